//! Decimal text of numbers, for three purposes: the shortest text that reads back equal, up to 32 digits, or nine digits for messages.

use mbs_core::real::DoubleDouble;

/// Number of significant digits in a message or a table. Chosen, not tuned.
const DIGITS: usize = 9;
/// Absolute values that are shown without an exponent.
const PLAIN: core::ops::Range<f64> = 1e-4..1e9;
/// Absolute values that are written without an exponent. Below the upper bound every double has a digit after the point.
const PLAIN_IN_FULL: core::ops::Range<f64> = 1e-4..1e15;

/// Text of a number with at most nine significant digits and no zeros at its end. Very large or small numbers have an exponent.
///
/// # Examples
/// ```
/// assert_eq!(mbs_scene::format::significant(0.714_200_000_000_000_1), "0.7142");
/// assert_eq!(mbs_scene::format::significant(1.0e-7 / 3.0), "3.33333333e-8");
/// assert_eq!(mbs_scene::format::significant(10.0), "10");
/// ```
#[must_use]
pub fn significant(x: f64) -> String {
    let rounded = rounded(x, DIGITS);
    let size = rounded.abs();
    if size == 0.0 {
        return "0".to_owned();
    }
    if PLAIN.contains(&size) { format!("{rounded}") } else { format!("{rounded:e}") }
}

/// Text of a number with at most 32 digits. It has an exponent where the text of [`shortest()`] has one.
#[must_use]
pub fn full(x: DoubleDouble) -> String {
    let size = x.hi().abs();
    let is_plain = x.hi() == 0.0 || !size.is_finite() || PLAIN_IN_FULL.contains(&size);
    if is_plain { format!("{x}") } else { format!("{x:e}") }
}

/// The shortest decimal text that reads back as the same number, with an exponent for very large and very small numbers.
#[must_use]
pub fn shortest(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 || !x.is_finite() || PLAIN_IN_FULL.contains(&size) {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}

/// Rounds a number to this number of significant digits, which shortens its decimal text.
#[must_use]
pub fn rounded(x: f64, digits: usize) -> f64 {
    if !x.is_finite() {
        return x;
    }
    format!("{x:.*e}", digits.saturating_sub(1)).parse().unwrap_or(x)
}

/// Text of a number with three significant digits, for messages.
#[must_use]
pub fn few(x: f64) -> String {
    significant(rounded(x, 3))
}

/// Text of a size for a table: an exponent with four significant digits, and `0` for zero.
#[must_use]
pub fn size(x: f64) -> String {
    if x == 0.0 { "0".to_owned() } else { format!("{x:.3e}") }
}

/// Text of a time span for a table, with its unit.
#[must_use]
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if s >= 1.0 => format!("{s:.2} s"),
        s if s >= 1e-3 => format!("{:.2} ms", s * 1e3),
        s => format!("{:.1} us", s * 1e6),
    }
}

/// Text of a count with its noun, which is in the plural unless the count is one.
#[must_use]
pub fn counted(n: usize, noun: &str) -> String {
    if n == 1 {
        return format!("1 {noun}");
    }
    match noun.split_once(" of ") {
        Some((head, rest)) => format!("{n} {head}s of {rest}"),
        None => match noun.strip_suffix('y') {
            Some(stem) => format!("{n} {stem}ies"),
            None => format!("{n} {noun}s"),
        },
    }
}

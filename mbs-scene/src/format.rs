//! Decimal text of numbers: in full, the shortest that reads back, or nine significant digits for people.

use mbs_core::real::DoubleDouble;

/// Significant digits that a message or a table shows. Chosen, not tuned.
const DIGITS: usize = 9;
/// Sizes of numbers that are shown without an exponent: from the first, below the second.
const PLAIN: core::ops::Range<f64> = 1e-4..1e9;
/// Sizes of numbers that are written without an exponent: below the second every double has a digit after the point.
const PLAIN_IN_FULL: core::ops::Range<f64> = 1e-4..1e15;

/// A number with at most nine significant digits and no zeros at its end; powers of ten where it is very large or small.
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

/// Text of a number with at most 32 digits; exponents where [`shortest()`] has them.
#[must_use]
pub fn full(x: DoubleDouble) -> String {
    let size = x.hi().abs();
    let is_plain = x.hi() == 0.0 || !size.is_finite() || PLAIN_IN_FULL.contains(&size);
    if is_plain { format!("{x}") } else { format!("{x:e}") }
}

/// The shortest decimal text that reads back as the same number; exponents where they are shorter.
#[must_use]
pub fn shortest(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 || !x.is_finite() || PLAIN_IN_FULL.contains(&size) {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}

/// Rounds to so many significant digits, which shortens the decimal text.
#[must_use]
pub fn rounded(x: f64, digits: usize) -> f64 {
    if !x.is_finite() {
        return x;
    }
    format!("{x:.*e}", digits.saturating_sub(1)).parse().unwrap_or(x)
}

/// Three significant digits, for messages.
#[must_use]
pub fn few(x: f64) -> String {
    significant(rounded(x, 3))
}

/// A size for a table: four digits, and a plain zero.
#[must_use]
pub fn size(x: f64) -> String {
    if x == 0.0 { "0".to_owned() } else { format!("{x:.3e}") }
}

/// A time span for a table.
#[must_use]
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if s >= 1.0 => format!("{s:.2} s"),
        s if s >= 1e-3 => format!("{:.2} ms", s * 1e3),
        s => format!("{:.1} us", s * 1e6),
    }
}

/// A count with its noun, of which there may be many.
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

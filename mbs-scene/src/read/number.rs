//! Numbers from decimal texts and from computed values.

use super::ReadFault;
use super::error::Read;
use super::expression::unit::{self, Dimensions};
use super::texts::Texts;
use super::tree::Span;
use mbs_core::real::DoubleDouble;
use mbs_core::scene::Number;

/// Number of digits of a value's text after the first [-]: 32 in all, as a double-double number has.
const DIGITS: usize = 31;

/// The number of a decimal text, which must be finite.
pub(super) fn decimal(texts: &Texts, text: &str, span: &Span) -> Read<Number> {
    match Number::from_decimal(text) {
        Some(number) if number.to_f64().is_finite() => Ok(number),
        _ => Err(texts.error(span, ReadFault::NotFinite { text: text.to_owned() })),
    }
}

/// A computed value as a number with 32 digits. `text` is the text in the error for a value that is not finite.
pub(super) fn rounded(
    texts: &Texts,
    value: DoubleDouble,
    (text, span): (&str, &Span),
) -> Read<Number> {
    let decimal = format!("{value:.DIGITS$e}");
    let (digits, exponent) = decimal.split_once('e').unwrap_or((&decimal, "0"));
    let decimal = format!("{}0e{exponent}", digits.trim_end_matches('0'));
    let number = Number::from_decimal(&decimal).filter(|number| number.to_f64().is_finite());
    number.ok_or_else(|| texts.error(span, ReadFault::NotFinite { text: text.to_owned() }))
}

/// Refuses a number with a unit whose dimensions differ from those of the key.
pub(super) fn check_unit(
    texts: &Texts,
    (text, span): (&str, &Span),
    dimensions: Option<Dimensions>,
    (key, unit): (&'static str, &'static str),
) -> Read<()> {
    let ways = unit::of_key(unit);
    match dimensions {
        Some(dimensions) if !ways.is_empty() && !ways.contains(&dimensions) => {
            let (text, found) = (text.to_owned(), unit::described(dimensions));
            Err(texts.error(span, ReadFault::OtherUnit { key, unit, text, found }))
        }
        _ => Ok(()),
    }
}

//! Decimal text to double-double number, by exact whole numbers.

use super::double_double::DoubleDouble;
use super::wide::Wide;

/// Largest number of digits that are read [-]. The other digits change the number by less than 10⁻⁵⁹ of it.
const MOST_DIGITS: u32 = 60;
/// Number of bits of the quotient [-]. The result needs 108 bits, two more than it keeps, and 120 fit the type.
const BITS: usize = 120;

/// Least number whose second part has all its bits: 2⁻⁹⁶⁹.
const WHOLE: f64 = f64::from_bits((1023 - 969) << 52);

/// The number of the decimal `text`, within 2⁻¹⁰⁶ of its size for numbers above 2⁻⁹⁶⁹. Every text that `f64` accepts is accepted.
///
/// Cost: about 10⁵ operations on whole numbers.
pub(super) fn read(text: &str) -> Option<DoubleDouble> {
    let near: f64 = text.parse().ok()?;
    // Infinities and NaN have no digits. A number too small for `f64` is zero.
    if near == 0.0 || !near.is_finite() {
        return Some(DoubleDouble::from_f64(near));
    }
    let (mut over, exponent) = digits(text)?;
    let mut under = Wide::from_u64(1);
    if exponent >= 0 {
        over.multiply_by_ten_to(exponent.unsigned_abs());
    } else {
        under.multiply_by_ten_to(exponent.unsigned_abs());
    }
    // The fraction is scaled by a power of two, so that the quotient has `BITS` bits or one less.
    let (of_over, wanted) = (over.bits(), under.bits() + BITS - 1);
    let (power, surplus) = (wanted.saturating_sub(of_over), of_over.saturating_sub(wanted));
    over.shift_up(power);
    under.shift_up(surplus);
    let quotient = over.divide(&under, BITS);
    let shift = i32::try_from(surplus).ok()? - i32::try_from(power).ok()?;
    let mut size = pair(quotient, shift);
    // Lost bits of the second part may change the first part by rounding.
    let nearest = near.abs();
    if nearest < WHOLE && size.hi().to_bits() != nearest.to_bits() {
        size = DoubleDouble::from_f64(nearest);
    }
    Some(if near < 0.0 { -size } else { size })
}

/// The first digits as a whole number, and its power of ten. The caller has checked that the text is a number.
fn digits(text: &str) -> Option<(Wide, i32)> {
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(at) => (&text[..at], text[at + 1..].parse::<i32>().ok()?),
        None => (text, 0),
    };
    let (mut number, mut n, mut shift, mut is_fraction) = (Wide::ZERO, 0, 0_i32, false);
    for byte in mantissa.bytes() {
        match byte {
            b'.' => is_fraction = true,
            b'0'..=b'9' if n < MOST_DIGITS => {
                number.multiply(10);
                number.add(u64::from(byte - b'0'), 0);
                n += u32::from(!number.is_zero());
                shift -= i32::from(is_fraction);
            }
            // A digit of the whole part that is left out still moves the decimal point.
            b'0'..=b'9' => shift += i32::from(!is_fraction),
            _ => {}
        }
    }
    Some((number, exponent.checked_add(shift)?))
}

/// The number m 2^shift in two parts, each rounded to nearest.
#[allow(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "roundings are what is asked for, of numbers of at most 120 bits"
)]
fn pair(m: u128, shift: i32) -> DoubleDouble {
    let hi = m as f64;
    let lo = (m as i128 - hi as i128) as f64;
    DoubleDouble::from_sum(libm::scalbn(hi, shift), libm::scalbn(lo, shift))
}

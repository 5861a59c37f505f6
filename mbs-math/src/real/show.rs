//! Double-double number to decimal text, by exact whole numbers.

use super::double_double::DoubleDouble;
use super::wide::Wide;
use core::fmt::{self, Alignment, Display, Formatter, LowerExp, Write};

/// Number of digits when no precision is requested: all digits of a double-double number.
const DIGITS: usize = 32;
/// Largest number of digits that are computed. Further digits are written as zeros.
const MOST_DIGITS: usize = 64;
/// Exponent of the smallest positive `f64`, which is 2^-1074.
const SMALLEST: i32 = 1074;
/// Bound of the rounding error of a logarithm [-]. The logarithms are below 400, with errors of at most 1e-13.
const LOG_ROUNDING: f64 = 1e-9;

/// Decimal digits of an absolute value: d₀.d₁d₂ ... times 10^exponent. Zero has no digits.
struct Decimal {
    digits: [u8; MOST_DIGITS],
    n: usize,
    exponent: i32,
}

impl Decimal {
    /// The absolute value of a finite number, rounded to nearest with ties to even. The number of digits is `wanted(exponent)`.
    fn new(x: DoubleDouble, wanted: impl Fn(i32) -> i32) -> Self {
        let mut of = Self { digits: [0; MOST_DIGITS], n: 0, exponent: 0 };
        if x.hi() == 0.0 {
            return of;
        }
        let (mut over, mut under) = (exact(x), Wide::from_u64(1));
        under.shift_up(SMALLEST.unsigned_abs() as usize);
        // An exponent that is one too small is corrected below. The subtracted bound keeps the exponent from being too large.
        #[allow(clippy::cast_possible_truncation, reason = "an exponent is below 400")]
        let mut exponent = libm::floor(libm::log10(x.hi().abs()) - LOG_ROUNDING) as i32;
        let scaled = if exponent >= 0 { &mut under } else { &mut over };
        scaled.multiply_by_ten_to(exponent.unsigned_abs());
        let mut tenfold = under;
        tenfold.multiply(10);
        if over >= tenfold {
            (under, exponent) = (tenfold, exponent + 1);
        }
        of.exponent = exponent;
        let wanted = wanted(exponent);
        if wanted < 0 {
            return of;
        }
        if wanted == 0 {
            under.multiply(10);
        }
        of.n = usize::try_from(wanted).unwrap_or(0).min(MOST_DIGITS);
        for digit in &mut of.digits[..of.n] {
            *digit = u8::try_from(over.divide(&under, 4)).unwrap_or(9);
            over.multiply(10);
        }
        // The remainder was multiplied by ten after the last digit, unless no digits were computed.
        under.multiply(if of.n == 0 { 1 } else { 10 });
        over.multiply(2);
        let last_is_odd = of.n > 0 && of.digits[of.n - 1] % 2 == 1;
        if over > under || (over == under && last_is_odd) {
            of.round_up();
        }
        of
    }

    /// Adds one to the last digit.
    fn round_up(&mut self) {
        for digit in self.digits[..self.n].iter_mut().rev() {
            if *digit < 9 {
                *digit += 1;
                return;
            }
            *digit = 0;
        }
        // Rounding 9.99 up gives 10.0. A number without digits becomes a one at the place before.
        self.exponent += 1;
        self.n = (self.n + 1).min(MOST_DIGITS);
        self.digits[0] = 1;
    }

    /// Leaves out zeros at the end.
    fn trim(&mut self) {
        while self.n > 0 && self.digits[self.n - 1] == 0 {
            self.n -= 1;
        }
    }

    /// The digit at 10^place.
    fn at(&self, place: i32) -> char {
        let i = usize::try_from(self.exponent - place).ok().filter(|&i| i < self.n);
        char::from(b'0' + i.map_or(0, |i| self.digits[i]))
    }

    /// Writes the digits from 10^from down to 10^to.
    fn write(&self, to: &mut dyn Write, (from, down): (i32, i32)) -> fmt::Result {
        (down..=from).rev().try_for_each(|place| to.write_char(self.at(place)))
    }

    /// Writes the whole part, and this number of decimals.
    fn plain(&self, to: &mut dyn Write, decimals: usize) -> fmt::Result {
        self.write(to, (self.exponent.max(0), 0))?;
        if decimals == 0 {
            return Ok(());
        }
        to.write_char('.')?;
        self.write(to, (-1, -i32::try_from(decimals).unwrap_or(i32::MAX)))
    }

    /// Writes one digit, this number of decimals, and the exponent.
    fn scientific(&self, to: &mut dyn Write, decimals: usize) -> fmt::Result {
        to.write_char(self.at(self.exponent))?;
        if decimals > 0 {
            to.write_char('.')?;
            let last = self.exponent - i32::try_from(decimals).unwrap_or(i32::MAX - 400);
            self.write(to, (self.exponent - 1, last))?;
        }
        write!(to, "e{}", if self.n == 0 { 0 } else { self.exponent })
    }
}

/// The absolute value of a finite number times 2^[`SMALLEST`], which is a whole number.
fn exact(x: DoubleDouble) -> Wide {
    let mut sum = Wide::ZERO;
    let (hi, lo) = (parts(x.hi()), parts(x.lo()));
    sum.add(hi.0, hi.1);
    if (x.hi() < 0.0) == (x.lo() < 0.0) {
        sum.add(lo.0, lo.1);
    } else {
        sum.subtract(lo.0, lo.1);
    }
    sum
}

/// Significand and shift of the absolute value of a finite `f64`, as a multiple of the smallest positive `f64`.
fn parts(x: f64) -> (u64, usize) {
    let (fraction, exponent) = (x.to_bits() & ((1 << 52) - 1), (x.to_bits() >> 52) & 0x7ff);
    if exponent == 0 { (fraction, 0) } else { (fraction | 1 << 52, exponent as usize - 1) }
}

/// Writer that counts the characters.
struct Length(usize);

impl Write for Length {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0 += text.len();
        Ok(())
    }
}

/// Writes sign, body, and the padding to the requested width. Numbers are aligned to the right by default.
fn padded(
    f: &mut Formatter<'_>,
    is_negative: bool,
    body: impl Fn(&mut dyn Write) -> fmt::Result,
) -> fmt::Result {
    let sign = if is_negative {
        "-"
    } else if f.sign_plus() {
        "+"
    } else {
        ""
    };
    let mut length = Length(sign.len());
    body(&mut length)?;
    let room = f.width().unwrap_or(0).saturating_sub(length.0);
    let (fill, zeros) = if f.sign_aware_zero_pad() { (0, room) } else { (room, 0) };
    let before = match f.align() {
        Some(Alignment::Left) => 0,
        Some(Alignment::Center) => fill / 2,
        _ => fill,
    };
    let letter = f.fill();
    (0..before).try_for_each(|_| f.write_char(letter))?;
    f.write_str(sign)?;
    (0..zeros).try_for_each(|_| f.write_char('0'))?;
    body(f)?;
    (before..fill).try_for_each(|_| f.write_char(letter))
}

impl Display for DoubleDouble {
    /// Writes the number without an exponent, like `f64`, with the requested decimals. Without a request it has 32 digits, and zeros at the
    /// end are left out.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if !self.hi().is_finite() {
            return Display::fmt(&self.hi(), f);
        }
        let (decimal, decimals) = match f.precision() {
            Some(p) => {
                let wanted = i32::try_from(p).unwrap_or(i32::MAX / 2);
                (Decimal::new(*self, |exponent| exponent + 1 + wanted), p)
            }
            None => {
                let mut decimal = Decimal::new(*self, |_| DIGITS as i32);
                decimal.trim();
                let n = i32::try_from(decimal.n).unwrap_or(0);
                let last = if n == 0 { 0 } else { n - 1 - decimal.exponent };
                (decimal, usize::try_from(last).unwrap_or(0))
            }
        };
        padded(f, self.hi().is_sign_negative(), |to| decimal.plain(to, decimals))
    }
}

impl LowerExp for DoubleDouble {
    /// Writes the number with an exponent, with the requested decimals. Without a request it has 32 digits, and zeros at the end are left
    /// out.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if !self.hi().is_finite() {
            return LowerExp::fmt(&self.hi(), f);
        }
        let (decimal, decimals) = match f.precision() {
            Some(p) => {
                let wanted = i32::try_from(p).unwrap_or(i32::MAX - 1);
                (Decimal::new(*self, |_| wanted + 1), p)
            }
            None => {
                let mut decimal = Decimal::new(*self, |_| DIGITS as i32);
                decimal.trim();
                let decimals = decimal.n.saturating_sub(1);
                (decimal, decimals)
            }
        };
        padded(f, self.hi().is_sign_negative(), |to| decimal.scientific(to, decimals))
    }
}

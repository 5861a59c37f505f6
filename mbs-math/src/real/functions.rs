//! Square root, sine, cosine and angle (atan2) of double-double numbers.

use super::double_double::DoubleDouble;
use super::transforms::{fast_two_sum, two_product};

type Pair = DoubleDouble;

/// Terms whose sum is π/2 within 2⁻²⁶⁸. The last terms give the digits that remain after cancellation near multiples of π/2.
const QUARTER: [f64; 5] = [
    core::f64::consts::FRAC_PI_2,
    6.123233995736766e-17,
    -1.4973849048591698e-33,
    5.562271104316826e-50,
    2.836115989820158e-66,
];
/// Number of quarter turns in a radian: 2/π.
const QUARTERS: f64 = core::f64::consts::FRAC_2_PI;
/// Largest number of quarter turns of an angle that is reduced [-]: 2⁵⁰, within the range 2⁵³ of exact whole numbers in `f64`.
const MOST_QUARTERS: f64 = 1_125_899_906_842_624.0;
/// The largest n in the terms xⁿ/n! [-]. For x = π/4 the first omitted term is 2⁻¹¹³ of the first term of the sine, and 2⁻¹¹⁹ for the
/// cosine.
const TERMS: usize = 28;
/// Coefficients 1/n! of the series, with the rounding errors of double-double products and quotients.
const SHARES: [Pair; TERMS + 1] = shares();

const fn shares() -> [Pair; TERMS + 1] {
    let mut of = [Pair::ONE; TERMS + 1];
    let mut product = Pair::ONE;
    let mut n = 1;
    while n <= TERMS {
        product = product.times_f64(n as f64);
        of[n] = Pair::ONE.over(product);
        n += 1;
    }
    of
}

/// Square root √x by one correction of the root of the leading part, with the exact square of that root (Karp).
///
/// The error is at most 25/8 u². A negative number gives NaN, and zero keeps its sign.
#[inline]
pub(super) fn sqrt(x: Pair) -> Pair {
    let root = libm::sqrt(x.hi());
    // The root is zero, infinite or NaN.
    if !(root > 0.0 && root.is_finite()) {
        return Pair::from_f64(root);
    }
    let (square, left) = two_product(root, root);
    let rest = ((x.hi() - square) - left) + x.lo();
    let (hi, lo) = fast_two_sum(root, rest / (2.0 * root));
    Pair::pair(hi, lo)
}

/// Sine and cosine of an angle [rad].
///
/// The angle is reduced to |r| ≤ π/4 by multiples of π/2 with 268 bits, and the Taylor series is summed in double-double arithmetic. The
/// relative error of each result is at most 2⁻¹⁰². Angles beyond 2⁵⁰ quarter turns, infinities and NaN give NaN.
///
/// Cost: 29 products and 30 sums of pairs, about 1300 flops.
pub(super) fn sin_cos(x: Pair) -> (Pair, Pair) {
    let count = libm::rint(x.hi() * QUARTERS);
    if !(count.abs() <= MOST_QUARTERS) {
        let none = Pair::from_f64(f64::NAN);
        return (none, none);
    }
    let mut r = x;
    if count != 0.0 {
        for part in QUARTER {
            let (product, left) = two_product(count, part);
            r -= Pair::from_sum(product, left);
        }
    }
    let (sine, cosine) = series(r);
    // The remainder by four of a whole number below 2⁵¹.
    #[allow(clippy::cast_possible_truncation, reason = "a whole number below 2^51")]
    match (count as i64).rem_euclid(4) {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// Sine and cosine for |r| ≤ π/4: r − r³/3! + ..., 1 − r²/2! + ...
fn series(r: Pair) -> (Pair, Pair) {
    let minus = -(r * r);
    let (mut sine, mut cosine) = (SHARES[TERMS - 1], SHARES[TERMS]);
    let mut n = TERMS - 2;
    while n >= 2 {
        cosine = SHARES[n] + minus * cosine;
        if n > 2 {
            sine = SHARES[n - 1] + minus * sine;
        }
        n -= 2;
    }
    // The largest terms are added last, so that the sine of a small angle is the angle itself.
    (r + r * (minus * sine), Pair::ONE + minus * cosine)
}

/// Angle of the point (x, y) from the x axis [rad], in [−π, π].
///
/// The angle θ of the leading parts is corrected once by δ: sin(δ) = (y cos θ − x sin θ)/r, where δ ≈ 10⁻¹⁶ equals its sine. The relative
/// error is at most 2⁻¹⁰⁰. Zeros and infinities give the multiples of π/4 that `f64` gives, with the same signs.
pub(super) fn atan2(y: Pair, x: Pair) -> Pair {
    let near = libm::atan2(y.hi(), x.hi());
    if near.is_nan() {
        return Pair::from_f64(near);
    }
    let size = libm::fmax(y.hi().abs(), x.hi().abs());
    if size == 0.0 || !size.is_finite() || y.hi() == 0.0 {
        let eighths = libm::rint(near * (2.0 * QUARTERS));
        let angle = Pair::PI.times_f64(eighths * 0.25);
        // The result keeps the sign of minus zero.
        return if eighths == 0.0 { Pair::from_f64(near) } else { angle };
    }
    // Both are scaled to a size near one, so that squares stay in range. The power of two is applied as two factors, since the power itself
    // may be out of range.
    let half = libm::scalbn(1.0, -libm::ilogb(size) / 2);
    let rest = libm::scalbn(1.0, -libm::ilogb(size) - (-libm::ilogb(size) / 2));
    let (y, x) = (y.scaled(half).scaled(rest), x.scaled(half).scaled(rest));
    let (sine, cosine) = sin_cos(Pair::from_f64(near));
    let across = y * cosine - x * sine;
    let radius = libm::sqrt(y.hi() * y.hi() + x.hi() * x.hi());
    Pair::from_sum(near, across.hi() / radius)
}

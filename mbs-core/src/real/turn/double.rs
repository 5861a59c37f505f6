//! Sine and cosine in double precision, without branches up to [`LIMIT`], so that a compiler sets them side by side in wide registers.
//!
//! ```text
//! n = round(x 2/π),   r + t = x − n π/2 in [−π/4, π/4],   π/2 = P1 + P2 + P3     the first two of 33 bits, so that n P1 and n P2 are exact
//! sin = r + (t − z (t/2 − r z S(z))) + r z S1,   cos = 1 − z/2 + (z² C(z) − r t),   z = r²
//! ```
//!
//! S and C are the minimax polynomials of fdlibm (Sun Microsystems, 1993; `k_sin.c`, `k_cos.c`), as are the three parts of π/2
//! (`e_rem_pio2.c`). What x − n P1 − n P2 rounds off comes back with the third part, as t. Beyond the limit libm is called.

/// The largest angle that is reduced here [rad]: n stays below 2²⁰, with which P1 and P2 have exact products.
pub(super) const LIMIT: f64 = 1.0e6;

/// Added and taken away, it rounds a number below 2⁵¹ to a whole one, whose last bits are then the last of the sum.
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// π/2 in three parts, the last rounded.
const HALF_PI: [f64; 3] =
    [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

/// Coefficients of the sine, r + r z (S1 + z S(z)), the lowest first.
const S: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
/// Coefficients of the cosine, 1 − z/2 + z² C(z), the lowest first.
const C: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// Sine and cosine of an angle [rad]. Cost: 25 products and 27 sums; beyond the limit that of libm.
#[inline]
pub(in crate::real) fn sin_cos(x: f64) -> (f64, f64) {
    // Not a number is beyond it too.
    if is_near(x) { near(x) } else { far(x) }
}

/// Is an angle within the limit?
#[inline(always)]
pub(in crate::real) fn is_near(x: f64) -> bool {
    x.abs() <= LIMIT
}

/// Sine and cosine of an angle within the limit.
#[inline(always)]
pub(in crate::real) fn near(x: f64) -> (f64, f64) {
    let whole = x * core::f64::consts::FRAC_2_PI + ROUNDING;
    let n = whole - ROUNDING;
    let first = x - n * HALF_PI[0];
    let shift = n * HALF_PI[1];
    let second = first - shift;
    // What the last difference lost comes back with the third part.
    let rest = ((first - second) - shift) - n * HALF_PI[2];
    let r = second + rest;
    let t = (second - r) + rest;
    let (sine, cosine) = (sine(r, t), cosine(r, t));
    let quarter = whole.to_bits();
    let (y, x) = if quarter & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    // The sign changes by the second bit of the quarter, and of the next one.
    let (sign_y, sign_x) = ((quarter & 2) << 62, ((quarter + 1) & 2) << 62);
    (f64::from_bits(y.to_bits() ^ sign_y), f64::from_bits(x.to_bits() ^ sign_x))
}

/// sin(r + t), |r| ≤ π/4, t within the last place of r.
#[inline(always)]
fn sine(r: f64, t: f64) -> f64 {
    let z = r * r;
    let series = S[1] + z * (S[2] + z * (S[3] + z * (S[4] + z * S[5])));
    let cube = z * r;
    r - ((z * (0.5 * t - cube * series) - t) - cube * S[0])
}

/// cos(r + t).
#[inline(always)]
fn cosine(r: f64, t: f64) -> f64 {
    let z = r * r;
    let series = z * (C[0] + z * (C[1] + z * (C[2] + z * (C[3] + z * (C[4] + z * C[5])))));
    let half = 0.5 * z;
    let w = 1.0 - half;
    w + (((1.0 - w) - half) + (z * series - r * t))
}

#[cold]
#[inline(never)]
pub(in crate::real) fn far(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

#[cfg(test)]
mod tests {
    use super::{LIMIT, sin_cos};
    use crate::Real;
    use crate::real::DoubleDouble;

    /// The largest error of both values, in units of the last place of the exact one.
    fn places(x: f64) -> f64 {
        let (found_y, found_x) = sin_cos(x);
        let (y, x) = DoubleDouble::from_f64(x).sin_cos();
        let off = |found: f64, exact: DoubleDouble| {
            let size = exact.to_f64().abs();
            let place = f64::from_bits(size.to_bits() + 1) - size;
            (DoubleDouble::from_f64(found) - exact).to_f64().abs() / place
        };
        off(found_y, y).max(off(found_x, x))
    }

    /// Numbers of all sizes, spread evenly over the bits between two.
    fn spread(from: f64, to: f64, n: u64) -> impl Iterator<Item = f64> {
        let (from, to) = (from.to_bits(), to.to_bits());
        (0..n).flat_map(move |k| {
            let x = f64::from_bits(from + (to - from) / n * k + (k * 7919) % 4096);
            [x, -x]
        })
    }

    // 0.5 is rounding of the result, the rest that of sums before it; looked at for 20 million numbers the largest error was 0.781.
    #[test]
    fn sine_and_cosine_are_right_to_the_last_place() {
        let worst =
            |numbers: &mut dyn Iterator<Item = f64>| numbers.map(places).fold(0.0, f64::max);
        let small = worst(&mut spread(1e-12, core::f64::consts::FRAC_PI_4, 40_000));
        let all = worst(&mut spread(core::f64::consts::FRAC_PI_4, LIMIT, 40_000));
        assert!(small < 0.8 && all < 0.8, "{small} {all}");
    }

    // The doubles nearest to multiples of pi/2 are where the reduction cancels most.
    #[test]
    fn multiples_of_a_quarter_turn_keep_every_digit() {
        let multiples =
            (1..640_000).step_by(97).map(|n| f64::from(n) * core::f64::consts::FRAC_PI_2);
        let neighbours = multiples.filter(|x| *x < LIMIT).flat_map(|x| {
            [-1_i64, 0, 1].map(|by| f64::from_bits(x.to_bits().wrapping_add_signed(by)))
        });
        let worst = neighbours.map(places).fold(0.0, f64::max);
        assert!(worst < 0.8, "{worst}");
    }

    #[test]
    fn sine_and_cosine_at_zero_are_exact_and_beyond_the_limit_are_those_of_libm() {
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
        assert_eq!(sin_cos(1e-300), (1e-300, 1.0));
        for x in [1.000_001e6, -1e9, 3e300] {
            assert_eq!(sin_cos(x), libm::sincos(x), "{x}");
        }
        assert!(sin_cos(f64::NAN).0.is_nan() && sin_cos(f64::INFINITY).1.is_nan());
    }
}

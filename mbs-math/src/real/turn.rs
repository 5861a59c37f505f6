//! Sine and cosine in single precision alone. libm computes them in double precision, which is done in software on a Cortex-M4F.
//!
//! ```text
//! n = round(x 2/π),   r = x − n π/2 in [−π/4, π/4],   π/2 = P1 + P2 + P3      the first two short, so that n P1 and n P2 are exact
//! sin r = r + r³ S(r²),   cos r = 1 − r²/2 + r⁴ C(r²)                         S and C of degree two, minimax, by Remez' exchange
//! ```
//!
//! Both results are within 1.32 2⁻²⁴ of the exact values (within 2⁻²⁴ up to π/4), and within 2.2 units in the last place. This was checked
//! for every number up to [`MAX_ANGLE`]. Larger angles are passed to libm, at its cost in doubles. There, `f32` resolves angles to 5e-4 rad
//! at best.
//!
//! Each product and sum is rounded separately, as everywhere in Rust, so that every target gives the same bits.

/// Largest angle that is reduced here [rad]. Up to it n is below 2¹². P1 and P2 have twelve bits, so n P1 and n P2 are exact.
const MAX_ANGLE: f32 = 6400.0;

/// Constant that rounds a number below 2²² to a whole number, when it is added and subtracted. The last bits of the sum are those of the
/// whole number.
const ROUNDING: f32 = 12_582_912.0;

/// Number of quarter turns in a radian: 2/π.
const TWO_BY_PI: f32 = core::f32::consts::FRAC_2_PI;
/// Parts P1, P2 and P3 of π/2; the last is rounded.
const HALF_PI: [f32; 3] = [1.570_800_8, -4.453_584_6e-6, -8.705_516e-10];

/// Coefficients of S and C, the lowest power first. The relative error is at most 4e-9 for the sine and 4e-11 for the cosine.
const S: [f32; 3] = [-0.166_666_55, 0.008_332_161, -0.000_195_152_5];
const C: [f32; 3] = [0.041_666_647, -0.001_388_736_7, 0.000_024_438_416];

/// Sine and cosine of an angle [rad]. Cost: 16 products and 15 sums; above [`MAX_ANGLE`] the cost of libm.
#[inline]
pub(super) fn sin_cos(x: f32) -> (f32, f32) {
    // The negated comparison also sends NaN to libm.
    if !(x.abs() <= MAX_ANGLE) {
        return far(x);
    }
    let whole = x * TWO_BY_PI + ROUNDING;
    let n = whole - ROUNDING;
    let near = x - n * HALF_PI[0];
    let shift = n * HALF_PI[1];
    let shifted = near - shift;
    // The rounding error of the last difference is added again with the third part.
    let r = shifted + ((near - shifted) - shift - n * HALF_PI[2]);
    let z = r * r;
    let sine = r + r * z * (S[0] + z * (S[1] + z * S[2]));
    let cosine = 1.0 - (0.5 * z - z * z * (C[0] + z * (C[1] + z * C[2])));
    let quarter = whole.to_bits();
    let (y, x) = if quarter & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    let is_left = (quarter + 1) & 2 != 0;
    (if quarter & 2 == 0 { y } else { -y }, if is_left { -x } else { x })
}

#[cold]
#[inline(never)]
fn far(x: f32) -> (f32, f32) {
    libm::sincosf(x)
}

#[cfg(test)]
mod tests {
    use super::{MAX_ANGLE, sin_cos};

    /// Distance between neighbouring `f32` numbers at `x`.
    fn last_place(x: f64) -> f64 {
        let single = crate::Real::abs(<f32 as crate::Real>::from_f64(x));
        f64::from(f32::from_bits(single.to_bits() + 1)) - f64::from(single)
    }

    /// The largest errors over some numbers: absolute in units of 2⁻²⁴, and in units of the last place.
    fn errors(numbers: impl Iterator<Item = f32>) -> [f64; 2] {
        let mut largest = [0.0_f64; 2];
        for x in numbers {
            let (sine, cosine) = sin_cos(x);
            let (y, x) = libm::sincos(f64::from(x));
            for (found, exact) in [(sine, y), (cosine, x)] {
                let error = (f64::from(found) - exact).abs();
                largest[0] = largest[0].max(error * f64::from(1 << 24));
                largest[1] = largest[1].max(error / last_place(exact));
            }
        }
        largest
    }

    /// Every `stride`-th number of a range, and its negative.
    fn every(stride: usize, from: f32, to: f32) -> impl Iterator<Item = f32> {
        (from.to_bits()..=to.to_bits())
            .step_by(stride)
            .flat_map(|bits| [f32::from_bits(bits), -f32::from_bits(bits)])
    }

    // The bounds are those in the text at the top of this file, which were checked for every number of the range. Here every eleventh is
    // checked.
    #[test]
    fn sine_and_cosine_are_right_to_the_last_place_but_one() {
        let [absolute, places] = errors(every(11, 1e-3, core::f32::consts::FRAC_PI_4));
        assert!(absolute < 1.0 && places < 1.0, "{absolute} {places}");
        let [absolute, places] = errors(every(11, core::f32::consts::FRAC_PI_4, MAX_ANGLE));
        assert!(absolute < 1.32 && places < 2.2, "{absolute} {places}");
    }

    #[test]
    fn sine_and_cosine_at_zero_are_exact_and_beyond_the_limit_are_those_of_libm() {
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
        assert_eq!(sin_cos(1e-30), (1e-30, 1.0));
        for x in [6400.1_f32, -1e9, 3e38] {
            assert_eq!(sin_cos(x), libm::sincosf(x), "{x}");
        }
        assert!(sin_cos(f32::NAN).0.is_nan() && sin_cos(f32::INFINITY).1.is_nan());
    }
}

//! Force of a tire along its plane, and how it shares friction with the side force: the brush model with one parabola of pressure.
//!
//! ```text
//! k_x = (v - w R) / v_e                      v the hub's speed along the plane, w the wheel's rate, v_e as in `tire`
//! x   = C k_x / (mu F),  y = C_y tan a / (mu F),  r = sqrt(x^2 + y^2)
//! s   = 1 - r / 3 + r^2 / 27  for r < 3,  else 1 / r          r s = 1 - (1 - r / 3)^3: the whole patch slides from 3 on
//! Fx  = -C k_x s(r),          Fy = side force alone, times s(r) / s(y)
//! ```
//!
//! C is the stiffness of the force by slip, C_y that of the side force by the slip angle, F the load, mu the friction. Without
//! slip along the plane the side force is as it is alone; a wheel that slides whole has all its friction against the slide,
//! weighted by the two stiffnesses. Source: Pacejka, *Tire and Vehicle Dynamics* (2012), chapter 3, for the brush model; the factor
//! of the side force is the ratio that the same model gives.

use super::entry::entry;
use crate::Real;

/// Force by slip along the plane of a wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LongitudinalSlip<T> {
    /// Force by slip, C [N].
    pub stiffness: T,
    /// Largest force as a share of the load, mu [-].
    pub friction: T,
}

entry!(LongitudinalSlip<T> { stiffness, friction });

/// What slip along the plane makes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlipForce<T> {
    /// -Fx [N].
    pub resistance: T,
    /// Its derivative by k_x, not negative [N].
    pub slope: T,
    /// What is left of the side force [-].
    pub side_share: T,
    /// The slip at which r is 1 without side force [-].
    pub scale: T,
}

/// s(r).
fn share<T: Real>(r: T) -> T {
    let three = T::TWO + T::ONE;
    if r < three { T::ONE - r / three + r * r / (three * three * three) } else { T::ONE / r }
}

/// s'(r) / r, for r above zero.
fn fall<T: Real>(r: T) -> T {
    let three = T::TWO + T::ONE;
    if r < three {
        (T::TWO * r / (three * three * three) - T::ONE / three) / r
    } else {
        -T::ONE / (r * r * r)
    }
}

/// The slope of a force at a rate, with the force `foreseen` there by the iterate before; `scale` is the rate at which r is 1.
///
/// The equation F / s(x) = M x is linearised in both F and x, so that the slope is M s (1 + w s'(x) / s^2), with w the foreseen force over M. By
/// the tangents alone, which vanish where all slides, an iteration goes to and fro; with these it converges from anywhere, and
/// at the solution they are the tangents (Chan, Golub and Mulet 1999).
pub fn slope<T: Real>((force, rate): (T, T), scale: T, foreseen: T) -> Option<T> {
    let x = rate / scale;
    let (size, s) = (x.abs(), share(x.abs()));
    let most = force / (x * s);
    if !(most > T::ZERO && most.is_finite()) {
        return None;
    }
    let w = (foreseen / most).max(-T::ONE).min(T::ONE);
    Some((most / scale * s * (T::ONE + w * x * fall(size) / (s * s))).max(T::ZERO))
}

impl<T: Real> LongitudinalSlip<T> {
    /// The force at a load [N], a slip and a side force that alone would be stiffness times tangent [N]. No load, no force.
    pub fn force(&self, load: T, slip: T, sideways: T) -> SlipForce<T> {
        let most = self.friction * load;
        if !(most > T::ZERO) {
            return SlipForce {
                resistance: T::ZERO,
                slope: T::ZERO,
                side_share: T::ONE,
                scale: T::ONE,
            };
        }
        let (x, y) = (self.stiffness * slip / most, (sideways / most).abs());
        let r = (x * x + y * y).sqrt();
        let s = share(r);
        let bend = if r.is_zero() { T::ZERO } else { x * x * fall(r) };
        SlipForce {
            resistance: self.stiffness * slip * s,
            slope: (self.stiffness * (s + bend)).max(T::ZERO),
            side_share: s / share(y),
            scale: most / self.stiffness,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLIP: LongitudinalSlip<f64> = LongitudinalSlip { stiffness: 6e4, friction: 0.8 };

    #[test]
    fn the_force_is_the_brush_models_and_all_friction_from_three_on() {
        // 3200 N at most: 1 - (1 - r/3)^3 of them.
        for (slip, force) in [(0.02, 1056.25), (0.08, 2800.0), (0.16, 3200.0), (1.0, 3200.0)] {
            let found = SLIP.force(4000.0, slip, 0.0).resistance;
            assert!((found - force).abs() < 1e-6, "{slip}: {found}");
            assert!((SLIP.force(4000.0, -slip, 0.0).resistance + found).abs() < 1e-12);
        }
    }

    #[test]
    fn its_slope_is_that_of_differences() {
        let h = 1e-7;
        for slip in [-0.3, -0.1, -0.01, 0.004, 0.1, 0.15, 0.4] {
            for sideways in [0.0, 900.0, -4000.0, 2e4] {
                let at = |slip: f64| SLIP.force(4000.0, slip, sideways).resistance;
                let slope = (at(slip + h) - at(slip - h)) / (2.0 * h);
                let found = SLIP.force(4000.0, slip, sideways).slope;
                assert!((slope - found).abs() < 1e-3, "{slip}, {sideways}: {slope}, {found}");
            }
        }
    }

    #[test]
    fn the_foreseen_slope_at_a_solution_is_the_tangent_and_converges_from_anywhere() {
        // v + c F(v) = b with F by the rate of slip over 5 m/s: c a step over an inertia, b what the rate would be without the tire
        let law = |v: f64| {
            let force = SLIP.force(4000.0, v / 5.0, 0.0);
            (force.resistance, force.slope / 5.0, force.scale * 5.0)
        };
        for v in [-2.0, -0.3, 1e-3, 0.1, 0.6, 3.0] {
            let (force, tangent, scale) = law(v);
            let found = slope((force, v), scale, force).unwrap();
            assert!((found - tangent).abs() < 1e-9 * SLIP.stiffness, "{v}: {found}, {tangent}");
        }
        for (c, b) in [(1e-5, 0.01), (1e-3, 3.1), (1e-3, 3.3), (0.1, 100.0), (0.1, 400.0)] {
            for start in [-5.0, -0.01, 0.0, 0.02, 3.0] {
                let (mut v, mut last, mut n) = (start, None, 0);
                loop {
                    let (force, tangent, scale) = law(v);
                    let by = last.and_then(|(before, force_before, by)| {
                        slope((force, v), scale, force_before + by * (v - before))
                    });
                    let by: f64 = by.unwrap_or(tangent);
                    let correction = -(v + c * force - b) / (1.0 + c * by);
                    last = Some((v, force, by));
                    v += correction;
                    n += 1;
                    assert!(n < 40, "c = {c}, b = {b}, from {start}: {v}");
                    if correction.abs() < 1e-13 * (1.0 + v.abs()) {
                        break;
                    }
                }
            }
        }
    }

    #[test]
    fn both_forces_stay_within_friction() {
        for i in 0..200 {
            let slip = -1.0 + 0.01 * f64::from(i);
            for sideways in [0.0, 500.0, 3000.0, 9000.0, 1e5] {
                let force = SLIP.force(4000.0, slip, sideways);
                let alone = sideways * share(sideways / 3200.0);
                let both = force.resistance.hypot(alone * force.side_share);
                assert!(both <= 3200.0 * (1.0 + 1e-12), "{slip}, {sideways}: {both}");
            }
        }
    }

    #[test]
    fn a_wheel_that_slides_whole_is_held_against_its_slide() {
        // equal stiffnesses: the force opposes (1, tan a)
        let force = SLIP.force(4000.0, 1.0, 6e4 * 0.5);
        let alone = 6e4 * 0.5 * share(6e4 * 0.5 / 3200.0);
        assert!((alone * force.side_share / force.resistance - 0.5).abs() < 1e-12);
        assert!((force.resistance.hypot(alone * force.side_share) - 3200.0).abs() < 1e-9);
    }
}

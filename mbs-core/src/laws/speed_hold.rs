//! A drive that holds a speed: proportional, with a largest force.
//!
//! ```text
//! F = L s(g (v0 - v) / L),   s(x) = x / sqrt(1 + x^2)
//! ```
//!
//! The saturation is smooth, so that the force has a derivative everywhere; below a third of the limit it is the gain to
//! within 5 %.

use super::body::{Action, BodyMotion};
use super::scalar::Measure;
use crate::Real;
use crate::algebra::Vector;

/// A speed hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedHold<T> {
    /// Speed to hold [m/s].
    pub speed: T,
    /// Force per speed [N s/m].
    pub gain: T,
    /// Largest force [N].
    pub limit: T,
}

impl<T: Real> SpeedHold<T> {
    /// Force along the direction at a speed, and its negative derivative by the speed.
    #[inline]
    pub fn force(&self, speed: T) -> (T, T) {
        let x = self.gain * (self.speed - speed) / self.limit;
        let root = (T::ONE + x * x).sqrt();
        (self.limit * x / root, self.gain / (root * root * root))
    }

    /// The force on a body along the law's direction.
    pub(crate) fn action(&self, motion: &BodyMotion<T>) -> Action<T> {
        let axis = Vector::<T, 3>::from(motion.axis);
        let rate = axis.dot(&Vector::from(motion.velocity));
        let (force, damping) = self.force(rate);
        let measure = Measure { rate, tension: -force, damping, ..Measure::default() };
        Action { force: motion.axis, moment: [T::ZERO; 3], measure }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn force_is_proportional_near_the_speed_and_never_above_the_limit() {
        let hold = SpeedHold { speed: 5.0, gain: 1e4, limit: 1e4 };
        let (force, slope) = hold.force(4.99);
        assert!((force - 100.0).abs() < 0.01 && (slope - 1e4).abs() < 10.0);
        assert!(hold.force(-100.0).0 <= 1e4 && hold.force(200.0).0 >= -1e4);
        let h = 1e-6;
        for v in [0.0, 4.0, 5.0, 6.5] {
            let slope = (hold.force(v + h).0 - hold.force(v - h).0) / (2.0 * h);
            assert!((slope + hold.force(v).1).abs() < 1e-4, "{v}");
        }
    }
}

//! Elastic stops at both ends of a range: two [`bumper`]s.
//!
//! ```text
//! tension = F(m - upper, m') above the range,   -F(lower - m, -m') below it,   0 within
//! ```

use super::bumper::{self, Contact};
use crate::Real;

/// A range with stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit<T> {
    /// Lower end [rad or m].
    pub lower: T,
    /// Upper end [rad or m].
    pub upper: T,
    /// Stiffness of the stops [N m/rad or N/m].
    pub stiffness: T,
    /// Damping of the stops [N m s/rad or N s/m].
    pub damping: T,
}

impl<T: Real> Limit<T> {
    /// Tension at a coordinate and its rate, with derivatives by both.
    #[inline]
    pub fn tension(&self, value: T, rate: T) -> Contact<T> {
        let law = [self.stiffness, self.damping];
        if value > self.upper {
            return bumper::contact(law, value - self.upper, rate);
        }
        let below = bumper::contact(law, self.lower - value, -rate);
        Contact { force: -below.force, ..below }
    }

    /// Stored energy [J].
    #[inline]
    pub fn energy(&self, value: T) -> T {
        bumper::energy(self.stiffness, (value - self.upper).max(self.lower - value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stops_push_back_into_the_range() {
        let limit = Limit { lower: -0.2, upper: 0.3, stiffness: 1e3, damping: 0.0 };
        assert_eq!(limit.tension(0.0, 5.0), Contact::default());
        assert!((limit.tension(0.35, 0.0).force - 50.0).abs() < 1e-12);
        assert!((limit.tension(-0.25, 0.0).force + 50.0).abs() < 1e-12);
        assert!((limit.energy(0.35) - 1.25).abs() < 1e-13);
        assert!((limit.energy(-0.25) - 1.25).abs() < 1e-13);
    }
}

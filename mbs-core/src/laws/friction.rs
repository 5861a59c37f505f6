//! Stribeck friction, regularised: against the rate, continuous at rest.
//!
//! ```text
//! f = g(r) r / sqrt(r^2 + e^2) + v r,   g = C + (S - C) / (1 + (r / r_s)^2)
//! ```
//!
//! C Coulomb, S static, r_s Stribeck rate, v viscous part, e the regularisation. The fall from S to C is the rational bell in
//! place of Stribeck's exponential, which needs no exponential function and differs from it by less than 0.21 (S - C). Friction at
//! rest is zero: what hangs on friction creeps at a rate of about e times load over S. All power is dissipated.

use crate::Real;

/// A friction law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction<T> {
    /// Friction of fast motion [N m or N].
    pub coulomb: T,
    /// Friction of slow motion [N m or N].
    pub r#static: T,
    /// Rate at which half of the difference is gone [rad/s or m/s].
    pub stribeck: T,
    /// Viscous part [N m s/rad or N s/m].
    pub viscous: T,
    /// Rate below which friction falls with the rate [rad/s or m/s].
    pub regularisation: T,
}

impl<T: Real> Friction<T> {
    /// Force against the rate, and a derivative by it that does not fall below zero (where friction falls with the rate, a
    /// tangent with its negative slope could lose definiteness).
    #[inline]
    pub fn force(&self, rate: T) -> (T, T) {
        let (e, s) = (self.regularisation, rate / self.stribeck);
        let bell = T::ONE / (T::ONE + s * s);
        let rise = self.r#static - self.coulomb;
        let level = self.coulomb + rise * bell;
        let root = (rate * rate + e * e).sqrt();
        let share = rate / root;
        let slope = level * e * e / (root * root * root)
            - share * rise * T::TWO * s * bell * bell / self.stribeck
            + self.viscous;
        (level * share + self.viscous * rate, slope.max(T::ZERO))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: Friction<f64> = Friction {
        coulomb: 2.0,
        r#static: 3.0,
        stribeck: 0.1,
        viscous: 0.05,
        regularisation: 1e-3,
    };

    #[test]
    fn friction_is_odd_and_dissipates() {
        for i in 0..400 {
            let rate = 1e-5 * 1.05_f64.powi(i);
            let (f, _) = LAW.force(rate);
            assert!(f > 0.0 && f <= 3.0 + 0.05 * rate);
            assert!((f + LAW.force(-rate).0).abs() < 1e-15);
        }
        assert_eq!(LAW.force(0.0).0.to_bits(), 0);
    }

    #[test]
    fn friction_reaches_both_levels() {
        // At 1e-2 the bell is 0.99 and the regularisation 0.995.
        assert!((LAW.force(1e-2).0 - 2.975).abs() < 0.02);
        assert!((LAW.force(10.0).0 - 2.5).abs() < 1e-3);
    }

    #[test]
    fn slope_is_that_of_the_force_where_it_rises() {
        let h = 1e-7;
        for rate in [0.0, 5e-4, -2e-3, 1e-3, 5.0] {
            let slope = (LAW.force(rate + h).0 - LAW.force(rate - h).0) / (2.0 * h);
            let told = LAW.force(rate).1;
            assert!((slope.max(0.0) - told).abs() < 1e-5 * (1.0 + told), "{rate}: {slope} {told}");
        }
    }
}

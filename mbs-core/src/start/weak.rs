//! Criterion for rows that further sweeps do not improve: their residual may be due to rounded numbers of the scene.
//!
//! Axes that are intended to be parallel may be given with six digits only. Their rows are then almost combinations of others:
//! y^T J = sigma u^T, with a sigma of about 1e-6. With parallel axes these rows would be redundant. With the given axes they prevent the
//! motion u. Such a combination of residuals phi is accepted up to the effect of its tilt sigma on the motion x - x0 since the reference
//! configuration:
//!
//! ```text
//! |y^T phi| <= 2 sigma |x - x0|,   sigma <= 1e-6      (rows and motions measured by masses)
//! ```
//!
//! A true contradiction has sigma = 0, so that only rounding errors are accepted.

use super::problem::Level;
use super::sweeps::Assembly;
use crate::Real;
use crate::algebra::norm_inf;
use crate::blocks::SpdSolver;

/// Largest tilt of a row from others that may be due to rounded numbers of the scene [-]: a unit in the sixth digit.
pub(super) const TILT: f64 = 1e-6;
/// Number of sweeps that separate the weakly determined combinations from the rest of a residual [-]. Each reduces the rest by the factor 1
/// / penalty.
pub(super) const SIEVES: u32 = 3;

impl<T: Real, S: SpdSolver<T>, const D: usize> Assembly<'_, T, S, D> {
    /// True if the residuals of all rows are within `accepted`, relative to their spreads. The effect of their tilt on the motion `moved`
    /// does not count. The matrix of the level must be factored without curvature.
    pub(super) fn is_met(&mut self, level: Level, accepted: T, moved: &[T]) -> bool {
        if self.worst(&self.rows) <= accepted {
            return true;
        }
        if !norm_inf(&self.rows).is_finite() {
            return false;
        }
        let change = core::mem::take(&mut self.change);
        self.change = alloc::vec![T::ZERO; change.len()];
        // y <- y - J W^-1 J^T S y: the weakly determined part of the residual remains
        let mut weak = self.rows.clone();
        for _ in 0..SIEVES {
            self.weigh(&weak);
            self.solve(level);
            self.problem.multiply(&self.f, level, &mut self.products);
            weak.iter_mut().zip(&self.products).for_each(|(y, &d)| *y -= d);
        }
        let determined: alloc::vec::Vec<T> =
            self.rows.iter().zip(&weak).map(|(&all, &weak)| all - weak).collect();
        self.weigh(&weak);
        self.pull(level);
        self.change = change;
        let p = &self.problem;
        let sum = |x: &mut dyn Iterator<Item = T>| x.fold(T::ZERO, |sum, x| sum + x);
        // sigma^2 = |J^T S y|^2 / (P y^T S y), in the norm of the inverse masses
        let size = sum(&mut p.penalty.iter().zip(&weak).map(|(&s, &y)| s * y * y));
        let pull = sum(&mut p.mass.iter().zip(&self.f).map(|(&m, &f)| f * f / m));
        let way = sum(&mut p.mass.iter().zip(moved).map(|(&m, &x)| m * x * x));
        let tilt = (pull / (size * p.alpha)).sqrt();
        self.worst(&determined) <= accepted
            && tilt <= T::from_f64(TILT)
            && (size / p.alpha).sqrt() <= T::TWO * tilt * way.sqrt()
    }

    /// Computes mu = S y.
    fn weigh(&mut self, y: &[T]) {
        for (mu, (&s, &y)) in self.mu.iter_mut().zip(self.problem.penalty.iter().zip(y)) {
            *mu = s * y;
        }
    }
}

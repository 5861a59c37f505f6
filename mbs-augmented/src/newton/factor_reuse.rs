//! Reuse of the factor of an earlier correction, and the residual that such a correction needs.
//!
//! ```text
//! T' d = -(M a + J^T lambda - Q) / a' - J'^T s phi,     T' = M + J'^T s J' + ...
//! ```
//!
//! With a symmetric tangent, each correction of a vehicle is at most a tenth of the one before, with a new factor or with the first one.
//! (The side force of a tire turns with its wheel, and the tangent leaves out its unsymmetric part.) Two changes of the iteration make
//! reuse possible.
//!
//! First, s phi uses the rows J' of the factor, so that the resulting correction has no part along the motion. Second, multipliers grow by
//! s (phi + J' d), which balances the correction. The published growth, s phi after the correction [P3 (2)], contains the square of the
//! correction. The next correction would have to remove that part while s phi enforces it again. When the rows have rotated, the part acts
//! along the motion.

use crate::equations::Equations;
use mbs_core::implicit::Newton;
use mbs_core::integrator::Rule;
use mbs_core::model::Model;
use mbs_core::team::set_product;
use mbs_core::{Real, SpdSolver};

/// Largest contraction of corrections with which a factor is reused, if the iteration ends below the truncation error [-]. The contraction
/// is the ratio of two consecutive corrections. A new factor costs as much as two iterations, which contract to 0.04.
const MAX_CONTRACTION: f64 = 0.2;
/// Largest contraction of corrections with which a factor is reused, if the tolerance alone ends the iteration [-]. A new factor removes
/// nearly all of the error where only constraints act.
const MAX_CONTRACTION_TO_TOLERANCE: f64 = 1e-3;
/// Largest relative change of a law's tangent with which its factor is reused [-]. With a change of a tenth, each correction is about a
/// tenth of the one before.
const MAX_TANGENT_CHANGE: f64 = 0.1;
/// Ratio to the largest tangent below which a law's tangent is not compared [-]. A change of such a tangent affects a correction by at most
/// a thousandth.
const NEGLIGIBLE_TANGENT: f64 = 1e-3;

/// Rule that decides when the matrix of a step is factored again.
#[derive(Debug)]
pub(crate) struct FactorReuse<T> {
    /// True if multipliers grow by s (phi + J' d), in balance with the correction, instead of as published.
    is_balanced: bool,
    /// Largest contraction of corrections with which a factor is reused [-].
    max_contraction: T,
    /// Sum of the corrections since the matrix was factored [m].
    pub(crate) since: T,
}

impl<T: Real> FactorReuse<T> {
    /// Creates the rule before the first correction of a step.
    pub(crate) fn new(is_balanced: bool, ends_at_tolerance: bool) -> Self {
        let most = if ends_at_tolerance { MAX_CONTRACTION_TO_TOLERANCE } else { MAX_CONTRACTION };
        Self { is_balanced, max_contraction: T::from_f64(most), since: T::ZERO }
    }

    /// True if the next correction may use the present factor: the laws' tangents are close to those that were factored, and corrections
    /// shrink. A rotation of the rows has little effect, because the residual contains s phi with the factored rows.
    pub(crate) fn can_reuse<S: SpdSolver<T>>(
        &self,
        newton: &Newton<T>,
        rule: &Rule<T>,
        equations: &Equations<T, S>,
    ) -> bool {
        let [before, last] = newton.corrections;
        let is_like = || !self.is_balanced || has_like_laws(rule, equations);
        match newton.iterations {
            0 => false,
            1 => self.is_balanced && is_like(),
            _ => last <= before * self.max_contraction && is_like(),
        }
    }
}

/// True if the laws' tangents are close to those in the factored matrix. For example, they are not after a wheel has left the road, or
/// after a contact with a stop. Stiffness and damping of lengths and angles are compared on one scale. The geometric stiffness of a tension
/// is not compared.
fn has_like_laws<T: Real, S: SpdSolver<T>>(rule: &Rule<T>, equations: &Equations<T, S>) -> bool {
    let weight = |[stiffness, damping]: [T; 2]| stiffness + damping * rule.velocity;
    let (mut largest, mut change) = (T::ZERO, T::ZERO);
    for (&law, measure) in equations.factored_laws.iter().zip(&equations.terms.measures) {
        let (before, now) = (weight(law), weight([measure.stiffness, measure.damping]));
        let size = before.abs().max(now.abs());
        largest = largest.max(size);
        if !((now - before).abs() <= size * T::from_f64(MAX_TANGENT_CHANGE)) {
            change = change.max(size);
        }
    }
    !(change > largest * T::from_f64(NEGLIGIBLE_TANGENT))
}

/// Assembles the residual for a reused factor: f = M a + J^T lambda - force Q + J'^T s phi. Cost: two residuals.
pub(crate) fn residual_with_reused_jacobian<T: Real, M: Model<T>, S: SpdSolver<T>>(
    model: &M,
    equations: &mut Equations<T, S>,
    (a, force): (&[T], T),
    (s, lambda): (&[T], &[T]),
) {
    equations.mu.copy_from_slice(lambda);
    equations.assemble(model, Some(a), force);
    equations.add_to_residual(model, |eq| {
        set_product(model.team(), &mut eq.mu, (s, &eq.terms.phi));
        eq.with_factored_rows(|eq| eq.assemble(model, None, T::ZERO));
    });
}

//! When the factor of an earlier correction serves again, and the residual for it.
//!
//! ```text
//! T' d = -(M a + J^T lambda - Q) / a' - J'^T s phi,     T' = M + J'^T s J' + ...
//! ```
//!
//! With a symmetric tangent corrections of a vehicle shrink to a tenth or less each, with a new factor or with the first. A tire's
//! side force turns with its wheel, and nothing of that is symmetric. That a factor serves on takes two things. s phi goes by the rows
//! of the factor, which answer it with a correction across the motion alone. And multipliers grow by s (phi + J' d), which is what the
//! correction is in balance with, and not by s phi after it [P3 (2)]. That has the square of the correction in it. The next
//! correction would have to take it back while s phi asks for it once more, and once the rows have turned it acts along the motion.

use crate::equations::Equations;
use mbs_core::implicit::Newton;
use mbs_core::integrator::Rule;
use mbs_core::model::Model;
use mbs_core::team::set_product;
use mbs_core::{Real, SpdSolver};

/// Contraction of corrections up to which a factor is kept, where the iteration ends below the truncation error [-]: a new factor costs two
/// iterations, which contract to 0.04 by then.
const MAX_CONTRACTION: f64 = 0.2;
/// Contraction of corrections up to which a factor is kept where the tolerance alone ends the iteration [-]. A new factor takes in nearly all
/// of what constraints alone leave.
const MAX_CONTRACTION_TO_TOLERANCE: f64 = 1e-3;
/// Change of a law's tangent up to which its factor serves [-]: a tenth of it then shrinks corrections to a tenth.
const MAX_TANGENT_CHANGE: f64 = 0.1;
/// Tangents below this times the largest are not looked at [-]: what they change is a thousandth of a correction.
const NEGLIGIBLE_TANGENT: f64 = 1e-3;

/// When the factor of a step is made anew.
#[derive(Debug)]
pub(crate) struct FactorReuse<T> {
    /// Do multipliers grow by what a correction is in balance with, and not as published?
    is_balanced: bool,
    /// Contraction of corrections up to which a factor is kept [-].
    max_contraction: T,
    /// Sum of the corrections since the matrix was factored [m].
    pub(crate) since: T,
}

impl<T: Real> FactorReuse<T> {
    /// Before the first correction.
    pub(crate) fn new(is_balanced: bool, ends_at_tolerance: bool) -> Self {
        let most = if ends_at_tolerance { MAX_CONTRACTION_TO_TOLERANCE } else { MAX_CONTRACTION };
        Self { is_balanced, max_contraction: T::from_f64(most), since: T::ZERO }
    }

    /// May the next correction be made with the factor there is? It is one of the matrix as it was while laws are like those that were
    /// factored. Rows that have turned since cost little, for its residual takes s phi by the rows that it was made with.
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

/// Are the laws' tangents nearly those of the factored matrix? A wheel that has left its road, or a stop that was met, is another law.
/// Stiffness and damping are looked at, of lengths and angles by the same measure; not what a tension adds across its line.
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

/// f = M a + J^T lambda - force Q + J'^T s phi: the residual of a step for a factor that is kept. Cost: two residuals.
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

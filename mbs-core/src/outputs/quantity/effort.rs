//! Effort of a coupling.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::CouplingId;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "effort",
    TargetKind::Coupling,
    ComponentForm::Force,
    QuantityDefinition {
        formula: "λ times the factor of its kind",
        axes: "none: a number",
        sign: "gear, differential: torque on the first wheel along its coordinate; \
            belt: positive where it turns the first wheel along its coordinate; \
            rack, screw: along the slide; rope: positive where it pulls",
        contents: "λ c_k f_k' is what acts on each term, from the balance of all bodies. \
            Gear, differential: the torque on the first wheel. Belt: the \
            difference of its strands. Rack, screw: the force along the slide. \
            Rope: its tension. Others: λ. What drives teeth apart is not in it.",
    },
)
.of_reactions()
.or("force");

/// Index of the coupling, and the factor from its multiplier to its effort.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Effort<T: Real, const D: usize>(usize, T);

impl<T: Real, const D: usize> Measured<T, D> for Effort<T, D> {
    type Of = CouplingId;

    fn new(of: CouplingId, from: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), from.scene.couplings[of.index()].effort_factor())
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.reactions.map_or(T::ZERO, |all| all.effort(self.0) * self.1);
    }
}

//! Power of a coupling. A driven coupling supplies it. A gear, belt, rack or screw transmits it to its first part.

use super::super::coupled_sum::CoupledSum;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::inputs::CouplingInput;
use crate::scene::CouplingId;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "power",
    TargetKind::Coupling,
    ComponentForm::Number("W"),
    QuantityDefinition {
        formula: "effort · rate",
        axes: "none: a number",
        sign: "positive: given by a driven coupling; passed to the part that the \
            effort is named for",
        contents: "Driven: λ times the rate of the sum. Gear, differential, belt, rack \
            and screw: the effort times the rate of the first wheel, of its rim, \
            or of the slide. Zero of others.",
    },
)
.of_reactions();

/// Index of the coupling, and the sum whose rate times the effort is the power. It is the sum of a driven coupling, or the term on which
/// the effort does work.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct CouplingPower<T: Real, const D: usize>(
    usize,
    Option<CoupledSum<T, D>>,
);

impl<T: Real, const D: usize> Measured<T, D> for CouplingPower<T, D> {
    type Of = CouplingId;

    fn new(of: CouplingId, from: &mut Maker<'_, T, D>) -> Self {
        let index = of.index();
        let coupling = &from.scene.couplings[index];
        let sum = match coupling.named_term() {
            Some(named) => {
                let input = CouplingInput::new(coupling);
                let term = input.terms.get(named..=named).unwrap_or_default();
                Some(CoupledSum::of_terms((from.scene, from.model), term, None))
            }
            None if coupling.is_driven() => Some(CoupledSum::new(from.scene, from.model, index)),
            None => None,
        };
        Self(index, sum)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let rate = self.1.as_ref().map_or(T::ZERO, |sum| sum.measure(now.state)[1]);
        out[0] = now.reactions.map_or(T::ZERO, |all| all.effort(self.0)) * rate;
    }
}

//! A one-sided stop between two points: f = -contact(touch - m, -m'), see [`contact`](crate::laws::bumper).

use crate::Real;
use crate::laws::LawInputs;
use crate::laws::bumper;
use crate::laws::entry::entry;
use crate::laws::operations::Operations;
use crate::laws::scalar::{ScalarForce, TensionLaw};

/// Law of a bumper, which pushes when the value is below `touch`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BumperLaw<T> {
    /// Stiffness [N/m] and damping [N s/m].
    pub law: [T; 2],
    /// Value at which contact begins [m].
    pub touch: T,
}

entry!(BumperLaw<T> { law, touch });

impl<T: Real> TensionLaw<T> for BumperLaw<T> {
    #[inline]
    fn evaluate(&self, value: T, rate: T, _: &LawInputs<'_, T>) -> ScalarForce<T> {
        let contact = bumper::contact(self.law, self.touch - value, -rate);
        ScalarForce {
            value,
            rate,
            tension: -contact.force,
            stiffness: contact.stiffness,
            damping: contact.damping,
            ..ScalarForce::default()
        }
    }

    fn operations(&self) -> Operations {
        bumper::OPERATIONS + Operations::new(0, 1)
    }

    #[inline]
    fn energy(&self, value: T, _: &LawInputs<'_, T>) -> T {
        bumper::energy(self.law[0], self.touch - value)
    }

    #[inline]
    fn elastic(&self, value: T, _: &LawInputs<'_, T>) -> T {
        -self.law[0] * (self.touch - value).max(T::ZERO)
    }

    fn may_push(&self) -> bool {
        true
    }

    fn n_gaps(&self) -> usize {
        1
    }

    fn has_fade(&self) -> bool {
        self.law[1] > T::ZERO
    }

    fn gaps(&self, value: T, rate: T) -> [[T; 2]; 2] {
        [[value - self.touch, rate], [T::ZERO; 2]]
    }
}

#[cfg(feature = "alloc")]
pub use data::Bumper;

#[cfg(feature = "alloc")]
mod data {
    use super::BumperLaw;
    use crate::algebra::{self, norm};
    use crate::effects::data::*;

    effect! {
        /// Pushes two points apart once they have come closer than their reference distance less the clearance.
        pub struct Bumper<T> = ["bumper"] {
            /// First and second body.
            bodies: [BodyId; 2] = Bodies, "", Needed;
            /// One point per body, reference configuration.
            points: [[T; 3]; 2] = Points(true), "m", Needed;
            /// Stiffness.
            stiffness: T = Number(NotNegative), "N/m", Needed;
            /// Damping while in contact.
            damping: T = Number(NotNegative), "N s/m", ZERO;
            /// Approach from the reference configuration before contact.
            clearance: T = Number(Any), "m", Needed;
        }
    }

    impl<T: Real> EffectModel<T> for Bumper<T> {
        const LAW: &'static str = "pushes with k x + c ẋ s(x), never pulls, x = L_ref - clearance - L; the damper fades in over 1 mm";
        const ABSENT: Option<[&'static str; 2]> = Some(["bumpers", "no bumpers"]);
        const IS_ONE_SIDED: bool = true;

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let law = [self.stiffness, self.damping];
            let [p, q] = self.points.map(algebra::Vector::<T, 3>::from);
            let touch = norm(&(q - p)) - self.clearance;
            to.length(self.bodies, self.points, BumperLaw { law, touch });
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Line(LineLook::Bumper)
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn stores_energy(&self) -> bool {
            !self.stiffness.is_zero()
        }
        fn dissipates(&self) -> bool {
            !self.damping.is_zero()
        }
    }
}

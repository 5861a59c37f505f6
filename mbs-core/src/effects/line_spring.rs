//! Spring and damper along a line over points: an elastic rope. One that pulls only is slack below its free length.
//!
//! ```text
//! f = k (L - L0) + c L',            pulls only: f = F(L - L0, L') of a bumper, 0 where L < L0
//! ```

use crate::Real;
use crate::laws::entry::entry;
use crate::laws::operations::Operations;
use crate::laws::scalar::{ScalarForce, TensionLaw};
use crate::laws::{LawInputs, bumper};

/// Law of a spring that pulls when the value is above `free`, and never pushes: see [`contact`](crate::laws::bumper).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PullLaw<T> {
    /// Stiffness [N/m, N m/rad].
    pub stiffness: T,
    /// Damping [N s/m, N m s/rad].
    pub damping: T,
    /// Value above which the spring pulls [m, rad].
    pub free: T,
}

entry!(PullLaw<T> { stiffness, damping, free });

impl<T: Real> TensionLaw<T> for PullLaw<T> {
    #[inline(never)]
    fn evaluate(&self, value: T, rate: T, _: &LawInputs<'_, T>) -> ScalarForce<T> {
        let pull = bumper::contact([self.stiffness, self.damping], value - self.free, rate);
        ScalarForce {
            value,
            rate,
            tension: pull.force,
            stiffness: pull.stiffness,
            damping: pull.damping,
            ..ScalarForce::default()
        }
    }

    fn operations(&self) -> Operations {
        bumper::OPERATIONS + Operations::new(0, 1)
    }

    #[inline]
    fn energy(&self, value: T, _: &LawInputs<'_, T>) -> T {
        bumper::energy(self.stiffness, value - self.free)
    }

    #[inline]
    fn elastic(&self, value: T, _: &LawInputs<'_, T>) -> T {
        self.stiffness * (value - self.free).max(T::ZERO)
    }

    fn n_gaps(&self) -> usize {
        1
    }

    fn has_fade(&self) -> bool {
        self.damping > T::ZERO
    }

    fn gaps(&self, value: T, rate: T) -> [[T; 2]; 2] {
        [[self.free - value, -rate], [T::ZERO; 2]]
    }
}

#[cfg(feature = "alloc")]
pub use data::LineSpring;
#[cfg(feature = "alloc")]
pub(super) use data::law_of;

#[cfg(feature = "alloc")]
mod data {
    use super::PullLaw;
    use crate::algebra::{self, norm};
    use crate::effects::Law;
    use crate::effects::data::*;
    use crate::effects::spring_damper::SpringDamperLaw;

    effect! {
        /// Spring and damper along a line over points of bodies, with one tension: an elastic rope without friction.
        pub struct LineSpring<T> = ["spring-damper"] {
            /// Two points or more, reference configuration.
            points: Vec<(BodyId, [T; 3])> = Line, "m", Needed;
            /// Stiffness.
            stiffness: T = Number(NotNegative), "N/m", ZERO;
            /// Damping.
            damping: T = Number(NotNegative), "N s/m", ZERO;
            /// Length without tension; `None`: that in the reference configuration.
            free_length: Option<T> = Length, "m", Nothing;
            /// Whether it is slack below that length, and pushes nowhere.
            pulls_only: bool = Flag, "", Nothing;
        }
    }

    /// Law with this stiffness, damping and free value. With `pulls_only` it is slack below the free value. `None` if its Cargo
    /// feature is off.
    pub(in crate::effects) fn law_of<T: Real>(
        [stiffness, damping, free]: [T; 3],
        pulls_only: bool,
    ) -> Option<Law<T>> {
        if pulls_only {
            PullLaw { stiffness, damping, free }.into()
        } else {
            SpringDamperLaw { stiffness, damping, free }.into()
        }
    }

    impl<T: Real> LineSpring<T> {
        /// Length without tension [m].
        fn free(&self) -> T {
            let part = |pair: &[(BodyId, [T; 3])]| {
                let [p, q] = [pair[0].1, pair[1].1].map(algebra::Vector::<T, 3>::from);
                norm(&(q - p))
            };
            let whole = || self.points.windows(2).map(part).fold(T::ZERO, |sum, part| sum + part);
            self.free_length.unwrap_or_else(whole)
        }
    }

    impl<T: Real> EffectModel<T> for LineSpring<T> {
        const LAW: &'static str = "tension k (L - L0) + c L̇; with `pulls_only` zero below L0, never negative, and the damper fades in over 1 mm";

        const HAS_BRANCHES: bool = false;

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let law = law_of([self.stiffness, self.damping, self.free()], self.pulls_only);
            to.on_line(&self.points, law);
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Line(LineLook::of([!self.stiffness.is_zero(), !self.damping.is_zero()]))
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

//! Spring and damper between two points.
//!
//! ```text
//! f = k (m - m0) + c m',   V = k (m - m0)^2 / 2,   dissipated power c m'^2
//! ```

use crate::Real;
use crate::laws::LawInputs;
use crate::laws::entry::entry;
use crate::laws::operations::Operations;
use crate::laws::scalar::{ScalarForce, TensionLaw};

/// Law of a spring and damper: stiffness (m - free) + damping m'.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringDamperLaw<T> {
    /// Stiffness [N/m, N m/rad].
    pub stiffness: T,
    /// Damping [N s/m, N m s/rad].
    pub damping: T,
    /// Value without tension [m, rad].
    pub free: T,
}

entry!(SpringDamperLaw<T> { stiffness, damping, free });

impl<T: Real> TensionLaw<T> for SpringDamperLaw<T> {
    #[inline]
    fn evaluate(&self, value: T, rate: T, _: &LawInputs<'_, T>) -> ScalarForce<T> {
        ScalarForce {
            value,
            rate,
            tension: self.stiffness * (value - self.free) + self.damping * rate,
            stiffness: self.stiffness,
            damping: self.damping,
            ..ScalarForce::default()
        }
    }

    fn operations(&self) -> Operations {
        Operations::new(2, 2)
    }

    #[inline]
    fn energy(&self, value: T, _: &LawInputs<'_, T>) -> T {
        let stretch = value - self.free;
        self.stiffness * stretch * stretch * T::HALF
    }

    #[inline]
    fn power(&self, measure: &ScalarForce<T>, _: &LawInputs<'_, T>) -> T {
        -self.damping * measure.rate * measure.rate
    }
}

#[cfg(feature = "alloc")]
pub use data::SpringDamper;

#[cfg(feature = "alloc")]
mod data {
    use super::SpringDamperLaw;
    use crate::effects::data::*;

    effect! {
        /// tension = stiffness (length - free_length) + damping d(length)/dt between two body points.
        pub struct SpringDamper<T> = ["spring-damper"] {
            /// First and second body.
            bodies: [BodyId; 2] = Bodies, "", Needed;
            /// One point per body, reference configuration.
            points: [[T; 3]; 2] = Points(true), "m", Needed;
            /// Stiffness.
            stiffness: T = Number(Any), "N/m", ZERO;
            /// Damping.
            damping: T = Number(Any), "N s/m", ZERO;
            /// Length without tension.
            free_length: T = Number(Any), "m", NeededWith("stiffness");
        }
    }

    impl<T: Real> EffectModel<T> for SpringDamper<T> {
        const LAW: &'static str = "tension k (L - L0) + c L̇; any length above zero";
        const HAS_BRANCHES: bool = false;

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let (stiffness, damping, free) = (self.stiffness, self.damping, self.free_length);
            to.length(self.bodies, self.points, SpringDamperLaw { stiffness, damping, free });
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Line(LineLook::of([!self.stiffness.is_zero(), !self.damping.is_zero()]))
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            let [p, q] = self.points;
            let gap = [0, 1, 2].map(|i| q[i] - p[i]);
            let in_place = gap.iter().fold(T::ZERO, |sum, x| sum + *x * *x).sqrt();
            let (key, value) = ("free_length", self.free_length);
            let length = UnitHint::FreeLength { key, value, in_place };
            let (key, value, bodies) = ("stiffness", self.stiffness, self.bodies);
            [length, UnitHint::Stiffness { key, value, bodies }].into()
        }
        fn stores_energy(&self) -> bool {
            !self.stiffness.is_zero()
        }
        fn dissipates(&self) -> bool {
            !self.damping.is_zero()
        }
    }
}

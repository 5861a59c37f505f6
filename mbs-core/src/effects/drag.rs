//! Drag of still air on a point.
//!
//! ```text
//! F = -1/2 rho C_d A |v| v
//! ```
//!
//! Range: turbulent flow around blunt bodies, where C_d is constant. All power is dissipated.

use crate::Real;
use crate::algebra::{Vector, norm};
use crate::laws::LawInputs;
use crate::laws::body::{BodyMotion, UnitWrench, WrenchesLaw, put};
use crate::laws::entry::entry;
use crate::laws::operations::Operations;
use crate::laws::scalar::ScalarForce;

/// Law of the drag of still air.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DragLaw<T> {
    /// Drag coefficient times area, C_d A [m^2].
    pub area_coefficient: T,
    /// Density of the air [kg/m^3].
    pub density: T,
}

entry!(DragLaw<T> { area_coefficient, density });

/// Magnitude of the drag [N] at a speed [m/s], and its derivative by the speed [N s/m]; `area_coefficient` is C_d A [m^2].
#[inline]
pub fn drag<T: Real>(area_coefficient: T, density: T, speed: T) -> (T, T) {
    let k = area_coefficient * density * T::HALF;
    (k * speed * speed, T::TWO * k * speed)
}

impl<T: Real> WrenchesLaw<T> for DragLaw<T> {
    /// Without speed there is no drag and no direction.
    fn evaluate(&self, motion: &BodyMotion<T>, _: &LawInputs<'_, T>, out: &mut [UnitWrench<T>]) {
        let velocity = Vector::<T, 3>::from(motion.velocity);
        let speed = norm(&velocity);
        let direction =
            if speed > T::ZERO { velocity * (T::ONE / speed) } else { Vector::<T, 3>::zeros() };
        let (tension, damping) = drag(self.area_coefficient, self.density, speed);
        let measure = ScalarForce { rate: speed, tension, damping, ..ScalarForce::default() };
        put(out, 0, UnitWrench { force: direction.into(), moment: [T::ZERO; 3], measure });
    }

    fn operations(&self, _: &LawInputs<'_, T>) -> Operations {
        Operations::new(12, 2).and(1, 1, 0)
    }

    fn needs_rotation(&self) -> bool {
        false
    }
}

#[cfg(feature = "alloc")]
pub use data::AeroDrag;

#[cfg(feature = "alloc")]
mod data {
    use super::DragLaw;
    use crate::algebra::unit;
    use crate::effects::data::*;

    effect! {
        /// Drag of still air, against the velocity of a point.
        pub struct AeroDrag<T> = ["aero-drag"] {
            /// The body.
            body: BodyId = Body, "", Needed;
            /// Point, reference configuration.
            at: [T; 3] = Point, "m", Needed;
            /// Drag coefficient times area.
            area_coefficient: T = Number(NotNegative), "m²", Needed;
            /// Density of air.
            density: T = Number(NotNegative), "kg/m³", Number("1.2");
        }
    }

    impl<T: Real> EffectModel<T> for AeroDrag<T> {
        const LAW: &'static str =
            "-½ ρ C_d A \\|v\\| v in still air; blunt bodies in turbulent flow";
        const ABSENT: Option<[&'static str; 2]> = Some(["air", "no drag of air"]);

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let &Self { body, at, area_coefficient, density } = self;
            to.on_body((body, at), unit(0).into(), DragLaw { area_coefficient, density });
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Nothing
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn dissipates(&self) -> bool {
            true
        }
        /// Drag grows with the square of the speed, so that small motions have none: returns false.
        fn rest(&mut self, _: &mut dyn FnMut(&'static str)) -> bool {
            false
        }
    }
}

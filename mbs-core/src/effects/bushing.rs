//! Springs and dampers along and about three axes at a place.

/// True if the build contains the rotations in space on which bushings act.
pub const IS_BUILT: bool = cfg!(feature = "bushing");

#[cfg(feature = "alloc")]
pub use data::Bushing;

#[cfg(feature = "alloc")]
mod data {
    use crate::algebra::unit;
    use crate::effects::data::*;
    use crate::effects::spring_damper::SpringDamperLaw;

    effect! {
        /// Six springs and dampers between two bodies at a place, in body axes of the first.
        pub struct Bushing<T> = ["bushing"] {
            /// First and second body.
            bodies: [BodyId; 2] = Bodies, "", Needed;
            /// Place, reference configuration.
            at: [T; 3] = Point, "m", Needed;
            /// Stiffness along x, y, z and about x, y, z; in the plane x, y and the third rotation.
            stiffness: [T; 6] = Six, "N/m and N m/rad", Needed;
            /// Damping, likewise.
            damping: [T; 6] = Six, "N s/m and N m s/rad", ZERO;
        }
    }

    impl<T: Real> EffectModel<T> for Bushing<T> {
        const LAW: &'static str = "springs and dampers along and about x, y, z of the first body; six numbers, in the plane `[x, y, theta]`; turns: the angle in the plane, over any number of them, and the rotation vector in space, below a turn";

        fn actions(&self, to: &mut Compiler<'_, T>) {
            let (bodies, k, c) = (self.bodies, &self.stiffness, &self.damping);
            let acts = |i: usize| !(k[i].is_zero() && c[i].is_zero());
            let law = |i| SpringDamperLaw { stiffness: k[i], damping: c[i], free: T::ZERO };
            for i in (0..to.among.dimension.count()).filter(|&i| acts(i)) {
                to.along(bodies, [self.at; 2], unit(i).into(), law(i));
            }
            if to.is_planar() {
                if acts(5) {
                    to.act(law(5), |law| Action::Turn { bodies, law });
                }
            } else if (3..6).any(acts) {
                // Add all three rotations, because the state remembers them together.
                for number in 0..3_u32 {
                    let law = law(3 + number as usize);
                    to.act(law, |law| Action::Rotation { bodies, number, law });
                }
            }
        }
        fn drawn_as(&self) -> EffectPicture<T> {
            EffectPicture::Ring(self.bodies[0], self.at)
        }
        fn unit_hints(&self, _: &[Joint<T>]) -> Vec<UnitHint<T>> {
            Vec::new()
        }
        fn stores_energy(&self) -> bool {
            self.stiffness.iter().any(|k| !k.is_zero())
        }
        fn dissipates(&self) -> bool {
            self.damping.iter().any(|c| !c.is_zero())
        }
    }
}

//! Readings of a simulation between steps, and of a run at an instant: written once for both.

/// Readings of a type that has `seen`, which is read, and `stopped`, which makes an error of a reason to stop.
#[doc(hidden)]
#[macro_export]
macro_rules! readings {
    ($what:ty) => {
        impl $what {
            /// Present time of the mechanism [s]. It is a count times the step plus a rest, so that 1000 steps of 1e-3 end at 1.0.
            #[must_use]
            pub fn time(&self) -> f64 {
                self.seen().time()
            }

            /// First coordinate of a joint, from the reference configuration, turns counted [rad, m].
            ///
            /// # Panics
            /// If the joint has no coordinates, as a weld.
            #[must_use]
            pub fn value(&self, joint: $crate::core::scene::JointId) -> f64 {
                self.values(joint)[0]
            }

            /// All coordinates of a joint [rad, m].
            #[must_use]
            pub fn values(
                &self,
                joint: $crate::core::scene::JointId,
            ) -> $crate::erased::values::Coordinates {
                self.seen().values(joint.index())
            }

            /// Rate of the first coordinate of a joint [rad/s, m/s].
            ///
            /// # Panics
            /// If the joint has no coordinates.
            #[must_use]
            pub fn rate(&self, joint: $crate::core::scene::JointId) -> f64 {
                self.rates(joint)[0]
            }

            /// All rates of a joint; of a ball the relative angular velocity in global axes [rad/s, m/s].
            #[must_use]
            pub fn rates(
                &self,
                joint: $crate::core::scene::JointId,
            ) -> $crate::erased::values::Coordinates {
                self.seen().rates(joint.index())
            }

            /// Centre of mass of a body, and its rotation from the reference configuration.
            #[must_use]
            pub fn pose(&self, body: $crate::core::scene::BodyId) -> $crate::erased::values::Pose {
                self.seen().body(body).0
            }

            /// Velocities and accelerations of a body.
            #[must_use]
            pub fn motion(
                &self,
                body: $crate::core::scene::BodyId,
            ) -> $crate::erased::values::BodyMotion {
                self.seen().body(body).1
            }

            /// The material point of a body that is at `at` in the reference configuration [m].
            #[must_use]
            pub fn point(
                &self,
                body: $crate::core::scene::BodyId,
                at: impl Into<$crate::core::scene::Vector3>,
            ) -> $crate::erased::values::PointMotion {
                let at = at.into().0.each_ref().map($crate::core::scene::Number::to_f64);
                self.seen().point(body, at)
            }

            /// Force and moment of a joint's first body on the second, at the joint's place on the second, effort of guides included
            /// [N, N m].
            ///
            /// Cost: at the first call, the balance of every body is prepared; at the first call after a step, it is solved for all joints.
            ///
            /// # Errors
            /// Where connected loops are too large for it.
            pub fn reaction(
                &self,
                joint: $crate::core::scene::JointId,
            ) -> Result<$crate::erased::values::Wrench, $crate::erased::SimulationError> {
                self.seen().reaction(joint.index()).map_err(|error| self.stopped(error))
            }

            /// Force and moment of an effect on its body, or on the second of its two bodies [N, N m]. For an effect on a joint this is the joint's
            /// second body.
            ///
            /// The moment is about the point of that body where the effect is attached, as it has moved. An effect about an angle has a moment alone;
            /// one that is disabled exerts nothing. The first of two bodies takes the opposite force along the same line.
            ///
            /// Cost: at the first call, all effects are prepared; at each, the laws of this one are evaluated.
            ///
            /// # Errors
            /// None that a simulation that was built can make; those of the model.
            ///
            /// ```
            /// use mbs::{Body, Effect, GROUND, Joint, Mechanism, Method};
            /// let mut m = Mechanism::planar("mass on a spring");
            /// let mass = m.add(Body::planar([0.0, -1.5], 2.0, 0.1));
            /// m.add(Joint::prismatic([GROUND, mass], [0.0, -1.5]).along([0.0, 1.0]));
            /// let spring = m.add(Effect::spring_damper([(GROUND, [0.0, 0.0]), (mass, [0.0, -1.5])], 40.0, 0.0, 1.0));
            /// let sim = m.simulate(&Method::default())?;
            /// // half a metre too long, it pulls the mass upward
            /// assert_eq!(sim.effect_force(spring)?.force, [0.0, 20.0, 0.0]);
            /// # Ok::<(), mbs::SimulationError>(())
            /// ```
            pub fn effect_force(
                &self,
                effect: $crate::core::scene::EffectId,
            ) -> Result<$crate::erased::values::Wrench, $crate::erased::SimulationError> {
                self.seen().effect_force(effect.index()).map_err(|error| self.stopped(error))
            }

            /// Components of an output of the mechanism.
            ///
            /// # Errors
            /// Where one is not finite.
            pub fn output(
                &self,
                output: $crate::core::scene::OutputId,
            ) -> Result<$crate::erased::values::Components, $crate::erased::SimulationError> {
                self.seen().output(output.index()).map_err(|error| self.stopped(error))
            }

            /// Writes all outputs in their order: as many numbers as [`n_outputs`](Self::n_outputs), or the first ones.
            ///
            /// # Errors
            /// Where one is not finite.
            pub fn write_outputs(
                &self,
                out: &mut [f64],
            ) -> Result<(), $crate::erased::SimulationError> {
                self.seen().write_outputs(out).map_err(|error| self.stopped(error))
            }

            /// Number of components of all outputs; of all joint coordinates where the mechanism names no output.
            #[must_use]
            pub fn n_outputs(&self) -> usize {
                self.seen().n_outputs()
            }

            /// Kinetic and potential energy, and work of dampers, guides and inputs since the start [J].
            #[must_use]
            pub fn energies(&self) -> $crate::erased::values::Energies {
                self.seen().energies()
            }

            /// Sizes of the model that steps.
            #[must_use]
            pub fn sizes(&self) -> $crate::erased::values::Sizes {
                self.seen().sizes()
            }
        }
    };
}

readings!(super::view::View<'_>);

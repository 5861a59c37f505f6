//! Methods that read quantities of a simulation between steps, and of a run at an instant. One macro defines them for both types.

/// Defines the methods that read quantities. The type must have the methods `seen`, which returns the object to read, and `stopped`, which
/// converts a stop reason to an error.
#[doc(hidden)]
#[macro_export]
macro_rules! readings {
    ($what:ty) => {
        impl $what {
            /// Current time of the mechanism [s]. It is a multiple of the step plus a rest, so that 1000 steps of 1e-3 end exactly at 1.0.
            #[must_use]
            pub fn time(&self) -> f64 {
                self.seen().time()
            }

            /// First coordinate of a joint, relative to the reference configuration, with full turns counted [rad, m].
            ///
            /// # Panics
            /// If the joint has no coordinates, such as a weld.
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

            /// All rates of a joint [rad/s, m/s]. For a ball joint they are the relative angular velocity in global axes.
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

            /// Motion of the material point of a body whose position in the reference configuration is `at` [m].
            #[must_use]
            pub fn point(
                &self,
                body: $crate::core::scene::BodyId,
                at: impl Into<$crate::core::scene::Vector3>,
            ) -> $crate::erased::values::PointMotion {
                let at = at.into().0.each_ref().map($crate::core::scene::Number::to_f64);
                self.seen().point(body, at)
            }

            /// Force and moment that a joint's first body exerts on the second body, at the joint's point on the second body [N, N m]. The
            /// effort of guides is included.
            ///
            /// Cost: the first call prepares the balance of every body. The first call after a step solves it for all joints.
            ///
            /// # Errors
            /// If connected closed loops are too large for the computation.
            pub fn reaction(
                &self,
                joint: $crate::core::scene::JointId,
            ) -> Result<$crate::erased::values::Wrench, $crate::erased::SimulationError> {
                self.seen().reaction(joint.index()).map_err(|error| self.stopped(error))
            }

            /// Force and moment that an effect exerts on its body [N, N m]. If the effect acts between two bodies, it is the load on the
            /// second body. For an effect on a joint, it is the load on the joint's second body.
            ///
            /// The moment is about the current position of the effect's attachment point on that body. An effect on an angle has a moment
            /// only. A disabled effect has no force. The first of the two bodies receives the opposite force along the same line.
            ///
            /// Cost: the first call prepares all effects; each call evaluates the laws of this effect.
            ///
            /// # Errors
            /// Errors of the model, which do not occur in a simulation that was created.
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
            /// If a component is not finite.
            pub fn output(
                &self,
                output: $crate::core::scene::OutputId,
            ) -> Result<$crate::erased::values::Components, $crate::erased::SimulationError> {
                self.seen().output(output.index()).map_err(|error| self.stopped(error))
            }

            /// Writes all outputs in their order. `out` has up to [`n_outputs`](Self::n_outputs) values; a shorter slice receives the first
            /// values.
            ///
            /// # Errors
            /// If a component is not finite.
            pub fn write_outputs(
                &self,
                out: &mut [f64],
            ) -> Result<(), $crate::erased::SimulationError> {
                self.seen().write_outputs(out).map_err(|error| self.stopped(error))
            }

            /// Number of components of all outputs. Without named outputs, the outputs are all joint coordinates.
            #[must_use]
            pub fn n_outputs(&self) -> usize {
                self.seen().n_outputs()
            }

            /// Kinetic and potential energy, and work of dampers, guides and inputs since the start [J].
            #[must_use]
            pub fn energies(&self) -> $crate::erased::values::Energies {
                self.seen().energies()
            }

            /// Sizes of the model that makes the steps.
            #[must_use]
            pub fn sizes(&self) -> $crate::erased::values::Sizes {
                self.seen().sizes()
            }
        }
    };
}

readings!(super::view::View<'_>);

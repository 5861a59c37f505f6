//! What is read of a simulation between steps, and of a run at an instant: the same, written once.

use super::failure::SimulationError;
use super::simulation::Simulation;
use super::values::{
    BodyMotion, Components, Coordinates, Energies, PointMotion, Pose, Sizes, Wrench,
};
use super::view::View;
use mbs_core::scene::{BodyId, EffectId, JointId, Number, OutputId, Vector3};

macro_rules! both {
    ($($readings:tt)*) => {
        impl Simulation { $($readings)* }
        impl View<'_> { $($readings)* }
    };
}

both! {
    /// Time [s]. It is a count times the step plus a rest, so that 1000 steps of 1e-3 end at 1.0.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.seen().time()
    }

    /// First coordinate of a joint, from the reference configuration, turns counted [rad, m].
    ///
    /// # Panics
    /// If the joint has no coordinates, as a weld.
    #[must_use]
    pub fn value(&self, joint: JointId) -> f64 {
        self.values(joint)[0]
    }

    /// All coordinates of a joint [rad, m].
    #[must_use]
    pub fn values(&self, joint: JointId) -> Coordinates {
        self.seen().values(joint.index())
    }

    /// Rate of the first coordinate of a joint [rad/s, m/s].
    ///
    /// # Panics
    /// If the joint has no coordinates.
    #[must_use]
    pub fn rate(&self, joint: JointId) -> f64 {
        self.rates(joint)[0]
    }

    /// All rates of a joint; of a ball the relative angular velocity in global axes [rad/s, m/s].
    #[must_use]
    pub fn rates(&self, joint: JointId) -> Coordinates {
        self.seen().rates(joint.index())
    }

    /// Centre of mass of a body, and its rotation from the reference configuration.
    #[must_use]
    pub fn pose(&self, body: BodyId) -> Pose {
        self.seen().body(body).0
    }

    /// Velocities and accelerations of a body.
    #[must_use]
    pub fn motion(&self, body: BodyId) -> BodyMotion {
        self.seen().body(body).1
    }

    /// The material point of a body that is at `at` in the reference configuration [m].
    #[must_use]
    pub fn point(&self, body: BodyId, at: impl Into<Vector3>) -> PointMotion {
        let at = at.into().0.each_ref().map(Number::to_f64);
        self.seen().point(body, at)
    }

    /// What the first body of a joint does to the second, at the joint's place on the second body, effort of guides included.
    ///
    /// Cost: at the first call, the balance of every body is prepared; at the first call after a step, it is solved for all joints.
    ///
    /// # Errors
    /// Where connected loops are too large for it.
    pub fn reaction(&self, joint: JointId) -> Result<Wrench, SimulationError> {
        self.seen().reaction(joint.index()).map_err(|error| self.stopped(error))
    }

    /// What an effect exerts on its body, or on the second of its two bodies: on a joint, on the joint's second body [N, N m].
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
    pub fn effect_force(&self, effect: EffectId) -> Result<Wrench, SimulationError> {
        self.seen().effect_force(effect.index()).map_err(|error| self.stopped(error))
    }

    /// Components of an output of the mechanism.
    ///
    /// # Errors
    /// Where one is not finite.
    pub fn output(&self, output: OutputId) -> Result<Components, SimulationError> {
        self.seen().output(output.index()).map_err(|error| self.stopped(error))
    }

    /// Writes all outputs in their order: as many numbers as [`n_outputs`](Self::n_outputs), or the first ones.
    ///
    /// # Errors
    /// Where one is not finite.
    pub fn write_outputs(&self, out: &mut [f64]) -> Result<(), SimulationError> {
        self.seen().write_outputs(out).map_err(|error| self.stopped(error))
    }

    /// Number of components of all outputs; of all joint coordinates where the mechanism names no output.
    #[must_use]
    pub fn n_outputs(&self) -> usize {
        self.seen().n_outputs()
    }

    /// Kinetic and potential energy, and work of dampers, guides and inputs since the start [J].
    #[must_use]
    pub fn energies(&self) -> Energies {
        self.seen().energies()
    }

    /// Sizes of the model that steps.
    #[must_use]
    pub fn sizes(&self) -> Sizes {
        self.seen().sizes()
    }
}

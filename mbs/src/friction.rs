//! Friction that the steps of an explicit method pass over.
//!
//! ```text
//! |r| <= |a| h   and   |a| h > 3 e        r, a rate and acceleration of the joint, h the step, e the regularisation
//! ```
//!
//! The acceleration would then carry the rate through rest within a step, and far beyond the rates at which friction rises. A rate that changes
//! its sign does so for a step or two; one that friction throws back does so step after step, and what holds by friction creeps at a
//! rate that is none of the law's. Implicit methods, and those that control their error, follow the rise.

use crate::choice::IntegratorKind;
use crate::settings::Settings;
use crate::simulation::Simulation;
use crate::stop::StopError;
use mbs_core::Real;
use mbs_core::algebra::{Vector, cross};
use mbs_core::natural::joint_axes;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{BodyId, Effect, EffectKind, JointKind, Scene};

/// Regularisations that a step may change the rate by: where friction holds, Runge and Kutta's method of order four is stable up to 2.8.
const FAR: f64 = 3.0;

/// Friction of a joint.
#[derive(Debug, Clone, Copy)]
struct Friction {
    effect: usize,
    joint: usize,
    regularisation: f64,
}

/// The frictions of a run by explicit steps of fixed length.
#[derive(Debug, Clone)]
pub(crate) struct Frictions {
    all: Vec<Friction>,
    /// Length of a step [s].
    step: f64,
}

impl Frictions {
    /// Those of a scene; none where the method of the settings follows them.
    pub(crate) fn new<T: Real>(scene: &Scene<T>, settings: &Settings) -> Self {
        let is_explicit = settings.integrator == IntegratorKind::Rk4;
        let friction = |(effect, e): (usize, &Effect<T>)| match &e.kind {
            EffectKind::Friction { joint, coulomb, r#static, regularisation, .. } if e.enabled => {
                let (joint, regularisation) = (*joint, regularisation.to_f64());
                // What is viscous alone rises nowhere.
                let has_rise = coulomb.max(*r#static) > T::ZERO;
                has_rise.then_some(Friction { effect, joint, regularisation })
            }
            _ => None,
        };
        let all = scene.effects.iter().enumerate().filter_map(friction);
        Self { all: if is_explicit { all.collect() } else { Vec::new() }, step: settings.step }
    }

    /// The first one that the last step has passed over.
    pub(crate) fn passed<T: Real, const D: usize>(
        &self,
        scene: &Scene<T>,
        simulation: &Simulation<T, D>,
    ) -> Option<StopError> {
        let is_passed = |friction: &&Friction| {
            let [rate, acceleration] = motion(scene, simulation, friction.joint);
            let change = acceleration.abs() * self.step;
            change > FAR * friction.regularisation && rate.abs() <= change
        };
        let &Friction { effect, regularisation, .. } = self.all.iter().find(is_passed)?;
        Some(StopError::Friction { effect, regularisation, step: self.step })
    }
}

/// Rate and acceleration of a joint's coordinate.
fn motion<T: Real, const D: usize>(
    scene: &Scene<T>,
    simulation: &Simulation<T, D>,
    joint: usize,
) -> [f64; 2] {
    let joint = &scene.joints[joint];
    let [first, second] = joint.bodies.map(|body| match body {
        BodyId::Ground => RigidMotion::at_rest(Vector::zeros()),
        BodyId::Body(b) => simulation.model().motion(scene, b, simulation.state()),
    });
    let [axis, _] = joint_axes(joint, scene.dimension).map(Vector::from);
    let axis = first.rotation * axis;
    if joint.kind != JointKind::Prismatic {
        let turn = second.angular_acceleration - first.angular_acceleration;
        return [second.omega - first.omega, turn].map(|x| axis.dot(&x).to_f64());
    }
    let [place, velocity, acceleration] = second.point(&Vector::from(joint.points[1]));
    let arm = place - first.position;
    let turning = first.velocity + cross(&first.omega, &arm);
    let swing = cross(&first.omega, &cross(&first.omega, &arm));
    let carried = first.acceleration + cross(&first.angular_acceleration, &arm) + swing;
    [velocity - turning, acceleration - carried].map(|x| axis.dot(&x).to_f64())
}

//! Friction that the steps of an explicit method pass over.
//!
//! ```text
//! |r| <= |a| h   and   |a| h > 3 e        r, a rate and acceleration of the joint, h the step, e the regularisation
//! ```
//!
//! The acceleration would then carry the rate through rest within a step, and far beyond the rates at which friction rises. A rate that changes
//! its sign does so for a step or two. One that friction throws back does so step after step, and what holds by friction creeps at a
//! rate that is none of the law's. Implicit methods, and those that control their error, follow the rise.

use crate::choice::IntegratorKind;
use crate::settings::ResolvedMethod;
use crate::simulation::Simulation;
use crate::stop::StopError;
use mbs_core::Real;
use mbs_core::natural::NaturalModel;
use mbs_core::outputs::CoordinateMotion;
use mbs_core::scene::{self, Effect, EffectKind, Scene};

/// Largest change of the rate in a step, in units of the regularisation [-]: where friction holds, the explicit method of order four is stable
/// up to 2.8.
const MAX_CHANGE: f64 = 3.0;

/// Friction of a joint.
#[derive(Debug, Clone)]
struct Friction<T: Real, const D: usize> {
    effect: usize,
    motion: CoordinateMotion<T, D>,
    regularisation: f64,
}

/// The frictions of a run by explicit steps of fixed length.
#[derive(Debug, Clone)]
pub(crate) struct Frictions<T: Real, const D: usize> {
    all: Vec<Friction<T, D>>,
    /// Length of a step [s].
    step: f64,
}

impl<T: Real, const D: usize> Frictions<T, D> {
    /// Those of a scene; none where the method of the settings follows them.
    pub(crate) fn new(
        scene: &Scene<T>,
        settings: &ResolvedMethod,
        model: &NaturalModel<T, D>,
    ) -> Self {
        let is_explicit = settings.integrator == IntegratorKind::Rk4;
        let friction = |(effect, e): (usize, &Effect<T>)| match &e.kind {
            EffectKind::Friction(law) if e.enabled => {
                let &scene::Friction {
                    joint, coordinate, coulomb, r#static, regularisation, ..
                } = law;
                // What is viscous alone rises nowhere.
                let has_rise = coulomb.max(r#static) > T::ZERO;
                let motion =
                    CoordinateMotion::new(scene, model, (&scene.joints[joint], coordinate));
                let regularisation = regularisation.to_f64();
                let motion = motion.filter(|_| has_rise)?;
                Some(Friction { effect, motion, regularisation })
            }
            _ => None,
        };
        let all = scene.effects.iter().enumerate().filter_map(friction);
        Self { all: if is_explicit { all.collect() } else { Vec::new() }, step: settings.step }
    }

    /// The first one that the last step has passed over.
    pub(crate) fn passed(&self, simulation: &Simulation<T, D>) -> Option<StopError> {
        let is_passed = |friction: &&Friction<T, D>| {
            let [rate, acceleration] = friction.motion.at(simulation.state()).map(Real::to_f64);
            let change = acceleration.abs() * self.step;
            change > MAX_CHANGE * friction.regularisation && rate.abs() <= change
        };
        let Friction { effect, regularisation, .. } = self.all.iter().find(is_passed)?;
        let (effect, regularisation) = (*effect, *regularisation);
        Some(StopError::Friction { effect, regularisation, step: self.step })
    }
}

//! Friction whose smooth transition is too steep for the steps of an explicit method.
//!
//! ```text
//! |r| <= |a| h   and   |a| h > 3 e        r, a rate and acceleration of the joint or the sum, h the step, e the regularisation
//! ```
//!
//! If both conditions hold, the acceleration reverses the rate within one step. The new rate is then far larger than e, the rate at which
//! friction is fully developed. A rate that only changes its sign satisfies the conditions for one or two steps. If friction reverses the
//! rate again and again, the conditions hold in many successive steps. Parts that should stick then creep at a rate that does not follow
//! from the law. Implicit methods and methods with error control resolve the transition.

use crate::choice::IntegratorKind;
use crate::settings::ResolvedMethod;
use crate::simulation::Simulation;
use crate::stop::StopError;
use mbs_core::Real;
use mbs_core::effects::{ActsOn, Value};
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::outputs::CoordinateMotion;
use mbs_core::scene::{CouplingTerm, Effect, EffectKind, JointId, Scene};

/// Largest change of the rate in a step, in units of the regularisation [-]. In the transition of friction, the explicit method of order
/// four is stable up to 2.8.
const MAX_CHANGE: f64 = 3.0;

/// Friction in a joint, or on a sum of joint coordinates.
#[derive(Debug, Clone)]
struct Friction<T: Real, const D: usize> {
    effect: usize,
    /// Coordinates with their factors; the friction acts on their weighted sum.
    terms: Vec<(T, CoordinateMotion<T, D>)>,
    regularisation: f64,
}

/// Coordinates on which a friction law acts, with their factors, and the regularisation of the law. It is `None` for sums with lengths or
/// curves, which are not monitored.
type Watched<T, const D: usize> = Option<(Vec<(T, CoordinateMotion<T, D>)>, T)>;

fn watched<T: Real, const D: usize>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
    kind: &EffectKind<T>,
) -> Watched<T, D> {
    let regularisation = kind.sticking()?;
    let motion = |joint: JointId, number| {
        CoordinateMotion::new(scene, model, (&scene.joints[joint], number))
    };
    let term = |term: &CouplingTerm<T>| {
        let (joint, number) = term.of.coordinate().filter(|_| term.curve.is_none())?;
        Some((term.factor, motion(joint, Some(number))?))
    };
    let terms = match kind.acts_on() {
        ActsOn::Joint(joint) => motion(joint, kind.coordinate()).map(|of| vec![(T::ONE, of)]),
        ActsOn::Sum => kind.values().iter().find_map(|value| match value {
            Value::Terms(terms) => terms.iter().map(term).collect(),
            _ => None,
        }),
        ActsOn::Line | ActsOn::Bodies => None,
    };
    terms.map(|terms| (terms, regularisation))
}

impl<T: Real, const D: usize> Friction<T, D> {
    /// Rate and acceleration of the coordinate, or of the weighted sum, on which the friction acts.
    fn motion(&self, state: &State<T>) -> [T; 2] {
        self.terms.iter().fold([T::ZERO; 2], |[rate, acceleration], (factor, of)| {
            let [r, a] = of.at(state);
            [rate + *factor * r, acceleration + *factor * a]
        })
    }
}

/// Friction effects of a run with explicit steps of fixed length.
#[derive(Debug, Clone)]
pub struct Frictions<T: Real, const D: usize> {
    all: Vec<Friction<T, D>>,
    /// Length of a step [s].
    step: f64,
}

impl<T: Real, const D: usize> Frictions<T, D> {
    /// Finds the friction effects of a scene; the list is empty for methods that resolve the transition of friction.
    pub fn new(scene: &Scene<T>, settings: &ResolvedMethod, model: &NaturalModel<T, D>) -> Self {
        let is_explicit = settings.integrator == IntegratorKind::Rk4;
        let friction = |(effect, e): (usize, &Effect<T>)| {
            let (terms, regularisation) = watched(scene, model, &e.kind).filter(|_| e.enabled)?;
            Some(Friction { effect, terms, regularisation: regularisation.to_f64() })
        };
        let all = scene.effects.iter().enumerate().filter_map(friction);
        Self { all: if is_explicit { all.collect() } else { Vec::new() }, step: settings.step }
    }

    /// Returns the error for the first friction effect whose transition was skipped in the last step.
    pub fn passed(&self, simulation: &Simulation<T, D>) -> Option<StopError> {
        let is_passed = |friction: &&Friction<T, D>| {
            let [rate, acceleration] = friction.motion(simulation.state()).map(Real::to_f64);
            let change = acceleration.abs() * self.step;
            change > MAX_CHANGE * friction.regularisation && rate.abs() <= change
        };
        let Friction { effect, regularisation, .. } = self.all.iter().find(is_passed)?;
        let (effect, regularisation) = (*effect, *regularisation);
        Some(StopError::Friction { effect, regularisation, step: self.step })
    }
}

//! Joints whose coordinate leaves its range or whose rate exceeds its limit. The run reports them in its notes; the motion is not affected.

use crate::checkpoint::tape::{Tape, Walked};
use crate::simulation::Simulation;
use crate::stop::StopError;
use mbs_core::Real;
use mbs_core::natural::NaturalModel;
use mbs_core::outputs::{Measures, Quantity};
use mbs_core::scene::{JointId, JointLimits, Output, Scene};
use mbs_scene::format::{few, significant};

/// Smallest excess that is reported, relative to the width of the range or to the limit of the rate [-]. Numbers in files have six or more
/// digits.
const NOTED_EXCESS: f64 = 1e-6;

/// Number of limits of a joint: lower end, upper end and rate.
const N_LIMITS: usize = 3;

/// A joint with a range or with a limit of its rate.
#[derive(Debug, Clone)]
struct Watched {
    joint: usize,
    /// Lower end, upper end and largest rate; infinite if there is no limit.
    limits: [f64; N_LIMITS],
    /// Smallest excess that is reported, for each limit.
    noted: [f64; N_LIMITS],
    /// Time at which each limit was exceeded first [s].
    first: [Option<f64>; N_LIMITS],
    /// Largest excess of each limit.
    most: [f64; N_LIMITS],
}

/// Monitor of the joints of a run that have a range or a limit of their rate.
#[derive(Debug, Clone)]
pub struct LimitWatch<T: Real, const D: usize> {
    all: Vec<Watched>,
    /// Value and rate of each monitored joint; `None` if there is no such joint.
    measures: Option<Measures<T, D>>,
    values: Vec<T>,
}

impl Watched {
    fn new<T: Real>(joint: usize, limits: &JointLimits<T>) -> Option<Self> {
        if limits.range.is_none() && limits.velocity.is_none() {
            return None;
        }
        let ends = limits.range.map(|ends| ends.map(T::to_f64));
        let [lower, upper] = ends.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let rate = limits.velocity.map_or(f64::INFINITY, T::to_f64);
        let noted = [upper - lower, upper - lower, rate].map(|size| size * NOTED_EXCESS);
        let (first, most) = ([None; N_LIMITS], [0.0; N_LIMITS]);
        Some(Self { joint, limits: [lower, upper, rate], noted, first, most })
    }

    fn watch(&mut self, t: f64, [value, rate]: [f64; 2]) {
        let [lower, upper, largest] = self.limits;
        let excess = [lower - value, value - upper, rate.abs() - largest];
        for (i, &excess) in excess.iter().enumerate() {
            if excess > self.noted[i] {
                self.first[i].get_or_insert(t);
                self.most[i] = self.most[i].max(excess);
            }
        }
    }

    fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        self.first.iter_mut().try_for_each(|first| tape.option(first, Tape::float))?;
        tape.floats(&mut self.most)
    }

    /// Notes on the limits that the joint has exceeded.
    fn notes<T>(&self, scene: &Scene<T>) -> impl Iterator<Item = String> {
        let joint = &scene.joints[self.joint];
        let unit = joint.kind.single(scene.dimension).map_or("", |freedom| freedom.unit());
        let note = move |i: usize| {
            let (t, most) = (significant(self.first[i]?), few(self.most[i]));
            let (name, limit) = (&joint.name, significant(self.limits[i]));
            Some(match i {
                0 => format!(
                    "joint `{name}` leaves its range below {limit} {unit} at t = {t} s, by up to {most} {unit}"
                ),
                1 => format!(
                    "joint `{name}` leaves its range above {limit} {unit} at t = {t} s, by up to {most} {unit}"
                ),
                _ => format!(
                    "the rate of joint `{name}` passes its limit of {limit} {unit}/s at t = {t} s, by up to {most} {unit}/s"
                ),
            })
        };
        (0..N_LIMITS).filter_map(note)
    }
}

impl<T: Real, const D: usize> LimitWatch<T, D> {
    /// Prepares the joints of a scene; without such joints, nothing is evaluated.
    ///
    /// # Errors
    /// [`StopError`] where the scene has another dimension.
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Result<Self, StopError> {
        let joints = scene.joints.iter().enumerate();
        let all: Vec<_> = joints.filter_map(|(i, j)| Watched::new(i, &j.limits)).collect();
        if all.is_empty() {
            return Ok(Self { all, measures: None, values: Vec::new() });
        }
        let quantities = all.iter().flat_map(|watched| {
            let joint = JointId::new(watched.joint);
            [Quantity::JointValue { joint }, Quantity::JointRate { joint }]
        });
        let outputs: Vec<_> = quantities.map(Output::new).collect();
        let measures = Measures::of_outputs(&outputs, scene, model);
        let measures = measures.map_err(|e| StopError::Start(e.into()))?;
        let values = vec![T::ZERO; measures.n_components()];
        Ok(Self { all, measures: Some(measures), values })
    }

    /// Checks one state of the run: the state at the start, or the state at the end of a step.
    ///
    /// Cost: value and rate of each monitored joint; no allocation.
    pub fn watch(&mut self, simulation: &Simulation<T, D>) {
        let Self { all, measures: Some(measures), values } = self else { return };
        let state = simulation.state();
        if simulation.has_own_coordinates() {
            measures.track_with(state, |joint, number| simulation.coordinate(joint, number));
        }
        // An error here means an ambiguous number of turns; the outputs report it.
        let _ = measures.write(state, None, values);
        let t = state.t.to_f64();
        for (watched, now) in all.iter_mut().zip(values.chunks_exact(2)) {
            watched.watch(t, [now[0].to_f64(), now[1].to_f64()]);
        }
    }

    /// Writes the largest excesses to a checkpoint, or reads them from one. A scene without such joints writes nothing.
    pub fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        if let Some(measures) = &mut self.measures {
            tape.reals(measures.memory_mut())?;
        }
        self.all.iter_mut().try_for_each(|watched| watched.walk(tape))
    }

    /// Notes of a run: one note for each exceeded limit, with the time of the first excess and the largest excess.
    pub fn notes(&self, scene: &Scene<T>) -> Vec<String> {
        self.all.iter().flat_map(|watched| watched.notes(scene)).collect()
    }
}

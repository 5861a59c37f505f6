//! Instants at which one-sided effects make and break contact, interpolated within steps.
//!
//! Where a gap has changed its sign over a step, the instant is the root of the cubic through values and rates at both ends.
//! Steps of a fixed length are not cut there: the laws begin and end without a jump, and the instant is for the record. Its
//! error is that of the states at both ends over the speed, and the h^3 that the kink of the gap's third derivative leaves.
//! A contact shorter than a step, which no end of a step has seen and no force has answered, is not listed.

use super::cubic::Cubic;
use super::load::{Gap, Loads, MOST_GAPS};
use crate::Real;
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::{ModelError, NaturalModel};
use alloc::vec;
use alloc::vec::Vec;

/// Most instants kept of a run [-]: their memory, 32 kB, is taken at its start. Chosen, not tuned.
pub const MOST_INSTANTS: usize = 1000;

/// A contact that is made or broken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instant {
    /// Time of the instant [s].
    pub t: f64,
    /// Index of the effect in the scene.
    pub effect: usize,
    /// End of a limit: 0 the lower, 1 the upper; 0 for other effects.
    pub end: usize,
    /// Is the contact made, and not broken?
    pub makes: bool,
}

/// Watches the gaps of bumpers, limits and tires from step to step.
#[derive(Debug, Clone)]
pub struct Contacts<T: Real, const D: usize> {
    loads: Loads<T, D>,
    effects: Vec<usize>,
    /// The gaps at the end of the last step.
    last: Vec<[Gap<T>; MOST_GAPS]>,
    t: f64,
    instants: Vec<Instant>,
    left_out: u64,
}

impl<T: Real, const D: usize> Contacts<T, D> {
    /// Prepares the one-sided effects of a scene; without any, nothing is ever evaluated.
    ///
    /// # Errors
    /// [`ModelError`] as for the model.
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Result<Self, ModelError> {
        let (loads, effects) = Loads::one_sided(scene, model)?;
        let last = vec![[Gap::default(); MOST_GAPS]; effects.len()];
        let most = if effects.is_empty() { 0 } else { MOST_INSTANTS };
        Ok(Self { loads, effects, last, t: 0.0, instants: Vec::with_capacity(most), left_out: 0 })
    }

    /// Takes the gaps at the state from which a run starts.
    pub fn start(&mut self, state: &State<T>) {
        if self.effects.is_empty() {
            return;
        }
        let (list, law_inputs) = self.loads.at(state);
        for (load, last) in list.iter().zip(&mut self.last) {
            *last = load.reading(state, &law_inputs).gaps;
        }
        self.t = state.t.to_f64();
    }

    /// Takes the gaps at the end of a step, and lists what has changed since the last.
    ///
    /// Cost: one evaluation of each one-sided effect, and some fifty operations for each change; no allocation.
    pub fn watch(&mut self, state: &State<T>) {
        if self.effects.is_empty() {
            return;
        }
        let (from, to) = (self.t, state.t.to_f64());
        let first = self.instants.len();
        let (list, law_inputs) = self.loads.at(state);
        for ((load, &effect), last) in list.iter().zip(&self.effects).zip(&mut self.last) {
            let gaps = load.reading(state, &law_inputs).gaps;
            for (end, (a, b)) in last.iter().zip(&gaps).take(load.n_gaps()).enumerate() {
                let makes = b.value < T::ZERO;
                if makes == (a.value < T::ZERO) {
                    continue;
                }
                if self.instants.len() == MOST_INSTANTS {
                    self.left_out += 1;
                    continue;
                }
                let share = Cubic::new([*a, *b], to - from).root(0.0, [0.0, 1.0]);
                self.instants.push(Instant { t: from + share * (to - from), effect, end, makes });
            }
            *last = gaps;
        }
        // One step's changes come in the order of the effects.
        self.instants[first..].sort_unstable_by(|a, b| a.t.total_cmp(&b.t));
        self.t = to;
    }

    /// Restores a state at which these instants were known, and this number of more left out.
    pub fn resume(&mut self, state: &State<T>, instants: &[Instant], left_out: u64) {
        self.start(state);
        self.instants.clear();
        self.instants.extend(instants.iter().take(MOST_INSTANTS));
        self.left_out = left_out;
    }

    /// The instants so far, in order; at most [`MOST_INSTANTS`].
    #[must_use]
    pub fn instants(&self) -> &[Instant] {
        &self.instants
    }

    /// How many more there were.
    #[must_use]
    pub fn left_out(&self) -> u64 {
        self.left_out
    }
}

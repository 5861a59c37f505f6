//! Instants at which one-sided effects begin and end contact, interpolated within steps.
//!
//! If a gap changes its sign over a step, the instant is the root of the cubic through values and rates at both ends. Steps of fixed length
//! do not end at this instant, since contact forces begin and end without a jump. The instant is only recorded. The error of the instant
//! has two parts. One is the error of the states at both ends, divided by the speed. The other is of order h^3 for a step h, from the
//! discontinuity of the gap's third derivative. A contact that begins and ends within one step is not found. No force acted in it, since
//! forces are evaluated at the ends of steps.

use super::cubic::Cubic;
use super::load::{Gap, Loads, MOST_GAPS};
use crate::Real;
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::{ModelError, NaturalModel};
use alloc::vec;
use alloc::vec::Vec;

/// Largest number of instants that a run stores [-]. Their memory, 32 kB, is allocated at the start. Chosen, not tuned.
pub const MOST_INSTANTS: usize = 1000;

/// Beginning or end of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instant {
    /// Time of the instant [s].
    pub t: f64,
    /// Index of the effect in the scene.
    pub effect: usize,
    /// Index of the gap: for a limit 0 at the lower end, 1 at the upper end; 0 for other effects.
    pub end: usize,
    /// True if the contact begins; false if it ends.
    pub makes: bool,
}

/// Recorder of contacts: it compares the gaps of bumpers, limits and tires from step to step.
#[derive(Debug, Clone)]
pub struct Contacts<T: Real, const D: usize> {
    loads: Loads<T, D>,
    effects: Vec<usize>,
    /// Gaps of each effect at the end of the last step.
    last: Vec<[Gap<T>; MOST_GAPS]>,
    t: f64,
    instants: Vec<Instant>,
    left_out: u64,
}

impl<T: Real, const D: usize> Contacts<T, D> {
    /// Prepares the one-sided effects of a scene. Without one-sided effects, nothing is evaluated.
    ///
    /// # Errors
    /// [`ModelError`] as when the model is built.
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Result<Self, ModelError> {
        let (loads, effects) = Loads::one_sided(scene, model)?;
        let last = vec![[Gap::default(); MOST_GAPS]; effects.len()];
        let most = if effects.is_empty() { 0 } else { MOST_INSTANTS };
        Ok(Self { loads, effects, last, t: 0.0, instants: Vec::with_capacity(most), left_out: 0 })
    }

    /// Evaluates the gaps at the state from which a run starts.
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

    /// Evaluates the gaps at the end of a step, and records the contacts that began or ended in it.
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
        // The changes of a step are recorded by effect first, and then sorted by time.
        self.instants[first..].sort_unstable_by(|a, b| a.t.total_cmp(&b.t));
        self.t = to;
    }

    /// Resumes a record at `state`. `instants` are the instants recorded so far; `left_out` is the number of instants that were not stored.
    pub fn resume(&mut self, state: &State<T>, instants: &[Instant], left_out: u64) {
        self.start(state);
        self.instants.clear();
        self.instants.extend(instants.iter().take(MOST_INSTANTS));
        self.left_out = left_out;
    }

    /// Recorded instants in the order of time; at most [`MOST_INSTANTS`].
    #[must_use]
    pub fn instants(&self) -> &[Instant] {
        &self.instants
    }

    /// Number of instants that were not stored.
    #[must_use]
    pub fn left_out(&self) -> u64 {
        self.left_out
    }
}

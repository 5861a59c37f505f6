//! Events at which a law passes a kink within a trial step. A driver can repeat the step so that it ends at the event.
//!
//! ```text
//! gap      of bumpers, limits, tires: 0 where contact is made or broken
//! kink     of a road under a wheel in contact, and between the pieces of a polynomial spring
//! ```
//!
//! For each gap and kink, values and rates at both ends of the step give a cubic. Its first change of sign is an event, at a fraction of
//! the step. A trial that ends within a band around zero has reached the event. The value there has neither sign, so the next step leaves
//! the band to either side without a second event. A driver makes a trial and calls [`Events::first_event`]. Until a trial reaches the
//! event, the driver repeats the step from the same state with the reported fraction of its length. Then the driver calls
//! [`Events::accept`]. This is the secant method with a cubic instead of a line. Two or three trials are usual.
//!
//! A contact that begins with the step may be too stiff for its length. The trapezoidal rule then reverses the motion within the step, with
//! all its energy, as if the contact had no duration. The initial rate g0' of the gap alone would give the free path p = -g0' h in the step
//! h. The rule gives the path p / (1 + (w h / 2)^2), where w^2 is stiffness over mass. The trial is too long if this path is below four
//! fifths of p. The reported fraction then makes w h almost one.
//!
//! The damper of a contact fades in over a millimetre of depth, which a fast step skips. Therefore one step, or a few equal steps, end
//! where the damper has faded in. The errors of the mean forces in both halves of the fade then cancel.
//!
//! The band is 1e-9 of the scene's length, or of a radian for angles. This is ten times the tolerance of steps. In `f32` it is 128 times
//! machine precision. The rounding error of the time, multiplied by the rate of the gap, is added.
//!
//! Some kinks are not found: those of dampers, friction and user-defined laws, and those of signals. The times of signals are known
//! beforehand ([`SignalTimes`](crate::inputs::SignalTimes)). Kinks of a road under a wheel in the air are not found either. In a hollow as
//! narrow as the wheel, two points of the road may have the same distance from the wheel; this kink is not found.

use super::cubic::Cubic;
use super::load::{Gap, Load, Loads, N_READING, Reading};
use crate::Real;
use crate::control::Event;
use crate::laws::corner::LawCorner;
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::{ModelError, NaturalModel};
use alloc::vec::Vec;

/// Detector of events: it compares gaps and kinks at the ends of trial steps with those at their beginning.
#[derive(Debug, Clone)]
pub struct Events<T: Real, const D: usize> {
    loads: Loads<T, D>,
    watched: Vec<Watched<T>>,
    /// Time at the beginning of the step [s].
    t: T,
    /// Number of trials of the step so far.
    trials: u32,
}

/// History of [`Events`] at the beginning of a step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EventHistory<T> {
    /// Time at the beginning of the step [s].
    pub t: T,
    /// Number of trials of the step so far.
    pub trials: u32,
    /// Gaps and coordinates of each observed effect, each with its rate.
    pub begin: Vec<[T; N_READING]>,
}

/// One observed effect with its gaps and kinks.
#[derive(Debug, Clone)]
struct Watched<T> {
    effect: usize,
    n_gaps: usize,
    /// Depth over which the damper of the contact fades in [m or rad].
    fade: Option<f64>,
    /// Kinks in the order of their places. Kinks at the same place of a crest are in the order from left to right.
    kinks: Vec<LawCorner<T>>,
    reach: T,
    /// Half width of the band around zero, without the error of the time [m or rad].
    band: f64,
    /// Readings at the beginning of the step, and at the end of the last trial.
    begin: Reading<T>,
    end: Reading<T>,
}

/// Half width of the band around zero, relative to the scene's length or to a radian [-]: ten times the tolerance of steps.
const BAND: f64 = 1e-9;
/// Smallest half width of the band, in multiples of machine precision [-]. It counts only in `f32`. Chosen, not tuned.
const BAND_ROUNDINGS: f64 = 128.0;
/// Smallest ratio of a contact's depth to its free path in the step in which it begins [-]. The ratio is 4/5 for w h = 1.
const RESOLVED: f64 = 0.8;
/// Number of trials of a step in which the cubic alone gives the instant of an event [-]: two or three are usual.
const MAX_CUBIC_TRIALS: u32 = 3;
/// Ratio of a gap's depth to its free path below which the contact prevents deeper penetration [-], as for [`RESOLVED`].
const HELD_RATIO: f64 = 0.8;
/// Target of w h / 2 in the repetition of a step with a stiff contact [-]: slightly below 1/2, where a contact is resolved.
const TARGET_HALF_WH: f64 = 0.45;
/// Longest path of a contact that needs no resolution, in multiples of the band [-]. Chosen, not tuned.
const SHORT_PATH: f64 = 100.0;
/// Tolerance of the end of a step at the depth where a damper has faded in, relative to that depth [-]. Chosen, not tuned.
const FADE_TOLERANCE: f64 = 0.1;
/// Largest number of equal steps that end where a damper has faded in [-]. If more steps are necessary, they resolve the fade anyway.
const MAX_FADE_STEPS: f64 = 4.0;
/// Bounds of the fraction for the repetition of a step with a stiff contact [-]. The step is at least halved. Chosen, not tuned.
const STIFF_FRACTIONS: [f64; 2] = [0.02, 0.5];
/// Error of the time, in multiples of its rounding error, that widens the band in proportion to the gap's rate [-]. Chosen, not tuned.
const TIME_ROUNDINGS: f64 = 4.0;

impl<T: Real, const D: usize> Events<T, D> {
    /// Prepares the gaps and kinks of a scene. Without gaps and kinks, nothing is evaluated.
    ///
    /// Cost: an entry for each bumper, limit, tire and polynomial spring, and an entry for each kink of each tire's road.
    ///
    /// # Errors
    /// [`ModelError`] as when the model is built.
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Result<Self, ModelError> {
        let (mut loads, effects) = Loads::with_kinks(scene, model)?;
        let start = State::at_rest(model);
        let (list, law_inputs) = loads.at(&start);
        let watch = |(load, &effect): (&Load<T, D>, &usize)| {
            let mut kinks = Vec::new();
            load.kinks(&law_inputs, |kink| kinks.push(kink));
            let band = BAND.max(BAND_ROUNDINGS * T::EPSILON.to_f64());
            let size = if load.is_angular() { 1.0 } else { model.length().to_f64() };
            let contact = (load.n_gaps(), load.fade());
            Watched::new(effect, contact, (kinks, load.reach()), band * size)
        };
        let watched = list.iter().zip(&effects).map(watch).collect();
        Ok(Self { loads, watched, t: T::ZERO, trials: 0 })
    }

    /// Evaluates gaps and kinks at the state from which the next step begins. It is called at the start of a run, and after a program has
    /// set the state.
    ///
    /// Cost: one length, angle or nearest point of the road for each effect; no allocation.
    pub fn start(&mut self, state: &State<T>) {
        self.read(state);
        for watched in &mut self.watched {
            watched.begin = watched.end;
        }
        self.t = state.t;
        self.trials = 0;
    }

    /// First event within the trial step that ends in `state`. The stored beginning of the step does not change.
    ///
    /// Cost: as [`start`](Self::start), and about eighty operations for each gap and for each kink close to the path of a wheel in contact.
    /// Each change of sign costs a bisection of about fifty evaluations. No allocation.
    pub fn first_event(&mut self, state: &State<T>) -> Option<Event> {
        self.read(state);
        let (from, to) = (self.t.to_f64(), state.t.to_f64());
        if self.watched.is_empty() || !(to > from) {
            return None;
        }
        let mut first: Option<Event> = None;
        self.trials += 1;
        let is_slow = self.trials > MAX_CUBIC_TRIALS;
        for watched in &self.watched {
            watched.crossings(([from, to], is_slow), |crossing| {
                if first.is_none_or(|first| crossing.share < first.share) {
                    first = Some(crossing);
                }
            });
        }
        first
    }

    /// Ends the step in `state`, from which the next step begins.
    ///
    /// It evaluates the state again, so `state` may differ from the last one passed to [`first_event`](Self::first_event). Cost: as
    /// [`start`](Self::start).
    pub fn accept(&mut self, state: &State<T>) {
        self.start(state);
    }

    /// History from which a run resumes: readings at the beginning of the step.
    #[must_use]
    pub fn history(&self) -> EventHistory<T> {
        let begin = self.watched.iter().map(|watched| watched.begin.numbers()).collect();
        EventHistory { t: self.t, trials: self.trials, begin }
    }

    /// Restores the history of the same scene. Returns `false`, and changes nothing, if its length does not fit.
    pub fn set_history(&mut self, history: &EventHistory<T>) -> bool {
        if history.begin.len() != self.watched.len() {
            return false;
        }
        (self.t, self.trials) = (history.t, history.trials);
        for (watched, numbers) in self.watched.iter_mut().zip(&history.begin) {
            watched.begin = Reading::of_numbers(numbers);
        }
        true
    }

    fn read(&mut self, state: &State<T>) {
        if self.watched.is_empty() {
            return;
        }
        let (list, law_inputs) = self.loads.at(state);
        for (load, watched) in list.iter().zip(&mut self.watched) {
            watched.end = load.reading(state, &law_inputs);
        }
    }
}

impl<T: Real> Watched<T> {
    fn new(
        effect: usize,
        (n_gaps, fade): (usize, Option<f64>),
        (mut kinks, reach): (Vec<LawCorner<T>>, T),
        band: f64,
    ) -> Self {
        // A wheel that rolls over a crest passes the steeper normal first.
        let key = |kink: &LawCorner<T>| [kink.place.to_f64(), -kink.slope.to_f64()];
        kinks.sort_unstable_by(|a, b| {
            let ([p, s], [q, u]) = (key(a), key(b));
            p.total_cmp(&q).then(s.total_cmp(&u))
        });
        kinks.dedup();
        let (begin, end) = (Reading::default(), Reading::default());
        Self { effect, n_gaps, fade, kinks, reach, band, begin, end }
    }

    /// Passes to `take` the first change of sign of each gap, and of each kink within reach.
    fn crossings(&self, ([from, to], is_slow): ([f64; 2], bool), mut take: impl FnMut(Event)) {
        let (begin, end) = (&self.begin, &self.end);
        for i in 0..self.n_gaps {
            let late = TIME_ROUNDINGS * T::EPSILON.to_f64() * to.abs();
            let step = (to - from, self.band + late * begin.gaps[i].rate.abs().to_f64());
            if let Some(share) = self.entry([begin.gaps[i], end.gaps[i]], step) {
                let effect = self.effect;
                return take(Event { share, is_landed: false, is_too_stiff: true, effect });
            }
        }
        let mut watch = |begin: Gap<T>, end: Gap<T>| {
            let rate = begin.rate.abs().max(end.rate.abs()).to_f64();
            let late = TIME_ROUNDINGS * T::EPSILON.to_f64() * to.abs();
            let cubic = Cubic::new([begin, end], to - from);
            if let Some(change) = cubic.change(self.band + late * rate) {
                let effect = self.effect;
                let (mut share, is_landed) = (change.share, change.lands);
                if is_slow && !is_landed {
                    share = share.min(self.free([begin, end], to - from));
                }
                take(Event { share, is_landed, is_too_stiff: false, effect });
            }
        };
        for i in 0..self.n_gaps {
            watch(begin.gaps[i], end.gaps[i]);
        }
        // Before a wheel touches the road, no kink of the road is an event.
        if self.n_gaps > 0 && begin.gaps[0].value.to_f64() > self.band {
            return;
        }
        for kink in self.near() {
            watch(passage(kink, &begin.place), passage(kink, &end.place));
        }
    }

    /// Fraction of a step of length `h` [s] after which a gap closes at its initial rate. It replaces the cubic if a stiff contact at the
    /// end prevents penetration, since the cubic then follows the contact instead of the free path. Otherwise the result is infinity.
    fn free(&self, [begin, end]: [Gap<T>; 2], h: f64) -> f64 {
        let [begin, rate, end] = [begin.value, begin.rate, end.value].map(T::to_f64);
        let on = begin + rate * h;
        let is_held = begin > self.band && on < 0.0 && end > HELD_RATIO * on;
        if is_held { (begin + 0.5 * self.band) / (begin - on) } else { f64::INFINITY }
    }

    /// Fraction of a step of length `h` [s] that resolves a contact which begins with the step, within `band`. `None` if the whole step
    /// resolves the contact.
    fn entry(&self, [begin, end]: [Gap<T>; 2], (h, band): (f64, f64)) -> Option<f64> {
        let [begin, rate, end] = [begin.value, begin.rate, end.value].map(T::to_f64);
        let way = -rate * h;
        if begin > band || way <= SHORT_PATH * band {
            return None;
        }
        let fading = self.fade.and_then(|fade| fading(begin + fade, (fade, way)));
        let has_faded_in =
            self.fade.is_some_and(|fade| (begin + fade).abs() <= FADE_TOLERANCE * fade);
        let part = (begin - end) / way;
        if part >= RESOLVED || !(begin.abs() <= band || has_faded_in) {
            return fading;
        }
        // part = 1 / (1 + x^2) with x = w h / 2; x is unknown if the contact has ended again.
        let share = TARGET_HALF_WH / libm::sqrt(1.0 / part.max(f64::MIN_POSITIVE) - 1.0);
        let share = share.clamp(STIFF_FRACTIONS[0], STIFF_FRACTIONS[1]);
        Some(fading.map_or(share, |fading| fading.min(share)))
    }

    /// Kinks between the two places of the wheel, extended by the reach on both sides, and one further kink on either side.
    fn near(&self) -> &[LawCorner<T>] {
        let (a, b) = (self.begin.place[0].value, self.end.place[0].value);
        let (lower, upper) = (a.min(b) - self.reach, a.max(b) + self.reach);
        let first = self.kinks.partition_point(|kink| kink.place < lower);
        let end = self.kinks.partition_point(|kink| kink.place <= upper);
        &self.kinks[first.saturating_sub(1)..end.max(first).saturating_add(1).min(self.kinks.len())]
    }
}

/// Fraction to which a step is shortened so that it ends where a damper has faded in. If one step is too short for this, a few equal steps
/// end there. `left` is the distance to that depth, `fade` the depth itself, `way` the path of the step. `None` if the step keeps its
/// length.
pub fn fading(left: f64, (fade, way): (f64, f64)) -> Option<f64> {
    if left <= FADE_TOLERANCE * fade {
        return None;
    }
    let steps = libm::ceil(left / (way * (1.0 + FADE_TOLERANCE)));
    let share = left / (steps * way);
    (steps <= MAX_FADE_STEPS && share < 1.0 - FADE_TOLERANCE)
        .then_some(share.max(STIFF_FRACTIONS[0]))
}

/// Value that changes its sign at a kink, and its rate.
fn passage<T: Real>(kink: &LawCorner<T>, place: &[Gap<T>; 2]) -> Gap<T> {
    let [value, rate] = [place.map(|x| x.value), place.map(|x| x.rate)];
    Gap { value: kink.value(value), rate: kink.rate(rate) }
}

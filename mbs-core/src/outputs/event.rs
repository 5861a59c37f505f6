//! Events at which a law passes a kink within a trial step, so that the step can be made again to end there.
//!
//! ```text
//! gap      of bumpers, limits, tires: 0 where contact is made or broken
//! kink     of a road under a wheel that is pressed in, and between the pieces of a polynomial spring
//! ```
//!
//! Values and rates at both ends of the step give a cubic for each. Its first change of sign is an event, at a fraction of the step.
//! A trial that ends within a band about zero has landed: there the value is on neither side, and the next step leaves to either
//! without a second event. A driver makes a trial, asks [`Events::first_event`], tries again from the same beginning with that
//! fraction of the step while it has not landed, and ends with [`Events::accept`]. It is the method of the secant with a cubic in
//! place of a line, and two or three trials are usual.
//!
//! A contact that begins with the step has a stiffness of its own, which the step may be too long for. The trapezoidal rule then
//! throws it back within the step, with all its energy, as if no time had passed. Of the free path p = -g0' h, which the speed alone
//! would give, it goes p / (1 + (w h / 2)^2) where w^2 is stiffness over mass. Below four fifths the trial is too long, and the
//! fraction that makes w h nearly one is reported. A damper fades in over a millimetre, which a step at speed passes unseen: a step,
//! or a few equal ones, end there. The errors of the means of their ends in both halves of the fade cancel.
//!
//! The band is 1e-9 of the scene's length (of a radian for angles), ten times what steps are solved to; in `f32` 128 roundings.
//! To it comes what the rounding of the time leaves at the rate of the gap.
//!
//! Not found: kinks of dampers, friction and user-defined laws, and those of signals, whose times are known beforehand
//! ([`SignalTimes`](crate::inputs::SignalTimes)). Nor are a road's kinks under a wheel in the air, or two places of a road that become
//! equally near in a hollow as tight as the wheel.

use super::cubic::Cubic;
use super::load::{Gap, Load, Loads, N_READING, Reading};
use crate::Real;
use crate::control::Event;
use crate::laws::corner::LawCorner;
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::{ModelError, NaturalModel};
use alloc::vec::Vec;

/// Compares gaps and kinks at the ends of trial steps with those at their beginning.
#[derive(Debug, Clone)]
pub struct Events<T: Real, const D: usize> {
    loads: Loads<T, D>,
    watched: Vec<Watched<T>>,
    /// When the step begins [s].
    t: T,
    /// Trials of it so far.
    trials: u32,
}

/// History of [`Events`] at the beginning of a step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EventHistory<T> {
    /// When it begins [s].
    pub t: T,
    /// Trials of it so far.
    pub trials: u32,
    /// Gaps and places of each effect that is watched, each with its rate.
    pub begin: Vec<[T; N_READING]>,
}

/// One effect that is watched, with its numbers.
#[derive(Debug, Clone)]
struct Watched<T> {
    effect: usize,
    n_gaps: usize,
    /// The depth over which its damper fades in [m or rad].
    fade: Option<f64>,
    /// In order of their places, on a crest from left to right.
    kinks: Vec<LawCorner<T>>,
    reach: T,
    /// Without what the time's rounding adds [m or rad].
    band: f64,
    /// At the beginning of the step, and at the end of the last trial.
    begin: Reading<T>,
    end: Reading<T>,
}

/// Half width of the band about zero, relative to the scene's length or to a radian [-]: ten times what steps are solved to.
const BAND: f64 = 1e-9;
/// Least half width of the band, in units of rounding [-]: it counts in `f32` alone. Chosen, not tuned.
const BAND_ROUNDINGS: f64 = 128.0;
/// Least ratio of a contact's depth to its free path in the step that begins it [-]: it is 4/5 where w h is one.
const RESOLVED: f64 = 0.8;
/// Most trials of a step in which the cubic alone gives the instant where a contact holds [-]: two or three are usual.
const MAX_CUBIC_TRIALS: u32 = 3;
/// Ratio of a gap's depth to its free path below which the contact holds it [-], as for [`RESOLVED`].
const HELD_RATIO: f64 = 0.8;
/// Half of w h after which a stiff contact is tried again [-]: a little below 1/2, where a contact is resolved.
const TARGET_HALF_WH: f64 = 0.45;
/// Longest path of a contact that needs no resolution, in bands [-]. Chosen, not tuned.
const SHORT_PATH: f64 = 100.0;
/// Tolerance of the depth at which a damper has faded in, relative to that depth [-]. Chosen, not tuned.
const FADE_TOLERANCE: f64 = 0.1;
/// Most equal steps that are cut to end where a damper has faded in [-]: more resolve the fade wherever they end.
const MAX_FADE_STEPS: f64 = 4.0;
/// Bounds of the fraction of a step after which a stiff contact is tried again [-]: it halves the step at least. Chosen, not tuned.
const STIFF_FRACTIONS: [f64; 2] = [0.02, 0.5];
/// Error of the time, in units of its rounding, that widens the band at a gap's rate [-]. Chosen, not tuned.
const TIME_ROUNDINGS: f64 = 4.0;

impl<T: Real, const D: usize> Events<T, D> {
    /// Prepares what is watched of a scene; without any of it, nothing is ever evaluated.
    ///
    /// Cost: an entry for each bumper, limit, tire and polynomial spring, and one for each kink of each tire's road.
    ///
    /// # Errors
    /// [`ModelError`] as for the model.
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

    /// Takes what is watched at a state from which the next step begins: at the start of a run, or after it was set from outside.
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

    /// The first event within the trial step that ends in a state. Does not move the beginning of the step.
    ///
    /// Cost: as [`start`](Self::start), and some eighty operations for each gap and each kink near the way of a wheel that is
    /// pressed in. A bisection of fifty cubics for each that changes. No allocation.
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

    /// Ends the step in a state, from which the next begins.
    ///
    /// Reads it anew, so that it need not be the one that [`first_event`](Self::first_event) was last asked for. Cost: as
    /// [`start`](Self::start).
    pub fn accept(&mut self, state: &State<T>) {
        self.start(state);
    }

    /// History that the next step is compared with.
    #[must_use]
    pub fn history(&self) -> EventHistory<T> {
        let begin = self.watched.iter().map(|watched| watched.begin.numbers()).collect();
        EventHistory { t: self.t, trials: self.trials, begin }
    }

    /// Restores the history of the same scene; returns whether it is one, by its length. Else nothing is changed.
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
        // A wheel that rolls on passes the steeper normal of a crest first.
        let key = |kink: &LawCorner<T>| [kink.place.to_f64(), -kink.slope.to_f64()];
        kinks.sort_unstable_by(|a, b| {
            let ([p, s], [q, u]) = (key(a), key(b));
            p.total_cmp(&q).then(s.total_cmp(&u))
        });
        kinks.dedup();
        let (begin, end) = (Reading::default(), Reading::default());
        Self { effect, n_gaps, fade, kinks, reach, band, begin, end }
    }

    /// Hands out the first change of each gap and of each kink that may be passed.
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
        // Before a wheel has touched, no kink of its road comes first.
        if self.n_gaps > 0 && begin.gaps[0].value.to_f64() > self.band {
            return;
        }
        for kink in self.near() {
            watch(passage(kink, &begin.place), passage(kink, &end.place));
        }
    }

    /// The fraction of a step of length `h` [s] after which a gap closes at the rate of its beginning, where a stiff contact holds it
    /// at the end. The cubic then follows the contact, and not the path to it. Else infinite.
    fn free(&self, [begin, end]: [Gap<T>; 2], h: f64) -> f64 {
        let [begin, rate, end] = [begin.value, begin.rate, end.value].map(T::to_f64);
        let on = begin + rate * h;
        let is_held = begin > self.band && on < 0.0 && end > HELD_RATIO * on;
        if is_held { (begin + 0.5 * self.band) / (begin - on) } else { f64::INFINITY }
    }

    /// The share of a step of length `h` [s] in which a contact that begins with it, within `band`, is resolved, where it is not in the
    /// whole.
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
        // part = 1 / (1 + x^2) with x = w h / 2; nothing is known of x where the contact has opened again.
        let share = TARGET_HALF_WH / libm::sqrt(1.0 / part.max(f64::MIN_POSITIVE) - 1.0);
        let share = share.clamp(STIFF_FRACTIONS[0], STIFF_FRACTIONS[1]);
        Some(fading.map_or(share, |fading| fading.min(share)))
    }

    /// The kinks that may be passed between the two places, and one on either side.
    fn near(&self) -> &[LawCorner<T>] {
        let (a, b) = (self.begin.place[0].value, self.end.place[0].value);
        let (lower, upper) = (a.min(b) - self.reach, a.max(b) + self.reach);
        let first = self.kinks.partition_point(|kink| kink.place < lower);
        let end = self.kinks.partition_point(|kink| kink.place <= upper);
        &self.kinks[first.saturating_sub(1)..end.max(first).saturating_add(1).min(self.kinks.len())]
    }
}

/// The share of a step of so long a way in which equal steps of a few end where a damper has faded in, which is `left` away.
pub fn fading(left: f64, (fade, way): (f64, f64)) -> Option<f64> {
    if left <= FADE_TOLERANCE * fade {
        return None;
    }
    let steps = libm::ceil(left / (way * (1.0 + FADE_TOLERANCE)));
    let share = left / (steps * way);
    (steps <= MAX_FADE_STEPS && share < 1.0 - FADE_TOLERANCE)
        .then_some(share.max(STIFF_FRACTIONS[0]))
}

/// The value that changes sign at a kink, and its rate.
fn passage<T: Real>(kink: &LawCorner<T>, place: &[Gap<T>; 2]) -> Gap<T> {
    let [value, rate] = [place.map(|x| x.value), place.map(|x| x.rate)];
    Gap { value: kink.value(value), rate: kink.rate(rate) }
}

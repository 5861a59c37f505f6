//! The end of the pilot: those that are close are timed again by turns, and all are ranked.

use super::entrant::{Entrant, LOST};
use super::law::{Basis, Prediction};
use super::race::Race;
use super::trial::{Aim, End, Time};

/// Errors are not predicted where they take more than so many times the longest trial.
const FAR: f64 = 30.0;
/// A finalist is given up where it takes so many times what was predicted.
const SLOW: f64 = 3.0;
/// It is tried where this many times its prediction is left.
const LATE: f64 = 1.5;
/// A setting coarser than its own tells something new where it is finer than this share of what was tried.
const NEWS: f64 = 0.5;
/// Those within this factor of the cheapest are tried with their own settings and timed again.
const CLOSE: f64 = 1.6;
/// So many of them at most, and so often.
const FINALISTS: usize = 4;
const ROUNDS: usize = 5;
/// Times that differ by less than this factor are the same; then those come first that were seen, or nearly, up to this factor in the
/// error, and of these the order of the candidates decides.
const SAME: f64 = 1.05;
const NEAR: f64 = 10.0;

/// A place in the ranking.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    pub(crate) entrant: usize,
    pub(crate) prediction: Prediction,
    /// Is the wanted error expected to be reached?
    pub(crate) reaches: bool,
    /// Its time is that of runs with the very setting.
    pub(crate) is_timed: bool,
}

impl Race<'_> {
    /// Runs the pilot to its end and ranks: the cheapest of those that reach the wanted error first, then the others by their errors.
    pub(crate) fn run(&mut self) -> Vec<Place> {
        self.heats();
        let mut places = self.ranked(&[]);
        let close: Vec<usize> = close(&places);
        for &i in &close {
            self.confirm(i);
        }
        places = self.ranked(&[]);
        let finalists = self::close(&places);
        let timed = self.time(&places, &finalists);
        let places = self.ranked(&timed);
        if places.is_empty() { self.rescued() } else { places }
    }

    /// Where all are out: the trials that were completed, those that reach the wanted error by their times, then the others by their
    /// errors.
    fn rescued(&self) -> Vec<Place> {
        let mut places: Vec<Place> = Vec::new();
        for (entrant, e) in self.entrants.iter().enumerate() {
            places.extend(e.points().into_iter().map(|point| Place {
                entrant,
                prediction: Prediction { point, basis: Basis::Coarsest },
                reaches: point.error <= self.wanted.error,
                is_timed: false,
            }));
        }
        sort(&mut places);
        let mut seen = Vec::new();
        places.retain(|p| {
            !seen.contains(&p.entrant) && {
                seen.push(p.entrant);
                true
            }
        });
        places
    }

    /// Tries a finalist with its own setting: does it get to the end, and with the error that was predicted? Once more if not. Where
    /// there is no time for that setting, the finest that there is time for still makes the prediction a better one.
    fn confirm(&mut self, i: usize) {
        for _ in 0..2 {
            let Some(p) = self.place(i).map(|place| place.prediction) else { return };
            let (left, entrant) = (self.left(), &self.entrants[i]);
            let most = (left / (LATE * p.point.seconds)).min(1.0);
            let setting = p.point.setting * most.powf(-1.0 / entrant.law().cost);
            let is_new = most >= 1.0
                || entrant.tries.last().is_some_and(|finest| setting < NEWS * finest.setting);
            if left <= 0.0 || entrant.has_tried(setting) || !is_new {
                return;
            }
            self.attempt(i, setting, Some(SLOW * p.point.seconds));
            self.judge();
            let finest = self.entrants[i].tries.last();
            if finest.is_some_and(|t| matches!(t.trial.end, End::Stopped(_))) {
                // nothing coarser runs with the wanted error, and this does not run
                let why = self.entrants[i].stopped();
                self.entrants[i].out = why;
            }
        }
    }

    /// Least times of the finalists with their settings, by turns, as far as the budget goes.
    fn time(&mut self, places: &[Place], finalists: &[usize]) -> Vec<(usize, f64)> {
        let of = |i: usize| places.iter().find(|place| place.entrant == i);
        let mut timed: Vec<(usize, f64)> = Vec::new();
        for _ in 0..ROUNDS {
            for place in finalists.iter().filter_map(|&i| of(i)) {
                let (i, point) = (place.entrant, place.prediction.point);
                let left = self.budget() - self.bench.spent();
                if left < 1.5 * point.seconds {
                    continue;
                }
                let method = self.entrants[i].method;
                let trial =
                    self.bench.trial(&method, point.setting, Aim::Time, Time::strictly(left));
                if trial.end != End::Done {
                    continue;
                }
                match timed.iter_mut().find(|(of, _)| *of == i) {
                    Some((_, least)) => *least = least.min(trial.seconds),
                    None => timed.push((i, trial.seconds)),
                }
            }
        }
        timed
    }

    fn place(&self, i: usize) -> Option<Place> {
        let entrant: &Entrant = &self.entrants[i];
        if entrant.out.is_some() {
            return None;
        }
        let mut prediction = self.prediction(entrant)?;
        let worst = self.wanted.error * (1.0 + 1e-9);
        let is_lost = entrant.points().last().is_some_and(|point| point.error >= LOST);
        let is_far = matches!(prediction.basis, Basis::Finer(factor)
            if is_lost || entrant.law().cost_of(factor) > FAR);
        let is_seen = entrant.seen(worst).is_some();
        let is_out_of_reach = entrant.is_at_its_floor() && !is_seen;
        let reaches = prediction.point.error <= worst && !is_out_of_reach && !is_far;
        let is_free = self.wanted.deadline.is_none();
        if !reaches
            && is_free
            && let Some(finest) = entrant.points().last()
        {
            // nothing finer than what was seen to run
            prediction.point = *finest;
        }
        Some(Place { entrant: i, prediction, reaches, is_timed: false })
    }

    /// The same with nothing but what was seen where errors do not go by a law.
    fn sure(&self, i: usize) -> Option<Place> {
        let mut place = self.place(i)?;
        let entrant = &self.entrants[i];
        let is_between = place.reaches && place.prediction.basis == Basis::Between;
        if is_between
            && entrant.is_beside_held(place.prediction.point.setting)
            && let Some(point) = entrant.seen(self.wanted.error)
        {
            place.prediction = Prediction { point, basis: Basis::Coarsest };
        }
        Some(place)
    }

    /// Those that are not out, by rank; the times given count for those that are close.
    fn ranked(&self, timed: &[(usize, f64)]) -> Vec<Place> {
        let mut places: Vec<Place> =
            (0..self.entrants.len()).filter_map(|i| self.sure(i)).collect();
        for place in &mut places {
            if let Some((_, seconds)) = timed.iter().find(|(i, _)| *i == place.entrant) {
                place.prediction.point.seconds = *seconds;
                place.is_timed = true;
            }
        }
        sort(&mut places);
        // what is the same within the noise goes by the order of the candidates
        if let Some(first) = places.first().copied().filter(|first| first.reaches) {
            let bound = SAME * first.prediction.point.seconds;
            let same =
                places.iter().take_while(|p| p.reaches && p.prediction.point.seconds <= bound);
            let n = same.count();
            let is_guessed = |p: &Place| match p.prediction.basis {
                Basis::Finer(factor) => !p.is_timed && factor > NEAR,
                _ => false,
            };
            places[..n].sort_by_key(|p| (is_guessed(p), p.entrant));
        }
        places
    }
}

/// Those that reach the wanted error by their times, then the others by their errors.
fn sort(places: &mut [Place]) {
    let error = |p: &Place| p.prediction.point.error;
    let seconds = |p: &Place| p.prediction.point.seconds;
    places.sort_by(|a, b| {
        let by = if a.reaches { seconds } else { error };
        b.reaches.cmp(&a.reaches).then_with(|| by(a).total_cmp(&by(b)))
    });
}

/// The candidates beside the cheapest.
fn close(places: &[Place]) -> Vec<usize> {
    let Some(first) = places.first() else { return Vec::new() };
    let bound = CLOSE * first.prediction.point.seconds;
    let near =
        places.iter().filter(|p| p.reaches == first.reaches && p.prediction.point.seconds <= bound);
    near.take(FINALISTS).map(|p| p.entrant).collect()
}

/// What a prediction stands on, in words.
pub(crate) fn basis(place: &Place) -> String {
    match (place.is_timed, place.prediction.basis) {
        (true, _) => "timed with this setting".to_owned(),
        (_, Basis::Between) => "between two trials".to_owned(),
        (_, Basis::Coarsest) => "a trial with this setting".to_owned(),
        (_, Basis::Coarser(factor)) => {
            format!("beyond its trials, whose least error is {factor:.1} times smaller")
        }
        (_, Basis::Finer(factor)) => {
            format!("beyond its trials, whose least error is {factor:.1} times larger")
        }
    }
}

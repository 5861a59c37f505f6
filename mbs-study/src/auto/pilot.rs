//! Pilot of a choice: it decides which candidate gets the next trial, and when enough is known.
//!
//! All trials run over the whole span, so that late events count as well. Candidates without a trial are tried first, then the candidate with
//! the smallest predicted time. The pilot ends when half of each predicted time exceeds the cheapest time that reaches the required error.

use super::candidates::{Next, PilotCandidate, Tried};
use super::estimate::{Basis, Point, Prediction, SMALL, error_of_finer};
use super::goal::PilotTarget;
use super::trial::{Aim, Bench, Trial, TrialEnd};
use crate::compare::method::Control;
use core::fmt::{self, Debug, Formatter};
use mbs_scene::format::duration;

/// CPU time that the pilot may always take [s]. A user does not notice this delay.
pub const BUDGET: f64 = 0.2;
/// CPU time that the pilot may take, relative to the predicted time of the run [-]. A long run may have a longer pilot.
pub const BUDGET_FRACTION: f64 = 0.05;
/// Largest time of a trial, relative to the cheapest time [-]. A longer trial is given up. Its candidate cannot win, even if its time is wrong
/// by half.
pub(super) const GIVE_UP: f64 = 1.5;

/// Place of a candidate in the ranking.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PilotPlace {
    /// Index of the method among the candidates.
    pub candidate: usize,
    /// Prediction of setting, error and CPU time.
    pub prediction: Prediction,
    /// True if a trial reached the required error.
    pub reaches: bool,
    /// Whether the time was measured by a run with this setting.
    pub is_timed: bool,
}

/// The most accurate trial so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Best {
    pub(crate) candidate: usize,
    pub(crate) trial: usize,
    pub(crate) own: f64,
}

/// Search for the cheapest candidate that reaches the required error.
pub struct PilotSearch<'a> {
    pub(crate) bench: &'a mut dyn Bench,
    /// Candidates of the search.
    pub candidates: Vec<PilotCandidate>,
    pub(crate) target: PilotTarget,
    pub(crate) best: Option<Best>,
    /// True if the budget ended the search.
    pub(crate) is_cut: bool,
    /// CPU time that is reserved for second trials [s].
    reserve: f64,
}

impl Debug for PilotSearch<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.debug_struct("PilotSearch").field("candidates", &self.candidates).finish_non_exhaustive()
    }
}

impl<'a> PilotSearch<'a> {
    /// Makes a search among candidates, none of which has a trial yet.
    pub fn new(
        bench: &'a mut dyn Bench,
        candidates: Vec<PilotCandidate>,
        target: PilotTarget,
    ) -> Self {
        let reserve = 0.5 * (BUDGET - bench.spent());
        Self { bench, candidates, target, best: None, is_cut: false, reserve }
    }

    /// Returns a smaller number of instants for shorter trials, if the budget ended the search. It is half of the instants that the fastest
    /// candidate reached.
    pub(crate) fn shorter(&self, count: usize) -> Option<usize> {
        let reached = self.candidates.iter().flat_map(|c| c.trials.iter().map(|t| t.trial.reached));
        let most = reached.fold(0.0, f64::max);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a part of a small count"
        )]
        let part = (0.5 * most * count as f64) as usize;
        (self.is_cut && part > 0).then_some(part)
    }

    /// Runs the trials and returns the ranking. The cheapest candidate that reaches the required error comes first.
    pub fn run(&mut self) -> Vec<PilotPlace> {
        while let Some((i, setting, limit)) = self.pick().or_else(|| self.confirming()) {
            self.attempt(i, setting, limit);
        }
        let timed = self.retime();
        self.ranked(&timed)
    }

    /// Returns the next trial if errors are not known well enough for a choice.
    ///
    /// Errors are known well enough if two conditions hold. First, the error of the best trial is at most a tenth of the required error. This
    /// is needed because trials may agree better than their errors: in chaotic motion (double-pendulum at 1e-2), or where instants limit the
    /// steps (simple-pendulum at 1e-6). Second, a trial by another integrator also reaches the required error. Trials of one integrator may
    /// agree too well: for rssr at 1e-2, trials of rk853 differ by only a tenth of their errors.
    fn confirming(&mut self) -> Option<(usize, f64, f64)> {
        let (best, left) = (self.best?, self.left());
        self.cheapest()?;
        let method = |i: usize| self.candidates[i].method;
        let is_other = |i: usize| method(i).integrator != method(best.candidate).integrator;
        let (small, mut all) = (SMALL * self.target.error, 0..self.candidates.len());
        let is_confirmed = all
            .clone()
            .any(|i| is_other(i) && self.candidates[i].seen(self.target.error).is_some());
        let target = match (best.own > small, is_confirmed) {
            (true, _) => PilotTarget { error: small, ..self.target },
            (_, false) => self.target,
            _ => return None,
        };
        let (mut pick, mut least) = (None, f64::INFINITY);
        for i in all.by_ref().filter(|&i| best.own > small || is_other(i)) {
            let candidate = &self.candidates[i];
            let Some((finer, p)) = candidate.finer().zip(candidate.predict(target)) else {
                continue;
            };
            let setting = p.setting.max(finer);
            let is_new = candidate.may_continue() && !candidate.has_tried(setting);
            if is_new && p.seconds < least && takes(candidate, setting) < 0.5 * left {
                (pick, least) = (Some((i, setting, left)), p.seconds);
            }
        }
        pick
    }

    /// Returns the next trial: candidate, setting and time limit [s]. The candidate with the smallest promised time is chosen.
    fn pick(&mut self) -> Option<(usize, f64, f64)> {
        let (cheapest, left) = (self.cheapest(), self.left());
        let mut pick = None;
        let mut least = f64::INFINITY;
        for i in 0..self.candidates.len() {
            let candidate = &self.candidates[i];
            if candidate.out.is_some() {
                continue;
            }
            let setting = match candidate.next(self.target) {
                Next::Try(setting) => setting,
                Next::Settled => continue,
                Next::Out(why) => {
                    self.candidates[i].out = Some(why);
                    continue;
                }
            };
            let promise = 0.5 * self.promise(i);
            if promise >= cheapest.unwrap_or(f64::INFINITY) || promise >= least {
                continue;
            }
            let limit = match cheapest {
                Some(seconds) => (GIVE_UP * seconds).min(left),
                None => self.time_limit(i, left),
            };
            let takes = takes(&self.candidates[i], setting);
            if takes > limit || limit <= 0.0 {
                self.is_cut |= takes > left || left <= 0.0;
                continue;
            }
            (pick, least) = (Some((i, setting, limit)), promise);
        }
        pick
    }

    /// Returns the time limit of a trial [s]. Before any candidate reaches the required error, a first trial gets at most twice its part of
    /// the budget without the reserve. It also gets at most twice the time of the fastest trial. The reserve is for second trials, without
    /// which no error is known (iltis-jump at 1e-2).
    fn time_limit(&self, i: usize, left: f64) -> f64 {
        let is_untried = |c: &&PilotCandidate| c.out.is_none() && c.trials.is_empty();
        if !is_untried(&&self.candidates[i]) {
            return left;
        }
        let untried = self.candidates.iter().filter(is_untried).count() as f64;
        let done = self.candidates.iter().flat_map(PilotCandidate::done).map(|t| t.trial.seconds);
        let fastest = done.fold(f64::INFINITY, f64::min);
        (2.0 / (untried + 1.0) * (left - self.reserve)).min(2.0 * fastest)
    }

    /// CPU time that a candidate is expected to need for the required error, if known; 0 before its first trial [s].
    fn promise(&self, i: usize) -> f64 {
        let candidate = &self.candidates[i];
        let predicted = candidate.predict(self.target).map(|p| p.seconds);
        let next = || candidate.finer().map(|setting| takes(candidate, setting));
        predicted.or_else(next).unwrap_or(0.0)
    }

    /// Returns the CPU time that the pilot may take [s].
    pub(crate) fn budget(&self) -> f64 {
        let tried = |&i: &usize| !self.candidates[i].trials.is_empty();
        let run = (0..self.candidates.len()).filter(tried).map(|i| self.promise(i));
        let run = self.cheapest().or_else(|| run.reduce(f64::min));
        BUDGET.max(BUDGET_FRACTION * run.unwrap_or(0.0))
    }

    /// Returns a place by theory if no trial came near the required error. The tolerance is a tenth of that error. Among the integrators with
    /// their own step control, the one that is fastest by its theoretical order is chosen. The measured power law is not used, because it may
    /// give any setting so far beyond the trials (iltis-links at 1e-6, on a busy machine).
    pub(crate) fn by_theory(&self, places: &[PilotPlace]) -> Option<PilotPlace> {
        let is_near = |p: &PilotPlace| p.reaches || p.prediction.error <= self.target.error / SMALL;
        if self.target.deadline.is_some() || places.first().is_some_and(is_near) {
            return None;
        }
        let setting = SMALL * self.target.error;
        let time = |i: &usize| takes(&self.candidates[*i], setting);
        let is_able = |i: &usize| {
            let candidate = &self.candidates[*i];
            let is_own = candidate.method.control == Control::Own;
            is_own && candidate.out.is_none() && candidate.whole_seconds().is_some()
        };
        let able = (0..self.candidates.len()).filter(is_able);
        let i = able.min_by(|a, b| time(a).total_cmp(&time(b)))?;
        let error = self.candidates[i].expected(setting);
        let prediction = Prediction { setting, error, seconds: time(&i), basis: Basis::Theory };
        Some(PilotPlace { candidate: i, prediction, reaches: false, is_timed: false })
    }

    fn left(&mut self) -> f64 {
        self.budget() - self.bench.spent()
    }

    /// Runs one more trial of a candidate, for `limit` [s] at most.
    fn attempt(&mut self, i: usize, setting: f64, limit: f64) {
        let aim = if self.target.deadline.is_some() { Aim::Steps } else { Aim::Rows };
        let candidate = &mut self.candidates[i];
        let trial = self.bench.trial(&candidate.method, setting, aim, limit);
        if trial.end == TrialEnd::GivenUp && trial.reached <= 0.0 {
            let why = format!("it makes no way in {}", duration(trial.seconds));
            candidate.out.get_or_insert(why);
        }
        candidate.take(Tried::new(setting, trial));
        if let (Some(deadline), Some(slowest)) = (self.target.deadline, candidate.slowest()) {
            let steps = (0.5 * deadline / slowest).floor();
            candidate.finest = deadline / steps.max(1.0);
            if steps < 1.0 {
                let why = format!(
                    "its slowest step takes {}, and less than twice that is left for it",
                    duration(slowest)
                );
                candidate.out.get_or_insert(why);
            }
        }
        self.compare(i, setting);
    }

    /// Computes the distances of a new trial from the others, and the errors of all trials from the best.
    fn compare(&mut self, i: usize, setting: f64) {
        let is_new = |t: &Tried| t.setting.to_bits() == setting.to_bits();
        let Some(k) = self.candidates[i].trials.iter().position(is_new) else { return };
        if self.candidates[i].trials[k].trial.end != TrialEnd::Done {
            // the list of trials has changed: errors are computed anew
            self.rate();
            return;
        }
        for (j, l) in self.done() {
            if (j, l) == (i, k) {
                continue;
            }
            let [a, b] = [(i, k), (j, l)].map(|(j, l)| &self.candidates[j].trials[l].trial);
            let d = self.distance(&a.rows, &b.rows);
            let method = self.candidates[i].method;
            let finer = |fine: &Trial, coarse: &Trial| error_of_finer(&method, fine, coarse, d);
            // `most` and `least` are the upper and lower bounds of the errors of both trials
            let (most, least) = if i != j {
                // two integrators have different errors: if their results agree, both errors are small
                let is_same = method.integrator == self.candidates[j].method.integrator;
                let of = |is_held: bool| if is_held && !is_same { d } else { f64::INFINITY };
                let is_held = [self.candidates[i].is_held(a), self.candidates[j].is_held(b)];
                (is_held.map(of), [0.0; 2])
            } else {
                let own = if k > l { finer(a, b) } else { finer(b, a) };
                let least = if own.is_finite() { d } else { 0.0 };
                let none = f64::INFINITY;
                if k > l { ([own, none], [0.0, least]) } else { ([none, own], [least, 0.0]) }
            };
            for (n, (j, l)) in [(i, k), (j, l)].into_iter().enumerate() {
                let tried = &mut self.candidates[j].trials[l];
                tried.most = tried.most.min(most[n]);
                tried.least = tried.least.max(least[n]);
            }
        }
        self.rate();
    }

    /// Returns the completed trials, each by candidate and index among its trials.
    fn done(&self) -> Vec<(usize, usize)> {
        let of = |(j, c): (usize, &PilotCandidate)| {
            let is_done =
                |(l, t): (usize, &Tried)| (t.trial.end == TrialEnd::Done).then_some((j, l));
            c.trials.iter().enumerate().filter_map(is_done).collect::<Vec<_>>()
        };
        self.candidates.iter().enumerate().flat_map(of).collect()
    }

    /// Distance of the outputs of two trials. It is at least the machine precision, also for equal outputs.
    fn distance(&self, a: &super::trial::Rows, b: &super::trial::Rows) -> f64 {
        let d = self.bench.distance(a, b);
        if d.is_nan() { f64::INFINITY } else { d.max(f64::EPSILON) }
    }

    /// Sets the errors of all trials: the distance from the best trial plus the error of the best trial.
    fn rate(&mut self) {
        let done = self.done();
        let own = |&(j, l): &(usize, usize)| self.candidates[j].trials[l].own();
        let best = done.iter().min_by(|a, b| own(a).total_cmp(&own(b))).filter(|t| own(t) < 1.0);
        let best = best.map(|t| Best { candidate: t.0, trial: t.1, own: own(t) });
        self.best = best;
        let Some(best) = best else { return };
        for (j, l) in done {
            let reference = &self.candidates[best.candidate].trials[best.trial].trial.rows;
            let is_best = (j, l) == (best.candidate, best.trial);
            let rows = &self.candidates[j].trials[l].trial.rows;
            let apart = if is_best { 0.0 } else { self.distance(reference, rows) };
            self.candidates[j].trials[l].error = Some(apart + best.own);
        }
    }

    /// CPU time of the cheapest trial that reached the required error [s]. It is a measured time, since a predicted one may be too low.
    fn cheapest(&self) -> Option<f64> {
        let left = self.candidates.iter().filter(|c| c.out.is_none());
        left.filter_map(|c| c.seen(self.target.error)).map(|p| p.seconds).reduce(f64::min)
    }

    /// Returns the place of a candidate that is not excluded, by its trials and its prediction.
    fn place(&self, i: usize) -> Option<PilotPlace> {
        let candidate = &self.candidates[i];
        let p = candidate.predict(self.target).filter(|_| candidate.out.is_none())?;
        let seen = candidate.seen(self.target.error);
        let stops =
            |t: &Tried| matches!(t.trial.end, TrialEnd::Stopped(_)) && t.setting <= p.setting;
        let is_better = |seen: &Point| {
            let is_untried = candidate.has_missed && !candidate.has_tried(p.setting);
            is_untried || seen.seconds <= p.seconds || candidate.trials.iter().any(stops)
        };
        let prediction = seen.filter(is_better).map_or(p, |point| Prediction::of_trial(&point));
        let error = if seen.is_some() { prediction.error } else { candidate.expected(p.setting) };
        let prediction = Prediction { error, ..prediction };
        Some(PilotPlace { candidate: i, prediction, reaches: seen.is_some(), is_timed: false })
    }

    /// Runs the finalists with their predicted settings. Finalists are candidates whose predicted time is close to the cheapest. Each finalist
    /// is then timed twice more, interleaved with the others, within the budget.
    fn retime(&mut self) -> Vec<(usize, f64)> {
        while let Some((i, setting, limit)) = self.untried() {
            self.attempt(i, setting, limit);
            let is_seen = |t: &&Tried| t.setting.to_bits() == setting.to_bits();
            let candidate = &mut self.candidates[i];
            let error = candidate.trials.iter().find(is_seen).and_then(|t| t.error);
            candidate.has_missed |= error.is_none_or(|error| error > self.target.error);
        }
        let mut timed: Vec<(usize, f64)> = Vec::new();
        for _ in 0..2 {
            for PilotPlace { candidate: i, prediction: p, .. } in self.finalists() {
                let (left, method) = (self.left(), self.candidates[i].method);
                if p.seconds >= left || self.target.deadline.is_some() {
                    continue;
                }
                let trial: Trial = self.bench.trial(&method, p.setting, Aim::Time, left);
                match timed.iter_mut().find(|(of, _)| *of == i) {
                    _ if trial.end != TrialEnd::Done => {}
                    Some((_, least)) => *least = least.min(trial.seconds),
                    None => timed.push((i, trial.seconds)),
                }
            }
        }
        timed
    }

    /// Returns a finalist that has not run with its predicted setting, if there is time for it. If a predicted setting missed the required
    /// error before, the new one is the geometric mean of the prediction and a setting that reached it.
    fn untried(&mut self) -> Option<(usize, f64, f64)> {
        let left = self.left();
        let of = |place: &PilotPlace| {
            let candidate = &self.candidates[place.candidate];
            let p = candidate.predict(self.target)?;
            let seen = candidate.seen(self.target.error).map(|seen| seen.setting);
            let setting = match seen {
                Some(seen) if candidate.has_missed => candidate.fit((p.setting * seen).sqrt()),
                _ => p.setting,
            };
            // the setting is known too if no whole number of steps lies between it and the last trial
            let is_known = candidate.has_tried(setting)
                || candidate.is_settled(self.target) && seen.is_some() && candidate.has_missed;
            let is_new = !is_known && p.seconds < left && candidate.may_continue();
            is_new.then_some((place.candidate, setting, left))
        };
        self.finalists().iter().find_map(of)
    }

    /// Returns the places whose time is at most [`GIVE_UP`] times that of the cheapest.
    fn finalists(&self) -> Vec<PilotPlace> {
        let mut places = self.ranked(&[]);
        let Some(first) = places.first().copied() else { return places };
        let limit = GIVE_UP * first.prediction.seconds;
        places.retain(|p| p.reaches == first.reaches && p.prediction.seconds <= limit);
        places
    }

    /// Returns the places in the order of the ranking. Candidates that reach the required error come first, sorted by time. The others
    /// follow, sorted by time, or by error if a deadline gives the time. Excluded candidates that completed a trial come last.
    fn ranked(&self, timed: &[(usize, f64)]) -> Vec<PilotPlace> {
        let mut places: Vec<PilotPlace> =
            (0..self.candidates.len()).filter_map(|i| self.place(i)).collect();
        for place in &mut places {
            if let Some((_, seconds)) = timed.iter().find(|(i, _)| *i == place.candidate) {
                place.prediction.seconds = *seconds;
                place.is_timed = true;
            }
        }
        let has_deadline = self.target.deadline.is_some();
        let key = |p: &PilotPlace| match p.reaches || !has_deadline {
            true => p.prediction.seconds,
            false => p.prediction.error,
        };
        places.sort_by(|a, b| b.reaches.cmp(&a.reaches).then_with(|| key(a).total_cmp(&key(b))));
        let out = |(i, c): (usize, &PilotCandidate)| {
            let points = c.points();
            let point =
                points.last().filter(|_| c.out.is_some() && c.finest <= points[0].setting)?;
            let prediction = Prediction::of_trial(point);
            Some(PilotPlace { candidate: i, prediction, reaches: false, is_timed: false })
        };
        let mut rest: Vec<PilotPlace> =
            self.candidates.iter().enumerate().filter_map(out).collect();
        rest.sort_by(|a, b| a.prediction.error.total_cmp(&b.prediction.error));
        places.extend(rest);
        places
    }
}

/// CPU time that a trial is expected to take; 0 for a candidate's first trial [s].
fn takes(candidate: &PilotCandidate, setting: f64) -> f64 {
    let Some(last) = candidate.trials.last() else { return 0.0 };
    let ratio = (last.setting / setting).powf(candidate.law().cost);
    candidate.whole_seconds().unwrap_or(0.0) * ratio
}

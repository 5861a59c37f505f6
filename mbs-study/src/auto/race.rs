//! The pilot: who gets the next trial, and when enough is known.
//!
//! The candidate that could still be the cheapest is tried next, at the setting that its trials so far predict for the wanted error;
//! one whose best case is dearer than what another was measured to take is left alone. All trials go over the whole span, the first
//! with coarse settings, so that what happens late in the run is seen as well.

use super::entrant::{Entrant, LOST, Try, is_twin};
use super::law::{Basis, HELD, Point, Prediction};
use super::trial::{Aim, Bench, End, Time, Trial};
use crate::compare::method::Control;
use mbs_scene::format::{duration, few};

/// CPU time of the pilot at least, and as a share of the predicted run [s, 1].
pub(crate) const BUDGET: [f64; 2] = [0.2, 0.05];
/// Error that is aimed at beside the wanted one: where a smaller error costs little, and where it costs more.
const AIMS: [f64; 2] = [0.6, 0.8];
/// A trial is taken as it is where its error is no more than this share of the wanted one.
const TAKEN: f64 = 0.9;
/// Cost exponent of the error that parts the two.
const CHEAP: f64 = 0.3;
/// A candidate is known well enough if another trial could change its time by no more than this factor.
const KNOWN: f64 = 1.2;
/// Trials of a candidate, and those that stop before one is completed, at most.
const TRIES: [usize; 2] = [9, 5];
/// Who stops twice before this share of the span is not helped by finer settings.
const START: f64 = 1e-3;
/// A candidate is followed alone until it reaches the wanted error, for so many trials at most.
const LED: usize = 6;
/// One of second order is followed where it promises to take no more than this share of what is left.
const FOLLOWED: f64 = 0.4;
/// Errors are not extrapolated over more than this factor at once where the motion was lost: where a smaller error costs little, and
/// where it costs more, which then takes no more than about three times as long.
const LEAP: [f64; 2] = [30.0, 8.0];
/// A trial is given up where it takes so many times what the best does.
pub(super) const LOSING: f64 = 1.6;
/// Any trial takes no less than this [s], and no more than this share of what is left, or up to the next where that is likely to be
/// enough.
const SHORTEST: f64 = 2e-3;
pub(super) const SHARE: f64 = 0.3;
pub(super) const MOST: f64 = 0.7;
/// What is likely to be at its end after so many times what a trial is given may go there.
const NEARLY: f64 = 1.25;
/// A tolerance that is so many times as large should need fewer steps.
const COARSER: f64 = 10.0;
/// Where no trial has got to the end after this share of the budget, the span is too long for it.
const BLIND: f64 = 0.7;
/// Twins are believed to need no less than this share of each other's steps, and of the time of each.
const TWIN: f64 = 0.7;
const CHEAPER: f64 = 0.4;
/// A frame is filled up to this share by steps that take as long as the slowest.
const FILLED: f64 = 0.5;

/// What is wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wanted {
    /// Error of the outputs.
    pub(crate) error: f64,
    /// Frames of so many seconds are to be computed each within that time.
    pub(crate) deadline: Option<f64>,
}

/// The most accurate trial so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Best {
    pub(crate) entrant: usize,
    pub(crate) setting: f64,
    pub(crate) own: f64,
}

/// What a candidate needs next.
#[derive(Debug, Clone, PartialEq)]
enum Next {
    Try(f64),
    Settled(Prediction),
    Out(String),
}

/// The pilot under way.
pub(crate) struct Race<'a> {
    pub(super) bench: &'a mut dyn Bench,
    pub(crate) entrants: Vec<Entrant>,
    pub(crate) wanted: Wanted,
    pub(crate) best: Option<Best>,
    /// The budget ended it.
    pub(crate) is_cut: bool,
    /// So often a finer run than is wanted was made.
    pub(super) refined: u32,
    /// The longest that a trial took beside its steps: to be built, and to be compared [s].
    beside: f64,
}

impl<'a> Race<'a> {
    pub(crate) fn new(bench: &'a mut dyn Bench, entrants: Vec<Entrant>, wanted: Wanted) -> Self {
        Self { bench, entrants, wanted, best: None, is_cut: false, refined: 0, beside: 0.0 }
    }

    /// Tries candidates until the cheapest is known, or the budget is used up.
    pub(crate) fn heats(&mut self) {
        loop {
            self.judge();
            let cheapest = self.cheapest();
            let is_any_done = self.entrants.iter().any(|e| e.done().next().is_some());
            let budget = self.budget() * if is_any_done { 1.0 } else { BLIND };
            if self.bench.spent() + self.beside + SHORTEST >= budget {
                self.is_cut = true;
                return;
            }
            if cheapest.is_some() && self.refine_reference() {
                continue;
            }
            if cheapest.is_none()
                && let Some((i, setting)) = self.leader()
            {
                let most = self.patience(i, setting, cheapest);
                self.attempt(i, setting, most);
                continue;
            }
            // who waits for others waits no longer where these want no more trials
            let pick = self.pick(cheapest, true).or_else(|| self.pick(cheapest, false));
            let Some((i, setting)) = pick else { return };
            let most = self.patience(i, setting, cheapest);
            self.attempt(i, setting, most);
        }
    }

    /// Who is tried next, and with what: the one that could be the cheapest.
    fn pick(&mut self, cheapest: Option<f64>, may_wait: bool) -> Option<(usize, f64)> {
        let mut pick: Option<(f64, usize, f64)> = None;
        let most_done = self.entrants.iter().map(|e| e.done().count()).max();
        let is_blind = self.best.is_none() && most_done == Some(1);
        for i in 0..self.entrants.len() {
            if self.entrants[i].out.is_some() {
                continue;
            }
            // before anything else one neighbour tells errors, unless it takes the same steps; those that follow a leader wait
            // until one has reached the goal
            let is_early = is_blind && self.entrants[i].done().next().is_none();
            if may_wait && (is_early || (cheapest.is_none() && self.follows(i))) {
                continue;
            }
            match self.next(&self.entrants[i]) {
                Next::Settled(_) => {}
                Next::Out(why) => self.entrants[i].out = Some(why),
                Next::Try(setting) => {
                    let least = self.least(i);
                    let can_win = cheapest.is_none_or(|seconds| least < seconds);
                    if can_win && pick.is_none_or(|(other, ..)| least < other) {
                        pick = Some((least, i, setting));
                    }
                }
            }
        }
        pick.map(|(_, i, setting)| (i, setting))
    }

    /// Before any reaches the wanted error: who is known, and expected to reach it first, if there is time for that; others would be
    /// looked at for long.
    fn leader(&mut self) -> Option<(usize, f64)> {
        let left = self.left();
        let of = |(i, e): (usize, &Entrant)| {
            let p = self.prediction(e)?;
            // what a high order promises is more certain, and others are not likely to come near
            let share = if is_cheap(e) { MOST } else { FOLLOWED };
            let is_near = e.tries.len() < LED && LOSING * p.point.seconds <= share * left;
            match self.next(e) {
                Next::Try(setting) if is_near => Some((i, setting, p.point.seconds)),
                _ => None,
            }
        };
        let known = self.entrants.iter().enumerate().filter(|(_, e)| e.out.is_none());
        let led = known.filter_map(of).min_by(|a, b| a.2.total_cmp(&b.2))?;
        // a small error may cost another much less: those are looked at first
        let is_unseen = |e: &Entrant| e.out.is_none() && e.tries.is_empty() && is_cheap(e);
        if let Some(i) = self.entrants.iter().position(is_unseen) {
            return Some((i, self.entrants[i].first));
        }
        Some((led.0, led.1))
    }

    /// Is there a candidate that takes about the same steps, comes first, and is not out, or only because it takes too long?
    fn follows(&self, i: usize) -> bool {
        let method = &self.entrants[i].method;
        let is_slow = |e: &Entrant| e.tries.last().is_some_and(|t| t.trial.end == End::GivenUp);
        let leaders = self.entrants[..i].iter().filter(|e| e.out.is_none() || is_slow(e));
        leaders.into_iter().any(|e| is_twin(&e.method, method))
    }

    /// What the pilot may take [s].
    pub(crate) fn budget(&self) -> f64 {
        BUDGET[0].max(BUDGET[1] * self.expected().unwrap_or(0.0))
    }

    pub(super) fn left(&mut self) -> f64 {
        self.budget() - self.bench.spent()
    }

    /// One more trial of a candidate, for at most so many seconds where another is known to take less.
    pub(super) fn attempt(&mut self, i: usize, setting: f64, most: Option<f64>) {
        let left = self.left();
        let most = most.map_or(SHARE * left, |most| most.min(left - self.beside)).max(SHORTEST);
        // a first look leaves another
        let is_last = !self.entrants[i].tries.is_empty();
        let aim = if self.wanted.deadline.is_some() { Aim::Steps } else { Aim::Rows };
        let method = self.entrants[i].method;
        let (cheapest, is_known) = (self.cheapest(), !self.entrants[i].points().is_empty());
        let begun = self.bench.spent();
        let at_last = (NEARLY * most).min(left - self.beside).max(most);
        let trial = self.bench.trial(&method, setting, aim, Time { most, at_last });
        self.beside = self.beside.max(self.bench.spent() - begun - trial.seconds);
        let entrant = &mut self.entrants[i];
        entrant.tries.retain(|t| t.trial.end != End::GivenUp);
        let whole = trial.seconds / trial.reached.max(1e-9);
        let is_given_up = trial.end == End::GivenUp;
        // who loses is out; whom only the budget stops is judged by what is known
        let is_losing = cheapest.is_some_and(|seconds| whole > LOSING * seconds);
        entrant.is_spent |= is_given_up && is_last && !is_losing && is_known;
        if is_given_up && (is_last || trial.reached <= 0.0) && !entrant.is_spent {
            entrant.out = Some(match trial.reached > 0.0 {
                true => format!("with {} it would take about {}", few(setting), duration(whole)),
                false => {
                    format!("with {} it makes no way in {}", few(setting), duration(trial.seconds))
                }
            });
        }
        entrant.take(setting, trial);
        if let (Some(deadline), Some(slowest)) = (self.wanted.deadline, entrant.slowest()) {
            let steps = (FILLED * deadline / slowest).floor();
            entrant.finest = deadline / steps.max(1.0);
            if steps < 1.0 {
                let why = format!(
                    "its slowest step takes {}, and less than twice that is left for it",
                    duration(slowest)
                );
                entrant.out.get_or_insert(why);
            }
        }
    }

    /// Errors of all trials against the best, which is chosen anew.
    pub(super) fn judge(&mut self) {
        let bench = &*self.bench;
        for entrant in &mut self.entrants {
            entrant
                .estimate(|fine: &Trial, coarse: &Trial| bench.distance(&fine.rows, &coarse.rows));
        }
        self.agree();
        let bench = &*self.bench;
        let known = self.entrants.iter().enumerate().flat_map(|(entrant, e)| {
            e.done()
                .filter_map(move |t| Some(Best { entrant, setting: t.setting, own: t.known()? }))
        });
        let best = known.min_by(|a, b| a.own.total_cmp(&b.own));
        let is_new = best != self.best;
        self.best = best;
        let Some(best) = best else { return };
        let same = |t: f64| (t - best.setting).abs() <= 0.0;
        let reference = self.entrants[best.entrant].done().find(|t| same(t.setting));
        let Some(reference) = reference.map(|t| t.trial.rows.clone()) else { return };
        for (i, entrant) in self.entrants.iter_mut().enumerate() {
            for t in entrant.tries.iter_mut().filter(|t| t.is_done()) {
                let is_best = i == best.entrant && same(t.setting);
                if is_new || t.error.is_none() {
                    let apart = bench.distance(&reference, &t.trial.rows);
                    let error = if is_best { best.own } else { apart + best.own };
                    t.error = Some(if error.is_nan() { f64::INFINITY } else { error });
                }
            }
        }
    }

    /// Where the results, or stability, hold the steps, no coarser neighbour tells an error. Two rules have different ones: where their outputs agree,
    /// that bounds both.
    fn agree(&mut self) {
        let places = self.entrants.iter().enumerate().flat_map(|(i, e)| {
            (0..e.tries.len()).filter(move |&k| e.tries[k].is_done()).map(move |k| (i, k))
        });
        let places: Vec<(usize, usize)> = places.collect();
        let is_held = |(i, k): (usize, usize)| {
            let (entrant, fine) = (&self.entrants[i], &self.entrants[i].tries[k]);
            let is_coarser = |t: &Try| t.is_done() && t.setting >= COARSER * fine.setting;
            let is_untold = entrant.method.control == Control::Own
                && fine.own.is_none()
                && entrant.tries.iter().any(is_coarser);
            is_untold || entrant.held(fine) >= HELD
        };
        let held: Vec<(usize, usize)> = places.iter().copied().filter(|p| is_held(*p)).collect();
        for (i, k) in held {
            for &(j, l) in &places {
                let (one, other) = (&self.entrants[i], &self.entrants[j]);
                let is_same = one.method.integrator == other.method.integrator;
                if is_same || (one.tries[k].is_met && other.tries[l].is_met) {
                    continue;
                }
                let rows = [&one.tries[k].trial.rows, &other.tries[l].trial.rows];
                let apart = self.bench.distance(rows[0], rows[1]).max(f64::EPSILON);
                if apart <= LOST {
                    let agreed = &mut self.entrants[i].tries[k].agreed;
                    *agreed = Some(agreed.map_or(apart, |least| least.min(apart)));
                }
            }
        }
        for (i, k) in places {
            self.entrants[i].tries[k].is_met = true;
        }
    }

    /// The error that a method is given its setting for.
    pub(super) fn aim(&self, entrant: &Entrant) -> f64 {
        self.wanted.error * AIMS[usize::from(!is_cheap(entrant))]
    }

    /// CPU time that the cheapest takes of the candidates that were seen to reach the wanted error [s].
    pub(super) fn cheapest(&self) -> Option<f64> {
        let reaches = |e: &&Entrant| e.points().iter().any(|p| p.error <= self.wanted.error);
        let known = self.entrants.iter().filter(|e| e.out.is_none()).filter(reaches);
        known.filter_map(|e| Some(self.prediction(e)?.point.seconds)).min_by(f64::total_cmp)
    }

    /// CPU time that is expected of the run, whether it was seen or not [s].
    fn expected(&self) -> Option<f64> {
        let known = self.entrants.iter().filter(|e| e.out.is_none());
        let seconds = known.filter_map(|e| Some(self.prediction(e)?.point.seconds));
        self.cheapest().or_else(|| seconds.min_by(f64::total_cmp))
    }

    /// CPU time of the fastest trial that got to the end, of some candidates [s].
    pub(super) fn fastest(&self, of: impl Fn(&Entrant) -> bool) -> Option<f64> {
        let some = self.entrants.iter().filter(|e| of(e));
        some.flat_map(|e| e.done().map(|t| t.trial.seconds)).min_by(f64::total_cmp)
    }

    /// What a candidate takes in the best case [s].
    fn least(&self, i: usize) -> f64 {
        let entrant = &self.entrants[i];
        let twins = || self.entrants.iter().filter(|e| is_twin(&e.method, &entrant.method));
        let Some(seconds) = entrant.whole_seconds() else {
            // who takes about the same steps may make each of them for less
            let of = |e: &Entrant| Some(CHEAPER * self.least_of(e, e.whole_seconds()?));
            return twins().filter_map(of).fold(0.0, f64::max);
        };
        let finest = entrant.tries.last().map_or(entrant.first, |t| t.setting);
        let of_twin = |e: &Entrant| match self.next(e) {
            Next::Settled(p) => {
                let finer = finest / p.point.setting;
                Some(TWIN * seconds * finer.powf(entrant.law().cost))
            }
            _ => None,
        };
        let of_twins = twins().filter_map(of_twin).fold(0.0, f64::max);
        self.least_of(entrant, seconds).max(of_twins)
    }

    /// The same by its own trials, of which the finest takes so many seconds.
    fn least_of(&self, entrant: &Entrant, seconds: f64) -> f64 {
        let is_partial = entrant.tries.last().is_some_and(|t| t.trial.end == End::GivenUp);
        match entrant.predict(self.aim(entrant)) {
            // what is finer may cost nothing
            Some(Prediction { basis: Basis::Finer(_), .. }) if entrant.is_held() => seconds,
            Some(Prediction { basis: Basis::Finer(factor), .. }) => {
                let held = entrant.tries.last().map_or(0.0, |t| entrant.held(t));
                seconds * entrant.law().longer(held, (0.25 * factor).max(1.0))
            }
            Some(p) => p.point.seconds / KNOWN,
            None if is_partial => seconds / KNOWN,
            None => 0.5 * seconds,
        }
    }

    /// What its trials so far say of a candidate, where that is enough.
    pub(super) fn prediction(&self, entrant: &Entrant) -> Option<Prediction> {
        let p = bounded(entrant, entrant.predict(self.aim(entrant))?);
        let seen = entrant.seen(TAKEN * self.wanted.error);
        let is_better =
            |seen: &Point| seen.seconds <= p.point.seconds || p.point.error > self.wanted.error;
        let taken = seen.filter(is_better);
        Some(taken.map_or(p, |point| Prediction { point, basis: Basis::Coarsest }))
    }

    /// What a candidate needs to be known.
    fn next(&self, entrant: &Entrant) -> Next {
        let Some(last) = entrant.tries.last() else { return Next::Try(entrant.first) };
        if let (true, Some(p)) = (entrant.is_spent, self.prediction(entrant)) {
            return Next::Settled(p);
        }
        let refine = |factor: f64| {
            entrant.fit(entrant.law().setting_for(1.0 / factor) * last.setting).max(entrant.finest)
        };
        let is_any_done = entrant.done().next().is_some();
        let leap = LEAP[usize::from(!is_cheap(entrant))];
        match &last.trial.end {
            End::NotStarted(e) => return Next::Out(format!("{}: {}", e.code, e.message)),
            End::GivenUp => return Next::Try(last.setting),
            End::Stopped(_) if !is_any_done => {
                let finer = refine(LEAP[0]);
                let is_over = entrant.tries.len() >= TRIES[1] || entrant.has_tried(finer);
                let is_at_the_start = entrant.tries.len() > 1
                    && entrant.tries.iter().all(|t| t.trial.reached <= START);
                let is_over = is_over || is_at_the_start;
                let why = entrant.stopped().unwrap_or_default();
                return if is_over { Next::Out(why) } else { Next::Try(finer) };
            }
            _ => {}
        }
        let Some(p) = self.prediction(entrant) else {
            let finer = refine(if entrant.law().cost < 1.0 { leap } else { 4.0 });
            let is_over = !is_any_done || entrant.has_tried(finer);
            return if is_over {
                Next::Out("its error is not known".into())
            } else {
                Next::Try(finer)
            };
        };
        let reaches = entrant.points().iter().any(|point| point.error <= self.wanted.error);
        if let (Some(why), false) = (entrant.stopped(), reaches) {
            return Next::Out(why);
        }
        if entrant.is_at_its_floor() && !reaches {
            let least = entrant.points().iter().map(|p| p.error).fold(f64::INFINITY, f64::min);
            return Next::Out(format!("finer settings do not bring its error below {least:.1e}"));
        }
        self.follow(entrant, p)
    }

    /// Is there a trial that errors as small as the wanted one are told against?
    fn can_tell(&self) -> bool {
        self.best.is_some_and(|best| best.own <= self.wanted.error)
    }

    /// Another trial where the prediction says, or enough.
    fn follow(&self, entrant: &Entrant, p: Prediction) -> Next {
        let law = entrant.law();
        let leap = LEAP[usize::from(!is_cheap(entrant))];
        let setting = match p.basis {
            // the way to a small error is not known from where the motion was lost, nor what is reached far off all that is known
            Basis::Finer(factor)
                if factor > leap && (self.wanted.error * factor > LOST || !self.can_tell()) =>
            {
                let finest = entrant.tries.last().map_or(p.point.setting, |t| t.setting);
                entrant.fit(finest * law.setting_for(1.0 / leap)).max(entrant.finest)
            }
            _ => p.point.setting,
        };
        let is_close = match p.basis {
            Basis::Coarsest => true,
            Basis::Between => {
                let points = entrant.points();
                let beside = |is: fn(f64, f64) -> bool| {
                    let times =
                        points.iter().filter(|q| is(q.error, p.point.error)).map(|q| q.seconds);
                    times.min_by(|a, b| {
                        let far = |t: f64| (t / p.point.seconds).ln().abs();
                        far(*a).total_cmp(&far(*b))
                    })
                };
                let (over, under) = (beside(|e, w| e > w), beside(|e, w| e <= w));
                over.zip(under).is_some_and(|(over, under)| under / over <= KNOWN * KNOWN)
            }
            Basis::Coarser(factor) => law.cost_of(factor) <= KNOWN,
            Basis::Finer(factor) => factor <= 1.0 / AIMS[1],
        };
        let is_over = entrant.tries.len() >= TRIES[0];
        if is_close || is_over || entrant.has_tried(setting) {
            Next::Settled(p)
        } else {
            Next::Try(setting)
        }
    }
}

/// Does a smaller error cost it little?
pub(super) fn is_cheap(entrant: &Entrant) -> bool {
    let law = entrant.law();
    law.cost / law.error < CHEAP
}

/// No finer than the candidate may be, and what can be had.
fn bounded(entrant: &Entrant, p: Prediction) -> Prediction {
    let setting = entrant.fit(p.point.setting).max(entrant.finest);
    let times = setting / p.point.setting;
    let law = entrant.law();
    let point = Point {
        setting,
        error: p.point.error * times.powf(law.error),
        seconds: p.point.seconds / times.powf(law.cost),
        ..p.point
    };
    Prediction { point, ..p }
}

//! Methods that the pilot tries, their order, and the results of their trials.

use super::estimate::{Basis, ERROR_RANGE, Point, PowerLaw, Prediction, SMALL, extended, predict};
use super::goal::PilotTarget;
use super::structure::Structure;
use super::trial::{Trial, TrialEnd};
use crate::compare::method::{Control, MethodCase};
use mbs::FormulationKind;

/// Ratio of a trial's step to that of the next trial [-]. With this ratio two trials show the order of a method if it is between 1 and 4, and
/// the second trial is still affordable.
const FINER_STEP: f64 = 4.0;
/// First tolerance of steps that are controlled by an error estimate [-]. A run with this tolerance takes less time than most other trials.
const FIRST_ERROR_TOLERANCE: f64 = 1e-3;
/// Largest tolerance that is tried [-]. With 0.1 the scenes rssr and iltis-stairs-stiff stop, and the number of steps is only a third
/// smaller.
const LOOSEST: f64 = 0.01;
/// Relative difference up to which two settings count as equal [-]. They differ by rounding, because the product of a number and its inverse is
/// not exactly 1.
pub(super) const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// Trial of a method, with its error where it is known.
#[derive(Debug, Clone)]
pub(crate) struct Tried {
    pub(crate) setting: f64,
    pub(crate) trial: Trial,
    /// Upper bound of the error, from the distances to trials that differ from this one. Infinite before there is such a trial.
    pub(crate) most: f64,
    /// Lower bound of the error: the largest distance from finer trials of the same method.
    pub(crate) least: f64,
    /// Error from the distance to the best trial of all.
    pub(crate) error: Option<f64>,
}

impl Tried {
    pub(crate) fn new(setting: f64, trial: Trial) -> Self {
        Self { setting, trial, most: f64::INFINITY, least: 0.0, error: None }
    }

    /// Error estimated without the best trial: the larger of its two bounds.
    ///
    /// The upper bound alone may be too small: in chaotic motion two rules with similar errors agree by chance (double-pendulum at 1e-2).
    pub(crate) fn own(&self) -> f64 {
        self.most.max(self.least)
    }
}

/// Candidate method of the pilot, with its trials.
#[derive(Debug, Clone)]
pub struct PilotCandidate {
    /// Method that is tried.
    pub method: MethodCase,
    /// Trials of the method, from the coarsest.
    pub(crate) trials: Vec<Tried>,
    /// Reason why the candidate is excluded, if it is.
    pub(crate) out: Option<String>,
    pub(crate) first: f64,
    pub(crate) coarsest: f64,
    /// Finest setting that the deadline allows; 0 without a deadline.
    pub(crate) finest: f64,
    /// True if a trial with a predicted setting missed the required error. Predictions are then ignored, and only measured errors count. This
    /// happens where the instants of the results limit the steps (quarter-car at 1e-4).
    pub(crate) has_missed: bool,
}

/// Decision on a candidate: another trial, no further trial, or exclusion.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Next {
    Try(f64),
    /// The candidate needs no further trial.
    Settled,
    Out(String),
}

/// Selects the candidates among the methods that the caller allows, and sorts them in the order of their trials.
///
/// If the scene has a spanning tree, relative coordinates come first: with integrators of their own step control, rk4 and error control. Then
/// follows index-3 with fixed steps. Without a tree, index-3 with fixed steps comes first. Then follows error control in index-3, classical and
/// state-space. If the caller asks for a formulation, all of its methods are candidates.
pub(super) fn select(
    (is_asked, has_deadline): (bool, bool),
    methods: &[MethodCase],
    structure: &Structure,
) -> Vec<MethodCase> {
    let natural =
        [FormulationKind::DEFAULT, FormulationKind::Classical, FormulationKind::StateSpace];
    let is_one = |m: &&MethodCase| {
        let is_default = m.formulation == FormulationKind::DEFAULT;
        match (m.formulation.row().relative, structure.loops.is_ok()) {
            (true, _) => has_deadline || !m.is_fixed() || m.integrator.is_explicit(),
            (false, true) => is_default && m.is_fixed(),
            (false, false) if m.is_fixed() => is_default || has_deadline,
            (false, false) => m.control == Control::Error && natural.contains(&m.formulation),
        }
    };
    let mut selected: Vec<MethodCase> = methods.iter().filter(is_one).copied().collect();
    if is_asked || selected.is_empty() {
        selected = methods.to_vec();
    }
    selected.sort_by_key(|m| (!m.formulation.row().relative, !is_own(m), !m.is_fixed()));
    selected
}

fn is_own(method: &MethodCase) -> bool {
    method.control == Control::Own
}

impl PilotCandidate {
    /// Makes a candidate without trials. With fixed steps, its first trial has a step of at most `longest` [s].
    pub fn new(method: MethodCase, target: PilotTarget, longest: f64) -> Self {
        let (first, coarsest) = match method.control {
            Control::Fixed => (longest, longest),
            // the global error is mostly smaller than the tolerance of an integrator's own step control
            Control::Own => ((target.error / SMALL).min(LOOSEST), LOOSEST),
            Control::Error | Control::Energy => (FIRST_ERROR_TOLERANCE, LOOSEST),
        };
        Self {
            method,
            trials: Vec::new(),
            out: None,
            first,
            coarsest,
            finest: 0.0,
            has_missed: false,
        }
    }

    pub(crate) fn law(&self) -> PowerLaw {
        PowerLaw::of(&self.method)
    }

    /// Returns the nearest possible setting that is no coarser than the given one. Fixed steps must divide the longest step evenly.
    pub fn fit(&self, setting: f64) -> f64 {
        let setting = setting.max(self.finest);
        if !self.method.is_fixed() {
            return setting.min(self.coarsest);
        }
        self.coarsest / (self.coarsest / setting * (1.0 - ROUNDING)).ceil().max(1.0)
    }

    /// Adds a trial, and removes trials of this candidate that were given up.
    pub(crate) fn take(&mut self, tried: Tried) {
        self.trials.retain(|t| t.trial.end != TrialEnd::GivenUp);
        let finer = |t: &Tried| t.setting < tried.setting;
        let place = self.trials.iter().position(finer).unwrap_or(self.trials.len());
        self.trials.insert(place, tried);
    }

    pub(crate) fn has_tried(&self, setting: f64) -> bool {
        self.done().any(|t| (t.setting / setting - 1.0).abs() <= ROUNDING)
    }

    pub(crate) fn done(&self) -> impl DoubleEndedIterator<Item = &Tried> {
        self.trials.iter().filter(|t| t.trial.end == TrialEnd::Done)
    }

    /// Completed trials with a known error, from the coarsest. A trial counts with at least the error of the next finer trial, since an error
    /// may be small by chance.
    pub(crate) fn points(&self) -> Vec<Point> {
        let point = |t: &Tried| {
            let Trial { steps, seconds, .. } = t.trial;
            Some(Point { setting: t.setting, error: t.error?, seconds, steps })
        };
        let mut points: Vec<Point> = self.done().filter_map(point).collect();
        for i in (1..points.len()).rev() {
            points[i - 1].error = points[i - 1].error.max(points[i].error);
        }
        points
    }

    /// Returns the cheapest trial whose error is at most `error`.
    pub(crate) fn seen(&self, error: f64) -> Option<Point> {
        let points = self.points().into_iter().filter(|p| p.error <= error);
        points.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }

    /// Predicts the setting for the target error, with its error and CPU time.
    pub(crate) fn predict(&self, target: PilotTarget) -> Option<Prediction> {
        let points = self.points();
        // a run with a coarser setting than the first completed trial would stop, or would make the same steps (guided-four-bar at 1e-6)
        let is_held = self.done().next().is_some_and(|t| self.is_held(&t.trial));
        let coarsest = match (self.trials.first(), points.first()) {
            (Some(t), Some(first)) if is_held || t.setting > first.setting => first.setting,
            _ => self.coarsest,
        };
        let p = predict(self.law(), &points, target.aim(), coarsest)?;
        // the power law is extrapolated by at most two trials beyond the finest one
        let furthest = SMALL * SMALL * points.last()?.setting;
        let setting = self.fit(p.setting.max(furthest));
        if setting <= p.setting || (self.finest <= 0.0 && p.setting >= furthest) {
            return Some(Prediction { setting, ..p });
        }
        Some(extended(points.last()?, self.law(), setting))
    }

    /// Error that is expected with a setting beyond all trials, if no trial has the required error. The error of the finest trial is
    /// extrapolated by the smallest exponent.
    pub(crate) fn expected(&self, setting: f64) -> f64 {
        let Some(last) = self.points().last().copied() else { return f64::INFINITY };
        last.error * (setting / last.setting).powf(ERROR_RANGE[0] * self.law().error)
    }

    /// True if the instants of the results limit the steps of a trial with step control. A step must end at each instant.
    pub(crate) fn is_held(&self, trial: &Trial) -> bool {
        let [steps, rows] = [trial.steps, trial.rows.len() as u64].map(|n| n as f64);
        !self.method.is_fixed() && steps * (1.0 - SMALL) <= rows
    }

    /// CPU time of a whole run with the setting of the finest trial, extrapolated from the fraction of the span that the trial reached [s].
    pub(crate) fn whole_seconds(&self) -> Option<f64> {
        let Trial { seconds, reached, .. } = self.trials.last()?.trial;
        (reached > 0.0).then(|| seconds / reached)
    }

    /// The slowest step of all trials [s].
    pub(crate) fn slowest(&self) -> Option<f64> {
        self.trials.iter().filter_map(|t| t.trial.slowest).reduce(f64::max)
    }

    /// True if the candidate is not excluded and its finest trial completed.
    pub(crate) fn may_continue(&self) -> bool {
        self.out.is_none() && self.trials.last().is_some_and(|t| t.trial.end == TrialEnd::Done)
    }

    /// Returns a setting that is finer than those of all trials, if there is one.
    pub(crate) fn finer(&self) -> Option<f64> {
        let last = self.trials.last()?.setting;
        let finer = self.fit(if self.method.is_fixed() { last / FINER_STEP } else { SMALL * last });
        (finer < last).then_some(finer)
    }

    /// Decides whether the candidate gets another trial, needs none, or is excluded.
    pub(crate) fn next(&self, target: PilotTarget) -> Next {
        let Some(last) = self.trials.last() else { return Next::Try(self.fit(self.first)) };
        let finer = self.finer().unwrap_or(last.setting);
        match &last.trial.end {
            TrialEnd::NotStarted(e) => return Next::Out(format!("{}: {}", e.code, e.message)),
            TrialEnd::GivenUp => return Next::Try(last.setting),
            TrialEnd::Stopped(e) => {
                let before = self.trials.len().checked_sub(2).map(|i| &self.trials[i].trial);
                let is_worse = before.is_some_and(|t| t.reached >= last.trial.reached);
                if self.seen(target.error).is_some() {
                    return Next::Settled;
                }
                if is_worse || self.has_tried(finer) {
                    let time = mbs_scene::format::few(e.time);
                    let setting = mbs_scene::format::few(last.setting);
                    return Next::Out(format!("{} at t = {time} s with {setting}", e.code));
                }
                return Next::Try(finer);
            }
            TrialEnd::Done => {}
        }
        let Some(p) = self.predict(target) else {
            return if finer < last.setting { Next::Try(finer) } else { Next::Settled };
        };
        let setting = p.setting.max(finer);
        let is_known = self.is_settled(target) || p.basis == Basis::Between;
        if is_known || self.has_tried(setting) { Next::Settled } else { Next::Try(setting) }
    }

    /// True if a trial has an error close to the target, or if coarser settings would not reduce the number of steps.
    pub(crate) fn is_settled(&self, target: PilotTarget) -> bool {
        let points = self.points();
        let is_near = |p: &Point| p.error <= target.error && p.error >= 0.5 * target.aim();
        let is_held = |t: &Tried| self.is_held(&t.trial);
        let is_alike = matches!(points[..], [a, b, ..] if a.steps >= b.steps);
        let is_low = points.first().is_some_and(|p| p.error <= target.error);
        points.iter().any(is_near)
            || (is_low && (is_alike || self.done().next().is_some_and(is_held)))
    }
}

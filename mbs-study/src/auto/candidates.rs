//! The methods that the pilot tries, in their order, and what its trials say of each.

use super::estimate::{Basis, ERROR_RANGE, Point, PowerLaw, Prediction, SMALL, extended, predict};
use super::goal::PilotTarget;
use super::structure::Structure;
use super::trial::{Trial, TrialEnd};
use crate::compare::method::{Control, MethodCase};
use mbs::FormulationKind;

/// The next trial has a step that is shorter by this factor [-]: two points of a law of order 1 to 4, and a time that may still be had.
const FINER_STEP: f64 = 4.0;
/// First tolerance of steps that are controlled by an estimate of the error [-]: such a run takes less time than most.
const FIRST_ERROR_TOLERANCE: f64 = 1e-3;
/// No tolerance is larger [-]: rssr and iltis-stairs-stiff stop with 0.1, and steps are a third shorter only.
const LOOSEST: f64 = 0.01;
/// Ratio of two settings, less one, up to which they are the same [-]: a quotient and its inverse round.
pub(super) const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// A trial, and its error where it is known.
#[derive(Debug, Clone)]
pub(crate) struct Tried {
    pub(crate) setting: f64,
    pub(crate) trial: Trial,
    /// Error by distances from trials that differ from this one, each a bound from above; infinite before there is one.
    pub(crate) most: f64,
    /// Largest distance from finer trials of the same method, each a bound of the error from below.
    pub(crate) least: f64,
    /// Error by the distance from the best trial.
    pub(crate) error: Option<f64>,
}

impl Tried {
    pub(crate) fn new(setting: f64, trial: Trial) -> Self {
        Self { setting, trial, most: f64::INFINITY, least: 0.0, error: None }
    }

    /// Error without a better trial: the larger of its bounds.
    ///
    /// The larger bound counts: two rules that lose a chaotic motion along the same direction agree by chance (double-pendulum at 1e-2).
    pub(crate) fn own(&self) -> f64 {
        self.most.max(self.least)
    }
}

/// A method in the pilot.
#[derive(Debug, Clone)]
pub struct PilotCandidate {
    /// Method that is tried.
    pub method: MethodCase,
    /// Trials of the method, from the coarsest.
    pub(crate) trials: Vec<Tried>,
    /// Reason why the candidate is out.
    pub(crate) out: Option<String>,
    pub(crate) first: f64,
    pub(crate) coarsest: f64,
    /// The finest setting that a deadline leaves it; 0 without one.
    pub(crate) finest: f64,
    /// Did a trial with a predicted setting miss the required error? Then only what was seen counts (quarter-car at 1e-4, where the results hold
    /// the steps).
    pub(crate) has_missed: bool,
}

/// Next need of a candidate: another trial, none, or to be left out.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Next {
    Try(f64),
    /// Enough is known of it.
    Settled,
    Out(String),
}

/// The candidates among the methods that the caller leaves, in the order in which they are tried.
///
/// With a tree: integrators that control their own steps, rk4, and error control in relative coordinates, then index-3. Without one:
/// index-3, then error control in index-3, classical and state-space. All methods of a formulation that is asked for.
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
    /// A candidate that is tried first with steps of at most `longest` [s], if they are fixed.
    pub fn new(method: MethodCase, target: PilotTarget, longest: f64) -> Self {
        let (first, coarsest) = match method.control {
            Control::Fixed => (longest, longest),
            // errors of controlled steps are mostly smaller than their tolerance
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

    /// The setting that can be had, no coarser than the one asked for: a whole number of steps makes the longest.
    pub fn fit(&self, setting: f64) -> f64 {
        let setting = setting.max(self.finest);
        if !self.method.is_fixed() {
            return setting.min(self.coarsest);
        }
        self.coarsest / (self.coarsest / setting * (1.0 - ROUNDING)).ceil().max(1.0)
    }

    /// Takes a trial in; one that was given up before is forgotten.
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

    /// Completed trials whose error is known, from the coarsest. An error that is small by chance does not count: none is smaller than that
    /// of the next finer one.
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

    /// The cheapest trial that has an error.
    pub(crate) fn seen(&self, error: f64) -> Option<Point> {
        let points = self.points().into_iter().filter(|p| p.error <= error);
        points.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }

    /// The setting for the error that is aimed at, and what is expected of it.
    pub(crate) fn predict(&self, target: PilotTarget) -> Option<Prediction> {
        let points = self.points();
        // nothing coarser than the first that completes is taken where it has stopped, or would make the same steps (guided-four-bar at 1e-6)
        let is_held = self.done().next().is_some_and(|t| self.is_held(&t.trial));
        let coarsest = match (self.trials.first(), points.first()) {
            (Some(t), Some(first)) if is_held || t.setting > first.setting => first.setting,
            _ => self.coarsest,
        };
        let p = predict(self.law(), &points, target.aim(), coarsest)?;
        // a law is taken two trials beyond the last
        let furthest = SMALL * SMALL * points.last()?.setting;
        let setting = self.fit(p.setting.max(furthest));
        if setting <= p.setting || (self.finest <= 0.0 && p.setting >= furthest) {
            return Some(Prediction { setting, ..p });
        }
        Some(extended(points.last()?, self.law(), setting))
    }

    /// The error that may be expected beyond all trials, none of which has the required one: that of the finest by the slowest law.
    pub(crate) fn expected(&self, setting: f64) -> f64 {
        let Some(last) = self.points().last().copied() else { return f64::INFINITY };
        last.error * (setting / last.setting).powf(ERROR_RANGE[0] * self.law().error)
    }

    /// Do the instants of the results hold the steps of a trial whose steps are controlled?
    pub(crate) fn is_held(&self, trial: &Trial) -> bool {
        let [steps, rows] = [trial.steps, trial.rows.len() as u64].map(|n| n as f64);
        !self.method.is_fixed() && steps * (1.0 - SMALL) <= rows
    }

    /// CPU time of a whole run with the finest setting tried, by the fraction that was reached [s].
    pub(crate) fn whole_seconds(&self) -> Option<f64> {
        let Trial { seconds, reached, .. } = self.trials.last()?.trial;
        (reached > 0.0).then(|| seconds / reached)
    }

    /// The slowest step of all trials [s].
    pub(crate) fn slowest(&self) -> Option<f64> {
        self.trials.iter().filter_map(|t| t.trial.slowest).reduce(f64::max)
    }

    /// Is it not out, and did its finest trial complete?
    pub(crate) fn may_continue(&self) -> bool {
        self.out.is_none() && self.trials.last().is_some_and(|t| t.trial.end == TrialEnd::Done)
    }

    /// A setting that is finer than all trials, if there is one.
    pub(crate) fn finer(&self) -> Option<f64> {
        let last = self.trials.last()?.setting;
        let finer = self.fit(if self.method.is_fixed() { last / FINER_STEP } else { SMALL * last });
        (finer < last).then_some(finer)
    }

    /// Returns what the candidate needs next to be known.
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

    /// Does a trial nearly have the error that is aimed at, or no coarser one take fewer steps?
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

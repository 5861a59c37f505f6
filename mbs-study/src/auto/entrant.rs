//! A candidate in the pilot: its method, its trials, what is known of their errors.

use super::law::{HELD, Law, Point, Prediction, credited, predict};
use super::trial::{End, Trial};
use crate::compare::method::{Control, MethodCase};

/// Errors above this share of the outputs' ranges have lost the motion: what they become at finer settings is not to be told.
pub(super) const LOST: f64 = 0.1;
/// The finer of two neighbours is believed to be better by no more than this factor.
const BETTER: f64 = 100.0;
/// Settings are not as close as this factor to a coarser one that stopped.
const CLEAR: f64 = 1.5;
/// Where the instants of the results end no more than this share of the steps, the others alone tell how much finer they are.
const FEW: f64 = 0.5;
/// A trial is coarser in earnest if it has no more than this share of the steps.
const COARSER: f64 = 0.95;
/// A setting is tried if it differs from those that were by more than this share.
const SAME: f64 = 0.02;

/// A trial, and its error as far as it is known.
#[derive(Debug, Clone)]
pub(crate) struct Try {
    pub(crate) setting: f64,
    pub(crate) trial: Trial,
    /// Its error by the distance of its coarser neighbour.
    pub(crate) own: Option<f64>,
    /// Its least distance from a trial with another rule, where the results hold its steps; has it met all that there are?
    pub(crate) agreed: Option<f64>,
    pub(crate) is_met: bool,
    /// Its error against the best of all trials.
    pub(crate) error: Option<f64>,
}

impl Try {
    pub(crate) fn is_done(&self) -> bool {
        self.trial.end == End::Done
    }

    /// Its error as far as it is known without a better trial.
    pub(crate) fn known(&self) -> Option<f64> {
        self.own.into_iter().chain(self.agreed).reduce(f64::min)
    }
}

/// A candidate.
#[derive(Debug, Clone)]
pub(crate) struct Entrant {
    pub(crate) method: MethodCase,
    /// From the coarsest.
    pub(crate) tries: Vec<Try>,
    /// Why it is out.
    pub(crate) out: Option<String>,
    /// The setting that it is given first, and the coarsest there is.
    pub(crate) first: f64,
    pub(crate) coarsest: f64,
    /// The finest setting that it is allowed; 0 where all are.
    pub(crate) finest: f64,
    /// The pilot has no time for another trial of it.
    pub(crate) is_spent: bool,
}

/// A step is no longer than this share more than what is asked for.
const ROUNDING: f64 = 1e-9;

impl Entrant {
    pub(crate) fn new(method: MethodCase, first: f64, coarsest: f64) -> Self {
        Self { method, tries: Vec::new(), out: None, first, coarsest, finest: 0.0, is_spent: false }
    }

    pub(crate) fn law(&self) -> Law {
        Law::of(&self.method)
    }

    /// The setting that can be had, no coarser than the one asked for: a whole number of steps makes the longest.
    pub(crate) fn fit(&self, setting: f64) -> f64 {
        if !self.method.is_fixed() {
            return setting.min(self.coarsest);
        }
        self.coarsest / (self.coarsest / setting * (1.0 - ROUNDING)).ceil().max(1.0)
    }

    /// Takes a trial in.
    pub(crate) fn take(&mut self, setting: f64, trial: Trial) {
        let place = self.tries.iter().position(|t| t.setting < setting).unwrap_or(self.tries.len());
        self.tries.insert(
            place,
            Try { setting, trial, own: None, agreed: None, is_met: false, error: None },
        );
    }

    /// Was a setting tried that is about the same?
    pub(crate) fn has_tried(&self, setting: f64) -> bool {
        self.tries.iter().any(|t| (t.setting / setting - 1.0).abs() <= SAME)
    }

    pub(crate) fn done(&self) -> impl DoubleEndedIterator<Item = &Try> {
        self.tries.iter().filter(|t| t.is_done())
    }

    /// Estimates the own error of every completed trial by those that are coarser and have fewer steps, each of which bounds it: where
    /// finer settings change nothing, the intervals of the results hold the steps, and nothing is told.
    ///
    /// ```text
    /// e = d r/(1 - r),   r = (steps of the coarse / of the fine)^order,   but not less than d/100, and d where the motion is lost
    /// ```
    ///
    /// Of controlled steps of second order, those that end at instants of the results are in both, and are not counted where they are the
    /// fewer; r is then not less than the tolerances say.
    pub(crate) fn estimate(&mut self, distance: impl Fn(&Trial, &Trial) -> f64) {
        let order = Law::order(&self.method);
        let done: Vec<usize> = (0..self.tries.len()).filter(|&i| self.tries[i].is_done()).collect();
        for (k, &i) in done.iter().enumerate() {
            let fine = &self.tries[i];
            let fewer =
                |&j: &usize| count(self.tries[j].trial.steps) / count(fine.trial.steps.max(1));
            if fine.own.is_some() {
                continue;
            }
            let ratio = |j: &usize| {
                let coarse = &self.tries[*j];
                let is_free = self.method.control == Control::Error && self.held(fine) <= FEW;
                let rows = if is_free { fine.trial.rows.len() as u64 } else { 0 };
                let free = |t: &Try| count(t.trial.steps.saturating_sub(rows));
                let told = (fine.setting / coarse.setting).powf(self.law().error);
                let counted = (free(coarse) / free(fine).max(1.0)).powf(order);
                if is_free { counted.max(told) } else { counted }
            };
            let own = |&j: &usize| {
                let d = distance(&fine.trial, &self.tries[j].trial);
                let r = ratio(&j);
                let share = if d > LOST { 1.0 } else { (r / (1.0 - r)).max(1.0 / BETTER) };
                // outputs that agree to the last digit have its error
                (d * share).max(f64::EPSILON)
            };
            let coarser = done[..k].iter().filter(|j| fewer(j) <= COARSER);
            let least = coarser.map(own).reduce(f64::min);
            self.tries[i].own = least;
        }
    }

    /// Completed trials whose error is known, from the coarsest.
    pub(crate) fn points(&self) -> Vec<Point> {
        let point = |t: &Try| {
            let Trial { steps, seconds, .. } = t.trial;
            let held = self.held(t);
            Some(Point { setting: t.setting, steps, error: t.error?, seconds, held })
        };
        self.done().filter_map(point).collect()
    }

    /// What an error takes, if anything is known.
    pub(crate) fn predict(&self, wanted: f64) -> Option<Prediction> {
        predict(&self.law(), &self.points(), wanted, self.limit())
    }

    /// The cheapest trial with no more than an error.
    pub(crate) fn seen(&self, error: f64) -> Option<Point> {
        let points = self.points();
        let reaches = (0..points.len()).map(|i| credited(&points, i)).filter(|p| p.error <= error);
        reaches.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
    }

    /// Do the instants of the results hold the steps of the next coarser trial? Its error is then far from where the law begins, and
    /// nothing is interpolated from it.
    pub(crate) fn is_beside_held(&self, setting: f64) -> bool {
        let coarser = self.points().into_iter().rfind(|p| p.setting > setting);
        !self.has_tried(setting) && coarser.is_some_and(|p| p.held >= HELD)
    }

    /// The coarsest setting that may run: well below one that stopped.
    fn limit(&self) -> f64 {
        let coarsest_done = self.done().next().map_or(0.0, |t| t.setting);
        let is_stop = |t: &&Try| matches!(t.trial.end, End::Stopped(_));
        let stopped = self.tries.iter().filter(is_stop).map(|t| t.setting);
        let coarser = stopped.filter(|s| *s > coarsest_done).fold(f64::INFINITY, f64::min);
        (coarser / CLEAR).max(coarsest_done).min(self.coarsest)
    }

    /// Its largest and its finest error do not differ over two refinements: rounding, or another motion.
    pub(crate) fn is_at_its_floor(&self) -> bool {
        let mut points = self.points();
        // the instants of the results hold the steps: a finer setting has not been seen yet
        points.dedup_by(|fine, coarse| {
            fine.steps == coarse.steps && fine.error.to_bits() == coarse.error.to_bits()
        });
        let [.., a, b, c] = &points[..] else { return false };
        let fell = |coarse: &Point, fine: &Point| fine.error < 0.7 * coarse.error;
        a.error < LOST && !fell(a, b) && !fell(b, c) && a.setting > 2.0 * c.setting
    }

    /// CPU time of a run to the end with the finest setting tried, by the share that was reached [s].
    pub(crate) fn whole_seconds(&self) -> Option<f64> {
        let finest = self.tries.last()?;
        let reached = finest.trial.reached;
        (reached > 0.0).then(|| finest.trial.seconds / reached)
    }

    /// It controls its own steps, and those of its finest trial are no matter of its tolerance yet.
    pub(crate) fn is_held(&self) -> bool {
        self.method.control == Control::Own && self.tries.last().is_some_and(|t| t.trial.is_held())
    }

    /// Share of the steps of a trial with controlled steps that end at the instants of its rows.
    pub(crate) fn held(&self, t: &Try) -> f64 {
        let rows = if self.method.is_fixed() { 0 } else { t.trial.rows.len() as u64 };
        (count(rows) / count(t.trial.steps.max(1))).min(1.0)
    }

    /// The slowest step of all trials [s].
    pub(crate) fn slowest(&self) -> Option<f64> {
        self.tries.iter().filter_map(|t| t.trial.slowest).reduce(f64::max)
    }

    /// The stop of the finest trial.
    pub(crate) fn stopped(&self) -> Option<String> {
        let last = self.tries.last()?;
        match &last.trial.end {
            End::Stopped(e) | End::NotStarted(e) => Some(format!(
                "{} at t = {} s with {}",
                e.code,
                mbs_scene::format::few(e.time),
                mbs_scene::format::few(last.setting)
            )),
            _ => None,
        }
    }
}

/// The same rule in coordinates of the same kind: they need about the same steps.
pub(super) fn is_twin(a: &MethodCase, b: &MethodCase) -> bool {
    let is_same = a.formulation == b.formulation;
    let is_controlled = |m: &MethodCase| m.control != Control::Fixed;
    !is_same
        && a.integrator == b.integrator
        && is_controlled(a) == is_controlled(b)
        && (a.control == b.control)
        && is_relative(a) == is_relative(b)
}

pub(super) fn is_relative(method: &MethodCase) -> bool {
    method.formulation.row().relative
}

#[allow(clippy::cast_precision_loss, reason = "counts stay far below 2^53")]
fn count(n: u64) -> f64 {
    n as f64
}

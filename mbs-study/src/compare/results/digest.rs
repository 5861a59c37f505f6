//! Evaluation of the runs: orders, times at an error, and ranks.

use super::data::{Comparison, MethodRuns, Rank, RankLevel, RunEntry, Status};
use super::{fit, front, rank};

/// Error below which a run is marked as not resolved, in units of the reference's uncertainty [-]. Chosen, not tuned.
const MIN_RESOLVED: f64 = 3.0;
/// Largest ratio to the fastest time of a formulation at which a method may still be the fastest after more timings [-]. Chosen, not tuned.
const NEARLY: f64 = 1.15;
/// Inverse of the relative difference up to which two numbers of steps are equal: a fiftieth. Chosen, not tuned.
const SAME_COUNT: u64 = 50;

impl Comparison {
    /// Smallest error that the reference resolves.
    #[must_use]
    pub fn floor(&self) -> f64 {
        MIN_RESOLVED * self.reference.uncertainty
    }

    /// Computes all results that follow from the runs: shortest times, marks, orders, and the ranking at the given errors.
    pub fn digest(&mut self, levels: &[f64]) {
        let (floor, instants) = (self.floor(), self.instants as u64);
        for method in &mut self.methods {
            for run in &mut method.runs {
                run.cpu_least = run.cpu_seconds.iter().copied().min_by(f64::total_cmp);
                run.is_below_reference = run.error.is_some_and(|error| error < floor);
            }
            method.fit = fit::fit(&method.errors(), floor);
            let at = |level: &f64| {
                Some(method.at_error(*level, instants).filter(|_| *level >= floor)?[0])
            };
            method.at_error = levels.iter().map(at).collect();
        }
        self.ranking = levels.iter().map(|level| self.ranked(*level)).collect();
    }

    /// Returns the runs whose times decide the ranking at these errors, each by the indices of its method and of the run. They are the runs
    /// around a ranked error. They belong to the fastest method of a formulation and integrator, or to methods that are nearly as fast.
    #[must_use]
    pub fn decisive(&self, levels: &[f64]) -> Vec<(usize, usize)> {
        let mut runs = Vec::new();
        for &level in levels.iter().filter(|level| **level >= self.floor()) {
            let times: Vec<Option<f64>> = self
                .methods
                .iter()
                .map(|m| Some(m.at_error(level, self.instants as u64)?[0]))
                .collect();
            for (m, method) in self.methods.iter().enumerate() {
                let same =
                    self.methods.iter().zip(&times).filter(|(o, _)| o.family() == method.family());
                let best = same.filter_map(|(_, time)| *time).fold(f64::INFINITY, f64::min);
                if times[m].is_some_and(|time| time <= NEARLY * best) {
                    runs.extend(method.beside(level).into_iter().map(|(r, _)| (m, r)));
                }
            }
        }
        runs.sort_unstable();
        runs.dedup();
        runs
    }

    fn ranked(&self, level: f64) -> RankLevel {
        let floor = self.floor();
        if level < floor {
            let note = format!("the reference resolves errors of {floor:.1e} and more only");
            return RankLevel { error: level, note: Some(note), ..RankLevel::default() };
        }
        let (mut reached, mut not_reached) = (Vec::<Rank>::new(), Vec::<String>::new());
        for method in &self.methods {
            let name = method.family();
            let Some([least, second]) = method.at_error(level, self.instants as u64) else {
                if !not_reached.contains(&name) {
                    not_reached.push(name);
                }
                continue;
            };
            let noise = second / least - 1.0;
            let found = Rank { rank: 0, name, method: method.name.clone(), seconds: least, noise };
            match reached.iter_mut().find(|rank| rank.name == found.name) {
                Some(best) if best.seconds <= least => {}
                Some(best) => *best = found,
                None => reached.push(found),
            }
        }
        not_reached.retain(|name| !reached.iter().any(|rank| rank.name == *name));
        let ranks = rank::rank(reached);
        RankLevel { error: level, note: None, apart: rank::APART, ranks, not_reached }
    }
}

impl MethodRuns {
    /// Name of the formulation, and of the integrator unless it is the trapezoidal rule.
    #[must_use]
    pub fn family(&self) -> String {
        match self.integrator.as_str() {
            "trapezoidal" => self.formulation.clone(),
            other => format!("{} {other}", self.formulation),
        }
    }

    /// Completed runs, from the coarsest.
    pub fn completed(&self) -> impl Iterator<Item = &RunEntry> {
        self.runs.iter().filter(|run| run.status == Status::Completed)
    }

    /// Mean step and error of the completed runs, from the longest step.
    pub(super) fn errors(&self) -> Vec<(f64, f64)> {
        let points = self.completed().filter_map(|run| Some((run.mean_step, run.error?)));
        points.filter(|(h, e)| *h > 0.0 && *e > 0.0).collect()
    }

    /// Shortest and second shortest CPU time at an error. `instants` is the number of instants of the results.
    fn at_error(&self, level: f64, instants: u64) -> Option<[f64; 2]> {
        let (places, points): (Vec<usize>, Vec<front::Point<2>>) = self.timed().unzip();
        let has_between = |coarse: usize, fine: usize| {
            self.has_between([places[coarse], places[fine]].map(|i| self.runs[i].steps), instants)
        };
        front::at_error(&points, level, has_between)
    }

    /// Shortest CPU time at an error [s]. `instants` is the number of instants of the results. `None` if no timed run reaches the error.
    #[must_use]
    pub fn seconds_at(&self, level: f64, instants: u64) -> Option<f64> {
        Some(self.at_error(level, instants)?[0])
    }

    /// Returns the method with only its timed runs around an error, to be timed again. Each run has no times, and at least the error of the
    /// next finer run.
    #[must_use]
    pub fn beside_alone(&self, level: f64) -> Self {
        let untimed = |(i, error): (usize, f64)| RunEntry {
            error: Some(error),
            cpu_seconds: Vec::new(),
            ..self.runs[i].clone()
        };
        Self { runs: self.beside(level).into_iter().map(untimed).collect(), ..self.clone() }
    }

    /// True if a run is possible that has more steps than the coarse run and fewer than the fine run. Fixed steps must divide the intervals of
    /// the results. If the intervals limit an integrator's own steps, the number of steps changes in jumps with the tolerance.
    #[doc(hidden)]
    #[must_use]
    pub fn has_between(&self, [coarse, fine]: [u64; 2], instants: u64) -> bool {
        match self.control.as_str() {
            "fixed" => coarse / instants.max(1) * instants.max(1) + instants < fine,
            "own" => fine > coarse + coarse / SAME_COUNT,
            _ => true,
        }
    }

    /// Indices of the runs around an error. Each run has at least the error of the next finer run.
    fn beside(&self, level: f64) -> Vec<(usize, f64)> {
        let (places, errors): (Vec<usize>, Vec<f64>) =
            self.timed().map(|(i, (error, _))| (i, error)).unzip();
        let beside = front::beside(&errors, level);
        let both = beside.into_iter().flat_map(|b| b.misses.into_iter().chain([b.reaches]));
        both.map(|i| (places[i], front::credited(&errors, i))).collect()
    }

    /// Completed runs that were timed, from the coarsest, with their indices.
    fn timed(&self) -> impl Iterator<Item = (usize, front::Point<2>)> {
        let runs = self.runs.iter().enumerate();
        let completed = runs.filter(|(_, run)| run.status == Status::Completed);
        completed.filter_map(|(i, run)| Some((i, (run.error?, run.two_least()?))))
    }
}

impl RunEntry {
    /// Shortest and second shortest CPU time; the same number twice if there is only one.
    #[must_use]
    pub fn two_least(&self) -> Option<[f64; 2]> {
        let mut times = self.cpu_seconds.clone();
        times.sort_by(f64::total_cmp);
        let least = *times.first()?;
        (least > 0.0).then(|| [least, times.get(1).copied().unwrap_or(least)])
    }
}

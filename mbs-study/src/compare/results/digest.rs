//! What follows from the runs: orders, times at an error, ranks.

use super::data::{Comparison, MethodRuns, Rank, RankLevel, RunEntry, Status};
use super::{fit, front, rank};

/// Error below which an entry is marked, in units of the reference's uncertainty [-]. Chosen, not tuned.
const MIN_RESOLVED: f64 = 3.0;
/// Ratio of times up to which a method may be the fastest of its formulation [-]. Chosen, not tuned.
const NEARLY: f64 = 1.15;
/// Inverse of the relative difference of counts of steps that are the same: a fiftieth. Chosen, not tuned.
const SAME_COUNT: u64 = 50;

impl Comparison {
    /// The least error that the reference resolves.
    #[must_use]
    pub fn floor(&self) -> f64 {
        MIN_RESOLVED * self.reference.uncertainty
    }

    /// Fills in what follows from the runs: least times, marks, orders, and the ranking at the errors given.
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

    /// The runs whose times decide the ranking at these errors, by method and run. They are those beside an error, of methods that are, or
    /// may well be, the fastest of their formulation and integrator.
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
    /// Formulation, and the integrator where it is not the trapezoidal rule.
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

    /// Least and second CPU time at an error, of runs whose results have this many instants.
    fn at_error(&self, level: f64, instants: u64) -> Option<[f64; 2]> {
        let (places, points): (Vec<usize>, Vec<front::Point<2>>) = self.timed().unzip();
        let has_between = |coarse: usize, fine: usize| {
            self.has_between([places[coarse], places[fine]].map(|i| self.runs[i].steps), instants)
        };
        front::at_error(&points, level, has_between)
    }

    /// Least CPU time at an error [s], of runs whose results have this number of instants; nothing where no timed run reaches it.
    #[must_use]
    pub fn seconds_at(&self, level: f64, instants: u64) -> Option<f64> {
        Some(self.at_error(level, instants)?[0])
    }

    /// The same method with its timed runs beside an error alone, each with the error that it counts with, whose times are left out:
    /// to be timed again.
    #[must_use]
    pub fn beside_alone(&self, level: f64) -> Self {
        let untimed = |(i, error): (usize, f64)| RunEntry {
            error: Some(error),
            cpu_seconds: Vec::new(),
            ..self.runs[i].clone()
        };
        Self { runs: self.beside(level).into_iter().map(untimed).collect(), ..self.clone() }
    }

    /// Is there a run with more steps than the coarse one of two and fewer than the fine one? Fixed steps are whole parts of the
    /// intervals of the results; where these hold an integrator's own steps, its tolerance changes the order, by stairs.
    fn has_between(&self, [coarse, fine]: [u64; 2], instants: u64) -> bool {
        match self.control.as_str() {
            "fixed" => coarse / instants.max(1) * instants.max(1) + instants < fine,
            "own" => fine > coarse + coarse / SAME_COUNT,
            _ => true,
        }
    }

    /// Indices of the runs beside an error, each with the error that it counts with.
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
    /// The least and the second CPU time; the same where there is one.
    #[must_use]
    pub fn two_least(&self) -> Option<[f64; 2]> {
        let mut times = self.cpu_seconds.clone();
        times.sort_by(f64::total_cmp);
        let least = *times.first()?;
        (least > 0.0).then(|| [least, times.get(1).copied().unwrap_or(least)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::results::Reference;

    /// Second order at 1 us a step of 10 s, times `cost`.
    fn method(formulation: &str, control: &str, cost: f64) -> MethodRuns {
        let run = |k: i32| {
            let h = 0.01 * f64::powi(0.5, k);
            let seconds = cost * 1e-6 * 10.0 / h;
            RunEntry {
                setting: h,
                mean_step: h,
                status: Status::Completed,
                steps: (10.0 / h).round() as u64,
                error: Some(10.0 * h * h),
                cpu_seconds: vec![1.03 * seconds, seconds, 1.2 * seconds],
                ..RunEntry::default()
            }
        };
        MethodRuns {
            name: format!("{formulation} {control}"),
            formulation: formulation.to_owned(),
            integrator: "trapezoidal".to_owned(),
            control: control.to_owned(),
            runs: (0..8).map(run).collect(),
            ..MethodRuns::default()
        }
    }

    #[test]
    fn nothing_lies_between_runs_whose_steps_the_results_hold() {
        let has = |control: &str, steps, instants| {
            MethodRuns { control: control.to_owned(), ..MethodRuns::default() }
                .has_between(steps, instants)
        };
        assert!(!has("fixed", [200, 400], 200) && has("fixed", [200, 600], 200));
        assert!(has("fixed", [400, 800], 200) && has("fixed", [200, 400], 50));
        assert!(!has("own", [203, 205], 200) && has("own", [203, 230], 200));
        assert!(has("error", [203, 205], 200));
    }

    #[test]
    fn a_formulation_is_ranked_by_its_fastest_control() {
        let methods = vec![
            method("index-3", "fixed", 2.0),
            method("index-3", "error", 1.0),
            method("slow", "fixed", 4.0),
        ];
        let mut comparison = Comparison { methods, ..Comparison::default() };
        comparison.digest(&[1e-3, 1e-5, 1e-9]);
        let ranks = |level: usize| -> Vec<(usize, &str)> {
            comparison.ranking[level].ranks.iter().map(|r| (r.rank, r.method.as_str())).collect()
        };
        assert_eq!(ranks(0), [(1, "index-3 error"), (2, "slow fixed")]);
        assert_eq!(ranks(1), ranks(0));
        assert_eq!(comparison.ranking[2].not_reached, ["index-3", "slow"]);
        assert!((comparison.methods[0].fit.as_ref().unwrap().order.unwrap() - 2.0).abs() < 1e-9);
        // 1e-3 lies at the first run; beside 1e-5, at h = 1e-3, are the fourth and the fifth
        assert_eq!(
            comparison.decisive(&[1e-3, 1e-5]),
            [(1, 0), (1, 3), (1, 4), (2, 0), (2, 3), (2, 4)]
        );
        let mut alone = comparison.methods[1].beside_alone(1e-5);
        assert_eq!((alone.runs.len(), alone.seconds_at(1e-5, 0)), (2, None));
        // all take twice as long as they did
        alone.runs.iter_mut().for_each(|run| run.cpu_seconds.push(2e-5 / run.setting));
        assert!((alone.seconds_at(1e-5, 0).unwrap() - 0.02).abs() < 1e-9);
        // h = 1e-3 at an error of 1e-5
        assert!((comparison.methods[0].at_error[1].unwrap() - 0.02).abs() < 1e-9);
    }

    #[test]
    fn runs_that_are_timed_again_count_with_the_errors_they_counted_with() {
        let mut lucky = method("index-3", "error", 1.0);
        lucky.runs[2].error = Some(1e-9);
        let alone = lucky.beside_alone(1e-4);
        let errors: Vec<f64> = alone.runs.iter().map(|run| run.error.unwrap()).collect();
        assert_eq!(errors, [lucky.runs[1].error.unwrap(), lucky.runs[3].error.unwrap()]);
        let mut again = alone;
        for (run, i) in again.runs.iter_mut().zip([1, 2]) {
            run.cpu_seconds.clone_from(&lucky.runs[i].cpu_seconds);
        }
        assert_eq!(again.seconds_at(1e-4, 0), lucky.seconds_at(1e-4, 0));
    }

    #[test]
    fn errors_that_the_reference_cannot_resolve_are_marked_and_not_ranked() {
        let reference = Reference { uncertainty: 1e-6, ..Reference::default() };
        let methods = vec![method("index-3", "fixed", 1.0)];
        let mut comparison = Comparison { reference, methods, ..Comparison::default() };
        comparison.digest(&[1e-3, 2e-6]);
        assert!(comparison.ranking[1].note.is_some() && comparison.ranking[1].ranks.is_empty());
        let marked: Vec<bool> =
            comparison.methods[0].runs.iter().map(|run| run.is_below_reference).collect();
        assert_eq!(marked, [false, false, false, false, false, true, true, true]);
    }
}

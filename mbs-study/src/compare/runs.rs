//! Recorded runs of every method, from the coarsest setting to the finest.

use super::course::Course;
use super::ladder::Instants;
use super::method::MethodCase;
use super::reference::Known;
use super::store::ResultStore;
use super::{CompareError, Study, Watch};
use crate::compare::results::{MethodRuns, RunEntry, Status};
use serde::{Deserialize, Serialize};

/// Error below which a finer setting may bring no improvement because of rounding, relative to the outputs' ranges [-]. Chosen, not tuned.
const GOOD: f64 = 1e-2;
/// Number of finer settings in a row without a smaller error, after which the refinement ends. Chosen, not tuned.
const NO_BETTER: u32 = 2;
/// Start and length of recording in the progress bar, as fractions of it [-].
const RECORDING: [f64; 2] = [0.05, 0.3];

/// Facts about a method while its settings are refined.
#[derive(Debug, Default)]
pub struct Refinement {
    /// Nominal time, CPU time and setting of the last completed run.
    last: Option<(f64, f64, f64)>,
    best: Option<f64>,
    /// Number of settings in a row that are finer than the best and have no smaller error.
    pub no_better: u32,
    /// Steps, iterations and bits of the errors of the last completed run. If a setting changes none of them, the instants of the results
    /// limit its steps. Such a setting does not count as one without improvement.
    same: Option<[u64; 4]>,
    /// Reason why no finer setting is run.
    over: Option<String>,
}

/// Run as it is stored in the journal.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(default)]
struct Made {
    entry: RunEntry,
    work: f64,
    is_not_started: bool,
}

impl Study<'_> {
    pub(super) fn runs(
        &self,
        known: &Known,
        store: &mut ResultStore,
        watch: &mut impl Watch,
    ) -> Result<Vec<MethodRuns>, CompareError> {
        let mut all = Vec::new();
        for (i, method) in self.methods.iter().enumerate() {
            let share = i as f64 / self.methods.len() as f64;
            watch.doing(RECORDING[0] + RECORDING[1] * share, &method.name());
            let settings = if method.is_fixed() { &self.steps } else { &self.tolerances };
            let mut refined = Refinement::default();
            let mut runs = Vec::new();
            for &setting in settings {
                runs.push(self.one(method, setting, known, (&mut refined, store))?);
            }
            all.push(MethodRuns {
                name: method.name(),
                formulation: method.formulation.name().to_owned(),
                integrator: method.integrator.name().to_owned(),
                control: method.control().to_owned(),
                precision: method.precision.name().to_owned(),
                runs,
                ..MethodRuns::default()
            });
        }
        Ok(all)
    }

    /// Makes one run, or returns the reason why it is not made.
    fn one(
        &self,
        method: &MethodCase,
        setting: f64,
        known: &Known,
        (refined, store): (&mut Refinement, &mut ResultStore),
    ) -> Result<RunEntry, CompareError> {
        if refined.over.is_none() {
            refined.over = self.too_long(method, setting, refined);
        }
        if let Some(why) = &refined.over {
            return Ok(RunEntry { setting, not_run: Some(why.clone()), ..RunEntry::default() });
        }
        let key = format!("run {} {setting:e}", method.name());
        let Made { entry, work, is_not_started } =
            store.get(&key, || self.recorded(method, setting, known))?;
        if is_not_started {
            refined.over = Some("it does not start with any setting".to_owned());
        }
        if entry.not_run.is_some() {
            refined.over.clone_from(&entry.not_run);
        }
        refined.take(&entry, work);
        Ok(entry)
    }

    /// Returns the reason why a setting is not run. The time of its run is predicted from the nominal time of the run before, and as a last
    /// resort from the CPU time of that run.
    fn too_long(&self, method: &MethodCase, setting: f64, refined: &Refinement) -> Option<String> {
        if refined.no_better >= NO_BETTER {
            return Some(format!("{NO_BETTER} finer settings in a row were no better"));
        }
        let (work, seconds, before) = refined.last?;
        let growth = method.growth(before / setting);
        let is_given = match method.is_fixed() {
            true => !self.request.steps.is_empty(),
            false => !self.request.tolerances.is_empty(),
        };
        let would =
            |seconds: f64| format!("it would take about {:.1e} s of CPU time", seconds * growth);
        let is_long = seconds * growth > self.request.time_limit;
        let is_much = !is_given && work * growth > self.most_work;
        (is_long || is_much).then(|| would(seconds))
    }

    fn recorded(&self, method: &MethodCase, setting: f64, known: &Known) -> Made {
        let (settings, course) = match self.course(method, setting, known) {
            Ok(both) => both,
            Err(text) => {
                let not_run = Some(format!("refused: {text}"));
                let entry = RunEntry { setting, not_run, ..RunEntry::default() };
                return Made { entry, ..Made::default() };
            }
        };
        let limit = self.request.time_limit;
        let recorded = self.scenes.recorded(&settings, &course, limit);
        let mut entry = RunEntry { setting, ..recorded.entry };
        if recorded.is_given_up {
            entry.status = Status::NotRun;
            entry.not_run = Some(format!("given up after {limit} s of CPU time"));
        }
        if entry.status == Status::Completed {
            let errors = known.errors(&recorded.rows);
            entry.error = errors.map(|[largest, _]| largest);
            entry.error_rms = errors.map(|[_, rms]| rms);
        }
        Made { entry, work: recorded.work, is_not_started: recorded.is_not_started }
    }

    /// Settings and schedule of a run over the compared time.
    pub(super) fn course(
        &self,
        method: &MethodCase,
        setting: f64,
        known: &Known,
    ) -> Result<(mbs::ResolvedMethod, Course), String> {
        let instants = Instants { count: known.rows.len(), ..self.instants };
        let between = method.is_fixed().then(|| instants.steps_between(setting));
        let step = between.map_or(self.of_scene, |n| instants.interval / n as f64);
        let settings = self.settings(method, setting, step)?;
        Ok((settings, Course { instants, between }))
    }
}

impl Refinement {
    /// Takes a run and its nominal time into account.
    pub fn take(&mut self, entry: &RunEntry, work: f64) {
        if entry.status != Status::Completed {
            return;
        }
        self.last = Some((work, entry.clocked_seconds, entry.setting));
        let Some(error) = entry.error else { return };
        let bits = |x: Option<f64>| x.map_or(0, f64::to_bits);
        let same = [entry.steps, entry.iterations, bits(entry.error), bits(entry.error_rms)];
        if self.same.replace(same) == Some(same) {
            return;
        }
        match self.best {
            Some(best) if error >= best => self.no_better += u32::from(best < GOOD),
            _ => {
                self.best = Some(error);
                self.no_better = 0;
            }
        }
    }
}

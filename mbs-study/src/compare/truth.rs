//! Computation of the reference by several methods, the best first.

use super::method::{Control, MethodCase};
use super::reference::{Known, Rows, RunPair};
use super::store::ResultStore;
use super::{CompareError, Study, course::Course, table};
use crate::compare::results::Status;
use mbs::{FormulationKind, IntegratorKind, Precision, ResolvedMethod};
use serde::{Deserialize, Serialize};

/// Time limit of a reference run, relative to that of other runs [-]. Chosen, not tuned.
const TIME_LIMIT: f64 = 10.0;
/// Time limit of a reference run of the most expensive kind, relative to that of other runs [-].
const SHORT_TIME_LIMIT: f64 = 1.0;
/// Tolerances of the reference's two runs, the best pair first [-]. The difference of the two runs is the uncertainty.
const TOLERANCES: [[f64; 2]; 3] = [[1e-13, 1e-12], [1e-11, 1e-10], [1e-9, 1e-8]];
/// Tolerances of the reference's two runs in double-double [-].
const PAIR_TOLERANCES: [[f64; 2]; 1] = [[1e-20, 1e-18]];
/// Steps of the check, relative to the scene's step [-]. The finest that [`CHECK_BUDGETS`] allows is used, and halved twice.
const STEPS: [f64; 4] = [0.125, 0.25, 0.5, 1.0];
/// Ratio of the budget of all runs to the largest work of a run of the check [-]. Chosen, not tuned.
const CHECK_BUDGETS: f64 = 20.0;
/// Integrator with error control in a precision, the tolerances of its two runs, and their time limit relative to other runs.
type Way<'a> = ((IntegratorKind, Precision), (&'a [[f64; 2]], f64));
const ORDINARY: (IntegratorKind, Precision) = (IntegratorKind::Rk54, Precision::F64);

/// Reference run as it is stored in the journal: its rows, or the reason why there are none.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Made {
    rows: Option<Rows>,
    stopped: Option<String>,
}

impl Study<'_> {
    /// Returns the reference: the table if there is one, otherwise runs.
    pub(super) fn known(
        &self,
        table: Option<(&str, &str)>,
        store: &mut ResultStore,
    ) -> Result<Known, CompareError> {
        let of = (&self.channels[..], self.length());
        if let Some((name, text)) = table {
            let duration = self.scenes.double.duration;
            let table = table::read(text, &self.channels, (&self.instants, duration));
            let mut known = Known::of_table(table.map_err(CompareError::Table)?, name, of);
            // the table is checked by two solutions before the methods are compared with it
            let (pairs, _) =
                self.pairs(&[(ORDINARY, (&TOLERANCES[1..], SHORT_TIME_LIMIT))], store)?;
            known.verify(name, &pairs, &self.instants);
            return Ok(known);
        }
        let least = self.request.errors.iter().copied().fold(1e-2, f64::min);
        let dear = (IntegratorKind::Extrapolation, Precision::DoubleDouble);
        let kinds: [Way<'_>; 2] = [
            (dear, (&PAIR_TOLERANCES[..], SHORT_TIME_LIMIT)),
            (ORDINARY, (&TOLERANCES[..], TIME_LIMIT)),
        ];
        let (pairs, why) = self.pairs(&kinds, store)?;
        let Some(best) = pairs.first() else { return Err(CompareError::NoReference(why)) };
        Ok(Known::of_runs(best, pairs.get(1), of, (&self.instants, least)))
    }

    /// Makes up to two solutions by different formulations. The first is in relative coordinates, by the first method that runs to the end. The
    /// second is in natural coordinates. Also returns the reason of the last failure.
    fn pairs(
        &self,
        kinds: &[Way<'_>],
        store: &mut ResultStore,
    ) -> Result<(Vec<RunPair>, String), CompareError> {
        let mut why = String::from("none was tried");
        let mut pairs = Vec::new();
        for &(kind, how) in kinds {
            if pairs.is_empty()
                && let Some(pair) = self.own_control(kind, how, store, &mut why)?
            {
                pairs.push(pair);
            }
        }
        let checks = FormulationKind::references().into_iter().filter(|f| !f.row().relative);
        for formulation in checks {
            if pairs.len() < 2
                && let Some(pair) = self.extrapolated(formulation, store, &mut why)?
            {
                pairs.push(pair);
            }
        }
        Ok((pairs, why))
    }

    /// Solution in relative coordinates with an integrator that controls its error, at two tight tolerances.
    fn own_control(
        &self,
        (integrator, precision): (IntegratorKind, Precision),
        (tolerances, times): (&[[f64; 2]], f64),
        store: &mut ResultStore,
        why: &mut String,
    ) -> Result<Option<RunPair>, CompareError> {
        let method = MethodCase {
            formulation: FormulationKind::RELATIVE,
            integrator,
            control: Control::Own,
            precision,
        };
        for &[fine, coarse] in tolerances {
            // the cheaper run is made first: if it fails, the other one is not made
            let coarse_rows = self.reference_run(&method, (coarse, times), store, why)?;
            let Some(coarse_rows) = coarse_rows else { continue };
            if let Some(rows) = self.reference_run(&method, (fine, times), store, why)? {
                let method =
                    format!("{}, at tolerances {fine:.0e} and {coarse:.0e}", method.name());
                return Ok(Some(RunPair { method, rows, coarse: coarse_rows }));
            }
        }
        Ok(None)
    }

    /// Solution by a formulation with the trapezoidal rule at three steps, extrapolated.
    fn extrapolated(
        &self,
        formulation: FormulationKind,
        store: &mut ResultStore,
        why: &mut String,
    ) -> Result<Option<RunPair>, CompareError> {
        let method = MethodCase {
            formulation,
            integrator: IntegratorKind::Trapezoidal,
            control: Control::Fixed,
            precision: Precision::F64,
        };
        let most = self.request.budget / CHECK_BUDGETS;
        let affordable = |factor: &&f64| {
            let shortest = self.of_scene * **factor / 4.0;
            let steps = self.instants.steps_between(shortest) * self.instants.count as u64;
            super::ladder::work(3 * steps, self.unknowns()) <= most
        };
        let factor = STEPS.iter().find(affordable).copied().unwrap_or(1.0);
        let between = self.instants.steps_between(self.of_scene * factor);
        let mut runs: Vec<Rows> = Vec::new();
        for halvings in 0..3 {
            let step = self.instants.interval / (between << halvings) as f64;
            match self.reference_run(&method, (step, TIME_LIMIT), store, why)? {
                Some(rows) => runs.push(rows),
                None => return Ok(None),
            }
        }
        let h = mbs_scene::format::significant(self.instants.interval / between as f64);
        let name = format!(
            "{}, f64, extrapolated from steps of {h} s, a half and a quarter",
            formulation.name()
        );
        let [a, b, c] = &runs[..] else { return Ok(None) };
        Ok(Some(RunPair::richardson(name, [a, b, c])))
    }

    /// Rows of a run that reaches the end.
    fn reference_run(
        &self,
        method: &MethodCase,
        (setting, times): (f64, f64),
        store: &mut ResultStore,
        why: &mut String,
    ) -> Result<Option<Rows>, CompareError> {
        let key = format!("reference {} {setting:e}", method.name());
        let made = store.get(&key, || match self.reference_rows(method, setting, times) {
            Ok(rows) => Made { rows: Some(rows), stopped: None },
            Err(why) => Made { rows: None, stopped: Some(why) },
        })?;
        if let Some(text) = made.stopped {
            *why = format!("{}, {text}", method.name());
        }
        Ok(made.rows)
    }

    /// Rows of a run, or the reason why there are none.
    fn reference_rows(
        &self,
        method: &MethodCase,
        setting: f64,
        times: f64,
    ) -> Result<Rows, String> {
        let step = if method.is_fixed() { setting } else { self.of_scene };
        let settings = self.settings(method, setting, step)?;
        let between = method.is_fixed().then(|| self.instants.steps_between(setting));
        let course = Course { instants: self.instants, between };
        let recorded = self.scenes.recorded(&settings, &course, times * self.request.time_limit);
        match (&recorded.entry.failure, recorded.entry.status) {
            (Some(error), _) => Err(format!("at t = {} s: {}", error.time, error.message)),
            (None, Status::Completed) if !recorded.is_given_up => Ok(recorded.rows),
            _ => Err("it took longer than the reference may".to_owned()),
        }
    }

    /// Settings of a run over the whole duration.
    pub(super) fn settings(
        &self,
        method: &MethodCase,
        setting: f64,
        step: f64,
    ) -> Result<ResolvedMethod, String> {
        let mut overrides = method.overrides(setting, step, self.instants.interval);
        overrides.duration = Some(self.duration);
        ResolvedMethod::new(&self.scenes.double, &overrides).map_err(|error| error.to_string())
    }
}

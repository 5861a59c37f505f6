//! What `mbs run --error` would choose on the scene, held against what all methods were measured to take.

use super::drive::Course;
use super::reference::Known;
use super::store::Store;
use super::{CompareError, Study, Watch};
use crate::auto::{Goal, Pick, Processor, Task, choose, methods};
use crate::settings::{Overrides, Settings};
use mbs_scene::compare::{Comparison, JudgedChoice, Status};

/// A chosen run is timed so often.
const TURNS: u32 = 9;
/// Where choices stand in the progress bar.
const DONE: f64 = 0.96;

impl Study<'_> {
    /// A choice for each error that is ranked: its pilot, the run it chose, and how that compares with the best of all.
    pub(super) fn choices(
        &self,
        (comparison, known): (&mut Comparison, &Known),
        store: &mut Store,
        watch: &mut impl Watch,
    ) -> Result<(), CompareError> {
        if !self.request.choices {
            return Ok(());
        }
        comparison.digest(&self.request.errors);
        for (level, &error) in self.request.errors.iter().enumerate() {
            watch.doing(DONE, "choice by measurement");
            let key = format!("choice {error:e}");
            let run = || serde_json::to_value(self.choice(error, known)).unwrap_or_default();
            let value = store.get(&key, run).map_err(CompareError::Journal)?;
            let mut choice = serde_json::from_value::<JudgedChoice>(value).unwrap_or_default();
            let ranks = comparison.ranking.get(level).map_or(&[][..], |level| &level.ranks);
            let best = ranks.iter().min_by(|a, b| a.seconds.total_cmp(&b.seconds));
            choice.best_method = best.map(|rank| rank.method.clone());
            choice.best_seconds = best.map(|rank| rank.seconds);
            choice.over_best = choice.cpu_seconds.zip(choice.best_seconds).map(|(a, b)| a / b);
            comparison.choices.push(choice);
        }
        Ok(())
    }

    fn choice(&self, error: f64, known: &Known) -> JudgedChoice {
        let mut judged = JudgedChoice { error, ..JudgedChoice::default() };
        let scene = &self.scenes.double;
        let instants = super::Instants { count: known.rows.len(), ..self.instants };
        let duration = Some(instants.time(instants.count));
        let base = Overrides { formulation: Some("auto".into()), duration, ..Overrides::default() };
        let Ok(settings) = Settings::new(scene, &base) else { return judged };
        let goal = Goal { error: Some(error), deadline: None };
        let Ok(mut methods) = methods(scene, &base, &settings, &goal) else { return judged };
        methods.retain(|m| self.methods.contains(m));
        let task = Task { base: &base, settings: &settings, goal, instants };
        let (picks, choice) = choose(scene, &task, &methods, &mut Processor::new(1));
        judged.pilot_seconds = choice.pilot_seconds;
        for (pick, candidate) in picks.iter().zip(&choice.candidates) {
            judged.method = pick.method.name();
            judged.setting = pick.setting;
            judged.predicted_seconds = candidate.seconds;
            judged.predicted_error = candidate.error;
            match self.chosen_run(pick, (instants, known)) {
                Ok((true_error, cpu_seconds)) => {
                    judged.true_error = true_error;
                    judged.cpu_seconds = cpu_seconds;
                    break;
                }
                Err(why) => judged.stopped.push(format!("{}: {why}", pick.method.name())),
            }
        }
        judged
    }

    /// True error and least CPU time of a chosen run [s].
    fn chosen_run(
        &self,
        pick: &Pick,
        (instants, known): (super::Instants, &Known),
    ) -> Result<(Option<f64>, Option<f64>), String> {
        let between = pick.method.is_fixed().then(|| instants.steps_between(pick.setting));
        #[allow(clippy::cast_precision_loss, reason = "a count of steps")]
        let step = between.map_or(self.of_scene, |n| instants.interval / n as f64);
        let settings = self.settings(&pick.method, pick.setting, step)?;
        let course = Course { instants, between };
        let recorded = self.scenes.recorded(&settings, &course, f64::from(u16::MAX));
        if recorded.entry.status != Status::Completed {
            return Err(recorded.entry.failure.map_or_else(String::new, |e| e.code));
        }
        let true_error = known.errors(&recorded.rows).map(|[largest, _]| largest);
        let times = (0..TURNS).filter_map(|turn| self.scenes.timed(&settings, &course, turn));
        Ok((true_error, times.min_by(f64::total_cmp)))
    }
}

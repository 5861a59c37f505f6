//! Choice of the method by `mbs run --error` on the scene, compared with the measured times of all methods.

use super::reference::Known;
use super::store::ResultStore;
use super::{CompareError, Study, Watch};
use crate::auto::{Goal, GoalError, Pick, Pilot, Processor, Task, methods};
use crate::compare::results::{Comparison, JudgedChoice, MethodRuns, Status};
use mbs::inside::in_space;
use mbs::{Method, ResolvedMethod};

/// Number of timings of a chosen run, of which the shortest counts. Chosen, not tuned.
const TURNS: u32 = 9;
/// Position of the choices in the progress bar, as a fraction of it [-].
const DONE: f64 = 0.96;

impl Study<'_> {
    /// Makes a choice for each error of the ranking: its pilot, the chosen run, and a comparison with the best method of all.
    pub(super) fn choices(
        &self,
        (comparison, known): (&mut Comparison, &Known),
        store: &mut ResultStore,
        watch: &mut impl Watch,
    ) -> Result<(), CompareError> {
        if !self.request.choices {
            return Ok(());
        }
        comparison.digest(&self.request.errors);
        for (level, &error) in self.request.errors.iter().enumerate() {
            watch.doing(DONE, "choice by measurement");
            let best = Rival::new(comparison, level);
            let key = format!("choice {error:e}");
            let run = || self.choice(error, known, best.as_ref());
            comparison.choices.push(store.get(&key, run)?);
        }
        Ok(())
    }

    fn choice(&self, error: f64, known: &Known, best: Option<&Rival>) -> JudgedChoice {
        let mut judged = JudgedChoice { error, ..JudgedChoice::default() };
        judged.best_method = best.map(|best| best.runs.name.clone());
        let scene = &self.scenes.double;
        let instants = super::Instants { count: known.rows.len(), ..self.instants };
        let duration = Some(instants.time(instants.count));
        let base = Method {
            formulation: Some("auto".into()),
            duration,
            interrupt: self.request.interrupt.clone(),
            ..Method::default()
        };
        let Ok(settings) = ResolvedMethod::new(scene, &base) else { return judged };
        let goal = Goal { error: Some(error), deadline: None };
        let Ok(mut methods) = methods(scene, &base, &settings, &goal) else { return judged };
        methods.retain(|m| self.methods.contains(m));
        let task = Task { base: &base, settings: &settings, goal, instants };
        let pilot = Pilot { task: &task, methods: &methods, clock: &mut Processor::new(1) };
        let (picks, choice) = in_space(scene, pilot);
        judged.pilot_seconds = choice.pilot_seconds;
        if let Some(look) = choice.second_look.as_ref().filter(|look| look.differs) {
            let apart = look.distance.unwrap_or(f64::INFINITY);
            judged.stopped.push(GoalError::Differs(apart).to_string());
            return judged;
        }
        for (pick, candidate) in picks.iter().zip(&choice.candidates) {
            judged.method = pick.method.name();
            judged.setting = pick.setting;
            judged.predicted_seconds = candidate.seconds;
            judged.predicted_error = candidate.error;
            match self.chosen_run(pick, known, best) {
                Ok(held) => {
                    judged.true_error = held.true_error;
                    judged.cpu_seconds = held.seconds;
                    judged.best_seconds = held.best_seconds;
                    judged.over_best = held.seconds.zip(held.best_seconds).map(|(a, b)| a / b);
                    break;
                }
                Err(why) => judged.stopped.push(format!("{}: {why}", pick.method.name())),
            }
        }
        judged
    }

    /// Times a chosen run, interleaved with the runs of the best method around the error. A disturbance of the machine then slows both.
    fn chosen_run(&self, pick: &Pick, known: &Known, best: Option<&Rival>) -> Result<Held, String> {
        let (settings, course) = self.course(&pick.method, pick.setting, known)?;
        let recorded = self.scenes.recorded(&settings, &course, f64::from(u16::MAX));
        if recorded.entry.status != Status::Completed {
            return Err(recorded.entry.failure.map_or_else(String::new, |e| e.code));
        }
        let true_error = known.errors(&recorded.rows).map(|[largest, _]| largest);
        let mut seconds = None::<f64>;
        let mut best = best.cloned();
        for turn in 0..TURNS {
            let time = self.scenes.timed(&settings, &course, turn);
            seconds = seconds.into_iter().chain(time).reduce(f64::min);
            let Some(Rival { method, runs, .. }) = &mut best else { continue };
            for run in &mut runs.runs {
                let (settings, course) = self.course(&self.methods[*method], run.setting, known)?;
                run.cpu_seconds.extend(self.scenes.timed(&settings, &course, turn));
            }
        }
        let best_seconds = best.and_then(|best| best.runs.seconds_at(best.error, best.instants));
        Ok(Held { true_error, seconds, best_seconds })
    }
}

/// Error of a chosen run against the reference, its shortest CPU time [s], and the time of the best method at the required error [s].
struct Held {
    true_error: Option<f64>,
    seconds: Option<f64>,
    best_seconds: Option<f64>,
}

/// Best of all methods at an error, with only its runs around that error; they are not timed yet.
#[derive(Clone)]
struct Rival {
    method: usize,
    runs: MethodRuns,
    error: f64,
    instants: u64,
}

impl Rival {
    fn new(comparison: &Comparison, level: usize) -> Option<Self> {
        let level = comparison.ranking.get(level)?;
        let best = level.ranks.iter().min_by(|a, b| a.seconds.total_cmp(&b.seconds))?;
        let method = comparison.methods.iter().position(|m| m.name == best.method)?;
        let runs = comparison.methods[method].beside_alone(level.error);
        Some(Self { method, runs, error: level.error, instants: comparison.instants as u64 })
    }
}

//! Plan of a run for a goal: ranked settings, and the next settings if a run stops.

use super::bench::{self, Clock};
use super::choose::{Pick, Pilot, Task, instants, methods};
use super::estimate::SMALL;
use super::goal::{ACCURATE, GoalError, check_goal};
use crate::compare::method::MethodCase;
use cpu_time::ThreadTime;
use mbs::inside::PreparedRun;
use mbs::record::{Fallback, PilotReport};
use mbs::{INTERRUPTED, Names, Outcome, ResolvedMethod, SimulationError, StopError, Watchers};
use mbs_core::scene::Scene;
use std::time::Instant;

/// Settings to run with, in the order in which they are tried.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Settings by rank, at least one.
    pub ranked: Vec<ResolvedMethod>,
}

impl Plan {
    /// Returns the settings that run first.
    ///
    /// # Panics
    /// Never: a plan has at least one element.
    #[must_use]
    pub fn first(&self) -> &ResolvedMethod {
        &self.ranked[0]
    }
}

/// Clock of the processor: CPU time of this thread, or wall time if several threads run the model.
#[derive(Debug)]
pub enum Processor {
    /// CPU time of this thread.
    Thread(ThreadTime),
    /// Wall time since an instant.
    Wall(Instant),
}

impl Processor {
    /// Makes the clock for a run with this number of threads.
    #[must_use]
    pub fn new(threads: usize) -> Self {
        if threads > 1 { Self::Wall(Instant::now()) } else { Self::Thread(ThreadTime::now()) }
    }
}

impl Clock for Processor {
    fn seconds(&mut self) -> f64 {
        match self {
            Self::Thread(clock) => clock.elapsed().as_secs_f64(),
            Self::Wall(clock) => clock.elapsed().as_secs_f64(),
        }
    }
}

/// Decides how a scene is run: with the given settings if there is no goal, otherwise by a pilot.
///
/// # Errors
/// A goal that these options do not allow, a scene that is refused in the requested precision, or an interrupt.
pub fn plan(run: &PreparedRun<'_>, clock: &mut dyn Clock) -> Result<Plan, SimulationError> {
    let (goal, base, settings) = (run.options().goal, &run.method, &run.settings);
    if !goal.is_some() {
        return Ok(Plan { ranked: vec![settings.clone()] });
    }
    check_goal(&goal, base, (settings.duration, settings.precision))?;
    let methods = methods(&run.scene, base, settings, &goal)?;
    let instants = instants(settings.duration, &goal);
    let task = Task { base, settings, goal, instants };
    let (picks, choice) = run.read()?.work(Pilot { task: &task, methods: &methods, clock });
    if base.interrupt.is_set() {
        let hint = "the choice was not made, and nothing was run; start it again";
        return Err(SimulationError::new(INTERRUPTED, "interrupted by a signal", hint));
    }
    if let Some(look) = choice.second_look.as_ref().filter(|look| look.differs) {
        let apart = look.distance.unwrap_or(f64::INFINITY);
        return Err(GoalError::Differs(apart).into());
    }
    Ok(Plan { ranked: ranked(&run.scene, &task, (&picks, &methods), &choice) })
}

/// Returns the settings of the picks. If there are no picks, the original settings are returned: their run reports why no method starts.
fn ranked(
    scene: &Scene<f64>,
    task: &Task<'_>,
    (picks, methods): (&[Pick], &[MethodCase]),
    choice: &PilotReport,
) -> Vec<ResolvedMethod> {
    let of = |pick: &Pick| {
        let settings =
            bench::settings(scene, task.base, &pick.method, (pick.setting, task.instants));
        Some(ResolvedMethod {
            asked: task.settings.asked.clone(),
            choice: Some(Box::new(choice.clone())),
            duration: task.settings.duration,
            ..settings.ok()?
        })
    };
    let blind = if picks.is_empty() { blind(task, choice, methods) } else { Vec::new() };
    let mut ranked: Vec<ResolvedMethod> = picks.iter().chain(&blind).filter_map(of).collect();
    if ranked.is_empty() {
        let choice = Some(Box::new(choice.clone()));
        ranked.push(ResolvedMethod { choice, ..task.settings.clone() });
    }
    ranked
}

/// Returns picks if the pilot had no result: every method that starts, in the order of the candidates. Each has the step of the scene, or a
/// tolerance of a tenth of the required error.
fn blind(task: &Task<'_>, choice: &PilotReport, methods: &[MethodCase]) -> Vec<Pick> {
    let starts = |m: &&MethodCase| {
        let same = choice.candidates.iter().find(|c| c.method == m.name());
        same.is_none_or(|c| c.trials.iter().all(|t| t.reached > 0.0))
    };
    let place = |m: &MethodCase| choice.candidates.iter().position(|c| c.method == m.name());
    let mut left: Vec<&MethodCase> = methods.iter().filter(starts).collect();
    left.sort_by_key(|m| place(m));
    let setting = |m: &MethodCase| match m.is_fixed() {
        true => task.goal.deadline.unwrap_or(f64::INFINITY).min(task.settings.step),
        false => SMALL * task.goal.error.unwrap_or(ACCURATE),
    };
    left.into_iter().map(|m| Pick { method: *m, setting: setting(m) }).collect()
}

/// Runs the settings of a plan. If a run stops, the settings of the next rank are tried, and the report of the choice records this. If all
/// runs stop, the one that got furthest is returned.
///
/// # Errors
/// Those of [`plan`], and a run that is refused.
pub fn run_plan(
    run: &PreparedRun<'_>,
    plan: &Plan,
    watchers: &mut Watchers<'_, '_>,
) -> Result<(Outcome, ResolvedMethod), SimulationError> {
    let (read, names) = (run.read()?, Names::new(&run.scene));
    run_ranked(plan, &names, |settings| run.run_by(&read, settings, watchers))
}

/// Runs a plan as [`run_plan`] does, with a given function for one run.
pub(super) fn run_ranked(
    plan: &Plan,
    names: &Names,
    mut run: impl FnMut(&ResolvedMethod) -> Result<Outcome, SimulationError>,
) -> Result<(Outcome, ResolvedMethod), SimulationError> {
    let mut lost: Vec<Fallback> = Vec::new();
    let mut furthest: Option<(Outcome, ResolvedMethod)> = None;
    for settings in &plan.ranked {
        let mut settings = settings.clone();
        if let Some(choice) = &mut settings.choice {
            choice.fallbacks.clone_from(&lost);
        }
        let outcome = run(&settings)?;
        let Some(error) = &outcome.error else { return Ok((outcome, settings)) };
        if *error == StopError::Interrupted {
            return Ok((outcome, settings));
        }
        let report = error.report(outcome.summary.end_time, names);
        lost.push(Fallback {
            method: method_name(&settings),
            code: report.code,
            message: report.message,
            time: report.time,
            cpu_seconds: outcome.summary.cpu_seconds,
        });
        let end = outcome.summary.end_time;
        if furthest.as_ref().is_none_or(|(other, _)| end > other.summary.end_time) {
            furthest = Some((outcome, settings));
        }
    }
    match furthest {
        Some(both) => Ok(both),
        None => {
            let settings = plan.first().clone();
            run(&settings).map(|outcome| (outcome, settings))
        }
    }
}

fn method_name(settings: &ResolvedMethod) -> String {
    match settings.integrator {
        mbs::IntegratorKind::Trapezoidal => settings.formulation.name().to_owned(),
        other => format!("{} {}", settings.formulation.name(), other.name()),
    }
}

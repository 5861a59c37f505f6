//! Choice of a method for a scene: the request, the allowed methods, the pilot and its ranked settings.

use super::bench::{Clock, SceneBench};
use super::candidates::{self, PilotCandidate};
use super::goal::{GoalError, PilotTarget};
use super::pilot::{BUDGET, PilotPlace, PilotSearch};
use super::structure::{self, Structure};
use super::{check, report};
use crate::compare::ladder::Instants;
use crate::compare::method::{Control, MethodCase};
use mbs::inside::{AssembledScene, SceneWork};
use mbs::record::PilotReport;
use mbs::{Goal, IntegratorKind, Method, Names, Precision, ResolvedMethod};
use mbs_core::Real;
use mbs_core::scene::Scene;

/// Number of instants at which errors are measured [-]. Intervals of a 200th of the run resolve most motions.
const INSTANTS: f64 = 200.0;
/// Method and setting that the pilot has chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pick {
    pub(crate) method: MethodCase,
    pub(crate) setting: f64,
}

/// Task of a choice: the requested method, its settings, the goal, and the instants of the trials.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Task<'a> {
    pub(crate) base: &'a Method,
    pub(crate) settings: &'a ResolvedMethod,
    pub(crate) goal: Goal,
    pub(crate) instants: Instants,
}

/// Returns the methods that the caller's options allow. The order decides between methods with equal times.
///
/// # Errors
/// [`GoalError`] if the goal and the caller's options allow no method.
pub fn methods<T>(
    scene: &Scene<T>,
    base: &Method,
    settings: &ResolvedMethod,
    goal: &Goal,
) -> Result<Vec<MethodCase>, GoalError> {
    let formulations = if settings.asked == "auto" { vec![] } else { vec![settings.formulation] };
    let asked = base.integrator.as_ref().or(scene.solver.integrator.as_ref());
    let integrator = asked.map(|_| settings.integrator);
    let mut methods = MethodCase::all(&formulations, &[settings.precision]);
    if let Some(integrator) = integrator {
        methods.retain_mut(|m| {
            let is_other_rule =
                !integrator.is_of_first_order() && m.integrator == IntegratorKind::Trapezoidal;
            if is_other_rule {
                m.integrator = integrator;
            }
            m.integrator == integrator
        });
    } else if settings.precision != Precision::DoubleDouble {
        // rk853 is faster than gbs for every error that the run's numbers resolve; gbs is for references with more digits
        methods.retain(|m| m.integrator != IntegratorKind::Extrapolation);
    }
    if goal.deadline.is_some() {
        if methods.iter().all(|m| m.control == Control::Own) && !methods.is_empty() {
            return Err(GoalError::OwnSteps);
        }
        methods.retain(MethodCase::is_fixed);
    }
    if methods.is_empty() { Err(GoalError::NoCandidate) } else { Ok(methods) }
}

/// Makes the instants for a run of `duration` [s]. With a deadline, a whole number of frames lies between two instants.
pub(crate) fn instants(duration: f64, goal: &Goal) -> Instants {
    let Some(frame) = goal.deadline else {
        return Instants::new(duration, &[duration / INSTANTS]);
    };
    let frames = (duration / frame * (1.0 + candidates::ROUNDING)).floor().max(1.0);
    let between = (frames / INSTANTS).ceil();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 200")]
    let count = (frames / between).floor().max(1.0) as usize;
    Instants { count, interval: between * frame }
}

/// Pilot for a scene. It gives ranked settings and the evidence for them.
pub(crate) struct Pilot<'a> {
    pub(crate) task: &'a Task<'a>,
    pub(crate) methods: &'a [MethodCase],
    pub(crate) clock: &'a mut dyn Clock,
}

impl SceneWork for Pilot<'_> {
    type Done = (Vec<Pick>, PilotReport);

    fn done<T: Real, const D: usize>(self, scene: &Scene<T>) -> Self::Done {
        chosen::<T, D>(scene, self.task, self.methods, self.clock)
    }
}

fn chosen<T: Real, const D: usize>(
    scene: &Scene<T>,
    task: &Task<'_>,
    methods: &[MethodCase],
    clock: &mut dyn Clock,
) -> (Vec<Pick>, PilotReport) {
    let begun = clock.seconds();
    let ready = AssembledScene::<T, D>::new(scene);
    let mut ready = ready.map_err(|e| Box::new(e.report(0.0, &Names::new(scene))));
    let structure = structure::structure(scene, task.settings.duration, ready.as_mut().ok());
    let asked = (task.settings.asked != "auto", task.goal.deadline.is_some());
    let methods = candidates::select(asked, methods, &structure);
    let (target, mut instants) = (PilotTarget::of(&task.goal), task.instants);
    // the assembly does not count: every run needs it, and trials get the whole budget (in iltis-links at 1e-6, it would take most of it)
    let (mut spent, mut before) = (0.0, clock.seconds() - begun);
    loop {
        let mut bench = SceneBench::new((scene, task.base), &ready, instants, (&mut *clock, spent));
        let longest = target.deadline.unwrap_or(f64::INFINITY).min(instants.interval);
        let of = |m: &MethodCase| candidate(m, &structure, (target, longest));
        let mut search = PilotSearch::new(&mut bench, methods.iter().map(of).collect(), target);
        let mut places = search.run();
        let shorter = search.shorter(instants.count);
        if let Some(count) = shorter.filter(|_| places.is_empty()) {
            before += search.bench.spent();
            // trials over a part of the span get half of the budget again
            spent = 0.5 * BUDGET;
            before -= spent;
            instants.count = count;
            continue;
        }
        if let Some(place) = search.by_theory(&places) {
            places.retain(|other| other.candidate != place.candidate);
            places.insert(0, place);
        }
        let check = match structure.loops.is_ok() && task.goal.error.is_some() {
            true => check::check(&mut search, &places, instants.interval),
            false => None,
        };
        let mut choice = report::evidence(&mut search, &places, &structure);
        match check {
            Some(Ok(look)) => choice.second_look = Some(look),
            Some(Err(why)) => choice.notes.push(report::unconfirmed(&why)),
            None => {}
        }
        choice.pilot_seconds += before;
        let times = task.instants.time(task.instants.count) / instants.time(instants.count);
        let picks = picks(&search, &places, times);
        choice.instants = instants.count;
        choice.span = instants.time(instants.count);
        report::extend(&mut choice, times);
        return (picks, choice);
    }
}

/// Makes a candidate, which is excluded if the structure of the scene does not allow its method.
fn candidate(
    method: &MethodCase,
    structure: &Structure,
    given: (PilotTarget, f64),
) -> PilotCandidate {
    let out = structure.refuses(method);
    PilotCandidate { out, ..PilotCandidate::new(*method, given.0, given.1) }
}

/// Ranked settings for the whole run. If the trials covered a part of it, errors are assumed to grow in proportion to the time.
fn picks(search: &PilotSearch<'_>, places: &[PilotPlace], times: f64) -> Vec<Pick> {
    let pick = |place: &PilotPlace| {
        let candidate = &search.candidates[place.candidate];
        let setting = place.prediction.setting * times.powf(-1.0 / candidate.law().error);
        Pick { method: candidate.method, setting: candidate.fit(setting) }
    };
    places.iter().map(pick).collect()
}

/// Lists the candidates of a scene with the facts that its structure gives, without any trial.
pub(crate) fn candidates<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
) -> Option<PilotReport> {
    let goal = Goal::default();
    let methods = methods(scene, &Method::default(), settings, &goal).ok()?;
    let mut ready = AssembledScene::<T, D>::new(scene).ok();
    let structure = structure::structure(scene, settings.duration, ready.as_mut());
    let given = (PilotTarget::of(&goal), instants(settings.duration, &goal).interval);
    let asked = (settings.asked != "auto", false);
    let entry = |method: &MethodCase| mbs::record::Candidate {
        basis: "the pilot decides".to_owned(),
        ..report::entry(&candidate(method, &structure, given))
    };
    Some(PilotReport {
        candidates: candidates::select(asked, &methods, &structure).iter().map(entry).collect(),
        structure: structure.words(),
        ..PilotReport::default()
    })
}

//! The choice of formulation, integrator and step by measurement: for a wanted error of the outputs, or for a deadline.
//!
//! Structure says who cannot run the scene; a short pilot runs the others over the whole span with coarse settings, takes their
//! errors against the best of them, and predicts what the wanted error costs each. Time comes from a [`Clock`] that is given.

mod bench;
mod entrant;
mod finish;
mod goal;
mod law;
mod patience;
mod plan;
mod race;
mod reference;
mod report;
mod second;
mod structure;
#[cfg(test)]
mod tests;
mod trial;

pub use bench::Clock;
pub use goal::{Goal, GoalError, time};
pub use plan::{Plan, PlanError, Processor, plan, run_plan};

use crate::compare::ladder::Instants;
use crate::compare::method::{Control, MethodCase};
use bench::SceneBench;
use entrant::Entrant;
use finish::Place;
use mbs::FormulationKind;
use mbs::Names;
use mbs::inside::AssembledScene;
use mbs::inside::SceneWork;
use mbs::record::{Candidate, PilotReport};
use mbs::{InSpace, Plane};
use mbs::{IntegratorKind, Precision};
use mbs::{Method, Settings};
use mbs_core::Real;
use mbs_core::scene::Scene;
use race::{Race, Wanted};

/// Instants at which errors are taken, where the caller has none.
const INSTANTS: f64 = 200.0;
/// Tolerances: what is looser controls nothing any more; the first of an error estimate, whose runs are short with it; the first of
/// an integrator that controls its own steps, which rows of results may keep far shorter than its tolerance does, and how many times the
/// wanted error it is at most.
const LOOSEST: f64 = 0.1;
const FIRST: f64 = 1e-4;
const FIRST_OWN: f64 = 1e-2;
const LOOSER: f64 = 10.0;
/// With a deadline alone, no smaller error is aimed at.
const ACCURATE: f64 = 1e-6;
/// The span is cut by this factor where no candidate is run to its end within the budget, at most so often.
const CUT: usize = 8;
const CUTS: u32 = 3;

/// A method and its setting, and what was expected of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pick {
    pub(crate) method: MethodCase,
    pub(crate) setting: f64,
}

/// Where a choice is made.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Task<'a> {
    pub(crate) base: &'a Method,
    pub(crate) settings: &'a Settings,
    pub(crate) goal: Goal,
    pub(crate) instants: Instants,
}

/// The methods that a caller leaves to choose from, in the order that decides where times are the same.
pub(crate) fn methods<T>(
    scene: &Scene<T>,
    base: &Method,
    settings: &Settings,
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
        // rk853 takes less time for every error that can be told in these digits: gbs is for references
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

/// Instants for a run of `duration` [s]: whole frames lie between them where there is a deadline.
pub(crate) fn instants(duration: f64, goal: &Goal) -> Instants {
    let Some(frame) = goal.deadline else {
        return Instants::new(duration, &[duration / INSTANTS]);
    };
    let frames = (duration / frame * (1.0 + 1e-9)).floor().max(1.0);
    let between = (frames / INSTANTS).ceil();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 200")]
    let count = (frames / between).floor().max(1.0) as usize;
    Instants { count, interval: between * frame }
}

/// The choice for a scene: ranked picks, the first to run, and the evidence.
pub(crate) struct Pilot<'a> {
    pub(crate) task: &'a Task<'a>,
    pub(crate) methods: &'a [MethodCase],
    pub(crate) clock: &'a mut dyn Clock,
}

impl SceneWork for Pilot<'_> {
    type Done = (Vec<Pick>, PilotReport);

    fn done<T: Real, const D: usize>(self, scene: &Scene<T>) -> Self::Done
    where
        Plane<D>: InSpace<T>,
    {
        chosen::<T, D>(scene, self.task, self.methods, self.clock)
    }
}

fn chosen<T: Real, const D: usize>(
    scene: &Scene<T>,
    task: &Task<'_>,
    methods: &[MethodCase],
    clock: &mut dyn Clock,
) -> (Vec<Pick>, PilotReport)
where
    Plane<D>: InSpace<T>,
{
    let begun = clock.seconds();
    let ready = AssembledScene::<T, D>::new(scene);
    let mut ready = ready.map_err(|e| Box::new(e.report(0.0, &Names::new(scene))));
    let structure = structure::structure(scene, task.settings.duration, ready.as_mut().ok());
    let methods = &few_methods(task, methods, &structure)[..];
    let (wanted, mut instants) = (wanted(&task.goal), task.instants);
    let mut spent = clock.seconds() - begun;
    let mut before = spent;
    for cut in 0..=CUTS {
        let mut bench = SceneBench::new((scene, task.base), &ready, instants, (&mut *clock, spent));
        let mut entrants: Vec<Entrant> =
            methods.iter().map(|m| entrant(*m, &structure, (wanted, instants))).collect();
        entrants.sort_by_key(|e| structure.promise(&e.method));
        let mut race = Race::new(&mut bench, entrants, wanted);
        let places = race.run();
        let is_blind = places.is_empty() && race.is_cut && instants.count > CUT;
        if is_blind && cut < CUTS {
            before += race.bench.spent() - spent;
            // the shorter span has half of the time again
            spent = 0.5 * race::BUDGET[0];
            instants.count /= CUT;
            continue;
        }
        let second = (structure.loops.is_ok() && task.goal.error.is_some())
            .then(|| second::look(&mut race, &places, instants))
            .flatten();
        let mut choice = report::evidence(&mut race, &places, &structure);
        choice.second_look = second;
        choice.pilot_seconds += before - spent;
        let picks = picks(&race, &places, scaled(task.instants, instants));
        choice.instants = instants.count;
        choice.span = instants.time(instants.count);
        extend(&mut choice, scaled(task.instants, instants));
        return (picks, choice);
    }
    (Vec::new(), PilotReport::default())
}

/// Of all methods those that were the cheapest on some scene, for some error, where a tree and the caller leave them: explicit and
/// collocation methods, and error control, in relative coordinates, and index-3. The others take up the time that these need.
fn few_methods(
    task: &Task<'_>,
    methods: &[MethodCase],
    structure: &structure::Structure,
) -> Vec<MethodCase> {
    let is_free = task.settings.asked == "auto" && task.goal.deadline.is_none();
    let is_few = |m: &&MethodCase| {
        let is_fixed = m.control == Control::Fixed;
        if m.formulation.row().relative {
            return !is_fixed || m.integrator.is_explicit();
        }
        m.formulation == FormulationKind::DEFAULT && is_fixed
    };
    let few: Vec<MethodCase> = methods.iter().filter(is_few).copied().collect();
    if !is_free || structure.loops.is_err() || few.is_empty() { methods.to_vec() } else { few }
}

/// How many times the pilot's span the run is.
fn scaled(whole: Instants, span: Instants) -> f64 {
    whole.time(whole.count) / span.time(span.count)
}

/// CPU times of the whole run from those of the pilot's span, and a word about it.
fn extend(choice: &mut PilotReport, times: f64) {
    if times <= 1.0 + 1e-9 {
        return;
    }
    for candidate in &mut choice.candidates {
        candidate.seconds = candidate.seconds.map(|seconds| seconds * times);
    }
    choice.notes.push(format!(
        "the pilot saw the first {} s, which is all that its time was enough for: what comes later may take other steps",
        mbs_scene::format::few(choice.span)
    ));
}

fn wanted(goal: &Goal) -> Wanted {
    Wanted { error: goal.error.unwrap_or(ACCURATE), deadline: goal.deadline }
}

/// A candidate with the setting that it is given first.
fn entrant(
    method: MethodCase,
    structure: &structure::Structure,
    (wanted, instants): (Wanted, Instants),
) -> Entrant {
    let coarsest = match (method.is_fixed(), wanted.deadline) {
        (true, Some(deadline)) => deadline.min(instants.interval),
        (true, None) => instants.interval,
        _ => LOOSEST,
    };
    let first = match method.control {
        Control::Fixed => coarsest,
        Control::Own => (LOOSER * wanted.error).min(FIRST_OWN).max(wanted.error).min(coarsest),
        Control::Error | Control::Energy => FIRST.max(0.01 * wanted.error).min(coarsest),
    };
    let entrant = Entrant::new(method, first, coarsest);
    Entrant { out: structure.refuses(&method), ..entrant }
}

/// The ranked settings; on a part of the span, errors are taken to grow in proportion to it.
fn picks(race: &Race<'_>, places: &[Place], times: f64) -> Vec<Pick> {
    let pick = |place: &Place| {
        let entrant = &race.entrants[place.entrant];
        let setting = place.prediction.point.setting * entrant.law().setting_for(1.0 / times);
        Pick { method: entrant.method, setting: entrant.fit(setting) }
    };
    places.iter().map(pick).collect()
}

/// The candidates of a scene, and what structure alone says of them.
pub(crate) fn candidates<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &Settings,
) -> Option<PilotReport>
where
    Plane<D>: InSpace<T>,
{
    let methods = methods(scene, &Method::default(), settings, &Goal::default()).ok()?;
    let mut ready = AssembledScene::<T, D>::new(scene).ok();
    let structure = structure::structure(scene, settings.duration, ready.as_mut());
    let candidate = |method: &MethodCase| Candidate {
        out: structure.refuses(method),
        basis: "the pilot decides".to_owned(),
        ..report::candidate(&Entrant::new(*method, 1.0, 1.0))
    };
    Some(PilotReport {
        structure: structure.words(),
        candidates: methods.iter().map(candidate).collect(),
        ..PilotReport::default()
    })
}

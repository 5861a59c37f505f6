//! A choice as evidence, and why in words.

use super::entrant::Entrant;
use super::finish::{Place, basis};
use super::race::{BUDGET, Race};
use super::structure::Structure;
use super::trial::End;
use crate::words::{duration, few};
use mbs_scene::{Candidate, Fallback, PilotReference, PilotReport, SecondLook, TrialEntry};

/// Candidates that are told beside the chosen one.
const TOLD: usize = 3;

/// The evidence: the ranked ones first, then those that are out.
pub(super) fn evidence(
    race: &mut Race<'_>,
    places: &[Place],
    structure: &Structure,
) -> PilotReport {
    let pilot_seconds = race.bench.spent();
    let pilot_budget = race.budget();
    let chosen = places.first().map(|place| place.prediction.point.seconds);
    let mut candidates: Vec<Candidate> = Vec::new();
    for (k, place) in places.iter().enumerate() {
        let entrant = &race.entrants[place.entrant];
        let point = place.prediction.point;
        let missed = if place.reaches { "" } else { "; the required error is not reached" };
        candidates.push(Candidate {
            rank: Some(k + 1),
            setting: Some(point.setting),
            seconds: Some(point.seconds),
            over_chosen: chosen.map(|seconds| point.seconds / seconds),
            error: Some(point.error),
            basis: basis(place) + missed,
            ..candidate(entrant)
        });
    }
    let is_placed = |i: usize| places.iter().any(|place| place.entrant == i);
    for (i, entrant) in race.entrants.iter().enumerate().filter(|(i, _)| !is_placed(*i)) {
        let open = if race.is_cut {
            "the pilot had no time for it"
        } else {
            "another is cheaper in any case"
        };
        let out = race.entrants[i].out.clone().unwrap_or_else(|| open.to_owned());
        candidates.push(Candidate { out: Some(out), ..candidate(entrant) });
    }
    let reference = race.best.map(|best| PilotReference {
        method: race.entrants[best.entrant].method.name(),
        setting: best.setting,
        uncertainty: best.own,
    });
    PilotReport {
        error: Some(race.wanted.error),
        deadline: race.wanted.deadline,
        structure: structure.words(),
        pilot_seconds,
        pilot_budget,
        reference,
        candidates,
        notes: notes(race, places),
        ..PilotReport::default()
    }
}

/// A candidate by itself, with its trials.
pub(super) fn candidate(entrant: &Entrant) -> Candidate {
    let trial = |t: &super::entrant::Try| TrialEntry {
        setting: t.setting,
        seconds: t.trial.seconds,
        steps: t.trial.steps,
        reached: t.trial.reached,
        error: t.error.filter(|e| e.is_finite()),
        outcome: match &t.trial.end {
            End::Done => "completed".to_owned(),
            End::GivenUp => "given up".to_owned(),
            End::Stopped(e) | End::NotStarted(e) => e.code.clone(),
        },
    };
    Candidate {
        method: entrant.method.name(),
        formulation: entrant.method.formulation.name().to_owned(),
        integrator: entrant.method.integrator.name().to_owned(),
        control: entrant.method.control().to_owned(),
        slowest_step: entrant.slowest(),
        trials: entrant.tries.iter().map(trial).collect(),
        ..Candidate::default()
    }
}

fn notes(race: &Race<'_>, places: &[Place]) -> Vec<String> {
    let mut notes = Vec::new();
    if places.first().is_none_or(|place| !place.reaches) {
        notes.push(format!(
            "no candidate is expected to reach an error of {}: chosen is the one with the least",
            few(race.wanted.error)
        ));
    }
    if race.is_cut {
        notes.push(format!(
            "the pilot ended with its time: {} s, or {} % of the run it expects",
            BUDGET[0],
            100.0 * BUDGET[1]
        ));
    }
    if let Some(best) = race.best.filter(|best| best.own > race.wanted.error) {
        notes.push(format!(
            "errors are known to {:.1e} only: the pilot had no time for a better reference",
            best.own
        ));
    }
    notes
}

/// Why, one sentence each.
pub(crate) fn reasons(choice: &PilotReport) -> Vec<String> {
    let mut reasons = Vec::new();
    let placed = || choice.candidates.iter().filter(|c| c.rank.is_some());
    let Some(first) = placed().next() else { return vec!["nothing was left to choose".to_owned()] };
    let number = |x: Option<f64>| x.map_or_else(|| "?".to_owned(), few);
    let seconds = |c: &Candidate| c.seconds.map_or_else(|| "?".to_owned(), duration);
    let setting = |c: &Candidate| match c.control.as_str() {
        "fixed" => format!("steps of {} s", number(c.setting)),
        _ => format!("a tolerance of {}", number(c.setting)),
    };
    let wanted = match (choice.error, choice.deadline) {
        (Some(error), Some(deadline)) => {
            format!("for an error of {} in frames of {} s", few(error), few(deadline))
        }
        (Some(error), None) => format!("for an error of {}", few(error)),
        _ => "as asked".to_owned(),
    };
    reasons.push(format!(
        "{wanted}: {} with {} takes about {} of CPU time with an error of {} ({})",
        first.method,
        setting(first),
        seconds(first),
        number(first.error),
        first.basis
    ));
    if let (Some(deadline), Some(slowest)) = (choice.deadline, first.slowest_step) {
        let steps = (deadline / first.setting.unwrap_or(deadline)).round();
        reasons.push(format!(
            "{} steps a frame, the slowest of {}: at most {} of the {} that a frame has",
            few(steps),
            duration(slowest),
            duration(steps * slowest),
            duration(deadline)
        ));
    }
    let others = placed().skip(1).filter(|c| c.error <= choice.error.map(|e| 1.001 * e)).take(TOLD);
    let others: Vec<String> = others
        .map(|c| format!("{} {:.2} times as long", c.method, c.over_chosen.unwrap_or(f64::NAN)))
        .collect();
    if !others.is_empty() {
        reasons.push(format!("the others: {}", others.join(", ")));
    }
    let trials: usize = choice.candidates.iter().map(|c| c.trials.len()).sum();
    reasons.push(format!(
        "{trials} trials over the first {} s at {} instants took {}",
        few(choice.span),
        choice.instants,
        duration(choice.pilot_seconds)
    ));
    reasons.extend(choice.second_look.as_ref().map(second_look));
    reasons.extend(choice.notes.iter().cloned());
    reasons.extend(choice.fallbacks.iter().map(fallback));
    reasons
}

/// How far another model is from the chosen one.
fn second_look(look: &SecondLook) -> String {
    let distance = look.distance.map_or_else(|| "?".to_owned(), few);
    let own = look.own_error.map_or_else(
        || "but nothing is known of its own error".to_owned(),
        |error| format!("and errs by {} itself", few(error)),
    );
    format!("index-3, which shares no model with it, differs by {distance}, {own}")
}

/// A candidate that stopped in the run.
fn fallback(lost: &Fallback) -> String {
    format!(
        "{} came before and stopped at {} s: {} ({}); {} of CPU time lost",
        lost.method,
        few(lost.time),
        lost.message,
        lost.code,
        duration(lost.cpu_seconds)
    )
}

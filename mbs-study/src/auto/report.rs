//! A choice as evidence, and why in words.

use super::entrant::Entrant;
use super::finish::{Place, basis};
use super::race::{BUDGET, Race};
use super::structure::Structure;
use super::trial::End;
use mbs::record::{Candidate, PilotReference, PilotReport, TrialEntry};
use mbs_scene::format::few;

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

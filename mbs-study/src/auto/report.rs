//! Report of a choice: the evidence, and the reasons in words.

use super::candidates::{PilotCandidate, Tried};
use super::estimate::Basis;
use super::pilot::{BUDGET, BUDGET_FRACTION, PilotPlace, PilotSearch};
use super::structure::Structure;
use super::trial::TrialEnd;
use mbs::record::Candidate as Entry;
use mbs::record::{PilotReference, PilotReport, TrialEntry};
use mbs_scene::format::few;

/// Returns the evidence of the choice: ranked candidates first, then excluded ones.
pub(super) fn evidence(
    search: &mut PilotSearch<'_>,
    places: &[PilotPlace],
    structure: &Structure,
) -> PilotReport {
    let pilot_seconds = search.bench.spent();
    let chosen = places.first().map(|place| place.prediction.seconds);
    let ranked = places.iter().enumerate().map(|(k, place)| {
        let p = place.prediction;
        let missed = if place.reaches { "" } else { "; no trial reached the required error" };
        Entry {
            rank: Some(k + 1),
            setting: Some(p.setting),
            seconds: Some(p.seconds),
            over_chosen: chosen.map(|seconds| p.seconds / seconds),
            error: Some(p.error).filter(|error| error.is_finite()),
            basis: basis(place) + missed,
            out: None,
            ..entry(&search.candidates[place.candidate])
        }
    });
    let is_placed = |i: usize| places.iter().any(|place| place.candidate == i);
    let rest = search.candidates.iter().enumerate().filter(|(i, _)| !is_placed(*i));
    let rest = rest.map(|(_, candidate)| {
        let open = match search.is_cut {
            true => "the pilot had no time for it",
            false => "another is cheaper in any case",
        };
        let out = candidate.out.clone().unwrap_or_else(|| open.to_owned());
        Entry { out: Some(out), ..entry(candidate) }
    });
    let reference = search.best.map(|best| {
        let candidate = &search.candidates[best.candidate];
        let setting = candidate.trials[best.trial].setting;
        PilotReference { method: candidate.method.name(), setting, uncertainty: best.own }
    });
    PilotReport {
        error: Some(search.target.error),
        deadline: search.target.deadline,
        structure: structure.words(),
        pilot_seconds,
        pilot_budget: search.budget(),
        reference,
        candidates: ranked.chain(rest).collect(),
        notes: notes(search, places),
        ..PilotReport::default()
    }
}

/// Makes the entry of one candidate with its trials.
pub(super) fn entry(candidate: &PilotCandidate) -> Entry {
    let trial = |t: &Tried| TrialEntry {
        setting: t.setting,
        seconds: t.trial.seconds,
        steps: t.trial.steps,
        reached: t.trial.reached,
        error: t.error.filter(|e| e.is_finite()),
        outcome: match &t.trial.end {
            TrialEnd::Done => "completed".to_owned(),
            TrialEnd::GivenUp => "given up".to_owned(),
            TrialEnd::Stopped(e) | TrialEnd::NotStarted(e) => e.code.clone(),
        },
    };
    Entry {
        method: candidate.method.name(),
        formulation: candidate.method.formulation.name().to_owned(),
        integrator: candidate.method.integrator.name().to_owned(),
        control: candidate.method.control().to_owned(),
        slowest_step: candidate.slowest(),
        trials: candidate.trials.iter().map(trial).collect(),
        out: candidate.out.clone(),
        ..Entry::default()
    }
}

/// Returns the basis of a prediction in words.
fn basis(place: &PilotPlace) -> String {
    match (place.is_timed, place.prediction.basis) {
        (true, _) => "timed with this setting".to_owned(),
        (_, Basis::Tried) => "a trial with this setting".to_owned(),
        (_, Basis::Between) => "between two trials".to_owned(),
        (_, Basis::Theory) => "by its order alone: no trial came near the error".to_owned(),
        (_, Basis::Beyond(factor)) if factor < 1.0 => {
            format!("beyond its trials, whose least error is {:.1} times smaller", 1.0 / factor)
        }
        (_, Basis::Beyond(factor)) => {
            format!("beyond its trials, whose least error is {factor:.1} times larger")
        }
    }
}

fn notes(search: &PilotSearch<'_>, places: &[PilotPlace]) -> Vec<String> {
    let (mut notes, error) = (Vec::new(), search.target.error);
    if places.first().is_none_or(|place| !place.reaches) {
        let chosen = match search.target.deadline {
            Some(_) => "chosen is the one with the least",
            None => "chosen is the one that is expected to reach it first",
        };
        notes.push(format!("no trial reached an error of {}: {chosen}", few(error)));
    }
    if search.is_cut {
        notes.push(format!(
            "the pilot ended with its time: {BUDGET} s, or {BUDGET_FRACTION} of the run it expects"
        ));
    }
    if let Some(best) = search.best.filter(|best| best.own > error) {
        notes.push(format!(
            "errors are known to {:.1e} only: the pilot had no time for a better reference",
            best.own
        ));
    }
    notes
}

/// Makes the note that the method in other coordinates did not confirm the choice, with the reason.
pub(super) fn unconfirmed(why: &str) -> String {
    format!("index-3, which shares no model with the chosen one, does not confirm it: {why}")
}

/// Scales CPU times of a shorter pilot span to the whole run, and adds a note about it.
pub(super) fn extend(choice: &mut PilotReport, times: f64) {
    if times <= 1.0 + f64::EPSILON {
        return;
    }
    for candidate in &mut choice.candidates {
        candidate.seconds = candidate.seconds.map(|seconds| seconds * times);
        candidate.error = None;
    }
    choice.notes.push(format!(
        "the pilot saw the first {} s, which is all that its time was enough for: the error of what comes later is not known",
        few(choice.span)
    ));
}

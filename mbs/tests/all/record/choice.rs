//! Table of a choice by measurement, as CSV.

use mbs::record::{Candidate, PilotReport, TrialEntry, write_choice};

#[test]
fn every_trial_has_a_row_and_a_candidate_without_trials_has_one() {
    let trial = TrialEntry { setting: 0.5, outcome: "completed".into(), ..TrialEntry::default() };
    let chosen = Candidate { rank: Some(1), trials: vec![trial; 2], ..Candidate::default() };
    let out = Candidate { out: Some("no tree".into()), ..Candidate::default() };
    let choice = PilotReport { candidates: vec![chosen, out], ..PilotReport::default() };
    let mut sink = Vec::new();
    write_choice(&mut sink, &choice).unwrap();
    let text = String::from_utf8(sink).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 4);
    assert!(lines[1].starts_with("1,") && lines[1].ends_with("completed"), "{text}");
    assert!(lines[3].contains("no tree"), "{text}");
    assert_eq!(choice.table().len(), 3);
}

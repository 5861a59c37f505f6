//! A comparison as CSV.

use mbs::record::RunError;
use mbs_study::compare::results::MethodRuns;
use mbs_study::compare::results::{Comparison, RunEntry, Status, write_comparison};

#[test]
fn a_failure_stands_beside_the_others_with_its_reason() {
    let failure = RunError {
        code: "rank-lost".into(),
        message: "a, b".into(),
        time: 0.5,
        ..RunError::default()
    };
    let failed = RunEntry {
        setting: 1e-3,
        status: Status::Failed,
        failure: Some(failure),
        ..RunEntry::default()
    };
    let runs = vec![failed, RunEntry { not_run: Some("too long".into()), ..RunEntry::default() }];
    let methods = vec![MethodRuns { name: "classical, f64".into(), runs, ..MethodRuns::default() }];
    let mut text = Vec::new();
    write_comparison(&mut text, &Comparison { methods, ..Comparison::default() }).unwrap();
    let text = String::from_utf8(text).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 3);
    assert!(
        lines[1].starts_with("\"classical, f64\",,,,,0.001,failed,rank-lost,\"a, b\",0.5,0,"),
        "{text}"
    );
    assert!(lines[2].contains(",not-run,,too long,"), "{text}");
}

//! Tests of the choice of a method by measurement, through the command.

use crate::files::scratch;
use crate::{json, run, scene, text};
use serde_json::Value;

#[test]
fn the_evidence_stands_in_the_json_in_files_and_on_the_page() {
    let (out, scene) = (scratch("choice-files"), scene("double-pendulum"));
    let folder = out.to_str().unwrap();
    let output = run("run", &[&scene, "--error", "1e-3", "--json", "--out", folder]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let json = json(&output);
    let evidence = &json["chosen"]["evidence"];
    assert_eq!(json["formulation"], "auto");
    assert!(json["chosen"]["reasons"][0].as_str().unwrap().contains("for an error of 0.001"));
    let candidates = evidence["candidates"].as_array().unwrap();
    for [old, new] in
        [["over_chosen", "cost_ratio"], ["out", "rejected"], ["basis", "prediction_basis"]]
    {
        assert!(candidates.iter().all(|c| c.get(old).is_some() && c[old] == c[new]), "{new}");
    }
    assert_eq!(candidates[0]["rank"], 1);
    for candidate in candidates {
        // a candidate has a rank and a cost, or a reason why it is out
        let (is_ranked, is_out) = (candidate["rank"].is_u64(), candidate["out"].is_string());
        assert!(is_ranked != is_out && is_ranked == candidate["seconds"].is_f64(), "{candidate}");
    }
    let beside: Value =
        serde_json::from_slice(&std::fs::read(out.join("choice.json")).unwrap()).unwrap();
    assert_eq!(&beside, evidence);
    let csv = std::fs::read_to_string(out.join("choice.csv")).unwrap();
    assert!(csv.starts_with("rank,method,") && csv.lines().count() > candidates.len());
    let page = std::fs::read_to_string(out.join("run.html")).unwrap();
    assert!(
        page.contains("What was chosen, and what the others would have cost")
            && page.contains("rk54")
    );
}

#[test]
fn malformed_goals_are_refused_with_what_to_write() {
    let scene = scene("double-pendulum");
    for (arguments, says) in [
        (&["--error", "0"][..], "more than 0 and less than 1"),
        (&["--error", "-0.001"], "more than 0 and less than 1"),
        (&["--error", "3"], "more than 0 and less than 1"),
        (&["--error", "small"], "invalid value"),
        (&["--deadline", "-1"], "longer than zero"),
        (&["--deadline", "0"], "longer than zero"),
        (&["--deadline", "1m"], "1ms or 500us"),
        (&["--deadline", "20s"], "longer than the run"),
        (&["--error", "1e-3", "--step", "1e-3"], "--step cannot be given beside"),
        (&["--deadline", "1ms", "--integrator", "rk54"], "choose their own steps"),
        (&["--deadline", "1ms", "--formulation", "multi-index"], "no method goes with"),
        (&["--error", "1e-3", "--formulation", "index-3", "--integrator", "rk4"], "rk4"),
    ] {
        let output = run("run", &[&[scene.as_str()][..], arguments].concat());
        let errors = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {errors}");
        assert!(output.stdout.is_empty() && errors.contains(says), "{arguments:?}: {errors}");
    }
}

#[test]
fn explain_reports_candidates_by_structure_and_with_an_error_what_each_costs() {
    let scene = scene("simple-pendulum");
    let plain = run("explain", &[&scene, "--duration", "0.2"]);
    let text = text(&plain.stdout);
    assert!(text.contains("Choice of formulation") && text.contains("the pilot decides"), "{text}");
    let measured = run("explain", &[&scene, "--duration", "0.2", "--error", "1e-3", "--json"]);
    let json = json(&measured);
    assert!(json["choice"]["candidates"][0]["seconds"].is_f64(), "{}", json["choice"]);
}

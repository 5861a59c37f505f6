//! Orders and ranks of a comparison.

use mbs_study::compare::results::Reference;
use mbs_study::compare::results::{Comparison, MethodRuns, RunEntry, Status};

/// Runs of a method of second order. A step takes 1 us times `cost`, and the runs cover 10 s.
fn method(formulation: &str, control: &str, cost: f64) -> MethodRuns {
    let run = |k: i32| {
        let h = 0.01 * f64::powi(0.5, k);
        let seconds = cost * 1e-6 * 10.0 / h;
        RunEntry {
            setting: h,
            mean_step: h,
            status: Status::Completed,
            steps: (10.0 / h).round() as u64,
            error: Some(10.0 * h * h),
            cpu_seconds: vec![1.03 * seconds, seconds, 1.2 * seconds],
            ..RunEntry::default()
        }
    };
    MethodRuns {
        name: format!("{formulation} {control}"),
        formulation: formulation.to_owned(),
        integrator: "trapezoidal".to_owned(),
        control: control.to_owned(),
        runs: (0..8).map(run).collect(),
        ..MethodRuns::default()
    }
}

#[test]
fn nothing_lies_between_runs_whose_steps_the_results_hold() {
    let has = |control: &str, steps, instants| {
        MethodRuns { control: control.to_owned(), ..MethodRuns::default() }
            .has_between(steps, instants)
    };
    assert!(!has("fixed", [200, 400], 200) && has("fixed", [200, 600], 200));
    assert!(has("fixed", [400, 800], 200) && has("fixed", [200, 400], 50));
    assert!(!has("own", [203, 205], 200) && has("own", [203, 230], 200));
    assert!(has("error", [203, 205], 200));
}

#[test]
fn a_formulation_is_ranked_by_its_fastest_control() {
    let methods = vec![
        method("index-3", "fixed", 2.0),
        method("index-3", "error", 1.0),
        method("slow", "fixed", 4.0),
    ];
    let mut comparison = Comparison { methods, ..Comparison::default() };
    comparison.digest(&[1e-3, 1e-5, 1e-9]);
    let ranks = |level: usize| -> Vec<(usize, &str)> {
        comparison.ranking[level].ranks.iter().map(|r| (r.rank, r.method.as_str())).collect()
    };
    assert_eq!(ranks(0), [(1, "index-3 error"), (2, "slow fixed")]);
    assert_eq!(ranks(1), ranks(0));
    assert_eq!(comparison.ranking[2].not_reached, ["index-3", "slow"]);
    assert!((comparison.methods[0].fit.as_ref().unwrap().order.unwrap() - 2.0).abs() < 1e-9);
    // an error of 1e-3 is that of the first run; the fourth and the fifth run are around 1e-5, at h = 1e-3
    assert_eq!(
        comparison.decisive(&[1e-3, 1e-5]),
        [(1, 0), (1, 3), (1, 4), (2, 0), (2, 3), (2, 4)]
    );
    let mut alone = comparison.methods[1].beside_alone(1e-5);
    assert_eq!((alone.runs.len(), alone.seconds_at(1e-5, 0)), (2, None));
    // all runs take twice their earlier time
    alone.runs.iter_mut().for_each(|run| run.cpu_seconds.push(2e-5 / run.setting));
    assert!((alone.seconds_at(1e-5, 0).unwrap() - 0.02).abs() < 1e-9);
    // an error of 1e-5 needs a step of 1e-3 s
    assert!((comparison.methods[0].at_error[1].unwrap() - 0.02).abs() < 1e-9);
}

#[test]
fn runs_that_are_timed_again_count_with_the_errors_they_counted_with() {
    let mut lucky = method("index-3", "error", 1.0);
    lucky.runs[2].error = Some(1e-9);
    let alone = lucky.beside_alone(1e-4);
    let errors: Vec<f64> = alone.runs.iter().map(|run| run.error.unwrap()).collect();
    assert_eq!(errors, [lucky.runs[1].error.unwrap(), lucky.runs[3].error.unwrap()]);
    let mut again = alone;
    for (run, i) in again.runs.iter_mut().zip([1, 2]) {
        run.cpu_seconds.clone_from(&lucky.runs[i].cpu_seconds);
    }
    assert_eq!(again.seconds_at(1e-4, 0), lucky.seconds_at(1e-4, 0));
}

#[test]
fn errors_that_the_reference_cannot_resolve_are_marked_and_not_ranked() {
    let reference = Reference { uncertainty: 1e-6, ..Reference::default() };
    let methods = vec![method("index-3", "fixed", 1.0)];
    let mut comparison = Comparison { reference, methods, ..Comparison::default() };
    comparison.digest(&[1e-3, 2e-6]);
    assert!(comparison.ranking[1].note.is_some() && comparison.ranking[1].ranks.is_empty());
    let marked: Vec<bool> =
        comparison.methods[0].runs.iter().map(|run| run.is_below_reference).collect();
    assert_eq!(marked, [false, false, false, false, false, true, true, true]);
}

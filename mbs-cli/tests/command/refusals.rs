//! Tests that malformed numbers and tables are refused with the true reason, and a hint that works.

use crate::{run, run_line, scene, status, text, written};

/// Runs the double pendulum with options that are refused. Returns the message.
fn refused(arguments: &[&str]) -> String {
    let output = run("run", &[&[&scene("double-pendulum")[..]], arguments].concat());
    let told = text(&output.stderr);
    assert!(status(&output) == 1 && output.stdout.is_empty(), "{arguments:?}: {told}");
    told
}

#[test]
fn malformed_steps_and_errors_are_refused_with_the_true_reason() {
    for (arguments, reason, hint) in [
        (
            ["--step", "-1e-3"],
            "step must be positive and finite, but is -0.001",
            "larger than zero",
        ),
        (["--step", "-0.5"], "step must be positive and finite, but is -0.5", "larger than zero"),
        (["--step", "NaN"], "step must be positive", "larger than zero"),
        (
            ["--step", "100"],
            "the step of 100 s is longer than the run of 10 s",
            "a step of 10 s at most",
        ),
        (["--step", "1e-300"], "too short for a run of 10 s", "a longer step"),
        (["--duration", "-1e1"], "duration must be positive", "larger than zero"),
        (["--tolerance", "-1e-9"], "tolerance must be positive", "larger than zero"),
        (["--error", "0"], "more than 0 and less than 1, but is 0", "such as 1e-4"),
        (["--error", "NaN"], "more than 0 and less than 1, but is NaN", "such as 1e-4"),
        (["--error", "-1e-3"], "more than 0 and less than 1, but is -0.001", "such as 1e-4"),
        (["--error", "1e-300"], "below the resolution of f64", "1e-13 or more"),
        (["--deadline", "-1e-3"], "must be a time longer than zero", "such as 1ms"),
    ] {
        let told = refused(&arguments);
        assert!(told.contains(reason) && told.contains(hint), "{arguments:?}: {told}");
    }
    // a step may be as long as the run
    let output = run("run", &[&scene("double-pendulum"), "--step", "0.01", "--duration", "0.01"]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
}

#[test]
fn a_choice_reports_the_method_and_the_step_that_ran() {
    let output =
        run("run", &[&scene("double-pendulum"), "--error", "1e-4", "--duration", "2", "--json"]);
    let value = crate::json(&output);
    let ran = value["chosen"]["ran"].as_str().expect("a text");
    let formulation = value["chosen"]["formulation"].as_str().expect("a text");
    assert!(ran.starts_with(formulation), "{ran}");
    let integrator = value["integrator"].as_str().expect("a text");
    assert!(integrator == "trapezoidal" || ran.contains(integrator), "{ran} {integrator}");
    assert!(ran.contains("steps of") || ran.contains("tolerance of"), "{ran}");
    // for a method that controls its steps, the headline has the average step and not the largest one
    let arguments = ["--formulation", "recursive", "--integrator", "rk853", "--step", "0.1"];
    let output = run("run", &[&[&scene("double-pendulum")[..]], &arguments[..]].concat());
    let headline = text(&output.stdout).lines().next().unwrap_or_default().to_owned();
    assert!(
        headline.contains("recursive rk853, f64") && headline.contains("s on average to t = 10 s"),
        "{headline}"
    );
}

#[test]
fn the_help_says_what_the_options_of_radau5_mean() {
    let help = text(&run("run", &["--help"]).stdout);
    let flat = help.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        flat.contains(
            "radau5, also of recursive alone, is implicit and of order 5, for stiff effects; give it a longer --step-max"
        ),
        "{flat}"
    );
    assert!(flat.contains("gbs and radau5 it is the error of each step"), "{flat}");
    assert!(flat.contains("--step-max <H> Longest step"), "{flat}");
    assert!(
        flat.contains("Taken by steps of controlled length, and by rk54, rk853, gbs and radau5"),
        "{flat}"
    );
}

/// Writes a table for a pendulum, and runs `mbs compare` with it.
fn compared(name: &str, table: &str) -> (i32, String) {
    let (scene, file) = (scene("simple-pendulum"), written(&format!("{name}-ref.csv"), table));
    let output = run_line(&format!(
        "compare {scene} --reference {file} --duration 1 --repeats 2 --no-maps --formulation index-3 --precision f64 --steps 1e-2,5e-3"
    ));
    (status(&output), text(&output.stdout) + &text(&output.stderr))
}

#[test]
fn malformed_tables_are_refused_by_their_line() {
    for (name, table, reason) in [
        ("empty", "t,mass.x,mass.y\n", "the reference table has no rows"),
        ("nothing", "", "the first column of the reference table is not `t`"),
        ("order", "t,mass.x\n0.5,1\n0.25,1\n", "line 3 of the reference table is not later"),
        (
            "nan",
            "t,mass.x\n0.5,NaN\n",
            "line 2 of the reference table has no finite number in column `mass.x`",
        ),
        ("column", "t,mass.x,mass.z\n0.5,1,1\n", "`mass.z` is no output of the scene"),
        ("beyond", "t,mass.x\n0.5,1\n400.0,1\n", "line 3 of the reference table is at 400 s"),
    ] {
        let (status, told) = compared(name, table);
        assert!(status == 1 && told.contains(reason) && told.contains("hint:"), "{name}: {told}");
    }
}

#[test]
fn a_table_that_no_method_comes_near_is_not_verified_and_nothing_is_ranked() {
    let rows: String = (1..=10).map(|k| format!("0.{k:02},{}.25,-3.5\n", k % 3)).collect();
    let (status, told) = compared("invented", &format!("t,mass.x,mass.y\n{rows}"));
    assert_eq!(status, 2, "{told}");
    assert!(
        told.contains("NOT verified") && told.contains("differ from invented-ref.csv by"),
        "{told}"
    );
    assert!(!told.contains("Fastest at"), "{told}");
}

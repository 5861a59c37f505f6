//! Formulations that complete a run that stopped with another one.

use crate::clock::CountedClock;
use mbs::core::scene::Scene;
use mbs::{Method, Outcome, ResolvedMethod};
use mbs_study::estimate::estimate;
use mbs_study::remedy::name_what_runs;
use mbs_testkit::repository::field;

fn run(scene: &Scene<f64>, method: &Method) -> Outcome {
    let settings = ResolvedMethod::new(scene, method).expect("the settings are built");
    let mut outcome = mbs::typed::run::<f64, 3>(scene, &settings, &mut ());
    estimate(scene, &settings, &mut outcome, &mut CountedClock::default());
    name_what_runs(scene, (method, &settings), &mut outcome);
    outcome
}

fn by(formulation: &str) -> Method {
    Method { formulation: Some(formulation.to_owned()), ..Method::default() }
}

/// Asserts that the run by `method` stops with this code, and that its error names this formulation, which completes.
fn names(scene: &Scene<f64>, (method, code): (&Method, &str), formulation: &str) -> Outcome {
    let error = run(scene, method).summary.error.expect("it stops");
    assert_eq!(error.code, code);
    let words = format!("formulation {formulation}, which was tried, runs to the end; else ");
    assert!(error.hint.starts_with(&words), "{}", error.hint);
    let other = run(scene, &Method { formulation: Some(formulation.to_owned()), ..method.clone() });
    assert_eq!(other.summary.error, None);
    other
}

#[test]
fn where_a_penalty_that_is_too_small_stops_index_3_the_tree_is_named_and_creeps_as_it_should() {
    let scene = field("58-held-hand");
    let method = Method { penalty: Some(1e5), ..Method::default() };
    let outcome = names(&scene, (&method, "not-converged"), "recursive");
    // regularised friction: the creep rate is s v / sqrt(1 - s^2), where s is weight over friction and v = 1 mm/s; a tilt of 7e-6 rad adds a
    // little
    let creep = outcome.rows().last().expect("rows").1[0];
    assert!((creep + 1.02603e-3).abs() < 3e-6, "{creep}");
}

#[test]
fn where_fixed_steps_lose_the_energy_of_an_impact_controlled_ones_are_named() {
    let scene = field("58-weight-on-a-stop");
    for formulation in ["index-3", "index-1", "classical", "state-space", "recursive"] {
        let outcome = names(&scene, (&by(formulation), "energy-drift"), "multi-index");
        let error = outcome.summary.energy.max_error;
        assert!(error < 1e-5, "{error} J of 9.81 J");
    }
}

#[test]
fn a_run_that_ends_has_no_error_to_name_anything_in() {
    let scene = field("58-weight-on-a-stop");
    let outcome = run(&scene, &Method { step: Some(1e-3), ..Method::default() });
    assert_eq!(outcome.summary.error, None);
    let estimate = outcome.summary.estimate.expect("an estimate");
    assert_eq!(estimate.missing, None);
}

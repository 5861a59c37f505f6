//! What a run says of its own accuracy.

use super::{field, read, text};
use mbs::auto::{Clock, Processor};
use mbs::core::scene::{Dimension, Scene};
use mbs::estimate::estimate;
use mbs::scene_file::ErrorEstimate;
use mbs::{Outcome, Overrides, Settings};

/// Estimates are of this size: neither a third of the error, nor ten times.
const NEAR: [f64; 2] = [1.0 / 3.0, 10.0];
/// Rounding of a result in an error-controlled run, relative.
const CONTROLLED: f64 = 1e-6;

fn run(scene: &Scene<f64>, overrides: &Overrides) -> (Settings, Outcome) {
    let settings = Settings::new(scene, overrides).expect("the settings are built");
    let outcome = match scene.dimension {
        Dimension::Planar => mbs::run::<f64, 2>(scene, &settings, &mut ()),
        Dimension::Spatial => mbs::run::<f64, 3>(scene, &settings, &mut ()),
    };
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    (settings, outcome)
}

fn by(formulation: &str, integrator: &str, tolerance: Option<f64>) -> Overrides {
    let [formulation, integrator] = [formulation, integrator].map(|name| Some(name.to_owned()));
    Overrides { formulation, integrator, tolerance, ..Overrides::default() }
}

/// A default run with its estimate, for which it has the time of a command that also reads the scene and writes the results: twice
/// that of the steps.
fn estimated(scene: &Scene<f64>) -> (Outcome, ErrorEstimate) {
    let mut clock = Processor::new(1);
    let (settings, mut outcome) = run(scene, &Overrides::default());
    let seconds = 2.0 * clock.seconds();
    let before = outcome.rows().to_vec();
    estimate(scene, &settings, &mut outcome, (&mut clock, seconds));
    assert_eq!(before, outcome.rows(), "an estimate changes no result");
    let estimate = outcome.summary.estimate.clone().expect("an estimate, or why there is none");
    (outcome, estimate)
}

fn errors(estimate: &ErrorEstimate) -> Vec<f64> {
    let outputs = estimate.outputs.as_ref().unwrap_or_else(|| panic!("{estimate:?}"));
    outputs.0.iter().flat_map(|(_, errors)| errors.iter().copied()).collect()
}

/// True errors over the estimates, of all components.
fn ratios(scene: &Scene<f64>) -> Vec<f64> {
    let (outcome, estimate) = estimated(scene);
    let (_, reference) = run(scene, &by("recursive", "rk853", Some(1e-12)));
    let error = |c: usize| {
        let rows = outcome.rows().iter().zip(reference.rows());
        rows.map(|((_, a), (_, b))| (a[c] - b[c]).abs()).fold(0.0, f64::max)
    };
    errors(&estimate).iter().enumerate().map(|(c, estimate)| error(c) / estimate).collect()
}

#[test]
fn a_default_run_of_a_light_wrist_states_the_error_that_it_has() {
    let (outcome, estimate) = estimated(&field("09-light-wrist"));
    let joint = outcome.summary.outputs.0.iter().position(|(name, _)| name == "joint6").unwrap();
    let true_error = (outcome.summary.outputs.0[joint].1[0] - -2.659_858_416).abs();
    let stated = estimate.outputs.unwrap().0[joint].1[0];
    assert!(stated > 0.5 * true_error && stated < 2.0 * true_error, "{stated} for {true_error}");
}

#[test]
fn an_error_controlled_run_of_a_light_wrist_has_the_right_values() {
    let scene = field("09-light-wrist");
    let (_, outcome) = run(&scene, &by("recursive", "rk853", Some(1e-10)));
    let right = [
        ("joint1", 4.236_464_485),
        ("joint4", -0.859_316_134),
        ("joint6", -2.659_858_416),
        ("finger_joint1", 6.052_611_540),
    ];
    for (name, value) in right {
        let found = outcome.summary.outputs.0.iter().find(|(n, _)| n == name).unwrap().1[0];
        assert!((found - value).abs() < CONTROLLED * value.abs(), "{name}: {found}");
    }
}

#[test]
fn a_run_whose_step_does_not_resolve_its_motion_says_so() {
    let (outcome, estimate) = estimated(&field("09-fast-rotor"));
    let is_said = outcome.notes().iter().any(|note| note.contains("does not resolve its motion"));
    assert!(is_said, "{:?}", outcome.notes());
    assert!(estimate.turn_per_step.is_some_and(|turn| turn > 0.5), "{estimate:?}");
}

#[test]
fn twenty_arms_with_light_wrists_state_errors_of_the_size_that_they_have() {
    let mut all = Vec::new();
    for seed in 1..=20 {
        all.extend(ratios(&arm(seed)));
    }
    all.sort_by(f64::total_cmp);
    let below = all.iter().filter(|ratio| **ratio <= 3.0).count();
    assert!(100 * below >= 95 * all.len(), "{all:?}");
    let median = all[all.len() / 2];
    assert!(median > 0.1 && median < NEAR[1], "{median}");
}

#[test]
fn a_spring_too_stiff_for_the_step_is_said() {
    let scene = "[scene]\nname = \"stiff\"\ndimension = 2\nduration = 0.5\n\n\
        [[body]]\nname = \"a\"\nmass = 1.0\ncenter = [0.1, 0.0]\ninertia = 0.01\n\n\
        [[joint]]\nname = \"s\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"a\"]\nat = [0.0, 0.0]\naxis = [1.0, 0.0]\n\n\
        [[effect]]\nname = \"k\"\nkind = \"spring-damper\"\nbodies = [\"ground\", \"a\"]\npoints = [[-1.0, 0.0], [0.1, 0.0]]\n\
        stiffness = 1.0e6\nfree_length = 1.1\n\n\
        [[initial]]\njoint = \"s\"\nvalue = 0.001\n";
    let (outcome, estimate) = estimated(&read(scene, "stiff"));
    // 2 pi / sqrt(k / m) = 6.28 ms
    let steps = estimate.steps_per_period.expect("a period");
    assert!((steps - 6.283).abs() < 0.1, "{steps}");
    assert!(outcome.notes().iter().any(|note| note.contains("stiffest force")));
    let ratios = ratios(&read(scene, "stiff"));
    assert!(ratios.iter().all(|r| *r < 3.0), "{ratios:?}");
}

#[test]
fn a_run_that_stops_has_no_estimate_and_says_why() {
    let scene = field("09-light-wrist");
    let overrides = Overrides { energy_alarm: Some(1e-9), ..Overrides::default() };
    let settings = Settings::new(&scene, &overrides).unwrap();
    let mut outcome = mbs::run::<f64, 3>(&scene, &settings, &mut ());
    estimate(&scene, &settings, &mut outcome, (&mut Processor::new(1), 1.0));
    let estimate = outcome.summary.estimate.unwrap();
    assert_eq!(estimate.missing.as_deref(), Some("the run stopped before its end"));
}

/// The light wrist with other masses of its last links, and let go from another state.
fn arm(seed: u32) -> Scene<f64> {
    let mut state = u64::from(seed);
    let mut random = |low: f64, high: f64| {
        // Knuth's multiplier: the high bits are random enough for masses
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * f64::from((state >> 33) as u32) / f64::from(u32::MAX >> 1)
    };
    let (mut scale, mut out) = (1.0, String::new());
    for line in text("09-light-wrist").lines() {
        let number = |key: &str| line.strip_prefix(key).and_then(|x| x.trim().parse::<f64>().ok());
        if let Some(name) = line.strip_prefix("name = ") {
            let is_light = ["link6", "link7", "hand", "finger"].iter().any(|n| name.contains(n));
            scale = if is_light { random(0.3, 1.0) } else { 1.0 };
        }
        let line = if let Some(mass) = number("mass = ") {
            format!("mass = {}", scale * mass)
        } else if let Some(list) = line.strip_prefix("inertia = [") {
            let numbers = list.trim_end_matches(']').split(',').map(|x| x.trim().parse::<f64>());
            let scaled: Vec<_> = numbers.map(|x| format!("{:e}", scale * x.unwrap())).collect();
            format!("inertia = [{}]", scaled.join(", "))
        } else if let Some(value) = number("value = ") {
            format!("value = {}", value * random(0.5, 1.5))
        } else if let Some(rate) = number("rate = ") {
            format!("rate = {}", rate * random(-2.0, 2.0))
        } else {
            line.to_owned()
        };
        out += &line;
        out.push('\n');
    }
    read(&out, "arm")
}

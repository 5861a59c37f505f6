//! Accuracy of a run by its own estimate.

mod differences;

use crate::clock::CountedClock;
use mbs::core::scene::{Dimension, Scene};
use mbs::inside::PreparedRun;
use mbs::record::ErrorEstimate;
use mbs::{Goal, Mechanism, Method, Outcome, ResolvedMethod, Run, Watchers};
use mbs_study::auto::{plan, run_plan};
use mbs_study::estimate::estimate;
use mbs_testkit::repository::{field, read, text};

/// An estimate is right if the true error is at most `STATED` times larger. Estimates have the size of the errors if the median of the ratios
/// is between 1/`MEDIAN` and `MEDIAN`.
const STATED: f64 = 3.0;
const MEDIAN: f64 = 10.0;
/// Rounding of a result in an error-controlled run, relative to the result.
const CONTROLLED: f64 = 1e-6;

fn run(scene: &Scene<f64>, overrides: &Method) -> (ResolvedMethod, Outcome) {
    let settings = ResolvedMethod::new(scene, overrides).expect("the settings are built");
    let outcome = match scene.dimension {
        Dimension::Planar => mbs::typed::run::<f64, 2>(scene, &settings, &mut ()),
        Dimension::Spatial => mbs::typed::run::<f64, 3>(scene, &settings, &mut ()),
    };
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    (settings, outcome)
}

fn by(formulation: &str, integrator: &str, tolerance: Option<f64>) -> Method {
    let [formulation, integrator] = [formulation, integrator].map(|name| Some(name.to_owned()));
    Method { formulation, integrator, tolerance, ..Method::default() }
}

/// Runs a scene with the default method, and estimates its errors.
fn estimated(scene: &Scene<f64>) -> (Outcome, ErrorEstimate) {
    let (settings, mut outcome) = run(scene, &Method::default());
    let before = outcome.rows().to_vec();
    estimate(scene, &settings, &mut outcome, &mut CountedClock::default());
    assert_eq!(before, outcome.rows(), "an estimate changes no result");
    let estimate = outcome.summary.estimate.clone().expect("an estimate, or why there is none");
    (outcome, estimate)
}

fn errors(estimate: &ErrorEstimate) -> Vec<f64> {
    let outputs = estimate.outputs.as_ref().unwrap_or_else(|| panic!("{estimate:?}"));
    outputs.0.iter().flat_map(|(_, errors)| errors.iter().copied()).collect()
}

/// Ratios of true errors to estimates, for all components.
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
    let below = all.iter().filter(|ratio| **ratio <= STATED).count();
    assert!(100 * below >= 95 * all.len(), "{all:?}");
    let median = all[all.len() / 2];
    assert!((1.0 / MEDIAN..MEDIAN).contains(&median), "{median}");
}

/// Scene of a mass of 1 kg on a spring of 1 MN/m, deflected by 1 mm.
const STIFF: &str = "[scene]\nname = \"stiff\"\ndimension = 2\nduration = 0.5\n\n\
        [[body]]\nname = \"a\"\nmass = 1.0\ncenter = [0.1, 0.0]\ninertia = 0.01\n\n\
        [[joint]]\nname = \"s\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"a\"]\nat = [0.0, 0.0]\naxis = [1.0, 0.0]\n\n\
        [[effect]]\nname = \"k\"\nkind = \"spring-damper\"\nbodies = [\"ground\", \"a\"]\npoints = [[-1.0, 0.0], [0.1, 0.0]]\n\
        stiffness = 1.0e6\nfree_length = 1.1\n\n\
        [[initial]]\njoint = \"s\"\nvalue = 0.001\n";

#[test]
fn a_spring_too_stiff_for_the_step_is_said() {
    let (outcome, estimate) = estimated(&read(STIFF, "stiff"));
    // the period is 2 pi / sqrt(k / m) = 6.28 ms, and the step 1 ms
    let steps = estimate.steps_per_period.expect("a period");
    assert!((steps - core::f64::consts::TAU).abs() < 0.1, "{steps}");
    assert!(outcome.notes().iter().any(|note| note.contains("stiffest force")));
    let ratios = ratios(&read(STIFF, "stiff"));
    assert!(ratios.iter().all(|r| *r < STATED), "{ratios:?}");
}

#[test]
fn a_run_that_stops_has_no_estimate_and_says_why() {
    let scene = field("09-light-wrist");
    let overrides = Method { energy_alarm: Some(1e-9), ..Method::default() };
    let settings = ResolvedMethod::new(&scene, &overrides).unwrap();
    let mut outcome = mbs::typed::run::<f64, 3>(&scene, &settings, &mut ());
    estimate(&scene, &settings, &mut outcome, &mut CountedClock::default());
    let estimate = outcome.summary.estimate.unwrap();
    assert_eq!(estimate.missing.as_deref(), Some("the run stopped before its end"));
}

#[test]
fn outputs_of_the_run_alone_have_no_estimate_and_it_is_said() {
    let outputs = "[[output]]\nname = \"r\"\nquantity = \"invariant-error\"\n";
    let bar = "[[body]]\nname = \"b\"\nmass = 1.0\ncenter = [0.5, 0.0]\ninertia = 0.1\n\
        [[joint]]\nname = \"j\"\nkind = \"revolute\"\nbodies = [\"ground\", \"b\"]\nat = [0.0, 0.0]\n";
    let scene = "[scene]\ndimension = 2\nduration = 0.1\ngravity = [0.0, -9.8]\n".to_owned()
        + bar
        + outputs;
    let (_, estimate) = estimated(&read(&scene, "of the run"));
    assert_eq!(estimate.missing.as_deref(), Some("no output is one of the motion"));
    assert!(estimate.outputs.is_none() && estimate.basis.is_none());
}

/// The scene of the light wrist, with other masses of its last links and another initial state.
fn arm(seed: u32) -> Scene<f64> {
    let mut state = u64::from(seed);
    let mut random = |low: f64, high: f64| {
        // a linear congruential generator with Knuth's multiplier; its high bits are random enough
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
            let scaled: Vec<_> =
                numbers.map(|x| format!("{:e}", scale * x.expect("a number"))).collect();
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

/// The wheel of 27-error-stated-of-a-short-run turns by 2 rad exactly: 2 N m on 0.02 kg m² for 0.2 s.
#[test]
fn a_run_of_milliseconds_states_the_error_that_it_has_in_every_formulation() {
    let scene = field("27-error-stated-of-a-short-run");
    for formulation in FORMULATIONS {
        let (settings, mut outcome) = run(&scene, &by(formulation, "trapezoidal", None));
        estimate(&scene, &settings, &mut outcome, &mut CountedClock::default());
        let estimate = outcome.summary.estimate.clone().expect("an estimate");
        let rows = outcome.rows().iter();
        let error = rows.map(|(t, row)| (row[0] - 50.0 * t * t).abs()).fold(0.0, f64::max);
        let stated = errors(&estimate)[0];
        assert!(3.0 * stated >= error, "{formulation}: {stated} for {error}");
        // the rounding of an angle of 2 rad, 1e-12, is too small for an estimate
        assert!(stated <= 3.0 * error + 1e-12, "{formulation}: {stated} for {error}");
    }
}

/// Rates of two gears: the first has 0.7 N m · t over the reduced inertia 0.02 + (2/3)² 0.04 kg m², the second two thirds of it.
#[test]
fn a_short_run_of_a_gear_pair_states_the_error_that_it_has_in_every_formulation() {
    let scene = field("22-gear-joint-wheel-first");
    let rate = 0.7 / (0.02 + 4.0 / 9.0 * 0.04);
    for formulation in FORMULATIONS {
        let (settings, mut outcome) = run(&scene, &by(formulation, "trapezoidal", None));
        estimate(&scene, &settings, &mut outcome, &mut CountedClock::default());
        let estimate = outcome.summary.estimate.clone().expect("an estimate");
        for (c, right) in [rate, -2.0 / 3.0 * rate].into_iter().enumerate() {
            let rows = outcome.rows().iter();
            let error = rows.map(|(t, row)| (row[c] - right * t).abs()).fold(0.0, f64::max);
            let stated = errors(&estimate)[c];
            assert!(3.0 * stated >= error, "{formulation}: {stated} for {error}");
            assert!(stated <= 3.0 * error + 1e-10, "{formulation}: {stated} for {error}");
        }
    }
}

/// Clock of a machine that is busy with other work.
#[derive(Default)]
struct Busy(f64);

impl mbs_study::auto::Clock for Busy {
    fn seconds(&mut self) -> f64 {
        self.0 += 1000.0;
        self.0
    }
}

#[test]
fn an_idle_and_a_loaded_machine_state_the_same_errors() {
    for name in ["09-light-wrist", "22-gear-joint-wheel-first"] {
        let scene = field(name);
        let (settings, mut outcome) = run(&scene, &Method::default());
        let mut stated = |clock: &mut dyn mbs_study::auto::Clock| {
            estimate(&scene, &settings, &mut outcome, clock);
            let estimate = outcome.summary.estimate.clone().expect("an estimate");
            ErrorEstimate { cpu_seconds: 0.0, ..estimate }
        };
        let idle = stated(&mut CountedClock::default());
        assert_eq!(idle, stated(&mut Busy::default()), "{name}");
    }
}

/// A stiff spring whose vibration no output shows: the mass starts at rest in its equilibrium.
#[test]
fn a_stiff_force_that_does_not_swing_is_not_mentioned() {
    let at_rest = STIFF.replace("value = 0.001", "value = 0.0");
    let (outcome, estimate) = estimated(&read(&at_rest, "stiff"));
    assert!(estimate.steps_per_period.is_some_and(|steps| steps < 10.0), "{estimate:?}");
    assert!(!outcome.notes().iter().any(|note| note.contains("stiffest force")));
}

/// Names of all formulations.
const FORMULATIONS: [&str; 6] =
    ["index-3", "index-1", "multi-index", "classical", "state-space", "recursive"];
/// Ten times the relative error of the trapezoidal rule for directions that turn at w = 8.4 rad/s with steps of h = 1 ms: (w h)²/12 [-].
const AT_A_MILLISECOND: f64 = 6e-5;

/// Returns the last values of an output's components.
fn last(outcome: &Outcome, name: &str) -> Vec<f64> {
    let found = outcome.summary.outputs.0.iter().find(|(n, _)| n == name);
    found.unwrap_or_else(|| panic!("no output {name}")).1.clone()
}

#[test]
fn a_torque_acts_on_the_angle_of_a_planar_free_joint() {
    let scene = field("17-torque-on-planar-free-joint");
    for formulation in FORMULATIONS {
        let (_, outcome) = run(&scene, &by(formulation, "trapezoidal", None));
        let rates = last(&outcome, "j_rate");
        let rate = rates.last().copied().unwrap_or_default();
        assert!((rate - 8.4).abs() < AT_A_MILLISECOND * 8.4, "{formulation}: {rate}");
    }
}

#[test]
fn a_torque_acts_on_the_angle_of_a_cylindrical_joint_whose_bodies_stand_in_reverse() {
    let scene = field("17-torque-on-reversed-cylindrical");
    for formulation in FORMULATIONS {
        let (_, outcome) = run(&scene, &by(formulation, "trapezoidal", None));
        for (rate, right) in last(&outcome, "j_rate").iter().zip([1.661_124_909, 5.317_300_217]) {
            assert!(
                (rate - right).abs() < AT_A_MILLISECOND * right,
                "{formulation}: {rate} for {right}"
            );
        }
    }
}

#[test]
fn a_choice_by_measurement_is_right_or_refused_where_coordinates_disagree() {
    let cases = [
        ("17-torque-on-planar-free-joint", 2, 8.4),
        ("17-torque-on-reversed-cylindrical", 1, 5.317_300_217),
    ];
    for (name, component, right) in cases {
        let mechanism = Mechanism::parse(&text(name)).expect("it is a scene");
        let options = Run::new().goal(Goal { error: Some(1e-4), deadline: None });
        let run = PreparedRun::new(&mechanism, &options).expect("the settings go together");
        let Ok(plan) = plan(&run, &mut CountedClock::default()) else { continue };
        let (outcome, settings) = run_plan(&run, &plan, &mut Watchers::default()).unwrap();
        let rate = last(&outcome, "j_rate")[component];
        let limit = 1e-3 * right;
        assert!((rate - right).abs() < limit, "{name}: {rate} by {:?}", settings.formulation);
    }
}

#[test]
fn a_choice_for_a_vehicle_that_jumps_sees_its_landing_and_keeps_its_error() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/iltis-jump.toml");
    let mechanism = Mechanism::read(path).expect("it is a scene");
    let scene = mechanism.resolve().expect("it is a scene");
    let base = Method { formulation: Some("auto".to_owned()), ..Method::default() };
    let options = Run::new().method(base).goal(Goal { error: Some(1e-2), deadline: None });
    let prepared = PreparedRun::new(&mechanism, &options).expect("the settings go together");
    let plan = plan(&prepared, &mut CountedClock::default()).unwrap();
    let (outcome, settings) = run_plan(&prepared, &plan, &mut Watchers::default()).unwrap();
    let exact = Method { step: Some(0.05), ..by("recursive", "rk853", Some(1e-10)) };
    let (_, reference) = run(&scene, &exact);
    let chassis = |row: &[f64]| [row[0], row[2]];
    let mut compared = 0;
    for (t, row) in outcome.rows() {
        let same = reference.rows().iter().find(|(other, _)| (other - t).abs() < 1e-9);
        let Some((_, right)) = same else { continue };
        compared += 1;
        for (a, b) in chassis(row).into_iter().zip(chassis(right)) {
            // the chassis travels 50 m, and all components of its channel have one range
            assert!((a - b).abs() < 2.0 * 1e-2 * 50.0, "{t} s: {a} for {b} by {settings:?}");
        }
    }
    assert!(compared > 100, "{compared}");
    let choice = plan.first().choice.as_ref().expect("a choice");
    assert!((choice.span - 10.0).abs() < 1e-9, "it saw {} s", choice.span);
}

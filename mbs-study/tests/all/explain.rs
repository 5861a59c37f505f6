//! Explanations of scenes, and the changes by leaving an effect out. No time is asserted.

mod timing;

use mbs::record::Provenance;
use mbs::{Method, ResolvedMethod};
use mbs_core::scene::Scene;
use mbs_report::explanation as explanation_text;
use mbs_study::explain::{EffectCost, Explanation, SearchEnd};
use mbs_study::explain::{Effort, explain};
use mbs_testkit::repository::path;

/// Effort with few timed steps; all other measurements are made in full.
const LITTLE: Effort = Effort { timed_steps: 20, repeats: 2, seconds: 60.0 };

/// Pendulum of 1 kg and 1 m with effects, which starts at rest at 60 degrees.
fn pendulum(effects: &str) -> Scene<f64> {
    mbs_testkit::scene(&format!(
        r#"
[scene]
name = "pendulum"
dimension = 2
duration = 2.0
gravity = [0.0, -9.81]
[[body]]
name = "bob"
mass = 1.0
center = [0.8660254037844386, -0.5]
inertia = 0.1
[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["ground", "bob"]
at = [0.0, 0.0]
{effects}
"#
    ))
}

const DAMPER: &str = r#"
[[effect]]
name = "damper"
kind = "torsion-spring"
joint = "pivot"
stiffness = 0.0
damping = 2.0
free_value = 0.0
"#;

const IDLE: &str = r#"
[[effect]]
name = "idle"
kind = "torque"
joint = "pivot"
value = 0.0
"#;

fn explained(scene: &Scene<f64>) -> (Explanation, ResolvedMethod) {
    let overrides = Method { step: Some(1e-2), ..Method::default() };
    let settings = ResolvedMethod::new(scene, &overrides).expect("the settings are built");
    (explain::<f64, 2>(scene, &settings, &LITTLE), settings)
}

fn price<'a>(explanation: &'a Explanation, name: &str) -> &'a EffectCost {
    let prices = explanation.prices.as_ref().expect("it starts");
    prices.effects.iter().find(|p| p.names == [name]).expect("it is on the list")
}

#[test]
fn an_idle_spin_is_reported_where_a_thin_rod_has_one() {
    let text = r#"
[scene]
dimension = 3
duration = 0.1
gravity = [0.0, 0.0, -9.81]
[[body]]
name = "on-ball"
rod = { from = [0.0, 0.0, 0.0], to = [1.0, 0.0, 0.0] }
mass = 1.0
[[body]]
name = "on-hinge"
rod = { from = [0.0, 3.0, 0.0], to = [1.0, 3.0, 0.0] }
mass = 1.0
[[joint]]
name = "ball"
kind = "spherical"
bodies = ["ground", "on-ball"]
at = [0.0, 0.0, 0.0]
[[joint]]
name = "hinge"
kind = "revolute"
bodies = ["ground", "on-hinge"]
at = [0.0, 3.0, 0.0]
axis = [0.0, 1.0, 0.0]
"#;
    let scene = mbs_testkit::scene(text);
    let settings = ResolvedMethod::new(&scene, &Method::default()).expect("the settings are built");
    let simulated = explain::<f64, 3>(&scene, &settings, &LITTLE).simulated;
    let rods: Vec<_> =
        simulated.rods.iter().map(|rod| (rod.body.as_str(), rod.idle_spin_carried)).collect();
    assert_eq!(rods, [("on-ball", false), ("on-hinge", true)]);
    // degrees of freedom: two swings of the ball joint and one rotation of the hinge; relative coordinates also have the rod's spin
    assert_eq!((simulated.dof, simulated.relative.map(|r| r.sizes.dof)), (Some(3), Some(4)));
    let planar = explained(&mbs_testkit::file("guided-four-bar")).0;
    assert!(planar.simulated.rods.is_empty(), "the plane has no such spin");
}

#[test]
fn a_switched_off_effect_is_named_and_absent() {
    let off = DAMPER.replace("kind", "enabled = false\nkind");
    let (explanation, _) = explained(&pendulum(&off));
    assert_eq!(explanation.effects.len(), 1);
    assert!(!explanation.effects[0].enabled && explanation.effects[0].kind == "torsion-spring");
    assert!(explanation.absent.iter().any(|a| a.what == "damping"));
    assert!(explanation.prices.expect("it starts").effects.is_empty());
    let (explanation, _) = explained(&pendulum(DAMPER));
    assert!(!explanation.absent.iter().any(|a| a.what == "damping"));
    assert!(explanation.absent.iter().any(|a| a.what == "springs"), "it has no stiffness");
}

#[test]
fn leaving_a_damper_out_changes_what_two_runs_differ_by_and_an_idle_effect_changes_nothing() {
    let scene = pendulum(&[DAMPER, IDLE].concat());
    let (explanation, settings) = explained(&scene);
    let mut free = scene.clone();
    free.effects[0].enabled = false;
    let [with, without] = [&scene, &free].map(|s| mbs::typed::run::<f64, 2>(s, &settings, &mut ()));
    let rows = with.rows().iter().zip(without.rows());
    let by_hand = rows.map(|(a, b)| (a.1[0] - b.1[0]).abs()).fold(0.0, f64::max);
    assert!(by_hand > 0.1, "{by_hand} rad");
    let changes = &price(&explanation, "damper").changes;
    assert_eq!(
        (changes.len(), changes[0].output.as_str(), changes[0].unit.as_str()),
        (1, "pivot", "rad")
    );
    assert_eq!(changes[0].largest.to_bits(), by_hand.to_bits());
    assert!((changes[0].relative.expect("it moves") * changes[0].range - by_hand).abs() < 1e-12);

    let idle = price(&explanation, "idle");
    /// Rounding difference of the same sum in another order [rad].
    const ROUNDING: f64 = 1e-12;
    assert!(idle.completed && idle.changes[0].largest < ROUNDING, "{:?}", idle.changes);
    assert!(idle.changes[0].is_rounding && !changes[0].is_rounding);
    assert!(idle.largest_change().is_none());
}

#[test]
fn what_is_rounding_beside_the_scene_is_no_change() {
    // a guided joint follows its guide, whatever effects act on other joints
    let text = std::fs::read_to_string(path("guided-four-bar")).expect("it is there");
    let effect = DAMPER.replace("pivot", "rocker-pivot");
    let (explanation, _) = explained(&mbs_testkit::scene(&format!("{text}\n{effect}")));
    let changes = &price(&explanation, "damper").changes;
    let of = |output: &str, unit: &str| {
        let mut found = changes.iter().filter(|c| c.output == output && c.unit == unit);
        found.next().expect("it is an output")
    };
    assert!(of("crank-angle", "rad").is_rounding && of("rocker-angle", "rad").is_rounding);
    // the damper changes the driving moment; a channel has an entry for each of its units
    assert!(!of("crank-reaction", "N m").is_rounding && !of("crank-reaction", "N").is_rounding);
}

#[test]
fn effects_of_a_kind_are_left_out_together_too() {
    let second = DAMPER.replace("\"damper\"", "\"brake\"");
    let (explanation, _) = explained(&pendulum(&[DAMPER, IDLE, &second].concat()));
    let prices = explanation.prices.as_ref().expect("it starts");
    assert_eq!(prices.effects.len(), 3);
    assert_eq!(prices.kinds.len(), 1, "one torque is no group");
    assert_eq!(prices.kinds[0].names, ["damper", "brake"]);
    let together = prices.kinds[0].changes[0].largest;
    assert!(together > price(&explanation, "brake").changes[0].largest);
    let text = explanation_text(&explanation, Provenance::default()).text();
    assert!(text.contains("all 2 torsion-spring") && text.contains("fraction of a step"), "{text}");
}

#[test]
fn the_largest_step_completes_and_twice_as_long_a_one_does_not() {
    let scene = pendulum(DAMPER);
    let (explanation, settings) = explained(&scene);
    let prices = explanation.prices.as_ref().expect("it starts");
    for (found, enabled) in
        [(&prices.largest_step, true), (&price(&explanation, "damper").largest_step, false)]
    {
        let step = found.step.expect("the given one completes");
        let doublings = (step / settings.step).log2();
        assert!((doublings - doublings.round()).abs() < 1e-9 && doublings > -0.5);
        let mut scene = scene.clone();
        scene.effects[0].enabled = enabled;
        let completes = |step: f64| {
            let settings = ResolvedMethod { step, step_max: step, ..settings.clone() };
            mbs::typed::run::<f64, 2>(&scene, &settings, &mut ()).summary.completed
        };
        assert!(completes(step));
        match found.end {
            SearchEnd::Stops => assert!(!completes(2.0 * step)),
            SearchEnd::Limit => assert!(2.0 * step > settings.duration / 10.0),
            SearchEnd::NotMeasured => panic!("a minute is enough"),
        }
    }
}

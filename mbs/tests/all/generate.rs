//! Generated scenes: the requested numbers of bodies and joints, a consistent start, and a motion without faults.

use mbs::scene_file::{Family, GenerateError, SceneFile, generate};
use mbs::{Method, Outcome};
use mbs_core::scene::Scene;

const COMMAND: &str = "mbs generate";

/// Position violation of index-3 after its projections [m]: the rounding of lengths of some metres.
const VIOLATION: f64 = 1e-10;
/// Energy error of the trapezoidal rule over the first hundred steps of 1 ms, relative to the exchanged energy [-]. The rule is of second
/// order, and these motions take seconds.
const DRIFT: f64 = 1e-3;

fn scene(family: &Family<'_>) -> Scene<f64> {
    let text = generate(family, COMMAND).expect("a scene");
    assert!(text.starts_with("# ") && text.contains("# Made by `mbs generate`."));
    SceneFile::parse(&text, "generated.toml").and_then(|d| d.scene()).expect("can be read")
}

/// Returns the numbers of bodies, joints and outputs.
fn counts(scene: &Scene<f64>) -> [usize; 3] {
    [scene.bodies.len(), scene.joints.len(), scene.outputs.len()]
}

fn vehicle(name: &str) -> SceneFile {
    let file = format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&file).expect("a scene of this repository");
    SceneFile::parse(&text, &file).expect("TOML")
}

/// Runs the first tenth of a second in index-3, and asserts that violation and energy error are small.
fn run(scene: &Scene<f64>) -> Outcome {
    let overrides = Method {
        formulation: Some("index-3".to_owned()),
        step: Some(1e-3),
        duration: Some(0.1),
        ..Method::default()
    };
    let outcome = crate::common::run(scene, &overrides);
    let summary = &outcome.summary;
    assert!(summary.completed, "{}: {:?}", summary.scene, summary.error);
    let position = summary.violation.position;
    assert!(position < VIOLATION, "{}: {position} m", summary.scene);
    let (error, turned) = (summary.energy.max_error, summary.energy.turned_over);
    assert!(error < DRIFT * turned, "{}: {error} J of {turned} J", summary.scene);
    outcome
}

#[test]
fn a_chain_has_a_joint_for_each_link_and_keeps_its_energy() {
    for n in [1, 2, 7, 40] {
        let scene = scene(&Family::Chain { bodies: n });
        assert_eq!(counts(&scene), [n, n, 2]);
        run(&scene);
    }
    // four kinds of joints alternate, with 1 + 2 + 1 + 3 degrees of freedom
    assert_eq!(run(&scene(&Family::Chain { bodies: 40 })).summary.dof, 70);
}

#[test]
fn a_tree_has_one_freedom_for_each_bar_and_keeps_its_energy() {
    for n in [1, 2, 63] {
        let scene = scene(&Family::Tree { bodies: n });
        assert_eq!(counts(&scene), [n, n, 2]);
        assert_eq!(run(&scene).summary.dof, n);
    }
}

#[test]
fn forty_four_bars_are_the_scene_of_that_name() {
    let generated = scene(&Family::FourBars { loops: 40 });
    let written = vehicle("n-four-bar-40").scene::<f64>().expect("a scene");
    assert_eq!(generated, written);
    let scene = scene(&Family::FourBars { loops: 5 });
    assert_eq!(counts(&scene), [11, 16, 2]);
    assert_eq!(run(&scene).summary.dof, 1);
}

#[test]
fn a_net_has_a_freedom_less_for_each_rod_and_keeps_its_energy() {
    for [rows, columns] in [[2, 2], [3, 5]] {
        let scene = scene(&Family::Net { rows, columns });
        let rods = rows * (columns + 1) + columns * (rows + 1);
        let knots = (rows + 1) * (columns + 1);
        // each rod after the first one at a knot has a joint there, and each corner has a joint with the ground
        assert_eq!(counts(&scene), [rods, 2 * rods - knots + 4, 2]);
        let summary = run(&scene).summary;
        assert_eq!(summary.dof, 3 * (knots - 4) - rods);
        assert_eq!(summary.constraints, rods, "a rod stays two points");
    }
    for bodies in [1, 12, 100, 2000] {
        let Family::Net { rows, columns } = Family::net_of(bodies) else { panic!("a net") };
        let size = |n: usize| 2 * n * (n + 1);
        let off = size(rows).abs_diff(bodies);
        assert!(rows == columns && off <= size(rows + 1).abs_diff(bodies));
        assert!(rows == 2 || off <= size(rows - 1).abs_diff(bodies));
    }
}

#[test]
fn a_convoy_is_the_vehicle_many_times_over_on_one_road() {
    let document = vehicle("iltis-stairs");
    let one = document.scene::<f64>().expect("a scene");
    let convoy = |count| scene(&Family::Convoy { vehicle: &document, count, spacing: 8.0 });
    let (three, [bodies, joints, outputs]) = (convoy(3), counts(&one));
    assert_eq!(counts(&three), [3 * bodies, 3 * joints, 2 * outputs]);
    assert_eq!(three.effects.len(), 3 * one.effects.len());
    assert_eq!(three.road, one.road);
    let [first, last] = [0, 2].map(|k| three.bodies[k * bodies].center);
    assert_eq!((first, last), (one.bodies[0].center, [-16.0, 0.0, 0.57]));
    let outcome = run(&convoy(2));
    // the road is level at first: both vehicles move alike, 8 m apart, except for the rounding of positions
    let (_, row) = outcome.rows().last().expect("the end");
    let half = row.len() / 2;
    assert!((row[0] - row[half] - 8.0).abs() < 1e-6 && (row[2] - row[half + 2]).abs() < 1e-6);
    assert_eq!(counts(&convoy(1)), [bodies, joints, outputs]);
}

#[test]
fn what_cannot_be_made_is_refused_with_a_hint() {
    let document = vehicle("iltis-stairs");
    let pendulum = vehicle("double-pendulum");
    let convoy = |vehicle, count, spacing| Family::Convoy { vehicle, count, spacing };
    let faults = [
        (Family::Chain { bodies: 0 }, GenerateError::TooFew { given: 0, least: 1 }),
        (Family::Tree { bodies: 0 }, GenerateError::TooFew { given: 0, least: 1 }),
        (Family::FourBars { loops: 0 }, GenerateError::TooFew { given: 0, least: 1 }),
        (Family::Net { rows: 5, columns: 1 }, GenerateError::TooFew { given: 1, least: 2 }),
        (convoy(&document, 0, 8.0), GenerateError::TooFew { given: 0, least: 1 }),
        (convoy(&document, 2, -1.0), GenerateError::Spacing(-1.0)),
        (convoy(&pendulum, 2, 8.0), GenerateError::NoTires),
    ];
    for (family, expected) in faults {
        let error = generate(&family, COMMAND).expect_err("refused");
        assert_eq!(error, expected);
        assert!(!error.hint().is_empty());
    }
    for family in [
        Family::Chain { bodies: usize::MAX },
        Family::FourBars { loops: usize::MAX },
        Family::Net { rows: usize::MAX, columns: usize::MAX },
        convoy(&document, usize::MAX, 8.0),
    ] {
        assert!(matches!(generate(&family, COMMAND), Err(GenerateError::TooMany { .. })));
    }
    let broken = SceneFile::parse("[scene]\n", "broken.toml").expect("TOML");
    assert_eq!(generate(&convoy(&broken, 2, 8.0), COMMAND), Err(GenerateError::NoScene));
}

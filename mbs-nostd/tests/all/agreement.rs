//! The solver of fixed capacity compared with mbs-recursive on the same scenes.

use crate::support::start;
use mbs_core::effects::{bushing, laws::SpringDamperLaw};
use mbs_core::integrator::Integrator;
use mbs_core::step::{OptionError, StepError};
use mbs_nostd::export::{Collected, bytes, elements, needs, source};
use mbs_nostd::table::{Law, Load, Measure};
use mbs_nostd::{Bounds, Checked, LoadError, Options, Planar, Solver, Spatial, Tables, Unwatched};
use mbs_recursive::{TreeMethod, TreeModel, TreeState, Workspace};
use mbs_testkit::file;

/// Solver with memory for the vehicle.
type Room = Solver<f64, Spatial, 12, 40, 32, 16, 256, 256, 2, 8>;
type RoomTables = Tables<f64, Spatial, 12, 12, 16, 64, 24, 64, 8, 40>;

fn vehicle(name: &str) -> (TreeModel<f64, Spatial>, TreeState<f64>) {
    start::<Spatial, 3>(&file(name))
}

#[test]
fn a_solver_of_fixed_capacity_gives_the_bits_of_the_recursion() {
    for name in
        ["iltis-slalom", "iltis-jump", "iltis-suspension", "spatial-four-bar", "rolling-disc"]
    {
        let (tree, begin) = vehicle(name);
        let collected = Collected::new(&tree, &begin, &[]).expect("no signals");
        let text = bytes(&collected.model(), false).expect("a scene without own laws");
        let tables = RoomTables::read(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
        let flash = Checked::new(&collected.model()).unwrap_or_else(|e| panic!("{name}: {e}"));
        let read = tables.model();
        let mut solvers = [Room::new(&flash), Room::new(&read)].map(|s| s.expect("room"));
        let (mut state, mut workspace) = (begin.clone(), Workspace::new(&tree));
        let (options, bounds) = (Options::default(), Bounds::default());
        for _ in 0..500 {
            tree.bounded_step((1e-3, &options, bounds), &mut state, &mut workspace)
                .unwrap_or_else(|e| panic!("{name}: {e}"));
            for (solver, model) in solvers.iter_mut().zip([&flash, &read]) {
                solver.step(model, 1e-3, &mut Unwatched).unwrap_or_else(|e| panic!("{name}: {e}"));
                assert_eq!(solver.coordinates(), &state.z[..], "{name}");
                assert_eq!(solver.velocities(), &state.v[..], "{name}");
                assert_eq!(solver.accelerations(), &state.a[..], "{name}");
            }
        }
    }
}

/// A scene with a housing that can turn freely, and two wheels in it that mesh as gears.
const GEARS: &str = include_str!("couplings.toml");

const DRIVEN: &str = r#"
[[coupling]]
name = "drive"
kind = "linear"
terms = [{ joint = "a", factor = 1.0 }, { joint = "hinge", factor = 0.5 }]
sine = { amplitude = 0.3, frequency = 1.0 }
"#;

/// Returns the largest difference of coordinates and accelerations between solver and recursion over steps of a scene.
fn apart_on_controller(text: &str) -> Result<f64, LoadError> {
    type Small = Solver<f64, Planar, 5, 5, 5, 5, 64, 64, 4, 1, 0, 0, 3>;
    let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(text));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signal moves");
    let flash = Checked::new(&collected.model())?;
    let bytes = bytes(&collected.model(), false).expect("a scene of tables");
    let tables = Tables::<f64, Planar, 5, 4, 4, 16, 4, 4, 4, 5>::read(&bytes)?;
    let read = tables.model();
    let mut solvers = [Small::new(&flash), Small::new(&read)].map(|s| s.expect("room"));
    let (mut state, mut workspace) = (begin.clone(), Workspace::new(&tree));
    let (options, bounds) = (Options::default(), Bounds::default());
    let mut worst = 0.0_f64;
    for _ in 0..500 {
        tree.bounded_step((1e-3, &options, bounds), &mut state, &mut workspace).expect("a step");
        for (solver, model) in solvers.iter_mut().zip([&flash, &read]) {
            solver.step(model, 1e-3, &mut Unwatched).expect("a step");
            let own = solver.coordinates().iter().chain(solver.accelerations());
            for (x, y) in own.zip(state.z.iter().chain(&state.a)) {
                worst = worst.max((x - y).abs());
            }
        }
    }
    Ok(worst)
}

#[test]
fn couplings_of_joints_hold_on_a_controller_as_in_the_recursion() {
    assert_eq!(apart_on_controller(GEARS), Ok(0.0));
    assert_eq!(apart_on_controller(&format!("{GEARS}{DRIVEN}")), Ok(0.0));
    // The constant of an exported guide is stored separately, which changes the rounding of the accelerations.
    let held = format!("{GEARS}{}", DRIVEN.replace("sine", "value = 0.1\nsine"));
    let apart = apart_on_controller(&held).expect("a model");
    assert!(apart < 1e-10, "{apart}");
    for signal in [
        "kind = \"constant\"\nvalue = 0.2",
        "kind = \"table\"\ntable = [[0.0, 0.0], [0.6, 0.4]]\nends = \"level\"",
        "kind = \"step\"\nfrom = -0.1\nto = 0.3\nrise = 0.4",
    ] {
        let followed = DRIVEN
            .replace("sine = { amplitude = 0.3, frequency = 1.0 }", "signal = \"s\"\nvalue = 0.1");
        let signal = format!("[[signal]]\nname = \"s\"\n{signal}\n");
        let apart = apart_on_controller(&format!("{GEARS}{followed}{signal}")).expect("a model");
        assert!(apart < 1e-10, "{signal}{apart}");
    }
}

/// A third wheel, and a differential between all three wheels.
const DIFFERENTIAL: &str = r#"
[[body]]
name = "third"
mass = 0.7
center = [0.01, 0.3]
inertia = 0.01
[[joint]]
name = "c"
kind = "revolute"
bodies = ["housing", "third"]
at = [0.0, 0.3]
[[coupling]]
name = "differential"
kind = "differential"
joints = ["a", "b", "c"]
"#;

#[test]
fn a_coupling_of_joints_on_three_branches_holds_on_a_controller_as_in_the_recursion() {
    type Two = Solver<f64, Planar, 5, 5, 5, 5, 64, 64, 4, 1>;
    let meshed = format!("{GEARS}{DIFFERENTIAL}");
    assert_eq!(apart_on_controller(&meshed), Ok(0.0));
    let alone = GEARS.split("[[coupling]]").next().expect("what stands before");
    let text = format!("{alone}{DIFFERENTIAL}");
    assert_eq!(apart_on_controller(&text), Ok(0.0));
    let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(&text));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signal moves");
    let checked = Checked::new(&collected.model()).expect("a model");
    assert_eq!(checked.sizes().sides, 3);
    let of_two = LoadError::Capacity { of: "sides of rows", needed: 3, capacity: 2 };
    assert_eq!(Two::new(&checked).err(), Some(of_two));
    let source = source(&collected.model(), ("A differential", false)).expect("tables");
    assert!(source.contains(", 0, 0, 3>;"), "{source}");
}

#[test]
fn the_drive_line_of_a_vehicle_has_the_bits_of_the_recursion() {
    type Vehicle = Solver<f64, Spatial, 18, 40, 32, 16, 256, 256, 2, 24, 2, 24, 3>;
    let (tree, begin) = vehicle("iltis-drive-line");
    let collected = Collected::new(&tree, &begin, &[]).expect("signals of a controller");
    let model = Checked::new(&collected.model()).expect("a model");
    assert_eq!(elements(model.model()), ["couplings", "signals"]);
    let mut solver = Vehicle::new(&model).expect("room");
    let (mut state, mut workspace) = (begin.clone(), Workspace::new(&tree));
    let (options, bounds) = (Options::default(), Bounds::default());
    for _ in 0..200 {
        tree.bounded_step((1e-3, &options, bounds), &mut state, &mut workspace).expect("a step");
        solver.step(&model, 1e-3, &mut Unwatched).expect("a step");
        assert_eq!(solver.coordinates(), &state.z[..]);
        assert_eq!(solver.accelerations(), &state.a[..]);
    }
}

const ROTORS: &str = r#"
[[effect]]
kind = "rotor"
joint = "b"
inertia = 1.0e-4
ratio = 70.0

[[effect]]
kind = "rotor"
joint = "hinge"
inertia = 2.0e-4
ratio = 30.0
"#;

#[test]
fn rotors_turn_on_a_controller_as_in_the_recursion() {
    assert_eq!(apart_on_controller(&format!("{GEARS}{ROTORS}")), Ok(0.0));
    let arm =
        std::fs::read_to_string(mbs_testkit::repository::path("geared-arm")).expect("a scene");
    assert_eq!(apart_on_controller(&arm), Ok(0.0));
    // models without optional parts have version 2
    let version = |text: &str| {
        let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(text));
        let collected = Collected::new(&tree, &begin, &[]).expect("no signal moves");
        let bytes = bytes(&collected.model(), false).expect("a scene of tables");
        u32::from_le_bytes([bytes[4], bytes[5], bytes[6], bytes[7]])
    };
    let off = ROTORS.replace("kind = \"rotor\"", "kind = \"rotor\"\nenabled = false");
    assert_eq!([GEARS, &format!("{GEARS}{off}"), &arm].map(version), [2, 2, 3]);
}

#[test]
fn laws_on_sums_act_on_a_controller_as_in_the_recursion() {
    let spring =
        "[[effect]]\nkind = \"torsion-spring\"\nstiffness = 9.0\ndamping = 0.3\nfree_value = 0.2\n";
    let sum = "terms = [{ joint = \"a\", factor = 1.0 }, { joint = \"b\", factor = -2.5 }]\n";
    let alone = GEARS.split("[[coupling]]").next().expect("what stands before");
    for scene in [GEARS, alone] {
        assert_eq!(apart_on_controller(&format!("{scene}{spring}{sum}")), Ok(0.0));
    }
}

/// Returns the largest difference of a coordinate from the converged trapezoidal rule over 10 s [m or rad].
fn apart(name: &str, evaluations: u32) -> f64 {
    let (tree, begin) = vehicle(name);
    let (mut state, mut workspace) = (begin.clone(), Workspace::new(&tree));
    let (mut exact, mut other) = (begin.clone(), Workspace::new(&tree));
    let options = Options::default();
    let bounds = Bounds { evaluations, ..Bounds::default() };
    let mut largest = 0.0_f64;
    for _ in 0..10_000 {
        tree.bounded_step((1e-3, &options, bounds), &mut state, &mut workspace)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        tree.step(TreeMethod::Trapezoidal, 1e-3, &options, &mut exact, &mut other)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        for (x, y) in state.z.iter().zip(&exact.z) {
            largest = largest.max((x - y).abs());
        }
    }
    largest
}

#[test]
fn one_evaluation_a_step_stays_below_the_error_of_the_step_itself_on_level_roads_and_a_second_one_on_stairs()
 {
    // The error of the trapezoidal rule is h² times a third derivative. The third derivative after a jump is about 100 m/s³, so the error
    // is about 1e-4.
    for name in ["iltis-slalom", "iltis-bump-5", "iltis-jump", "iltis-suspension"] {
        let apart = apart(name, 1);
        assert!(apart < 1e-4, "{name}: {apart}");
    }
    let (one, two) = (apart("iltis-stairs", 1), apart("iltis-stairs", 2));
    assert!(one < 1e-3 && two < 1e-6, "{one} {two}");
}

#[test]
fn rungs_drop_the_effects_of_the_ladder_in_its_order_and_time_that_runs_out_climbs_them() {
    let (tree, begin) = vehicle("iltis-slalom");
    let collected = Collected::new(&tree, &begin, &[3, 1]).expect("no signals");
    let model = collected.model();
    let n = model.mechanism.loads.len();
    assert_eq!(model.rungs, [n - 1, n - 2].map(|n| u32::try_from(n).expect("few effects")));
    let model = Checked::new(&model).expect("a model");
    let mut solver = Room::new(&model).expect("room");
    solver.bounds = Bounds { evaluations: 3, ..Bounds::default() };
    for rung in [0, 1, 1, 2, 2, 2] {
        let report = solver.step(&model, 1e-3, &mut || false).expect("a step");
        assert!(report.is_cut_short && report.evaluations == 1 && report.projections == 0);
        assert_eq!(solver.ladder.rung(), rung);
    }
}

#[test]
fn a_solver_refuses_integrators_with_auxiliary_accelerations() {
    let (tree, begin) = vehicle("six-joint-arm");
    let collected = Collected::new(&tree, &begin, &[]).expect("no signals");
    let model = Checked::new(&collected.model()).expect("a model");
    let mut solver = Room::new(&model).expect("room");
    solver.options.integrator = Integrator::hht(0.05);
    let refused = StepError::BadOption(OptionError::NotBuilt("integrator"));
    assert_eq!(solver.step(&model, 1e-3, &mut Unwatched), Err(refused));
    assert_eq!(solver.time().to_bits(), 0);
}

#[test]
fn a_rotation_needs_the_feature_of_bushings_and_is_refused_without_it() {
    let (tree, begin) = vehicle("six-joint-arm");
    let collected = Collected::new(&tree, &begin, &[]).expect("no signals");
    let law = Law::SpringDamper(SpringDamperLaw { stiffness: 1.0, damping: 0.0, free: 0.0 });
    let load = Load::Between { links: [1, 2], gauge: Measure::Rotation { number: 0 }, law };
    let mut model = collected.model();
    let loads = [load];
    model.mechanism.loads = &loads;
    assert_eq!(needs(&model), ["bushing"]);
    assert_eq!(Checked::new(&model).is_ok(), bushing::IS_BUILT);
}

#[test]
fn whatever_word_of_a_model_is_broken_nothing_panics() {
    let (tree, begin) = vehicle("iltis-slalom");
    let text = bytes(&Collected::new(&tree, &begin, &[]).expect("no signals").model(), false)
        .expect("a model");
    let (mut refused, mut stepped) = (0, 0);
    for at in (0..text.len() - 3).step_by(4) {
        for word in [u32::MAX, 1, 0x7f, 0x7ff8_0000] {
            let mut broken = text.clone();
            broken[at..at + 4].copy_from_slice(&word.to_le_bytes());
            let Ok(tables) = RoomTables::read(&broken) else {
                refused += 1;
                continue;
            };
            let model = tables.model();
            let Ok(mut solver) = Room::new(&model) else { continue };
            // A changed word may give a valid model with a wrong number. A step then returns an error, or the motion differs.
            for _ in 0..3 {
                let _ = solver.step(&model, 1e-3, &mut Unwatched);
            }
            stepped += 1;
        }
        let Err(_) = RoomTables::read(&text[..at]) else { panic!("cut off at {at}") };
    }
    assert!(refused > 500 && stepped > 500, "{refused} {stepped}");
}

//! Inputs that are set between steps: tests of the solver of fixed capacity, and of the bound of its operations.

use crate::support::start;
use mbs_core::scene::{Effect, EffectKind, JointId, JointTorque, Motion, Scene, Signal, TableEnds};
use mbs_nostd::export::{Collected, bytes};
use mbs_nostd::{Bounds, Checked, InputError, Options, Planar, Solver, Tables, Unwatched};
use mbs_recursive::Workspace;
use mbs_recursive::own::OwnFreedoms;
use mbs_testkit::file;

type Room = Solver<f64, Planar, 8, 16, 16, 16, 256, 256, 2, 4>;
type RoomTables = Tables<f64, Planar, 8, 12, 16, 64, 24, 64, 8, 40>;

fn with_torques(name: &str) -> Scene<f64> {
    let mut scene = file(name);
    for (name, course) in
        [("set", Signal::Input([0.0; 3])), ("constant", Signal::Constant([0.1, 0.0, 0.0]))]
    {
        let kind = EffectKind::JointTorque(JointTorque {
            joint: JointId::new(0),
            coordinate: None,
            course,
        });
        scene.effects.push(Effect { name: name.into(), enabled: true, kind });
    }
    scene
}

#[test]
fn a_course_written_for_one_step_acts_in_that_whole_step() {
    let mut scene = with_torques("simple-pendulum");
    scene.gravity = None;
    scene.initials.clear();
    scene.effects.pop();
    let (tree, begin) = start::<Planar, 2>(&scene);
    let collected = Collected::new(&tree, &begin, &[]).expect("no signals");
    let text = bytes(&collected.model(), false).expect("a scene without own laws");
    let tables = RoomTables::read(&text).expect("a model");
    let flash = Checked::new(&collected.model()).expect("a model");
    let mut mass = [0.0];
    let mut freedoms = OwnFreedoms::of_tree(&tree);
    freedoms.write_mass_matrix(&tree, &begin, &mut Workspace::new(&tree), &mut mass);
    let h = 1e-3;
    for model in [flash, tables.model()] {
        let mut solver = Room::new(&model).expect("room");
        for _ in 0..2 {
            for k in 0..6 {
                // a torque of one N m for each kg m^2 of inertia, in the third step only
                let torque = if k == 2 { mass[0] } else { 0.0 };
                solver.set_input(0, [torque, 0.0, 0.0]).expect("an input");
                solver.step(&model, h, &mut Unwatched).expect("a regular step");
                let (found, right) = (solver.velocities()[0] / h, if k < 2 { 0.0 } else { 1.0 });
                assert!((found - right).abs() < 1e-12, "step {k}: {found} of the step");
            }
            solver.restart(&model);
        }
    }
}

#[test]
fn a_solver_of_fixed_capacity_takes_inputs_as_the_recursion_does() {
    let mut scene = with_torques("guided-four-bar");
    scene.guides[0].law = Motion::Input([0.0, 0.0, 2.0]);
    scene.initials.clear();
    let (tree, begin) = start::<Planar, 2>(&scene);
    let effect = scene.effects.len() - 2;
    let collected = Collected::new(&tree, &begin, &[]).expect("no signals");
    let course = collected
        .model()
        .prescriptions
        .courses
        .iter()
        .position(|c| matches!(c, mbs_nostd::SignalLaw::Input(_)))
        .expect("an input");
    let flash = Checked::new(&collected.model()).expect("a model");
    let mut solver = Room::new(&flash).expect("room");
    let (host, mut state) = start::<Planar, 2>(&scene);
    let mut workspace = Workspace::new(&host);
    for k in 1..=200 {
        let t = f64::from(k) * 1e-3;
        let (motion, torque) = ([t * t, 2.0 * t, 2.0], [f64::from(k / 10 % 3), 0.0, 0.0]);
        host.prescribed().set_guide(&mut state.inputs, 0, motion).expect("an input");
        host.prescribed().set_input(&mut state.inputs, effect, torque).expect("an input");
        solver.set_guide(0, motion).expect("an input");
        solver.set_input(course, torque).expect("an input");
        let work = (1e-3, &Options::default(), Bounds::default());
        host.bounded_step(work, &mut state, &mut workspace).expect("a regular step");
        solver.step(&flash, 1e-3, &mut Unwatched).expect("a regular step");
        // After a change of inputs the host evaluates accelerations to rounding; the solver uses a bounded number of sweeps.
        for (x, y) in solver.velocities().iter().zip(&state.v) {
            assert!((x - y).abs() < 1e-9 * (1.0 + y.abs()), "step {k}: {x} {y}");
        }
    }
}

#[test]
fn a_table_with_level_ends_steps_from_bytes_as_it_does_on_the_host() {
    let (rows, ends) = (vec![[0.0, 0.0], [0.05, 0.2], [0.1, 0.3]], TableEnds::Level);
    steps_from_bytes(Motion::Table { rows, ends });
}

#[test]
fn a_table_between_its_rows_steps_from_bytes_as_it_does_on_the_host() {
    let rows = vec![[0.0, 0.0], [0.02, 0.0], [0.05, 0.2], [0.08, 0.2], [0.1, 0.3]];
    steps_from_bytes(Motion::Monotone { rows, ends: TableEnds::Level });
}

fn steps_from_bytes(law: Motion<f64>) {
    let mut scene = file("guided-four-bar");
    scene.guides[0].law = law;
    scene.initials.clear();
    let (host, mut state) = start::<Planar, 2>(&scene);
    let collected = Collected::new(&host, &state, &[]).expect("no signals");
    let text = bytes(&collected.model(), false).expect("a scene without own laws");
    let tables = RoomTables::read(&text).expect("a model");
    let model = tables.model();
    let mut solver = Room::new(&model).expect("room");
    let mut workspace = Workspace::new(&host);
    for k in 1..=150 {
        let work = (1e-3, &Options::default(), Bounds::default());
        host.bounded_step(work, &mut state, &mut workspace).expect("a regular step");
        solver.step(&model, 1e-3, &mut Unwatched).expect("a regular step");
        for (x, y) in solver.velocities().iter().zip(&state.v) {
            assert!((x - y).abs() < 1e-9 * (1.0 + y.abs()), "step {k}: {x} {y}");
        }
    }
    // after the end of the table the crank and the linkage are at rest
    assert!(state.v.iter().all(|v| v.abs() < 1e-9), "{:?}", state.v);
    host.prescribed().guide_input(0).expect_err("a table is no input");
}

#[test]
fn what_is_no_input_or_not_finite_is_refused_and_changes_nothing() {
    let scene = with_torques("double-pendulum");
    let (tree, begin) = start::<Planar, 2>(&scene);
    let collected = Collected::new(&tree, &begin, &[]).expect("no signals");
    let model = Checked::new(&collected.model()).expect("a model");
    let mut solver = Room::new(&model).expect("room");
    let mut other = solver.clone();
    assert_eq!(solver.set_input(1, [1.0; 3]), Err(InputError::NotAnInput { number: 1 }));
    assert_eq!(solver.set_input(2, [1.0; 3]), Err(InputError::NotAnInput { number: 2 }));
    assert_eq!(solver.set_guide(0, [1.0; 3]), Err(InputError::NotAnInput { number: 0 }));
    let refused = solver.set_input(0, [0.0, f64::NAN, 0.0]);
    assert_eq!(refused, Err(InputError::NotFinite { number: 0, component: 1 }));
    for _ in 0..10 {
        solver.step(&model, 1e-3, &mut Unwatched).expect("a regular step");
        other.step(&model, 1e-3, &mut Unwatched).expect("a regular step");
    }
    assert_eq!(solver.coordinates(), other.coordinates());
}

//! States that a program sets. They are compared with the recursion on the host and with closed forms; invalid states are refused.

use crate::support::start;
use mbs_core::Real;
use mbs_core::step::StepError;
use mbs_nostd::export::{Collected, bytes};
use mbs_nostd::table::LinkKind;
use mbs_nostd::{Bounds, Checked, Planar, Solver, Spatial, StateError, Tables, Unwatched};
use mbs_recursive::space::Space;
use mbs_recursive::{Options, TreeModel, TreeState, Workspace};
use mbs_testkit::{allocations, file};

/// Solver with memory for the vehicle and for an arm with drives.
type Room<S> = Solver<f64, S, 12, 40, 32, 16, 256, 256, 2, 40, 40, 40>;
type RoomTables = Tables<f32, Planar, 8, 12, 16, 64, 24, 64, 8, 40, 4>;

/// A four-bar linkage with a ground of 1 m, a crank of 0.3 m, a coupler and a rocker. Its points have one decimal.
const CRANK: &str = include_str!("crank-rocker.toml");

/// Returns the state after `n` steps of 1 ms. Small numbers of both signs are added to it. Quaternions remain of unit length.
fn aside<S: Space<f64>>(
    tree: &TreeModel<f64, S>,
    begin: &TreeState<f64>,
    (n, by): (usize, f64),
) -> TreeState<f64> {
    let (mut state, mut workspace) = (begin.clone(), Workspace::new(tree));
    for _ in 0..n {
        let work = (1e-3, &Options::default(), Bounds::default());
        tree.bounded_step(work, &mut state, &mut workspace).expect("a step");
    }
    for (i, x) in state.z.iter_mut().chain(&mut state.v).enumerate() {
        *x += by * [1.0, -0.5, 0.25][i % 3];
    }
    let collected = Collected::new(tree, begin, &[]).expect("signals of a controller");
    for link in collected.model().mechanism.links.iter().skip(1) {
        if S::DIMENSION == 3 && matches!(link.kind, LinkKind::Ball | LinkKind::Free) && by > 0.0 {
            let q = &mut state.z[link.z as usize..][..4];
            let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
            q.iter_mut().for_each(|x| *x /= length);
        }
    }
    state
}

/// Returns all outputs of a solver as bits.
fn shown<S: Space<f64>>(solver: &Room<S>) -> Vec<u64> {
    let lists = [solver.coordinates(), solver.velocities(), solver.accelerations()];
    let numbers = lists.into_iter().flatten().chain(solver.multipliers());
    numbers.chain([&solver.time()]).map(|x| x.to_bits()).collect()
}

/// Sets states of a scene in the solver and in the recursion, and checks that the following steps have the same bits.
fn same_as_in_the_recursion<S: mbs_nostd::format::Axes<f64>, const D: usize>(
    name: &str,
    (n, by): (usize, f64),
) {
    let scene = if name == "crank" { mbs_testkit::scene(CRANK) } else { file(name) };
    let (tree, begin) = start::<S, D>(&scene);
    let collected = Collected::new(&tree, &begin, &[]).expect("signals of a controller");
    let model = Checked::new(&collected.model()).expect("a model");
    let mut solver = Room::<S>::new(&model).expect("room");
    for _ in 0..n {
        solver.step(&model, 1e-3, &mut Unwatched).expect("a step");
    }
    let (mut state, mut workspace) = (aside(&tree, &begin, (n, by)), Workspace::new(&tree));
    let given = state.clone();
    tree.settle(&mut state, &mut workspace).unwrap_or_else(|e| panic!("{name}: {e}"));
    let report = solver.set_state(&model, &given.z, &given.v);
    let report = report.unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(solver.coordinates(), &state.z[..], "{name}");
    assert_eq!(solver.velocities(), &state.v[..], "{name}");
    assert_eq!(solver.accelerations(), &state.a[..], "{name}");
    assert_eq!(solver.multipliers(), &state.lambda[..], "{name}");
    assert!(report.moved <= 4.0 * by, "{name}: {report:?}");
    let is_open = solver.multipliers().is_empty();
    assert_eq!(
        (report.evaluations, report.responses > 0),
        if is_open { (1, false) } else { (2, true) }
    );
    for _ in 0..100 {
        let work = (1e-3, &Options::default(), Bounds::default());
        tree.bounded_step(work, &mut state, &mut workspace).expect("a step");
        solver.step(&model, 1e-3, &mut Unwatched).expect("a step");
        assert_eq!(solver.coordinates(), &state.z[..], "{name}");
        assert_eq!(solver.velocities(), &state.v[..], "{name}");
    }
}

#[test]
fn a_state_that_is_set_is_that_of_the_recursion_to_the_bit_and_so_are_the_steps_from_there() {
    for name in ["double-pendulum", "guided-four-bar", "four-bar", "crank"] {
        same_as_in_the_recursion::<Planar, 2>(name, (50, 0.02));
    }
    for name in ["six-joint-arm", "servo-arm", "spatial-four-bar", "iltis-slalom"] {
        same_as_in_the_recursion::<Spatial, 3>(name, (50, 1e-3));
    }
    // the quaternion comes from a step, so setting it does not change its bits
    same_as_in_the_recursion::<Spatial, 3>("free-body", (50, 0.0));
}

#[test]
fn a_solver_set_to_the_state_of_another_run_follows_it_but_for_the_accelerations_that_it_starts_from()
 {
    let (tree, begin) = start::<Planar, 2>(&file("double-pendulum"));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signals");
    let model = Checked::new(&collected.model()).expect("a model");
    let mut run = Room::<Planar>::new(&model).expect("room");
    let mut other = run.clone();
    let mut apart = [0.0_f64; 2];
    for (steps, apart) in [1e-3, 5e-4].into_iter().zip(&mut apart) {
        run.restart(&model);
        for _ in 0..300 {
            run.step(&model, steps, &mut Unwatched).expect("a step");
        }
        other.set_state(&model, run.coordinates(), run.velocities()).expect("an open chain");
        assert_eq!(other.coordinates(), run.coordinates());
        assert_eq!(other.velocities(), run.velocities());
        for solver in [&mut run, &mut other] {
            solver.step(&model, steps, &mut Unwatched).expect("a step");
        }
        for (x, y) in run.coordinates().iter().zip(other.coordinates()) {
            *apart = apart.max((x - y).abs());
        }
    }
    // A run starts its step from the accelerations at the last predicted position. The error of this position is β h² times the change of
    // the accelerations in a step, which is h³/4 times a third derivative. Newly evaluated accelerations differ by this error times ∂z̈/∂z.
    // The difference changes the end of the step by h²/4 times the difference. The total change is of order h⁵.
    assert!(apart[0] < 1e-10 && apart[1] < apart[0] / 16.0, "{apart:?}");
}

#[test]
fn after_a_new_input_steps_begin_with_accelerations_anew_and_a_state_that_is_set_changes_no_bit() {
    let (tree, begin) = start::<Spatial, 3>(&mbs_testkit::scene(include_str!("two-link-arm.toml")));
    let collected = Collected::new(&tree, &begin, &[]).expect("an input");
    let model = Checked::new(&collected.model()).expect("a model");
    let mut run = Room::<Spatial>::new(&model).expect("room");
    for _ in 0..20 {
        run.step(&model, 1e-3, &mut Unwatched).expect("a step");
    }
    run.set_input(0, [0.7, 0.0, 0.0]).expect("an input");
    let mut other = run.clone();
    other.set_state(&model, run.coordinates(), run.velocities()).expect("an open chain");
    for _ in 0..100 {
        run.step(&model, 1e-3, &mut Unwatched).expect("a step");
        other.step(&model, 1e-3, &mut Unwatched).expect("a step");
        assert_eq!(shown(&run), shown(&other));
    }
}

/// Returns the gap in the loop of the crank-rocker, with its first and second rate. The gap is the distance between the end of the coupler
/// and the end of the rocker. It is computed from the coordinates of the links only.
///
/// A link is rotated by the sum φ of all joint angles between the ground and the link. A vector r in the link's axes is R(φ) r in global
/// axes. Its rate is φ' R(φ) i r, and its second rate is φ'' R(φ) i r - φ'² R(φ) r, where i is a rotation by a right angle.
fn gap<T: Real>(model: &Checked<'_, T, Planar>, motion: [&[T]; 3]) -> [f64; 3] {
    let mechanism = &model.model().mechanism;
    let point = |link: usize, own: [f64; 2]| -> [[f64; 2]; 3] {
        let (mut at, mut number, mut arm) = ([[0.0; 2]; 3], link, own);
        loop {
            // rotation of this link: the sum of the angles of all links on the path to the ground
            let (mut turn, mut k) = ([0.0; 3], number);
            while k > 0 {
                let v = mechanism.links[k].v as usize;
                for (turn, list) in turn.iter_mut().zip(motion) {
                    *turn += list[v].to_f64();
                }
                k = mechanism.links[k].parent as usize;
            }
            let (s, c) = f64::sin_cos(turn[0]);
            let r = [c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]];
            let across = [-r[1], r[0]];
            for i in 0..2 {
                at[0][i] += r[i];
                at[1][i] += turn[1] * across[i];
                at[2][i] += turn[2] * across[i] - turn[1] * turn[1] * r[i];
            }
            if number == 0 {
                return at;
            }
            let offset = &mechanism.links[number].offset;
            arm = [offset[0].to_f64(), offset[1].to_f64()];
            number = mechanism.links[number].parent as usize;
        }
    };
    let lap = &mechanism.loops.loops[0];
    let ends = [0, 1].map(|side| {
        let own = &lap.points[side];
        point(lap.links[side] as usize, [own[0].to_f64(), own[1].to_f64()])
    });
    [0, 1, 2].map(|level| {
        let [x, y] = [0, 1].map(|i| ends[0][level][i] - ends[1][level][i]);
        x.hypot(y)
    })
}

#[test]
fn a_loop_is_closed_with_its_velocities_and_accelerations_in_both_precisions() {
    let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(CRANK));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signals");
    let given = aside(&tree, &begin, (0, 0.05));
    let double = Checked::new(&collected.model()).expect("a model");
    let before = gap(&double, [&given.z, &given.v, &given.a]);
    assert!(before[0] > 0.01 && before[1] > 0.05, "the state is off: {before:?}");
    let mut solver = Room::<Planar>::new(&double).expect("room");
    let report = solver.set_state(&double, &given.z, &given.v).expect("it is near");
    let motion = [solver.coordinates(), solver.velocities(), solver.accelerations()];
    let after = gap(&double, motion);
    // the limits are rounding errors: rates are about 6 rad/s, and accelerations about 100 rad/s^2
    assert!(after[0] < 1e-14 && after[1] < 1e-13 && after[2] < 1e-11, "{after:?} {report:?}");
    assert!(report.violation[0] < 1e-14 && report.responses < 40, "{report:?}");
    let text = bytes(&collected.model(), true).expect("a scene without own laws");
    let tables = RoomTables::read(&text).expect("a model");
    let single = tables.model();
    let mut solver =
        Solver::<f32, Planar, 8, 16, 16, 16, 64, 64, 2, 4>::new(&single).expect("room");
    let [z, v] =
        [&given.z, &given.v].map(|list| list.iter().map(|&x| x as f32).collect::<Vec<_>>());
    let report = solver.set_state(&single, &z, &v).expect("it is near");
    let motion = [solver.coordinates(), solver.velocities(), solver.accelerations()];
    let after = gap(&single, motion);
    assert!(after[0] < 2e-6 && after[1] < 2e-5 && after[2] < 2e-3, "{after:?} {report:?}");
}

#[test]
fn a_loop_is_closed_by_the_move_that_is_smallest_in_the_norm_of_the_masses() {
    let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(CRANK));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signals");
    let model = Checked::new(&collected.model()).expect("a model");
    let mut solver = Room::<Planar>::new(&model).expect("room");
    let given = aside(&tree, &begin, (0, 1e-4));
    solver.set_state(&model, &given.z, &given.v).expect("it is near");
    let n = given.z.len();
    let mut mass = vec![0.0; n * n];
    let mut freedoms = mbs_recursive::own::OwnFreedoms::of_tree(&tree);
    freedoms.write_mass_matrix(&tree, &begin, &mut Workspace::new(&tree), &mut mass);
    // The linkage has one freedom and can move along its velocities u only. The smallest correction d has no part along u: u' M d = 0.
    let moved: Vec<f64> = solver.coordinates().iter().zip(&given.z).map(|(x, y)| x - y).collect();
    let along = |a: &[f64], b: &[f64]| -> f64 {
        (0..n).map(|i| a[i] * (0..n).map(|j| mass[i * n + j] * b[j]).sum::<f64>()).sum()
    };
    let (part, speed) = (along(&begin.v, &moved), along(&begin.v, &begin.v).sqrt());
    let size = along(&moved, &moved).sqrt();
    // The correction is 1e-4 of the linkage's size, so the direction of the velocities also changes by about 1e-4.
    assert!(size > 1e-6 && part.abs() < 1e-3 * size * speed, "{part} of {size}");
}

/// Checks that a refused state changes nothing: outputs, later closings of loops and later steps are those of a solver without the call.
fn is_untouched(model: &Checked<'_, f64, Planar>, asked: &Room<Planar>, other: &Room<Planar>) {
    let (mut after, mut other) = (asked.clone(), other.clone());
    assert_eq!(shown(&after), shown(&other));
    // The memory that later closings of loops use is also unchanged.
    let mut closed = [&after, &other].map(Clone::clone);
    let reports = closed.each_mut().map(|solver| {
        let (mut z, v) = (solver.coordinates().to_vec(), solver.velocities().to_vec());
        z[0] += 1e-3;
        solver.set_state(model, &z, &v).expect("it is near")
    });
    assert_eq!(reports[0], reports[1]);
    assert_eq!(shown(&closed[0]), shown(&closed[1]));
    for _ in 0..20 {
        let reports = [&mut after, &mut other].map(|s| s.step(model, 1e-3, &mut Unwatched));
        assert_eq!(reports[0], reports[1]);
        assert_eq!(shown(&after), shown(&other));
    }
}

#[test]
fn what_is_no_state_is_refused_and_the_state_before_stays_to_the_bit() {
    let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(CRANK));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signals");
    let model = Checked::new(&collected.model()).expect("a model");
    let mut solver = Room::<Planar>::new(&model).expect("room");
    for _ in 0..20 {
        solver.step(&model, 1e-3, &mut Unwatched).expect("a step");
    }
    let before = solver.clone();
    let n = before.coordinates().len();
    let (z, v) = (before.coordinates().to_vec(), before.velocities().to_vec());
    let with = |list: &[f64], entry: usize, x: f64| {
        let mut list = list.to_vec();
        list[entry] = x;
        list
    };
    let length = |of, given| Err(StateError::Length { of, given, needed: n });
    let not_finite = |of, entry| Err(StateError::NotFinite { of, entry });
    for (z, v, refused) in [
        (z[1..].to_vec(), v.clone(), length("coordinates", n - 1)),
        (z.clone(), [&v[..], &[0.0]].concat(), length("velocities", n + 1)),
        (z.clone(), Vec::new(), length("velocities", 0)),
        (with(&z, 1, f64::NAN), v.clone(), not_finite("coordinates", 1)),
        (z.clone(), with(&v, 2, f64::NEG_INFINITY), not_finite("velocities", 2)),
    ] {
        assert_eq!(solver.set_state(&model, &z, &v), refused);
        is_untouched(&model, &solver, &before);
    }
    // The square of this rate is infinite, so the accelerations do not exist.
    let error = solver.set_state(&model, &z, &with(&v, 0, 1e200)).expect_err("too fast");
    assert!(matches!(error, StateError::Failed(_) | StateError::Open { .. }), "{error}");
    is_untouched(&model, &solver, &before);
    // The loops close if the second link is displaced by up to 1.5 rad. For 2 rad the projection does not converge.
    for turn in [0.5, 1.0, 1.5] {
        let mut asked = before.clone();
        asked.set_state(&model, &with(&z, 1, z[1] + turn), &v).expect("it is near enough");
        // If the loops are far from closed, the projection converges slowly and ends below the square root of machine precision. The next
        // step projects the remainder.
        let motion = [asked.coordinates(), asked.velocities(), asked.accelerations()];
        assert!(gap(&model, motion)[0] < 2e-9, "{turn}");
        asked.step(&model, 1e-3, &mut Unwatched).expect("a step");
        let motion = [asked.coordinates(), asked.velocities(), asked.accelerations()];
        assert!(gap(&model, motion)[0] < 1e-12, "{turn} after a step");
    }
    let error = solver.set_state(&model, &with(&z, 1, z[1] + 2.0), &v).expect_err("too far");
    assert!(matches!(error, StateError::Open { .. }), "{error}");
    is_untouched(&model, &solver, &before);
}

#[test]
fn another_model_and_a_quaternion_without_direction_are_refused_and_a_long_one_is_made_unit() {
    let (tree, begin) = start::<Spatial, 3>(&file("free-body"));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signals");
    let model = Checked::new(&collected.model()).expect("a model");
    let (arm, at_arm) = start::<Spatial, 3>(&file("six-joint-arm"));
    let arm = Collected::new(&arm, &at_arm, &[]).expect("no signals");
    let arm = Checked::new(&arm.model()).expect("a model");
    let mut solver = Room::<Spatial>::new(&model).expect("room");
    let refused = Err(StateError::Failed(StepError::Tables));
    assert_eq!(solver.set_state(&arm, &at_arm.z, &at_arm.v), refused);
    let mut z = begin.z.clone();
    for x in [0.0, 1e200] {
        z[..4].fill(x);
        let refused = Err(StateError::Quaternion { entry: 0 });
        assert_eq!(solver.set_state(&model, &z, &begin.v), refused);
        assert_eq!(solver.coordinates(), &begin.z[..]);
    }
    z[..4].copy_from_slice(&[2.0, 0.0, 0.0, 2.0]);
    let report = solver.set_state(&model, &z, &begin.v).expect("a direction");
    let half = 0.5_f64.sqrt();
    for (x, right) in solver.coordinates().iter().zip([half, 0.0, 0.0, half]) {
        assert!((x - right).abs() < 1e-15);
    }
    assert!((report.moved - (2.0 - half)).abs() < 1e-15, "{report:?}");
}

#[test]
fn setting_a_state_allocates_nothing() {
    let (tree, begin) = start::<Planar, 2>(&mbs_testkit::scene(CRANK));
    let collected = Collected::new(&tree, &begin, &[]).expect("no signals");
    let model = Checked::new(&collected.model()).expect("a model");
    let mut solver = Room::<Planar>::new(&model).expect("room");
    let given = aside(&tree, &begin, (0, 0.01));
    let mut far = begin.z.clone();
    far[1] += 2.0;
    let before = allocations::count();
    solver.set_state(&model, &given.z, &given.v).expect("it is near");
    let refused = solver.set_state(&model, &far, &begin.v).is_err();
    assert_eq!(allocations::count() - before, 0);
    assert!(refused, "it is too far");
}

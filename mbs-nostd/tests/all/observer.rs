//! A Luenberger observer of the two-link arm. The firmware runs this observer on an emulated board. The tests run it on the host, in both
//! precisions.

use crate::support::start;
use mbs_core::Real;
use mbs_nostd::export::{Collected, bytes};
use mbs_nostd::format::{Axes, Record};
use mbs_nostd::{Checked, Solver, Spatial, Tables, Unwatched};

type Arm<T> = Solver<T, Spatial, 4, 2, 2, 0, 0, 0, 0, 2, 0, 2>;
type ArmTables<T> = Tables<T, Spatial, 4, 1, 1, 4, 4, 4, 4, 4, 2>;

/// Step of the arm and of the observer [s].
const STEP: f64 = 1e-3;
/// Decay rate of the observer's error: double root of its characteristic equation [1/s].
const ROOT: f64 = 20.0;

/// Returns the accelerations of the arm at the coordinates `z` and velocities `v`. They are evaluated by setting this state.
fn accelerations(model: &Checked<'_, f64, Spatial>, z: [f64; 2], v: [f64; 2]) -> [f64; 2] {
    let mut solver = Arm::<f64>::new(model).expect("room");
    solver.set_state(model, &z, &v).expect("an open chain");
    [solver.accelerations()[0], solver.accelerations()[1]]
}

/// Returns A and B of the linearised arm v' = A z + B v at its equilibrium, hanging at rest. They are central differences of the
/// accelerations.
fn linearised(model: &Checked<'_, f64, Spatial>) -> [[[f64; 2]; 2]; 2] {
    let by = 1e-4;
    let mut matrices = [[[0.0; 2]; 2]; 2];
    for (which, matrix) in matrices.iter_mut().enumerate() {
        for j in 0..2 {
            let sides = [by, -by].map(|by| {
                let mut state = [[0.0; 2]; 2];
                state[which][j] = by;
                accelerations(model, state[0], state[1])
            });
            for i in 0..2 {
                matrix[i][j] = (sides[0][i] - sides[1][i]) / (2.0 * by);
            }
        }
    }
    matrices
}

/// Runs the arm and its observer together. Returns the largest error of an angle after 0.4 s, and the largest error of the complete run
/// [rad].
fn observed<T: Real + Record>(
    model: &Checked<'_, T, Spatial>,
    gains: [[[f64; 2]; 2]; 2],
) -> [f64; 2]
where
    Spatial: Axes<T>,
{
    let real = T::from_f64;
    let mut arm = Arm::<T>::new(model).expect("room");
    let mut observer = arm.clone();
    let mut z = [arm.coordinates()[0] - real(0.04), arm.coordinates()[1] - real(0.02)];
    let mut v = [arm.velocities()[0], arm.velocities()[1]];
    let mut largest = [0.0_f64; 2];
    for step in 1..=1000 {
        observer.set_state(model, &z, &v).expect("an open chain");
        for solver in [&mut arm, &mut observer] {
            solver.set_input(0, [real(0.5), T::ZERO, T::ZERO]).expect("an input");
            solver.step(model, real(STEP), &mut Unwatched).expect("a step");
        }
        z.copy_from_slice(observer.coordinates());
        v.copy_from_slice(observer.velocities());
        let errors = [0, 1].map(|i| arm.coordinates()[i] - z[i]);
        for i in 0..2 {
            z[i] += real(gains[0][i][0]) * errors[0] + real(gains[0][i][1]) * errors[1];
            v[i] += real(gains[1][i][0]) * errors[0] + real(gains[1][i][1]) * errors[1];
            let error = errors[i].abs().to_f64();
            largest[1] = largest[1].max(error);
            if step >= 400 {
                largest[0] = largest[0].max(error);
            }
        }
    }
    largest
}

#[test]
fn an_observer_on_the_exported_arm_reaches_a_milliradian_within_four_tenths_of_a_second() {
    let (tree, begin) = start::<Spatial, 3>(&mbs_testkit::scene(include_str!("two-link-arm.toml")));
    let collected = Collected::new(&tree, &begin, &[]).expect("an input");
    let model = Checked::new(&collected.model()).expect("a model");
    let [a, b] = linearised(&model);
    // the firmware computes this closed form: A = -K/M and B = -D/M
    let (m22, k22) = (0.03, 9.81 * 0.15);
    let (m12, k11) = (m22 + 0.06, 9.81 * 0.8 + k22);
    let m11 = 0.32 / 3.0 + 0.16 + 0.12 + m22;
    for (m, right) in [(a, [[k11, k22], [k22, k22]]), (b, [[0.4, 0.0], [0.0, 0.1]])] {
        for j in 0..2 {
            let forces = [m11 * m[0][j] + m12 * m[1][j], m12 * m[0][j] + m22 * m[1][j]];
            for i in 0..2 {
                assert!((forces[i] + right[i][j]).abs() < 1e-5, "{forces:?} {right:?}");
            }
        }
    }
    // h L1 and h L2 of e'' + 2 r e' + r² e = 0: L1 = 2 r + B, L2 = r² + A + B L1
    let one = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
    let first = |i: usize, j: usize| 2.0 * ROOT * one(i, j) + b[i][j];
    let second = |i: usize, j: usize| {
        let damped = b[i][0] * first(0, j) + b[i][1] * first(1, j);
        ROOT * ROOT * one(i, j) + a[i][j] + damped
    };
    let by_step =
        |gain: &dyn Fn(usize, usize) -> f64| [0, 1].map(|i| [0, 1].map(|j| STEP * gain(i, j)));
    let gains = [by_step(&first), by_step(&second)];
    let text = bytes(&collected.model(), true).expect("a scene without own laws");
    let tables = ArmTables::<f32>::read(&text).expect("a model");
    for largest in [observed(&model, gains), observed(&tables.model(), gains)] {
        assert!(largest[0] < 1e-3 && largest[1] < 0.045, "{largest:?}");
    }
    // without gains the error decays by the arm's damping only, which is slower
    let free = observed(&model, [[[0.0; 2]; 2]; 2]);
    assert!(free[0] > 1e-3, "{free:?}");
}

//! Invariance of a motion under the choice of independent columns, axes and precision, and conditions that hold at every step.

use crate::common::Bench;
use mbs_core::model::Model;
use mbs_core::{Cliques, Real};
use mbs_statespace::{Coordinates, PivotChange, StepError, Workspace};
use mbs_testkit::retell::{turn_scene, turned};
use mbs_testkit::scenes::{CHAIN, DOUBLE, GUIDED, REDUNDANT, SLIDER, TOP, TWO_FOUR_BARS};
use mbs_testkit::{PLANAR, SPATIAL, apart, scene, scene_in};

/// Allowed growth of rounding errors over some hundred steps of a regular motion [m].
const ROUNDING: f64 = 1e-9;

/// Returns two numbers: the largest entry of J R over all rows including the dropped ones, and the largest entry of R.
fn null_space_error<const D: usize>(bench: &Bench<f64, D>) -> (f64, f64) {
    let (model, e) = (&bench.model, bench.w.elimination());
    let f = e.independent().len();
    let mut basis = vec![0.0; e.rank() * f];
    e.write_basis(&mut basis);
    let (mut worst, mut largest) = (0.0_f64, 1.0_f64);
    let (mut x, mut rates) = (vec![0.0; model.n_extended()], vec![0.0; model.n_constraints()]);
    for i in 0..f {
        x.fill(0.0);
        for (k, &u) in e.dependent().iter().enumerate() {
            x[u as usize] = basis[k * f + i];
            largest = largest.max(basis[k * f + i].abs());
        }
        x[e.independent()[i] as usize] = 1.0;
        model.multiply_jacobian(bench.w.terms(), &x, &mut rates);
        worst = rates.iter().fold(worst, |w, r| w.max(r.abs()));
    }
    (worst, largest)
}

fn check_null_space<const D: usize>(text: &str) {
    let mut bench = Bench::<f64, D>::new(text);
    for _ in 0..10 {
        bench.run(1e-3, 20);
        let (error, size) = null_space_error(&bench);
        assert!(error <= 1e-13 * size, "{}: {error:e} of {size:e}", bench.scene.name);
    }
}

#[test]
fn the_basis_spans_the_null_space_of_all_rows() {
    check_null_space::<2>(&DOUBLE);
    check_null_space::<2>(&SLIDER);
    check_null_space::<2>(PLANAR);
    check_null_space::<3>(&CHAIN);
    check_null_space::<3>(&REDUNDANT);
    check_null_space::<3>(SPATIAL);
}

fn check_rechoice<const D: usize>(text: &str, dt: f64, steps: u32) {
    let mut plain = Bench::<f64, D>::new(text);
    let mut forced = Bench::<f64, D>::new(text);
    // The tolerance is machine precision. With a larger tolerance, each step would leave an error that depends on the choice.
    (plain.options.tolerance, forced.options.tolerance) = (1e-14, 1e-14);
    forced.options.pivot_change = PivotChange::EveryStep;
    let (mut sets, mut last) = (0, Vec::new());
    for _ in 0..steps {
        plain.run(dt, 1);
        forced.run(dt, 1);
        if last != forced.w.elimination().independent() {
            last = forced.w.elimination().independent().to_vec();
            sets += 1;
        }
    }
    let name = &plain.scene.name;
    assert!(sets > 1, "{name}: other columns were chosen on the way");
    assert!(forced.w.n_choices() == steps && plain.w.n_choices() < steps / 4, "{name}");
    let difference = apart(&plain.state.q, &forced.state.q);
    assert!(difference < ROUNDING, "{name}: {difference:e} m");
}

#[test]
fn choosing_anew_at_every_step_does_not_change_the_motion() {
    check_rechoice::<2>(&DOUBLE, 1e-3, 500);
    check_rechoice::<2>(&SLIDER, 1e-3, 500);
    check_rechoice::<3>(&REDUNDANT, 1e-3, 500);
    check_rechoice::<3>(&TOP, 1e-3, 200);
}

#[test]
fn chosen_columns_as_coordinates_change_the_motion_by_the_error_of_the_rule_only() {
    let position = |dt: f64, steps, pivot_change| {
        let mut bench = Bench::<f64, 2>::new(&SLIDER);
        bench.options.coordinates = Coordinates::Chosen;
        bench.options.pivot_change = pivot_change;
        bench.run(dt, steps);
        bench.state.q
    };
    let difference = |dt, steps| {
        let forced = position(dt, steps, PivotChange::EveryStep);
        apart(&position(dt, steps, PivotChange::WhenNeeded), &forced)
    };
    let (coarse, fine) = (difference(1e-3, 300), difference(2.5e-4, 1200));
    assert!(fine > ROUNDING && coarse > 8.0 * fine, "{coarse:e} {fine:e}: second order");
}

#[test]
fn a_turned_scene_moves_alike() {
    for text in [&*CHAIN, &REDUNDANT, &TOP] {
        let mut plain = Bench::<f64, 3>::new(text);
        let mut other = Bench::<f64, 3>::of(turn_scene(&scene(text)));
        plain.run(1e-3, 200);
        other.run(1e-3, 200);
        let (a, b) = (plain.centers(&plain.state), other.centers(&other.state));
        for ((name, a), (_, b)) in a.iter().zip(&b) {
            assert!(apart(&turned(*a), b) < ROUNDING, "{name}: {a:?} {b:?}");
        }
    }
}

#[test]
fn all_three_levels_hold_to_rounding_after_every_step() {
    let mut bench = Bench::<f64, 3>::new(SPATIAL);
    for _ in 0..300 {
        let report = bench.try_step(1e-3).unwrap();
        let size = |x: &[f64]| x.iter().fold(1.0_f64, |s, x| s.max(x.abs()));
        let [q, v, a] = report.violation;
        assert!(q < 1e-14 && v < 1e-14 * size(&bench.state.v) && a < 1e-14 * size(&bench.state.a));
    }
}

#[test]
fn a_stiff_spring_takes_few_iterations() {
    // A rod of 1 kg on a spring of 1e7 N/m at its end has a period of 1.3 ms, little more than a step of 1 ms.
    let text = "[scene]\nname = \"stiff\"\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n[[body]]\nname = \"x\"\nrod = { from = [0.0, 0.0], to = [1.0, 0.0] }\nmass = 1.0\n[[joint]]\nname = \"j\"\nkind = \"revolute\"\nbodies = [\"ground\", \"x\"]\nat = [0.0, 0.0]\n[[effect]]\nkind = \"spring-damper\"\nbodies = [\"ground\", \"x\"]\npoints = [[1.0, 1.0], [1.0, 0.0]]\nstiffness = 1e7\nfree_length = 1.0001\n";
    for dt in [1e-2, 1e-3] {
        let mut bench = Bench::<f64, 2>::new(text);
        let start = bench.invariant();
        for _ in 0..500 {
            let report = bench.try_step(dt).unwrap();
            assert!(report.iterations <= 4, "{} iterations at {dt}", report.iterations);
        }
        // The limit is a hundredth of the 0.05 J stored in the spring.
        let error = (bench.invariant() - start).abs();
        assert!(error < 5e-4, "{dt}: {error:e} J");
    }
}

#[test]
fn the_geometric_stiffness_saves_iterations_and_changes_nothing_else() {
    let run = |is_geometric| {
        let mut bench = Bench::<f64, 2>::new(&DOUBLE);
        bench.options.geometric_stiffness = is_geometric;
        let mut iterations = 0;
        for _ in 0..300 {
            iterations += bench.try_step(5e-3).unwrap().iterations;
        }
        (iterations, bench.state.q)
    };
    let ((with, q), (without, printed)) = (run(true), run(false));
    assert!(with < without, "{with} {without}");
    // The iterations of both forms end at 1e-10 of the displacement in a step, which is 1e-4 m.
    assert!(apart(&q, &printed) < 1e-9);
}

#[test]
fn a_fully_guided_mechanism_has_no_unknowns() {
    let mut bench = Bench::<f64, 2>::new(&GUIDED);
    assert!(bench.w.elimination().independent().is_empty());
    for _ in 0..1000 {
        assert_eq!(bench.try_step(1e-3).unwrap().iterations, 0);
    }
    // The work of the guide equals the gain of kinetic and potential energy.
    let start = Bench::<f64, 2>::new(&GUIDED).invariant();
    let error = (bench.invariant() - start).abs();
    assert!(error < 5e-6, "{error:e} J: the trapezoidal rule in time");
}

#[test]
fn a_start_at_the_singular_position_is_refused() {
    // The cranks of the two four-bars lie along the ground. The mechanism then has three instantaneous freedoms instead of one.
    let text = &TWO_FOUR_BARS;
    let mut bench = Bench::<f64, 2>::new(text);
    let (usual, n) = (bench.w.elimination().rank(), bench.model.n_unknowns());
    // The unknowns are the ends of the cranks, which are rotated by a quarter turn.
    for x in bench.state.q[..n].chunks_exact_mut(2) {
        (x[0], x[1]) = (x[0] + 1.0, 0.0);
    }
    for x in bench.state.v[..n].chunks_exact_mut(2) {
        (x[0], x[1]) = (0.0, -5.0);
    }
    bench.state.a.fill(0.0);
    bench.state.a_aux.fill(0.0);
    bench.w = Workspace::new(&bench.model, &bench.state);
    assert!(bench.w.elimination().rank() < usual);
    let outcome = (0..5).map(|_| bench.try_step(1e-3)).find(Result::is_err);
    assert!(matches!(outcome, Some(Err(StepError::RankLost { .. }))), "{outcome:?}");
}

#[test]
fn single_precision_stays_near_double_precision() {
    // Error that single precision may cause in half a second [m].
    const SINGLE: f64 = 1e-3;
    let mut double = Bench::<f64, 2>::new(&DOUBLE);
    double.run(2e-3, 250);
    let mut single = Bench::<f32, 2>::of(scene_in(&DOUBLE));
    single.run(2e-3, 250);
    let single: Vec<f64> = single.state.q.iter().map(|x| x.to_f64()).collect();
    assert!(apart(&double.state.q, &single) < SINGLE);
}

#[test]
fn what_is_at_rest_stays_at_rest() {
    let text = "[scene]\nname = \"hanging chain\"\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n[[body]]\nname = \"x\"\nrod = { from = [0.1, 0.0], to = [0.1, -0.7] }\nmass = 1.3\n[[body]]\nname = \"y\"\nrod = { from = [0.1, -0.7], to = [0.1, -1.3] }\nmass = 0.7\n[[joint]]\nname = \"j\"\nkind = \"revolute\"\nbodies = [\"ground\", \"x\"]\nat = [0.1, 0.0]\n[[joint]]\nname = \"k\"\nkind = \"revolute\"\nbodies = [\"x\", \"y\"]\nat = [0.1, -0.7]\n";
    for dt in [1e-2, 1e-3, 1e-4] {
        let mut bench = Bench::<f64, 2>::new(text);
        bench.run(dt, 100);
        assert!(bench.state.v.iter().all(|v| v.abs() < 1e-12), "{dt}: {:?}", bench.state.v);
    }
}

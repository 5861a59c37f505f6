//! Motions compared with closed forms: for example order of convergence, energy, reactions, drift of the constraints, and singular
//! positions.

use crate::common::{Index, Run};
use mbs_classical::{OptionError, Options, Stabilisation, StepError};
use mbs_core::integrator::Integrator;
use mbs_core::model::Owner;
use mbs_core::scene::BodyId;
use mbs_testkit::scene;
use mbs_testkit::scenes::{DOUBLE, SIMPLE, TWO_FOUR_BARS};

/// Steps [s] and energy errors [J] of the trapezoidal rule on the double pendulum over 10 s.
const DOUBLE_ENERGY: [(f64, f64); 3] = [(1e-2, 4.645e-1), (1e-3, 4.636e-3), (1e-4, 4.335e-5)];
/// Largest allowed ratio of a run's error to the error of the rule [-].
const ROOM: f64 = 1.02;
/// Exact position of the end of the first crank of the two four-bars after 10 s [m].
const CRANK: [f64; 2] = [0.328_458_111_540_815_4, 0.944_518_538_178_601];

/// Returns the largest deviation of the energy invariant over `seconds` [J].
fn energy_error<const D: usize>(mut run: Run<f64, D>, dt: f64, seconds: f64) -> f64 {
    let start = run.invariant();
    let mut worst: f64 = 0.0;
    for i in 0..(seconds / dt).round() as usize {
        run.step(dt).unwrap_or_else(|e| panic!("step {i}: {e}"));
        worst = worst.max((run.invariant() - start).abs());
    }
    worst
}

#[test]
fn both_forms_are_of_second_order_on_the_pendulum() {
    // The exact position of the mass after 1 s, by elliptic functions [m].
    let exact = [0.986_291_751_131_875_3_f64, -0.165_010_853_125_541_2];
    for index in [Index::One, Index::Three] {
        let error = |dt: f64, n: usize| {
            let run = Run::<f64, 2>::new(&scene(&SIMPLE), index).steps(dt, n);
            let [x, y, _] = run.points()[0];
            (x.abs() - exact[0]).hypot(y - exact[1])
        };
        let (coarse, fine) = (error(2e-3, 500), error(1e-3, 1000));
        assert!((3.9..4.1).contains(&(coarse / fine)), "{index:?}: {coarse:e}, {fine:e}");
        assert!(fine < 2e-5, "{fine:e}");
    }
}

#[test]
fn every_integrator_is_of_second_order() {
    for integrator in [
        Integrator::hht(0.1),
        Integrator::generalised_alpha(0.8),
        Integrator::newmark(1.0 / 6.0, 0.5),
    ] {
        for index in [Index::One, Index::Three] {
            let error = |dt: f64, n: usize| {
                let mut run = Run::<f64, 2>::new(&scene(&SIMPLE), index);
                run.options.integrator = integrator;
                let [x, y, _] = run.steps(dt, n).points()[0];
                (x.abs() - 0.986_291_751_131_875_3).hypot(y + 0.165_010_853_125_541_2)
            };
            let (coarse, fine) = (error(4e-3, 250), error(2e-3, 500));
            assert!((3.7..4.3).contains(&(coarse / fine)), "{integrator:?} {index:?}: {coarse:e}");
        }
    }
}

#[test]
fn what_hangs_at_rest_stays_at_rest() {
    let text = "[scene]\nname = \"hanging chain\"\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n[[body]]\nname = \"x\"\nrod = { from = [0.1, 0.0], to = [0.1, -0.7] }\nmass = 1.3\n[[body]]\nname = \"y\"\nrod = { from = [0.1, -0.7], to = [0.1, -1.3] }\nmass = 0.7\n[[joint]]\nname = \"j\"\nkind = \"revolute\"\nbodies = [\"ground\", \"x\"]\nat = [0.1, 0.0]\n[[joint]]\nname = \"k\"\nkind = \"revolute\"\nbodies = [\"x\", \"y\"]\nat = [0.1, -0.7]\n";
    for index in [Index::One, Index::Three] {
        for dt in [1e-2, 1e-3, 1e-4] {
            let run = Run::<f64, 2>::new(&scene(text), index).steps(dt, 100);
            assert!(run.state.v.iter().all(|v| v.abs() < 1e-12), "{index:?}, {dt}");
        }
    }
}

#[test]
fn options_outside_their_range_are_named() {
    let plain = Options::<f64>::index3();
    assert_eq!(plain.validate(), Ok(()));
    for (options, name) in [
        (Options { tolerance: 0.0, ..plain }, "tolerance"),
        (Options { rank: f64::NAN, ..plain }, "rank"),
        (Options { regularisation: Some(-1.0), ..plain }, "regularisation"),
        (Options { max_iterations: 0, ..plain }, "max_iterations"),
        (
            Options { stabilisation: Stabilisation::Baumgarte { alpha: 0.0, beta: 1.0 }, ..plain },
            "stabilisation.alpha",
        ),
    ] {
        assert_eq!(options.validate(), Err(OptionError::NotPositive(name)));
    }
}

#[test]
fn index3_keeps_the_energy_of_the_double_pendulum_as_the_trapezoidal_rule_does() {
    for (dt, expected) in DOUBLE_ENERGY {
        let run = Run::<f64, 2>::new(&scene(&DOUBLE), Index::Three);
        let error = energy_error(run, dt, 10.0);
        assert!(error < expected * ROOM, "{dt}: {error:.4e} J");
    }
}

#[test]
fn projected_index1_keeps_the_energy_of_the_double_pendulum() {
    let run = Run::<f64, 2>::new(&scene(&DOUBLE), Index::One);
    let error = energy_error(run, 1e-3, 10.0);
    assert!(error < DOUBLE_ENERGY[1].1 * ROOM, "{error:.4e} J");
}

#[test]
fn corrections_do_not_depend_on_the_step() {
    for dt in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        let mut run = Run::<f64, 2>::new(&scene(&DOUBLE), Index::Three);
        for _ in 0..50 {
            let report = run.step(dt).unwrap();
            assert!(report.iterations <= 3, "{dt}: {report:?}");
            assert!(report.violation[0] < 1e-16, "{dt}: {report:?}");
        }
    }
}

#[test]
fn the_reaction_of_a_pendulum_is_the_tension_of_its_bar() {
    for index in [Index::One, Index::Three] {
        let mut run = Run::<f64, 2>::new(&scene(&SIMPLE), index);
        for _ in 0..300 {
            run.step(2e-3).unwrap();
            let bob = run.model.point(BodyId::Body(0), run.scene.bodies[0].center);
            let (r, v) = (bob.value(&run.state.q), bob.value(&run.state.v));
            // m (v^2 - g . r) / L with m = 1 kg, L = 1 m
            let tension = v[0] * v[0] + v[1] * v[1] - 9.81 * r[1];
            let found = run.state.reaction[0];
            assert!((found - tension).abs() < 1e-8, "{index:?}: {found} for {tension}");
        }
    }
}

/// Returns the largest |phi| and the largest energy error of the double pendulum over 10 s at 1 ms, with the given stabilisation.
fn drift(stabilisation: Stabilisation<f64>) -> (f64, f64) {
    let mut run = Run::<f64, 2>::new(&scene(&DOUBLE), Index::One);
    run.options = Options { stabilisation, ..Options::index1() };
    let start = run.invariant();
    let (mut phi, mut energy): (f64, f64) = (0.0, 0.0);
    for _ in 0..10_000 {
        phi = phi.max(run.step(1e-3).expect("a regular step").violation[0]);
        energy = energy.max((run.invariant() - start).abs());
    }
    (phi, energy)
}

#[test]
fn plain_index1_drifts_baumgarte_drifts_less_at_the_price_of_energy_and_projection_not_at_all() {
    let (plain, plain_energy) = drift(Stabilisation::None);
    let (baumgarte, energy) = drift(Stabilisation::Baumgarte { alpha: 100.0, beta: 100.0 });
    assert!(plain > 2e-5, "plain: {plain:.1e} m");
    assert!(baumgarte < plain / 5.0, "Baumgarte: {baumgarte:.1e} m of {plain:.1e} m");
    assert!(energy > plain_energy, "Baumgarte: {energy:.1e} J, plain: {plain_energy:.1e} J");
    let (projected, energy) = drift(Stabilisation::Projection);
    assert!(projected < 1e-15, "projection: {projected:.1e} m");
    assert!(energy < DOUBLE_ENERGY[1].1 * ROOM * 1.01, "projection: {energy:.1e} J");
}

#[test]
fn index3_passes_the_singular_positions_on_the_right_branch_or_says_that_it_cannot() {
    let mut passed = 0;
    let steps = [500, 700, 1000, 1500, 2000, 3000, 4000, 5000, 6500, 8000, 10_000, 13_000];
    for n in steps {
        let dt = 10.0 / f64::from(n);
        let mut run = Run::<f64, 2>::new(&scene(&TWO_FOUR_BARS), Index::Three);
        let end = (0..n).try_for_each(|_| run.step(dt).map(drop));
        match end {
            Ok(()) => {
                let [x, y, _] = run.points()[0];
                let error = (2.0 * x - CRANK[0]).hypot(2.0 * y - CRANK[1]);
                // The error of the trapezoidal rule is 211 dt^2 at 2e-2 s, 66 dt^2 at 1e-2 s and 24 dt^2 at 1e-3 s.
                assert!(error < 250.0 * dt * dt, "{dt}: {error:e} m");
                passed += 1;
            }
            Err(StepError::RankLost { .. }) => {}
            Err(other) => panic!("{dt}: {other}"),
        }
    }
    assert!(passed >= steps.len() - 1, "{passed} passed");
}

#[test]
fn index3_passes_the_singular_positions_with_the_energy_of_the_rule() {
    for (dt, expected) in [(1e-2, 9.17e-2), (1e-3, 8.30e-4), (1e-4, 8.21e-6)] {
        let run = Run::<f64, 2>::new(&scene(&TWO_FOUR_BARS), Index::Three);
        let error = energy_error(run, dt, 10.0);
        assert!(error < expected * ROOM, "{dt}: {error:.4e} J");
    }
}

#[test]
fn index1_at_a_singular_position_is_right_or_refused() {
    for n in [100, 300, 1000, 3000] {
        let dt = 1.0 / f64::from(n);
        let mut run = Run::<f64, 2>::new(&scene(&TWO_FOUR_BARS), Index::One);
        for _ in 0..n {
            match run.step(dt) {
                Ok(_) => {}
                Err(StepError::RankLost { .. } | StepError::NotConverged { .. }) => break,
                Err(other) => panic!("{dt}: {other}"),
            }
        }
        // On the expected branch all cranks stay parallel.
        let points = run.points();
        assert!((points[0][1] - points[2][1]).abs() < 1e-9, "{dt}: the cranks left each other");
    }
}

#[test]
fn a_step_onto_the_singular_position_is_refused_and_changes_nothing() {
    let mut run = Run::<f64, 2>::new(&scene(&TWO_FOUR_BARS), Index::Three).steps(1e-3, 714);
    // The secant rule finds the step that ends with horizontal cranks.
    let height = |run: &mut Run<f64, 2>, dt: f64| {
        let before = run.state.clone();
        let result = run.step(dt);
        let y = run.points()[0][1];
        run.state.copy_from(&before);
        result.map(|_| y)
    };
    let (mut a, mut b) = (1e-4, 3e-4);
    let mut lost = None;
    let mut last = height(&mut run, a).unwrap();
    for _ in 0..20 {
        match height(&mut run, b) {
            Ok(y) => (a, b, last) = (b, b - y * (b - a) / (y - last), y),
            Err(e) => {
                lost = Some(e);
                break;
            }
        }
    }
    let before = run.state.clone();
    assert!(run.step(b).is_err(), "at {last:e} m");
    assert_eq!(run.state, before);
    let Some(StepError::RankLost { row, pivot }) = lost else { panic!("{lost:?} at {last:e} m") };
    assert!(pivot < 1e-9, "{pivot:e}");
    assert!(matches!(
        mbs_core::model::Model::<f64>::owner_of_row(&run.model, row as usize),
        Owner::Body(_) | Owner::Joint(_)
    ));
}

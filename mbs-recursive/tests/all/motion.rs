//! Runs of complete mechanisms: tests of order, energy, singular positions, and the closure of the report.

use crate::support::Run;
use mbs_core::integrator::Integrator;
use mbs_recursive::{Closure, Planar, Spatial};
use mbs_testkit::file;

/// Largest energy error of the trapezoidal rule on the double pendulum in natural coordinates [J]. The runs have 10 s, with steps of 1e-2 s
/// and of 1e-3 s.
const DOUBLE_PENDULUM: [f64; 2] = [4.645e-1, 4.636e-3];
/// Position of the tip of the first crank of the two four-bars after 10 s [m]. The mechanism moves as a pendulum, as the scene states, so
/// the tip has a closed form.
const TIP: [f64; 2] = [0.328_458_111_540_815_4, 0.944_518_538_178_601];

#[test]
fn trapezoidal_rule_is_of_second_order_and_below_the_level_of_natural_coordinates() {
    let run = |dt, n| Run::<Planar>::new::<2>(&file("double-pendulum")).drift(dt, n);
    let errors = [run(1e-2, 1000), run(1e-3, 10_000)];
    assert!(errors[0] < DOUBLE_PENDULUM[0] && errors[1] < DOUBLE_PENDULUM[1], "{errors:?}");
    assert!((80.0..125.0).contains(&(errors[0] / errors[1])), "{errors:?}");
}

#[test]
fn generalised_alpha_and_hht_are_of_second_order_on_trees_loops_and_a_damped_oscillator() {
    // The reference is the method of order 8. Its error is 1e-5 times the error of the steps. A method of order one would have half the
    // error with half the step.
    fn ratio(name: &str, integrator: Integrator<f64>) -> f64 {
        let scene = file(name);
        let mut exact = Run::<Planar>::new::<2>(&scene);
        exact.options.error = 1e-11;
        exact.rk853(1.0).expect("a step");
        let apart = |n: u32| {
            let mut run = Run::<Planar>::new::<2>(&scene);
            run.options.integrator = integrator;
            run.drift_of(n, |run| run.step(1.0 / f64::from(n)));
            let differences = run.state.z.iter().zip(&exact.state.z).map(|(x, y)| (x - y).abs());
            differences.fold(0.0, f64::max)
        };
        apart(500) / apart(1000)
    }
    for integrator in [Integrator::generalised_alpha(0.8), Integrator::hht(0.05)] {
        let ratios = ["double-pendulum", "four-bar", "quarter-car"].map(|s| ratio(s, integrator));
        assert!(ratios.iter().all(|r| (3.7..4.3).contains(r)), "{integrator:?}: {ratios:?}");
    }
}

#[test]
fn rk4_loses_energy_with_order_four_or_better_on_trees_and_loops() {
    // The energy error of RK4 is proportional to h⁴ or h⁵.
    fn ratio<S: mbs_recursive::space::Space<f64>, const D: usize>(name: &str, dt: f64) -> f64 {
        let run = |n: u32, dt: f64| Run::<S>::new::<D>(&file(name)).drift_of(n, |run| run.rk4(dt));
        run(400, dt) / run(800, dt * 0.5)
    }
    let ratios = [
        ratio::<Spatial, 3>("tree-30", 2.5e-3),
        ratio::<Spatial, 3>("spatial-chain-20", 2.5e-3),
        ratio::<Spatial, 3>("spinning-top", 2.5e-3),
        ratio::<Spatial, 3>("spatial-four-bar", 2.5e-3),
        ratio::<Planar, 2>("four-bar", 1e-2),
        ratio::<Planar, 2>("andrews", 3e-5),
    ];
    assert!(ratios.iter().all(|r| (11.0..45.0).contains(r)), "{ratios:?}");
}

#[test]
fn a_tighter_error_makes_a_smaller_energy_error() {
    let run = |error| {
        let mut run = Run::<Planar>::new::<2>(&file("double-pendulum"));
        run.options.error = error;
        run.drift_of(10, |run| run.rk54(1.0))
    };
    let errors = [run(1e-5), run(1e-7), run(1e-9)];
    assert!(errors[0] > 20.0 * errors[1] && errors[1] > 20.0 * errors[2], "{errors:?}");
    assert!(errors[2] < 1e-7, "{errors:?}");
}

#[test]
fn order_8_takes_half_the_evaluations_of_order_5_for_ten_digits() {
    let run = |is_eighth: bool, error: f64| {
        let mut run = Run::<Planar>::new::<2>(&file("double-pendulum"));
        run.options.error = error;
        let (start, mut evaluations) = (run.invariant(), 0);
        for _ in 0..10 {
            let report = if is_eighth { run.rk853(1.0) } else { run.rk54(1.0) };
            evaluations += report.expect("a step").iterations;
        }
        ((run.invariant() - start).abs(), evaluations)
    };
    let (fifth, eighth) = (run(false, 1e-12), run(true, 1e-12));
    assert!(fifth.0 < 1e-9 && eighth.0 < 1e-9, "{fifth:?} {eighth:?}");
    assert!(2 * eighth.1 < fifth.1, "{fifth:?} {eighth:?}");
}

#[test]
fn error_control_begins_with_the_first_step_and_stays_within_the_length_asked_for() {
    let steps = |first_step| {
        let mut run = Run::<Planar>::new::<2>(&file("double-pendulum"));
        // Every step is accepted, and the next one is five times as long.
        (run.options.error, run.options.first_step) = (1e6, first_step);
        let report = run.rk54(0.1).expect("a step");
        assert_eq!((report.rejected, run.state.t.to_bits()), (0, 0.1_f64.to_bits()));
        report.steps
    };
    // steps: 0.1; 0.01, 0.05, 0.04; 0.001, 0.005, 0.025, 0.069; 0.1
    assert_eq!([None, Some(0.01), Some(0.001), Some(0.7)].map(steps), [1, 3, 4, 1]);
}

#[test]
fn the_redundant_loop_of_the_spatial_four_bar_has_its_rank() {
    let mut run = Run::<Spatial>::new::<3>(&file("spatial-four-bar"));
    let rank = run.model.rank(&run.state, &mut run.workspace).expect("regular");
    // Three of the five equations of a cut hinge are redundant, because the linkage stays in its plane.
    assert_eq!((run.model.n_freedoms(), run.model.n_rows(), rank), (3, 5, 2));
}

#[test]
fn a_hinge_of_two_balls_repeats_one_row_though_its_weights_are_large() {
    let mut run = Run::<Spatial>::new::<3>(&file("iltis-links"));
    let rank = run.model.rank(&run.state, &mut run.workspace).expect("regular");
    // There are four redundant rows, one for each hinge. The vehicle has ten freedoms.
    assert_eq!((run.model.n_freedoms(), run.model.n_rows(), rank), (42, 36, 32));
}

#[test]
fn two_four_bars_pass_their_singular_positions_on_the_pendulum_s_branch() {
    // The mechanism passes the singular position ten times in 10 s. The error of the tip is smaller for methods of higher order.
    let tip = |run: &mut Run<Planar>| {
        let tip = run.motions(5)[0].point(&[0.0, 1.0, 0.0].into())[0];
        (tip[0] - TIP[0]).abs().max((tip[1] - TIP[1]).abs())
    };
    for (dt, n, level) in [(1e-2, 1000, 3e-4), (1e-3, 10_000, 3e-6)] {
        let mut run = Run::<Planar>::new::<2>(&file("two-four-bars"));
        let energy = run.drift(dt, n);
        let apart = tip(&mut run);
        assert!(apart < level && energy < 2e-2, "{dt}: {apart} m, {energy} J");
    }
    let mut run = Run::<Planar>::new::<2>(&file("two-four-bars"));
    let energy = run.drift_of(1000, |run| run.rk4(1e-2));
    assert!(tip(&mut run) < 1e-6 && energy < 2e-6, "{} m, {energy} J", tip(&mut run));
}

#[test]
fn singular_positions_cost_no_digits_at_tight_tolerances() {
    // Near a singular position, velocities have an error of rounding / distance² in a direction that the constraints forbid a little
    // further on. If this counted as an error of the step, steps would become shorter until a step ends in the singular position. The error
    // of the tip would then be 1e-5 m for any tolerance.
    for (name, tip) in
        [("four-bar", [0.478_385_057_760_970_6, 0.878_150_178_791_209_3]), ("two-four-bars", TIP)]
    {
        for (tolerance, level) in [(1e-10, 1e-7), (1e-11, 1e-8), (1e-12, 1e-9)] {
            let mut run = Run::<Planar>::new::<2>(&file(name));
            run.options.error = tolerance;
            let energy = run.drift_of(200, |run| run.rk54(0.05));
            let bodies = run.motions(if name == "four-bar" { 3 } else { 5 });
            let end = bodies[0].point(&[0.0, 1.0, 0.0].into())[0];
            let apart = (end[0] - tip[0]).abs().max((end[1] - tip[1]).abs());
            assert!(
                apart < level && energy < level,
                "{name}, {tolerance:e}: {apart:e} m, {energy:e} J"
            );
        }
    }
}

#[test]
fn the_report_s_closure_holds_loops_within_its_penalty() {
    let mut run = Run::<Planar>::new::<2>(&file("four-bar"));
    run.options.closure = Closure::report();
    let (mut worst, start) = ([0.0_f64; 3], run.invariant());
    for _ in 0..500 {
        let report = run.step(1e-3).expect("a regular step");
        for (worst, x) in worst.iter_mut().zip(report.violation) {
            *worst = worst.max(x);
        }
    }
    let energy = (run.invariant() - start).abs();
    // λ = α Φ̈ is about 10 N with α = 1e7, so Φ̈ is 1e-6. The loops open much less than they would by drift.
    assert!(worst[0] > 0.0 && worst[0] < 1e-4 && worst[1] < 1e-4 && worst[2] < 1e-3, "{worst:?}");
    assert!(energy < 1e-2, "{energy}");
}

#[test]
fn guides_and_dampers_are_in_the_ledger() {
    let run = |dt, n| Run::<Planar>::new::<2>(&file("guided-four-bar")).drift(dt, n);
    let errors = [run(1e-2, 500), run(5e-3, 1000)];
    assert!((3.5..4.5).contains(&(errors[0] / errors[1])), "{errors:?}");
}

/// A body that a guide turns about a joint to the ground. It has no contact or joint with the other bodies.
const FLAG: &str = r#"
[[body]]
name = "flag"
mass = 1.0
center = [0.3, 0.3, 0.1]
inertia = [0.1, 0.2, 0.3, 0.0, 0.0, 0.0]
[[joint]]
name = "flag-pole"
kind = "revolute"
bodies = ["ground", "flag"]
at = [0.3, 0.2, 0.1]
axis = [0.0, 1.0, 0.0]
[[guide]]
joint = "flag-pole"
ramp = { rate = 3.0 }
"#;

#[test]
fn a_guided_body_that_meets_no_other_changes_nothing() {
    // The power of the guide is computed from the forces through the joints. The following projections need the factored inertias, which
    // must not change.
    let path = format!("{}/../scenes/rssr.toml", env!("CARGO_MANIFEST_DIR"));
    let alone = std::fs::read_to_string(path).expect("the scene is there");
    let ends = |step: fn(&mut Run<Spatial>)| {
        [alone.clone(), alone.clone() + FLAG].map(|text| {
            let mut run = Run::<Spatial>::new::<3>(&mbs_testkit::scene(&text));
            for _ in 0..20 {
                step(&mut run);
            }
            (run.state.z, run.state.v)
        })
    };
    let fixed = ends(|run| {
        run.rk4(5e-3).expect("a step");
    });
    let controlled = ends(|run| {
        run.options.error = 1e-5;
        run.rk54(0.02).expect("a step");
    });
    for [(z, v), (z_beside, v_beside)] in [fixed, controlled] {
        assert_eq!((z.len(), v.len()), (z_beside.len(), v_beside.len()));
        for (x, y) in z.iter().chain(&v).zip(z_beside.iter().chain(&v_beside)) {
            // The limit allows for rounding errors of numbers of order ten over twenty steps, which the motion amplifies.
            assert!((x - y).abs() < 1e-11, "{x} {y}");
        }
    }
}

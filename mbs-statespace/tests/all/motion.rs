//! Motions compared with closed forms, with the tables of the report, and with the index-3 augmented Lagrangian.

use crate::common::Bench;
use mbs_core::integrator::Integrator;
use mbs_statespace::{Coordinates, StepError};
use mbs_testkit::scenes::{
    CHAIN, DOUBLE, FREE, GUIDED, N_FOUR_BAR, REDUNDANT, SIMPLE, SLIDER, TOP, TWO_FOUR_BARS,
};
use mbs_testkit::{PLANAR, SPATIAL, apart, retell, scene};

/// Position of a mass on a bar of 1 m, 1 s after the release from the horizontal, by elliptic functions [m].
const PENDULUM_AT_ONE: [f64; 2] = [-0.986_291_751_132, -0.165_010_853_126];

const PENDULUM: &str = "[scene]\nname = \"pendulum\"\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n[[body]]\nname = \"bob\"\nmass = 1.0\ncenter = [1.0, 0.0]\ninertia = 0.0\n[[joint]]\nname = \"pivot\"\nkind = \"revolute\"\nbodies = [\"ground\", \"bob\"]\nat = [0.0, 0.0]\n";

fn pendulum_error(dt: f64, set: impl Fn(&mut Bench<f64, 2>)) -> f64 {
    let mut bench = Bench::<f64, 2>::new(PENDULUM);
    set(&mut bench);
    bench.run(dt, (1.0 / dt).round() as u32);
    apart(&bench.state.q[..2], &PENDULUM_AT_ONE)
}

#[test]
fn every_integrator_is_of_second_order_on_the_pendulum_in_both_coordinates() {
    for coordinates in [Coordinates::Tangent, Coordinates::Chosen] {
        for integrator in [
            Integrator::trapezoidal(),
            Integrator::newmark(1.0 / 6.0, 0.5),
            Integrator::generalised_alpha(0.8),
            Integrator::hht(0.05),
        ] {
            let error = |dt| {
                pendulum_error(dt, |bench| {
                    bench.options.integrator = integrator;
                    bench.options.coordinates = coordinates;
                })
            };
            let ratio = error(1e-3) / error(5e-4);
            // With chosen columns, the position at which the columns change depends on the step. So the error does not fall smoothly with
            // the step.
            let width = if coordinates == Coordinates::Tangent { 0.05 } else { 0.5 };
            assert!((ratio - 4.0).abs() < width, "{coordinates:?} {integrator:?}: {ratio}");
        }
    }
}

fn largest_energy_error(text: &str, dt: f64, duration: f64) -> f64 {
    let mut bench = Bench::<f64, 2>::new(text);
    let (start, mut error) = (bench.invariant(), 0.0_f64);
    for _ in 0..(duration / dt).round() as u32 {
        bench.run(dt, 1);
        error = error.max((bench.invariant() - start).abs());
    }
    error
}

#[test]
fn double_pendulum_keeps_its_energy_as_the_trapezoidal_rule_can() {
    // Energy errors of the trapezoidal rule in natural coordinates over 10 s [J]. The report's state space has 2.9e-1, 4.8e-3, 4.3e-5.
    for (dt, limit) in [(1e-2, 4.645e-1), (1e-3, 4.636e-3), (1e-4, 4.335e-5)] {
        let error = largest_energy_error(&DOUBLE, dt, 10.0);
        assert!(error <= limit, "{dt}: {error:e} J");
    }
}

/// Checks that state space and index-3 agree within ten times the larger of their errors. The errors are estimated from runs with dt and dt
/// / 2.
fn agrees<const D: usize>(text: &str, dt: f64, steps: u32) {
    let mut coarse = Bench::<f64, D>::new(text);
    coarse.run(dt, steps);
    let mut fine = Bench::<f64, D>::new(text);
    fine.run(dt / 2.0, 2 * steps);
    let (ours, finer) = (&coarse.state.q, &fine.state.q);
    let (theirs, their_finer) = (coarse.index3(dt, steps), coarse.index3(dt / 2.0, 2 * steps));
    let error = apart(ours, finer).max(apart(&theirs.q, &their_finer.q)) * 4.0 / 3.0;
    let difference = apart(ours, &theirs.q);
    let name = &coarse.scene.name;
    // The term 1e-12 covers rounding errors of the positions. A guided mechanism has no other error.
    assert!(difference <= 10.0 * error + 1e-12, "{name}: {difference:e} against {error:e}");
    // The error must be small enough that a wrong motion would be detected.
    assert!(error < 0.02, "{name}: error {error:e}");
}

#[test]
fn scenes_move_as_in_the_index3_augmented_lagrangian() {
    agrees::<2>(&SIMPLE, 1e-3, 1000);
    agrees::<2>(&DOUBLE, 1e-3, 1000);
    agrees::<2>(&SLIDER, 1e-3, 1000);
    agrees::<2>(&GUIDED, 2e-3, 500);
    agrees::<2>(&N_FOUR_BAR, 2e-3, 300);
    agrees::<3>(&CHAIN, 2e-3, 300);
    agrees::<3>(&REDUNDANT, 1e-3, 1000);
    agrees::<3>(&TOP, 2e-4, 1000);
    agrees::<3>(&FREE, 1e-3, 1000);
    agrees::<2>(PLANAR, 1e-3, 300);
    agrees::<3>(SPATIAL, 1e-3, 300);
}

#[test]
fn work_and_reactions_are_those_of_index3() {
    // A driven mechanism with dampers. The energy balance and the guides' multipliers are compared, at a step where the error of both methods
    // is 1e-5 of their size.
    let text = PLANAR;
    let mut bench = Bench::<f64, 2>::new(text);
    let (dt, steps) = (2e-4, 500);
    bench.run(dt, steps);
    let theirs = bench.index3(dt, steps);
    let size = theirs.work.abs().max(1.0);
    assert!((bench.state.work - theirs.work).abs() < 1e-5 * size, "{}", bench.state.work);
    assert!((bench.state.power - theirs.power).abs() < 1e-4 * theirs.power.abs().max(1.0));
}

#[test]
fn the_redundant_spatial_four_bar_moves_like_the_planar_one() {
    let spatial = scene(&REDUNDANT);
    let planar = retell::flattened(&spatial);
    let mut space = Bench::<f64, 3>::of(spatial);
    let mut plane = Bench::<f64, 2>::of(planar);
    assert!(!space.w.elimination().dropped_rows().is_empty(), "the spatial one is redundant");
    assert!(plane.w.elimination().dropped_rows().is_empty());
    let (dt, steps) = (1e-3, 1000);
    space.run(dt, steps);
    plane.run(dt, steps);
    let (space, plane) = (space.centers(&space.state), plane.centers(&plane.state));
    for ((name, a), (_, b)) in space.iter().zip(&plane) {
        // Both runs integrate in the metric of the mass, which is the same in both. The results differ only by rounding errors, which grow
        // over a thousand steps.
        let [x, y, off] = retell::in_plane(*a);
        let difference = apart(&[x, y], &b[..2]).max(off.abs());
        assert!(difference < 1e-9, "{name}: {a:?} {b:?} {difference:e}");
    }
}

/// Returns a frame moved by the angle, length and twist of a link (Denavit and Hartenberg): three axes, then the origin.
fn along([x, y, z, p]: [[f64; 3]; 4], angle: f64, length: f64, twist: f64) -> [[f64; 3]; 4] {
    let mix = |a: f64, u: [f64; 3], b: f64, v: [f64; 3]| [0, 1, 2].map(|i| a * u[i] + b * v[i]);
    let (s, c) = angle.sin_cos();
    let (new_x, across) = (mix(c, x, s, y), mix(-s, x, c, y));
    let (s, c) = twist.sin_cos();
    [new_x, mix(c, across, s, z), mix(-s, across, c, z), mix(1.0, p, length, new_x)]
}

/// Returns Bennett's linkage: four hinges whose axes are neither parallel nor intersect, with one freedom. Opposite links are equal.
fn bennett() -> String {
    let (a, alpha, beta, angle) = (1.0_f64, 0.6_f64, 1.1_f64, 0.8_f64);
    let b = a * beta.sin() / alpha.sin();
    let ratio = ((beta + alpha) / 2.0).sin() / ((beta - alpha) / 2.0).sin();
    let other = 2.0 * (ratio / (angle / 2.0).tan()).atan();
    let mut frames = vec![[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]]];
    for (turn, length, twist) in [(angle, a, alpha), (other, b, beta), (-angle, a, alpha)] {
        frames.push(along(frames[frames.len() - 1], turn, length, twist));
    }
    let mut text = String::from(
        "[scene]\nname = \"Bennett\"\ndimension = 3\ngravity = [0.0, 1.0, -9.81]\nduration = 1.0\n",
    );
    for i in 0..3 {
        let c = [0, 1, 2].map(|k| (frames[i][3][k] + frames[i + 1][3][k]) / 2.0);
        text += &format!("[[body]]\nname = \"b{i}\"\nmass = 1.0\ncenter = {c:?}\n");
        text += "inertia = [0.1, 0.08, 0.09, 0.01, 0.0, 0.0]\n";
    }
    let names = ["ground", "b0", "b1", "b2", "ground"];
    for (i, f) in frames.iter().enumerate() {
        let (one, two, at, axis) = (names[i], names[i + 1], f[3], f[2]);
        text += &format!("[[joint]]\nname = \"j{i}\"\nkind = \"revolute\"\n");
        text += &format!("bodies = [\"{one}\", \"{two}\"]\nat = {at:?}\naxis = {axis:?}\n");
    }
    text + "[[initial]]\njoint = \"j0\"\nvalue = 0.0\nrate = 4.0\n"
}

#[test]
fn bennetts_linkage_keeps_the_rank_of_its_start() {
    let text = bennett();
    let mut bench = Bench::<f64, 3>::new(&text);
    assert_eq!(bench.w.elimination().independent().len(), 1);
    assert!(!bench.w.elimination().dropped_rows().is_empty(), "its hinges are redundant");
    bench.options.pivot_change = mbs_statespace::PivotChange::EveryStep;
    for _ in 0..1000 {
        // The dropped rows are also satisfied, although only the exact lengths of the links allow the motion.
        let report = bench.try_step(1e-3).unwrap();
        assert!(report.violation[0] < 1e-13, "{:?}", report.violation);
    }
    agrees::<3>(&text, 1e-3, 1000);
}

/// Steps through the singular position end on the right branch or with the typed error, for every step length.
#[test]
fn two_four_bars_pass_on_the_right_branch_or_say_that_they_cannot() {
    let (mut passed, mut refused) = (0, 0);
    for k in 0..120 {
        let dt = 2e-4 * 1.045_f64.powi(k);
        let mut bench = Bench::<f64, 2>::new(&TWO_FOUR_BARS);
        let start = bench.invariant();
        let mut outcome = Ok(());
        for _ in 0..(2.0 / dt) as u32 {
            let before = bench.state.clone();
            if let Err(error) = bench.try_step(dt) {
                assert!(bench.state == before, "the state is unchanged");
                outcome = Err(error);
                break;
            }
            // Both outer cranks have the same height on the symmetric branch [m].
            let centers = bench.centers(&bench.state);
            let heights: Vec<f64> =
                centers.iter().filter(|c| c.0.starts_with("crank")).map(|c| c.1[1]).collect();
            assert!((heights[0] - heights[2]).abs() < 1e-9, "dt {dt}: {heights:?}");
        }
        // The rule's error is 820 J/s^2 dt^2; the limit is twice as large.
        let error = (bench.invariant() - start).abs();
        assert!(error < 1640.0 * dt * dt + 1e-9, "dt {dt}: {error:e} J");
        match outcome {
            Ok(()) => passed += 1,
            Err(StepError::RankLost { row, pivot }) => {
                refused += 1;
                assert!((row as usize) < 5 && pivot < 1e-3, "row {row}, pivot {pivot}");
                // A refusal occurs only close to the horizontal position of the cranks.
                assert!(bench.centers(&bench.state)[0].1[1].abs() < 0.3, "dt {dt}");
            }
            Err(error) => assert!(dt > 0.01, "dt {dt}: {error}"),
        }
    }
    assert!(passed > 0 && refused > 0, "both happen: {passed}, {refused}");
}

#[test]
fn two_four_bars_reach_ten_seconds_exactly() {
    // Exact position of the first crank's end at 10 s [m], as the scene file states it.
    const END: [f64; 2] = [0.328_458_111_540_815_4, 0.944_518_538_178_601];
    let mut bench = Bench::<f64, 2>::new(&TWO_FOUR_BARS);
    bench.run(1e-3, 10_000);
    let center = bench.centers(&bench.state)[2].1;
    let end = [2.0 * center[0], 2.0 * center[1]];
    // The trapezoidal rule's error at this step is 4.8e-5 m.
    assert!(apart(&end, &END) < 6e-5, "{end:?}");
}

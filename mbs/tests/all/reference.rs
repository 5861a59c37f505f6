//! Motions against references: elliptic functions, extrapolation with 34 digits, closed-form kinematics.
#![allow(
    clippy::print_stdout,
    clippy::excessive_precision,
    reason = "what is measured is shown with --nocapture; references keep their digits"
)]

use crate::common;

use crate::common::{Bench, FORMULATIONS, distance, steps, worst};

/// Ratio of the errors at a step and at half of it in a method of order 2. Terms of higher order explain the difference from 4.
const SECOND_ORDER: core::ops::Range<f64> = 3.7..4.3;

/// Asserts that errors fall by 4 with each halving.
fn assert_second_order(case: &str, errors: &[f64]) {
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        println!("{case}: {:.3e} -> {:.3e}, ratio {ratio:.2}", pair[0], pair[1]);
        assert!(SECOND_ORDER.contains(&ratio), "{case}: {errors:?}");
    }
}

/// Distances of a point from references at their times.
fn errors_at<const N: usize>(
    (name, formulation, step): (&str, &str, f64),
    (body, at): (usize, [f64; 3]),
    references: &[(f64, [f64; 2]); N],
) -> [f64; N] {
    let mut bench = Bench::<2>::new(name, formulation, step);
    let point = bench.point(body, at);
    let (mut errors, mut next, mut k) = ([f64::NAN; N], 0, 0);
    let end = references[N - 1].0;
    bench
        .run(end, |b| {
            k += 1;
            if next < N && k == steps(references[next].0, step) {
                errors[next] = distance(b.position(&point), references[next].1);
                next += 1;
            }
        })
        .unwrap_or_else(|(t, e)| panic!("{name} {formulation} {step}: {e} at {t}"));
    errors
}

/// Position of the double pendulum's tip by extrapolation with 34 digits; two settings agree (benchmarks, section 6).
const DOUBLE_PENDULUM_TIP: [(f64, [f64; 2]); 3] = [
    (1.0, [-1.662_115_135_816_127_6, -1.041_466_637_193_224_7]),
    (2.0, [0.313_524_776_450_181_57, -1.914_746_617_562_305_2]),
    (3.0, [1.330_436_825_144_049_1, -1.398_644_860_519_204]),
];
/// Error constants c of the trapezoidal rule at these times [m/s^2]: error = c dt^2, with a margin of a tenth.
const DOUBLE_PENDULUM_LEVEL: [f64; 3] = [10.5, 128.0, 157.0];

#[test]
fn double_pendulum_tip_converges_with_order_2_to_the_reference() {
    for formulation in FORMULATIONS {
        let of = |step| {
            errors_at(
                ("double-pendulum", formulation, step),
                (1, [2.0, 0.0, 0.0]),
                &DOUBLE_PENDULUM_TIP,
            )
        };
        let errors = [1e-3, 5e-4, 2.5e-4].map(of);
        for i in 0..3 {
            let t = DOUBLE_PENDULUM_TIP[i].0;
            assert_second_order(
                &format!("double-pendulum {formulation} t = {t}"),
                &errors.map(|e| e[i]),
            );
            let level = errors[2][i] / 2.5e-4_f64.powi(2);
            println!("  error / dt^2 = {level:.3}");
            assert!(level <= DOUBLE_PENDULUM_LEVEL[i], "{formulation} t = {t}: {level}");
        }
    }
}

/// Position of the pendulum by Jacobi elliptic functions, with 18 digits (benchmarks, section 2).
const PENDULUM: [(f64, [f64; 2]); 4] = [
    (1.0, [0.986_291_751_131_875_3, -0.165_010_853_125_541_17]),
    (2.0, [-0.793_566_195_343_321_7, -0.608_483_930_443_791_5]),
    (5.0, [-0.942_305_435_043_757_3, -0.334_754_338_414_000_6]),
    (10.0, [-0.275_087_462_576_116_86, -0.961_419_205_099_125_1]),
];
/// Error constant of the trapezoidal rule at 10 s [m/s^2].
const PENDULUM_LEVEL: f64 = 106.0;

#[test]
fn simple_pendulum_follows_the_elliptic_functions_with_order_2() {
    for formulation in FORMULATIONS {
        let of = |step| {
            errors_at(("simple-pendulum", formulation, step), (0, [-1.0, 0.0, 0.0]), &PENDULUM)
        };
        let errors = [1e-3, 5e-4, 2.5e-4].map(of);
        for i in 0..PENDULUM.len() {
            let case = format!("simple-pendulum {formulation} t = {}", PENDULUM[i].0);
            assert_second_order(&case, &errors.map(|e| e[i]));
            let level = errors[2][i] / 2.5e-4_f64.powi(2);
            println!("  error / dt^2 = {level:.3}");
            assert!(level <= PENDULUM_LEVEL, "{case}: {level}");
        }
    }
}

/// Position of the crank's end by elliptic functions, with 20 digits (benchmarks, section 3).
const CRANK_END: [(f64, [f64; 2]); 1] =
    [(10.0, [0.328_458_111_540_815_4, 0.944_518_538_178_600_9])];

/// Steps over which the order is observed [s].
const CRANK_END_STEPS: [f64; 8] = [2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5];
/// Error constant of the trapezoidal rule at this time [m/s^2]: 38 in the limit, 57 at 2e-3 s.
const CRANK_END_LEVEL: f64 = 60.0;
/// How far the order over a decade of steps may differ from 2 [-]: terms of higher order matter at the largest steps.
const CRANK_END_ORDER: f64 = 0.1;

#[test]
fn two_four_bars_crank_end_converges_with_order_2_to_the_exact_row_down_to_1e_5() {
    let of =
        |step| errors_at(("two-four-bars", "index-3", step), (0, [0.0, 1.0, 0.0]), &CRANK_END)[0];
    let errors = CRANK_END_STEPS.map(of);
    for (step, error) in CRANK_END_STEPS.iter().zip(errors) {
        let level = error / (step * step);
        println!("two-four-bars dt {step:e}: {error:.3e} m, error / dt^2 = {level:.2}");
        assert!(level <= CRANK_END_LEVEL, "{step:e}: {level}");
    }
    // at 1e-3 s terms of higher order add a fifth; at 1e-4 s the error falls to a quarter at half the step
    assert_second_order("two-four-bars", &errors[4..6]);
    for (i, j) in [(1, 4), (4, 7)] {
        let order =
            (errors[i] / errors[j]).log10() / (CRANK_END_STEPS[i] / CRANK_END_STEPS[j]).log10();
        println!("order {order:.3}");
        assert!((order - 2.0).abs() <= CRANK_END_ORDER, "{order}");
    }
}

/// Positions of one and of forty four-bar linkages by elliptic functions, with 20 digits (benchmarks, section 3).
const ROWS_OF_FOUR_BARS: [(&str, (f64, [f64; 2])); 2] = [
    ("four-bar", (10.0, [0.478_385_057_760_970_56, 0.878_150_178_791_209_3])),
    ("n-four-bar-40", (10.0, [0.180_512_226_686_728_39, 0.983_572_740_582_311_6])),
];

#[test]
fn rows_of_four_bars_end_at_their_exact_places_with_order_2() {
    for (name, row) in ROWS_OF_FOUR_BARS {
        for formulation in FORMULATIONS {
            let of = |step| errors_at((name, formulation, step), (0, [0.0, 1.0, 0.0]), &[row])[0];
            let errors = [2.5e-4, 1.25e-4].map(of);
            assert_second_order(&format!("{name} {formulation}"), &errors);
            let level = errors[1] / 1.25e-4_f64.powi(2);
            println!("  error / dt^2 = {level:.3}");
            assert!(level <= CRANK_END_LEVEL, "{name} {formulation}: {level}");
        }
    }
}

/// Angle of the rocker in the scene rssr from its crank's angle, on the branch of the start.
fn rocker(crank: f64) -> f64 {
    let (s, c) = crank.sin_cos();
    // this is the closing equation, with the rocker's angle b, and cosine c and sine s of the crank's angle: (0.4 + 0.5 cos b)^2 + (0.5 sin b -
    // 0.15 c)^2 = 1.0425 - (0.7 - 0.15 s)^2; so 0.4 cos b - 0.15 c sin b = rest
    let rest = 1.0425 - (0.7 - 0.15 * s).powi(2) - 0.16 - 0.25 - 0.0225 * c * c;
    let (x, y) = (0.4, -0.15 * c);
    y.atan2(x) + (rest / x.hypot(y)).acos() - 0.4_f64.atan2(0.3)
}

#[test]
fn rssr_rocker_follows_the_crank_in_closed_form() {
    let scene = common::scene("rssr");
    for formulation in FORMULATIONS {
        let outcome = common::run_in(&scene, formulation, None);
        assert!(outcome.error.is_none(), "{formulation}: {:?}", outcome.error);
        let (mut off, mut reach) = (0.0, 0.0_f64);
        for (_, row) in outcome.rows() {
            off = worst(off, (row[1] - rocker(row[0])).abs());
            reach = reach.max(row[0]);
        }
        println!("rssr {formulation}: rocker {off:.1e} rad over {reach:.1} rad of the crank");
        assert!(off <= KINEMATICS, "{formulation}: {off:e}");
        assert!(reach > 50.0, "the crank turns fully, several times");
    }
}

type Point = [f64; 2];

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

/// A moving point: position, velocity, acceleration.
type Motion = [Point; 3];

/// The four-bar of the scene guided-four-bar in closed form: crank pin A and rocker pin B at a time.
fn four_bar(t: f64) -> [Motion; 2] {
    let rate = core::f64::consts::PI;
    let (s, c) = (0.24_f64.atan2(0.18) + rate * t).sin_cos();
    let a = [
        [0.3 * c, 0.3 * s],
        [-0.3 * rate * s, 0.3 * rate * c],
        [-0.3 * rate * rate * c, -0.3 * rate * rate * s],
    ];
    // B is where the coupler's circle about A meets the rocker's circle about its pivot D; of two points, the one left of the line from A to
    // D
    let (coupler2, rocker2, pivot) = (0.58624_f64, 0.36, [0.7, 0.0]);
    let d = minus(pivot, a[0]);
    let d2 = dot(d, d);
    let along = (coupler2 - rocker2 + d2) / (2.0 * d2);
    let across = (coupler2 / d2 - along * along).sqrt();
    let b = [a[0][0] + along * d[0] - across * d[1], a[0][1] + along * d[1] + across * d[0]];
    // the lengths are constant: (B - A) . (B - A)' = 0 and (B - D) . B' = 0, and their derivatives
    let (r, p) = (minus(b, a[0]), minus(b, pivot));
    let solve = |x: f64, y: f64| {
        let det = r[0] * p[1] - r[1] * p[0];
        [(x * p[1] - y * r[1]) / det, (r[0] * y - p[0] * x) / det]
    };
    let v = solve(dot(r, a[1]), 0.0);
    let w = minus(v, a[1]);
    let acceleration = solve(dot(r, a[2]) - dot(w, w), -dot(v, v));
    [a, [b, v, acceleration]]
}

/// Rate of the kinetic and potential energy d(T + V)/dt of a uniform rod between two moving points [W].
fn rod_power(mass: f64, x: &Motion, y: &Motion) -> f64 {
    let kinetic = 2.0 * dot(x[1], x[2]) + dot(x[1], y[2]) + dot(y[1], x[2]) + 2.0 * dot(y[1], y[2]);
    mass * kinetic / 6.0 + mass * 9.81 * (x[1][1] + y[1][1]) / 2.0
}

/// Error of positions and velocities [m, m/s], which the guide determines: the accuracy of their projections.
const KINEMATICS: f64 = 1e-9;
/// Error of accelerations and torque, relative to 1 + their size [-]: the accuracy of the acceleration projection.
const DYNAMICS: f64 = 1e-7;

#[test]
fn guided_four_bar_follows_its_closed_form_kinematics_and_inverse_dynamics() {
    for formulation in FORMULATIONS {
        let mut bench = Bench::<2>::new("guided-four-bar", formulation, 1e-3);
        let pins = [bench.point(0, [0.18, 0.24, 0.0]), bench.point(2, [0.868, 0.576, 0.0])];
        let fixed = |at| [at, [0.0; 2], [0.0; 2]];
        let mut off = [0.0; 4];
        let mut k = 0;
        bench
            .run(4.0, |b| {
                k += 1;
                let [crank, rocker] = four_bar(f64::from(k) * 1e-3);
                for (pin, exact) in pins.iter().zip([crank, rocker]) {
                    off[0] = worst(off[0], distance(b.position(pin), exact[0]));
                    off[1] = worst(off[1], distance(b.velocity(pin), exact[1]));
                    let size = 1.0 + dot(exact[2], exact[2]).sqrt();
                    off[2] = worst(off[2], distance(b.acceleration(pin), exact[2]) / size);
                }
                // power balance: torque times crank rate is the rate of kinetic and potential energy
                let power = rod_power(0.4, &fixed([0.0, 0.0]), &crank)
                    + rod_power(1.0, &crank, &rocker)
                    + rod_power(0.8, &fixed([0.7, 0.0]), &rocker);
                let torque = power / core::f64::consts::PI;
                let found = b.simulation.state().power / core::f64::consts::PI;
                off[3] = worst(off[3], (found - torque).abs() / (1.0 + torque.abs()));
            })
            .unwrap_or_else(|(t, e)| panic!("{formulation}: {e} at {t}"));
        println!(
            "guided-four-bar {formulation}: position {:.1e} velocity {:.1e} acceleration {:.1e} torque {:.1e}",
            off[0], off[1], off[2], off[3]
        );
        assert!(off[0] <= KINEMATICS && off[1] <= KINEMATICS, "{formulation}: {off:?}");
        assert!(off[2] <= DYNAMICS && off[3] <= DYNAMICS, "{formulation}: {off:?}");
    }
}

#[test]
fn guided_four_bar_crank_reaction_carries_the_torque_of_inverse_dynamics() {
    let scene = common::scene("guided-four-bar");
    for formulation in FORMULATIONS {
        let outcome = common::run_in(&scene, formulation, None);
        assert!(outcome.error.is_none());
        let fixed = |at| [at, [0.0; 2], [0.0; 2]];
        let mut off = 0.0;
        for (t, row) in outcome.rows().iter().skip(1) {
            let [crank, rocker] = four_bar(*t);
            let power = rod_power(0.4, &fixed([0.0, 0.0]), &crank)
                + rod_power(1.0, &crank, &rocker)
                + rod_power(0.8, &fixed([0.7, 0.0]), &rocker);
            let torque = power / core::f64::consts::PI;
            // the columns are three angles, then two forces and the moment of the crank's pivot
            off = worst(off, (row[5] - torque).abs() / (1.0 + torque.abs()));
        }
        println!("guided-four-bar {formulation}: moment of the crank reaction {off:.1e}");
        assert!(off <= DYNAMICS, "{formulation}: {off:e}");
    }
}

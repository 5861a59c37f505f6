//! Effects on sums of joint coordinates against closed forms, in every formulation.

use crate::common::oracle::{
    self, Rows, WAYS, Way, agree_in_the_limit, energy_balances, outputs_of,
};
use mbs_testkit::scene;

/// Inertias of two shafts [kg m^2].
const INERTIAS: [f64; 2] = [0.3, 0.05];

/// Scene of two shafts on the ground about parallel axes, which are oblique in space. The shafts have rates at the start, and `rest` is
/// further text.
fn shafts(dimension: usize, rates: [f64; 2], rest: &str) -> String {
    let mut text = format!("[scene]\nname = \"s\"\ndimension = {dimension}\nduration = 1.0\n");
    for (i, (inertia, rate)) in INERTIAS.iter().zip(rates).enumerate() {
        let (at, axis, inertia) = if dimension == 2 {
            (format!("[{i}.0, 0.0]"), "", format!("{inertia:?}"))
        } else {
            let six = format!("[{inertia:?}, {inertia:?}, {inertia:?}, 0.0, 0.0, 0.0]");
            (format!("[{i}.0, 0.2, 0.1]"), "axis = [0.36, 0.48, 0.8]\n", six)
        };
        text += &format!(
            "[[body]]\nname = \"w{i}\"\nmass = 1.0\ncenter = {at}\ninertia = {inertia}\n\
             [[joint]]\nname = \"j{i}\"\nkind = \"revolute\"\nbodies = [\"ground\", \"w{i}\"]\nat = {at}\n{axis}\
             [[initial]]\njoint = \"j{i}\"\nrate = {rate:?}\n\
             [[output]]\nname = \"angle-{i}\"\njoint = \"j{i}\"\nquantity = \"value\"\n\
             [[output]]\nname = \"rate-{i}\"\njoint = \"j{i}\"\nquantity = \"rate\"\n"
        );
    }
    text + rest
}

fn terms(factors: [f64; 2]) -> String {
    let [a, b] = factors;
    format!(
        "terms = [{{ joint = \"j0\", factor = {a:?} }}, {{ joint = \"j1\", factor = {b:?} }}]\n"
    )
}

/// Rows of a run by each method: angles and rates of both shafts, then the other outputs.
fn run(text: &str, times: (f64, f64)) -> Vec<(Way, Rows)> {
    WAYS.map(|way| (way, oracle::run(text, way, times))).to_vec()
}

/// Error of angles of some radians with steps of 0.1 ms at 20 rad/s [rad]: (w h)^2/12 of the angle, by the trapezoidal rule in natural
/// coordinates.
const TURNED: f64 = 4e-6;

#[test]
fn two_flywheels_on_a_spring_and_a_damper_turn_against_each_other_as_one_oscillator() {
    let [j1, j2] = INERTIAS;
    let (k, c, w) = (40.0, 0.2, 20.0);
    for (dimension, factor) in [(2, 1.0), (3, 1.0), (3, 2.5)] {
        // the sum m = a - n b of the shafts' angles has the equation m'' (1/(1/J1 + n^2/J2)) = -k m - c m'
        let n: f64 = factor;
        let mass = 1.0 / (1.0 / j1 + n * n / j2);
        let text = shafts(
            dimension,
            [w, 0.0],
            &format!(
                "[[effect]]\nname = \"e\"\nkind = \"torsion-spring\"\n{}stiffness = {k:?}\ndamping = {c:?}\n{}",
                terms([1.0, -n]),
                outputs_of("e")
            ),
        );
        let (delta, omega0) = (c / (2.0 * mass), (k / mass).sqrt());
        let omega = (omega0 * omega0 - delta * delta).sqrt();
        for (way, rows) in run(&text, (1e-4, 0.6)) {
            for (t, row) in rows.iter().step_by(200) {
                let (sin, cos) = (omega * t).sin_cos();
                let fall = (-delta * t).exp();
                let m = w / omega * fall * sin;
                let rate = w * fall * (cos - delta / omega * sin);
                // the momentum J1 a' + J2 b'/n is constant
                let both = j1 * w * t;
                let b = (both - j1 * m) / (n * j1 + j2 / n);
                let a = m + n * b;
                let found = [row[0], row[2], row[4], row[5] / omega, row[6] / k];
                let expected = [a, b, m, rate / omega, m + c / k * rate];
                for (i, (x, y)) in found.iter().zip(expected).enumerate() {
                    assert!(
                        (x - y).abs() < TURNED * (1.0 + n),
                        "{dimension}, {n}, {way:?}, {t}, {i}: {x} {y}"
                    );
                }
                let energy = 0.5 * k * row[4] * row[4];
                let power = -row[6] * row[5];
                assert!((row[7] - energy).abs() < 1e-9 * (1.0 + energy), "{way:?}: {row:?}");
                assert!((row[8] - power).abs() < 1e-9 * (1.0 + power.abs()), "{way:?}: {row:?}");
            }
            assert!(rows.last().expect("a row").1[0] > 6.0, "more than a turn");
        }
    }
}

#[test]
fn a_clutch_slips_until_its_shafts_have_the_common_rate_of_their_momentum() {
    let [j1, j2] = INERTIAS;
    let (torque, w) = (8.0, [30.0, -10.0]);
    for (dimension, n) in [(2, 1.0), (3, 1.0), (3, 2.0)] {
        let mobility = 1.0 / j1 + n * n / j2;
        let slip = w[0] - n * w[1];
        let lock = slip / (torque * mobility);
        let text = shafts(
            dimension,
            w,
            &format!(
                "[[effect]]\nname = \"e\"\nkind = \"friction\"\n{}coulomb = {torque:?}\n{}",
                terms([1.0, -n]),
                outputs_of("e")
            ),
        );
        let step = 1e-4;
        for (way, rows) in run(&text, (step, 1.2 * lock)) {
            // before the sum locks, torques are constant, except for a part e^2/slip^2 below 1e-8
            let half = &rows[rows.len() / 2];
            let t = half.0;
            for (found, expected) in [
                (half.1[1], w[0] - torque / j1 * t),
                (half.1[3], w[1] + n * torque / j2 * t),
                (half.1[6], torque),
            ] {
                assert!(
                    (found - expected).abs() < 1e-4 * expected.abs(),
                    "{way:?}: {found} {expected}"
                );
            }
            // the sum locks when its rate is below a thousandth, within two steps of the end of the slip
            let locked =
                rows.iter().find(|(_, row)| row[5].abs() < 1e-3 * slip).expect("it locks").0;
            assert!((locked - lock).abs() < 2e-3 * lock + 2.0 * step, "{way:?}: {locked} {lock}");
            // afterwards a' = n b', and n J1 a' + J2 b' keeps its value
            let b = (n * j1 * w[0] + j2 * w[1]) / (n * n * j1 + j2);
            let end = &rows.last().expect("a row").1;
            for (found, expected) in [(end[1], n * b), (end[3], b)] {
                assert!(
                    (found - expected).abs() < 1e-4 * expected.abs(),
                    "{dimension}, {n}, {way:?}: {found} {expected}"
                );
            }
        }
    }
}

#[test]
fn a_gear_with_play_hits_both_of_its_flanks() {
    let [j1, j2] = INERTIAS;
    let (n, half, k, w) = (2.0, 0.02, 2e3, 6.0);
    // 20 and 40 teeth: a + 2 b is zero without backlash
    let mass: f64 = 1.0 / (1.0 / j1 + n * n / j2);
    let contact = core::f64::consts::PI * (mass / k).sqrt();
    for dimension in [2, 3] {
        let text = shafts(
            dimension,
            [w, 0.0],
            &format!(
                "[[effect]]\nname = \"e\"\nkind = \"limit\"\n{}lower = -{half:?}\nupper = {half:?}\nstiffness = {k:?}\n{}",
                terms([1.0, n]),
                outputs_of("e")
            ),
        );
        let first = half / w;
        let duration = first + 2.0 * contact + 3.0 * half / w;
        for (way, rows) in run(&text, (1e-4, duration)) {
            let near = |t: f64| {
                let gap = |row: &&(f64, Vec<f64>)| (row.0 - t).abs();
                rows.iter().min_by(|a, b| gap(a).total_cmp(&gap(b))).expect("a row").1.clone()
            };
            // an impact reverses the rate of the sum: its impulse is 2 w mass
            let impulse = 2.0 * w * mass;
            let between = near(first + contact + half / w);
            let after = near(duration);
            for (found, expected) in [
                (between[1], w - impulse / j1),
                (between[3], -n * impulse / j2),
                (between[5], -w),
                (after[1], w),
                (after[3], 0.0),
                (after[5], w),
            ] {
                assert!(
                    (found - expected).abs() < 3e-3 * w,
                    "{dimension}, {way:?}: {found} {expected}"
                );
            }
            let deepest = rows.iter().map(|(_, row)| row[4].abs()).fold(0.0, f64::max);
            let expected = half + w * (mass / k).sqrt();
            assert!((deepest - expected).abs() < 1e-4, "{way:?}: {deepest} {expected}");
        }
    }
}

/// Scene of two wheels in a housing on a free hinge, with a torque on the sum of both angles.
fn housing(factors: [f64; 2], torque: f64) -> String {
    let body = |name: &str, x: f64, inertia: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 1.0\ncenter = [{x:?}, 0.0]\ninertia = {inertia:?}\n"
        )
    };
    let joint = |name: &str, bodies: [&str; 2], x: f64| {
        format!(
            "[[joint]]\nname = \"{name}\"\nkind = \"revolute\"\nbodies = {bodies:?}\nat = [{x:?}, 0.0]\n\
             [[output]]\nname = \"{name}\"\njoint = \"{name}\"\nquantity = \"rate\"\n"
        )
    };
    [
        "[scene]\nname = \"h\"\ndimension = 2\nduration = 1.0\n".to_owned(),
        body("housing", 0.0, 0.196),
        body("w0", 0.2, INERTIAS[0]),
        body("w1", -0.2, INERTIAS[1]),
        joint("h", ["ground", "housing"], 0.0),
        joint("j0", ["housing", "w0"], 0.2),
        joint("j1", ["housing", "w1"], -0.2),
        format!(
            "[[effect]]\nname = \"e\"\nkind = \"torque\"\n{}value = {torque:?}\n",
            terms(factors)
        ),
    ]
    .concat()
}

#[test]
fn what_carries_all_joints_of_a_sum_gets_the_opposite_of_its_torques() {
    let ([j1, j2], torque, duration) = (INERTIAS, 0.7, 5e-4);
    for factors in [[1.0, 2.0], [1.5, -1.0]] {
        let [c1, c2] = factors;
        // inertia 0.196 + 2 (1 kg at 0.2 m); the torque c T acts on each wheel about its axis
        let carrier = -(c1 + c2) * torque / 0.276;
        let expected = [carrier, c1 * torque / j1 - carrier, c2 * torque / j2 - carrier];
        for (way, rows) in run(&housing(factors, torque), (duration / 16.0, duration)) {
            let end = &rows.last().expect("a row").1;
            for (rate, expected) in end.iter().zip(expected) {
                let found = rate / duration;
                assert!(
                    (found - expected).abs() < 1e-8 * expected.abs(),
                    "{factors:?}, {way:?}: {found} {expected}"
                );
            }
        }
    }
}

/// Scene of two wheels and a slider in a housing on a hinge about oblique axes. Smooth laws act on sums of coordinates, of a line and of a
/// curve.
fn machine() -> String {
    let body = |name: &str, x: f64, inertia: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 1.0\ncenter = [{x:?}, 0.1, 0.0]\ninertia = [{inertia:?}, 0.16, 0.15, 0.002, 0.0, 0.001]\n"
        )
    };
    let joint = |name: &str, kind: &str, bodies: [&str; 2], x: f64, axis: [f64; 3]| {
        format!(
            "[[joint]]\nname = \"{name}\"\nkind = \"{kind}\"\nbodies = {bodies:?}\nat = [{x:?}, 0.0, 0.0]\naxis = {axis:?}\n\
             [[output]]\nname = \"{name}\"\njoint = \"{name}\"\nquantity = \"value\"\n\
             [[output]]\nname = \"{name}-rate\"\njoint = \"{name}\"\nquantity = \"rate\"\n"
        )
    };
    let sum = "{ joint = \"a\", factor = 1.0 }, { joint = \"b\", factor = -2.0 }, { joint = \"s\", factor = 3.0 }";
    let others = "{ points = [{ body = \"ground\", at = [0.0, 1.0, 0.0] }, { body = \"w0\", at = [0.3, 0.2, 0.1] }, { body = \"w2\", at = [0.5, 0.2, 0.1] }] }, \
                  { joint = \"a\", coefficients = [-6.3, 0.2, 0.1] }";
    [
        "[scene]\nname = \"m\"\ndimension = 3\nduration = 0.1\ngravity = [0.0, 0.0, -9.81]\n".to_owned(),
        body("housing", 0.0, 0.2),
        body("w0", 0.3, 0.07),
        body("w1", -0.3, 0.08),
        body("w2", 0.5, 0.09),
        joint("h", "revolute", ["ground", "housing"], 0.0, [0.1, 0.3, 1.0]),
        joint("a", "revolute", ["housing", "w0"], 0.3, [0.36, 0.48, 0.8]),
        joint("b", "revolute", ["housing", "w1"], -0.3, [1.0, -0.4, 0.2]),
        joint("s", "prismatic", ["housing", "w2"], 0.5, [0.2, 0.5, -0.6]),
        format!("[[effect]]\nname = \"e\"\nkind = \"torsion-spring\"\nterms = [{sum}]\nstiffness = 20.0\ndamping = 0.2\nfree_value = 6.9\n"),
        format!("[[effect]]\nkind = \"friction\"\nterms = [{sum}]\ncoulomb = 0.4\nregularisation = 0.5\n"),
        format!("[[effect]]\nname = \"f\"\nkind = \"polynomial-spring\"\nterms = [{others}]\ncoefficients = [[-9.0, 9.0, 0.5, 30.0, 4.0]]\n"),
        "[[initial]]\njoint = \"a\"\nvalue = 7.0\nrate = 3.0\n[[initial]]\njoint = \"h\"\nrate = -1.0\n".to_owned(),
        outputs_of("e"),
        outputs_of("f"),
    ]
    .concat()
}

#[test]
fn natural_and_relative_coordinates_agree_on_sums_to_nine_digits() {
    let way = Way("index-3", "trapezoidal");
    agree_in_the_limit(&scene(&machine()), way, (2.5e-4, 0.1, 40), 1e-9, |_| ());
}

#[test]
fn the_energy_of_laws_on_sums_balances() {
    energy_balances(&scene(&machine()));
}

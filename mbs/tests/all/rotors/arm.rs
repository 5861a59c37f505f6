//! An arm of two links with a rotor at each joint, against its equations of motion written by hand.
//!
//! ```text
//! M11 = I1 + m1 c1² + I2 + m2 (l² + c2² + 2 l c2 cos b) + R1      M12 = I2 + m2 (c2² + l c2 cos b)
//! M22 = I2 + m2 c2² + R2                                          R: inertia ratio² of the rotors
//! ```
//!
//! Link i has the mass mi, the inertia Ii about its centre, and the distance ci of its centre from its joint. l is the length of the first
//! link, and b the angle of the elbow. The second rotor rotates with the elbow only: R2 is in M22 and in no other entry.

use super::{head, initial, output, rotor};
use crate::common::oracle::{TRAPEZOIDAL, Way, last, rows};
use crate::common::{by, run as run_method};
use mbs::Method;
use mbs_testkit::scene;

/// Mass [kg], distance of the centre from the joint [m] and inertia about the centre [kg m^2] of both links.
const LINKS: [[f64; 3]; 2] = [[3.0, 0.45, 0.08], [1.5, 0.3, 0.03]];
/// Length of the first link [m].
const LENGTH: f64 = 0.9;
/// Inertia [kg m^2] and ratio [-] of both rotors: 0.9 and 0.32 kg m^2 at the joints.
const ROTORS: [[f64; 2]; 2] = [[1e-4, 94.868_329_805_051_38], [2e-5, -126.491_106_406_735_17]];
/// Angles and rates at the start.
const START: [f64; 4] = [-0.4, 0.9, 1.2, -2.0];
const GRAVITY: f64 = 9.81;
/// End of the runs [s].
const END: f64 = 0.5;

/// Scene of the arm in the plane, or in space in an oblique plane: the arm along (2, -1, 2)/3, up (2, 2, -1)/3, the axis (-1, 2, 2)/3.
fn arm(dimension: usize, enabled: &str) -> String {
    let along = |[x, y, z]: [f64; 3], size: f64| {
        let size = size / 3.0;
        format!("[{:?}, {:?}, {:?}]", x * size, y * size, z * size)
    };
    let place = |x: f64| match dimension {
        2 => format!("[{x:?}, 0.0]"),
        _ => along([2.0, -1.0, 2.0], x),
    };
    let (gravity, axis) = match dimension {
        2 => (format!("[0.0, {:?}]", -GRAVITY), ""),
        _ => (along([2.0, 2.0, -1.0], -GRAVITY), "axis = [-1.0, 2.0, 2.0]\n"),
    };
    let tensor = |i: f64| {
        if dimension == 2 {
            format!("{i:?}")
        } else {
            format!("[{i:?}, {i:?}, {i:?}, 0.0, 0.0, 0.0]")
        }
    };
    let body = |name: &str, k: usize, from: f64| {
        let [mass, center, inertia] = LINKS[k];
        let (center, inertia) = (place(from + center), tensor(inertia));
        format!(
            "[[body]]\nname = \"{name}\"\nmass = {mass:?}\ncenter = {center}\ninertia = {inertia}\n"
        )
    };
    let joint = |name: &str, bodies: [&str; 2], at: f64| {
        let at = place(at);
        format!(
            "[[joint]]\nname = \"{name}\"\nkind = \"revolute\"\nbodies = {bodies:?}\nat = {at}\n{axis}"
        )
    };
    let rotors: String = ["shoulder", "elbow"]
        .iter()
        .zip(ROTORS)
        .map(|(joint, [inertia, ratio])| rotor(joint, inertia, ratio) + enabled)
        .collect();
    [
        head(dimension, &gravity),
        body("upper", 0, 0.0),
        body("lower", 1, LENGTH),
        joint("shoulder", ["ground", "upper"], 0.0),
        joint("elbow", ["upper", "lower"], LENGTH),
        rotors,
        initial("shoulder", START[0], START[2]),
        initial("elbow", START[1], START[3]),
        output("shoulder", "value"),
        output("elbow", "value"),
        output("shoulder", "rate"),
        output("elbow", "rate"),
    ]
    .concat()
}

/// Returns the rates and accelerations for given angles and rates.
fn motion([a, b, a1, b1]: [f64; 4], reflected: [f64; 2]) -> [f64; 4] {
    let [[m1, c1, i1], [m2, c2, i2]] = LINKS;
    let coupling = m2 * LENGTH * c2;
    let m11 = i1
        + m1 * c1 * c1
        + i2
        + m2 * (LENGTH * LENGTH + c2 * c2)
        + 2.0 * coupling * b.cos()
        + reflected[0];
    let m12 = i2 + m2 * c2 * c2 + coupling * b.cos();
    let m22 = i2 + m2 * c2 * c2 + reflected[1];
    let bend = coupling * b.sin();
    let second = m2 * GRAVITY * c2 * (a + b).cos();
    let first = (m1 * c1 + m2 * LENGTH) * GRAVITY * a.cos() + second;
    let (f1, f2) = (bend * (2.0 * a1 * b1 + b1 * b1) - first, -bend * a1 * a1 - second);
    let det = m11 * m22 - m12 * m12;
    [a1, b1, (m22 * f1 - m12 * f2) / det, (m11 * f2 - m12 * f1) / det]
}

/// State at the end by the classical Runge-Kutta method; 20,000 steps have an error of 1e-14.
fn right(reflected: [f64; 2]) -> [f64; 4] {
    let steps = 20_000;
    let h = END / f64::from(steps);
    let plus = |y: [f64; 4], h: f64, k: [f64; 4]| core::array::from_fn(|i| y[i] + h * k[i]);
    let mut y = START;
    for _ in 0..steps {
        let k1 = motion(y, reflected);
        let k2 = motion(plus(y, 0.5 * h, k1), reflected);
        let k3 = motion(plus(y, 0.5 * h, k2), reflected);
        let k4 = motion(plus(y, h, k3), reflected);
        y = core::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    y
}

fn reflected() -> [f64; 2] {
    ROTORS.map(|[inertia, ratio]| inertia * ratio * ratio)
}

fn largest(found: &[f64], right: &[f64]) -> f64 {
    found.iter().zip(right).fold(0.0, |worst, (x, y)| (x - y).abs().max(worst))
}

fn end(text: &str, way: Way, step: f64) -> Vec<f64> {
    let rows = rows(&scene(text), way, (step, END), 1);
    last(&rows.unwrap_or_else(|e| panic!("{way:?}: {e}"))).to_vec()
}

#[test]
fn the_arm_moves_as_its_equations_say() {
    let right = right(reflected());
    for dimension in [2, 3] {
        let text = arm(dimension, "");
        for integrator in ["rk4", "rk54", "rk853", "radau5"] {
            let method = Method {
                integrator: Some(integrator.to_owned()),
                tolerance: (integrator != "rk4").then_some(1e-12),
                step: Some(5e-4),
                duration: Some(END),
                ..by("recursive")
            };
            let outcome = run_method(&scene(&text), &method);
            assert!(outcome.error.is_none(), "{integrator}: {:?}", outcome.error);
            let off = largest(last(outcome.rows()), &right);
            println!("{dimension} {integrator}: {off:.1e}");
            assert!(off < 1e-9, "{dimension} {integrator}: {off:e}");
        }
        for formulation in TRAPEZOIDAL {
            let method = Method {
                error_tolerance: Some(3e-14),
                step: Some(1e-6),
                step_max: Some(1e-3),
                duration: Some(END),
                ..by(formulation)
            };
            let outcome = run_method(&scene(&text), &method);
            assert!(outcome.error.is_none(), "{formulation}: {:?}", outcome.error);
            let off = largest(last(outcome.rows()), &right);
            println!("{dimension} {formulation} controlled: {off:.1e}");
            // two steps of the rule are extrapolated, so the error is of order four
            let way = Way(formulation, "trapezoidal");
            let [coarse, fine] = [5e-4, 2.5e-4].map(|step| end(&text, way, step));
            let limit: Vec<f64> = fine
                .iter()
                .zip(&coarse)
                .map(|(fine, coarse)| fine + (fine - coarse) / 3.0)
                .collect();
            let extrapolated = largest(&limit, &right);
            println!("{dimension} {formulation} extrapolated: {extrapolated:.1e}");
            assert!(off < 1e-9 && extrapolated < 1e-9, "{formulation}: {off:e}, {extrapolated:e}");
        }
    }
}

#[test]
fn errors_fall_by_four_when_the_step_is_halved() {
    let right = right(reflected());
    for dimension in [2, 3] {
        let text = arm(dimension, "");
        for formulation in TRAPEZOIDAL {
            let way = Way(formulation, "trapezoidal");
            let [coarse, fine] = [1e-3, 5e-4].map(|step| largest(&end(&text, way, step), &right));
            let ratio = coarse / fine;
            println!("{dimension} {formulation}: {coarse:.2e}, {fine:.2e}, {ratio:.3}");
            assert!((3.6..4.4).contains(&ratio), "{formulation}: {ratio}");
        }
    }
}

#[test]
fn a_rotor_that_is_switched_off_leaves_nothing() {
    let off = arm(2, "enabled = false\n");
    let begin = off.find("[[effect]]").expect("there are rotors");
    let end_of = off.find("[[initial]]").expect("there are values");
    let absent = format!("{}{}", &off[..begin], &off[end_of..]);
    let right = right([0.0; 2]);
    for formulation in TRAPEZOIDAL {
        let way = Way(formulation, "trapezoidal");
        let [without, switched_off] = [&absent, &off].map(|text| end(text, way, 1e-3));
        assert_eq!(without, switched_off, "{formulation}");
        let off = largest(&without, &right);
        println!("{formulation}: {off:.1e}");
        assert!(off < 1e-3, "{formulation}: {off:e}");
    }
}

#[test]
fn the_energy_is_kept_and_has_the_rotors_in_it() {
    for dimension in [2, 3] {
        for formulation in TRAPEZOIDAL {
            let method = Method { step: Some(1e-3), duration: Some(2.0), ..by(formulation) };
            let outcome = run_method(&scene(&arm(dimension, "")), &method);
            let error = outcome.summary.energy.max_error;
            // the exchanged energy is 7 J
            println!("{dimension} {formulation}: {error:.1e} J");
            assert!(error < 1e-4, "{formulation}: {error:e}");
        }
    }
}

//! Spherical pendulums, chains, and points on bodies, against independent equations of motion.

use super::{check, distance, head, list, output, point, rk4, run, velocity};
use crate::common::oracle::{TRAPEZOIDAL, Way, agree_in_the_limit, rows};
use mbs_testkit::scene;

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Gravity of these scenes [m/s^2], along no axis.
const DOWN: [f64; 3] = [2.0, -6.0, -7.0];

#[test]
fn a_spherical_pendulum_of_a_point_follows_its_equation() {
    let (at, v) = ([0.3, 0.4, -0.5], [1.0, -0.5, 0.2]);
    let text = [
        head(3, &list(&DOWN)),
        point("ball", 0.4, &at),
        distance(["ground", "ball"], &[0.0; 3], &at),
        velocity("ball", &at, &v),
        output("ball", &at, "position"),
        output("ball", &at, "velocity"),
    ]
    .concat();
    // a point x with velocity v on the sphere has the acceleration x'' = g - x (g.x + v.v) / x.x
    let slope = |s: &[f64; 6]| {
        let (x, v) = (&s[..3], &s[3..]);
        let pull = (dot(&DOWN, x) + dot(v, v)) / dot(x, x);
        core::array::from_fn(|i| if i < 3 { v[i] } else { DOWN[i - 3] - pull * x[i - 3] })
    };
    let right = rk4(slope, [at[0], at[1], at[2], v[0], v[1], v[2]], (1.0, 20_000));
    check(&text, 1.0, (1e-3, 1e-3), (&right, 1e-9));
}

/// Masses of a chain [kg], from the ground down.
const MASSES: [f64; 3] = [0.5, 1.2, 0.3];
const PLACES: [[f64; 3]; 3] = [[0.3, 0.1, -0.2], [0.7, 0.0, -0.1], [0.9, 0.35, -0.3]];

fn chain() -> String {
    let names = ["a", "b", "c"];
    let mut text = head(3, &list(&DOWN));
    for (i, name) in names.iter().enumerate() {
        text += &point(name, MASSES[i], &PLACES[i]);
    }
    text += &distance(["ground", "a"], &[0.0; 3], &PLACES[0]);
    text += &distance(["b", "a"], &PLACES[1], &PLACES[0]);
    text += &distance(["b", "c"], &PLACES[1], &PLACES[2]);
    for (name, at) in names.iter().zip(&PLACES) {
        text += &output(name, at, "position");
    }
    text
}

/// Rates of the chain's positions and velocities. Three tensions, divided by the lengths, keep the distances constant.
fn chain_slope(s: &[f64; 18]) -> [f64; 18] {
    let link = |from: usize, i: usize| -> [f64; 3] {
        let own = |k: usize| s[from + 3 * i + k];
        core::array::from_fn(|k| own(k) - if i > 0 { s[from + 3 * (i - 1) + k] } else { 0.0 })
    };
    let r: [[f64; 3]; 3] = core::array::from_fn(|i| link(0, i));
    let w: [[f64; 3]; 3] = core::array::from_fn(|i| link(9, i));
    // t_i is the tension of link i over its length, r_i the vector along the link, and w_i its rate: a_i = g + (-t_i r_i + t_(i+1) r_(i+1)) /
    // m_i, r_i.(a_i - a_(i-1)) + w_i.w_i = 0
    let mut a = [[0.0; 4]; 3];
    for i in 0..3 {
        let before = if i > 0 { 1.0 / MASSES[i - 1] } else { 0.0 };
        a[i][i] = dot(&r[i], &r[i]) * (1.0 / MASSES[i] + before);
        if i > 0 {
            a[i][i - 1] = -dot(&r[i], &r[i - 1]) * before;
        }
        if i < 2 {
            a[i][i + 1] = -dot(&r[i], &r[i + 1]) / MASSES[i];
        }
        a[i][3] = dot(&w[i], &w[i]) + if i == 0 { dot(&r[0], &DOWN) } else { 0.0 };
    }
    for k in 0..2 {
        let factor = a[k + 1][k] / a[k][k];
        (0..4).for_each(|j| a[k + 1][j] -= factor * a[k][j]);
    }
    let mut t = [0.0; 4];
    for k in (0..3).rev() {
        t[k] = (a[k][3] - if k < 2 { a[k][k + 1] * t[k + 1] } else { 0.0 }) / a[k][k];
    }
    core::array::from_fn(|n| {
        if n < 9 {
            return s[9 + n];
        }
        let (i, k) = ((n - 9) / 3, (n - 9) % 3);
        let next = if i < 2 { t[i + 1] * r[i + 1][k] } else { 0.0 };
        DOWN[k] + (next - t[i] * r[i][k]) / MASSES[i]
    })
}

#[test]
fn a_chain_of_points_follows_its_equations() {
    let start: [f64; 18] = core::array::from_fn(|n| if n < 9 { PLACES[n / 3][n % 3] } else { 0.0 });
    let right = rk4(chain_slope, start, (0.5, 20_000));
    check(&chain(), 0.5, (1e-3, 1e-3), (&right[..9], 1e-9));
}

/// Scene of a body on a hinge about an oblique axis, or a planar pin, with a point on a ball joint. Another point hangs on the first by a
/// distance and a spring. With `welded`, the first point is a welded rigid body without inertia.
fn carrier(dimension: usize, welded: bool) -> String {
    let cut = |x: [f64; 3]| list(&x[..dimension]);
    let (ball, far) = ([0.8, -0.3, 0.2], [1.1, -0.5, -0.3]);
    let is_planar = dimension == 2;
    let (kind, axis, inertia, zero) = match is_planar {
        true => ("revolute", "", "0.2".to_owned(), "0.0".to_owned()),
        false => (
            "spherical",
            "axis = [0.3, 1.0, -0.4]\n",
            list(&[0.2, 0.25, 0.3, 0.01, 0.02, -0.01]),
            list(&[0.0; 6]),
        ),
    };
    let held = if welded {
        format!("center = {}\ninertia = {zero}", cut(ball))
    } else {
        format!("point = {}", cut(ball))
    };
    let kind = if welded { "weld" } else { kind };
    let far_at = &far[..dimension];
    [
        head(dimension, &cut(DOWN)),
        format!("[[body]]\nname = \"arm\"\nmass = 1.5\ncenter = {}\ninertia = {inertia}\n", cut([0.4, 0.1, 0.0])),
        format!("[[body]]\nname = \"ball\"\nmass = 0.6\n{held}\n"),
        point("far", 0.4, far_at),
        format!("[[joint]]\nname = \"hinge\"\nkind = \"revolute\"\nbodies = [\"ground\", \"arm\"]\nat = {}\n{axis}", cut([0.1, 0.0, 0.1])),
        format!("[[joint]]\nname = \"held\"\nkind = \"{kind}\"\nbodies = [\"ball\", \"arm\"]\nat = {}\n", cut(ball)),
        format!("[[joint]]\nname = \"link\"\nkind = \"distance\"\nbodies = [\"ball\", \"far\"]\npoints = [{}, {}]\n", cut(ball), cut(far)),
        format!("[[effect]]\nname = \"s\"\nkind = \"spring-damper\"\nbodies = [\"ground\", \"far\"]\npoints = [{}, {}]\nstiffness = 40.0\ndamping = 0.3\nfree_length = 0.5\n", cut([1.0, 0.3, 0.0]), cut(far)),
        "[[initial]]\njoint = \"hinge\"\nrate = 1.5\n".into(),
        "[[output]]\nname = \"hinge\"\njoint = \"hinge\"\nquantity = \"value\"\n".into(),
        output("ball", &ball[..dimension], "acceleration"),
        output("far", far_at, "position"),
        "[[output]]\nname = \"held\"\njoint = \"held\"\nquantity = \"reaction\"\n".into(),
        "[[output]]\nname = \"moment\"\nquantity = \"momentum\"\n".into(),
    ]
    .concat()
}

/// Rounding error of accelerations, and of forces of ten newtons, after a tenth of a second.
const SAME: f64 = 1e-8;

#[test]
fn a_point_on_a_ball_moves_as_a_weight_that_is_welded_there() {
    for dimension in [2, 3] {
        let [point, welded] = [false, true].map(|welded| scene(&carrier(dimension, welded)));
        for formulation in TRAPEZOIDAL {
            let way = Way(formulation, "trapezoidal");
            let [point, welded] =
                [&point, &welded].map(|s| rows(s, way, (1e-3, 0.1), 1).expect("it runs"));
            for ((t, a), (_, b)) in point.iter().zip(&welded) {
                for (k, (x, y)) in a.iter().zip(b).enumerate() {
                    // a weld can transmit moments too, which are zero here
                    assert!((x - y).abs() < SAME, "{formulation}, {t}, {k}: {x} {y}");
                }
            }
        }
    }
}

#[test]
fn natural_and_relative_coordinates_agree_to_nine_digits() {
    for dimension in [2, 3] {
        // accelerations and forces have the rounding of positions divided by the square of the step
        let text = carrier(dimension, false).replace("acceleration", "velocity").replace(
            "joint = \"held\"\nquantity = \"reaction\"",
            "joint = \"hinge\"\nquantity = \"rate\"",
        );
        let scene = scene(&text);
        for formulation in ["index-3", "classical"] {
            let way = Way(formulation, "trapezoidal");
            agree_in_the_limit(&scene, way, (5e-4, 0.2, 100), 1e-9, |_| {});
        }
    }
}

#[test]
fn coordinates_of_a_free_point_start_and_are_acted_on_by_number() {
    // a spring of 8 N/m and a force act on y; the other two coordinates move uniformly
    for dimension in [2, 3] {
        let at = &[0.2, -0.1, 0.4][..dimension];
        let (value, rate) = (&[0.1, 0.3, -0.2][..dimension], &[0.5, -1.0, 0.25][..dimension]);
        let text = [
            head(dimension, &list(&vec![0.0; dimension])),
            point("ball", 2.0, at),
            "[[joint]]\nname = \"way\"\nkind = \"free\"\nbodies = [\"ground\", \"ball\"]\n".into(),
            format!("[[initial]]\njoint = \"way\"\nvalue = {}\nrate = {}\n", list(value), list(rate)),
            "[[effect]]\nname = \"s\"\nkind = \"torsion-spring\"\njoint = \"way\"\ncoordinate = \"y\"\nstiffness = 8.0\n".into(),
        ]
        .concat();
        let duration: f64 = 0.5;
        let (sine, cosine) = (2.0 * duration).sin_cos();
        let mut right: Vec<f64> = value.iter().zip(rate).map(|(x, v)| x + duration * v).collect();
        right[1] = 0.3 * cosine - 0.5 * sine;
        check(&text, duration, (2e-3, 1e-4), (&right, 1e-10));
        let first = run(&text, Way("index-3", "trapezoidal"), 1e-3, 1e-3);
        assert_eq!(first[0].1.len(), dimension, "coordinates of the default output");
    }
}

#[test]
fn a_free_joint_to_a_point_of_a_body_measures_it_and_drives_it() {
    // a dumbbell, which is a body with a point on a ball joint; a free joint measures the point from the ground, and a spring holds it
    for dimension in [2, 3] {
        let cut = |x: [f64; 3]| list(&x[..dimension]);
        let at = [0.8, -0.3, 0.2];
        let (kind, inertia) = match dimension {
            2 => ("revolute", "0.2".to_owned()),
            _ => ("spherical", list(&[0.2, 0.25, 0.3, 0.01, 0.02, -0.01])),
        };
        let text = [
            head(dimension, &cut([0.0; 3])),
            format!("[[body]]\nname = \"arm\"\nmass = 1.5\ncenter = {}\ninertia = {inertia}\n", cut([0.4, 0.1, 0.0])),
            point("ball", 0.6, &at[..dimension]),
            format!("[[joint]]\nname = \"held\"\nkind = \"{kind}\"\nbodies = [\"ball\", \"arm\"]\nat = {}\n", cut(at)),
            "[[joint]]\nname = \"way\"\nkind = \"free\"\nbodies = [\"ground\", \"ball\"]\n".into(),
            format!("[[initial]]\njoint = \"way\"\nvalue = {}\nrate = {}\n", cut([4.0, 5.0, -4.0]), cut([1.0, -2.0, 0.5])),
            "[[effect]]\nname = \"s\"\nkind = \"torsion-spring\"\njoint = \"way\"\ncoordinate = \"y\"\nstiffness = 8.0\n".into(),
            "[[output]]\nname = \"way\"\njoint = \"way\"\nquantity = \"value\"\n".into(),
            output("arm", &[0.4, 0.1, 0.0][..dimension], "position"),
        ]
        .concat();
        let scene = scene(&text);
        for formulation in ["index-3", "classical"] {
            let way = Way(formulation, "trapezoidal");
            agree_in_the_limit(&scene, way, (1e-3, 0.2, 50), 1e-8, |_| {});
            let first = &run(&text, way, 1e-3, 1e-3)[0].1;
            assert!((first[0] - 4.0).abs() < 1e-9 && (first[1] - 5.0).abs() < 1e-9, "{first:?}");
        }
    }
}

#[test]
fn points_on_the_line_of_a_rod_leave_it_two_points_that_move_as_in_the_tree() {
    // a rod on a ball joint of the ground, a point at its end, and a second rod on a ball joint at the point; the point is the first body
    let (end, tip) = ([0.6, 0.3, 0.1], [1.0, 0.1, -0.2]);
    let rod = |name: &str, mass: f64, from: &[f64], to: &[f64]| {
        let (from, to) = (list(from), list(to));
        format!(
            "[[body]]\nname = \"{name}\"\nmass = {mass:?}\nrod = {{ from = {from}, to = {to} }}\n"
        )
    };
    let ball = |bodies: [&str; 2], at: &[f64]| {
        let [a, b] = bodies;
        format!(
            "[[joint]]\nname = \"{a}-{b}\"\nkind = \"spherical\"\nbodies = {bodies:?}\nat = {}\n",
            list(at)
        )
    };
    let text = [
        head(3, &list(&DOWN)),
        point("p", 0.7, &end),
        rod("upper", 1.0, &[0.0; 3], &end),
        rod("lower", 0.8, &end, &tip),
        ball(["p", "lower"], &end),
        ball(["ground", "upper"], &[0.0; 3]),
        ball(["upper", "p"], &end),
        velocity("p", &end, &[-0.3, 0.5, 0.3]),
        output("p", &end, "position"),
        output("lower", &tip, "position"),
        "[[output]]\nname = \"l\"\nquantity = \"angular-momentum\"\n".into(),
    ]
    .concat();
    let scene = scene(&text);
    let model = mbs::core::natural::NaturalModel::<f64, 3>::new(&scene).expect("a model");
    assert_eq!(mbs::core::blocks::Cliques::n_unknowns(&model), 6, "the ends of both rods");
    for formulation in ["index-3", "classical", "state-space"] {
        let way = Way(formulation, "trapezoidal");
        agree_in_the_limit(&scene, way, (1e-3, 0.2, 50), 1e-8, |_| {});
    }
}

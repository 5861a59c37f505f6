//! Relations against equivalent elements of the library: sums, ropes, cams and links.

use super::{Sum, line, of_joints, run, scene};
use crate::common::oracle::{WAYS, Way, last};
use mbs::core::scene::Scene;
use mbs::{BodyId, Coupling, CouplingMeasure, CouplingTerm, Curve, JointId, Number, Relation};

/// Scene of two eccentric wheels and a third one on a carrier, in the plane or about an oblique axis in space.
fn wheels(dimension: usize) -> String {
    let mut text = format!(
        "[scene]\nname = \"w\"\ndimension = {dimension}\nduration = 1.0\ngravity = {}\n",
        if dimension == 2 { "[3.0, -9.0]" } else { "[3.0, -7.2, -5.4]" }
    );
    let vector = |x: f64, y: f64| {
        if dimension == 2 {
            format!("[{x:?}, {y:?}]")
        } else {
            format!("[{x:?}, {:?}, {:?}]", 0.8 * y, 0.6 * y)
        }
    };
    let axis = if dimension == 2 { "" } else { "axis = [0.0, -0.6, 0.8]\n" };
    for (name, on, at, center) in [
        ("a", "ground", [0.0, 0.0], [0.1, 0.05]),
        ("b", "ground", [1.0, 0.2], [1.06, 0.2]),
        ("c", "a", [0.3, 0.0], [0.3, 0.08]),
    ] {
        let inertia = if dimension == 2 { "0.02" } else { "[0.02, 0.03, 0.025, 0.001, 0.0, 0.0]" };
        text += &format!(
            "[[body]]\nname = \"{name}\"\nmass = 1.2\ncenter = {}\ninertia = {inertia}\n",
            vector(center[0], center[1])
        );
        text += &format!(
            "[[joint]]\nname = \"{name}\"\nkind = \"revolute\"\nbodies = [\"{on}\", \"{name}\"]\nat = {}\n{axis}",
            vector(at[0], at[1])
        );
        for quantity in ["value", "rate"] {
            text += &format!(
                "[[output]]\nname = \"{name}-{quantity}\"\njoint = \"{name}\"\nquantity = \"{quantity}\"\n"
            );
        }
    }
    text + "[[initial]]\njoint = \"a\"\nvalue = 0.0\nrate = 7.0\n"
}

/// Both scenes move alike, with the same efforts. `allowed` is the largest difference for each method.
fn are_alike([own, library]: [&Scene<f64>; 2], duration: f64, allowed: impl Fn(Way) -> f64) {
    for way in WAYS {
        let [a, b] = [own, library].map(|scene| run(scene, way, 1e-3, duration, 1));
        for ((t, a), (_, b)) in a.iter().zip(&b) {
            for (k, (x, y)) in a.iter().zip(b).enumerate() {
                let error = (x - y).abs() / (1.0 + y.abs());
                assert!(error < allowed(way), "{way:?}, {t}, {k}: {x} {y}");
            }
        }
    }
}

#[test]
fn a_relation_that_is_a_sum_is_the_linear_coupling() {
    let joints = [0, 1, 2].map(JointId::new);
    let factors = [13.0, 17.0, -4.0];
    for dimension in [2, 3] {
        let own = of_joints(&[0, 1, 2], Sum(factors.to_vec()));
        let library = Coupling::linear(joints.into_iter().zip(factors));
        let scenes = [own, library].map(|of| scene(&wheels(dimension), [of]));
        // the limit covers rounding and the tolerance of the iterations over 500 steps
        are_alike([&scenes[0], &scenes[1]], 0.5, |_| 1e-9);
    }
}

/// Relation f(x) + l + x y / 2, where f is a polynomial.
#[derive(Debug)]
struct Mixed {
    product: f64,
}

impl Relation for Mixed {
    fn evaluate(&self, at: &[f64], gradient: &mut [f64]) -> f64 {
        let [x, y, l] = [at[0], at[1], at[2]];
        gradient[0] = 0.1 - 0.04 * x + self.product * y;
        gradient[1] = 0.2 + self.product * x;
        gradient[2] = 1.0;
        0.1 * x - 0.02 * x * x + 0.2 * y + l + self.product * x * y
    }

    fn curvature(&self, _: &[f64], rates: &[f64]) -> f64 {
        -0.04 * rates[0] * rates[0] + 2.0 * self.product * rates[0] * rates[1]
    }
}

fn points(dimension: usize) -> Vec<(BodyId, [f64; 3])> {
    let at = |x: f64, y: f64| if dimension == 2 { [x, y, 0.0] } else { [x, 0.8 * y, 0.6 * y] };
    vec![
        (BodyId::new(2), at(0.3, 0.1)),
        (BodyId::Ground, at(0.5, 0.8)),
        (BodyId::new(1), at(1.2, 0.3)),
    ]
}

#[test]
fn a_relation_of_angles_and_a_length_is_the_coupling_of_curves_and_a_line() {
    for dimension in [2, 3] {
        let line = || line(&points(dimension));
        let [x, y] = [0, 1].map(|joint| CouplingMeasure::from(JointId::new(joint)));
        let own = Coupling::relation([x, y, line()], Mixed { product: 0.0 });
        let curve = Curve::Polynomial(
            ["0.0", "0.1", "-0.02"].map(|c| Number::from_decimal(c).expect("a number")).to_vec(),
        );
        let of = JointId::new;
        let library = Coupling::of(vec![
            CouplingTerm { curve: Some(curve), ..CouplingTerm::of_joint(of(0), 0, 1.0) },
            CouplingTerm::of_joint(of(1), 0, 0.2),
            CouplingTerm { factor: 1.into(), of: line(), curve: None },
        ]);
        let scenes = [own, library].map(|of| scene(&wheels(dimension), [of]));
        // the limits cover rounding and the tolerance of the iterations over 300 steps; in state space, rounding also decides when the basis
        // changes
        let allowed = |way: Way| if way.0 == "state-space" { 1e-6 } else { 1e-8 };
        are_alike([&scenes[0], &scenes[1]], 0.3, allowed);
    }
}

#[test]
fn formulations_agree_on_a_relation_of_angles_and_a_length_that_mixes_them() {
    for dimension in [2, 3] {
        // the limit of 1e-6 covers the effect of the iterations' tolerance on rates of 20 rad/s in 800 steps
        let measures = [0, 1].map(|joint| CouplingMeasure::from(JointId::new(joint)));
        let measures = measures.into_iter().chain([line(&points(dimension))]);
        let scene =
            scene(&wheels(dimension), [Coupling::relation(measures, Mixed { product: 0.1 })]);
        for way in WAYS.into_iter().filter(|way| way.1 == "trapezoidal") {
            crate::common::oracle::agree_in_the_limit(
                &scene,
                way,
                (2.5e-4, 0.2, 200),
                1e-6,
                |_| (),
            );
        }
    }
}

#[test]
fn a_ratio_of_a_relation_holds_over_many_hundred_turns() {
    let text =
        wheels(2).replace("gravity = [3.0, -9.0]\n", "").replace("rate = 7.0", "rate = 100.0");
    let own = of_joints(&[0, 1], Sum(vec![13.0, 17.0]));
    let scene = scene(&text, [own]);
    for way in WAYS {
        let rows = run(&scene, way, 5e-4, 20.0, 100);
        let end = last(&rows);
        assert!(end[0] > 250.0 * core::f64::consts::TAU, "{way:?}: {end:?}");
        // the limit is the rounding of angles of 2,000 rad
        let left = 13.0 * end[0] + 17.0 * end[2];
        assert!(left.abs() < 1e-10, "{way:?}: {left:e}");
    }
}

/// Squared distance |p - s|^2 of a crank pin at radius r from (0, 0) and a slider at (d + s) along its slide.
#[derive(Debug)]
struct Crank {
    radius: f64,
    distance: f64,
}

impl Relation for Crank {
    fn evaluate(&self, at: &[f64], gradient: &mut [f64]) -> f64 {
        let (r, d) = (self.radius, self.distance + at[1]);
        gradient[0] = 2.0 * r * d * at[0].sin();
        gradient[1] = 2.0 * d - 2.0 * r * at[0].cos();
        r * r + d * d - 2.0 * r * d * at[0].cos()
    }

    fn curvature(&self, at: &[f64], rates: &[f64]) -> f64 {
        let (r, d) = (self.radius, self.distance + at[1]);
        let [turn, slide] = [rates[0], rates[1]];
        2.0 * (r * d * at[0].cos() * turn * turn + slide * slide)
            + 4.0 * r * at[0].sin() * turn * slide
    }
}

/// Scene of a crank in the x-y plane and a slider along x, with or without a link of length 0.5 m between them.
fn crank(dimension: usize, link: bool) -> String {
    let vector = |v: [f64; 3]| format!("{:?}", &v[..dimension]);
    let (inertia, axis) = if dimension == 2 {
        ("0.02", "")
    } else {
        ("[0.02, 0.02, 0.02, 0.0, 0.0, 0.0]", "axis = [0.0, 0.0, 1.0]\n")
    };
    let mut text = format!(
        "[scene]\nname = \"c\"\ndimension = {dimension}\nduration = 1.0\ngravity = {}\n",
        vector([2.0, -9.0, 1.0])
    );
    for (name, center) in [("crank", [0.1, 0.0, 0.0]), ("slider", [0.7, 0.0, 0.0])] {
        text += &format!(
            "[[body]]\nname = \"{name}\"\nmass = 1.2\ncenter = {}\ninertia = {inertia}\n",
            vector(center)
        );
    }
    text += &format!(
        "[[joint]]\nname = \"turn\"\nkind = \"revolute\"\nbodies = [\"ground\", \"crank\"]\nat = {}\n{axis}",
        vector([0.0; 3])
    );
    text += &format!(
        "[[joint]]\nname = \"slide\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"slider\"]\nat = {}\naxis = {}\n",
        vector([0.7, 0.0, 0.0]),
        vector([1.0, 0.0, 0.0])
    );
    if link {
        text += &format!(
            "[[joint]]\nname = \"rod\"\nkind = \"distance\"\nbodies = [\"crank\", \"slider\"]\npoints = [{}, {}]\n",
            vector([0.2, 0.0, 0.0]),
            vector([0.7, 0.0, 0.0])
        );
    }
    for joint in ["turn", "slide"] {
        for quantity in ["value", "rate"] {
            text += &format!(
                "[[output]]\nname = \"{joint}-{quantity}\"\njoint = \"{joint}\"\nquantity = \"{quantity}\"\n"
            );
        }
    }
    text + "[[initial]]\njoint = \"turn\"\nvalue = 0.0\nrate = 15.0\n"
}

#[test]
fn a_relation_of_crank_and_slider_is_the_rod_between_them() {
    for dimension in [2, 3] {
        let own = of_joints(&[0, 1], Crank { radius: 0.2, distance: 0.7 }).holding(0.25);
        let own = scene(&crank(dimension, false), [own]);
        let rod = mbs_testkit::scene(&crank(dimension, true));
        for way in WAYS {
            let duration = 1.0;
            let end = |scene: &Scene<f64>, step: f64| {
                last(&run(scene, way, step, duration, 1))[..4].to_vec()
            };
            let right = end(&rod, 2.5e-4);
            assert!(right[0] > 8.0, "it turns round: {right:?}");
            let errors = [1e-3, 5e-4].map(|step| {
                let found = end(&own, step);
                // the error of the scene with the rod is that of a quarter of the step
                found.iter().zip(&right).fold(0.0, |most: f64, (x, y)| most.max((x - y).abs()))
            });
            if way.1 == "rk853" {
                assert!(errors[1] < 1e-10, "{way:?}: {errors:?}");
            } else {
                let ratio = errors[0] / errors[1];
                assert!(errors[1] < 1e-2 && (3.0..7.0).contains(&ratio), "{way:?}: {errors:?}");
            }
        }
    }
}

//! User-defined relations of several measures, against independent equations of motion, in every formulation.

mod closed_forms;
mod linkages;
mod refusals;
mod states;

use crate::common::oracle::{Rows, Way, rows};
use mbs::core::scene::{Quantity, Scene};
use mbs::scene_file::SceneFile;
use mbs::{Coupling, CouplingId, CouplingMeasure, JointId, Number, Output, Relation};

/// Product (1 + x)(1 + y), times 1 + z if there is a third number.
#[derive(Debug)]
struct Product;

impl Relation for Product {
    fn evaluate(&self, at: &[f64], gradient: &mut [f64]) -> f64 {
        for (k, slope) in gradient.iter_mut().enumerate() {
            let others = at.iter().enumerate().filter(|(i, _)| *i != k);
            *slope = others.map(|(_, x)| 1.0 + x).product();
        }
        at.iter().map(|x| 1.0 + x).product()
    }

    fn curvature(&self, at: &[f64], rates: &[f64]) -> f64 {
        let n = at.len();
        let pairs = (0..n).flat_map(|i| (0..i).map(move |j| (i, j)));
        let along = |(i, j): (usize, usize)| {
            let others = at.iter().enumerate().filter(|(k, _)| *k != i && *k != j);
            2.0 * rates[i] * rates[j] * others.map(|(_, x)| 1.0 + x).product::<f64>()
        };
        pairs.map(along).sum()
    }
}

/// Ellipse (x/a + 1)^2 + (y/b)^2, for a bead that is at a vertex in the reference configuration.
#[derive(Debug)]
struct Ellipse([f64; 2]);

impl Relation for Ellipse {
    fn evaluate(&self, at: &[f64], gradient: &mut [f64]) -> f64 {
        let Self([a, b]) = *self;
        let [x, y] = [at[0] / a + 1.0, at[1] / b];
        (gradient[0], gradient[1]) = (2.0 * x / a, 2.0 * y / b);
        x * x + y * y
    }

    fn curvature(&self, _: &[f64], rates: &[f64]) -> f64 {
        let [u, v] = [rates[0] / self.0[0], rates[1] / self.0[1]];
        2.0 * (u * u + v * v)
    }
}

/// Sum of numbers, each with a factor.
#[derive(Debug)]
struct Sum(Vec<f64>);

impl Relation for Sum {
    fn evaluate(&self, at: &[f64], gradient: &mut [f64]) -> f64 {
        gradient.copy_from_slice(&self.0);
        at.iter().zip(&self.0).map(|(x, factor)| factor * x).sum()
    }

    fn curvature(&self, _: &[f64], _: &[f64]) -> f64 {
        0.0
    }
}

/// Scene with a further coupling `held`, whose outputs `effort` and `value` follow those of the text.
fn scene(text: &str, couplings: impl IntoIterator<Item = Coupling>) -> Scene<f64> {
    with(text, couplings).resolve().unwrap_or_else(|e| panic!("{e}"))
}

fn with(text: &str, couplings: impl IntoIterator<Item = Coupling>) -> Scene<Number> {
    let file = SceneFile::parse(text, "relation").unwrap_or_else(|e| panic!("{e}"));
    let mut scene = file.numbers().unwrap_or_else(|e| panic!("{e}\n{text}"));
    for coupling in couplings {
        let coupling = if coupling.name.is_empty() { coupling.named("held") } else { coupling };
        scene.couplings.push(coupling);
    }
    let coupling = CouplingId::new(0);
    let of = [
        ("effort", Quantity::Effort { coupling }),
        ("value", Quantity::CouplingValue { coupling }),
    ];
    scene.outputs.extend(of.map(|(name, quantity)| Output::new(quantity).named(name)));
    scene
}

/// Relation of the first coordinates of joints, which are given by number.
fn of_joints(joints: &[usize], relation: impl Relation + 'static) -> Coupling {
    Coupling::relation(joints.iter().map(|&joint| JointId::new(joint)), relation)
}

/// Scene of bodies on slides (name, mass, base, direction), each through the origin, in two or three dimensions. The base is a body by name.
fn slides(dimension: usize, gravity: [f64; 3], bodies: &[(&str, f64, &str, [f64; 3])]) -> String {
    let vector = |v: [f64; 3]| format!("{:?}", &v[..dimension]);
    let inertia = if dimension == 2 { "0.1" } else { "[0.1, 0.1, 0.1, 0.0, 0.0, 0.0]" };
    let mut text = format!(
        "[scene]\nname = \"r\"\ndimension = {dimension}\nduration = 1.0\ngravity = {}\n",
        vector(gravity)
    );
    for (name, mass, on, axis) in bodies {
        let (origin, axis) = (vector([0.0; 3]), vector(*axis));
        text += &format!(
            "[[body]]\nname = \"{name}\"\nmass = {mass:?}\ncenter = {origin}\ninertia = {inertia}\n"
        );
        text += &format!(
            "[[joint]]\nname = \"{name}-s\"\nkind = \"prismatic\"\nbodies = [\"{on}\", \"{name}\"]\nat = {origin}\naxis = {axis}\n"
        );
        for quantity in ["value", "rate"] {
            text += &format!(
                "[[output]]\nname = \"{name}-{quantity}\"\njoint = \"{name}-s\"\nquantity = \"{quantity}\"\n"
            );
        }
    }
    text
}

fn initial(joint: &str, keys: &str) -> String {
    format!("[[initial]]\njoint = \"{joint}\"\n{keys}\n")
}

/// Rows of a run that must not stop.
fn run(scene: &Scene<f64>, way: Way, step: f64, duration: f64, every: usize) -> Rows {
    rows(scene, way, (step, duration), every).unwrap_or_else(|e| panic!("{way:?}: {e}"))
}

/// Integrates x'' = f(x, x') from (x, x') over a time by the classical Runge-Kutta method. With these steps the error is below 1e-11.
fn solve(mut x: [f64; 2], time: f64, f: impl Fn([f64; 2]) -> f64) -> [f64; 2] {
    let n = (time * 2e4).ceil();
    let h = time / n;
    for _ in 0..n as usize {
        let slope = |x: [f64; 2]| [x[1], f(x)];
        let beside = |k: [f64; 2], h: f64| [x[0] + h * k[0], x[1] + h * k[1]];
        let k1 = slope(x);
        let k2 = slope(beside(k1, 0.5 * h));
        let k3 = slope(beside(k2, 0.5 * h));
        let k4 = slope(beside(k3, h));
        x = [0, 1].map(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
    x
}

/// Measure of a length over points.
fn line(points: &[(mbs::BodyId, [f64; 3])]) -> CouplingMeasure<Number> {
    CouplingMeasure::line(points.iter().copied())
}

//! Scenes that contain every joint, guide and effect, random configurations, and dense views of a model.

#![allow(dead_code, unreachable_pub, reason = "each test binary uses its part")]

use mbs_core::model::{Load, Model, Tangent, Terms};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::Scene;
use mbs_scene::Document;

/// Every planar joint kind, guide law and effect, a welded pair and bodies fixed to the ground.
pub const PLANAR: &str = r#"
[scene]
name = "planar zoo"
dimension = 2
gravity = [0.3, -9.81]
duration = 1.0
[[body]]
name = "crank"
rod = { from = [0.0, 0.0], to = [1.0, 0.2] }
mass = 1.3
[[body]]
name = "coupler"
mass = 2.0
center = [1.6, 0.5]
inertia = 0.11
[[body]]
name = "tool"
mass = 0.7
center = [2.0, 0.9]
inertia = 0.05
[[body]]
name = "slider"
mass = 0.9
center = [2.3, -0.4]
inertia = 0.02
[[body]]
name = "carriage"
mass = 1.1
center = [2.6, -0.9]
inertia = 0.04
[[body]]
name = "free"
mass = 0.6
center = [3.5, 1.5]
inertia = 0.03
[[body]]
name = "post"
mass = 5.0
center = [0.0, -1.0]
inertia = 1.0
[[body]]
name = "pendulum"
mass = 0.8
center = [-0.4, -1.3]
inertia = 0.02
[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["ground", "crank"]
at = [0.0, 0.0]
[[joint]]
name = "pin"
kind = "revolute"
bodies = ["crank", "coupler"]
at = [1.0, 0.2]
[[joint]]
name = "weld"
kind = "weld"
bodies = ["coupler", "tool"]
at = [1.8, 0.6]
[[joint]]
name = "ankle"
kind = "revolute"
bodies = ["tool", "slider"]
at = [2.2, 0.3]
[[joint]]
name = "slot"
kind = "prismatic"
bodies = ["slider", "carriage"]
at = [2.4, -0.6]
axis = [2.0, 1.0]
[[joint]]
name = "rail"
kind = "prismatic"
bodies = ["ground", "carriage"]
at = [2.7, -1.0]
axis = [1.0, -0.3]
[[joint]]
name = "floating"
kind = "free"
bodies = ["coupler", "free"]
at = [3.5, 1.5]
[[joint]]
name = "link"
kind = "distance"
bodies = ["coupler", "free"]
points = [[1.9, 0.8], [3.2, 1.4]]
[[joint]]
name = "post-weld"
kind = "weld"
bodies = ["ground", "post"]
at = [0.0, -1.0]
[[joint]]
name = "hook"
kind = "revolute"
bodies = ["post", "pendulum"]
at = [-0.2, -0.9]
[[guide]]
joint = "hook"
table = [[0.0, 0.0], [0.4, 0.3], [1.0, 0.5], [1.7, -0.2]]
[[guide]]
joint = "rail"
sine = { amplitude = 0.2, frequency = 0.7, phase = 0.0 }
[[effect]]
name = "strut"
kind = "spring-damper"
bodies = ["ground", "tool"]
points = [[2.0, 2.5], [2.1, 1.0]]
stiffness = 120.0
damping = 7.0
free_length = 0.9
[[effect]]
name = "push"
kind = "spring-damper"
bodies = ["free", "slider"]
points = [[3.4, 1.2], [2.3, -0.3]]
stiffness = 40.0
damping = 3.0
free_length = 4.0
[[effect]]
name = "coil"
kind = "torsion-spring"
joint = "pin"
stiffness = 30.0
damping = 2.0
free_value = 0.0
[[effect]]
name = "thrust"
kind = "force"
body = "tool"
at = [2.1, 1.1]
value = [3.0, -5.0]
[[effect]]
name = "gust"
kind = "force"
body = "free"
at = [3.6, 1.7]
table = [[0.0, [1.0, 2.0]], [1.0, [-2.0, 4.0]]]
[[effect]]
name = "jet"
kind = "force"
body = "free"
at = [3.3, 1.6]
value = [2.0, 1.5]
frame = "body"
[[effect]]
name = "motor"
kind = "torque"
body = "coupler"
value = 2.5
[[effect]]
name = "servo"
kind = "torque"
joint = "ankle"
table = [[0.0, 1.0], [1.0, -2.0]]
"#;

/// Every spatial joint kind, guide law and effect, a welded pair, a rod held by balls and a body fixed to the ground.
pub const SPATIAL: &str = r#"
[scene]
name = "spatial zoo"
dimension = 3
gravity = [0.3, 0.2, -9.81]
duration = 1.0
[[body]]
name = "a"
mass = 1.3
center = [0.5, 0.1, 0.2]
inertia = [0.05, 0.06, 0.07, 0.005, -0.004, 0.003]
[[body]]
name = "b"
mass = 2.0
center = [1.4, 0.4, 0.1]
inertia = [0.11, 0.12, 0.08, -0.01, 0.006, 0.004]
[[body]]
name = "c"
mass = 0.7
center = [1.2, -0.5, 0.4]
inertia = [0.03, 0.02, 0.04, 0.001, 0.002, -0.003]
[[body]]
name = "d"
mass = 0.9
center = [1.6, -1.0, 0.8]
inertia = [0.02, 0.03, 0.025, 0.001, 0.001, 0.002]
[[body]]
name = "e"
mass = 1.1
center = [2.1, -1.3, 1.1]
inertia = [0.04, 0.035, 0.03, 0.002, -0.002, 0.001]
[[body]]
name = "f"
mass = 0.6
center = [2.6, -1.5, 0.9]
inertia = [0.02, 0.02, 0.02, 0.001, 0.0, 0.0]
[[body]]
name = "g"
mass = 0.5
center = [2.9, -1.2, 0.7]
inertia = [0.02, 0.025, 0.015, 0.001, 0.002, 0.001]
[[body]]
name = "h"
mass = 0.8
center = [2.0, 1.5, 0.5]
inertia = [0.03, 0.02, 0.025, 0.002, 0.001, -0.001]
[[body]]
name = "stick"
rod = { from = [1.8, 0.6, 0.2], to = [2.2, 1.3, 0.6] }
mass = 0.4
[[body]]
name = "post"
mass = 5.0
center = [-1.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]
[[body]]
name = "bob"
mass = 0.9
center = [-1.2, 0.5, -0.3]
inertia = [0.02, 0.03, 0.025, 0.001, 0.001, 0.002]
[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["ground", "a"]
at = [0.0, 0.0, 0.0]
axis = [0.2, 1.0, 0.3]
[[joint]]
name = "ball"
kind = "spherical"
bodies = ["a", "b"]
at = [1.0, 0.2, 0.3]
[[joint]]
name = "cross"
kind = "universal"
bodies = ["a", "c"]
at = [0.8, -0.2, 0.3]
axes = [[1.0, 0.3, 0.0], [0.1, 1.0, 0.5]]
[[joint]]
name = "slide"
kind = "prismatic"
bodies = ["c", "d"]
at = [1.4, -0.8, 0.6]
axis = [1.0, -1.0, 0.7]
[[joint]]
name = "sleeve"
kind = "cylindrical"
bodies = ["d", "e"]
at = [1.9, -1.1, 1.0]
axis = [0.3, 0.4, 1.0]
[[joint]]
name = "table"
kind = "planar"
bodies = ["e", "f"]
at = [2.4, -1.4, 1.0]
axis = [1.0, 0.2, 0.6]
direction = [0.0, 1.0, 0.1]
[[joint]]
name = "weld"
kind = "weld"
bodies = ["f", "g"]
at = [2.7, -1.4, 0.8]
[[joint]]
name = "floating"
kind = "free"
bodies = ["b", "h"]
[[joint]]
name = "link"
kind = "distance"
bodies = ["a", "h"]
points = [[0.6, 0.4, 0.5], [1.9, 1.4, 0.7]]
[[joint]]
name = "hinged-link"
kind = "distance"
bodies = ["e", "h"]
points = [[2.0, -1.1, 1.2], [2.1, 1.6, 0.4]]
axis = [1.0, 0.1, 0.2]
[[joint]]
name = "near-ball"
kind = "spherical"
bodies = ["b", "stick"]
at = [1.8, 0.6, 0.2]
[[joint]]
name = "far-ball"
kind = "spherical"
bodies = ["stick", "h"]
at = [2.2, 1.3, 0.6]
[[joint]]
name = "post-weld"
kind = "weld"
bodies = ["ground", "post"]
at = [-1.0, 0.0, 0.0]
[[joint]]
name = "hook"
kind = "revolute"
bodies = ["post", "bob"]
at = [-1.1, 0.2, 0.1]
axis = [1.0, 0.4, -0.2]
[[guide]]
joint = "hook"
sine = { amplitude = 0.4, frequency = 0.6, phase = 0.0 }
[[guide]]
joint = "slide"
table = [[0.0, 0.0], [0.4, 0.1], [1.0, 0.2], [1.7, -0.1]]
[[guide]]
joint = "pivot"
ramp = { rate = 0.8 }
[[effect]]
name = "strut"
kind = "spring-damper"
bodies = ["ground", "b"]
points = [[1.5, 0.3, 2.0], [1.5, 0.5, 0.4]]
stiffness = 120.0
damping = 7.0
free_length = 0.9
[[effect]]
name = "push"
kind = "spring-damper"
bodies = ["g", "h"]
points = [[2.8, -1.1, 0.7], [2.0, 1.3, 0.3]]
stiffness = 40.0
damping = 3.0
free_length = 6.0
[[effect]]
name = "coil"
kind = "torsion-spring"
joint = "sleeve"
stiffness = 30.0
damping = 2.0
free_value = 0.0
[[effect]]
name = "thrust"
kind = "force"
body = "g"
at = [2.9, -1.3, 0.6]
value = [3.0, -5.0, 1.0]
[[effect]]
name = "gust"
kind = "force"
body = "h"
at = [2.1, 1.7, 0.4]
table = [[0.0, [1.0, 2.0, -1.0]], [1.0, [-2.0, 4.0, 0.0]]]
[[effect]]
name = "jet"
kind = "force"
body = "e"
at = [2.2, -1.2, 1.0]
value = [2.0, 1.5, 0.4]
frame = "body"
[[effect]]
name = "motor"
kind = "torque"
body = "b"
value = [2.5, -1.0, 0.7]
[[effect]]
name = "servo"
kind = "torque"
joint = "table"
table = [[0.0, 1.0], [1.0, -2.0]]
[[effect]]
name = "stick-load"
kind = "force"
body = "stick"
at = [2.0, 0.95, 0.4]
value = [0.5, 0.2, -1.0]
"#;

/// The scene of a text.
pub fn scene(text: &str) -> Scene<f64> {
    let document = Document::parse(text, "test.toml").unwrap_or_else(|e| panic!("{e}"));
    document.scene::<f64>().unwrap_or_else(|e| panic!("{e}"))
}

/// The model of a scene.
pub fn model<const D: usize>(scene: &Scene<f64>) -> NaturalModel<f64, D> {
    NaturalModel::new(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name))
}

/// A small generator of the same numbers on every machine (xorshift64*).
pub struct Random(pub u64);

impl Random {
    /// The next number in [-1, 1].
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// `size` times random numbers at the first `n` of `length` places, zero at the others.
    pub fn vector(&mut self, n: usize, length: usize, size: f64) -> Vec<f64> {
        (0..length).map(|i| if i < n { size * self.next() } else { 0.0 }).collect()
    }
}

/// x + s y.
pub fn plus(x: &[f64], s: f64, y: &[f64]) -> Vec<f64> {
    x.iter().zip(y).map(|(x, y)| x + s * y).collect()
}

/// x . y.
pub fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// The reference configuration.
pub fn reference(model: &impl Model<f64>) -> Vec<f64> {
    let mut q = vec![0.0; model.n_extended()];
    model.write_reference(&mut q);
    q
}

/// J x.
pub fn rates(model: &impl Model<f64>, terms: &Terms<f64>, x: &[f64]) -> Vec<f64> {
    let mut rates = vec![0.0; model.n_constraints()];
    model.multiply_jacobian(terms, x, &mut rates);
    rates
}

/// The rows of J, each over the unknowns.
pub fn jacobian(model: &impl Model<f64>, terms: &Terms<f64>) -> Vec<Vec<f64>> {
    let (n, m) = (model.n_unknowns(), model.n_constraints());
    let mut rows = vec![vec![0.0; n]; m];
    let mut unit = vec![0.0; model.n_extended()];
    for i in 0..n {
        unit[i] = 1.0;
        for (row, rate) in rows.iter_mut().zip(rates(model, terms, &unit)) {
            row[i] = rate;
        }
        unit[i] = 0.0;
    }
    rows
}

/// The sum of the residuals of all elements.
pub fn residual(model: &impl Model<f64>, terms: &Terms<f64>, load: &Load<'_, f64>) -> Vec<f64> {
    let mut f = vec![0.0; model.n_unknowns()];
    for e in 0..model.n_elements() {
        let clique = model.clique(e);
        let mut local = vec![f64::NAN; clique.len()];
        model.write_residual(terms, load, e, &mut local);
        for (&u, x) in clique.iter().zip(local) {
            f[u as usize] += x;
        }
    }
    f
}

/// The sum of the blocks of all elements, dense and symmetric.
pub fn matrix(
    model: &impl Model<f64>,
    terms: &Terms<f64>,
    tangent: &Tangent<'_, f64>,
) -> Vec<Vec<f64>> {
    let n = model.n_unknowns();
    let mut a = vec![vec![0.0; n]; n];
    for e in 0..model.n_elements() {
        let clique = model.clique(e);
        let k = clique.len();
        let mut block = vec![f64::NAN; k * (k + 1) / 2];
        model.write_block(terms, tangent, e, &mut block);
        let mut at = 0;
        for j in 0..k {
            for i in j..k {
                let (row, column) = (clique[i] as usize, clique[j] as usize);
                a[row][column] += block[at];
                if i != j {
                    a[column][row] += block[at];
                }
                at += 1;
            }
        }
    }
    a
}

/// The part of x that is orthogonal to all rows, by Gram-Schmidt done twice; rows that depend on others are left out.
pub fn in_null_space(rows: &[Vec<f64>], x: &[f64]) -> Vec<f64> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for row in rows {
        let mut y = row.clone();
        for _ in 0..2 {
            for b in &basis {
                y = plus(&y, -dot(b, &y), b);
            }
        }
        let length = dot(&y, &y).sqrt();
        if length > 1e-9 * dot(row, row).sqrt() {
            basis.push(y.iter().map(|y| y / length).collect());
        }
    }
    let n = rows.first().map_or(x.len(), Vec::len);
    let mut x = x.to_vec();
    for _ in 0..2 {
        for b in &basis {
            let s = dot(b, &x[..n]);
            for (x, b) in x.iter_mut().zip(b) {
                *x -= s * b;
            }
        }
    }
    x
}

/// Fails unless two vectors agree within `tolerance` times one plus their size.
#[track_caller]
pub fn close(what: &str, x: &[f64], y: &[f64], tolerance: f64) {
    assert_eq!(x.len(), y.len(), "{what}");
    let size = y.iter().fold(1.0_f64, |s, y| s.max(y.abs()));
    for (i, (x, y)) in x.iter().zip(y).enumerate() {
        assert!((x - y).abs() <= tolerance * size, "{what}: entry {i}: {x} against {y}");
    }
}

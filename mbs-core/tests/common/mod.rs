//! Scenes that contain every joint, guide and effect, random configurations, and dense views of a model.

#![allow(dead_code, unreachable_pub, reason = "each test binary uses its part")]

pub mod effects;

use mbs_core::model::{Load, Model, Tangent, Terms};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::Scene;
use mbs_scene::Document;

/// Every planar joint kind, guide law and effect, a welded pair and bodies fixed to the ground.
pub const PLANAR: &str = include_str!("planar-zoo.toml");

/// Every spatial joint kind, guide law and effect, a welded pair, a rod held by balls and a body fixed to the ground.
pub const SPATIAL: &str = include_str!("spatial-zoo.toml");

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

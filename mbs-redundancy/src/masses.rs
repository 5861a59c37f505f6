//! Motions that the joints allow and that have no kinetic energy.
//!
//! ```text
//! J V = 0,   R = [√m (c-rows of V);  √I R_bᵀ (ω-rows of V)],   massless motions: the null space of R
//! ```
//!
//! R is scaled by the mean mass and mean inertia of the bodies, so that the rank does not depend on units.

use super::Vector;
use super::link::Poses;
use super::linkage::Linkage;
use super::parts::Part;
use super::rank::Rank;
use mbs_core::cluster::mass_properties;
use mbs_core::scene::{Inertia, Scene};
use mbs_linear::{Matrix, Svd};

/// A motion without kinetic energy.
#[derive(Debug, Clone, PartialEq)]
pub struct Massless {
    /// Bodies that move in this motion.
    pub bodies: Vec<usize>,
    /// True if the motion is only the rotation of slender rods about their axes. Such a spin affects nothing else.
    pub is_idle_spin: bool,
}

/// Largest number of columns of a part that is decomposed, which limits the computing time. Chosen, not tuned.
const LARGEST: usize = 600;
/// Largest entry of a unit vector that counts as zero [-]. Chosen, not tuned.
const ZERO: f64 = 1e-6;
/// Square root of the largest energy that counts as zero, relative to the mean body's energy [-]. The root is compared, because R contains
/// square roots of masses. Chosen, not tuned.
const LEAST: f64 = 1e-7;

/// Returns the massless motions of a scene at a pose. Returns `None` if a part is too large. Spins of rods come first, one motion for each
/// rod.
///
/// Cost: two decompositions of the rows of all joints, if some body has a direction without inertia. Otherwise the cost is proportional to
/// the number of bodies.
#[must_use]
pub fn massless(scene: &Scene<f64>, linkage: &Linkage, at: &Poses) -> Option<Vec<Massless>> {
    let n = scene.bodies.len();
    let roots: Vec<_> = (0..n).map(|b| roots(scene, b, at)).collect();
    let is_light = |root: &Matrix| Rank::of(root).is_none_or(|r| r.sizes[2] < 6);
    let f = linkage.freedoms();
    if f == 6 && !roots.iter().any(is_light) {
        return Some(Vec::new());
    }
    if n * f > LARGEST {
        return None;
    }
    let all =
        Part { joints: (0..scene.joints.len()).collect(), bodies: (0..n).collect(), length: 1.0 };
    let free = Rank::of(&linkage.jacobian(&all, at).matrix)?.free;
    let scale = mean(scene);
    let r = energy(&roots, linkage, &free, scale);
    let rank = cut(&r)?;
    if rank.n_columns() == 0 {
        return Some(Vec::new());
    }
    let motions = free.times(&rank);
    Some(classified(scene, linkage, at, &motions))
}

/// Returns √M, the square root of the inertia of a body, as a 6 x 6 matrix on (v, ω) in global axes.
fn roots(scene: &Scene<f64>, body: usize, at: &Poses) -> Matrix {
    let (mass, _, inertia) = mass_properties(scene, body);
    let turned = at[body].rotation * inertia * at[body].rotation.transpose();
    let mut root = Matrix::zeros(6, 6);
    for i in 0..3 {
        root[(i, i)] = mass.sqrt();
    }
    let square = Matrix::from_fn(3, 3, |i, j| turned[(i, j)]);
    if let Some(Svd { u, sigma, .. }) = Svd::new(&square) {
        for i in 0..3 {
            for j in 0..3 {
                root[(3 + i, 3 + j)] = sigma[i].sqrt() * u[(j, i)];
            }
        }
    }
    root
}

/// Returns the mean mass and mean inertia of the bodies that have mass or inertia. A mean is one if no body has any.
fn mean(scene: &Scene<f64>) -> [f64; 2] {
    let bodies: Vec<_> = (0..scene.bodies.len()).map(|b| mass_properties(scene, b)).collect();
    let mean = |values: Vec<f64>| {
        let n = values.len() as f64;
        if values.is_empty() { 1.0 } else { values.iter().sum::<f64>() / n }
    };
    let some = |x: &f64| *x > 0.0;
    let masses = bodies.iter().map(|b| b.0).filter(some).collect();
    let inertias = bodies.iter().map(|b| b.2.trace() / 3.0).filter(some).collect();
    [mean(masses), mean(inertias)]
}

/// Returns the square root of the energy of the free motions: one row for each direction of a body, one column for each motion.
fn energy(roots: &[Matrix], linkage: &Linkage, free: &Matrix, scale: [f64; 2]) -> Matrix {
    let f = linkage.freedoms();
    let place = |i: usize| if f == 6 { i } else { [0, 1, 5][i] };
    Matrix::from_fn(roots.len() * 6, free.n_columns(), |row, j| {
        let (b, i) = (row / 6, row % 6);
        let scale = if i < 3 { scale[0] } else { scale[1] }.sqrt();
        (0..f).map(|k| roots[b][(i, place(k))] * free[(b * f + k, j)]).sum::<f64>() / scale
    })
}

/// Returns a basis of the null space of R.
fn cut(r: &Matrix) -> Option<Matrix> {
    if r.n_columns() == 0 {
        return Some(Matrix::zeros(0, 0));
    }
    let Svd { sigma, v, .. } = Svd::new(r)?;
    Some(v.columns_from(sigma.iter().filter(|&&s| s > LEAST).count()))
}

/// Separates the idle spins of rods from the other massless motions.
fn classified(
    scene: &Scene<f64>,
    linkage: &Linkage,
    at: &Poses,
    motions: &Matrix,
) -> Vec<Massless> {
    let f = linkage.freedoms();
    let mut found = Vec::new();
    let mut spins = Vec::new();
    for (b, body) in scene.bodies.iter().enumerate() {
        if body.is_point() {
            // a point mass has no rotation
            spins.extend(linkage.turns().map(|turn| {
                let mut spin = Matrix::zeros(scene.bodies.len() * f, 1);
                spin[(b * f + turn, 0)] = 1.0;
                spin
            }));
        }
        let Inertia::Rod { from, to } = body.inertia else { continue };
        if f == 3 || !(body.mass > 0.0) {
            continue;
        }
        let d = at[b].rotation * (Vector::from(to) - Vector::from(from));
        let d = d / d.norm();
        let mut spin = Matrix::zeros(scene.bodies.len() * f, 1);
        (0..3).for_each(|i| spin[(b * f + 3 + i, 0)] = d[i]);
        // A spin is idle if it is one of the massless motions.
        let left = spin.minus(&motions.times(&motions.transpose().times(&spin)));
        if (0..left.n_rows()).all(|i| left[(i, 0)].abs() <= ZERO) {
            found.push(Massless { bodies: vec![b], is_idle_spin: true });
            spins.push(spin);
        }
    }
    let mut rest = motions.clone();
    for spin in &spins {
        rest = rest.minus(&spin.times(&spin.transpose().times(&rest)));
    }
    let Some(Svd { u, sigma, .. }) = Svd::thin(&rest) else { return found };
    let k = sigma.iter().filter(|&&s| s > 0.5).count();
    if k > 0 {
        let moves = |b: &usize| (0..k).any(|j| (0..f).any(|i| u[(b * f + i, j)].abs() > ZERO));
        let bodies = (0..scene.bodies.len()).filter(moves).collect();
        found.push(Massless { bodies, is_idle_spin: false });
    }
    found
}

//! Test whether a dependency holds in every position or only in the present one.
//!
//! The part is displaced along a random admissible motion. Then the method of Levenberg and Marquardt closes its joints again. With a
//! damping of |r|, where r is the residual of the joints, the method converges quadratically even if rows are redundant (Yamashita and
//! Fukushima 2001). A dependency is structural if it holds in all positions reached. If it does not, the present position is singular.

use super::link::Poses;
use super::linkage::Linkage;
use super::parts::Part;
use super::rank::Rank;
use super::residual::residuals;
use mbs_core::rigid::RigidMotion;
use mbs_linear::{Matrix, Svd};

mbs_core::named! {
    /// Positions in which a dependency holds.
    pub enum Nature {
        /// In every nearby position: the dependency follows from the design of the mechanism.
        Structural = "structural",
        /// In this position alone, which is singular.
        Singular = "singular-position",
        /// Partly in every position: in the present position there are more dependent equations.
        Both = "both",
        /// Not determinable, because no body can move.
        Rigid = "rigid",
        /// Not examined, because the part is too large or no position close by was found.
        Untried = "untried",
    }
}

/// Number of perturbations in different directions. Chosen, not tuned.
const PERTURBATIONS: u64 = 3;
/// Size of a perturbation, in radians and in lengths of the part [-]. After a failure half of it is tried. Chosen, not tuned.
const PERTURBATION: f64 = 0.1;
/// Smallest distance of a perturbed pose from the present one, relative to the perturbation [-]. Closer poses count as the same. Chosen,
/// not tuned.
const LEAST_DISTANCE: f64 = 1e-2;
/// Largest number of sweeps that close the joints again [-]. Chosen, not tuned.
const MAX_SWEEPS: usize = 60;
/// Residual below which the joints are satisfied, relative to the part's length [-]. Chosen, not tuned.
const MET: f64 = 1e-13;
/// Residual that is accepted if it no longer falls, relative to the part's length [-]. Chosen, not tuned.
const ACCEPTED: f64 = 1e-11;
/// Largest number of entries of a matrix that is decomposed here, which limits the computing time. Chosen, not tuned.
const LARGEST: usize = 100_000;

/// Returns positions close to `at` that satisfy the joints of a part. Returns `None` if the part is too large, and an empty list if none is
/// found.
pub(crate) fn neighbours(
    linkage: &Linkage,
    part: &Part,
    (at, rank): (&Poses, &Rank),
) -> Option<Vec<Vec<RigidMotion<f64>>>> {
    if rank.sizes[0] * rank.sizes[1] > LARGEST {
        return None;
    }
    let mut random = 0x9E37_79B9_7F4A_7C15_u64;
    let mut found = Vec::new();
    for kick in 0..2 * PERTURBATIONS {
        if found.len() as u64 == PERTURBATIONS || rank.free.n_columns() == 0 {
            break;
        }
        let weights: Vec<f64> = (0..rank.free.n_columns()).map(|_| draw(&mut random)).collect();
        let mut twist = combine(&rank.free, &weights);
        let largest = twist.iter().fold(0.0_f64, |l, x| l.max(x.abs()));
        // Further trials use half of the perturbation or less.
        let size = PERTURBATION * part.length / (1 + kick / PERTURBATIONS) as f64;
        twist.iter_mut().for_each(|x| *x *= size / largest);
        let mut there = at.to_vec();
        linkage.moved(part, &mut there, &twist);
        if close(linkage, part, at, &mut there)
            && distance(part, at, &there) > LEAST_DISTANCE * size
        {
            found.push(there);
        }
    }
    Some(found)
}

/// Moves poses until they satisfy the joints of a part. Returns whether that succeeded.
fn close(linkage: &Linkage, part: &Part, met: &Poses, at: &mut [RigidMotion<f64>]) -> bool {
    let measure = |at: &Poses| -> Vec<f64> {
        let links = part.joints.iter().map(|&j| &linkage.links[j]);
        let rows = links.flat_map(|link| residuals(link, (part, linkage.dimension), met, at));
        rows.map(|r| r / part.length).collect()
    };
    let mut r = measure(at);
    for _ in 0..MAX_SWEEPS {
        let size = r.iter().map(|x| x * x).sum::<f64>().sqrt();
        if size <= MET {
            return true;
        }
        let jacobian = linkage.jacobian(part, at);
        let Some(Svd { u, sigma, v }) = Svd::thin(&jacobian.matrix) else { return false };
        // δ = −V Σ (Σ² + |r|)⁻¹ Uᵀ r
        let mut twist = vec![0.0; jacobian.matrix.n_columns()];
        for k in 0..sigma.len() {
            let share: f64 = u.column(k).iter().zip(&r).map(|(u, r)| u * r).sum();
            let weight = -share * sigma[k] / (sigma[k] * sigma[k] + size) * part.length;
            for (i, x) in twist.iter_mut().enumerate() {
                *x += weight * v[(i, k)];
            }
        }
        linkage.moved(part, at, &twist);
        let left = measure(at);
        let after = left.iter().map(|x| x * x).sum::<f64>().sqrt();
        r = left;
        if !(after < size) && size <= ACCEPTED {
            return true;
        }
    }
    false
}

/// Returns the largest displacement of a body between two poses [m]: that of its centre, or its rotation times the part's length.
fn distance(part: &Part, from: &Poses, to: &Poses) -> f64 {
    let of = |&b: &usize| {
        let way = (to[b].position - from[b].position).norm();
        let turn =
            mbs_core::algebra::rotation_vector(&(to[b].rotation * from[b].rotation.transpose()));
        way.max(turn.norm() * part.length)
    };
    part.bodies.iter().map(of).fold(0.0, f64::max)
}

fn combine(basis: &Matrix, weights: &[f64]) -> Vec<f64> {
    let entry = |i| weights.iter().enumerate().map(|(j, w)| w * basis[(i, j)]).sum();
    (0..basis.n_rows()).map(entry).collect()
}

/// Draws a pseudo-random number in (-1, 1), the same on every machine (xorshift64*).
fn draw(state: &mut u64) -> f64 {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    let x = (state.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64;
    x / (1_u64 << 52) as f64 - 1.0
}

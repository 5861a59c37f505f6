//! Choice of the coordinates that are states: as many independent coordinates as there are freedoms, preferably the first ones of the
//! scene.

use core::ops::Range;

/// Smallest independent part of a coordinate, relative to its size, for the first choice, which follows the order of the scene [-]. Chosen,
/// not tuned.
const INDEPENDENT: f64 = 0.1;
/// Smallest independent part of a coordinate for the second choice, by the size of this part [-]. The second choice completes the first
/// one. With a smaller part, the states would not determine the motion accurately.
const LEAST: f64 = 1e-4;
/// Largest change of a coordinate that counts as no motion, relative to the largest change of all coordinates [-]. Difference quotients
/// have errors of 1e-11.
const HELD: f64 = 1e-8;

/// Chooses the states among coordinates. Row i of `slopes` has the derivatives of coordinate i by each freedom. Coordinates of joints are
/// chosen first, and coordinates of bodies complete the number. `None` if all coordinates together are too few.
pub fn choose(slopes: &[Vec<f64>], n_of_joints: usize) -> Option<Vec<usize>> {
    let f = slopes.first().map_or(0, Vec::len);
    let mut taken = Taken { slopes, chosen: Vec::new(), basis: Vec::new() };
    let largest = slopes.iter().fold(0.0_f64, |most, row| most.max(norm(row)));
    for group in [0..n_of_joints, n_of_joints..slopes.len()] {
        taken.fill(f, group, HELD * largest);
    }
    let mut chosen = taken.chosen;
    chosen.sort_unstable();
    (chosen.len() == f).then_some(chosen)
}

/// Chosen coordinates, and an orthonormal basis of their rows in `slopes`.
struct Taken<'a> {
    slopes: &'a [Vec<f64>],
    chosen: Vec<usize>,
    basis: Vec<Vec<f64>>,
}

impl Taken<'_> {
    /// Chooses coordinates of a group whose rows are larger than `held`. It ends when `f` coordinates are chosen or no further one is
    /// independent.
    fn fill(&mut self, f: usize, group: Range<usize>, held: f64) {
        let moving = group.filter(|&i| norm(&self.slopes[i]) > held);
        let moving: Vec<usize> = moving.collect();
        for &i in &moving {
            self.take(f, i, INDEPENDENT);
        }
        while self.chosen.len() < f {
            let parts = moving.iter().map(|&i| (norm(&self.rest(i)), i));
            let Some((_, best)) = parts.max_by(|a, b| a.0.total_cmp(&b.0)) else { return };
            if !self.take(f, best, LEAST) {
                return;
            }
        }
    }

    /// Chooses a coordinate if its independent part exceeds `least`; returns whether it was chosen.
    fn take(&mut self, f: usize, i: usize, least: f64) -> bool {
        let mut rest = self.rest(i);
        let size = norm(&rest);
        if self.chosen.len() == f || !(size > least) {
            return false;
        }
        rest.iter_mut().for_each(|x| *x /= size);
        self.basis.push(rest);
        self.chosen.push(i);
        true
    }

    /// Row of a coordinate, scaled to unit length, minus its components along the rows of the chosen coordinates.
    fn rest(&self, i: usize) -> Vec<f64> {
        let size = norm(&self.slopes[i]);
        let mut rest: Vec<f64> = self.slopes[i].iter().map(|x| x / size).collect();
        // Orthogonalisation is done twice, because the rounding errors of the first pass are not orthogonal to the basis.
        for basis in self.basis.iter().chain(&self.basis) {
            let along: f64 = rest.iter().zip(basis).map(|(x, y)| x * y).sum();
            rest.iter_mut().zip(basis).for_each(|(x, y)| *x -= along * y);
        }
        rest
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

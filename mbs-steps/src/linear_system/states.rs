//! Choice of the coordinates that are the states: as many independent ones as there are freedoms, the first ones of the scene.

use core::ops::Range;

/// Part of a coordinate that is independent of those before, relative to its size, above which it is taken in the scene's order [-].
/// Chosen, not tuned.
const INDEPENDENT: f64 = 0.1;
/// Part of a coordinate that is independent of those before, above which the largest one is taken where these are too few [-]. Below it,
/// states and motion have no common digits.
const LEAST: f64 = 1e-4;
/// Change of a coordinate with the motion that is none, relative to the largest [-]: differences leave 1e-11.
const HELD: f64 = 1e-8;

/// The places of the states among coordinates that change by these rows with each freedom. Those of joints are first, and bodies' fill up
/// what they leave. Nothing where all together are too few.
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

/// Coordinates that are taken, and an orthonormal basis of their rows.
struct Taken<'a> {
    slopes: &'a [Vec<f64>],
    chosen: Vec<usize>,
    basis: Vec<Vec<f64>>,
}

impl Taken<'_> {
    /// Takes from a group, of those that change by more than `held`, until there are `f` of them, or none is independent.
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

    /// Takes a coordinate with an independent part of more than this.
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

    /// The part of a row of unit length that is independent of those taken.
    fn rest(&self, i: usize) -> Vec<f64> {
        let size = norm(&self.slopes[i]);
        let mut rest: Vec<f64> = self.slopes[i].iter().map(|x| x / size).collect();
        // twice, as rounding of the first time is not orthogonal
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

//! Eigenvectors of a linear system, by inverse iteration.
//!
//! ```text
//! (A - (lambda + d) 1) v_(k+1) = v_k / |v_k|,   d: rounding of A
//! ```
//!
//! In these formulas lambda is an eigenvalue and v_k the iterated vector. An eigenvalue of multiplicity m has up to m independent
//! eigenvectors. Each one is made orthogonal to the previous ones.

use super::data::LinearSystem;
use super::solve::{Complex, Factor, product, quotient, size};
use crate::erased::SimulationError;
use crate::mode::{Mode, slowest_first};
use crate::stop::StopError;

/// Number of inverse iterations for an eigenvector [-]. One iteration suffices, unless the start vector is almost orthogonal to the
/// eigenvector. Chosen, not tuned.
const ITERATIONS: usize = 3;
/// Distance up to which eigenvalues count as equal, relative to the largest eigenvalue [-]. Rounding errors split a double eigenvalue by
/// the square root of these errors.
const EQUAL: f64 = 1e-7;
/// Smallest part of a unit vector orthogonal to previous eigenvectors of the same eigenvalue, for which the vector counts as independent
/// [-]. Chosen, not tuned.
const OWN: f64 = 1e-3;

/// An eigenvalue, or a pair of conjugate eigenvalues, with its eigenvector.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ModeShape {
    /// Eigenvalue of the mode.
    pub mode: Mode,
    /// Eigenvector as [real, imaginary] of each state, scaled such that its largest component is one. The conjugate eigenvalue has the
    /// conjugate vector.
    pub states: Vec<[f64; 2]>,
    /// Complex amplitude of each output, [real, imaginary].
    pub outputs: Vec<[f64; 2]>,
}

impl LinearSystem {
    /// Eigenvalues of A in order of increasing magnitude, each with its eigenvector. A conjugate pair is listed once.
    ///
    /// The component of largest magnitude is scaled to one, regardless of its unit. If an eigenvalue has fewer independent eigenvectors
    /// than its multiplicity, as for a free motion, an eigenvector is listed twice.
    ///
    /// Cost: n^3 operations for each of n states.
    ///
    /// # Errors
    /// If the iteration for the eigenvalues does not converge.
    ///
    /// ```
    /// use mbs::{Body, Effect, GROUND, Joint, LinearizeOptions, Mechanism, linearize};
    /// let mut m = Mechanism::planar("two masses on springs");
    /// let mut before = GROUND;
    /// for x in [1.0, 2.0] {
    ///     let mass = m.add(Body::planar([x, 0.0], 1.0, 0.1));
    ///     m.add(Joint::prismatic([GROUND, mass], [x, 0.0]).along([1.0, 0.0]));
    ///     m.add(Effect::spring_damper([(before, [x - 1.0, 0.0]), (mass, [x, 0.0])], 100.0, 0.0, 1.0));
    ///     before = mass;
    /// }
    /// let shapes = linearize(&m, &LinearizeOptions::default(), None, None)?.shapes()?;
    /// // both go the same way in the slower mode: as one to the golden ratio
    /// let [first, second] = [0, 1].map(|mass| shapes[0].outputs[mass]);
    /// assert!((second[1] / first[1] - 1.618_034).abs() < 1e-6);
    /// # Ok::<(), mbs::SimulationError>(())
    /// ```
    pub fn shapes(&self) -> Result<Vec<ModeShape>, SimulationError> {
        let values = self.eigenvalues().map_err(|error| {
            SimulationError::new(error.code(), "the eigenvalues do not converge", "")
                .with_cause(error)
        })?;
        let modes = slowest_first(&values, self.noise);
        let largest = values.iter().fold(0.0_f64, |most, &x| most.max(size(x)));
        let mut shapes: Vec<ModeShape> = Vec::with_capacity(modes.len());
        for mode in modes {
            let value = [mode.real, mode.imaginary];
            let apart = |of: &Mode| size([of.real - value[0], of.imaginary - value[1]]);
            let equal = shapes.iter().filter(|shape| apart(&shape.mode) <= EQUAL * largest);
            let before: Vec<Vec<Complex>> = equal.map(|shape| shape.states.clone()).collect();
            let states = self.vector(value, largest, &before);
            let outputs = (0..self.c.rows).map(|i| dot(self.c.row(i), &states)).collect();
            shapes.push(ModeShape { mode, states, outputs });
        }
        Ok(shapes)
    }

    /// Computes the eigenvalues of A.
    pub(crate) fn eigenvalues(&self) -> Result<Vec<Complex>, StopError> {
        let n = self.a.rows;
        if n == 0 {
            return Ok(Vec::new());
        }
        let by_columns = || (0..n * n).map(|k| self.a[(k % n, k / n)]).collect();
        let matrix = self.rest.clone().unwrap_or_else(by_columns);
        mbs_linear::eigenvalues(n, &matrix).ok_or(StopError::Eigenvalues)
    }

    /// Computes an eigenvector, scaled such that its largest component is one.
    fn vector(&self, value: Complex, largest: f64, before: &[Vec<Complex>]) -> Vec<Complex> {
        let n = self.a.rows;
        let shift = value[0] + largest.max(f64::MIN_POSITIVE) * f64::EPSILON;
        let entry = |k: usize| {
            let (x, is_diagonal) = (self.a.data[k], k / n == k % n);
            if is_diagonal { [x - shift, -value[1]] } else { [x, 0.0] }
        };
        let factor = Factor::new(n, (0..n * n).map(entry).collect());
        let mut basis: Vec<Vec<Complex>> = Vec::new();
        for vector in before {
            let mut unit = vector.clone();
            take_out(&basis, &mut unit);
            if normalise(&mut unit) > OWN {
                basis.push(unit);
            }
        }
        // Each start vector has another direction. Its irregular components make it unlikely that it is orthogonal to the eigenvector.
        let mut found = vec![[0.0; 2]; n];
        for start in 0..=before.len() {
            let of = |i: usize| ((i + 1) as f64 * (1.0 + start as f64 * 0.37)).sin() + 1.5;
            let mut x: Vec<Complex> = (0..n).map(|i| [of(i), 0.0]).collect();
            for _ in 0..ITERATIONS {
                x = factor.solve(&x);
                normalise(&mut x);
            }
            found.clone_from(&x);
            take_out(&basis, &mut x);
            if normalise(&mut x) > OWN {
                found = x;
                break;
            }
        }
        let bigger =
            |best: usize, i: usize| if size(found[i]) > size(found[best]) { i } else { best };
        let main = (0..n).fold(0, bigger);
        let by = found[main];
        found.iter_mut().for_each(|x| *x = quotient(*x, by));
        found[main] = [1.0, 0.0];
        found
    }
}

fn dot(row: &[f64], x: &[Complex]) -> Complex {
    row.iter().zip(x).fold([0.0; 2], |sum, (a, x)| [sum[0] + a * x[0], sum[1] + a * x[1]])
}

/// Scales a vector to unit length, and returns its previous length.
fn normalise(x: &mut [Complex]) -> f64 {
    let largest = x.iter().fold(f64::MIN_POSITIVE, |most, x| most.max(size(*x)));
    let squares: f64 = x.iter().map(|x| (size(*x) / largest).powi(2)).sum();
    let length = largest * squares.sqrt();
    x.iter_mut().flatten().for_each(|x| *x /= length);
    length
}

/// Subtracts from `x` its components along orthonormal vectors.
fn take_out(basis: &[Vec<Complex>], x: &mut [Complex]) {
    for unit in basis {
        let along = unit.iter().zip(&*x).fold([0.0; 2], |sum: Complex, (u, x)| {
            let [re, im] = product([u[0], -u[1]], *x);
            [sum[0] + re, sum[1] + im]
        });
        for (x, u) in x.iter_mut().zip(unit) {
            let [re, im] = product(along, *u);
            *x = [x[0] - re, x[1] - im];
        }
    }
}

//! The numbers that a relation is of, and its derivatives there, on the stack.
//!
//! ```text
//! phi = phi(r) + g . (m - r),    r: the numbers m as doubles, g the gradient there
//! ```
//!
//! What doubles do not hold of a number is added by the gradient: Newton's method then sees no rounding of many turns.

use crate::Real;
use crate::laws::relation::{MAX_ARGUMENTS, Relation};

/// Numbers, their rates, and the gradient of a relation.
#[derive(Debug)]
pub struct Arguments<T> {
    n: usize,
    at: [f64; MAX_ARGUMENTS],
    /// Remainders of the numbers, which doubles do not hold.
    rest: [T; MAX_ARGUMENTS],
    rates: [f64; MAX_ARGUMENTS],
    gradient: [f64; MAX_ARGUMENTS],
}

impl<T: Real> Default for Arguments<T> {
    fn default() -> Self {
        let zeros = [0.0; MAX_ARGUMENTS];
        Self { n: 0, at: zeros, rest: [T::ZERO; MAX_ARGUMENTS], rates: zeros, gradient: zeros }
    }
}

impl<T: Real> Arguments<T> {
    /// Adds the number `base + change` with its rate. More than [`MAX_ARGUMENTS`] are left out: the check of a scene refuses them.
    pub fn push(&mut self, [base, change]: [T; 2], rate: T) {
        if self.n < MAX_ARGUMENTS {
            let at = (base + change).to_f64();
            self.at[self.n] = at;
            self.rest[self.n] = (base - T::from_f64(at)) + change;
            self.rates[self.n] = rate.to_f64();
            self.n += 1;
        }
    }

    /// The value of a relation; its slopes are known from then on.
    pub fn evaluate(&mut self, relation: &(impl Relation + ?Sized)) -> T {
        let n = self.n;
        let value = relation.evaluate(&self.at[..n], &mut self.gradient[..n]);
        let rest = self.rest[..n].iter().zip(&self.gradient[..n]);
        rest.fold(T::from_f64(value), |value, (&rest, &g)| value + rest * T::from_f64(g))
    }

    /// The derivative by number `k`; zero of one that is not there.
    pub fn slope(&self, k: usize) -> T {
        self.gradient.get(k).map_or(T::ZERO, |&g| T::from_f64(g))
    }

    /// The second derivative along the rates.
    pub fn curvature(&self, relation: &(impl Relation + ?Sized)) -> T {
        T::from_f64(relation.curvature(&self.at[..self.n], &self.rates[..self.n]))
    }

    /// The mixed second derivative by numbers `i` and `j`, from three curvatures: of searches, not of steps.
    pub fn second_derivative(&self, relation: &(impl Relation + ?Sized), i: usize, j: usize) -> T {
        let at = &self.at[..self.n];
        let along = |on: &[usize]| {
            let rates: [f64; MAX_ARGUMENTS] =
                core::array::from_fn(|k| if on.contains(&k) { 1.0 } else { 0.0 });
            relation.curvature(at, &rates[..self.n])
        };
        let twice = along(&[i, j]) - along(&[i]) - along(&[j]);
        T::from_f64(if i == j { along(&[i]) } else { 0.5 * twice })
    }
}

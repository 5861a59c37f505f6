//! Arguments of a relation, and the derivatives of the relation by them. They need no allocation.
//!
//! ```text
//! phi = phi(r) + g . (m - r),    m: the arguments, r: the arguments rounded to double precision, g: the gradient of phi at r
//! ```
//!
//! The gradient accounts for the part of an argument below double precision. Newton's method then sees no rounding error of an angle of
//! many turns.

use crate::Real;
use crate::laws::relation::{MAX_ARGUMENTS, Relation};

/// Arguments of a relation, their rates, and the gradient of the relation.
#[derive(Debug)]
pub struct Arguments<T> {
    n: usize,
    at: [f64; MAX_ARGUMENTS],
    /// Parts of the arguments below double precision.
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
    /// Adds the argument `base + change` with its rate. Arguments beyond [`MAX_ARGUMENTS`] are ignored; the check of a scene refuses them.
    pub fn push(&mut self, [base, change]: [T; 2], rate: T) {
        if self.n < MAX_ARGUMENTS {
            let at = (base + change).to_f64();
            self.at[self.n] = at;
            self.rest[self.n] = (base - T::from_f64(at)) + change;
            self.rates[self.n] = rate.to_f64();
            self.n += 1;
        }
    }

    /// Evaluates a relation and its gradient. Its slopes are available afterwards.
    pub fn evaluate(&mut self, relation: &(impl Relation + ?Sized)) -> T {
        let n = self.n;
        let value = relation.evaluate(&self.at[..n], &mut self.gradient[..n]);
        let rest = self.rest[..n].iter().zip(&self.gradient[..n]);
        rest.fold(T::from_f64(value), |value, (&rest, &g)| value + rest * T::from_f64(g))
    }

    /// Derivative of the relation by argument `k`; zero if there is no such argument.
    pub fn slope(&self, k: usize) -> T {
        self.gradient.get(k).map_or(T::ZERO, |&g| T::from_f64(g))
    }

    /// Second derivative of the relation along the rates of its arguments.
    pub fn curvature(&self, relation: &(impl Relation + ?Sized)) -> T {
        T::from_f64(relation.curvature(&self.at[..self.n], &self.rates[..self.n]))
    }

    /// Mixed second derivative by arguments `i` and `j`, from three curvatures. Searches use it; steps do not.
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

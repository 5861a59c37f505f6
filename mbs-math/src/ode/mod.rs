//! Runge-Kutta methods for y' = f(t, y), of any formulation whose state is a vector of numbers.
//!
//! ```text
//! kᵢ = f(t + cᵢ h, y + h Σⱼ aᵢⱼ kⱼ),   y(t + h) = y + h Σᵢ bᵢ kᵢ,   error = h Σᵢ eᵢ kᵢ
//! ```
//!
//! [`rk4_step`] is the classical method of order 4 with a fixed step. [`Tableau`] holds an embedded pair, or the
//! method 8(5,3) with two estimates, and [`Adaptive`] drives it or an [`Extrapolation`] of any even order with error control.
//! [`StepControl`] chooses the steps, and a hook after each accepted step may project the state onto its constraints.
//!
//! All storage is in slices of the caller; the explicit methods are built without `alloc`, so nothing in them can allocate.
//! [`Radau`] is implicit, for stiff systems, and makes its matrices with the feature `alloc`, when it is made.

mod adaptive;
mod control;
mod eighth;
mod error;
mod extrapolation;
mod method;
#[cfg(feature = "alloc")]
mod radau;
mod rk4;
mod tableau;
#[cfg(test)]
mod tests;

pub use adaptive::{Adaptive, AdaptiveHistory, Counts, EndState};
pub use control::StepControl;
pub use error::OdeError;
pub use extrapolation::Extrapolation;
pub use method::{Method, Options};
#[cfg(feature = "alloc")]
pub use radau::{Radau, RadauHistory};
pub use rk4::{rk4_scratch, rk4_step};
pub use tableau::Tableau;

/// A system of first-order differential equations y' = f(t, y).
pub trait Rates<T> {
    /// Why rates could not be evaluated.
    type Error;

    /// Number of components of y.
    fn n(&self) -> usize;

    /// Writes y' at time `t` [s] and state `y` into `dy`; both slices have [`Self::n`] components.
    ///
    /// A number that is not finite in `dy` makes a step with error control try a shorter one.
    ///
    /// # Errors
    ///
    /// What makes an answer impossible; the integration ends with it.
    fn rates(&mut self, t: T, y: &[T], dy: &mut [T]) -> Result<(), Self::Error>;

    /// Writes the rates with as few roundings as can be had, for slopes by differences. By default [`Self::rates`].
    ///
    /// # Errors
    ///
    /// As [`Self::rates`].
    fn fine_rates(&mut self, t: T, y: &[T], dy: &mut [T]) -> Result<(), Self::Error> {
        self.rates(t, y, dy)
    }

    /// Takes from the error of a trial step what the end of a step takes from the state, such as what a projection removes.
    /// Only what is left says something about the step. Called after the rates of all stages, once for each estimate; by default all
    /// is left.
    ///
    /// # Errors
    ///
    /// What makes an answer impossible; the integration ends with it.
    fn keep(&mut self, error: &mut [T]) -> Result<(), Self::Error> {
        let _ = error;
        Ok(())
    }
}

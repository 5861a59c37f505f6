//! Runge-Kutta methods for y' = f(t, y), where the state y is a vector of numbers. They serve every formulation with such a state.
//!
//! ```text
//! kᵢ = f(t + cᵢ h, y + h Σⱼ aᵢⱼ kⱼ),   y(t + h) = y + h Σᵢ bᵢ kᵢ,   error = h Σᵢ eᵢ kᵢ
//! ```
//!
//! [`rk4_step`] is the classical method of order 4 with a fixed step. [`Tableau`] has the coefficients of an embedded pair, or of the
//! method 8(5,3) with two error estimates. [`Adaptive`] makes steps of a [`Tableau`] or of an [`Extrapolation`], which has any even order,
//! with error control. [`StepControl`] chooses the steps. A hook after each accepted step may project the state onto its constraints.
//!
//! All storage is in slices of the caller. The explicit methods are built without `alloc`, so no explicit method can allocate. [`Radau`] is
//! implicit, for stiff systems; it needs the feature `alloc`, and allocates its matrices when it is made.

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
    /// Error of an evaluation of the rates.
    type Error;

    /// Number of components of y.
    fn n(&self) -> usize;

    /// Writes y' at time `t` [s] and state `y` into `dy`; both slices have [`Self::n`] components.
    ///
    /// A number in `dy` that is not finite makes a method with error control try a shorter step.
    ///
    /// # Errors
    ///
    /// An error that prevents the evaluation; it ends the integration.
    fn rates(&mut self, t: T, y: &[T], dy: &mut [T]) -> Result<(), Self::Error>;

    /// Writes the rates with the smallest rounding errors that the system can give, for derivatives by finite differences. Default:
    /// [`Self::rates`].
    ///
    /// # Errors
    ///
    /// An error that prevents the evaluation, as of [`Self::rates`].
    fn fine_rates(&mut self, t: T, y: &[T], dy: &mut [T]) -> Result<(), Self::Error> {
        self.rates(t, y, dy)
    }

    /// Removes from the estimated error of a trial step the components that the hook after the step removes from the state. A projection, for
    /// example, removes the components across the constraints. Only the remaining components measure the accuracy of the step. The function
    /// is called after the rates of all stages, once for each estimate. Default: nothing is removed.
    ///
    /// # Errors
    ///
    /// An error that prevents the computation; it ends the integration.
    fn keep(&mut self, error: &mut [T]) -> Result<(), Self::Error> {
        let _ = error;
        Ok(())
    }
}

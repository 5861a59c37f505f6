//! User-defined relations: twice differentiable functions of several measured numbers, which a coupling constrains.
//!
//! ```text
//! phi(m_1 .. m_n) = value + f(t),    phi' = g . m',    phi'' = g . m'' + m'^T H m'
//! ```
//!
//! The gradient of phi is g, and H is its matrix of second derivatives. A relation returns m'^T H m' as one number for given rates
//! m'.

use core::fmt::{self, Debug, Display, Formatter};

/// Largest number of arguments of a relation [-], because they and their derivatives are on the stack of a step.
pub const MAX_ARGUMENTS: usize = 16;

/// Twice differentiable function of several numbers, with data. The coupling that constrains it is made by `Coupling::relation`.
///
/// The relation computes in doubles. A run of 32 digits refuses it, because its rows must hold to more than 16. An infinite or NaN
/// result ends the step with [`StepError::Relation`](crate::step::StepError::Relation). A scene is refused if [`check`] finds wrong
/// derivatives in the reference configuration or at the start values.
///
/// # Examples
/// ```
/// use mbs_core::laws::relation::{Relation, check};
/// /// A bead on an ellipse, by its two coordinates: (x/a)^2 + (y/b)^2.
/// #[derive(Debug)]
/// struct Ellipse { axes: [f64; 2] }
///
/// impl Relation for Ellipse {
///     fn evaluate(&self, at: &[f64], gradient: &mut [f64]) -> f64 {
///         let [x, y] = [at[0] / self.axes[0], at[1] / self.axes[1]];
///         gradient[0] = 2.0 * x / self.axes[0];
///         gradient[1] = 2.0 * y / self.axes[1];
///         x * x + y * y
///     }
///     fn curvature(&self, _: &[f64], rates: &[f64]) -> f64 {
///         let [x, y] = [rates[0] / self.axes[0], rates[1] / self.axes[1]];
///         2.0 * (x * x + y * y)
///     }
/// }
/// assert_eq!(check(&Ellipse { axes: [2.0, 1.0] }, &[1.2, 0.8]), Ok(()));
/// ```
pub trait Relation: Send + Sync + Debug {
    /// Returns the value at these numbers, and writes the derivative by each of them to `gradient`, which has the same length.
    ///
    /// The result must depend on `at` only: calls come at trial states, in any order and from several threads.
    fn evaluate(&self, at: &[f64], gradient: &mut [f64]) -> f64;

    /// Returns the second derivative along `rates`: `sum_ij d2 phi/(dm_i dm_j) rates_i rates_j`, where mixed terms count twice.
    ///
    /// For constant `rates` this is the second time derivative of the value.
    fn curvature(&self, at: &[f64], rates: &[f64]) -> f64;
}

/// Fault of a relation, for which it is refused.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum RelationFault {
    /// A number is infinite or NaN.
    NotFinite,
    /// A derivative differs from the difference quotient of the values.
    Gradient {
        /// Number of the argument, from 0.
        argument: usize,
        /// Derivative that the relation gives, and the difference quotient of its values.
        numbers: [f64; 2],
    },
    /// The curvature differs from the difference quotient of the gradient.
    Curvature {
        /// Curvature that the relation gives, and the difference quotient of its gradients.
        numbers: [f64; 2],
    },
    /// The relation has more than [`MAX_ARGUMENTS`] terms.
    TooMany {
        /// Number of terms found.
        found: usize,
    },
    /// The run uses more digits than a double has.
    Doubles,
    /// A term of the relation has a curve.
    Curve {
        /// Number of the term with the curve, from 0.
        term: usize,
    },
}

impl RelationFault {
    /// Returns advice on how to mend the fault.
    #[must_use]
    pub const fn advice(&self) -> &'static str {
        match self {
            Self::NotFinite => {
                "let it have numbers in the reference configuration, where all measures are zero, and at the start"
            }
            Self::Gradient { .. } => {
                "correct the gradient: one derivative for each number, in the order of the terms"
            }
            Self::Curvature { .. } => {
                "correct the curvature: sum_ij H_ij rates_i rates_j, mixed derivatives twice"
            }
            Self::TooMany { .. } => "split it into several couplings of fewer measures",
            Self::Doubles => "run it in doubles, `f64`",
            Self::Curve { .. } => "let the relation have the curve",
        }
    }
}

impl Display for RelationFault {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite => write!(f, "gives a number that is infinite or NaN"),
            Self::Gradient { argument, numbers: [given, found] } => write!(
                f,
                "has the derivative {given:e} by its number {}, but its values change by {found:e}",
                argument + 1
            ),
            Self::Curvature { numbers: [given, found] } => write!(
                f,
                "has the curvature {given:e} along some rates, but its gradients change by {found:e}"
            ),
            Self::TooMany { found } => {
                write!(f, "has {found} terms; a relation takes {MAX_ARGUMENTS}")
            }
            Self::Doubles => write!(f, "gives doubles, 16 digits, which rows of 32 cannot hold"),
            Self::Curve { term } => {
                write!(f, "has a curve in term {}, beside a relation", term + 1)
            }
        }
    }
}

impl core::error::Error for RelationFault {}

/// Steps of the difference quotients [m or rad]. A correct derivative agrees at one of these steps, whatever the length scale of
/// the relation.
const STEPS: [f64; 3] = [1e-3, 1e-5, 1e-7];
/// Largest relative difference between a correct derivative and a difference quotient [-]. Correct ones differ by the square of the
/// step, and a wrong formula by its own size. Chosen, not tuned.
const AGREEMENT: f64 = 1e-3;
/// Largest difference between a correct derivative and a difference quotient, relative to the largest derivative [-]. This limit is
/// for derivatives that are zero. Their quotients contain only an error of the order of the third derivatives. Chosen, not tuned.
const BESIDE_LARGEST: f64 = 1e-6;
/// Rounding error of a value, in units of the rounding of its size [-]: a formula has a few dozen operations. Chosen, not tuned.
const ROUNDINGS: f64 = 64.0;

/// Compares the derivatives of a relation with central differences of its values, and the curvature with those of its gradient.
///
/// Difference quotients are skipped if an end is outside the range of finite values. If a derivative is zero by chance, as it may
/// be in the reference configuration, a wrong formula may pass: check at several places.
///
/// Cost: about seven evaluations for each argument.
///
/// # Errors
/// [`RelationFault`] of the first derivative that differs.
///
/// # Panics
/// If there are more than [`MAX_ARGUMENTS`] arguments.
pub fn check(relation: &(impl Relation + ?Sized), at: &[f64]) -> Result<(), RelationFault> {
    let n = at.len();
    let mut given = [0.0; MAX_ARGUMENTS];
    let value = relation.evaluate(at, &mut given[..n]);
    let is_finite = value.is_finite() && given.iter().all(|x| x.is_finite());
    let mut rates = [0.0; MAX_ARGUMENTS];
    for (k, rate) in rates[..n].iter_mut().enumerate() {
        // different rates, so that errors in two mixed derivatives do not cancel
        *rate = 1.0 / (1.0 + k as f64 / 3.0);
    }
    let along_all = relation.curvature(at, &rates[..n]);
    if !is_finite || !along_all.is_finite() {
        return Err(RelationFault::NotFinite);
    }
    let largest = given.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let floor = BESIDE_LARGEST * if largest > 0.0 { largest } else { 1.0 };
    for argument in 0..n {
        let unit = unit(argument);
        let of = |at: &[f64]| relation.evaluate(at, &mut [0.0; MAX_ARGUMENTS][..n]);
        if let Some(found) = differing((at, &unit[..n]), given[argument], floor, of) {
            let numbers = [given[argument], found];
            return Err(RelationFault::Gradient { argument, numbers });
        }
    }
    let units = (0..n).map(unit);
    for along in units.chain([rates]) {
        let along = &along[..n];
        let given = relation.curvature(at, along);
        let of = |at: &[f64]| {
            let mut gradient = [0.0; MAX_ARGUMENTS];
            let _ = relation.evaluate(at, &mut gradient[..n]);
            gradient.iter().zip(along).map(|(g, rate)| g * rate).sum()
        };
        let floor = BESIDE_LARGEST * along_all.abs().max(largest).max(BESIDE_LARGEST);
        if let Some(found) = differing((at, along), given, floor, of) {
            return Err(RelationFault::Curvature { numbers: [given, found] });
        }
    }
    Ok(())
}

fn unit(k: usize) -> [f64; MAX_ARGUMENTS] {
    core::array::from_fn(|i| if i == k { 1.0 } else { 0.0 })
}

/// Compares `given` with difference quotients along a direction. If a quotient agrees with `given`, returns `None`. Otherwise it
/// returns the quotient nearest to `given`.
fn differing(
    (at, along): (&[f64], &[f64]),
    given: f64,
    floor: f64,
    of: impl Fn(&[f64]) -> f64,
) -> Option<f64> {
    let mut nearest: Option<f64> = None;
    for step in STEPS {
        let [before, after] = [-step, step].map(|step| {
            let mut place = [0.0; MAX_ARGUMENTS];
            let numbers = place.iter_mut().zip(at).zip(along);
            numbers.for_each(|((x, at), along)| *x = at + step * along);
            of(&place[..at.len()])
        });
        let found = (after - before) / (2.0 * step);
        if !found.is_finite() {
            continue;
        }
        let rounding = ROUNDINGS * f64::EPSILON * before.abs().max(after.abs()) / step;
        let allowed = AGREEMENT * found.abs().max(given.abs()) + floor + rounding;
        if (found - given).abs() <= allowed {
            return None;
        }
        if nearest.is_none_or(|other| (found - given).abs() < (other - given).abs()) {
            nearest = Some(found);
        }
    }
    nearest
}

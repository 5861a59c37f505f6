//! Step-size control: the energy invariant, a local error estimate, and the driver that repeats steps.
//!
//! This module depends on no formulation: it steps a [`Stepper`]. The crate mbs-augmented implements this trait for its formulations, the
//! crate mbs for all formulations.
//!
//! # Examples
//!
//! A mass of 1 kg falls freely for 1 s. The steps are exact, so they grow to the largest step.
//!
//! ```
//! use mbs_core::control::{TrialStep, Driver, EnergyRule, Invariant, Rules, Stepper};
//! use mbs_core::step::{StepError, StepReport};
//!
//! struct Fall { t: f64, y: f64, v: f64, saved: [f64; 3] }
//!
//! impl Stepper<f64> for Fall {
//!     fn attempt(&mut self, h: f64) -> Result<TrialStep<f64>, StepError> {
//!         self.saved = [self.t, self.y, self.v];
//!         let v = self.v - 9.81 * h;
//!         (self.t, self.y, self.v) = (self.t + h, self.y + 0.5 * h * (self.v + v), v);
//!         let energies = [0.5 * v * v, 9.81 * self.y, 0.0];
//!         Ok(TrialStep { energies, t: self.t, report: StepReport::default(), error: 0.0, acceleration_energy: [0.0; 2] })
//!     }
//!     fn undo(&mut self) {
//!         [self.t, self.y, self.v] = self.saved;
//!     }
//!     fn keep(&mut self, _at_event: bool) {}
//! }
//!
//! let mut fall = Fall { t: 0.0, y: 9.81, v: 0.0, saved: [0.0; 3] };
//! let rules = Rules { max_step: 0.1, energy: Some(EnergyRule::default()), error: None };
//! let mut driver = Driver::new(rules, 1e-3);
//! let mut invariant = Invariant::new([0.0, 9.81 * 9.81, 0.0], 9.81, f64::EPSILON);
//! while fall.t < 1.0 {
//!     let rest = 1.0 - fall.t;
//!     driver.step(&mut fall, &mut invariant, (1.0 - rest, rest))?;
//! }
//! assert!((fall.y - 0.5 * 9.81).abs() < 1e-12 && driver.next() == 0.1);
//! assert!(invariant.max_error() < 1e-12);
//! # Ok::<(), StepError>(())
//! ```

mod driver;
pub(crate) mod energy;
mod estimate;
mod invariant;

pub use driver::{Accepted, Driver, DriverHistory, Event, Limit, Rules, Stepper, TrialStep};
pub use energy::EnergyRule;
pub use estimate::LocalError;
pub use invariant::Invariant;

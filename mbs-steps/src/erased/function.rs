//! User-defined outputs, written as code.

use super::view::{Sight, View};
use crate::record::Channel;
use crate::run::Columns;
use crate::simulation::Simulation;
use crate::stop::StopError;
use core::fmt::{self, Debug, Formatter};
use mbs_core::Real;
use mbs_scene::Component;
use std::sync::Arc;

/// User-defined output of a mechanism: a number that is computed from the mechanism at an instant. A closure with a [`View`] as its
/// argument is such an output too.
///
/// ```
/// use mbs::{Mechanism, OutputFunction, View};
///
/// /// Speed of a body's centre of mass [m/s].
/// struct Speed(mbs::BodyId);
/// impl OutputFunction for Speed {
///     fn evaluate(&self, now: &View<'_>) -> f64 {
///         now.motion(self.0).velocity.iter().map(|v| v * v).sum::<f64>().sqrt()
///     }
/// }
/// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
/// let mut m = Mechanism::read(path)?;
/// let lower = m.find("lower")?;
/// let speed = m.add_function("speed", Speed(lower));
/// let mut sim = m.simulate(&mbs::Method::default())?;
/// sim.advance_to(0.1)?;
/// // the rods fall freely at first: their angular velocities differ by less than their size
/// assert!(sim.function(speed) > 0.5 && sim.function(speed) < 3.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait OutputFunction: Send + Sync {
    /// Evaluates the output at an instant. A value that is not finite stops the run with an error that names the output.
    fn evaluate(&self, now: &View<'_>) -> f64;
}

impl<F: Fn(&View<'_>) -> f64 + Send + Sync> OutputFunction for F {
    fn evaluate(&self, now: &View<'_>) -> f64 {
        self(now)
    }
}

/// Index of a user-defined output among those of its mechanism.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct FunctionId(pub usize);

/// User-defined output with its name. It is not part of the scene. Clones refer to the same function.
#[derive(Clone)]
pub struct Function {
    pub name: String,
    pub code: Arc<dyn OutputFunction>,
}

impl PartialEq for Function {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && Arc::ptr_eq(&self.code, &other.code)
    }
}

impl Debug for Function {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "Function({:?})", self.name)
    }
}

/// Columns of a run that hold the user-defined outputs of a mechanism.
#[allow(
    missing_debug_implementations,
    reason = "it holds what has none, and is made and used in one call"
)]
pub struct FunctionColumns<'a, T: Real, const D: usize> {
    pub sight: Sight<'a, T, D>,
    pub functions: &'a [Function],
}

impl<T: Real, const D: usize> Columns<T, D> for FunctionColumns<'_, T, D> {
    fn channels(&self) -> Vec<Channel> {
        let component = || Component { label: String::new(), unit: String::new() };
        let channel = |f: &Function| Channel {
            name: f.name.clone(),
            quantity: "",
            components: vec![component()],
        };
        self.functions.iter().map(channel).collect()
    }

    fn follow(&mut self, now: &Simulation<T, D>) -> Result<(), StopError> {
        self.sight.follow(now)
    }

    fn write(&mut self, now: &Simulation<T, D>, out: &mut [T]) -> Result<(), StopError> {
        let mut bad = None;
        self.sight.show(now, |view| {
            for (to, function) in out.iter_mut().zip(self.functions) {
                *to = T::from_f64(function.code.evaluate(view));
                bad = bad.or((!to.is_finite()).then_some(&function.name));
            }
        })?;
        bad.map_or(Ok(()), |name| {
            let message = format!("output `{name}` is code, and gives no finite number").into();
            let hint = "change the function, or end the run before".into();
            Err(StopError::Observer { code: "output-not-finite", message, hint })
        })
    }
}

//! Steps from instant to instant, and who watches them.

use super::ladder::Instants;
use crate::interrupt::Interrupt;
use crate::simulation::Simulation;
use crate::stop::StopError;
use mbs_core::Real;
use mbs_core::control::Accepted;

/// What a run does.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Signal {
    pub(crate) instants: Instants,
    /// Steps between two instants, where their length is fixed.
    pub(crate) between: Option<u64>,
}

/// Watches a run; does nothing by default.
pub(crate) trait Watcher<T: Real, const D: usize> {
    /// A step was made; `is_last`: it ends the run. Says whether to go on.
    ///
    /// # Errors
    /// What stops the run.
    fn step(
        &mut self,
        simulation: &Simulation<T, D>,
        accepted: &Accepted<T>,
        is_last: bool,
    ) -> Result<bool, StopError> {
        let _ = (simulation, accepted, is_last);
        Ok(true)
    }

    /// An instant is reached. Says whether to go on.
    ///
    /// # Errors
    /// What stops the run.
    fn instant(&mut self, simulation: &Simulation<T, D>) -> Result<bool, StopError> {
        let _ = simulation;
        Ok(true)
    }
}

impl<T: Real, const D: usize> Watcher<T, D> for () {}

/// A watcher of a run that is asked to end between two steps.
struct Interruptible<'a, W> {
    watcher: &'a mut W,
    interrupt: &'a Interrupt,
}

impl<T: Real, const D: usize, W: Watcher<T, D>> Watcher<T, D> for Interruptible<'_, W> {
    fn step(
        &mut self,
        simulation: &Simulation<T, D>,
        accepted: &Accepted<T>,
        is_last: bool,
    ) -> Result<bool, StopError> {
        let goes_on = self.watcher.step(simulation, accepted, is_last)?;
        if self.interrupt.is_set() { Err(StopError::Interrupted) } else { Ok(goes_on) }
    }

    fn instant(&mut self, simulation: &Simulation<T, D>) -> Result<bool, StopError> {
        self.watcher.instant(simulation)
    }
}

/// Steps a simulation from its start over all instants, or until it is interrupted.
///
/// # Errors
/// Why it stopped.
pub(crate) fn drive<T: Real, const D: usize>(
    simulation: &mut Simulation<T, D>,
    (course, interrupt): (&Signal, &Interrupt),
    watcher: &mut impl Watcher<T, D>,
) -> Result<(), StopError> {
    for k in 0..course.instants.count {
        let is_last = k + 1 == course.instants.count;
        let watcher = &mut Interruptible { watcher, interrupt };
        let goes_on = match course.between {
            Some(n) => fixed(simulation, (course.instants, n), k, watcher)?,
            None => {
                let end = T::from_f64(course.instants.time(k + 1));
                controlled(simulation, end, is_last, watcher)?
            }
        };
        if !goes_on || !watcher.instant(simulation)? {
            return Ok(());
        }
    }
    Ok(())
}

/// The steps of fixed length after instant `k`. Says whether to go on.
fn fixed<T: Real, const D: usize>(
    simulation: &mut Simulation<T, D>,
    (instants, n): (Instants, u64),
    k: usize,
    watcher: &mut impl Watcher<T, D>,
) -> Result<bool, StopError> {
    #[allow(clippy::cast_precision_loss, reason = "counts stay far below 2^53")]
    let float = |n: u64| n as f64;
    let h = instants.interval / float(n);
    let dt = T::from_f64(h);
    let end = instants.time(k + 1);
    for j in 1..=n {
        let accepted = simulation.advance(dt).map_err(|error| simulation.explain(error))?;
        let t = if j == n { end } else { instants.time(k) + float(j) * h };
        simulation.set_time(T::from_f64(t));
        if !watcher.step(simulation, &accepted, j == n && k + 1 == instants.count)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Steps of controlled length up to `end` [s]. An integrator that controls its own takes them within one. Says
/// whether to go on.
fn controlled<T: Real, const D: usize>(
    simulation: &mut Simulation<T, D>,
    end: T,
    is_last: bool,
    watcher: &mut impl Watcher<T, D>,
) -> Result<bool, StopError> {
    loop {
        let rest = end - simulation.state().t;
        if rest <= T::ZERO {
            simulation.set_time(end);
            return Ok(true);
        }
        let accepted = simulation.advance(rest).map_err(|error| simulation.explain(error))?;
        if accepted.is_last {
            simulation.set_time(end);
        }
        let goes_on = watcher.step(simulation, &accepted, is_last && accepted.is_last)?;
        if accepted.is_last || !goes_on {
            return Ok(goes_on);
        }
    }
}

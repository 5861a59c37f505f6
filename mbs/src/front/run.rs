//! The two functions that run a mechanism.

use super::conflict::RunConflict;
use super::mechanism::Mechanism;
use super::options::{Run, Watchers};
use super::prepared::PreparedRun;
use super::result::RunResult;
use crate::erased::SimulationError;

/// Runs a mechanism to the end of its duration. A run that stops early is no error: its result has a [`stop`](RunResult::stop).
///
/// # Errors
/// [`SimulationError`] for a mechanism, a method or options that are refused. A goal and an estimate are refused here: use `mbs_study::run`.
///
/// # Examples
/// ```
/// use mbs::{Body, GROUND, Joint, Mechanism, Run, run};
/// let mut m = Mechanism::planar("pendulum");
/// m.set_gravity([0.0, -9.81]);
/// let bob = m.add(Body::planar([1.0, 0.0], 1.0, 0.0));
/// m.add(Joint::revolute([GROUND, bob], [0.0, 0.0]).named("pivot"));
/// let result = run(&m, &Run::new().duration(1.0))?;
/// let angle = result.table().column("pivot").unwrap().last().unwrap();
/// // let go at the horizontal, the bob has turned by -2.9758 rad after 1 s
/// assert!((angle + 2.9758).abs() < 1e-4 && result.stop().is_none());
/// # Ok::<(), mbs::SimulationError>(())
/// ```
pub fn run(m: &Mechanism, options: &Run) -> Result<RunResult, SimulationError> {
    run_with(m, options, &mut Watchers::default())
}

/// Runs a mechanism as [`run`] does, with watchers.
///
/// With an observer or an output that is code, the run follows the revolutions of all joints. A joint that turns by more than half a
/// revolution in one step then stops the run. Without them, only joints that the run reads can stop it so.
///
/// # Errors
/// Those of [`run`].
pub fn run_with(
    m: &Mechanism,
    options: &Run,
    watchers: &mut Watchers<'_, '_>,
) -> Result<RunResult, SimulationError> {
    if options.goal.is_some() || options.estimate {
        return Err(RunConflict::Study.into());
    }
    PreparedRun::new(m, options)?.run(watchers)
}

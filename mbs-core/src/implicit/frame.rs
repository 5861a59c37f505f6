//! Frame of an implicit step in natural coordinates: the checks, inputs and reports around the equations of a formulation.
//!
//! ```text
//! check options, take inputs, rule  ->  formulation: predict, iterate, project  ->  check rotations and lines, update state, report
//! ```

use super::{InputResponse, StepEnd, check_lines, check_rotations, take_inputs};
use crate::Real;
use crate::integrator::{Integrator, Rule};
use crate::model::{Model, State, Terms};
use crate::step::{OptionError, Step, StepError, StepReport, Stop};

/// Scratch memory of the implicit steps of one crate. Its formulations differ only in their equations.
pub trait StepScratch<T: Real>: InputResponse<T> {
    /// Checks the options of a step. Returns their integrator, and whether coordinates are summed with compensation.
    ///
    /// # Errors
    /// [`OptionError`] names the option.
    fn checked(options: &Self::Options) -> Result<(&Integrator<T>, bool), OptionError>;

    /// End of the step, and the terms as last evaluated there.
    fn reached(&self) -> (&StepEnd<T>, &Terms<T>);

    /// Copies the finished step into the state. `unit` converts multipliers of the iteration to multipliers of the equations of motion.
    fn commit<M: Model<T>>(&mut self, model: &M, how: (&Rule<T>, bool, T), s: &mut State<T>);

    /// Returns the report of the step.
    fn report(&mut self, newton: (u32, T, Stop), violation: [T; 3]) -> StepReport<T>;
}

/// Result of solving the equations of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solved<T> {
    /// Number of iterations, the last correction [m or -], and the reason of the end.
    pub newton: (u32, T, Stop),
    /// Largest |phi|, |phi'|, |phi''| after the projections [m, m/s, m/s^2].
    pub violation: [T; 3],
    /// Factor from multipliers of the iteration to multipliers of the equations of motion.
    pub unit: T,
}

/// Advances `s` by one [`Step`]. `solve` computes the end of the step by the rule; its first argument also has the scene's length [m].
///
/// # Errors
/// [`StepError`]; [`take_inputs`] may then have changed the state, but nothing else has.
#[inline]
pub fn step<T: Real, M: Model<T>, W: StepScratch<T>>(
    model: &M,
    step: Step<T>,
    options: &W::Options,
    s: &mut State<T>,
    w: &mut W,
    solve: impl FnOnce((&Rule<T>, T), &State<T>, &mut W) -> Result<Solved<T>, StepError>,
) -> Result<StepReport<T>, StepError> {
    let Step { dt, length } = step.checked()?;
    let (integrator, compensated) = W::checked(options)?;
    take_inputs(model, options, s, w)?;
    let rule = integrator.rule(dt);
    let Solved { newton, violation, unit } = solve((&rule, length), s, w)?;
    let (end, terms) = w.reached();
    check_rotations(model, terms)?;
    check_lines(model, s, &end.dq)?;
    w.commit(model, (&rule, compensated, unit), s);
    Ok(w.report(newton, violation))
}

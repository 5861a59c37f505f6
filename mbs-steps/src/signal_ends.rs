//! Steps that end at jumps and corners of signals.
//!
//! A step towards a jump ends shortly before the jump, so that no trial step evaluates the signal after the jump. Then the time is set to a
//! value shortly after the jump. Positions and velocities are unchanged, and accelerations jump. At a corner accelerations do not jump.

use mbs_core::Real;
use mbs_core::formulation::Formulation;
use mbs_core::inputs::{SignalTime, SignalTimes};
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::step::{Step, StepError, StepReport};

/// Times at which steps must end because of signals. The list is empty if all signals are smooth.
#[derive(Debug, Clone)]
pub struct SignalEnds<T>(SignalTimes<T>);

/// Distance between a jump and the end of the step before it, in units of the machine precision of the time [-]. The next step begins at
/// the same distance after the jump. The distance exceeds the rounding error of the times of rows up to the thousandth period.
const BESIDE_JUMP: f64 = 32.0;
/// Largest time to a jump or a corner that is too short for a step, in units of the machine precision of the time [-]. Chosen, not tuned.
const NO_STEP: f64 = 96.0;

impl<T: Real> SignalEnds<T> {
    /// Collects the times of jumps and corners of a model's signals.
    pub fn new<const D: usize>(model: &NaturalModel<T, D>) -> Self {
        Self(model.prescribed().signal_times())
    }

    /// Returns the first jump or corner within `rest` [s] after time `t` [s], and the length of the step that ends there [s].
    pub fn ahead(&self, t: T, rest: T) -> Option<(SignalTime<T>, T)> {
        let mut after = t;
        loop {
            let ahead = self.0.after(after)?;
            let length = ahead.time - beside(&ahead) - t;
            if !(length < rest) {
                return None;
            }
            if length > T::EPSILON * ahead.time.abs() * T::from_f64(NO_STEP) {
                return Some((ahead, length));
            }
            after = ahead.time;
        }
    }

    /// Makes one step with an integrator that controls its internal steps. The step is made in parts that end at jumps and corners.
    ///
    /// # Errors
    /// [`StepError`]; the state is then the state after the last completed part.
    pub fn advance<const D: usize>(
        &self,
        (model, formulation): (&NaturalModel<T, D>, &mut dyn Formulation<T, D>),
        step: Step<T>,
        state: &mut State<T>,
    ) -> Result<(StepReport<T>, [f64; 3]), StepError> {
        let (end, mut all) = (state.t + step.dt, StepReport { steps: 0, ..StepReport::default() });
        loop {
            let left = if all.steps == 0 { step.dt } else { end - state.t };
            if all.steps > 0 && left <= T::EPSILON * end.abs() * T::from_f64(NO_STEP) {
                return Ok((all, formulation.energies(model, state)));
            }
            let ahead = self.ahead(state.t, left);
            let dt = ahead.map_or(left, |(_, length)| length);
            let (report, energies) = formulation.advance(model, Step { dt, ..step }, state)?;
            all.add(&report);
            match ahead {
                Some((at, _)) => Self::pass(&at, (model, &mut *formulation), state)?,
                None => return Ok((all, energies)),
            }
        }
    }

    /// Moves the state across a jump or a corner at the end of a step.
    ///
    /// # Errors
    /// [`StepError`] if the accelerations after a jump cannot be computed.
    pub fn pass<const D: usize>(
        at: &SignalTime<T>,
        (model, formulation): (&NaturalModel<T, D>, &mut dyn Formulation<T, D>),
        state: &mut State<T>,
    ) -> Result<(), StepError> {
        if at.is_jump {
            formulation.pass_jump(model, state, at.time + beside(at))?;
        } else {
            formulation.set_time(at.time);
            state.t = at.time;
        }
        // The multipliers have a corner here, so a length of zero prevents extrapolation across it.
        state.dt = T::ZERO;
        Ok(())
    }
}

/// Returns the distance between a signal's jump and the adjacent steps [s]; 0 at a corner.
fn beside<T: Real>(at: &SignalTime<T>) -> T {
    if at.is_jump { at.time.abs() * T::EPSILON * T::from_f64(BESIDE_JUMP) } else { T::ZERO }
}

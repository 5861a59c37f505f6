//! Jumps and corners of signals as ends of steps.
//!
//! A step to a jump ends a little before it, so that its trials see none of it. Then the state becomes that a little behind it: the
//! mechanism stays, and its accelerations jump. At a corner nothing jumps.

use mbs_core::Real;
use mbs_core::formulation::Formulation;
use mbs_core::inputs::{SignalTime, SignalTimes};
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::step::{Step, StepError, StepReport};

/// Times at which steps end for signals: none where these are smooth.
#[derive(Debug, Clone)]
pub struct SignalEnds<T>(SignalTimes<T>);

/// Distance at which a step ends before a jump of a signal, and the next begins behind it, in units of rounding of the time [-].
/// It is more than the rounding of the times of rows in the thousandth period.
const BESIDE_JUMP: f64 = 32.0;
/// Time to a jump or a corner that is no step, in the same units [-]. Chosen, not tuned.
const NO_STEP: f64 = 96.0;

impl<T: Real> SignalEnds<T> {
    /// Takes the times of a model's signals.
    pub fn new<const D: usize>(model: &NaturalModel<T, D>) -> Self {
        Self(model.prescribed().signal_times())
    }

    /// The first jump or corner within `rest` [s] from time `t` [s], and the length of the step that ends there.
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

    /// A step of a method that controls its own steps within it, in parts that end at jumps and corners.
    ///
    /// # Errors
    /// [`StepError`]; the state is then that after the last part that was made.
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

    /// Passes the end of a step that has led to it.
    ///
    /// # Errors
    /// [`StepError`] of the accelerations behind a jump.
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
        // multipliers bend here: nothing is extrapolated
        state.dt = T::ZERO;
        Ok(())
    }
}

/// Returns the distance from a signal's time at which steps end and begin [s]; 0 where it is no jump.
fn beside<T: Real>(at: &SignalTime<T>) -> T {
    if at.is_jump { at.time.abs() * T::EPSILON * T::from_f64(BESIDE_JUMP) } else { T::ZERO }
}

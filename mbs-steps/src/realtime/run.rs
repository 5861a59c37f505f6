//! Runs of a scene that a clock paces.

use super::error::PacingError;
use super::ladder::{Sought, listed};
use super::measure::measured;
use super::{Degrade, Overrun, Pace, Pacer, Pacing};
use crate::choice::StepRule;
use crate::precision::is_finer;
use crate::run::{Outcome, PacedLevel, PacedSchedule, paced};
use crate::settings::ResolvedMethod;
use crate::settings::length::SAME_LENGTH;
use core::time::Duration;
use mbs_core::Real;
use mbs_core::scene::Scene;
use mbs_realtime::Clock;

/// Runs a scene at the pace of a clock.
///
/// With [`Overrun::Degrade`] and [`Degrade::Measured`] some seconds pass before the run begins.
///
/// Cost of a period in addition to its steps: the row of outputs and some hundred operations; no allocation.
///
/// # Errors
/// [`PacingError`] for invalid pacing settings; a run that stops returns an [`Outcome`] with its error.
pub fn run<T: Real, const D: usize>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    pacing: &Pacing,
    clock: &mut dyn Clock,
) -> Result<Outcome, PacingError> {
    let (pace, track) = track::<T>(scene, settings, pacing)?;
    let sought = Sought { scene, settings, track: &track };
    let rungs = match (&pacing.degrade, pacing.overrun) {
        (Degrade::Measured, Overrun::Degrade) => measured::<T, D>(&sought)?,
        (Degrade::Listed(words), Overrun::Degrade) => listed::<T, D>(&sought, words)?,
        _ => vec![PacedLevel::default()],
    };
    let mut pacer = Pacer::new(pace, rungs.len()).map_err(|_| PacingError::Quiet)?;
    let of_levels = (&mut pacer, &rungs[..]);
    let run = paced::<T, D>(scene, settings, &track, of_levels, &mut &mut *clock);
    run.map_err(|(effect, why)| PacingError::Fixed {
        name: scene.effects[effect].name.clone(),
        why,
    })
}

/// Computes the pace, and divides simulated time into periods and steps.
fn track<T: Real>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    pacing: &Pacing,
) -> Result<(Pace, PacedSchedule<T>), PacingError> {
    let is_controlled = settings.rule != StepRule::Fixed || settings.integrator.controls_its_step();
    let lengths = settings.lengths(scene);
    let (step, exact) = if is_controlled {
        (settings.step_max, lengths.step_max)
    } else {
        (settings.step, lengths.step)
    };
    let period = pacing.period.unwrap_or(step);
    let refused = |key, value| PacingError::Time { key, value };
    let whole = time(period).filter(|time| !time.is_zero());
    let whole = whole.ok_or_else(|| refused("period", period))?;
    let awake = time(pacing.awake).filter(|time| *time <= Duration::from_secs(1));
    let awake = awake.ok_or_else(|| refused("awake", pacing.awake))?;
    let exact = match pacing.period {
        None => exact,
        Some(period) if is_finer::<T>() => {
            T::from_decimal(&format!("{period:e}")).unwrap_or(T::from_f64(period))
        }
        Some(period) => T::from_f64(period),
    };
    let of_periods = ResolvedMethod { step_max: period, ..settings.clone() };
    let track = PacedSchedule {
        period: (exact, period),
        periods: of_periods.n_steps(),
        steps: (!is_controlled).then(|| parts(period, step)),
        has_level: pacing.overrun == Overrun::Degrade,
    };
    let Pacing { overrun, quiet, .. } = *pacing;
    Ok((Pace { overrun, awake, quiet, ..Pace::every(whole) }, track))
}

/// Converts a time [s]; `None` if a clock cannot represent it.
fn time(seconds: f64) -> Option<Duration> {
    Duration::try_from_secs_f64(seconds).ok()
}

/// Number of steps of a period: the smallest number of equal steps that are not longer than `step`, within rounding errors.
pub fn parts(period: f64, step: f64) -> u32 {
    let n = (period / step * (1.0 - SAME_LENGTH)).ceil().clamp(1.0, f64::from(u32::MAX));
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is clamped")]
    let n = n as u32;
    n
}

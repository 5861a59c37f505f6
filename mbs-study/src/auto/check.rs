//! A check from the other coordinates: candidates in relative coordinates share one model, and cannot find a fault of it by their
//! agreement.

use super::estimate::{SMALL, error_of_finer};
use super::pilot::{PilotPlace, PilotSearch};
use super::trial::{Aim, Trial, TrialEnd};
use crate::compare::method::{Control, MethodCase};
use mbs::record::SecondLook;
use mbs::{FormulationKind, IntegratorKind, Precision};
use mbs_scene::format::few;

/// Compares the chosen candidate with the default formulation. Nothing where the choice is not in relative coordinates; an error says why
/// nothing is known.
pub fn check(
    search: &mut PilotSearch<'_>,
    places: &[PilotPlace],
    longest: f64,
) -> Option<Result<SecondLook, String>> {
    let chosen = &search.candidates[places.first()?.candidate];
    if !chosen.method.formulation.row().relative {
        return None;
    }
    let finest = chosen.done().rfind(|t| t.error.is_some())?;
    let (rows, error) = (finest.trial.rows.clone(), finest.error.unwrap_or_default());
    let precision = chosen.method.precision;
    Some(fine(search, precision, longest).map(|(trial, own)| {
        let apart = search.bench.distance(&rows, &trial.rows);
        // all errors are small beside a difference of models; steps that lose a chaotic motion err by more than they say (double-pendulum at
        // 1e-3)
        let differs = SMALL * apart > search.target.error.max(error).max(own);
        SecondLook { distance: apart.is_finite().then_some(apart), own_error: Some(own), differs }
    }))
}

/// A run of the default formulation in steps of half of `longest` [s], and twice its error by a run with twice the step.
///
/// Two runs and no more: of many pairs in chaotic motion, one agrees by chance (double-pendulum at 1e-3).
fn fine(
    search: &mut PilotSearch<'_>,
    precision: Precision,
    longest: f64,
) -> Result<(Trial, f64), String> {
    let method = MethodCase {
        formulation: FormulationKind::DEFAULT,
        integrator: IntegratorKind::Trapezoidal,
        control: Control::Fixed,
        precision,
    };
    let limit = search.budget();
    let mut trial = |step: f64| {
        let trial = search.bench.trial(&method, step, Aim::Rows, limit);
        match &trial.end {
            TrialEnd::Done => Ok(trial),
            TrialEnd::GivenUp => Err("it takes too long".to_owned()),
            TrialEnd::Stopped(e) | TrialEnd::NotStarted(e) => {
                Err(format!("it stops: {}", e.message))
            }
        }
    };
    let [coarse, fine] = [trial(longest)?, trial(0.5 * longest)?];
    let d = search.bench.distance(&fine.rows, &coarse.rows);
    if d <= SMALL {
        let own = 2.0 * error_of_finer(&method, &fine, &coarse, d);
        return Ok((fine, own));
    }
    Err(format!("with steps of {} s and half of that it differs by {}", few(longest), few(d)))
}

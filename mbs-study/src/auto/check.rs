//! Check of the choice in other coordinates. Candidates in relative coordinates have the same model, so their agreement cannot show a fault
//! of that model.

use super::estimate::{SMALL, error_of_finer};
use super::pilot::{PilotPlace, PilotSearch};
use super::trial::{Aim, Trial, TrialEnd};
use crate::compare::method::{Control, MethodCase};
use mbs::record::SecondLook;
use mbs::{FormulationKind, IntegratorKind, Precision};
use mbs_scene::format::few;

/// Compares the chosen candidate with the default formulation. Returns `None` if the choice is not in relative coordinates, and an error with
/// the reason if the comparison is not possible.
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
        // the models count as different only if the distance is ten times all errors: in chaotic motion errors are larger than estimated
        // (double-pendulum at 1e-3)
        let differs = SMALL * apart > search.target.error.max(error).max(own);
        SecondLook { distance: apart.is_finite().then_some(apart), own_error: Some(own), differs }
    }))
}

/// Runs the default formulation with steps of half of `longest` [s]. Returns the trial and twice its error, estimated by a run with steps of
/// twice the length.
///
/// Only two runs are compared: among many pairs of runs of a chaotic motion, one pair agrees by chance (double-pendulum at 1e-3).
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

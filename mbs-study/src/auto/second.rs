//! One look from the other coordinates: candidates in relative coordinates share one model, and cannot find a fault of it by their
//! agreement.

use super::entrant::LOST;
use super::finish::Place;
use super::race::{BUDGET, Race, SHARE};
use super::trial::{Aim, End, Time, Trial};
use crate::compare::ladder::Instants;
use crate::compare::method::{Control, MethodCase};
use mbs::FormulationKind;
use mbs::IntegratorKind;
use mbs::record::SecondLook;

/// Outputs differ by more than so many times the wanted error, beyond what the look itself errs by, where the models do.
const DIFFERS: f64 = 10.0;
/// Own errors of the look: with half the step the error of second order is a third of the difference; twice that for the order that is not
/// quite met.
const OWN: f64 = 2.0 / 3.0;

/// Compares the chosen candidate with the default formulation in steps as long as the distance of the instants, and half as long. Nothing where the choice is none in
/// relative coordinates.
pub(super) fn look(
    race: &mut Race<'_>,
    places: &[Place],
    instants: Instants,
) -> Option<SecondLook> {
    let chosen = &race.entrants[places.first()?.entrant];
    let precision = chosen.method.precision;
    if !chosen.method.formulation.row().relative {
        return None;
    }
    let best = chosen.done().rfind(|t| t.error.is_some())?;
    let (rows, error) = (best.trial.rows.clone(), best.error.unwrap_or_default());
    let method = MethodCase {
        formulation: FormulationKind::DEFAULT,
        integrator: IntegratorKind::Trapezoidal,
        control: Control::Fixed,
        precision,
    };
    let mut trial = |step: f64| -> Trial {
        race.bench.trial(&method, step, Aim::Rows, Time::strictly(SHARE * BUDGET[0]))
    };
    let [coarse, fine] = [instants.interval, 0.5 * instants.interval].map(&mut trial);
    if fine.end != End::Done {
        return None;
    }
    let apart = race.bench.distance(&rows, &fine.rows);
    let own = match coarse.end {
        End::Done => OWN * race.bench.distance(&fine.rows, &coarse.rows),
        _ => f64::INFINITY,
    };
    let is_known = own < LOST;
    let differs = is_known && apart > DIFFERS * race.wanted.error.max(error) + own;
    let finite = |x: f64| x.is_finite().then_some(x);
    Some(SecondLook { distance: finite(apart), own_error: finite(own), differs })
}

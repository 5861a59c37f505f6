//! Checks after a step that all directions are still defined. A direction is undefined for a line part of zero length, for the twist of a
//! ball joint with opposite axes, and for a disc that lies flat.

use crate::link::indexing::{Outside, at};
use crate::loads::{Load, SumLoad};
use crate::loops::index;
use crate::passes::failure::failure;
use crate::passes::kinematics;
use crate::passes::slices::{Inputs, Start, Store, TreeSlices};
use crate::rows::Row;
use crate::rows::coupled::{HAS_BALL_ANGLES, HAS_LINES};
use crate::rows::rolling::{self, is_flat};
use crate::space::Space;
use mbs_core::Real;
use mbs_core::step::StepError;

/// Checks that no part of a line has collapsed to zero length in the step of `dt` [s] from `start` to the state in `s`. Checks that no disc
/// lies flat at the end of the step.
///
/// Cost: one comparison for each loop. With lines also the places of the links at the start of the step.
///
/// # Errors
/// [`StepError::RopeCollapsed`] names the coupling and the part. [`StepError::LineCollapsed`] names the part, and has the index of the load
/// in place of the index of the effect. [`StepError::TwistOpen`] and [`StepError::Overturned`] also have the index of the load.
/// [`StepError::RollingFlat`] names the rolling.
#[inline(always)]
pub(crate) fn check_lines<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    step: (&Start<'_, T>, T),
    s: &mut Store<'_, T, S>,
) -> Result<(), StepError> {
    if rolling::IS_BUILT && !m.loops.loops.is_empty() {
        check_flat(m, s)?;
    }
    check_parts(m, inputs, step, s)
}

/// Checks that no part of a line has collapsed to zero length in the step. Discs are not checked.
#[inline(always)]
pub(crate) fn check_parts<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    step: (&Start<'_, T>, T),
    s: &mut Store<'_, T, S>,
) -> Result<(), StepError> {
    if HAS_LINES && !m.loops.couplings.points.is_empty() {
        check(m, inputs, step, s)
    } else {
        Ok(())
    }
}

fn check_flat<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &Store<'_, T, S>,
) -> Result<(), StepError> {
    for lap in m.loops.cut() {
        let Some(first) = m.loops.rows.get(lap.first as usize) else { continue };
        if !first.begins_rolling() {
            continue;
        }
        let links = lap.links.map(|link| at(s.placed, link as usize));
        let is_flat = match links {
            [Ok(body), Ok(on)] => is_flat(first, [body, on]),
            _ => Err(Outside),
        };
        if is_flat.map_err(|outside| failure(m, outside.into()))? {
            return Err(StepError::RollingFlat { rolling: lap.joint });
        }
    }
    Ok(())
}

fn check<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    (start, dt): (&Start<'_, T>, T),
    s: &mut Store<'_, T, S>,
) -> Result<(), StepError> {
    inputs.evaluate(start.t, s.guides, s.courses);
    kinematics(m.links, (start.z, start.v, s.guides), s.trial)
        .map_err(|outside| failure(m, outside.into()))?;
    inputs.evaluate(start.t + dt, s.guides, s.courses);
    let couplings = &m.loops.couplings;
    for lap in m.loops.loops.get(couplings.n_cut as usize..).unwrap_or(&[]) {
        let Some(Row::Coupled(row)) = m.loops.rows.get(lap.first as usize) else { continue };
        let part = couplings.collapsed(row, [&*s.trial, &*s.placed]);
        if let Some(part) = part.map_err(|outside| failure(m, outside.into()))? {
            return Err(StepError::RopeCollapsed { coupling: lap.joint, part: index(part) });
        }
    }
    for (number, load) in m.loads.iter().enumerate() {
        let Load::Sum(sum) = load else { continue };
        if HAS_BALL_ANGLES {
            check_twists((m, number), (sum, start), s)?;
        }
        let part = couplings.collapsed(&sum.row(), [&*s.trial, &*s.placed]);
        let Some(part) = part.map_err(|outside| failure(m, outside.into()))? else { continue };
        let is_slack = is_slack(m, inputs, (sum, start, dt), s);
        if !is_slack.map_err(|outside| failure(m, outside.into()))? {
            return Err(StepError::LineCollapsed { effect: index(number), part: index(part) });
        }
    }
    Ok(())
}

/// Checks that the twists of a sum are defined. If the law depends on whole turns, it also checks that no twist has passed a whole turn.
fn check_twists<T: Real, S: Space<T>>(
    (m, number): (&TreeSlices<'_, T, S>, usize),
    (sum, start): (&SumLoad<T>, &Start<'_, T>),
    s: &Store<'_, T, S>,
) -> Result<(), StepError> {
    let couplings = &m.loops.couplings;
    let failed = |outside: Outside| failure(m, outside.into());
    if couplings.has_open_twist(&sum.row(), s.placed).map_err(failed)? {
        return Err(StepError::TwistOpen { effect: index(number) });
    }
    let lost = couplings.lost_twist(&sum.row(), [start.z, s.z]).map_err(failed)?;
    if lost == Some(T::ZERO) {
        return Ok(());
    }
    let [now, meant] = sum.at_twists(&s.instant(m), lost.unwrap_or(T::ZERO)).map_err(failed)?;
    if lost.is_none() || now != meant {
        return Err(StepError::Overturned { effect: index(number) });
    }
    Ok(())
}

/// True if the law of a sum is one-sided and has no force at the start and at the end of the step.
fn is_slack<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    (sum, start, dt): (&SumLoad<T>, &Start<'_, T>, T),
    s: &mut Store<'_, T, S>,
) -> Result<bool, Outside> {
    let couplings = &m.loops.couplings;
    inputs.evaluate(start.t, s.guides, s.courses);
    let here = (m.links, &*s.trial, (start.z, start.v, &*s.guides));
    let before = sum.is_apart(couplings, here)?;
    inputs.evaluate(start.t + dt, s.guides, s.courses);
    let here = (m.links, &*s.placed, (&*s.z, &*s.v, &*s.guides));
    Ok(before && sum.is_apart(couplings, here)?)
}

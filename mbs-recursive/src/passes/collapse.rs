//! Checks of what has no direction left after a step: parts of ropes without length, twists of balls with opposite axes, flat discs.

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

/// Looks whether a part of a line has collapsed in the step of `dt` [s] from `start` to where the links of `s` are, and whether a disc lies
/// flat there.
///
/// Cost: without lines a comparison for each loop; with them, the places of the links at the start of the step.
///
/// # Errors
/// [`StepError::RopeCollapsed`] names coupling and part, [`StepError::LineCollapsed`] part, and the load in place of the effect,
/// as do [`StepError::TwistOpen`] and [`StepError::Overturned`]; [`StepError::RollingFlat`] names the rolling.
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

/// Looks whether a part of a line has collapsed in the step, without a look at discs.
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

/// The twists of a sum have a direction, and have not passed a whole turn where the law asks for it.
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

/// Does the law of a sum act on one side only, and neither at the start nor at the end?
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

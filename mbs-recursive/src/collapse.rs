//! What has no direction after a step: parts of ropes without length, discs that lie flat.

use crate::fault::failure;
use crate::indexing::{Outside, at};
use crate::passes::kinematics;
use crate::rolling::{IS_BUILT, is_flat};
use crate::rows::Row;
use crate::slices::{Inputs, Start, Store, TreeSlices};
use crate::space::Space;
use mbs_core::Real;
use mbs_core::step::StepError;

/// Looks whether a part of a line has collapsed in the step of `dt` [s] from `start` to where the links of `s` are, and whether a disc lies
/// flat there.
///
/// Cost: without lines a comparison for each loop; with them, the places of the links at the start of the step.
///
/// # Errors
/// [`StepError::RopeCollapsed`] names coupling and part, [`StepError::RollingFlat`] the rolling.
#[inline(always)]
pub(crate) fn check_lines<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    step: (&Start<'_, T>, T),
    s: &mut Store<'_, T, S>,
) -> Result<(), StepError> {
    if IS_BUILT && !m.loops.loops.is_empty() {
        check_flat(m, s)?;
    }
    if m.loops.couplings.points.is_empty() { Ok(()) } else { check(m, inputs, step, s) }
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
            let part = u32::try_from(part).unwrap_or(u32::MAX);
            return Err(StepError::RopeCollapsed { coupling: lap.joint, part });
        }
    }
    Ok(())
}

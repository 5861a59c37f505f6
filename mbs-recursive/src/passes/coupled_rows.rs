//! The part of couplings in what is done with all rows: each function is called where there are couplings alone.

use crate::link::indexing::{Outside, at, at_mut};
use crate::loops::index;
use crate::passes::slices::{Store, TreeSlices};
use crate::space::Space;
use mbs_core::Real;

/// Violation of a coupling that is rounding of its sum, in units of rounding of its terms [-]. Chosen, not tuned.
const SUM_ROUNDINGS: f64 = 4.0;

/// The largest number left, the row that has it, and the scale of its parts.
pub(crate) type Largest<T> = (T, u32, T);

/// Takes over a row's number if it is the largest.
#[inline(always)]
fn note<T: Real>((worst, row): (T, u32), k: usize, x: T) -> (T, u32) {
    if x.abs() <= worst { (worst, row) } else { (x.abs(), index(k)) }
}

/// Φ, Φ̇, the bias of Φ̈ and the gradients where the links are placed.
#[inline(never)]
pub(crate) fn evaluate<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'_, T, S>,
) -> Result<(), Outside> {
    for row in m.loops.coupled() {
        let here = (m.links, &*s.placed, (&*s.z, &*s.v, &*s.guides));
        let out = (&mut *s.gradient, &mut *s.loops.slopes);
        *at_mut(s.rows, row.1)? = m.loops.couplings.evaluate(row, here, Some(out))?.row;
    }
    Ok(())
}

/// J a + bias into l; the largest of all rows, with the scale of its parts.
#[inline(never)]
pub(crate) fn residual<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'_, T, S>,
    (mut worst, mut row, mut scale): Largest<T>,
) -> Result<Largest<T>, Outside> {
    for coupled in m.loops.coupled() {
        let k = coupled.1;
        let gradients = (&*s.gradient, &*s.loops.slopes);
        let [left, parts] = m.loops.couplings.along(coupled, m.links, gradients, (s.a, s.zdd))?;
        let bias = at(s.rows, k)?[2];
        let left = left + bias;
        scale = scale.max(parts + bias.abs());
        *at_mut(s.loops.l, k)? = left;
        (worst, row) = note((worst, row), k, left);
    }
    Ok((worst, row, scale))
}

/// Φ or Φ̇ at the trial state into l; the largest of all rows, with the fastest one, and whether no more is left than the share.
#[inline(never)]
pub(crate) fn violation<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    (level, share): (u8, T),
    s: &mut Store<'_, T, S>,
    ((mut worst, mut row, mut scale), mut is_within): (Largest<T>, bool),
) -> Result<(Largest<T>, bool), Outside> {
    for coupled in m.loops.coupled() {
        let here = (m.links, &*s.trial, (&*s.z, &*s.v, &*s.guides));
        let values = m.loops.couplings.evaluate(coupled, here, None)?;
        let (x, parts) = (values.row[usize::from(level > 0)], values.parts);
        let mut own = T::ONE;
        if level > 0 {
            (scale, own) = (scale.max(parts[1]), own.max(parts[1]));
        }
        *at_mut(s.loops.l, coupled.1)? = x;
        // Angles grow with every turn, and rounding of their sum with them.
        if level == 0 && x.abs() <= parts[0] * T::EPSILON * T::from_f64(SUM_ROUNDINGS) {
            continue;
        }
        is_within &= x.abs() <= share * own;
        (worst, row) = note((worst, row), coupled.1, x);
    }
    Ok(((worst, row, scale), is_within))
}

/// Φ into l and Φ̇ into the rows at the trial state; the largest |Φ| and |Φ̇| of all.
#[inline(never)]
pub(crate) fn at_trial<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'_, T, S>,
    mut largest: [T; 2],
) -> Result<[T; 2], Outside> {
    for row in m.loops.coupled() {
        let here = (m.links, &*s.trial, (&*s.z, &*s.v, &*s.guides));
        let [value, rate, _] = m.loops.couplings.evaluate(row, here, None)?.row;
        *at_mut(s.loops.l, row.1)? = value;
        at_mut(s.rows, row.1)?[1] = rate;
        largest = [largest[0].max(value.abs()), largest[1].max(rate.abs())];
    }
    Ok(largest)
}

/// J δ into l, for motions of the links in `a_response` and of the freedoms.
#[inline(never)]
pub(crate) fn along<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    delta: &[T],
    s: &mut Store<'_, T, S>,
) -> Result<(), Outside> {
    for row in m.loops.coupled() {
        let gradients = (&*s.gradient, &*s.loops.slopes);
        let motions = (&*s.a_response, delta);
        *at_mut(s.loops.l, row.1)? = m.loops.couplings.along(row, m.links, gradients, motions)?[0];
    }
    Ok(())
}

/// The largest |Φ|, |Φ̇| and |Φ̈| of all rows as last evaluated.
#[inline(never)]
pub(crate) fn violations<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &Store<'_, T, S>,
    mut largest: [T; 3],
) -> [T; 3] {
    for row in m.loops.coupled() {
        let gradients = (&*s.gradient, &*s.loops.slopes);
        let along = m.loops.couplings.along(row, m.links, gradients, (s.a, s.zdd));
        let along = along.map_or(T::ZERO, |[x, _]| x);
        let [phi, phi_d, bias] = s.rows[row.1];
        for (most, x) in largest.iter_mut().zip([phi, phi_d, along + bias]) {
            *most = most.max(x.abs());
        }
    }
    largest
}

/// −Jᵀ λ of the rows as forces on links, and as efforts along joints.
#[inline(never)]
pub(crate) fn add_forces<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'_, T, S>,
) -> Result<(), Outside> {
    for (row, k, n) in m.loops.coupled() {
        let lambda = *at(s.lambda, k)?;
        for start in m.loops.couplings.starts_of(row)? {
            let push = *at(s.gradient, start.side as usize * n + k)? * lambda;
            at_mut(s.condensed, start.link as usize)?.force += push;
        }
        for (link, _, slope) in m.loops.couplings.joints_of(row, s.loops.slopes)? {
            at_mut(s.condensed, link as usize)?.effort -= slope * lambda;
        }
    }
    Ok(())
}

//! Rotations in space, which bushings act on: the rotation vector of two links, and where its laws end, at a whole turn.
//!
//! Beyond it the half angles of a tree give the turn the other way round: the rotation vector has changed its sign.

use super::{Instant, Load, Measure};
use crate::failure::failure;
use crate::indexing::{Outside, at};
use crate::joint::{HAS_GUIDED_BALLS, guided_vector};
use crate::link::LinkKind;
use crate::slices::{Inputs, Start, Store, TreeSlices};
use crate::space::Space;
use mbs_core::Real;
use mbs_core::algebra::{Vector, norm};
use mbs_core::effects::bushing;
use mbs_core::laws::LawInputs;
use mbs_core::step::StepError;

impl<T: Real, S: Space<T>> Instant<'_, T, S> {
    /// The rotation vector of the second link against the first, in space and the first's axes. It is known
    /// below a whole turn, by twice the half angles of the joints between them.
    pub(crate) fn rotation(&self, links: [u32; 2]) -> Result<Vector<T, 3>, Outside> {
        let [[s, x, y, z], second] = [self.quaternion(links[0])?, self.quaternion(links[1])?];
        let [s, x, y, z] = product([s, -x, -y, -z], second);
        let v = Vector::<T, 3>::new(x, y, z);
        let sine = norm(&v);
        // w = θ v/|v|, tan θ/2 = |v|/s; at no turn 2 v
        let share = if sine > T::ZERO { T::TWO * sine.atan2(s) / sine } else { T::TWO };
        Ok(v * share)
    }

    /// The rotation of a link against the ground, in space, of the sign that its coordinates lead to.
    fn quaternion(&self, link: u32) -> Result<[T; 4], Outside> {
        let (mut sum, mut number) = ([T::ONE, T::ZERO, T::ZERO, T::ZERO], link);
        while number > 0 {
            let link = at(self.links, number as usize)?;
            match link.kind {
                LinkKind::Revolute | LinkKind::GuidedRevolute => {
                    let (s, c) = (self.coordinate(number)?[0] * T::HALF).sin_cos();
                    let n = S::spin_into(&link.axis) * s;
                    sum = product([c, n[0], n[1], n[2]], sum);
                }
                LinkKind::Ball | LinkKind::Free => {
                    let first = link.z as usize;
                    let mut own = sum;
                    for (i, own) in own.iter_mut().enumerate() {
                        *own = *at(self.coordinates.0, first + i)?;
                    }
                    sum = product(own, sum);
                }
                LinkKind::GuidedBall if HAS_GUIDED_BALLS => {
                    let half = guided_vector(link, self.coordinates.2)?[0] * T::HALF;
                    let (angle, (s, c)) = (norm(&half), norm(&half).sin_cos());
                    // sin(|f|/2) f/|f|; at no turn it is f/2
                    let n = if angle > T::ZERO { half * (s / angle) } else { half };
                    sum = product([c, n[0], n[1], n[2]], sum);
                }
                LinkKind::Prismatic | LinkKind::GuidedPrismatic | LinkKind::GuidedBall => {}
            }
            number = if link.kind == LinkKind::Free { 0 } else { link.parent };
        }
        Ok(sum)
    }
}

/// The product of two quaternions.
fn product<T: Real>(p: [T; 4], q: [T; 4]) -> [T; 4] {
    let ([a, b, c, d], [e, f, g, h]) = (p, q);
    [
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    ]
}

/// Looks whether a rotation has passed a whole turn in the step of `dt` [s] from `start` to (`s.z`, `s.v`).
///
/// Cost: one look at each effect; for a rotation, the half angles on the way at both ends.
///
/// # Errors
/// [`StepError::Overturned`] with the number of the load in place of the effect.
#[inline(always)]
pub(crate) fn check_rotations<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    step: (&Start<'_, T>, T),
    s: &mut Store<'_, T, S>,
) -> Result<(), StepError> {
    let is_rotation =
        |load: &Load<T, S>| matches!(load, Load::Between { gauge: Measure::Rotation { .. }, .. });
    if bushing::IS_BUILT && m.loads.iter().any(is_rotation) {
        check(m, inputs, step, s)
    } else {
        Ok(())
    }
}

fn check<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    inputs: &impl Inputs<T>,
    (start, dt): (&Start<'_, T>, T),
    s: &mut Store<'_, T, S>,
) -> Result<(), StepError> {
    for (number, load) in m.loads.iter().enumerate() {
        let Load::Between { links, gauge: Measure::Rotation { number: 0 }, .. } = load else {
            continue;
        };
        let failed = |outside: Outside| failure(m, outside.into());
        inputs.evaluate(start.t, s.guides, s.courses);
        let before = instant(m, (start.z, start.v, s.guides), s.placed);
        let before = before.rotation(*links).map_err(failed)?;
        inputs.evaluate(start.t + dt, s.guides, s.courses);
        let now = instant(m, (s.z, s.v, s.guides), s.placed).rotation(*links).map_err(failed)?;
        let [b, n] = [before, now].map(|w| w.dot(&w).sqrt());
        if before.dot(&now) < T::ZERO && b + n > T::TWO * T::PI {
            return Err(StepError::Overturned {
                effect: u32::try_from(number).unwrap_or(u32::MAX),
            });
        }
    }
    Ok(())
}

fn instant<'a, T: Real, S: Space<T>>(
    m: &'a TreeSlices<'_, T, S>,
    coordinates: (&'a [T], &'a [T], &'a [[T; 3]]),
    placed: &'a [crate::link::LinkMotion<T, S>],
) -> Instant<'a, T, S> {
    Instant {
        links: m.links,
        placed,
        coordinates,
        couplings: &m.loops.couplings,
        law_inputs: LawInputs::courses(&[]),
        base: m.base,
    }
}

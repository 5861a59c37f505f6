//! Rotation vector between two links in space, on which bushings act.

use super::Instant;
use crate::link::LinkKind;
use crate::link::indexing::{Outside, at};
use crate::link::joint::{HAS_GUIDED_BALLS, guided_vector};
use crate::space::Space;
use mbs_core::Real;
use mbs_core::algebra::{Vector, norm};

impl<T: Real, S: Space<T>> Instant<'_, T, S> {
    /// Returns the rotation vector of the second link relative to the first, in the first link's axes. It is computed from the half angles
    /// of the joints between the links. It is valid if the rotation is below a whole turn.
    pub(crate) fn rotation(&self, links: [u32; 2]) -> Result<Vector<T, 3>, Outside> {
        let [[s, x, y, z], second] = [self.quaternion(links[0])?, self.quaternion(links[1])?];
        let [s, x, y, z] = product([s, -x, -y, -z], second);
        let v = Vector::<T, 3>::new(x, y, z);
        let sine = norm(&v);
        // rotation vector w = θ v/|v| with tan θ/2 = |v|/s, from the quaternion (s, v); for v = 0 the factor is its limit 2
        let share = if sine > T::ZERO { T::TWO * sine.atan2(s) / sine } else { T::TWO };
        Ok(v * share)
    }

    /// Returns the quaternion of a link's rotation relative to the ground in space. Its sign follows from the joint coordinates.
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
                    // vector part sin(|f|/2) f/|f| for the rotation vector f of the guides; for f = 0 its limit f/2
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

/// Returns the product of two quaternions.
fn product<T: Real>(p: [T; 4], q: [T; 4]) -> [T; 4] {
    let ([a, b, c, d], [e, f, g, h]) = (p, q);
    [
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    ]
}

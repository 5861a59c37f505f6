//! Numbers between two links that scalar laws depend on, with their gradients by the links' motions.
//!
//! ```text
//! length   L = |p₂ − p₁|                       n on p₂, −n on p₁
//! along    m = (p₂ − p₁)·d₁ − m₀               d₁ on p₂, −d₁ on the first link at the same place
//! rotation wᵢ of w = log(R₁ᵀ R₂), in space      the moment R₁ ∂wᵢ on the second, minus it on the first
//! turn     θ = θ₂ − θ₁, in the plane            the unit moment on the second, minus it on the first
//! ```

use super::Instant;
use crate::link::indexing::Outside;
use crate::space::{Numbers, Space};
use mbs_core::Real;
use mbs_core::algebra::rotation_gradient;
use mbs_core::effects::bushing;
use mbs_core::laws::scalar::{Law, ScalarForce};

/// Number measured between two links, on which a law depends. A point is the vector from its link's origin, in the axes of the reference
/// configuration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Measure<T: Real, S: Space<T>> {
    /// The distance of two points.
    Length {
        /// Points on the first and the second link.
        points: [S::Point; 2],
    },
    /// The distance of two points along a direction of the first link.
    Along {
        /// Points on the first and the second link.
        points: [S::Point; 2],
        /// The direction in the first link, in the axes of the reference configuration.
        direction: S::Point,
        /// Value of the distance along the direction that counts as zero [m].
        offset: T,
    },
    /// A component of the rotation vector of the second link relative to the first, in the first link's axes. In the reference
    /// configuration these are the global axes. The coordinates of the tree determine the rotation if it is below a whole turn.
    Rotation {
        /// Index of the component, from 0.
        number: u32,
    },
    /// The angle of the second link relative to the first, in the plane. The coordinates of the tree count its whole turns.
    Turn,
}

impl<T: Real, S: Space<T>> Measure<T, S> {
    /// Evaluates the law for the measured number. Returns its force, and the wrenches on both links for a unit rate of the number.
    pub(super) fn evaluate(
        &self,
        at: &Instant<'_, T, S>,
        links: [u32; 2],
        law: &Law<T>,
    ) -> Result<(ScalarForce<T>, [S::Motion; 2]), Outside> {
        let (value, gradient) = match self {
            Self::Length { points } => {
                let (arms, gap) = between(at, links, points)?;
                let value = gap.dot(&gap).sqrt();
                // At length zero the direction is undefined, and zero is used.
                let n = if value > T::ZERO { gap * (T::ONE / value) } else { S::Point::zero() };
                (value, [-S::wrench(&arms[0], &n), S::wrench(&arms[1], &n)])
            }
            Self::Along { points, direction, offset } => {
                let (arms, gap) = between(at, links, points)?;
                let d = at.arm(links[0], direction)?;
                let gradient = [-S::wrench(&(arms[0] + gap), &d), S::wrench(&arms[1], &d)];
                (gap.dot(&d) - *offset, gradient)
            }
            Self::Rotation { number } if bushing::IS_BUILT => {
                let (w, i) = (at.rotation(links)?, *number as usize);
                let first = S::rotation_into(&at.placed(links[0])?.rotation);
                let moment = first * rotation_gradient(&w, i.min(2));
                let g = S::motion(S::spin_from(&moment), S::Point::zero());
                (*crate::link::indexing::at(w.as_slice(), i)?, [-g, g])
            }
            Self::Turn if S::DIMENSION == 2 => {
                let (mut x, mut y) = (S::Point::zero(), S::Point::zero());
                (x[0], y[1]) = (T::ONE, T::ONE);
                let g = S::motion(S::moment(&x, &y), S::Point::zero());
                (at.turn(links[1])? - at.turn(links[0])?, [-g, g])
            }
            // This build or this space does not support the measure. A model with this measure is refused when it is loaded.
            Self::Rotation { .. } | Self::Turn => return Err(Outside),
        };
        let rate = gradient[0].dot(&at.placed(links[0])?.velocity)
            + gradient[1].dot(&at.placed(links[1])?.velocity);
        Ok((law.evaluate(value, rate, &at.law_inputs), gradient))
    }
}

/// Returns the arms of two points, and the vector from the first point to the second.
#[inline]
fn between<T: Real, S: Space<T>>(
    at: &Instant<'_, T, S>,
    links: [u32; 2],
    points: &[S::Point; 2],
) -> Result<([S::Point; 2], S::Point), Outside> {
    let arms = [at.arm(links[0], &points[0])?, at.arm(links[1], &points[1])?];
    let (p, q) = (at.placed(links[0])?.position + arms[0], at.placed(links[1])?.position + arms[1]);
    Ok((arms, q - p))
}

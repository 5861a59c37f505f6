//! Forces of effects that depend linearly on accelerations within a step. Their stiffness and damping act as inertia.
//!
//! ```text
//! z̈ changes position and velocity at the end of a step by s z̈ and c z̈, with s = β h² and c = γ h, hence
//! f(z̈) = f(z̈*) + κ w·(a − a*),   κ = s ∂f/∂m + c ∂f/∂m'      w the unit wrench, a* the accelerations that f was evaluated for
//!
//! on one link, or against the ground      I += κ w wᵀ,   p += w (f − κ w·a*)
//! across a joint of one freedom           bᵀ I b += κ (w·b)²,   τ += κ (w·b)² z̈*
//! between other links                     as on one link, for each of the two
//! along a sum                             as on one link, for each of its ends
//! ```
//!
//! The first two lines (one link; one joint) are the exact linear part. In the third line (other links) the acceleration of the other link
//! is taken from the last iterate, so that an iteration remains necessary. The iteration contracts, because M + 2 κ diag(w wᵀ) − κ (w₁ −
//! w₂)(w₁ − w₂)ᵀ is positive definite. The converged accelerations do not depend on κ; only the iterates do. For friction and slip, κ uses
//! the slope of the secant.

use super::{Instant, Load, Reach};
use crate::link::ArticulatedInertia;
use crate::link::indexing::{Outside, at, at_mut};
use crate::space::{Numbers, Space};
use mbs_core::Real;

impl<T: Real, S: Space<T>> Load<T, S> {
    /// Adds the load's forces as [`apply`](Self::apply) does, and their linear dependence on accelerations. The forces were evaluated for
    /// the accelerations `zdd` of the freedoms and `a` of the links.
    ///
    /// # Errors
    /// [`Outside`] if the tables are inconsistent.
    pub fn apply_ahead(
        &self,
        here: &Instant<'_, T, S>,
        (reach, zdd, a): (Reach<T>, &[T], &[S::Motion]),
        condensed: &mut [ArticulatedInertia<T, S>],
    ) -> Result<(), Outside> {
        match self {
            Self::Between { links, gauge, law } => {
                let (mut measure, gradient) = gauge.evaluate(here, *links, law)?;
                measure.damping = law.secant(&measure);
                let Some((end, gradient_end)) = outer(here, *links, &gradient)? else {
                    for (&link, w) in links.iter().zip(gradient).filter(|(link, _)| **link > 0) {
                        let link = link as usize;
                        reach.resist(at_mut(condensed, link)?, (&w, at(a, link)?), &measure);
                    }
                    return Ok(());
                };
                for (&link, g) in links.iter().zip(gradient) {
                    at_mut(condensed, link as usize)?.force += g * measure.tension;
                }
                let arm = gradient_end.dot(&here.placed(end)?.freedom);
                let weight = reach.weight(&measure) * arm * arm;
                here.resist_joint(end, (weight, zdd), condensed)
            }
            Self::Angle { link, law } => {
                let [value, rate] = here.coordinate(*link)?;
                let mut measure = law.evaluate(value, rate, &here.law_inputs);
                measure.damping = law.secant(&measure);
                at_mut(condensed, *link as usize)?.effort -= measure.tension;
                here.resist_joint(*link, (reach.weight(&measure), zdd), condensed)
            }
            Self::BodyLoad(load) => {
                let link = load.link as usize;
                load.apply_ahead(here, (reach, at(a, link)?), at_mut(condensed, link)?)
            }
            Self::Sum(load) => load.apply_ahead(here, (reach, zdd, a), condensed),
            Self::Constant { .. } | Self::Force { .. } | Self::Torque { .. } => {
                self.apply(here, condensed)
            }
        }
    }
}

/// Finds the outer link of a pair: the link whose parent is the other link and whose joint has at most one freedom. Returns this link with
/// its unit wrench.
fn outer<T: Real, S: Space<T>>(
    here: &Instant<'_, T, S>,
    [first, second]: [u32; 2],
    gradient: &[S::Motion; 2],
) -> Result<Option<(u32, S::Motion)>, Outside> {
    let hangs = |link: u32, other: u32| {
        let own = at(here.links, link as usize)?;
        Ok(link > 0 && own.parent == other && own.kind.n_freedoms::<T, S>() <= 1)
    };
    Ok(if hangs(first, second)? {
        Some((first, gradient[0]))
    } else if hangs(second, first)? {
        Some((second, gradient[1]))
    } else {
        None
    })
}

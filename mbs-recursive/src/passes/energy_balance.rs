//! Kinetic and potential energy, and the power of dampers, signals and guides.

use crate::link::indexing::{Outside, at};
use crate::link::{Link, LinkKind, LinkMotion};
use crate::loads::Instant;
use crate::passes::slices::{Store, TreeSlices};
use crate::passes::{inverse, rotor};
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// Returns the kinetic energy ½ Σ Zᵀ M Z over all links, with velocity Z and mass matrix M of a link [J].
pub fn kinetic<T: Real, S: Space<T>>(links: &[Link<T, S>], placed: &[LinkMotion<T, S>]) -> T {
    let mut twice = T::ZERO;
    for (link, p) in links.iter().zip(placed).skip(1) {
        let inertia = S::body_inertia(link.mass, &p.center, &link.tensor, &p.rotation);
        twice += p.velocity.dot(&S::times(&inertia, &p.velocity));
    }
    twice * T::HALF
}

/// Returns the potential energy of gravity, springs and constant forces [J].
///
/// # Errors
/// [`Outside`] if the tables are inconsistent.
pub fn potential<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    at: &Instant<'_, T, S>,
) -> Result<T, Outside> {
    let mut energy = T::ZERO;
    for (link, p) in m.links.iter().zip(at.placed).skip(1) {
        energy -= m.gravity.dot(&(p.position + p.center + m.base)) * link.mass;
    }
    for load in m.loads {
        energy += load.potential(at)?;
    }
    Ok(energy)
}

/// Returns the power of non-conservative forces and of guides at the positions, accelerations and multipliers in the store [W].
///
/// # Errors
/// [`Outside`] if the tables are inconsistent.
pub fn power<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'_, T, S>,
) -> Result<T, Outside> {
    let mut power = T::ZERO;
    for load in m.loads {
        power += load.power(&s.instant(m))?;
    }
    if m.links.iter().skip(1).any(|link| link.kind.is_guided()) {
        inverse::forces(m, s)?;
        rotor::add_efforts(m, (s.zdd, s.guides), s.condensed)?;
        for (i, link) in m.links.iter().enumerate().skip(1) {
            if link.kind.is_guided() {
                let mut effort = [T::ZERO];
                inverse::effort(link, at(s.placed, i)?, at(s.condensed, i)?, &mut effort)?;
                power += match link.kind {
                    LinkKind::GuidedBall => effort[0],
                    _ => effort[0] * at(s.guides, link.v as usize)?[1],
                };
            }
        }
    }
    // power of −Jᵀ λ of a guided coupling, where J v = s'
    for (row, k, _) in m.loops.coupled() {
        if let Some([_, rate, _]) = s.guides.get(row.guide as usize) {
            power -= *at(s.lambda, k)? * *rate * row.inverse;
        }
    }
    Ok(power)
}

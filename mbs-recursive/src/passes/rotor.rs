//! Rotors that turn with a joint's coordinate. A rotor adds an inertia to the diagonal entry of the joint.
//!
//! ```text
//! D += I        τ += I z̈,   E = ½ I ż²          I: the rotor's inertia times the square of its ratio
//! ```

use crate::link::indexing::{Outside, at, at_mut};
use crate::link::{ArticulatedInertia, Link, LinkRotor};
use crate::passes::slices::TreeSlices;
use crate::space::Space;
use mbs_core::Real;

/// True if this build supports rotors.
pub const IS_BUILT: bool = cfg!(feature = "rotors");

/// Returns the rotors; a build without rotors returns an empty slice.
#[inline(always)]
fn built<T>(rotors: &[LinkRotor<T>]) -> &[LinkRotor<T>] {
    if IS_BUILT { rotors } else { &[] }
}

/// Adds the rotors' inertias to the resistances of the joints.
#[inline]
pub(crate) fn resist<T: Real, S: Space<T>>(
    rotors: &[LinkRotor<T>],
    condensed: &mut [ArticulatedInertia<T, S>],
) -> Result<(), Outside> {
    for rotor in built(rotors) {
        at_mut(condensed, rotor.link as usize)?.resistance += rotor.inertia;
    }
    Ok(())
}

/// Adds the inertia forces of the rotors to the efforts along their joints, for accelerations `zdd` of the freedoms.
pub(crate) fn add_efforts<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    (zdd, guides): (&[T], &[[T; 3]]),
    condensed: &mut [ArticulatedInertia<T, S>],
) -> Result<(), Outside> {
    for rotor in built(m.rotors) {
        let acceleration = of_link(m.links, rotor.link, zdd, (guides, 2))?;
        at_mut(condensed, rotor.link as usize)?.effort -= rotor.inertia * acceleration;
    }
    Ok(())
}

/// Returns the entry of a link's freedom in `numbers`. For a guided link it returns a derivative of the guide; `derivative` is its order.
pub(crate) fn of_link<T: Real, S: Space<T>>(
    links: &[Link<T, S>],
    link: u32,
    numbers: &[T],
    (guides, derivative): (&[[T; 3]], usize),
) -> Result<T, Outside> {
    let link = at(links, link as usize)?;
    if link.kind.is_guided() {
        return Ok(*at(at(guides, link.v as usize)?, derivative)?);
    }
    Ok(*at(numbers, link.v as usize)?)
}

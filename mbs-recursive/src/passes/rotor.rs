//! Rotors that turn with a joint's coordinate: an inertia on the diagonal of the joint's own block.
//!
//! ```text
//! D += I        τ += I z̈,   E = ½ I ż²          I: the rotor's inertia times the square of its ratio
//! ```

use crate::link::indexing::{Outside, at, at_mut};
use crate::link::{ArticulatedInertia, Link, LinkRotor};
use crate::passes::slices::TreeSlices;
use crate::space::Space;
use mbs_core::Real;

/// Are rotors in this build?
pub const IS_BUILT: bool = cfg!(feature = "rotors");

/// Returns the rotors; none in a build without them.
#[inline(always)]
fn built<T>(rotors: &[LinkRotor<T>]) -> &[LinkRotor<T>] {
    if IS_BUILT { rotors } else { &[] }
}

/// Adds the rotors' inertias to what resists the joints.
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

/// Adds what the rotors' inertias do along their joints at accelerations `zdd` of the freedoms, as an effect's effort.
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

/// The number of a link's coordinate among those of the freedoms; of a guided one that derivative of its guide.
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

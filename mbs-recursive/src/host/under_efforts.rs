//! Accelerations under given efforts along the freedoms.

use crate::link::indexing::{Outside, at, at_mut};
use crate::link::joint::read;
use crate::link::options::Options;
use crate::link::{ArticulatedInertia, Link, LinkKind, LinkMotion};
use crate::loops::Fault;
use crate::passes::evaluate::{Level, begin, finish};
use crate::passes::slices::{Store, TreeSlices};
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// Evaluates the accelerations under given efforts along the freedoms and under gravity.
pub(crate) fn accelerations_under<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    options: &Options<T>,
    (level, efforts): (Level, &[T]),
    s: &mut Store<'_, T, S>,
) -> Result<T, Fault<T>> {
    let mut condensed = begin(m, s)?;
    for load in m.loads {
        load.apply(&s.instant(m), condensed)?;
    }
    add_efforts(m.links, s.placed, efforts, condensed)?;
    core::mem::swap(&mut s.condensed, &mut condensed);
    finish(m, options, level, s)
}

/// Adds efforts along the freedoms to the forces. The moment of a ball acts on its link and, with opposite sign, on its parent.
fn add_efforts<T: Real, S: Space<T>>(
    links: &[Link<T, S>],
    placed: &[LinkMotion<T, S>],
    efforts: &[T],
    condensed: &mut [ArticulatedInertia<T, S>],
) -> Result<(), Outside> {
    for (i, link) in links.iter().enumerate().skip(1) {
        let (rotation, first) = (&at(placed, i)?.rotation, link.v as usize);
        let wrench = match link.kind {
            LinkKind::Revolute | LinkKind::Prismatic => {
                at_mut(condensed, i)?.effort += *at(efforts, first)?;
                continue;
            }
            LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall => continue,
            LinkKind::Ball => {
                S::motion(S::rotate_spin(rotation, &read(efforts, first)?), S::Point::zero())
            }
            LinkKind::Free => S::motion(
                S::rotate_spin(rotation, &read(efforts, first)?),
                read(efforts, first + S::Spin::N)?,
            ),
        };
        at_mut(condensed, i)?.force -= wrench;
        if link.parent > 0 {
            at_mut(condensed, link.parent as usize)?.force += wrench;
        }
    }
    Ok(())
}

//! The mass matrix by the composite rigid body algorithm.

use super::OwnFreedoms;
use super::six::{Moments, V3};
use crate::build::TreeModel;
use crate::host::{TreeState, Workspace};
use crate::link::{Link, LinkMotion};
use crate::space::Space;
use mbs_core::Real;

impl<T: Real, S: Space<T>> OwnFreedoms<T, S> {
    /// Writes the mass matrix of the tree with open loops, by rows.
    ///
    /// Cost: an outward pass without velocities, and operations of order (number of bodies) × (depth of the tree); no allocation.
    ///
    /// # Panics
    /// If the length of `mass` is not the square of the number of freedoms.
    pub fn write_mass_matrix(
        &mut self,
        model: &TreeModel<T, S>,
        state: &TreeState<T>,
        workspace: &mut Workspace<T, S>,
        mass: &mut [T],
    ) {
        let n = self.columns.len();
        assert_eq!(mass.len(), n * n, "numbers of the mass matrix");
        self.place(model, state, workspace);
        let (links, placed) = (model.mechanism().links, workspace.store().placed);
        mass.fill(T::ZERO);
        self.write_rooted(links, placed);
        for i in (1..links.len()).rev() {
            let (before, here) = self.composite.split_at_mut(i);
            let (composite, own) = (&here[0], &self.links[i]);
            if own.parent > 0 {
                let arm = own.place - self.links[own.parent].place;
                before[own.parent] += composite.gathered(&arm);
            }
            for c in own.columns.clone() {
                let force = composite.times(&self.columns[c].here);
                let row = self.columns[c].number as usize;
                let mut put = |other: u32, x| {
                    let other = other as usize;
                    (mass[row * n + other], mass[other * n + row]) = (x, x);
                };
                for column in &self.columns[own.columns.start..=c] {
                    put(column.number, column.here.dot(&force));
                }
                let rooted = force.gathered(&own.place);
                let mut k = self.columns[own.columns.start].up;
                while let Some(column) = self.columns.get(k as usize) {
                    put(column.number, column.rooted.dot(&rooted));
                    k = column.up;
                }
            }
        }
        for rotor in model.mechanism().rotors {
            for c in self.links[rotor.link as usize].columns.clone() {
                mass[self.columns[c].number as usize * (n + 1)] += rotor.inertia;
            }
        }
    }

    /// Writes the moments of the bodies about their links' origins. Writes the columns about the origin of the first link on the path from
    /// the ground. The rounding errors of the vectors between these origins are relative to their length. They do not grow with the
    /// distance of the mechanism from the ground's origin.
    fn write_rooted(&mut self, links: &[Link<T, S>], placed: &[LinkMotion<T, S>]) {
        for (i, (link, p)) in links.iter().zip(placed).enumerate().skip(1) {
            let own = &self.links[i];
            let place = match own.parent {
                0 => V3::zeros(),
                parent => self.links[parent].place + S::point_into(&p.arm),
            };
            self.composite[i] = moments(link, p, &own.tensor);
            for c in own.columns.clone() {
                self.columns[c].rooted = self.columns[c].here.at(&-place);
            }
            self.links[i].place = place;
        }
    }
}

/// Returns the moments of a body about its link's origin.
#[inline(always)]
pub(super) fn moments<T: Real, S: Space<T>>(
    link: &Link<T, S>,
    p: &LinkMotion<T, S>,
    tensor: &[T; 6],
) -> Moments<T> {
    Moments {
        mass: link.mass,
        first: S::point_into(&p.center) * link.mass,
        second: Moments::turned(tensor, &S::rotation_into(&p.rotation)),
    }
}

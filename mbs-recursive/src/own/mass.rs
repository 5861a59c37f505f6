//! The mass matrix by composite bodies.

use super::OwnFreedoms;
use super::six::{Moments, Six, dot};
use crate::link::{Link, LinkKind, LinkMotion};
use crate::space::Space;
use crate::state::{TreeState, Workspace};
use crate::tree::TreeModel;
use mbs_core::Real;

impl<T: Real, S: Space<T>> OwnFreedoms<T, S> {
    /// Writes the mass matrix, loops being open, row by row.
    ///
    /// Cost: an outward pass without velocities, and bodies times depth; no allocation.
    ///
    /// # Panics
    /// If `mass` has not the square of the freedoms.
    pub fn write_mass_matrix(
        &mut self,
        model: &TreeModel<T, S>,
        state: &TreeState<T>,
        workspace: &mut Workspace<T, S>,
        mass: &mut [T],
    ) {
        let n = self.number.len();
        assert_eq!(mass.len(), n * n, "numbers of the mass matrix");
        self.place(model, state, workspace);
        let (links, placed) = (model.mechanism().links, workspace.store().placed);
        mass.fill(T::ZERO);
        for ((to, tensor), (link, p)) in
            self.composite.iter_mut().zip(&self.tensors).zip(links.iter().zip(&*placed)).skip(1)
        {
            *to = moments(link, p, tensor);
        }
        for i in (1..links.len()).rev() {
            let composite = self.composite[i];
            let parent = self.parent[i];
            if parent > 0 {
                self.composite[parent] += composite.gathered(&S::point_into(&placed[i].arm));
            }
            for c in self.of_link[i].clone() {
                let column = &self.columns[c];
                let force = match links[i].kind {
                    LinkKind::Revolute => composite.times_turn(&column.turn),
                    _ => composite.times(column),
                };
                self.write_column(links, placed, (i, c, force), mass);
            }
        }
        for rotor in model.mechanism().rotors {
            for c in self.of_link[rotor.link as usize].clone() {
                mass[self.number[c] as usize * (n + 1)] += rotor.inertia;
            }
        }
    }

    /// Writes what a force on a link about its origin does along the columns on the way to the ground, in a row and a column of
    /// `mass`: those of column `c` of link `i`.
    #[inline(always)]
    fn write_column(
        &self,
        links: &[Link<T, S>],
        placed: &[LinkMotion<T, S>],
        (mut i, c, mut force): (usize, usize, Six<T>),
        mass: &mut [T],
    ) {
        let (n, own) = (self.number.len(), self.number[c] as usize);
        let mut put = |k: usize, x: T| {
            let other = self.number[k] as usize;
            (mass[own * n + other], mass[other * n + own]) = (x, x);
        };
        for k in self.of_link[i].start..=c {
            put(k, self.columns[k].dot(&force));
        }
        while self.parent[i] > 0 {
            force = force.gathered(&S::point_into(&placed[i].arm));
            i = self.parent[i];
            for k in self.of_link[i].clone() {
                let column = &self.columns[k];
                put(
                    k,
                    match links[i].kind {
                        LinkKind::Revolute => dot(&column.turn, &force.turn),
                        LinkKind::Prismatic => dot(&column.push, &force.push),
                        _ => column.dot(&force),
                    },
                );
            }
        }
    }
}

/// A body about its link's origin.
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

//! Whole turns at the start. The assembly counts whole turns of the angles that effects measure. The tree adds these turns to its
//! coordinates.
//!
//! The coordinate of a joint starts at the value nearest to its given value. The angle of a free link comes from its rotation matrix,
//! within half a turn. An angle between a free link and another link may therefore lack whole turns. The natural state stores these turns.

use crate::build::TreeModel;
use crate::build::own_tables::own;
use crate::host::state::TreeState;
use crate::link::{Link, LinkKind};
use crate::loads::{Instant, Load, Measure};
use crate::space::{Numbers, Space};
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::laws::LawInputs;
use mbs_core::model::State;
use mbs_core::natural::{NaturalModel, unwrap};
use mbs_core::scene::Scene;

/// Groups of links whose relative turns are known. The name of a group is the index of the free link at its root, or 0 for the ground.
struct Groups {
    /// Group of each root link.
    of: Vec<u32>,
}

impl Groups {
    fn of(&self, root: u32) -> u32 {
        self.of[root as usize]
    }

    /// Joins two groups of links. The joined group has the name of the first group.
    fn join(&mut self, [first, second]: [u32; 2]) {
        self.of.iter_mut().filter(|of| **of == second).for_each(|of| *of = first);
    }
}

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Adds whole turns to the coordinates. The natural state stores these turns for couplings and effects.
    pub(crate) fn take_turns<const D: usize>(
        &self,
        scene: &Scene<T>,
        natural: &NaturalModel<T, D>,
        from: &State<T>,
        state: &mut TreeState<T>,
    ) {
        self.take_coupled_turns(scene, natural, from, state);
        #[allow(clippy::cast_possible_truncation, reason = "links are numbered by u32")]
        let mut groups = Groups { of: (0..self.links.len() as u32).collect() };
        for (load, &effect) in self.loads.iter().zip(&self.effects) {
            let Some(place) = natural.memory_of_effect(effect) else { continue };
            match load {
                Load::Angle { link, .. } => {
                    let whole = unwrap(T::ZERO, from.memory[place] - self.coordinate(state, *link));
                    if !self.links[*link as usize].kind.is_guided() {
                        state.z[self.links[*link as usize].z as usize] += whole;
                    }
                }
                Load::Between {
                    links,
                    gauge: Measure::Turn | Measure::Rotation { number: 0 },
                    ..
                } => {
                    let whole = self.missing(state, *links, &from.memory[place..]);
                    let roots = links.map(|link| groups.of(self.root(link)));
                    if roots[0] == roots[1] {
                        continue;
                    }
                    // The ground cannot turn, so the other group turns.
                    let (roots, whole) =
                        if roots[1] == 0 { ([0, roots[0]], -whole) } else { (roots, whole) };
                    if whole != T::ZERO {
                        let turned = (0..self.links.len()).filter(|&l| groups.of[l] == roots[1]);
                        turned.for_each(|l| turn(&self.links[l], whole, &mut state.z));
                    }
                    groups.join(roots);
                }
                _ => {}
            }
        }
    }

    fn take_coupled_turns<const D: usize>(
        &self,
        scene: &Scene<T>,
        natural: &NaturalModel<T, D>,
        from: &State<T>,
        state: &mut TreeState<T>,
    ) {
        if natural.coupled_angles().next().is_none() {
            return;
        }
        let links = self.coordinate_links(scene);
        for ((joint, number), sign, place) in natural.coupled_angles() {
            let link = links[joint][number].filter(|&i| !self.links[i as usize].kind.is_guided());
            if let Some(link) = link {
                let last = from.memory[place] * sign - self.coordinate(state, link);
                state.z[self.links[link as usize].z as usize] += unwrap(T::ZERO, last);
            }
        }
    }

    /// Returns the free link at the root of a link's branch; 0 if the branch starts at the ground.
    fn root(&self, mut link: u32) -> u32 {
        while link > 0 && self.links[link as usize].kind != LinkKind::Free {
            link = self.links[link as usize].parent;
        }
        link
    }

    /// Returns the whole turns [rad] that the rotation of the second link relative to the first lacks, compared with the rotation stored in
    /// `last`.
    fn missing(&self, state: &TreeState<T>, links: [u32; 2], last: &[T]) -> T {
        if S::DIMENSION == 2 {
            return unwrap(T::ZERO, last[0] - self.turn_of(state, links));
        }
        let w = self.with_angles(state, |at| own(at.rotation(links)));
        let gap = (0..3).map(|i| (w[i] - last[i]) * (w[i] - last[i])).fold(T::ZERO, |a, x| a + x);
        if gap.sqrt() > T::PI { T::TWO * T::PI } else { T::ZERO }
    }

    /// Returns the angle of the second link relative to the first in the plane, including whole turns [rad].
    pub(crate) fn turn_of(&self, state: &TreeState<T>, links: [u32; 2]) -> T {
        self.with_angles(state, |at| own(at.turn(links[1])) - own(at.turn(links[0])))
    }

    /// Calls `f` with an instant that has coordinates only; the places of the links are not set.
    fn with_angles<R>(&self, state: &TreeState<T>, f: impl FnOnce(&Instant<'_, T, S>) -> R) -> R {
        let mut guides = vec![[T::ZERO; 3]; self.prescribed.n_guides()];
        let mut signals = vec![[T::ZERO; 3]; self.prescribed.signals().len()];
        self.prescribed.write(state.t, &state.applied, &mut guides, &mut signals);
        f(&Instant {
            links: &self.links,
            placed: &[],
            coordinates: (&state.z, &state.v, &guides),
            couplings: &self.couplings.slices(self.tables.codes()),
            law_inputs: LawInputs::courses(&[]),
            base: S::Point::zero(),
        })
    }
}

/// Turns a free link by whole turns [rad]: changes its angle in the plane, or the sign of its quaternion in space.
fn turn<T: Real, S: Space<T>>(link: &Link<T, S>, whole: T, z: &mut [T]) {
    let first = link.z as usize;
    match (link.kind, S::DIMENSION) {
        (LinkKind::Free, 2) => z[first] += whole,
        (LinkKind::Free, _) => z[first..][..4].iter_mut().for_each(|x| *x = -*x),
        _ => {}
    }
}

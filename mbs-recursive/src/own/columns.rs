//! Columns of the freedoms: the list of the columns, and their values at a position.

use super::six::{Moments, Six, V3};
use crate::build::TreeModel;
use crate::build::own_tables::own;
use crate::host::{TreeState, Workspace};
use crate::link::indexing::{Outside, at, at_mut};
use crate::link::{Link, LinkKind, LinkMotion, joint};
use crate::loops::index;
use crate::passes::slices::TreeSlices;
use crate::space::{Numbers, Space};
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;
use mbs_core::Real;
use mbs_core::algebra::Vector;

/// Column index that means no column.
pub(super) const NONE: u32 = u32::MAX;

/// Indices of a link's freedoms in the order of the joints, and the points about which a free joint's freedoms are defined.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkFreedoms<T: Real> {
    /// Index of the link's first translational freedom. It is not used for a joint without such freedoms.
    pub moves: usize,
    /// Index of the link's first rotational freedom, or of the only freedom of its joint.
    pub turns: usize,
    /// True if the freedom is the motion of the parent relative to the child.
    pub is_reversed: bool,
    /// Point of a free joint on the ground, from the tree's base [m].
    pub point: Vector<T, 3>,
    /// Point of a free joint on the body, from the link's origin, in the axes of the reference configuration [m].
    pub reference: Vector<T, 3>,
}

/// A part of a joint whose columns are of one kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PartKind {
    /// A joint with one freedom.
    Single,
    /// Rotations about axes fixed in the child.
    ChildBall,
    /// Rotations about axes fixed in the parent.
    ParentBall,
    /// Slides along axes fixed in the parent.
    ParentSlides,
    /// Slides along axes fixed in the child.
    ChildSlides,
}

/// Adjacent columns of one kind.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ColumnPart<T: Real> {
    pub(super) link: usize,
    pub(super) kind: PartKind,
    pub(super) columns: Range<usize>,
    /// True if the motion is relative to the ground, as for a free joint.
    pub(super) is_free: bool,
    pub(super) point: V3<T>,
    pub(super) reference: V3<T>,
}

/// Column of a freedom at a position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Column<T: Real> {
    /// Index of the freedom in the order of the joints.
    pub(super) number: u32,
    /// Index of the next column on the path to the ground.
    pub(super) up: u32,
    /// Column about the origin of its link.
    pub(super) here: Six<T>,
    /// Column about the origin of the first link on the path from the ground.
    pub(super) rooted: Six<T>,
}

/// Data of a link that its columns need, stored together.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct OwnLink<T: Real> {
    /// Vector from the origin of the first link on the path from the ground to the origin of this link [m].
    pub(super) place: V3<T>,
    /// Index of the parent link; for a free link the ground.
    pub(super) parent: usize,
    pub(super) columns: Range<usize>,
    /// Range of the parts of the link's joint.
    pub(super) parts: Range<usize>,
    /// Inertia tensor of the link about its origin in reference axes: xx, xy, xz, yy, yz, zz.
    pub(super) tensor: [T; 6],
}

/// The freedoms of a tree in the order and with the signs of the joints, with scratch for matrices over these freedoms.
#[derive(Debug, Clone)]
pub struct OwnFreedoms<T: Real, S: Space<T>> {
    pub(super) parts: Vec<ColumnPart<T>>,
    pub(super) columns: Vec<Column<T>>,
    /// For each column: indices of the columns on its path to the ground, the nearest first. Empty before the first factorisation.
    pub(super) above: Vec<Vec<u32>>,
    /// For each column: indices of the columns whose path to the ground contains it. Empty before the first factorisation.
    pub(super) below: Vec<Vec<u32>>,
    /// For each column: range from the smallest to the largest index among the entries of `above`, the entries of `below` and the column
    /// itself. Empty before the first factorisation.
    pub(super) related: Vec<Range<usize>>,
    /// Data of the links, beginning with the ground.
    pub(super) links: Vec<OwnLink<T>>,
    /// Links on the path from the ground to the link that was placed last.
    pub(super) way: Vec<usize>,
    pub(super) composite: Vec<Moments<T>>,
    /// Scratch for a row of a solution.
    pub(super) row: Vec<T>,
    /// Smallest allowed pivot of each freedom.
    pub(super) least: Vec<T>,
    space: core::marker::PhantomData<S>,
}

impl<T: Real, S: Space<T>> OwnFreedoms<T, S> {
    /// Makes the tree's freedoms with the indices of `places`, which has one entry for each link. Guided links have no freedoms.
    ///
    /// # Panics
    /// If the length of `places` is not the number of links, including the ground.
    #[must_use]
    pub fn new(model: &TreeModel<T, S>, places: &[LinkFreedoms<T>]) -> Self {
        let links = model.mechanism().links;
        assert_eq!(places.len(), links.len(), "places and links");
        let mut made = Self {
            parts: Vec::new(),
            columns: Vec::with_capacity(model.n_freedoms()),
            above: Vec::new(),
            below: Vec::new(),
            related: Vec::new(),
            links: Vec::with_capacity(links.len()),
            way: Vec::with_capacity(links.len()),
            composite: vec![Moments::zero(); links.len()],
            row: Vec::new(),
            least: vec![T::ZERO; model.n_freedoms()],
            space: core::marker::PhantomData,
        };
        let mut last = vec![NONE; links.len()];
        for (i, (link, place)) in links.iter().zip(places).enumerate() {
            let is_free = link.kind == LinkKind::Free;
            let parent = if is_free { 0 } else { link.parent as usize };
            let (first, first_part) = (made.columns.len(), made.parts.len());
            let before = last[parent];
            for (kind, numbers) in parts::<T, S>(link.kind, place) {
                let columns = made.columns.len()..made.columns.len() + numbers.len();
                for number in numbers {
                    let up = made.columns.len().checked_sub(1).filter(|&c| c >= first);
                    let (number, up) = (index(number), up.map_or(before, index));
                    made.columns.push(Column {
                        number,
                        up,
                        here: Six::zero(),
                        rooted: Six::zero(),
                    });
                }
                let (point, reference) = (place.point, place.reference);
                made.parts.push(ColumnPart { link: i, kind, columns, is_free, point, reference });
            }
            made.links.push(OwnLink {
                place: V3::zeros(),
                parent,
                columns: first..made.columns.len(),
                parts: first_part..made.parts.len(),
                tensor: tensor::<T, S>(&link.tensor),
            });
            last[i] =
                if made.columns.len() > first { index(made.columns.len() - 1) } else { before };
        }
        made
    }

    /// Makes the tree's freedoms in the order of its states.
    #[must_use]
    pub fn of_tree(model: &TreeModel<T, S>) -> Self {
        let links = model.mechanism().links.iter();
        let place = |link: &Link<T, S>| {
            let (first, zero) = (link.v as usize, V3::zeros());
            let moves = first + S::Spin::N;
            LinkFreedoms { moves, turns: first, is_reversed: false, point: zero, reference: zero }
        };
        Self::new(model, &links.map(place).collect::<Vec<_>>())
    }

    /// Computes the places of the links at a state, without velocities, and writes the columns.
    pub(super) fn place(
        &mut self,
        model: &TreeModel<T, S>,
        state: &TreeState<T>,
        workspace: &mut Workspace<T, S>,
    ) {
        let m = model.mechanism();
        let s = workspace.store();
        model.prescribed().write(state.t, &state.applied, s.guides, s.courses);
        own(positions(m.links, 1..m.links.len(), (&state.z, &state.v, s.guides), s.placed));
        self.write_columns(&m, s.placed);
    }

    /// Computes the places of only the links on the path from a link to the ground at a state, and writes their columns. Writes these links
    /// to `self.way`, beginning at the ground.
    pub(super) fn place_way(
        &mut self,
        model: &TreeModel<T, S>,
        (state, mut link): (&TreeState<T>, usize),
        workspace: &mut Workspace<T, S>,
    ) {
        self.way.clear();
        while link > 0 {
            self.way.push(link);
            link = self.links[link].parent;
        }
        self.way.reverse();
        let m = model.mechanism();
        let s = workspace.store();
        model.prescribed().write(state.t, &state.applied, s.guides, s.courses);
        own(positions(m.links, self.way.iter().copied(), (&state.z, &state.v, s.guides), s.placed));
        for i in 0..self.way.len() {
            self.write_columns_of(&m, self.links[self.way[i]].parts.clone(), s.placed);
        }
    }

    /// Writes all columns for the current places of the links.
    pub(super) fn write_columns(&mut self, m: &TreeSlices<'_, T, S>, placed: &[LinkMotion<T, S>]) {
        self.write_columns_of(m, 0..self.parts.len(), placed);
    }

    /// Writes the columns of some parts for the current places of the links.
    #[inline]
    fn write_columns_of(
        &mut self,
        m: &TreeSlices<'_, T, S>,
        parts: Range<usize>,
        placed: &[LinkMotion<T, S>],
    ) {
        for part in &self.parts[parts] {
            let columns = &mut self.columns[part.columns.clone()];
            let p = &placed[part.link];
            if part.kind == PartKind::Single {
                columns[0].here = six::<T, S>(&p.freedom);
                continue;
            }
            let parent = &placed[m.links[part.link].parent as usize].rotation;
            for (column, here) in columns.iter_mut().zip(part.columns::<S>((p, parent))) {
                column.here = here;
            }
        }
    }
}

impl<T: Real> ColumnPart<T> {
    /// Returns the columns of a ball joint or of slides, about the link's origin.
    fn columns<S: Space<T>>(
        &self,
        (p, parent): (&LinkMotion<T, S>, &S::Rotation),
    ) -> impl Iterator<Item = Six<T>> + use<T, S> {
        let is_turn = matches!(self.kind, PartKind::ChildBall | PartKind::ParentBall);
        let (of_child, of_parent) = (&p.rotation, parent);
        // the point about which the part rotates, its axes, and its sign
        let (point, axes, sense) = match self.kind {
            PartKind::ChildBall => {
                let s = S::rotate(of_child, &S::point_from(&self.reference));
                (S::point_into(&s), of_child, T::ONE)
            }
            PartKind::ParentBall if self.is_free => {
                (self.point - S::point_into(&p.position), of_parent, -T::ONE)
            }
            PartKind::ParentBall => (V3::zeros(), of_parent, -T::ONE),
            PartKind::ChildSlides => (V3::zeros(), of_child, -T::ONE),
            PartKind::ParentSlides | PartKind::Single => (V3::zeros(), of_parent, T::ONE),
        };
        let axes = S::rotation_into(axes);
        // in the plane only the rotation about the normal exists
        let first = if is_turn { 3 - S::Spin::N } else { 0 };
        (first..3).map(move |k| {
            let n = V3::new(axes[(0, k)], axes[(1, k)], axes[(2, k)]) * sense;
            if is_turn {
                // motion of a rotation about n at the point s: (n, s × n)
                Six { turn: n, push: mbs_core::algebra::cross(&point, &n) }
            } else {
                Six { turn: V3::zeros(), push: n }
            }
        })
    }
}

/// Returns the parts of a link's joint, from the parent outward, with the indices of their columns.
fn parts<T: Real, S: Space<T>>(
    kind: LinkKind,
    place: &LinkFreedoms<T>,
) -> impl Iterator<Item = (PartKind, Range<usize>)> + use<T, S> {
    let turns = place.turns..place.turns + S::Spin::N;
    let moves = place.moves..place.moves + S::Point::N;
    let parts = match (kind, place.is_reversed) {
        (LinkKind::Revolute | LinkKind::Prismatic, _) => {
            [Some((PartKind::Single, place.turns..place.turns + 1)), None]
        }
        (LinkKind::Ball, false) => [Some((PartKind::ChildBall, turns)), None],
        (LinkKind::Ball, true) => [Some((PartKind::ParentBall, turns)), None],
        (LinkKind::Free, false) => {
            [Some((PartKind::ParentSlides, moves)), Some((PartKind::ChildBall, turns))]
        }
        (LinkKind::Free, true) => {
            [Some((PartKind::ParentBall, turns)), Some((PartKind::ChildSlides, moves))]
        }
        (LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall, _) => {
            [None, None]
        }
    };
    parts.into_iter().flatten()
}

/// Returns a motion of the plane or of space as a three-dimensional motion.
#[inline(always)]
pub(super) fn six<T: Real, S: Space<T>>(motion: &S::Motion) -> Six<T> {
    Six { turn: S::spin_into(&S::spin(motion)), push: S::point_into(&S::point(motion)) }
}

/// Returns the entries of a tensor in reference axes. In the plane only the entry about the normal is not zero.
fn tensor<T: Real, S: Space<T>>(tensor: &S::Tensor) -> [T; 6] {
    let inertia = S::body_inertia(T::ZERO, &S::Point::zero(), tensor, &S::identity());
    let column = |k: usize| {
        let mut e = V3::zeros();
        e[k] = T::ONE;
        S::spin_into(&S::turning_block(&inertia, &S::spin_from(&e)))
    };
    let [x, y, z] = [column(0), column(1), column(2)];
    [x[0], y[0], z[0], y[1], z[1], z[2]]
}

/// Computes the places of some links, each after its parent. Velocities and velocity products are not changed.
///
/// # Errors
/// [`Outside`] if the tables are inconsistent.
#[inline]
fn positions<T: Real, S: Space<T>>(
    links: &[Link<T, S>],
    some: impl Iterator<Item = usize>,
    (z, v, guides): (&[T], &[T], &[[T; 3]]),
    placed: &mut [LinkMotion<T, S>],
) -> Result<(), Outside> {
    for i in some {
        let link = at(links, i)?;
        let parent = at(placed, link.parent as usize)?;
        let here = joint::place::<T, S, false>(link, parent, z, v, guides)?;
        let p = at_mut(placed, i)?;
        (p.rotation, p.position, p.arm) = (here.rotation, here.position, here.arm);
        (p.freedom, p.center) = (here.freedom, here.center);
    }
    Ok(())
}

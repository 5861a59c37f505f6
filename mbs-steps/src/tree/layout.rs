//! Transformation between the coordinates of the joints (q, v) and the coordinates of the links (z, w).
//!
//! ```text
//! a ball, second body against the first      q = quaternion,   v = ω in the second body's axes
//! a free joint                               q = (x, quaternion), v = (ẋ, ω); x from the first body's point in its axes
//! the links' own, child against parent       z = (quaternion, c), w = (ω, ċ), ω in the child's axes, c the centre of a free body
//!
//! p = c + s, s = R r      forward   x = p − P          ẋ = ċ + ω × s
//!                         reversed  x = Rᵀ (P − p)     ẋ = −ω × x − Rᵀ ṗ,   ω of q = −R ω
//! ```
//!
//! P and p are the attachment points on the first and the second body. r is the arm from c to p in the reference configuration, and R is
//! the rotation. v = B w, where B depends on the position. v̇ = B ẇ + b with a bias b, and efforts transform with the transposes. For all
//! other joints both coordinates are equal, or of opposite sign for a reversed joint.

use super::{TreeError, TreeErrorKind};
use mbs_core::algebra::{Matrix, Vector, cross, rotation_vector};
use mbs_core::scene::{JointId, Scene};
use mbs_recursive::own::LinkFreedoms;
use mbs_recursive::space::{Numbers, Space};
use mbs_recursive::{JointLinks, TreeModel};
use std::ops::Range;

type V3 = Vector<f64, 3>;
/// Linear and angular part of a velocity, an acceleration, or a force with its moment.
type Pair = [V3; 2];

/// Coordinates of one joint or free body, and their index ranges.
#[derive(Debug, Clone)]
struct Place {
    own: TreeRange,
    /// Index of the joint in the scene, and index of a body that it carries; `None` for a body without a joint.
    of: (Option<usize>, usize),
    /// True for a free body, with or without a free joint in the scene.
    is_free: bool,
}

/// Coordinate of a joint with one freedom.
#[derive(Debug, Clone, Copy)]
struct Single {
    link: u32,
    q: u32,
    z: u32,
    /// Index of the coordinate's rate in v and in w.
    at: [u32; 2],
}

/// The coordinates of a ball joint or of a free joint.
#[derive(Debug, Clone)]
struct Turning {
    own: TreeRange,
    link: usize,
    /// Index of its first coordinate in z.
    z: usize,
    /// Index of the first translation and of the first rotation, in v and in w.
    at: [[usize; 2]; 2],
    /// Number of translations among the coordinates.
    n: usize,
    pose: Pose,
}

/// Pose of a ball joint or of a free joint at the current state.
#[derive(Debug, Clone)]
struct Pose {
    is_reversed: bool,
    /// Attachment point P, relative to the origin of the base.
    point: V3,
    /// Arm r in the reference configuration.
    reference: V3,
    rotation: Matrix<f64, 3>,
    /// Arm s = R r at the current rotation.
    arm: V3,
    /// Vector x between the two attachment points.
    gap: V3,
}

impl Pose {
    fn turn(&mut self, rotation: Matrix<f64, 3>) {
        (self.rotation, self.arm) = (rotation, rotation * self.reference);
    }

    /// Computes v = B w, from link velocities w to joint velocities v.
    fn outward(&self, [linear, spin]: Pair) -> Pair {
        let turning = self.rotation * spin;
        let linear = linear + cross(&turning, &self.arm);
        if !self.is_reversed {
            return [linear, spin];
        }
        [-(cross(&spin, &self.gap) + self.rotation.transpose() * linear), -turning]
    }

    /// Computes w = B⁻¹ v, from joint velocities v to link velocities w.
    fn inward(&self, [linear, spin]: Pair) -> Pair {
        let (linear, spin) = if self.is_reversed {
            let spin = -(self.rotation.transpose() * spin);
            (-(self.rotation * (linear + cross(&spin, &self.gap))), spin)
        } else {
            (linear, spin)
        };
        [linear - cross(&(self.rotation * spin), &self.arm), spin]
    }

    /// Transforms efforts along v to efforts along w: Bᵀ f.
    fn forces_inward(&self, [force, moment]: Pair) -> Pair {
        let back = self.rotation.transpose();
        if !self.is_reversed {
            return [force, moment + back * cross(&self.arm, &force)];
        }
        let turned = -(self.rotation * force);
        let moment = back * (cross(&self.arm, &turned) - moment);
        [turned, moment - cross(&self.gap, &force)]
    }

    /// Transforms efforts along w to efforts along v: B⁻ᵀ f.
    fn forces_outward(&self, [force, moment]: Pair) -> Pair {
        let back = self.rotation.transpose();
        let moment = moment - back * cross(&self.arm, &force);
        if !self.is_reversed {
            return [force, moment];
        }
        let force = -(back * force);
        [force, -(self.rotation * (moment + cross(&self.gap, &force)))]
    }

    /// Computes the bias b of v̇ = B ẇ + b at the velocities v and w.
    fn bias(&self, [[linear, _], [_, spin]]: [Pair; 2]) -> V3 {
        let turning = self.rotation * spin;
        let central = cross(&turning, &cross(&turning, &self.arm));
        if !self.is_reversed {
            return central;
        }
        let carried = linear * 2.0 + cross(&spin, &self.gap);
        -(cross(&spin, &carried) + self.rotation.transpose() * central)
    }
}

/// Layout of each joint's coordinates in q, v, z and w.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    places: Vec<Place>,
    singles: Vec<Single>,
    turning: Vec<Turning>,
    /// Number of coordinates of a rotation in q, and in v.
    turns: [usize; 2],
    rotation: fn(&[f64]) -> Matrix<f64, 3>,
    /// Function that changes the coordinates of a rotation by a rotation vector in body axes.
    advance: fn(&mut [f64], &[f64]),
    /// Number of coordinates in q and in v.
    pub n: [usize; 2],
}

/// Index that selects v, or efforts along v, in a pair.
const OWN: usize = 0;
/// Index that selects w, or efforts along w, in a pair.
const TREE: usize = 1;

impl Layout {
    /// Creates the layout of a scene. Coordinates have the order of the scene's joints. Free bodies without a joint follow.
    pub(super) fn new<S: Space<f64>>(scene: &Scene<f64>, model: &TreeModel<f64, S>) -> Self {
        let turns = [S::FREE - S::Point::N, S::Spin::N];
        let rotation = |z: &[f64]| S::rotation_into(&S::turned_by(&S::identity(), z));
        let mut joints: Vec<_> = model.joint_links().collect();
        joints.sort_by_key(|joint| (joint.joint.is_none(), joint.joint, joint.body));
        let advance = S::advance_rotation;
        let (places, singles, turning) = (Vec::new(), Vec::new(), Vec::new());
        let mut layout = Self { places, singles, turning, turns, rotation, advance, n: [0; 2] };
        joints.iter().for_each(|joint| layout.add(scene, model, joint));
        layout
    }

    fn add<S: Space<f64>>(
        &mut self,
        scene: &Scene<f64>,
        model: &TreeModel<f64, S>,
        joint: &JointLinks<f64>,
    ) {
        let (m, zero) = (model.mechanism(), V3::zeros());
        let mut links: Vec<usize> = joint.links.clone().collect();
        if joint.is_reversed {
            links.reverse();
        }
        for (i, link) in links.into_iter().map(|i| (i, &m.links[i])) {
            if link.kind.is_guided() {
                continue;
            }
            let ([q, v], w) = (self.n, link.v as usize);
            self.n[0] += link.kind.n_coordinates::<f64, S>();
            self.n[1] += link.kind.n_freedoms::<f64, S>();
            let own = TreeRange { q: q..self.n[0], v: v..self.n[1] };
            self.places.push(Place {
                own: own.clone(),
                of: (joint.joint, joint.body),
                is_free: joint.joint.is_none_or(|joint| scene.joints[joint].kind.is_free()),
            });
            if own.v.len() == 1 {
                let [i, q, z, v, w] = [i, q, link.z as usize, v, w].map(index);
                self.singles.push(Single { link: i, q, z, at: [v, w] });
                continue;
            }
            let n = own.v.len() - self.turns[1];
            let origin = V3::from(joint.origin);
            let point = joint.joint.map_or(origin, |j| V3::from(scene.joints[j].points[0]));
            let pose = Pose {
                is_reversed: joint.is_reversed,
                point: point - S::point_into(&m.base),
                reference: if n > 0 { point - origin } else { zero },
                rotation: Matrix::<f64, 3>::identity(),
                arm: zero,
                gap: zero,
            };
            let at = [[v, v + n], [w + self.turns[1], w]];
            self.turning.push(Turning { own, link: i, z: link.z as usize, at, n, pose });
        }
    }

    /// Returns the freedoms of each link, including the ground, with their indices.
    pub(super) fn freedoms(&self, n_links: usize) -> Vec<LinkFreedoms<f64>> {
        let zero = V3::zeros();
        let none =
            LinkFreedoms { moves: 0, turns: 0, is_reversed: false, point: zero, reference: zero };
        let mut links = vec![none; n_links + 1];
        for single in &self.singles {
            links[single.link as usize].turns = single.at[OWN] as usize;
        }
        for Turning { link, at, pose, .. } in &self.turning {
            let [moves, turns] = at[OWN];
            let &Pose { is_reversed, point, reference, .. } = pose;
            links[*link] = LinkFreedoms { moves, turns, is_reversed, point, reference };
        }
        links
    }

    /// Returns the index range of the coordinates of a joint of the tree; `None` for a guided joint.
    pub(super) fn range(&self, joint: usize) -> Option<TreeRange> {
        self.range_of(|place| place.of.0 == Some(joint))
    }

    /// Index range from the first to the last of the selected places; `None` if no place is selected.
    fn range_of(&self, is_own: impl Fn(&Place) -> bool) -> Option<TreeRange> {
        let mut own = self.places.iter().filter(|place| is_own(place));
        let first = own.next()?.own.clone();
        let last = own.next_back().map_or(&first, |place| &place.own).clone();
        Some(TreeRange { q: first.q.start..last.q.end, v: first.v.start..last.v.end })
    }

    /// Returns the index range in q of each joint's angles and displacements; quaternions are excluded.
    pub(super) fn numbers(&self) -> impl Iterator<Item = (JointId, Range<usize>)> + '_ {
        let mut joints: Vec<usize> = self.places.iter().filter_map(|place| place.of.0).collect();
        joints.dedup();
        joints.into_iter().filter_map(|joint| {
            let TreeRange { q, v } = self.range(joint)?;
            (q.len() == v.len()).then(|| (JointId::new(joint), q))
        })
    }

    /// Returns the index range of the coordinates of a free body.
    pub(super) fn range_of_free(&self, body: usize) -> Option<TreeRange> {
        self.range_of(|place| place.is_free && place.of.1 == body)
    }

    /// Scales quaternions to unit length.
    ///
    /// # Errors
    /// [`TreeErrorKind::NoRotation`] for a quaternion of zero length; nothing is changed then.
    pub(super) fn normalise(&self, from: &[f64], q: &mut [f64]) -> Result<(), TreeError> {
        self.rotations(from)?;
        q.copy_from_slice(from);
        for at in self.quaternions() {
            let length = length(&q[at.clone()]);
            q[at].iter_mut().for_each(|x| *x /= length);
        }
        Ok(())
    }

    /// Checks that no quaternion has zero length.
    ///
    /// # Errors
    /// [`TreeErrorKind::NoRotation`] for a quaternion of zero length.
    pub(super) fn rotations(&self, q: &[f64]) -> Result<(), TreeError> {
        match self.quaternions().find(|at| !(length(&q[at.clone()]) > f64::MIN_POSITIVE)) {
            Some(at) => Err(TreeErrorKind::NoRotation(at.start).into()),
            None => Ok(()),
        }
    }

    /// Returns the index ranges of quaternions in q.
    fn quaternions(&self) -> impl Iterator<Item = Range<usize>> {
        let ends = self.turning.iter().map(|turning| turning.own.q.end);
        ends.map(|end| end - self.turns[0]..end).filter(|at| at.len() == 4)
    }

    /// Computes q ⊕ δ, the coordinates after a step δ along the velocities.
    pub(super) fn integrate(&self, step: &[f64], q: &mut [f64]) {
        for single in &self.singles {
            q[single.q as usize] += step[single.at[OWN] as usize];
        }
        for turning in &self.turning {
            let (step, q) = (&step[turning.own.v.clone()], &mut q[turning.own.q.clone()]);
            q[..turning.n].iter_mut().zip(step).for_each(|(q, step)| *q += step);
            (self.advance)(&mut q[turning.n..], &step[turning.n..]);
        }
    }

    /// Computes the step δ from one position to another, such that `from` ⊕ δ = `to`. Rotations take the shorter way.
    pub(super) fn difference(&self, from: &[f64], to: &[f64], step: &mut [f64]) {
        for single in &self.singles {
            let q = single.q as usize;
            step[single.at[OWN] as usize] = to[q] - from[q];
        }
        for turning in &self.turning {
            let (step, n) = (&mut step[turning.own.v.clone()], turning.n);
            let (from, to) = (&from[turning.own.q.clone()], &to[turning.own.q.clone()]);
            let pairs = step.iter_mut().zip(to.iter().zip(from));
            pairs.for_each(|(step, (to, from))| *step = to - from);
            if to.len() > step.len() {
                let relative = (self.rotation)(&from[n..]).transpose() * (self.rotation)(&to[n..]);
                put(&rotation_vector(&relative), &mut step[n..]);
            }
        }
    }

    /// Computes z, the coordinates of the links, from q.
    pub(super) fn coordinates_inward(&mut self, q: &[f64], z: &mut [f64]) {
        for single in &self.singles {
            z[single.z as usize] = q[single.q as usize];
        }
        for Turning { own, z: first, n, pose, .. } in &mut self.turning {
            let (own, z) = (&q[own.q.clone()], &mut z[*first..]);
            let ((gap, turn), (to, center)) = (own.split_at(*n), z.split_at_mut(self.turns[0]));
            invert(turn, pose.is_reversed, to);
            pose.turn((self.rotation)(to));
            pose.gap = vector(gap);
            let moved = if pose.is_reversed { -(pose.rotation * pose.gap) } else { pose.gap };
            put(&(pose.point + moved - pose.arm), &mut center[..*n]);
        }
    }

    /// Computes q from z, the coordinates of the links.
    pub(super) fn coordinates_outward(&mut self, z: &[f64], q: &mut [f64]) {
        for single in &self.singles {
            q[single.q as usize] = z[single.z as usize];
        }
        for Turning { own, z: first, n, pose, .. } in &mut self.turning {
            let (own, z) = (&mut q[own.q.clone()], &z[*first..]);
            let ((gap, turn), (from, center)) = (own.split_at_mut(*n), z.split_at(self.turns[0]));
            invert(from, pose.is_reversed, turn);
            pose.turn((self.rotation)(from));
            let moved = vector(&center[..*n]) + pose.arm - pose.point;
            let back = -(pose.rotation.transpose() * moved);
            pose.gap = if pose.is_reversed { back } else { moved };
            put(&pose.gap, gap);
        }
    }

    pub(super) fn velocities_inward(&self, v: &[f64], w: &mut [f64]) {
        self.map([OWN, TREE], (v, w), |joint, pair| joint.pose.inward(pair));
    }
    pub(super) fn velocities_outward(&self, w: &[f64], v: &mut [f64]) {
        self.map([TREE, OWN], (w, v), |joint, pair| joint.pose.outward(pair));
    }
    /// Computes ẇ from v̇ at the velocities v and w.
    pub(super) fn accelerations_inward(
        &self,
        velocities: [&[f64]; 2],
        (own, tree): (&[f64], &mut [f64]),
    ) {
        self.map([OWN, TREE], (own, tree), |joint, [linear, spin]| {
            joint.pose.inward([linear - joint.bias(self.turns[1], velocities), spin])
        });
    }
    /// Computes v̇ from ẇ at the velocities v and w.
    pub(super) fn accelerations_outward(
        &self,
        velocities: [&[f64]; 2],
        (tree, own): (&[f64], &mut [f64]),
    ) {
        self.map([TREE, OWN], (tree, own), |joint, pair| {
            let [linear, spin] = joint.pose.outward(pair);
            [linear + joint.bias(self.turns[1], velocities), spin]
        });
    }
    pub(super) fn efforts_inward(&self, own: &[f64], tree: &mut [f64]) {
        self.map([OWN, TREE], (own, tree), |joint, pair| joint.pose.forces_inward(pair));
    }
    pub(super) fn efforts_outward(&self, tree: &[f64], own: &mut [f64]) {
        self.map([TREE, OWN], (tree, own), |joint, pair| joint.pose.forces_outward(pair));
    }

    fn map(
        &self,
        [from, to]: [usize; 2],
        (x, out): (&[f64], &mut [f64]),
        map: impl Fn(&Turning, Pair) -> Pair,
    ) {
        for single in &self.singles {
            out[single.at[to] as usize] = x[single.at[from] as usize];
        }
        for place in &self.turning {
            let ([moves, turns], n_turns) = (place.at[to], self.turns[1]);
            let [linear, spin] = map(place, place.pair(from, n_turns, x));
            put(&linear, &mut out[moves..][..place.n]);
            out[turns..][..n_turns].copy_from_slice(&spin.as_slice()[3 - n_turns..]);
        }
    }
}

impl Turning {
    /// Computes the bias b of v̇ = B ẇ + b at the velocities v and w.
    fn bias(&self, turns: usize, [v, w]: [&[f64]; 2]) -> V3 {
        self.pose.bias([self.pair(OWN, turns, v), self.pair(TREE, turns, w)])
    }

    /// Returns the joint's components of v or w as vectors; a single angular component is about z.
    fn pair(&self, side: usize, turns: usize, x: &[f64]) -> Pair {
        let [moving, turning] = self.at[side];
        let mut spin = V3::zeros();
        spin.as_mut_slice()[3 - turns..].copy_from_slice(&x[turning..][..turns]);
        let linear = x.get(moving..).map_or_else(V3::zeros, |x| vector(&x[..self.n]));
        [linear, spin]
    }
}

/// Converts an index to the integer type of the tables.
#[allow(clippy::cast_possible_truncation, reason = "trees have fewer freedoms than 2^32")]
fn index(i: usize) -> u32 {
    i as u32
}

/// Euclidean length of a quaternion.
fn length(q: &[f64]) -> f64 {
    q.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Vector with the given first components; its remaining components are zero.
fn vector(x: &[f64]) -> V3 {
    V3::from_fn(|i, _| x.get(i).copied().unwrap_or(0.0))
}

/// Copies the first components of a vector, as many as `to` has.
fn put(x: &V3, to: &mut [f64]) {
    to.copy_from_slice(&x.as_slice()[..to.len()]);
}

/// Copies an angle or a quaternion. For a reversed joint it is inverted.
fn invert(from: &[f64], is_reversed: bool, to: &mut [f64]) {
    to.copy_from_slice(from);
    if is_reversed {
        to[usize::from(from.len() == 4)..].iter_mut().for_each(|x| *x = -*x);
    }
}

/// Index ranges of the coordinates of a joint or of a free body.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct TreeRange {
    /// Index range in the coordinates.
    pub q: Range<usize>,
    /// Index range in the velocities, accelerations and efforts.
    pub v: Range<usize>,
}

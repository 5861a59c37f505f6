//! Coordinates in the joints' own order and sense, against those of the links.
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
//! v = B w with B of the present position; v̇ = B ẇ + b, efforts go by the transposes. All other joints are in the same sense either way.

use super::{TreeError, TreeErrorKind};
use mbs_core::algebra::{Matrix, Vector, cross, rotation_vector};
use mbs_core::scene::Scene;
use mbs_recursive::own::LinkFreedoms;
use mbs_recursive::space::{Numbers, Space};
use mbs_recursive::{JointLinks, TreeModel};
use std::ops::Range;

type V3 = Vector<f64, 3>;
/// What moves and what turns: a velocity, an acceleration, or a force with its moment.
type Pair = [V3; 2];

/// One coordinate, or those of a rotation.
#[derive(Debug, Clone)]
struct Place {
    own: TreeRange,
    /// The link that has it.
    link: usize,
    /// First of its numbers in z.
    z: usize,
    /// First of what moves and of what turns, in v and in w.
    at: [[usize; 2]; 2],
    /// How many numbers move.
    n: usize,
    /// The joint of the scene, and a body that it carries.
    of: (Option<usize>, usize),
    /// Does nothing hold the body?
    is_free: bool,
    pose: Option<Box<Pose>>,
}

/// A ball or a free joint at the present state.
#[derive(Debug, Clone)]
struct Pose {
    is_reversed: bool,
    /// P, from the base.
    point: V3,
    /// r.
    reference: V3,
    rotation: Matrix<f64, 3>,
    /// s.
    arm: V3,
    /// x.
    gap: V3,
    /// b.
    bias: V3,
}

impl Pose {
    fn turn(&mut self, rotation: Matrix<f64, 3>) {
        (self.rotation, self.arm) = (rotation, rotation * self.reference);
    }

    /// v = B w.
    fn outward(&self, [linear, spin]: Pair) -> Pair {
        let turning = self.rotation * spin;
        let linear = linear + cross(&turning, &self.arm);
        if !self.is_reversed {
            return [linear, spin];
        }
        [-(cross(&spin, &self.gap) + self.rotation.transpose() * linear), -turning]
    }

    /// w = B⁻¹ v.
    fn inward(&self, [linear, spin]: Pair) -> Pair {
        let (linear, spin) = if self.is_reversed {
            let spin = -(self.rotation.transpose() * spin);
            (-(self.rotation * (linear + cross(&spin, &self.gap))), spin)
        } else {
            (linear, spin)
        };
        [linear - cross(&(self.rotation * spin), &self.arm), spin]
    }

    /// b at the velocities v and w.
    fn set_bias(&mut self, [[linear, _], [_, spin]]: [Pair; 2]) {
        let turning = self.rotation * spin;
        let central = cross(&turning, &cross(&turning, &self.arm));
        self.bias = if self.is_reversed {
            let carried = linear * 2.0 + cross(&spin, &self.gap);
            -(cross(&spin, &carried) + self.rotation.transpose() * central)
        } else {
            central
        };
    }
}

/// Where each joint's numbers stand.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    places: Vec<Place>,
    /// Numbers of a rotation in q and in v.
    turns: [usize; 2],
    rotation: fn(&[f64]) -> Matrix<f64, 3>,
    /// Moves the coordinates of a rotation by a rotation vector in its own axes.
    advance: fn(&mut [f64], &[f64]),
    /// Numbers in q and in v.
    pub(super) n: [usize; 2],
}

/// Place of v, or of efforts along v.
const OWN: usize = 0;
/// Place of w.
const TREE: usize = 1;

impl Layout {
    /// Coordinates in the order of the scene's joints; bodies that no joint holds stand behind them.
    pub(super) fn new<S: Space<f64>>(scene: &Scene<f64>, model: &TreeModel<f64, S>) -> Self {
        let turns = [S::FREE - S::Point::N, S::Spin::N];
        let rotation = |z: &[f64]| S::rotation_into(&S::turned_by(&S::identity(), z));
        let mut joints: Vec<_> = model.joint_links().collect();
        joints.sort_by_key(|joint| (joint.joint.is_none(), joint.joint, joint.body));
        let advance = S::advance_rotation;
        let mut layout = Self { places: Vec::new(), turns, rotation, advance, n: [0; 2] };
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
            let is_rotation = self.n[1] > v + 1;
            let n = if is_rotation { self.n[1] - v - self.turns[1] } else { 0 };
            let origin = V3::from(joint.origin);
            let point = joint.joint.map_or(origin, |j| V3::from(scene.joints[j].points[0]));
            let pose = Pose {
                is_reversed: joint.is_reversed,
                point: point - S::point_into(&m.base),
                reference: if n > 0 { point - origin } else { zero },
                rotation: Matrix::<f64, 3>::identity(),
                arm: zero,
                gap: zero,
                bias: zero,
            };
            self.places.push(Place {
                own: TreeRange { q: q..self.n[0], v: v..self.n[1] },
                link: i,
                z: link.z as usize,
                at: [[v, v + n], [w + self.turns[1], w]],
                n,
                of: (joint.joint, joint.body),
                is_free: joint.joint.is_none_or(|joint| scene.joints[joint].kind.is_free()),
                pose: is_rotation.then(|| Box::new(pose)),
            });
        }
    }

    /// Where the freedoms of each link stand, the ground's among them.
    pub(super) fn freedoms(&self, n_links: usize) -> Vec<LinkFreedoms<f64>> {
        let zero = V3::zeros();
        let none =
            LinkFreedoms { moves: 0, turns: 0, is_reversed: false, point: zero, reference: zero };
        let mut links = vec![none; n_links + 1];
        for place in &self.places {
            let [moves, turns] = place.at[OWN];
            let pose = place.pose.as_ref();
            links[place.link] = LinkFreedoms {
                moves,
                turns,
                is_reversed: pose.is_some_and(|pose| pose.is_reversed),
                point: pose.map_or(zero, |pose| pose.point),
                reference: pose.map_or(zero, |pose| pose.reference),
            };
        }
        links
    }

    /// Where the numbers of a joint of the tree stand; nothing for a guided one.
    pub(super) fn range(&self, joint: usize) -> Option<TreeRange> {
        self.range_of(|place| place.of.0 == Some(joint))
    }

    /// From the first of some places to the last.
    fn range_of(&self, is_own: impl Fn(&Place) -> bool) -> Option<TreeRange> {
        let mut own = self.places.iter().filter(|place| is_own(place));
        let first = own.next()?.own.clone();
        let last = own.next_back().map_or(&first, |place| &place.own).clone();
        Some(TreeRange { q: first.q.start..last.q.end, v: first.v.start..last.v.end })
    }

    /// Where the numbers of a free body stand.
    pub(super) fn range_of_free(&self, body: usize) -> Option<TreeRange> {
        self.range_of(|place| place.is_free && place.of.1 == body)
    }

    /// Makes quaternions unit.
    ///
    /// # Errors
    /// [`TreeErrorKind::NoRotation`] for one without length; nothing is changed then.
    pub(super) fn normalise(&self, from: &[f64], q: &mut [f64]) -> Result<(), TreeError> {
        self.rotations(from)?;
        q.copy_from_slice(from);
        for at in self.quaternions() {
            let length = length(&q[at.clone()]);
            q[at].iter_mut().for_each(|x| *x /= length);
        }
        Ok(())
    }

    /// Refuses quaternions without length.
    ///
    /// # Errors
    /// [`TreeErrorKind::NoRotation`].
    pub(super) fn rotations(&self, q: &[f64]) -> Result<(), TreeError> {
        match self.quaternions().find(|at| !(length(&q[at.clone()]) > f64::MIN_POSITIVE)) {
            Some(at) => Err(TreeErrorKind::NoRotation(at.start).into()),
            None => Ok(()),
        }
    }

    /// Where quaternions stand in q.
    fn quaternions(&self) -> impl Iterator<Item = Range<usize>> {
        let rotations = self.places.iter().filter(|place| place.pose.is_some());
        let rotations = rotations.map(|place| place.own.q.end - self.turns[0]..place.own.q.end);
        rotations.filter(|at| at.len() == 4)
    }

    /// q ⊕ δ, δ along the velocities.
    pub(super) fn integrate(&self, step: &[f64], q: &mut [f64]) {
        for place in &self.places {
            let (step, q) = (&step[place.own.v.clone()], &mut q[place.own.q.clone()]);
            let n = step.len() - if place.pose.is_some() { self.turns[1] } else { 0 };
            q[..n].iter_mut().zip(step).for_each(|(q, step)| *q += step);
            if place.pose.is_some() {
                (self.advance)(&mut q[n..], &step[n..]);
            }
        }
    }

    /// The δ with which `from` ⊕ δ is `to`; rotations by the shorter way.
    pub(super) fn difference(&self, from: &[f64], to: &[f64], step: &mut [f64]) {
        for place in &self.places {
            let step = &mut step[place.own.v.clone()];
            let (from, to) = (&from[place.own.q.clone()], &to[place.own.q.clone()]);
            step.iter_mut()
                .zip(to.iter().zip(from))
                .for_each(|(step, (to, from))| *step = to - from);
            if to.len() > step.len() {
                let n = step.len() - self.turns[1];
                let relative = (self.rotation)(&from[n..]).transpose() * (self.rotation)(&to[n..]);
                put(&rotation_vector(&relative), &mut step[n..]);
            }
        }
    }

    /// z of q.
    pub(super) fn coordinates_inward(&mut self, q: &[f64], z: &mut [f64]) {
        for place in &mut self.places {
            let (own, z) = (&q[place.own.q.clone()], &mut z[place.z..]);
            let Some(pose) = &mut place.pose else {
                z[0] = own[0];
                continue;
            };
            let ((gap, turn), (to, center)) =
                (own.split_at(place.n), z.split_at_mut(self.turns[0]));
            invert(turn, pose.is_reversed, to);
            pose.turn((self.rotation)(to));
            pose.gap = vector(gap);
            let moved = if pose.is_reversed { -(pose.rotation * pose.gap) } else { pose.gap };
            put(&(pose.point + moved - pose.arm), &mut center[..place.n]);
        }
    }

    /// q of z.
    pub(super) fn coordinates_outward(&mut self, z: &[f64], q: &mut [f64]) {
        for place in &mut self.places {
            let (own, z) = (&mut q[place.own.q.clone()], &z[place.z..]);
            let Some(pose) = &mut place.pose else {
                own[0] = z[0];
                continue;
            };
            let ((gap, turn), (from, center)) =
                (own.split_at_mut(place.n), z.split_at(self.turns[0]));
            invert(from, pose.is_reversed, turn);
            pose.turn((self.rotation)(from));
            let moved = vector(&center[..place.n]) + pose.arm - pose.point;
            let back = -(pose.rotation.transpose() * moved);
            pose.gap = if pose.is_reversed { back } else { moved };
            put(&pose.gap, gap);
        }
    }

    /// Takes the velocities v and w for what accelerations have of them.
    pub(super) fn set_velocities(&mut self, v: &[f64], w: &[f64]) {
        let turns = self.turns[1];
        for place in &mut self.places {
            let pairs = [place.pair(OWN, turns, v), place.pair(TREE, turns, w)];
            place.pose.iter_mut().for_each(|pose| pose.set_bias(pairs));
        }
    }

    pub(super) fn velocities_inward(&self, v: &[f64], w: &mut [f64]) {
        self.map([OWN, TREE], (v, w), Pose::inward);
    }
    pub(super) fn velocities_outward(&self, w: &[f64], v: &mut [f64]) {
        self.map([TREE, OWN], (w, v), Pose::outward);
    }
    pub(super) fn accelerations_inward(&self, v: &[f64], w: &mut [f64]) {
        self.map([OWN, TREE], (v, w), |pose, [x, spin]| pose.inward([x - pose.bias, spin]));
    }
    pub(super) fn accelerations_outward(&self, w: &[f64], v: &mut [f64]) {
        self.map([TREE, OWN], (w, v), |pose, pair| {
            let [linear, spin] = pose.outward(pair);
            [linear + pose.bias, spin]
        });
    }
    pub(super) fn efforts_inward(&self, own: &[f64], tree: &mut [f64]) {
        let map = |pose: &Pose, efforts| transposed(|unit| pose.outward(unit), efforts);
        self.map([OWN, TREE], (own, tree), map);
    }
    pub(super) fn efforts_outward(&self, tree: &[f64], own: &mut [f64]) {
        let map = |pose: &Pose, efforts| transposed(|unit| pose.inward(unit), efforts);
        self.map([TREE, OWN], (tree, own), map);
    }

    fn map(
        &self,
        [from, to]: [usize; 2],
        (x, out): (&[f64], &mut [f64]),
        map: impl Fn(&Pose, Pair) -> Pair,
    ) {
        for place in &self.places {
            let [moving, turning] = place.at[to];
            let Some(pose) = &place.pose else {
                out[turning] = x[place.at[from][1]];
                continue;
            };
            let turns = self.turns[1];
            let [linear, spin] = map(pose, place.pair(from, turns, x));
            put(&linear, &mut out[moving..][..place.n]);
            out[turning..][..turns].copy_from_slice(&spin.as_slice()[3 - turns..]);
        }
    }
}

impl Place {
    /// Its numbers in v or w as vectors; one number turns about z.
    fn pair(&self, side: usize, turns: usize, x: &[f64]) -> Pair {
        let [moving, turning] = self.at[side];
        if self.pose.is_none() {
            return [V3::zeros(); 2];
        }
        let mut spin = V3::zeros();
        spin.as_mut_slice()[3 - turns..].copy_from_slice(&x[turning..][..turns]);
        let linear = x.get(moving..).map_or_else(V3::zeros, |x| vector(&x[..self.n]));
        [linear, spin]
    }
}

/// The transposed of a linear map.
fn transposed(map: impl Fn(Pair) -> Pair, [force, moment]: Pair) -> Pair {
    let along = |[linear, spin]: Pair| force.dot(&linear) + moment.dot(&spin);
    let unit = |i| V3::from_fn(|k, _| f64::from(u8::from(k == i)));
    [
        V3::from_fn(|i, _| along(map([unit(i), V3::zeros()]))),
        V3::from_fn(|i, _| along(map([V3::zeros(), unit(i)]))),
    ]
}

/// The length of a quaternion.
fn length(q: &[f64]) -> f64 {
    q.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// A vector of the first components.
fn vector(x: &[f64]) -> V3 {
    V3::from_fn(|i, _| x.get(i).copied().unwrap_or(0.0))
}

/// The first components of a vector.
fn put(x: &V3, to: &mut [f64]) {
    to.copy_from_slice(&x.as_slice()[..to.len()]);
}

/// An angle or quaternion, or the opposite one.
fn invert(from: &[f64], is_reversed: bool, to: &mut [f64]) {
    to.copy_from_slice(from);
    if is_reversed {
        to[usize::from(from.len() == 4)..].iter_mut().for_each(|x| *x = -*x);
    }
}

/// Where the numbers of a joint stand.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct TreeRange {
    /// In the coordinates.
    pub q: Range<usize>,
    /// In the velocities, accelerations and efforts.
    pub v: Range<usize>,
}

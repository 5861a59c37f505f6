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

use super::{TreeError, TreeRange};
use mbs_core::algebra::{Matrix, Vector, cross};
use mbs_core::scene::Scene;
use mbs_recursive::space::{Numbers, Space};
use mbs_recursive::{JointLinks, TreeModel};

type V3 = Vector<f64, 3>;
/// What moves and what turns: a velocity, an acceleration, or a force with its moment.
type Pair = [V3; 2];

/// One coordinate, or those of a rotation.
#[derive(Debug, Clone)]
struct Place {
    /// First of its numbers in q and v.
    own: TreeRange,
    /// First of its numbers in z and w.
    tree: [usize; 2],
    /// The joint of the scene.
    joint: Option<usize>,
    /// A body that it carries.
    body: usize,
    pose: Option<Pose>,
}

/// A ball or a free joint at the present state.
#[derive(Debug, Clone)]
struct Pose {
    is_free: bool,
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

    /// B⁻ᵀ of a force and moment along w.
    fn efforts_outward(&self, [force, moment]: Pair) -> Pair {
        let moment = moment - self.rotation.transpose() * cross(&self.arm, &force);
        if !self.is_reversed {
            return [force, moment];
        }
        let force = -(self.rotation.transpose() * force);
        [force, -(self.rotation * (moment + cross(&self.gap, &force)))]
    }

    /// Bᵀ of a force and moment along v.
    fn efforts_inward(&self, [force, moment]: Pair) -> Pair {
        let back = self.rotation.transpose();
        let [force, moment] = if self.is_reversed {
            [-(self.rotation * force), -(cross(&self.gap, &force) + back * moment)]
        } else {
            [force, moment]
        };
        [force, moment + back * cross(&self.arm, &force)]
    }

    /// b at the velocities v and w.
    fn set_bias(&mut self, [linear, _]: Pair, [_, spin]: Pair) {
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
    /// Numbers of a place, and of a rotation in q and in v.
    sizes: [usize; 3],
    rotation: fn(&[f64]) -> Matrix<f64, 3>,
    pub(super) n: [usize; 2],
}

impl Layout {
    /// Coordinates in the order of the scene's joints; bodies that no joint holds stand behind them.
    pub(super) fn new<S: Space<f64>>(scene: &Scene<f64>, model: &TreeModel<f64, S>) -> Self {
        let sizes = [S::Point::N, S::FREE - S::Point::N, S::Spin::N];
        let rotation = |z: &[f64]| S::rotation_into(&S::turned_by(&S::identity(), z));
        let mut joints: Vec<_> = model.joint_links().collect();
        joints.sort_by_key(|joint| (joint.joint.is_none(), joint.joint, joint.body));
        let mut layout = Self { places: Vec::new(), sizes, rotation, n: [0; 2] };
        for joint in &joints {
            layout.add(scene, model, joint);
        }
        layout
    }

    fn add<S: Space<f64>>(
        &mut self,
        scene: &Scene<f64>,
        model: &TreeModel<f64, S>,
        joint: &JointLinks<f64>,
    ) {
        let m = model.mechanism();
        let mut links: Vec<usize> = joint.links.clone().collect();
        if joint.is_reversed {
            links.reverse();
        }
        for link in links.iter().map(|&link| &m.links[link]) {
            let [q, v] = self.n;
            self.n[0] += link.kind.n_coordinates::<f64, S>();
            self.n[1] += link.kind.n_freedoms::<f64, S>();
            let [place, _, turns] = self.sizes;
            let freedoms = self.n[1] - v;
            let is_free = freedoms == place + turns;
            if freedoms == 0 {
                continue;
            }
            let origin = V3::from(joint.origin);
            let point = joint.joint.map_or(origin, |j| V3::from(scene.joints[j].points[0]));
            let zero = V3::zeros();
            let pose = Pose {
                is_free,
                is_reversed: joint.is_reversed,
                point: point - S::point_into(&m.base),
                reference: if is_free { point - origin } else { zero },
                rotation: Matrix::<f64, 3>::identity(),
                arm: zero,
                gap: zero,
                bias: zero,
            };
            self.places.push(Place {
                own: TreeRange { q: q..self.n[0], v: v..self.n[1] },
                tree: [link.z as usize, link.v as usize],
                joint: joint.joint,
                body: joint.body,
                pose: (freedoms > 1).then_some(pose),
            });
        }
    }

    /// Where the numbers of a joint of the tree stand; nothing for a guided one.
    pub(super) fn range(&self, joint: usize) -> Option<TreeRange> {
        let mut own = self.places.iter().filter(|place| place.joint == Some(joint));
        let first = own.next()?.own.clone();
        let last = own.last().map_or(&first, |place| &place.own).clone();
        Some(TreeRange { q: first.q.start..last.q.end, v: first.v.start..last.v.end })
    }

    /// Where the numbers of a free body stand.
    pub(super) fn range_of_free(&self, body: usize) -> Option<TreeRange> {
        let is_free = |place: &Place| place.pose.as_ref().is_some_and(|pose| pose.is_free);
        let mut free = self.places.iter().filter(|place| is_free(place));
        free.find(|place| place.body == body).map(|place| place.own.clone())
    }

    /// Where quaternions stand in q.
    fn quaternions(&self) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        let rotations = self.places.iter().filter(|place| place.pose.is_some());
        let ends = rotations.filter(|_| self.sizes[1] == 4).map(|place| place.own.q.end);
        ends.map(|end| end - 4..end)
    }

    /// # Errors
    /// [`TreeError::NoRotation`] for a quaternion without length.
    pub(super) fn check_rotations(&self, q: &[f64]) -> Result<(), TreeError> {
        let lost = self.quaternions().find(|at| !(length(&q[at.clone()]) > f64::MIN_POSITIVE));
        lost.map_or(Ok(()), |at| Err(TreeError::NoRotation { first: at.start }))
    }

    /// Makes quaternions unit.
    pub(super) fn normalise(&self, q: &mut [f64]) {
        for at in self.quaternions() {
            let length = length(&q[at.clone()]);
            q[at].iter_mut().for_each(|x| *x /= length);
        }
    }

    /// z of q.
    pub(super) fn coordinates_inward(&mut self, q: &[f64], z: &mut [f64]) {
        let ([n, turns, _], read) = (self.sizes, self.rotation);
        for place in &mut self.places {
            let (own, first) = (&q[place.own.q.clone()], place.tree[0]);
            let Some(pose) = &mut place.pose else {
                z[first] = own[0];
                continue;
            };
            let (gap, turn) = own.split_at(own.len() - turns);
            invert(turn, pose.is_reversed, &mut z[first..first + turns]);
            pose.rotation = read(&z[first..first + turns]);
            pose.arm = pose.rotation * pose.reference;
            if pose.is_free {
                pose.gap = vector(gap);
                let moved = if pose.is_reversed { -(pose.rotation * pose.gap) } else { pose.gap };
                let center = pose.point + moved - pose.arm;
                z[first + turns..][..n].copy_from_slice(&center.as_slice()[..n]);
            }
        }
    }

    /// q of z.
    pub(super) fn coordinates_outward(&mut self, z: &[f64], q: &mut [f64]) {
        let ([n, turns, _], read) = (self.sizes, self.rotation);
        for place in &mut self.places {
            let (own, first) = (&mut q[place.own.q.clone()], place.tree[0]);
            let Some(pose) = &mut place.pose else {
                own[0] = z[first];
                continue;
            };
            let at = own.len() - turns;
            let (gap, turn) = own.split_at_mut(at);
            invert(&z[first..first + turns], pose.is_reversed, turn);
            pose.rotation = read(&z[first..first + turns]);
            pose.arm = pose.rotation * pose.reference;
            if pose.is_free {
                let moved = vector(&z[first + turns..][..n]) + pose.arm - pose.point;
                pose.gap =
                    if pose.is_reversed { -(pose.rotation.transpose() * moved) } else { moved };
                gap.copy_from_slice(&pose.gap.as_slice()[..n]);
            }
        }
    }

    /// Takes the velocities v and w for what accelerations have of them.
    pub(super) fn set_velocities(&mut self, v: &[f64], w: &[f64]) {
        let sizes = self.sizes;
        for place in &mut self.places {
            let (own, tree) = (place.own.v.clone(), place.tree[1]);
            if let Some(pose) = &mut place.pose {
                let [own, tree] =
                    [own_pair(sizes, &v[own]), tree_pair(sizes, pose.is_free, &w[tree..])];
                pose.set_bias(own, tree);
            }
        }
    }

    pub(super) fn velocities_inward(&self, v: &[f64], w: &mut [f64]) {
        self.inward(v, w, Pose::inward);
    }
    pub(super) fn velocities_outward(&self, w: &[f64], v: &mut [f64]) {
        self.outward(w, v, Pose::outward);
    }
    pub(super) fn accelerations_inward(&self, v: &[f64], w: &mut [f64]) {
        self.inward(v, w, |pose, [linear, spin]| pose.inward([linear - pose.bias, spin]));
    }
    pub(super) fn accelerations_outward(&self, w: &[f64], v: &mut [f64]) {
        self.outward(w, v, |pose, pair| {
            let [linear, spin] = pose.outward(pair);
            [linear + pose.bias, spin]
        });
    }
    pub(super) fn efforts_inward(&self, own: &[f64], tree: &mut [f64]) {
        self.inward(own, tree, Pose::efforts_inward);
    }
    pub(super) fn efforts_outward(&self, tree: &[f64], own: &mut [f64]) {
        self.outward(tree, own, Pose::efforts_outward);
    }

    fn inward(&self, own: &[f64], tree: &mut [f64], map: impl Fn(&Pose, Pair) -> Pair) {
        for place in &self.places {
            let (own, tree) = (&own[place.own.v.clone()], &mut tree[place.tree[1]..]);
            let Some(pose) = &place.pose else {
                tree[0] = own[0];
                continue;
            };
            let [linear, spin] = map(pose, own_pair(self.sizes, own));
            let [n, _, turns] = self.sizes;
            tree[..turns].copy_from_slice(&spin.as_slice()[3 - turns..]);
            if pose.is_free {
                tree[turns..turns + n].copy_from_slice(&linear.as_slice()[..n]);
            }
        }
    }

    fn outward(&self, tree: &[f64], own: &mut [f64], map: impl Fn(&Pose, Pair) -> Pair) {
        for place in &self.places {
            let (own, tree) = (&mut own[place.own.v.clone()], &tree[place.tree[1]..]);
            let Some(pose) = &place.pose else {
                own[0] = tree[0];
                continue;
            };
            let [linear, spin] = map(pose, tree_pair(self.sizes, pose.is_free, tree));
            let n = own.len() - self.sizes[2];
            own[..n].copy_from_slice(&linear.as_slice()[..n]);
            own[n..].copy_from_slice(&spin.as_slice()[3 - self.sizes[2]..]);
        }
    }
}

fn length(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// A vector of the first components.
fn vector(x: &[f64]) -> V3 {
    V3::from_fn(|i, _| x.get(i).copied().unwrap_or(0.0))
}

/// A vector of what turns: three components, or that about z.
fn axial(x: &[f64]) -> V3 {
    if x.len() == 1 { V3::new(0.0, 0.0, x[0]) } else { vector(x) }
}

/// Of numbers in the joint's own order.
fn own_pair([_, _, turns]: [usize; 3], own: &[f64]) -> Pair {
    let (linear, spin) = own.split_at(own.len() - turns);
    [vector(linear), axial(spin)]
}

/// Of numbers in the tree's order.
fn tree_pair([n, _, turns]: [usize; 3], is_free: bool, tree: &[f64]) -> Pair {
    let linear = if is_free { vector(&tree[turns..turns + n]) } else { V3::zeros() };
    [linear, axial(&tree[..turns])]
}

/// An angle or quaternion, or the opposite one.
fn invert(from: &[f64], is_reversed: bool, to: &mut [f64]) {
    to.copy_from_slice(from);
    let first = usize::from(from.len() == 4);
    if is_reversed {
        to[first..].iter_mut().for_each(|x| *x = -*x);
    }
}

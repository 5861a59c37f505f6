//! Axes that are almost parallel, or almost across each other, in the loops of a scene.
//!
//! A loop that moves by parallel axes is held fast by a tilt of one of them, however small. Numbers of files have six digits or more:
//! axes within [`MEANT`] of each other are meant to be parallel, and models are built with them so.

use super::Scene;
use crate::Real;
use crate::algebra::{Vector, along, cross, norm};
use crate::scene::BodyId;
use alloc::borrow::Cow;
use alloc::vec;
use alloc::vec::Vec;

/// Largest tilt that is taken as none [rad]: numbers of files have six digits or more.
pub const MEANT: f64 = 1e-6;
/// Largest tilt that is taken as none where it takes freedoms at the start [rad]: numbers of some files have five digits.
pub const FIVE_DIGITS: f64 = 1e-5;
/// Largest tilt that is taken as an error of the file where tilts alone hold a mechanism [rad]: 0.06°. Chosen, not tuned.
pub const DOUBTFUL: f64 = 1e-3;
/// Largest tilt of a direction that was normalised, in units of rounding [-]. Chosen, not tuned.
const ROUNDINGS: f64 = 1e3;

/// An axis that is off from that of another joint, or from a direction across it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tilt<T> {
    /// The joint, and which of its axes.
    pub joint: usize,
    /// Number of the axis in its joint: 0 or 1.
    pub axis: usize,
    /// The joint whose axis it is meant to be parallel to, or across.
    pub other: usize,
    /// Angle by which the axis is off [rad].
    pub angle: T,
    /// The unit axis that is not off.
    pub to: [T; 3],
}

/// One direction of the scene, with the axes that have it, or nearly.
struct Direction<T: Real> {
    value: Vector<T, 3>,
    members: Vec<usize>,
}

/// An axis of a joint.
struct Axis<T: Real> {
    joint: usize,
    axis: usize,
    value: Vector<T, 3>,
}

/// Axes of joints in loops that are off from another's, or from one across it, by more than rounding and at most `most` [rad].
///
/// Of almost parallel axes the direction that most of them have is right, the first in the file where as many have another.
/// Cost: in proportion to the joints, and to the directions times those that several axes have.
#[must_use]
pub fn tilts<T: Real>(scene: &Scene<T>, most: T) -> Vec<Tilt<T>> {
    let axes = axes(scene);
    let rounding = T::EPSILON * T::from_f64(ROUNDINGS);
    let mut to: Vec<(Vector<T, 3>, usize)> = axes.iter().map(|a| (a.value, a.joint)).collect();
    let mut directions = directions(&axes, most, rounding);
    for direction in &directions {
        for &m in &direction.members {
            let sign = if axes[m].value.dot(&direction.value) < T::ZERO { -T::ONE } else { T::ONE };
            to[m] = (direction.value * sign, axes[direction.members[0]].joint);
        }
    }
    for i in 0..directions.len() {
        for j in 0..directions.len() {
            let (one, common) = (&directions[i], &directions[j]);
            let across = one.value.dot(&common.value);
            // What fewer axes have is put across what more have.
            let is_common =
                common.members.len() > 1 && (common.members.len(), j) > (one.members.len(), i);
            if is_common && across.abs() > rounding && across.abs() <= most {
                let (value, other) =
                    (along(&(one.value - common.value * across)), axes[common.members[0]].joint);
                for &m in &one.members {
                    let sign = if to[m].0.dot(&value) < T::ZERO { -T::ONE } else { T::ONE };
                    to[m] = (value * sign, other);
                }
                directions[i].value = value;
            }
        }
    }
    let off = axes.iter().zip(to).map(|(axis, (to, other))| {
        let angle = norm(&cross(&axis.value, &to));
        Tilt { joint: axis.joint, axis: axis.axis, other, angle, to: to.into() }
    });
    off.filter(|tilt| tilt.angle > rounding).collect()
}

/// The scene with axes as they are meant: see [`MEANT`].
#[must_use]
pub fn aligned<T: Real>(scene: &Scene<T>) -> Cow<'_, Scene<T>> {
    #[cfg(feature = "instances")]
    if T::HAS_INSTANCES {
        return mbs_math::once::found::<Aligned<T>>(ALIGNED)(scene);
    }
    aligned_here(scene)
}

#[cfg(feature = "instances")]
type Aligned<T> = for<'a> fn(&'a Scene<T>) -> Cow<'a, Scene<T>>;
#[cfg(feature = "instances")]
mbs_math::instances!(ALIGNED: Aligned<T> = aligned_here::<T>, {});

fn aligned_here<T: Real>(scene: &Scene<T>) -> Cow<'_, Scene<T>> {
    let tilts = tilts(scene, T::from_f64(MEANT));
    if tilts.is_empty() { Cow::Borrowed(scene) } else { Cow::Owned(align(scene, &tilts)) }
}

/// The scene without these tilts.
#[must_use]
pub fn align<T: Real>(scene: &Scene<T>, tilts: &[Tilt<T>]) -> Scene<T> {
    let mut scene = scene.clone();
    for tilt in tilts {
        scene.joints[tilt.joint].axes[tilt.axis] = Some(tilt.to);
    }
    scene
}

/// The axes of joints in loops: of those that are left when ends are taken off as long as there are any.
fn axes<T: Real>(scene: &Scene<T>) -> Vec<Axis<T>> {
    let ground = scene.bodies.len();
    let node = |body: BodyId| if let BodyId::Body(b) = body { b } else { ground };
    let ends: Vec<[usize; 2]> = scene.joints.iter().map(|j| j.bodies.map(node)).collect();
    let mut at_node = vec![Vec::new(); ground + 1];
    for (j, &[a, b]) in ends.iter().enumerate() {
        at_node[a].push(j);
        at_node[b].push(j);
    }
    let mut left: Vec<usize> = at_node.iter().map(Vec::len).collect();
    let mut is_in = vec![true; ends.len()];
    let mut open: Vec<usize> = (0..=ground).filter(|&n| left[n] == 1).collect();
    while let Some(end) = open.pop() {
        for &j in at_node[end].iter().filter(|&&j| is_in[j]).take(1).collect::<Vec<_>>() {
            is_in[j] = false;
            for n in ends[j] {
                left[n] -= 1;
                if left[n] == 1 {
                    open.push(n);
                }
            }
        }
    }
    let inside = scene.joints.iter().enumerate().filter(|&(j, _)| is_in[j]);
    let all = inside.flat_map(|(joint, x)| {
        let axes = x.axes.iter().enumerate();
        axes.filter_map(move |(axis, a)| {
            a.map(|a| Axis { joint, axis, value: along(&Vector::from(a)) })
        })
    });
    all.collect()
}

/// Groups axes by their directions, within `most` of the one that most of a group have.
fn directions<T: Real>(axes: &[Axis<T>], most: T, rounding: T) -> Vec<Direction<T>> {
    // Parallel axes are near each other in the size of any component.
    let size = |i: usize| axes[i].value[0].abs();
    let mut order: Vec<usize> = (0..axes.len()).collect();
    order.sort_by(|&i, &j| size(i).partial_cmp(&size(j)).unwrap_or(core::cmp::Ordering::Equal));
    let (mut is_taken, mut directions) = (vec![false; axes.len()], Vec::new());
    for (at, &first) in order.iter().enumerate() {
        if is_taken[first] {
            continue;
        }
        let near = order[at..].iter().copied().take_while(|&i| size(i) - size(first) <= most);
        let off = |i: usize, j: usize| norm(&cross(&axes[i].value, &axes[j].value));
        let mut members: Vec<usize> =
            near.filter(|&i| !is_taken[i] && off(i, first) <= most).collect();
        members.sort_unstable();
        members.iter().for_each(|&i| is_taken[i] = true);
        let like = |i: usize| members.iter().filter(|&&j| off(i, j) <= rounding).count();
        let mut right = members[0];
        let mut best = like(right);
        for &i in &members[1..] {
            // As many as have it already cannot be outdone by what is left of the group.
            if 2 * best > members.len() {
                break;
            }
            let count = like(i);
            if count > best {
                (right, best) = (i, count);
            }
        }
        let value = axes[right].value;
        let place = members.iter().position(|&i| i == right).unwrap_or(0);
        members.swap(0, place);
        directions.push(Direction { value, members });
    }
    directions.sort_by_key(|direction| direction.members[0]);
    directions
}

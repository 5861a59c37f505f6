//! Axes in the closed loops of a scene that are almost parallel or almost perpendicular.
//!
//! A closed loop may need parallel axes to move: any tilt of one of them locks it. Numbers in files have six digits or more. Axes within
//! [`MEANT`] of each other therefore count as parallel, and models are built with exactly parallel axes.

use super::Scene;
use crate::Real;
use crate::algebra::{Vector, along, cross, norm};
use crate::scene::BodyId;
use alloc::borrow::Cow;
use alloc::vec;
use alloc::vec::Vec;

/// Largest tilt that counts as zero [rad]: numbers in files have six digits or more.
pub const MEANT: f64 = 1e-6;
/// Largest tilt that counts as zero if it removes degrees of freedom at the start [rad]: numbers in some files have five digits.
pub const FIVE_DIGITS: f64 = 1e-5;
/// Largest tilt that counts as an error of the file if only tilts lock the mechanism [rad]: 0.06°. Chosen, not tuned.
pub const DOUBTFUL: f64 = 1e-3;
/// Largest tilt of a direction due to its normalisation, in multiples of machine precision [-]. Chosen, not tuned.
const ROUNDINGS: f64 = 1e3;

/// Axis that is slightly tilted from the axis of another joint, or from a direction perpendicular to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tilt<T> {
    /// Index of the joint with the tilted axis.
    pub joint: usize,
    /// Index of the axis in its joint: 0 or 1.
    pub axis: usize,
    /// Index of the joint to whose axis it should be parallel or perpendicular.
    pub other: usize,
    /// Angle of the tilt [rad].
    pub angle: T,
    /// Unit axis without the tilt.
    pub to: [T; 3],
}

/// Direction of the scene, with the axes that are parallel or almost parallel to it.
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

/// Axes of joints in closed loops with a tilt above machine precision and at most `most` [rad]. The tilt is relative to the axis of another
/// joint, or to a direction perpendicular to it.
///
/// Among almost parallel axes the most frequent direction is correct, or the first in the file if several are equally frequent.
/// Cost: proportional to the joints, and to all directions times the directions of several axes.
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
            // The direction with fewer axes is made perpendicular to the direction with more axes.
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

/// Scene with parallel and perpendicular axes where the tilts are below [`MEANT`].
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

/// Scene in which the axes have none of these tilts.
#[must_use]
pub fn align<T: Real>(scene: &Scene<T>, tilts: &[Tilt<T>]) -> Scene<T> {
    let mut scene = scene.clone();
    for tilt in tilts {
        scene.joints[tilt.joint].axes[tilt.axis] = Some(tilt.to);
    }
    scene
}

/// Axes of the joints in closed loops. Bodies with a single joint are removed repeatedly; the joints that remain are in loops.
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

/// Groups axes by direction. The axes of a group are within `most` of the first one; the group has the most frequent direction of its axes.
fn directions<T: Real>(axes: &[Axis<T>], most: T, rounding: T) -> Vec<Direction<T>> {
    // Parallel axes have components of similar magnitude, so sorting by one component finds them.
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
            // A direction of more than half of the group is the most frequent one.
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

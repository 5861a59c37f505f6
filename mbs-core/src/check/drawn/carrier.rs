//! Carrier of a coupling: the body in which its axes are fixed, and the joints between the carrier and the bodies with the axes.

use crate::Real;
use crate::algebra::{Vector, along, cross, norm};
use crate::joint::Freedom;
use crate::mechanism::Scene;
use crate::scene::{BodyId, CouplingMeasure, Joint, JointId};
use alloc::collections::VecDeque;
use alloc::vec;
use alloc::vec::Vec;

/// Largest sine of the angle between parallel axes. Also the largest distance of equal axes, relative to the size of the scene [-]. Chosen,
/// not tuned: numbers in files are rounded.
pub(super) const PARALLEL: f64 = 1e-6;

/// Turn or slide of a joint, with its axis in the reference configuration.
#[derive(Debug, Clone)]
pub(super) struct Element<T: Real> {
    pub(super) joint: JointId,
    pub(super) number: usize,
    bodies: [BodyId; 2],
    pub(super) is_turn: bool,
    pub(super) axis: Vector<T, 3>,
    pub(super) point: Vector<T, 3>,
}

impl<T: Real> Element<T> {
    /// Prepares a measured coordinate; `None` unless it is a turn or a slide.
    pub(super) fn new(scene: &Scene<T>, of: &CouplingMeasure<T>) -> Option<Self> {
        let &CouplingMeasure::Coordinate { joint, number } = of else { return None };
        Self::of(scene, joint, number)
    }

    fn of(scene: &Scene<T>, joint: JointId, number: usize) -> Option<Self> {
        let of = scene.joints.get(joint.index())?;
        let (is_turn, axis) = match of.kind.freedom(scene.dimension, number)? {
            Freedom::Turn(axis) => (true, axis),
            Freedom::Slide(axis) => (false, axis),
            Freedom::Ball => return None,
        };
        let axis = along(&of.direction(axis));
        let (bodies, point) = (of.bodies, Vector::from(of.points[0]));
        Some(Self { joint, number, bodies, is_turn, axis, point })
    }

    /// The only turn or slide of a joint, or the turn if the joint also has a slide along the same axis.
    fn only(scene: &Scene<T>, joint: usize) -> Option<Self> {
        let of: &Joint<T> = &scene.joints[joint];
        let number = match of.kind.freedoms(scene.dimension) {
            [Freedom::Turn(_) | Freedom::Slide(_)] => 0,
            [Freedom::Slide(slide), Freedom::Turn(turn)] if slide == turn => 1,
            _ => return None,
        };
        Self::of(scene, JointId::new(joint), number)
    }

    /// Sign of the axis relative to a parallel axis `other`; `None` if they are not parallel.
    pub(super) fn sense(&self, other: &Vector<T, 3>) -> Option<T> {
        let is_parallel = norm(&cross(&self.axis, other)) <= T::from_f64(PARALLEL);
        is_parallel.then(|| if self.axis.dot(other) < T::ZERO { -T::ONE } else { T::ONE })
    }

    /// Sign of the coordinate as a motion of `body`, one of the two bodies of the joint.
    pub(super) fn side(&self, body: BodyId) -> T {
        if self.bodies[1] == body { T::ONE } else { -T::ONE }
    }

    /// True if this motion does not move the axis of `other`: it is a turn about the same axis, or a slide in the direction of a slide
    /// `other`.
    fn keeps(&self, other: &Self, reach: T) -> bool {
        if self.is_turn != other.is_turn || self.sense(&other.axis).is_none() {
            return false;
        }
        let way = self.point - other.point;
        let off = norm(&(way - other.axis * other.axis.dot(&way)));
        !other.is_turn || off <= reach * T::from_f64(PARALLEL)
    }
}

/// Joint on the path between two carriers.
#[derive(Debug, Clone)]
pub(super) struct Leg<T: Real> {
    pub(super) element: Element<T>,
    /// True if the joint does not move the axis of the first element; false if it does not move the axis of the second element.
    pub(super) is_first: bool,
    sign: T,
}

impl<T: Real> Leg<T> {
    /// Sign of the coordinate as a motion along the path, about or along the axis of `other`.
    pub(super) fn sense_about(&self, other: &Element<T>) -> T {
        self.sign * self.element.sense(&other.axis).unwrap_or(T::ONE)
    }
}

/// Result for a joint on a path: the joint's element with a flag, and a second flag. The first flag is `is_first` of a leg. The second flag
/// is true if the path has passed the carrier. `None`: the path may not use the joint.
type Admitted<T> = Option<(Option<(Element<T>, bool)>, bool)>;

/// Signs of two elements as motions of their outer bodies in the carrier, and the path between their inner bodies. A joint connects an
/// outer body to an inner one; the path does not use the outer bodies.
pub(super) fn of<T: Real>(
    scene: &Scene<T>,
    [first, second]: [&Element<T>; 2],
    reach: T,
) -> Option<([T; 2], Vec<Leg<T>>)> {
    let admit = |joint: usize, is_past: bool| -> Admitted<T> {
        let element = Element::only(scene, joint)?;
        if !is_past && element.keeps(first, reach) {
            return Some((Some((element, true)), false));
        }
        let keeps = element.keeps(second, reach);
        keeps.then_some((Some((element, false)), true))
    };
    let mut best: Option<([T; 2], Vec<Leg<T>>, usize)> = None;
    for (i, j) in [(1, 1), (1, 0), (0, 1), (0, 0)] {
        let outer = [first.bodies[i], second.bodies[j]];
        if outer[0] == outer[1] {
            continue;
        }
        let ends = [first.bodies[1 - i], second.bodies[1 - j]];
        let Some((way, n)) = way(scene, ends, (&outer, &[first.joint, second.joint]), admit) else {
            continue;
        };
        if best.as_ref().is_none_or(|best| n < best.2) {
            best = Some(([first.side(outer[0]), second.side(outer[1])], way, n));
        }
    }
    best.map(|(signs, way, _)| (signs, way))
}

/// Sign of a wheel in its carrier, and the path from the carrier to the cage. The turns on the path have axes parallel to the axis of the
/// cage.
pub(super) fn to<T: Real>(
    scene: &Scene<T>,
    (wheel, cage): (&Element<T>, &Element<T>),
    cage_body: BodyId,
) -> Option<(T, Vec<Leg<T>>)> {
    let admit = |joint: usize, _: bool| -> Admitted<T> {
        let element = Element::only(scene, joint)?;
        if !element.is_turn {
            return Some((None, false));
        }
        element.sense(&cage.axis)?;
        Some((Some((element, true)), false))
    };
    let ways = [1, 0].into_iter().filter_map(|i| {
        let (outer, own) = (wheel.bodies[i], wheel.bodies[1 - i]);
        let (way, n) = way(scene, [own, cage_body], (&[outer], &[wheel.joint]), admit)?;
        Some((wheel.side(outer), way, n))
    });
    ways.min_by_key(|found| found.2).map(|(sign, way, _)| (sign, way))
}

/// Shortest path between two bodies over admitted joints and welds. It avoids the listed bodies and joints.
fn way<T: Real>(
    scene: &Scene<T>,
    [from, to]: [BodyId; 2],
    (bodies, joints): (&[BodyId], &[JointId]),
    admit: impl Fn(usize, bool) -> Admitted<T>,
) -> Option<(Vec<Leg<T>>, usize)> {
    if bodies.contains(&from) || bodies.contains(&to) {
        return None;
    }
    let place = |(body, is_past): (BodyId, bool)| {
        2 * body.index().map_or(0, |body| body + 1) + usize::from(is_past)
    };
    // for each body, before and after the carrier: the previous body and the joint by which the search reached it
    let mut seen: Vec<Option<(usize, Option<Leg<T>>)>> = vec![None; 2 * (scene.bodies.len() + 1)];
    let mut open = VecDeque::from([(from, false)]);
    seen[place((from, false))] = Some((usize::MAX, None));
    while let Some((body, is_past)) = open.pop_front() {
        if body == to {
            let (mut legs, mut n, mut at) = (Vec::new(), 0, place((body, is_past)));
            while let Some((before, leg)) =
                seen[at].take().filter(|(before, _)| *before < usize::MAX)
            {
                legs.extend(leg);
                (at, n) = (before, n + 1);
            }
            legs.reverse();
            return Some((legs, n));
        }
        for (k, joint) in scene.joints.iter().enumerate() {
            let Some(side) = joint.bodies.iter().position(|of| *of == body) else { continue };
            let next = joint.bodies[1 - side];
            if joints.contains(&JointId::new(k)) || bodies.contains(&next) {
                continue;
            }
            let is_weld =
                joint.kind.freedoms(scene.dimension).is_empty() && !joint.kind.form().is_link;
            let step = if is_weld { Some((None, is_past)) } else { admit(k, is_past) };
            let Some((leg, is_past_next)) = step else { continue };
            let to = (next, is_past_next);
            if seen[place(to)].is_none() {
                let sign = if side == 0 { T::ONE } else { -T::ONE };
                let leg = leg.map(|(element, is_first)| Leg { element, is_first, sign });
                seen[place(to)] = Some((place((body, is_past)), leg));
                open.push_back(to);
            }
        }
    }
    None
}

/// Body of a joint that is farther from the ground, counted in joints. If both are equally far, it is the body with fewer joints, or else
/// the second.
pub(super) fn outer<T: Real>(scene: &Scene<T>, of: &Element<T>) -> BodyId {
    let [first, second] = of.bodies;
    let far = distances(scene);
    let steps = |body: BodyId| body.index().map_or(Some(0), |body| far[body]);
    let held = |body| scene.joints.iter().filter(|joint| joint.bodies.contains(&body)).count();
    let is_first = match (steps(first), steps(second)) {
        (Some(one), Some(other)) if one != other => one > other,
        _ => held(first) < held(second),
    };
    if is_first { first } else { second }
}

/// Body of a joint that is not the `outer` one.
pub(super) fn inner<T: Real>(scene: &Scene<T>, of: &Element<T>) -> BodyId {
    let [first, second] = of.bodies;
    if outer(scene, of) == first { second } else { first }
}

/// Number of joints between each body and the ground; `None`: no joints connect them.
fn distances<T: Real>(scene: &Scene<T>) -> Vec<Option<usize>> {
    let place = |body: BodyId| body.index().map_or(0, |body| body + 1);
    let mut neighbours = vec![Vec::new(); scene.bodies.len() + 1];
    for [a, b] in scene.joints.iter().map(|joint| joint.bodies.map(place)) {
        neighbours[a].push(b);
        neighbours[b].push(a);
    }
    let mut far = vec![None; neighbours.len()];
    far[0] = Some(0);
    let mut open = VecDeque::from([(0, 0)]);
    while let Some((body, steps)) = open.pop_front() {
        for &next in &neighbours[body] {
            if far[next].is_none() {
                far[next] = Some(steps + 1);
                open.push_back((next, steps + 1));
            }
        }
    }
    far.split_off(1)
}

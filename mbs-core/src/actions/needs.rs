//! Material points, directions and rotations that the entries of a scene need. The needs of joints are found elsewhere.

use crate::Real;
use crate::effects::action::{Action, Actions};
use crate::mechanism::Scene;
use crate::scene::{
    BallAngle, BodyId, CouplingMeasure, Entry, InitialTarget, Quantity, RelativePoint, SignalKind,
    Target,
};

/// Need of an entry of the scene: a point, a direction, a rotation, or coordinates of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Need<T> {
    /// The material point at this place in the reference configuration [m].
    Point(BodyId, [T; 3]),
    /// A direction that is fixed in both bodies of a joint, reference configuration.
    Direction(usize, [T; 3]),
    /// Full rotation of a body.
    Rotation(BodyId),
    /// Rotation of a body that is only measured, so that it need not be full.
    Orientation(BodyId),
    /// Coordinates of a joint: the coordinate with this number; `None`: all coordinates.
    Coordinates(usize, Option<usize>),
}

/// Passes the needs of a scene to `take`: those of initial conditions, guides, effects, couplings, signals, rollings and outputs.
///
/// Cost: one pass over these entries.
pub(crate) fn needs<T: Real>(
    scene: &Scene<T>,
    actions: &Actions<T>,
    take: &mut impl FnMut(Entry, Need<T>),
) {
    for (i, initial) in scene.initials.iter().enumerate() {
        of_initial(&initial.target, |need| take(Entry::Initial(i), need));
    }
    for (i, guide) in scene.guides.iter().enumerate() {
        take(Entry::Guide(i), Need::Coordinates(guide.joint.index(), Some(guide.number)));
    }
    for (effect, action) in &actions.list {
        of_action(action, &mut |need| take(Entry::Effect(*effect), need));
    }
    for (i, coupling) in scene.couplings.iter().enumerate() {
        for term in coupling.terms.iter().filter(|term| !term.factor.is_zero()) {
            of_measure(&term.of, &mut |need| take(Entry::Coupling(i), need));
        }
    }
    for (i, signal) in scene.signals.iter().enumerate() {
        if let SignalKind::Measure { of, .. } = &signal.kind {
            of_measure(of, &mut |need| take(Entry::Signal(i), need));
        }
    }
    for (i, rolling) in scene.rollings.iter().enumerate() {
        [rolling.body, rolling.on]
            .into_iter()
            .for_each(|body| take(Entry::Rolling(i), Need::Rotation(body)));
    }
    for (i, output) in scene.outputs.iter().enumerate() {
        of_output(scene, &output.quantity, |need| take(Entry::Output(i), need));
        if let Some(frame) = output.frame {
            take(Entry::Output(i), Need::Orientation(frame));
        }
    }
}

fn of_initial<T: Copy>(target: &InitialTarget<T>, mut take: impl FnMut(Need<T>)) {
    match target {
        InitialTarget::Body { body, velocity, angular_velocity } => {
            if let Some((at, _)) = velocity {
                take(Need::Point(*body, *at));
            }
            if angular_velocity.is_some() {
                take(Need::Orientation(*body));
            }
        }
        InitialTarget::Joint { joint, .. } => take(Need::Coordinates(joint.index(), None)),
    }
}

fn of_action<T: Real>(action: &Action<T>, take: &mut impl FnMut(Need<T>)) {
    match action {
        Action::Length { ends, .. } => ends.iter().for_each(|(b, p)| take(Need::Point(*b, *p))),
        Action::Along { ends: [first, second], .. } => {
            take(Need::Rotation(first.0));
            take(Need::Point(second.0, second.1));
        }
        Action::Turn { bodies, .. } | Action::Rotation { bodies, .. } => {
            bodies.iter().for_each(|body| take(Need::Rotation(*body)));
        }
        Action::Constant { at: (body, at), .. } => take(Need::Point(BodyId::Body(*body), *at)),
        Action::Torque { body, .. } => take(Need::Rotation(BodyId::Body(*body))),
        Action::Sum { terms, .. } => terms.iter().for_each(|term| of_measure(&term.of, take)),
        Action::Angle { joint, number, .. } => take(Need::Coordinates(*joint, Some(*number))),
        Action::Force { at: (body, at), turns, .. } => take(turning(*body, at, *turns)),
        Action::BodyLoad { at: (body, at), law, .. } => {
            take(turning(*body, at, law.needs_rotation()));
        }
    }
}

fn turning<T: Copy>(body: usize, at: &[T; 3], turns: bool) -> Need<T> {
    let body = BodyId::Body(body);
    if turns { Need::Rotation(body) } else { Need::Point(body, *at) }
}

fn of_measure<T: Copy>(of: &CouplingMeasure<T>, take: &mut impl FnMut(Need<T>)) {
    match of {
        CouplingMeasure::Length { points } => {
            points.iter().for_each(|(body, at)| take(Need::Point(*body, *at)));
        }
        CouplingMeasure::Ball { joint, angle: BallAngle::Swing, axis } => {
            take(Need::Direction(joint.index(), *axis));
        }
        CouplingMeasure::Ball { joint, .. } => take(Need::Coordinates(joint.index(), None)),
        CouplingMeasure::Coordinate { joint, number } => {
            take(Need::Coordinates(joint.index(), Some(*number)));
        }
    }
}

fn of_output<T: Copy>(scene: &Scene<T>, quantity: &Quantity<T>, mut take: impl FnMut(Need<T>)) {
    let turns = quantity.row().needs_rotation;
    match quantity.target() {
        Target::Point(body, at) => take(Need::Point(body, at)),
        Target::RelativePoint(RelativePoint { body, at, relative_to, origin }) => {
            take(Need::Point(body, at));
            take(Need::Point(relative_to, origin));
            if turns {
                take(Need::Orientation(relative_to));
            }
        }
        Target::RelativeBody(body, other) => {
            [body, other].into_iter().for_each(|body| take(Need::Orientation(body)));
        }
        Target::WheelCarrier(of) => {
            [of.body, of.relative_to].into_iter().for_each(|body| take(Need::Orientation(body)));
        }
        Target::Body(body) if turns => take(Need::Orientation(body)),
        Target::Joint(joint) if turns => {
            let Some(joint) = scene.joints.get(joint.index()) else { return };
            if joint.kind.n_rotations(scene.dimension) > 0 {
                joint.bodies.into_iter().for_each(|body| take(Need::Orientation(body)));
            }
        }
        Target::Body(_)
        | Target::Joint(_)
        | Target::Coupling(_)
        | Target::Rolling(_)
        | Target::Effect(_)
        | Target::Signal(_)
        | Target::Scene => {}
    }
}

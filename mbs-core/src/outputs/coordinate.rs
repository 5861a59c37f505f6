//! Joint coordinates measured at a state: the same directions and signs that hold them at the start.

use super::frame::Frame;
use super::wrench::Wrench;
use crate::Real;
use crate::algebra::{Vector, cross, norm, raised, rotation_vector, unit};
use crate::joint::{Freedom, Rotation};
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::{self, Affine, NaturalModel, Places, unwrap, unwrap_rotation};
use crate::scene::{BodyId, Joint, JointId};
use alloc::boxed::Box;
use alloc::vec::Vec;

/// Turn in one step from which positions and rates are compared [rad]. The trapezoidal rule in natural coordinates turns by 2 atan(x/2) for x,
/// 0.7 % less at this.
const LARGE_TURN: f64 = 0.3;
/// Largest relative difference of such a turn by positions and by rates [-]: above the 0.7 % of the rule.
const MISFIT: f64 = 1e-2;

/// One coordinate of a joint, or the three of a turn; or the four of a body's orientation.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Coordinate<T: Real, const D: usize> {
    /// `sign` times the angle of y in the frame x1, x2. It is one of two, as in a universal joint, or the only one.
    Angle { x1: Affine<T, D>, x2: Affine<T, D>, y: Affine<T, D>, sign: T, is_one_of_two: bool },
    /// Slide x.y along the direction y.
    Slide { x: Affine<T, D>, y: Affine<T, D> },
    /// Rotation of the second body against the first.
    Turn { frames: Box<[Frame<T, D>; 2]> },
    /// Rotation of a body as a unit quaternion, its scalar part first.
    Quaternion { frame: Box<Frame<T, D>> },
}

impl<T: Real, const D: usize> Coordinate<T, D> {
    /// The coordinates of a joint in the order of its numbers.
    pub(super) fn of_joint(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
        joint: &Joint<T>,
    ) -> Vec<Self> {
        let freedoms = joint.freedoms(scene.dimension).iter();
        freedoms.map(|&freedom| Self::of_freedom(scene, model, (joint, freedom))).collect()
    }

    /// A coordinate of a joint by its number, with the joint's place on one of its bodies; `None` where no number measures it.
    pub(super) fn carried(
        (scene, model): (&Scene<T>, &NaturalModel<T, D>),
        (joint, number): (JointId, usize),
        carrier: BodyId,
    ) -> Option<(Self, Affine<T, D>)> {
        let joint = &scene.joints[joint.index()];
        let freedom = joint.kind.freedom(scene.dimension, number)?;
        let side = usize::from(joint.bodies[1] == carrier);
        let place = model.point(carrier, joint.points[side]);
        Some((Self::of_freedom(scene, model, (joint, freedom)), place))
    }

    /// Coordinate of one freedom.
    pub(super) fn of_freedom(
        scene: &Scene<T>,
        mut model: &NaturalModel<T, D>,
        (joint, freedom): (&Joint<T>, Freedom),
    ) -> Self {
        if scene.turns_point(joint) {
            return Self::none(model, freedom);
        }
        match model.coordinate(joint, scene.dimension, freedom) {
            natural::Coordinate::Angle { x1, x2, y, sign } => {
                let rotation = joint.kind.rotation(scene.dimension);
                let is_one_of_two = matches!(rotation, Rotation::Universal(_));
                Self::Angle { x1, x2, y, sign, is_one_of_two }
            }
            natural::Coordinate::Slide { x, y } => Self::Slide { x, y },
            natural::Coordinate::Rotation => Self::turn(model, joint.bodies),
        }
    }

    /// Coordinate that stays zero: points do not turn.
    fn none(model: &NaturalModel<T, D>, freedom: Freedom) -> Self {
        if freedom == Freedom::Ball {
            return Self::Turn { frames: Box::new([Frame::Point, Frame::Point]) };
        }
        let zero = model.direction(BodyId::Ground, [T::ZERO; 3]);
        Self::Slide { x: zero.clone(), y: zero }
    }

    /// The angle of the second body against the first, in the plane.
    pub(super) fn between(model: &NaturalModel<T, D>, [first, second]: [BodyId; 2]) -> Self {
        let [x, y] = [0, 1].map(|i| unit::<T>(i).into());
        Self::Angle {
            x1: model.direction(first, x),
            x2: model.direction(first, y),
            y: model.direction(second, x),
            sign: T::ONE,
            is_one_of_two: false,
        }
    }

    /// The rotation vector of the second body against the first, in space.
    pub(super) fn turn(model: &NaturalModel<T, D>, bodies: [BodyId; 2]) -> Self {
        Self::Turn { frames: Box::new(bodies.map(|body| Frame::new(model, body))) }
    }

    /// The rotation of a body in space against the reference configuration.
    pub(super) fn quaternion(model: &NaturalModel<T, D>, body: BodyId) -> Self {
        Self::Quaternion { frame: Box::new(Frame::new(model, body)) }
    }

    /// How many numbers it has.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Angle { .. } | Self::Slide { .. } => 1,
            Self::Turn { .. } => 3,
            Self::Quaternion { .. } => 4,
        }
    }

    /// Is it one that turns more than once?
    pub(super) fn is_angle(&self) -> bool {
        matches!(self, Self::Angle { .. })
    }

    /// Writes what a rotation vector follows its turns by: the angular velocity in the axes of the first body; nothing of the others.
    pub(super) fn turning(&self, q: &[T], v: &[T], out: &mut [T]) {
        if let Self::Turn { frames } = self {
            let omega = frames[1].turning(q, v) - frames[0].turning(q, v);
            out.copy_from_slice((frames[0].rotation(q).transpose() * omega).as_slice());
        }
    }

    /// Is it a rotation vector?
    pub(super) fn is_turn(&self) -> bool {
        matches!(self, Self::Turn { .. })
    }

    /// Replaces the last value by the present one, with the turns that lead nearest to the `expected` value.
    pub(super) fn track(&self, q: &[T], expected: &[T], last: &mut [T]) {
        match self {
            Self::Angle { .. } => last[0] = unwrap(self.angle_at(q), expected[0]),
            Self::Slide { x, y } => last[0] = x.value(q).dot(&y.value(q)),
            Self::Turn { frames } => {
                let r = frames[0].rotation(q).transpose() * frames[1].rotation(q);
                let w = unwrap_rotation(&rotation_vector(&r), &Vector::from_fn(|i, _| expected[i]));
                last.copy_from_slice(w.as_slice());
            }
            Self::Quaternion { frame } => {
                let half = rotation_vector(&frame.rotation(q)) * T::HALF;
                let angle = norm(&half);
                let (sin, cos) = angle.sin_cos();
                let by = if angle > T::ZERO { sin / angle } else { T::ONE };
                let found = [cos, half[0] * by, half[1] * by, half[2] * by];
                let along = found.iter().zip(expected).fold(T::ZERO, |sum, (x, y)| sum + *x * *y);
                let sign = if along < T::ZERO { -T::ONE } else { T::ONE };
                last.copy_from_slice(&found.map(|x| x * sign));
            }
        }
    }

    /// The angle, within half a turn of zero; zero of what is none.
    fn angle_at(&self, q: &[T]) -> T {
        let Self::Angle { x1, x2, y, sign, .. } = self else { return T::ZERO };
        let y = y.value(q);
        x2.value(q).dot(&y).atan2(x1.value(q).dot(&y)) * *sign
    }

    /// The force at the joint's place on the second body and the moment on it, opposite on the first, that do work on this coordinate alone
    /// [- and 1]: on a slide the force along it, on an angle the moment (C y x x2 - S y x x1)/r^2. Zero of a rotation.
    pub(super) fn direction(&self, q: &[T]) -> Wrench<T> {
        let mut wrench = Wrench::zero();
        match self {
            Self::Angle { .. } => wrench.moment = self.gradient(q),
            Self::Slide { y, .. } => wrench.force = raised(&y.value(q)),
            Self::Turn { .. } | Self::Quaternion { .. } => {}
        }
        wrench
    }

    /// The gradient of the angle by the rotation of the second body against the first, global axes; zero of what is no angle.
    ///
    /// ```text
    /// y x (C x2 - S x1) / (C^2 + S^2),   C = x1.y,   S = x2.y
    /// ```
    pub(super) fn gradient(&self, q: &[T]) -> Vector<T, 3> {
        let Self::Angle { x1, x2, y, .. } = self else { return Vector::zeros() };
        let [x1, x2, y] = [x1, x2, y].map(|x| raised(&x.value(q)));
        let (c, s) = (x1.dot(&y), x2.dot(&y));
        cross(&y, &(x2 * c - x1 * s)) * (T::ONE / (c * c + s * s))
    }

    /// Angle that is expected a time of `dt` [s] after `last`, with these rates at both ends: where the mean rate leads.
    pub(super) fn expected(last: T, [before, now]: [T; 2], dt: T) -> T {
        last + (before + now) * dt * T::HALF
    }

    /// Turn of an angle between two states by its rates, if it is a large one and its positions differ.
    pub(super) fn lost_turn(&self, [from, to]: [&State<T>; 2]) -> Option<T> {
        if !self.is_angle() {
            return None;
        }
        let (mut before, mut now) = ([T::ZERO], [T::ZERO]);
        self.rates(&from.q, &from.v, &mut before);
        self.rates(&to.q, &to.v, &mut now);
        let expected = Self::expected(T::ZERO, [before[0], now[0]], to.t - from.t);
        if !(expected.abs() > T::from_f64(LARGE_TURN)) {
            return None;
        }
        let turned = unwrap(self.angle_at(&to.q) - self.angle_at(&from.q), expected);
        let is_lost = (turned - expected).abs() > expected.abs() * T::from_f64(MISFIT);
        is_lost.then_some(expected)
    }

    /// Writes the rates at (q, v).
    pub(super) fn rates(&self, q: &[T], v: &[T], out: &mut [T]) {
        match self {
            Self::Angle { x1, x2, y, sign, .. } => {
                let (p1, p2, py) = (x1.value(q), x2.value(q), y.value(q));
                let (w1, w2, wy) = (x1.rate(v), x2.rate(v), y.rate(v));
                let (c, s) = (p1.dot(&py), p2.dot(&py));
                let (c_t, s_t) = (w1.dot(&py) + p1.dot(&wy), w2.dot(&py) + p2.dot(&wy));
                out[0] = *sign * (c * s_t - s * c_t) / (c * c + s * s);
            }
            Self::Slide { x, y } => {
                out[0] = x.rate(v).dot(&y.value(q)) + x.value(q).dot(&y.rate(v));
            }
            Self::Turn { frames } => {
                let omega = frames[1].turning(q, v) - frames[0].turning(q, v);
                out.copy_from_slice(omega.as_slice());
            }
            // its rate is the angular velocity of the body
            Self::Quaternion { .. } => out.fill(T::ZERO),
        }
    }

    /// Writes the accelerations at a state.
    pub(super) fn accelerations(&self, state: &State<T>, out: &mut [T]) {
        match self {
            // the derivative of its rate
            Self::Turn { .. } => self.rates(&state.q, &state.a, out),
            _ => out.fill(self.motion(state)[1]),
        }
    }

    /// Rate and acceleration of an angle or a slide; zero of others.
    fn motion(&self, state: &State<T>) -> [T; 2] {
        let State { q, v, a, .. } = state;
        // x.y, its rate and its second derivative
        let product = |x: &Affine<T, D>, y: &Affine<T, D>| {
            let ([x, xt, xtt], [y, yt, ytt]) =
                [x, y].map(|z| [z.value(q), z.rate(v), z.rate(a)]).into();
            let second = xtt.dot(&y) + T::TWO * xt.dot(&yt) + x.dot(&ytt);
            [x.dot(&y), xt.dot(&y) + x.dot(&yt), second]
        };
        match self {
            Self::Angle { x1, x2, y, sign, .. } => {
                let ([c, ct, ctt], [s, st, stt]) = (product(x1, y), product(x2, y));
                // tan theta = s/c, r^2 = c^2 + s^2
                let inverse = T::ONE / (c * c + s * s);
                let rate = (c * st - s * ct) * inverse;
                let turning = (c * stt - s * ctt) * inverse;
                let change = T::TWO * (c * ct + s * st) * inverse * rate;
                [rate, turning - change].map(|x| x * *sign)
            }
            Self::Slide { x, y } => {
                let [_, rate, acceleration] = product(x, y);
                [rate, acceleration]
            }
            Self::Turn { .. } | Self::Quaternion { .. } => [T::ZERO; 2],
        }
    }

    /// Writes what a wrench of the first body on the second, at the joint's place there, does on the coordinate: its work as this coordinate
    /// alone changes.
    pub(super) fn efforts(&self, q: &[T], wrench: &Wrench<T>, out: &mut [T]) {
        match self {
            Self::Turn { .. } => out.copy_from_slice(wrench.moment.as_slice()),
            // About the axis. The gradient of the angle leads elsewhere, where the other angle's axis is oblique to this one.
            Self::Angle { x1, x2, is_one_of_two: true, .. } => {
                let [x1, x2] = [x1, x2].map(|x| raised(&x.value(q)));
                out.fill(wrench.moment.dot(&cross(&x1, &x2)));
            }
            _ => {
                let along = self.direction(q);
                out.fill(wrench.force.dot(&along.force) + wrench.moment.dot(&along.moment));
            }
        }
    }
}

/// Rate and acceleration of a coordinate of a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct CoordinateMotion<T: Real, const D: usize> {
    coordinate: Coordinate<T, D>,
}

impl<T: Real, const D: usize> CoordinateMotion<T, D> {
    /// Of a joint, by the coordinate's number, or else of its [default](crate::scene::JointKind::default_coordinate); `None` where it has
    /// none.
    #[must_use]
    pub fn new(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
        (joint, number): (&Joint<T>, Option<usize>),
    ) -> Option<Self> {
        let (kind, dimension) = (joint.kind, scene.dimension);
        let number = kind.coordinate_or_default(number, dimension)?;
        let freedom = kind.freedom(dimension, number)?;
        Some(Self { coordinate: Coordinate::of_freedom(scene, model, (joint, freedom)) })
    }

    /// Rate and acceleration of the coordinate at a state [rad/s or m/s, rad/s^2 or m/s^2]. Cost: a few products, no allocation.
    #[must_use]
    pub fn at(&self, state: &State<T>) -> [T; 2] {
        self.coordinate.motion(state)
    }
}

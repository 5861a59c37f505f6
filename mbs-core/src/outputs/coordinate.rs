//! Joint coordinates measured at a state. Directions and signs are those of the initial conditions.

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

/// Rotation in one step above which positions and rates are compared [rad]. If the rates give a rotation x, the trapezoidal rule in natural
/// coordinates rotates by 2 atan(x/2). This is 0.7 % less at x = 0.3.
const LARGE_TURN: f64 = 0.3;
/// Largest relative difference between the rotations by positions and by rates [-]: slightly above the 0.7 % of the trapezoidal rule.
const MISFIT: f64 = 1e-2;

/// One coordinate of a joint, three components of a rotation vector, or four of a quaternion.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Coordinate<T: Real, const D: usize> {
    /// Angle of y in the frame x1, x2, times `sign`. `is_one_of_two` is true if the joint has two angles, as a universal joint has.
    Angle { x1: Affine<T, D>, x2: Affine<T, D>, y: Affine<T, D>, sign: T, is_one_of_two: bool },
    /// Slide x.y: the component of the vector x along the unit direction y.
    Slide { x: Affine<T, D>, y: Affine<T, D> },
    /// Rotation of the second body relative to the first.
    Turn { frames: Box<[Frame<T, D>; 2]> },
    /// Rotation of a body as a unit quaternion, its scalar part first.
    Quaternion { frame: Box<Frame<T, D>> },
}

impl<T: Real, const D: usize> Coordinate<T, D> {
    /// Coordinates of a joint in the order of their numbers.
    pub(super) fn of_joint(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
        joint: &Joint<T>,
    ) -> Vec<Self> {
        let freedoms = joint.freedoms(scene.dimension).iter();
        freedoms.map(|&freedom| Self::of_freedom(scene, model, (joint, freedom))).collect()
    }

    /// Coordinate of a joint by its number, with the joint's point on the body `carrier`. `None` for a component of a rotation vector.
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

    /// Coordinate that measures one freedom of a joint.
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

    /// Coordinate that remains zero, for a joint of a point mass without orientation.
    fn none(model: &NaturalModel<T, D>, freedom: Freedom) -> Self {
        if freedom == Freedom::Ball {
            return Self::Turn { frames: Box::new([Frame::Point, Frame::Point]) };
        }
        let zero = model.direction(BodyId::Ground, [T::ZERO; 3]);
        Self::Slide { x: zero.clone(), y: zero }
    }

    /// Angle of the second body relative to the first, in a planar scene.
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

    /// Rotation vector of the second body relative to the first, in a spatial scene.
    pub(super) fn turn(model: &NaturalModel<T, D>, bodies: [BodyId; 2]) -> Self {
        Self::Turn { frames: Box::new(bodies.map(|body| Frame::new(model, body))) }
    }

    /// Quaternion of a body relative to the reference configuration, in a spatial scene.
    pub(super) fn quaternion(model: &NaturalModel<T, D>, body: BodyId) -> Self {
        Self::Quaternion { frame: Box::new(Frame::new(model, body)) }
    }

    /// Number of components of the coordinate.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Angle { .. } | Self::Slide { .. } => 1,
            Self::Turn { .. } => 3,
            Self::Quaternion { .. } => 4,
        }
    }

    /// True if the coordinate is an angle, which may exceed a whole turn.
    pub(super) fn is_angle(&self) -> bool {
        matches!(self, Self::Angle { .. })
    }

    /// Writes the angular velocity in axes of the first body. The change of a rotation vector is predicted from it. Does nothing for other
    /// coordinates.
    pub(super) fn turning(&self, q: &[T], v: &[T], out: &mut [T]) {
        if let Self::Turn { frames } = self {
            let omega = frames[1].turning(q, v) - frames[0].turning(q, v);
            out.copy_from_slice((frames[0].rotation(q).transpose() * omega).as_slice());
        }
    }

    /// True if the coordinate is a rotation vector.
    pub(super) fn is_turn(&self) -> bool {
        matches!(self, Self::Turn { .. })
    }

    /// Replaces `last` by the present value. An angle gets the number of whole turns that brings it nearest to the `expected` value.
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

    /// Angle within half a turn of zero; zero for other coordinates.
    fn angle_at(&self, q: &[T]) -> T {
        let Self::Angle { x1, x2, y, sign, .. } = self else { return T::ZERO };
        let y = y.value(q);
        x2.value(q).dot(&y).atan2(x1.value(q).dot(&y)) * *sign
    }

    /// Wrench on the second body at the joint's point that does work on this coordinate alone, for an effort of one. The first body has the
    /// opposite wrench. For a slide it is the force along it, for an angle the moment (C y x x2 - S y x x1)/r^2 with C = x1.y, S = x2.y and
    /// r^2 = C^2 + S^2. It is zero for a rotation vector.
    pub(super) fn direction(&self, q: &[T]) -> Wrench<T> {
        let mut wrench = Wrench::zero();
        match self {
            Self::Angle { .. } => wrench.moment = self.gradient(q),
            Self::Slide { y, .. } => wrench.force = raised(&y.value(q)),
            Self::Turn { .. } | Self::Quaternion { .. } => {}
        }
        wrench
    }

    /// Gradient of the angle by the rotation of the second body relative to the first, in global axes. It is zero for other coordinates.
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

    /// Angle that is expected a time `dt` [s] after the angle `last`. It follows from the mean of the rates at both ends of this time.
    pub(super) fn expected(last: T, [before, now]: [T; 2], dt: T) -> T {
        last + (before + now) * dt * T::HALF
    }

    /// Rotation between two states according to the rates [rad]. `None` if it is small, or if it agrees with the rotation according to
    /// positions.
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

    /// Writes the rates of the coordinate at (q, v).
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
            // the rate of an orientation is the angular velocity of the body, another output
            Self::Quaternion { .. } => out.fill(T::ZERO),
        }
    }

    /// Writes the accelerations of the coordinate at a state.
    pub(super) fn accelerations(&self, state: &State<T>, out: &mut [T]) {
        match self {
            // the acceleration is the derivative of the angular velocity
            Self::Turn { .. } => self.rates(&state.q, &state.a, out),
            _ => out.fill(self.motion(state)[1]),
        }
    }

    /// Rate and acceleration of an angle or a slide; zero for other coordinates.
    fn motion(&self, state: &State<T>) -> [T; 2] {
        let State { q, v, a, .. } = state;
        // Returns x.y, its rate and its second derivative.
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

    /// Writes the generalised force on the coordinate: the work of a wrench per change of this coordinate alone. The wrench is that of the
    /// first body on the second, at the joint's point on the second body.
    pub(super) fn efforts(&self, q: &[T], wrench: &Wrench<T>, out: &mut [T]) {
        match self {
            Self::Turn { .. } => out.copy_from_slice(wrench.moment.as_slice()),
            // The effort is the moment about the axis. The gradient of the angle has another direction if the axes are oblique to each
            // other.
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

/// Evaluator of the rate and acceleration of a joint's coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct CoordinateMotion<T: Real, const D: usize> {
    coordinate: Coordinate<T, D>,
}

impl<T: Real, const D: usize> CoordinateMotion<T, D> {
    /// Prepares a coordinate of a joint by its number. Without a number it is the [default](crate::scene::JointKind::default_coordinate).
    /// `None` if the joint has no such coordinate.
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

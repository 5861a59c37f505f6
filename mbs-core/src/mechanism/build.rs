//! Constructors for the parts of a scene in code, one for each form. They never fail; the check of the whole scene reports errors.
//!
//! Points and vectors are in global axes of the reference configuration. They have two numbers in a planar scene and three in a spatial
//! one.

use crate::effects::{
    Actuator, AeroDrag, BodyTorque, Bumper, Bushing, EffectKind, Force, Friction, JointTorque,
    LawOnBody, LawOnJoint, LawOnLine, Limit, Polynomial, SpeedHold, SpringDamper, Tire,
    TorsionSpring, Value,
};
use crate::joint::{Axis, Dimension, Freedom, JointKind, Rotation};
use crate::laws::code::{BodyLaw, ForceLaw};
use crate::mechanism::{Effect, Output};
use crate::scene::{
    AxisFrame, Body, BodyId, Coupling, Guide, Inertia, InitialCondition, InitialTarget, Joint,
    JointId, JointLimits, Motion, NamedSignal, Number, PolynomialPiece, Signal, Vector3,
};
use alloc::string::String;
use alloc::vec::Vec;

/// Attachment point: a body and a point of it.
type End<P> = (BodyId, P);

/// Bodies and points of two attachment points.
fn ends<P: Into<Vector3>>([first, second]: [End<P>; 2]) -> ([BodyId; 2], [[Number; 3]; 2]) {
    ([first.0, second.0], [first.1.into().0, second.1.into().0])
}

impl Body<Number> {
    /// A uniform slender rod with a mass [kg] between two points [m].
    pub fn rod(from: impl Into<Vector3>, to: impl Into<Vector3>, mass: impl Into<Number>) -> Self {
        let (from, to) = (from.into().0, to.into().0);
        let center = core::array::from_fn(|i| Number::HALF * (from[i].clone() + to[i].clone()));
        Self::of((mass.into(), center), Inertia::Rod { from, to })
    }

    /// A point mass [kg] at a position [m], without orientation.
    pub fn point(at: impl Into<Vector3>, mass: impl Into<Number>) -> Self {
        Self::of((mass.into(), at.into().0), Inertia::Point)
    }

    /// A planar body: centre of mass [m], mass [kg], and moment of inertia about the centre of mass [kg m^2].
    pub fn planar(
        center: impl Into<Vector3>,
        mass: impl Into<Number>,
        inertia: impl Into<Number>,
    ) -> Self {
        Self::of((mass.into(), center.into().0), Inertia::Planar(inertia.into()))
    }

    /// A spatial body: centre of mass [m], mass [kg], and inertia about the centre of mass [kg m^2]. The inertia is [Ixx, Iyy, Izz, Ixy,
    /// Iyz, Izx] in global axes. Products of inertia have the signs of the matrix entries.
    pub fn spatial<I: Into<Number>>(
        center: impl Into<Vector3>,
        mass: impl Into<Number>,
        inertia: [I; 6],
    ) -> Self {
        Self::of((mass.into(), center.into().0), Inertia::Spatial(inertia.map(Into::into)))
    }

    /// Sets the factor of gravity on the body. Zero: the body has no weight.
    #[must_use]
    pub fn with_gravity_scale(mut self, scale: impl Into<Number>) -> Self {
        self.gravity_scale = Some(scale.into());
        self
    }

    fn of((mass, center): (Number, [Number; 3]), inertia: Inertia<Number>) -> Self {
        Self { name: String::new(), mass, center, inertia, gravity_scale: None }
    }
}

impl Joint<Number> {
    fn at(kind: JointKind, bodies: [BodyId; 2], at: impl Into<Vector3>) -> Self {
        let at = at.into().0;
        Self::placed(kind, bodies, [at.clone(), at])
    }

    fn placed(kind: JointKind, bodies: [BodyId; 2], points: [[Number; 3]; 2]) -> Self {
        let (name, axes, limits) = (String::new(), [None, None], JointLimits::NONE);
        Self { name, kind, bodies, points, axes, limits }
    }

    /// A hinge at a point [m]. In space it needs an axis: [`about`](Self::about).
    pub fn revolute(bodies: [BodyId; 2], at: impl Into<Vector3>) -> Self {
        Self::at(JointKind::Revolute, bodies, at)
    }

    /// A ball joint at a point [m] (spatial).
    pub fn spherical(bodies: [BodyId; 2], at: impl Into<Vector3>) -> Self {
        Self::at(JointKind::Spherical, bodies, at)
    }

    /// A universal joint at a point [m] (spatial). It needs two axes: [`about`](Self::about) the axis fixed in the first body, then the one
    /// fixed in the second.
    pub fn universal(bodies: [BodyId; 2], at: impl Into<Vector3>) -> Self {
        Self::at(JointKind::Universal, bodies, at)
    }

    /// A slide at a point [m]. It needs an axis: [`along`](Self::along).
    pub fn prismatic(bodies: [BodyId; 2], at: impl Into<Vector3>) -> Self {
        Self::at(JointKind::Prismatic, bodies, at)
    }

    /// A slide and a hinge on one axis through a point [m] (spatial). It needs the axis: [`along`](Self::along).
    pub fn cylindrical(bodies: [BodyId; 2], at: impl Into<Vector3>) -> Self {
        Self::at(JointKind::Cylindrical, bodies, at)
    }

    /// A plane that moves on a plane through a point [m] (spatial). It needs the normal, [`about`](Self::about), and the direction of the
    /// first translation, [`along`](Self::along).
    pub fn planar(bodies: [BodyId; 2], at: impl Into<Vector3>) -> Self {
        Self::at(JointKind::Planar, bodies, at)
    }

    /// A rigid connection of two bodies at a point [m].
    pub fn weld(bodies: [BodyId; 2], at: impl Into<Vector3>) -> Self {
        Self::at(JointKind::Weld, bodies, at)
    }

    /// A free joint, with all relative motions, measured at a point [m].
    pub fn free(bodies: [BodyId; 2], at: impl Into<Vector3>) -> Self {
        Self::at(JointKind::Free, bodies, at)
    }

    /// A link without mass between a point of each body [m]. With an axis, [`about`](Self::about), it is a hinge at the first body.
    pub fn distance<P: Into<Vector3>>(bodies: [BodyId; 2], points: [P; 2]) -> Self {
        Self::placed(JointKind::Distance, bodies, points.map(|point| point.into().0))
    }

    /// Sets the axis of the rotation. For a universal joint the first call sets the first axis, the second call the second. For a planar
    /// joint it is the normal.
    #[must_use]
    pub fn about(mut self, axis: impl Into<Vector3>) -> Self {
        let rotation = self.kind.rotation(Dimension::Spatial);
        let is_second = matches!(rotation, Rotation::Universal(_)) && self.axes[0].is_some();
        self.axes[usize::from(is_second)] = Some(axis.into().0);
        self
    }

    /// Sets the direction of the slide; for a planar joint the direction of its first translation.
    #[must_use]
    pub fn along(mut self, direction: impl Into<Vector3>) -> Self {
        let slides = self.kind.freedoms(Dimension::Spatial);
        let is_second = slides.first() == Some(&Freedom::Slide(Axis::Second));
        self.axes[usize::from(is_second)] = Some(direction.into().0);
        self
    }

    /// Sets an initial condition of a joint with one coordinate. The value [rad or m] is relative to the reference configuration; the rate
    /// is in [rad/s or m/s]. Joints of several coordinates need an `InitialCondition`.
    pub fn start(self, value: impl Into<Number>, rate: impl Into<Number>) -> StartedJoint {
        StartedJoint { joint: self, value: value.into(), rate: rate.into() }
    }
}

/// A joint with the initial condition of its coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct StartedJoint {
    /// Joint that has the coordinate.
    pub joint: Joint<Number>,
    /// Coordinate of the joint at the start [rad or m].
    pub value: Number,
    /// Rate of the coordinate at the start [rad/s or m/s].
    pub rate: Number,
}

impl StartedJoint {
    /// Sets the name of the joint.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        self.joint = self.joint.named(name);
        self
    }
}

impl InitialCondition<Number> {
    /// Initial values of a joint's coordinates [rad, m], relative to the reference configuration, and of their rates [rad/s, m/s].
    pub fn joint(joint: JointId, value: Option<Vec<Number>>, rate: Option<Vec<Number>>) -> Self {
        Self { target: InitialTarget::Joint { joint, value, rate } }
    }

    /// Initial velocity [m/s] of a point [m] of a body.
    pub fn velocity(body: BodyId, at: impl Into<Vector3>, velocity: impl Into<Vector3>) -> Self {
        let velocity = Some((at.into().0, velocity.into().0));
        Self { target: InitialTarget::Body { body, velocity, angular_velocity: None } }
    }

    /// Initial angular velocity of a body in global axes [rad/s]; in a planar scene only the third component counts.
    pub fn angular_velocity(body: BodyId, angular_velocity: impl Into<Vector3>) -> Self {
        let angular_velocity = Some(angular_velocity.into().0);
        Self { target: InitialTarget::Body { body, velocity: None, angular_velocity } }
    }
}

impl Guide<Number> {
    /// A guide of a joint with one coordinate by a function of time.
    pub fn new(joint: JointId, motion: impl Into<Motion<Number>>) -> Self {
        Self { joint, number: 0, law: motion.into() }
    }

    /// Guides another coordinate of the joint, by its number from 0. A joint with several coordinates needs one guide for each, in order.
    #[must_use]
    pub fn on_coordinate(mut self, number: usize) -> Self {
        self.number = number;
        self
    }
}

impl Effect<Number> {
    fn of(kind: impl Into<EffectKind<Number>>) -> Self {
        Self { name: String::new(), enabled: true, kind: kind.into() }
    }

    /// Moves the effect to another coordinate of its joint, by its number from 0. Effects without a joint do not change.
    #[must_use]
    pub fn on_coordinate(mut self, number: usize) -> Self {
        let values = self.kind.values().into_iter().map(|value| match value {
            Value::Coordinate(_) => Value::Coordinate(Some(number)),
            other => other,
        });
        self.kind = self.kind.with(values).unwrap_or(self.kind);
        self
    }

    /// A spring and a damper along the line between two points: stiffness [N/m], damping [N s/m], free length [m].
    pub fn spring_damper<P: Into<Vector3>>(
        between: [(BodyId, P); 2],
        stiffness: impl Into<Number>,
        damping: impl Into<Number>,
        free_length: impl Into<Number>,
    ) -> Self {
        let ((bodies, points), free_length) = (ends(between), free_length.into());
        let (stiffness, damping) = (stiffness.into(), damping.into());
        Self::of(SpringDamper { bodies, points, stiffness, damping, free_length })
    }

    /// A spring and a damper about a hinge: stiffness [N m/rad], damping [N m s/rad], angle without torque [rad].
    pub fn torsion_spring(
        joint: JointId,
        stiffness: impl Into<Number>,
        damping: impl Into<Number>,
        free_value: impl Into<Number>,
    ) -> Self {
        let (stiffness, damping) = (stiffness.into(), damping.into());
        let free_value = free_value.into();
        Self::of(TorsionSpring { joint, coordinate: None, stiffness, damping, free_value })
    }

    /// A force [N] at a point of a body, in global axes.
    pub fn force(body: BodyId, at: impl Into<Vector3>, signal: impl Into<Signal<Number>>) -> Self {
        let (at, course, frame) = (at.into().0, signal.into(), AxisFrame::Global);
        Self::of(Force { body, at, course, frame })
    }

    /// A force [N] at a point of a body, in axes that turn with the body.
    pub fn body_force(
        body: BodyId,
        at: impl Into<Vector3>,
        signal: impl Into<Signal<Number>>,
    ) -> Self {
        let (at, course, frame) = (at.into().0, signal.into(), AxisFrame::Body);
        Self::of(Force { body, at, course, frame })
    }

    /// A torque of a joint's first body on its second about the joint's axis: one number [N m].
    pub fn torque(joint: JointId, signal: impl Into<Signal<Number>>) -> Self {
        Self::of(JointTorque { joint, coordinate: None, course: signal.into() })
    }

    /// A torque of the ground on a body, in global axes [N m]; in a planar scene one number.
    pub fn body_torque(body: BodyId, signal: impl Into<Signal<Number>>) -> Self {
        Self::of(BodyTorque { body, course: signal.into() })
    }

    /// A force [N] along the line between two points. A positive force pushes them apart.
    pub fn actuator<P: Into<Vector3>>(
        between: [(BodyId, P); 2],
        signal: impl Into<Signal<Number>>,
    ) -> Self {
        let (bodies, points) = ends(between);
        Self::of(Actuator { bodies, points, course: signal.into() })
    }

    /// A spring along the line between two points. Polynomials of its length [m] give the force [N].
    pub fn polynomial_spring<P: Into<Vector3>>(
        between: [(BodyId, P); 2],
        pieces: Vec<PolynomialPiece<Number>>,
    ) -> Self {
        let ((bodies, points), direction) = (ends(between), None);
        Self::of(Polynomial { bodies, points, direction, of_rate: false, pieces })
    }

    /// A damper along the line between two points. Polynomials of the rate of its length [m/s] give the force [N].
    pub fn polynomial_damper<P: Into<Vector3>>(
        between: [(BodyId, P); 2],
        pieces: Vec<PolynomialPiece<Number>>,
    ) -> Self {
        let ((bodies, points), direction) = (ends(between), None);
        Self::of(Polynomial { bodies, points, direction, of_rate: true, pieces })
    }

    /// A stop between two points: stiffness [N/m], damping in contact [N s/m], distance at which contact begins [m].
    pub fn bumper<P: Into<Vector3>>(
        between: [(BodyId, P); 2],
        stiffness: impl Into<Number>,
        damping: impl Into<Number>,
        clearance: impl Into<Number>,
    ) -> Self {
        let ((bodies, points), clearance) = (ends(between), clearance.into());
        let (stiffness, damping) = (stiffness.into(), damping.into());
        Self::of(Bumper { bodies, points, stiffness, damping, clearance })
    }

    /// Springs and dampers along and about x, y, z at a position, in body axes of the first body. Stiffness [N/m, N m/rad], damping [N s/m,
    /// N m s/rad].
    pub fn bushing(
        bodies: [BodyId; 2],
        at: impl Into<Vector3>,
        stiffness: [f64; 6],
        damping: [f64; 6],
    ) -> Self {
        let [stiffness, damping] = [stiffness, damping].map(|six| six.map(Number::from));
        Self::of(Bushing { bodies, at: at.into().0, stiffness, damping })
    }

    /// Elastic stops of a joint's coordinate: range [rad or m], stiffness [N m/rad or N/m], damping [N m s/rad or N s/m].
    pub fn limit(joint: JointId, range: [f64; 2], stiffness: f64, damping: f64) -> Self {
        let [lower, upper] = range.map(Number::from);
        let (stiffness, damping) = (stiffness.into(), damping.into());
        let (coordinate, range) = (None, false);
        Self::of(Limit { joint, coordinate, range, lower, upper, stiffness, damping })
    }

    /// Coulomb friction [N m or N] of a joint's coordinate, regularised below a rate [rad/s or m/s]. The other numbers have default values
    /// in the effect's kind.
    pub fn friction(
        joint: JointId,
        coulomb: impl Into<Number>,
        regularisation: impl Into<Number>,
    ) -> Self {
        /// Stribeck rate relative to the rate of regularisation [-]. It has no effect as long as static and Coulomb friction are equal.
        /// Chosen, not tuned.
        const STRIBECK_RATIO: f64 = 10.0;
        let (coulomb, regularisation) = (coulomb.into(), regularisation.into());
        Self::of(Friction {
            joint,
            coordinate: None,
            r#static: coulomb.clone(),
            coulomb,
            stribeck: regularisation.clone() * Number::from(STRIBECK_RATIO),
            viscous: Number::ZERO,
            regularisation,
            factor: Signal::constant(1.0),
        })
    }

    /// Drag of air at rest on a point of a body: drag coefficient times area [m^2], density [kg/m^3].
    pub fn aero_drag(
        body: BodyId,
        at: impl Into<Vector3>,
        area_coefficient: impl Into<Number>,
        density: impl Into<Number>,
    ) -> Self {
        let (at, area_coefficient) = (at.into().0, area_coefficient.into());
        Self::of(AeroDrag { body, at, area_coefficient, density: density.into() })
    }

    /// A force along a direction of the body that controls its speed [m/s]: gain [N s/m], largest force [N].
    pub fn speed_hold(
        body: BodyId,
        direction: impl Into<Vector3>,
        speed: impl Into<Number>,
        [gain, limit]: [f64; 2],
    ) -> Self {
        let (direction, speed) = (direction.into().0, speed.into());
        let (gain, limit) = (gain.into(), limit.into());
        Self::of(SpeedHold { body, direction, speed, gain, limit })
    }

    /// A wheel on the road without side force: centre [m], radius [m], radial stiffness [N/m], radial damping [N s/m].
    pub fn tire(
        body: BodyId,
        center: impl Into<Vector3>,
        radius: impl Into<Number>,
        stiffness: impl Into<Number>,
        damping: impl Into<Number>,
    ) -> Self {
        Self::of(Tire {
            body,
            center: center.into().0,
            axis: None,
            radius: radius.into(),
            stiffness: stiffness.into(),
            damping: damping.into(),
            rolling_resistance: Number::ZERO,
            side: None,
            spin: None,
            longitudinal: None,
        })
    }
}

/// Effects with user-defined laws, in code only: no scene file has them. Each law has an input of three numbers, which are zero until the
/// program sets them.
impl Effect<Number> {
    /// A user-defined force law along the line between two points.
    pub fn law_on_line<P: Into<Vector3>>(
        between: [(BodyId, P); 2],
        law: impl ForceLaw + 'static,
    ) -> Self {
        let ((bodies, points), law) = (ends(between), law.into());
        Self::of(LawOnLine { bodies, points, law, input: Signal::input(0.0) })
    }

    /// A user-defined force law on the coordinate of a joint with one coordinate.
    pub fn law_on_joint(joint: JointId, law: impl ForceLaw + 'static) -> Self {
        Self::of(LawOnJoint { joint, coordinate: None, law: law.into(), input: Signal::input(0.0) })
    }

    /// A user-defined law on a body at a point. The body-fixed direction passed to the law is x by default; the field `axis` changes it.
    pub fn law_on_body(body: BodyId, at: impl Into<Vector3>, law: impl BodyLaw + 'static) -> Self {
        let axis = Vector3::from([1.0, 0.0, 0.0]).0;
        let (at, law) = (at.into().0, law.into());
        Self::of(LawOnBody { body, at, axis, law, input: Signal::input(0.0) })
    }
}

macro_rules! named {
    ($($part:ident),*) => {$(
        impl<T> $part<T> {
            /// Sets the name of this part.
            #[must_use]
            pub fn named(mut self, name: &str) -> Self {
                self.name = name.into();
                self
            }
        }
    )*};
}
named!(Body, Coupling, Joint, NamedSignal, Effect, Output);

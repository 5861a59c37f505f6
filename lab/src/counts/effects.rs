//! One effect of each kind: selected effects, and the manual's examples for kinds that are not selected here.

use mbs_core::effects::{EFFECTS, Places, Row};
use mbs_core::laws::body::{BodyMotion, UnitWrench};
use mbs_core::laws::code::{self, Force as Given, Measured, MeasuredBody, Wrench};
use mbs_core::laws::scalar::ScalarForce;
use mbs_core::laws::user::{ScalarLaw, UserBodyLaw, UserScalarLaw, WrenchLaw};
use mbs_core::scene::{
    Actuator, AeroDrag, AxisFrame, BodyId, BodyTorque, Bumper, Bushing, CalspanCoefficients,
    Dimension, EffectKind, Force, Friction, JointId, JointTorque, LawOnBody, LawOnJoint, LawOnLine,
    Limit, Own, Polynomial, PolynomialPiece, Signal, SpeedHold, SpringDamper, Tire, TorsionSpring,
    UserLaw,
};

/// Body that is the coupler of the scene.
const COUPLER: BodyId = BodyId::Body(1);
const CRANK: JointId = JointId::new(0);
/// Centre of the coupler [m].
const CENTER: [f64; 3] = [1.0, 1.5, 0.25];
const BODIES: [BodyId; 2] = [BodyId::Ground, BodyId::Body(2)];
/// Attachment points on [`BODIES`], the ground and the rocker [m].
const POINTS: [[f64; 3]; 2] = [[0.5, 0.0, 0.0], [2.0, 1.0, 0.5]];

/// Name and data of one effect of each kind.
pub(crate) fn all(dimension: Dimension) -> Vec<(String, EffectKind<f64>)> {
    let depth = if dimension == Dimension::Planar { 0.0 } else { 1.0 };
    let flat = |[x, y, z]: [f64; 3]| [x, y, z * depth];
    let mut all = springs_and_forces(POINTS.map(flat), flat(CENTER));
    let six = [1.0, 1.0, depth, depth, depth, 1.0];
    all.extend(between(POINTS.map(flat), six));
    all.extend(between_in_code(POINTS.map(flat)));
    all.extend(on_a_body(flat(CENTER), dimension));
    let (pair, body) = ((BODIES, POINTS.map(flat)), (COUPLER, flat(CENTER)));
    let places = Places { pair, body, joint: CRANK };
    let is_chosen = |row: &Row| all.iter().any(|(_, kind)| kind.row() == row);
    let others = EFFECTS.iter().enumerate().filter(|(_, row)| !is_chosen(row));
    let examples = others.filter_map(|(i, row)| {
        Some((row.module.replace('_', "-"), EffectKind::example(i, &places)?))
    });
    let examples: Vec<_> = examples.collect();
    all.into_iter().map(|(name, kind)| (name.to_owned(), kind)).chain(examples).collect()
}

/// Effects that every build contains: springs and forces.
fn springs_and_forces(points: [[f64; 3]; 2], at: [f64; 3]) -> Vec<(&'static str, EffectKind<f64>)> {
    let (bodies, body) = (BODIES, COUPLER);
    let course = Signal::Input([3.0, 0.0, 0.0]);
    let (stiffness, damping) = (100.0, 1.0);
    vec![
        (
            "spring-damper",
            EffectKind::SpringDamper(SpringDamper {
                bodies,
                points,
                stiffness,
                damping,
                free_length: 1.0,
            }),
        ),
        (
            "torsion-spring",
            EffectKind::TorsionSpring(TorsionSpring {
                joint: CRANK,
                coordinate: None,
                stiffness,
                damping,
                free_value: 0.0,
            }),
        ),
        (
            "force",
            EffectKind::Force(Force { body, at, course: course.clone(), frame: AxisFrame::Body }),
        ),
        ("body-torque", EffectKind::BodyTorque(BodyTorque { body, course: course.clone() })),
        (
            "joint-torque",
            EffectKind::JointTorque(JointTorque {
                joint: CRANK,
                coordinate: None,
                course: course.clone(),
            }),
        ),
        ("actuator", EffectKind::Actuator(Actuator { bodies, points, course })),
    ]
}

/// Laws of a length, an angle or a relative displacement between bodies.
fn between(points: [[f64; 3]; 2], six: [f64; 6]) -> Vec<(&'static str, EffectKind<f64>)> {
    let (bodies, joint) = (BODIES, CRANK);
    let (stiffness, damping) = (100.0, 1.0);
    let pieces =
        vec![PolynomialPiece { lower: 0.0, upper: 4.0, coefficients: vec![-100.0, 50.0, 5.0] }];
    vec![
        (
            "polynomial",
            EffectKind::Polynomial(Polynomial {
                bodies,
                points,
                direction: None,
                of_rate: false,
                pieces,
            }),
        ),
        (
            "bumper",
            EffectKind::Bumper(Bumper { bodies, points, stiffness, damping, clearance: 0.1 }),
        ),
        (
            "limit",
            EffectKind::Limit(Limit {
                joint,
                coordinate: None,
                range: false,
                lower: -1.0,
                upper: 1.0,
                stiffness,
                damping,
            }),
        ),
        (
            "friction",
            EffectKind::Friction(Friction {
                joint,
                coordinate: None,
                coulomb: 1.0,
                r#static: 1.2,
                stribeck: 0.1,
                viscous: 0.1,
                regularisation: 0.01,
                factor: Signal::Constant([1.0, 0.0, 0.0]),
            }),
        ),
        (
            "bushing",
            EffectKind::Bushing(Bushing {
                bodies,
                at: points[1],
                stiffness: six.map(|share| share * stiffness),
                damping: six.map(|share| share * damping),
            }),
        ),
    ]
}

/// User-defined laws of a length or an angle.
fn between_in_code(points: [[f64; 3]; 2]) -> Vec<(&'static str, EffectKind<f64>)> {
    let (bodies, joint) = (BODIES, CRANK);
    vec![
        (
            "own-length",
            EffectKind::Own(Own {
                law: UserLaw::Length { bodies, points, law: UserScalarLaw::of::<Steady>() },
                course: Signal::Constant([1.0; 3]),
            }),
        ),
        (
            "law-on-line",
            LawOnLine { bodies, points, law: Steady.into(), input: Signal::Input([1.0; 3]) }.into(),
        ),
        (
            "law-on-joint",
            LawOnJoint {
                joint,
                coordinate: None,
                law: Steady.into(),
                input: Signal::Input([1.0; 3]),
            }
            .into(),
        ),
    ]
}

/// Laws on one body.
fn on_a_body(at: [f64; 3], dimension: Dimension) -> Vec<(&'static str, EffectKind<f64>)> {
    let body = COUPLER;
    let axis = (dimension == Dimension::Spatial).then_some([0.0, 1.0, 0.0]);
    vec![
        ("drag", EffectKind::AeroDrag(AeroDrag { body, at, area_coefficient: 1.0, density: 1.2 })),
        (
            "speed-hold",
            EffectKind::SpeedHold(SpeedHold {
                body,
                direction: [1.0, 0.0, 0.0],
                speed: 1.0,
                gain: 10.0,
                limit: 10.0,
            }),
        ),
        (
            "tire",
            EffectKind::Tire(Tire {
                body,
                center: at,
                axis,
                radius: if axis.is_some() { 0.3 } else { 1.6 },
                stiffness: 100.0,
                damping: 1.0,
                rolling_resistance: 0.01,
                side: axis.map(|_| CalspanCoefficients::iltis()),
                spin: None,
                longitudinal: None,
            }),
        ),
        (
            "own-body",
            EffectKind::Own(Own {
                law: UserLaw::Body {
                    body,
                    at,
                    axis: [1.0, 0.0, 0.0],
                    law: UserBodyLaw::of::<Steady>(),
                },
                course: Signal::Constant([1.0; 3]),
            }),
        ),
        (
            "law-on-body",
            LawOnBody {
                body,
                at,
                axis: [1.0, 0.0, 0.0],
                law: Steady.into(),
                input: Signal::Input([1.0; 3]),
            }
            .into(),
        ),
    ]
}

/// A user-defined law whose force is its input.
#[derive(Debug)]
struct Steady;

impl code::ForceLaw for Steady {
    fn evaluate(&self, at: &Measured) -> Given {
        Given { force: at.input[0], energy: at.input[0] * at.value, ..Given::default() }
    }
}

impl code::BodyLaw for Steady {
    fn evaluate(&self, at: &MeasuredBody) -> Wrench {
        Wrench { force: at.axis.map(|x| -at.input[0] * x), ..Wrench::default() }
    }
}

impl ScalarLaw<f64> for Steady {
    fn evaluate(_: f64, _: f64, input: [f64; 3]) -> ScalarForce<f64> {
        ScalarForce { tension: input[0], ..ScalarForce::default() }
    }
    fn energy(value: f64, input: [f64; 3]) -> f64 {
        input[0] * value
    }
    fn elastic(_: f64, input: [f64; 3]) -> f64 {
        input[0]
    }
}

impl WrenchLaw<f64> for Steady {
    fn evaluate(motion: &BodyMotion<f64>, input: [f64; 3]) -> UnitWrench<f64> {
        let measure = ScalarForce { tension: input[0], ..ScalarForce::default() };
        UnitWrench { force: motion.axis, moment: [0.0; 3], measure }
    }
}

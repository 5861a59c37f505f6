//! User-defined laws with data, on the mechanism on which every kind of effect is tested.

use mbs_core::Real;
use mbs_core::algebra::Vector;
use mbs_core::laws::code::{BodyLaw, Codes, Force, ForceLaw, Measured, MeasuredBody, Wrench};
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::real::DoubleDouble;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{
    Body, BodyId, Dimension, Effect, EffectKind, GROUND, JointId, LawOnBody, LawOnJoint, LawOnLine,
    Number, Scene, Signal,
};

/// Force f = k x + h x³ + c (1 + x²) x'. The stiffness k grows with time, and x is measured from a length that is an input.
#[derive(Debug)]
struct Hardening {
    stiffness: f64,
    cubic: f64,
    damping: f64,
}

impl ForceLaw for Hardening {
    fn evaluate(&self, at: &Measured) -> Force {
        let Self { stiffness, cubic, damping } = *self;
        let (x, k) = (at.value - at.input[0], stiffness * (1.0 + at.time));
        Force {
            force: k * x + cubic * x * x * x + damping * (1.0 + x * x) * at.rate,
            stiffness: k + 3.0 * cubic * x * x + 2.0 * damping * x * at.rate,
            damping: damping * (1.0 + x * x),
            energy: 0.5 * k * x * x + 0.25 * cubic * x * x * x * x,
        }
    }
}

/// Force against the motion and rotation of a body, along its direction, and towards the origin.
#[derive(Debug)]
struct Wind(f64);

impl BodyLaw for Wind {
    fn evaluate(&self, at: &MeasuredBody) -> Wrench {
        let force =
            |i: usize| at.axis[i] * (1.0 + at.time) - at.position[i] - self.0 * at.velocity[i];
        let moment = at.angular_velocity.map(|w| -self.0 * w);
        Wrench { force: core::array::from_fn(force), moment }
    }
}

/// Effects with a user-defined law of each kind.
pub(crate) fn every(dimension: Dimension) -> Vec<(&'static str, EffectKind<f64>)> {
    let depth = if dimension == Dimension::Planar { 0.0 } else { 1.0 };
    let (body, at) = (BodyId::Body(3), [1.2, 1.3, 1.1 * depth]);
    let (bodies, points) = ([BodyId::Body(2), body], [[0.1, 0.8, 0.7 * depth], at]);
    let hardening = || Hardening { stiffness: 30.0, cubic: 20.0, damping: 2.0 }.into();
    let input = || Signal::Constant([0.3, 0.0, 0.0]);
    let on_joint = |joint| LawOnJoint {
        joint: JointId::new(joint),
        coordinate: None,
        law: hardening(),
        input: input(),
    };
    let (law, axis) = (Wind(0.7).into(), [1.0, 2.0, 0.5 * depth]);
    vec![
        ("line", LawOnLine { bodies, points, law: hardening(), input: input() }.into()),
        ("hinge", on_joint(0).into()),
        ("slide", on_joint(1).into()),
        ("body", LawOnBody { body, at, axis, law, input: input() }.into()),
    ]
}

/// Tension of a law along x, from the origin to a body at 1/3 that moves at 1/7.
fn tension<T: Real>() -> T {
    let mut scene = Scene::empty("line", Dimension::Planar, Number::from(1.0));
    let third = || Number::from_decimal("0.33333333333333333333333333333333").expect("a number");
    scene.bodies.push(Body::planar([third(), Number::ZERO], 2.0, 1.0).named("body"));
    let ends = [(GROUND, [Number::ZERO, Number::ZERO]), (BodyId::new(0), [third(), Number::ZERO])];
    let law = Hardening { stiffness: 30.0, cubic: 20.0, damping: 2.0 };
    scene.effects.push(Effect::law_on_line(ends, law).named("law"));
    let scene = scene.resolve::<T>().expect("a scene");
    let model = NaturalModel::<T, 2>::new(&scene).expect("a model");
    let (mut state, mut terms) = (State::at_rest(&model), model.terms());
    let motion = RigidMotion {
        velocity: Vector::from([T::ONE / T::from_f64(7.0), T::ZERO, T::ZERO]),
        ..RigidMotion::at_rest(scene.bodies[0].center.into())
    };
    model.write_motions(&[motion], &mut state);
    model.set_inputs(state.t, &state, &mut terms);
    model.evaluate_forces(&state.q, &state.v, &mut terms);
    terms.measures[0].tension
}

#[test]
fn a_law_sees_the_nearest_doubles_in_every_precision() {
    let at = |x: f64, v: f64| 30.0 * x + 20.0 * x * x * x + 2.0 * (1.0 + x * x) * v;
    let told = at(1.0 / 3.0, 1.0 / 7.0);
    // the length and its rate are rounded before the law gets them
    let [double, pair] = [tension::<f64>(), tension::<DoubleDouble>().to_f64()];
    assert!((double - told).abs() < 1e-13 && (pair - told).abs() < 1e-13, "{double} {pair} {told}");
    assert!(tension::<DoubleDouble>().parts()[1] == 0.0);
    assert!((tension::<f32>().to_f64() - told).abs() < 1e-5);
}

#[test]
fn a_law_is_equal_to_its_copies_alone_and_shows_its_data() {
    let [(_, a), (_, b)] = [0, 1].map(|_| every(Dimension::Planar).swap_remove(0));
    assert!(a == a.clone() && a != b);
    assert!(format!("{a:?}").contains("Hardening { stiffness: 30.0, cubic: 20.0"), "{a:?}");
    let other = a.clone().map(&mut |x: f64| x.to_bits()).expect("numbers that are mapped");
    assert_eq!(other.map(&mut f64::from_bits), Some(a));
    assert_eq!(Codes::default().failed(), None);
}

//! Checks of scenes: every refusal by its name, scenes that must pass, and arbitrary data, which must not panic.

use mbs_core::scene::*;
use proptest::prelude::*;

mod body;
mod drawn;
mod effects;

fn body(name: &str, mass: f64, inertia: Inertia<f64>) -> Body<f64> {
    Body { name: name.into(), mass, center: [0.5, 0.0, 0.0], inertia, gravity_scale: None }
}

fn joint(name: &str, kind: JointKind, bodies: [BodyId; 2]) -> Joint<f64> {
    let (points, axes, limits) = ([[0.0; 3]; 2], [None, None], JointLimits::NONE);
    Joint { name: name.into(), kind, bodies, points, axes, limits }
}

fn planar() -> Scene<f64> {
    let rod = Inertia::Rod { from: [0.0; 3], to: [1.0, 0.0, 0.0] };
    let ground = BodyId::Ground;
    Scene {
        gravity: Some([0.0, -9.81, 0.0]),
        bodies: vec![body("upper", 1.0, rod), body("lower", 1.0, Inertia::Planar(0.1))],
        joints: vec![
            joint("pivot", JointKind::Revolute, [ground, BodyId::Body(0)]),
            joint("elbow", JointKind::Revolute, [BodyId::Body(0), BodyId::Body(1)]),
        ],
        ..Scene::empty("pendulum", Dimension::Planar, 10.0)
    }
}

fn spatial() -> Scene<f64> {
    let mut scene = planar();
    scene.dimension = Dimension::Spatial;
    scene.bodies[1].inertia = Inertia::Spatial([0.1, 0.1, 0.1, 0.0, 0.0, 0.0]);
    for joint in &mut scene.joints {
        joint.axes[0] = Some([0.0, 2.0, 0.0]);
    }
    scene
}

fn spring(points: [[f64; 3]; 2], bodies: [BodyId; 2]) -> Effect<f64> {
    let kind = EffectKind::SpringDamper(SpringDamper {
        bodies,
        points,
        stiffness: 1.0,
        damping: 0.0,
        free_length: 0.5,
    });
    Effect { name: "strut".into(), enabled: true, kind }
}

fn natural(rows: Vec<[f64; 2]>) -> Motion<f64> {
    Motion::Table { rows, ends: TableEnds::Natural }
}

fn value(joint: usize, value: Option<Vec<f64>>, rate: Option<Vec<f64>>) -> InitialCondition<f64> {
    InitialCondition { target: InitialTarget::Joint { joint: JointId::new(joint), value, rate } }
}

/// Applies `spoil` to a scene and returns the entry, the key and the fault of the refusal.
fn refused(
    mut scene: Scene<f64>,
    spoil: impl FnOnce(&mut Scene<f64>),
) -> (Entry, &'static str, SceneFault) {
    assert_eq!(scene.check(), Ok(()), "the scene is sound before it is spoiled");
    spoil(&mut scene);
    let error = scene.check().expect_err("refused");
    (error.entry, error.field, error.fault)
}

#[test]
fn numbers_that_cannot_be_meant_are_refused() {
    use SceneFault::{LimitOrder, Negative, NotFinite, NotPositive};
    let found = refused(planar(), |s| s.duration = f64::INFINITY);
    assert_eq!(found, (Entry::Scene, "duration", NotFinite));
    let found = refused(planar(), |s| s.duration = 0.0);
    assert_eq!(found, (Entry::Scene, "duration", NotPositive(0.0)));
    let found = refused(planar(), |s| s.bodies[1].mass = -2.0);
    assert_eq!(found, (Entry::Body(1), "mass", Negative(-2.0)));
    let found = refused(planar(), |s| s.bodies[1].center[0] = f64::NAN);
    assert_eq!(found, (Entry::Body(1), "center", NotFinite));
    let found = refused(planar(), |s| s.solver.step = Some(0.0));
    assert_eq!(found, (Entry::Solver, "step", NotPositive(0.0)));
    let found = refused(planar(), |s| s.solver.tolerance = Some(-1.0));
    assert_eq!(found, (Entry::Solver, "tolerance", NotPositive(-1.0)));
    let found = refused(planar(), |s| s.solver.penalty = Some(f64::NAN));
    assert_eq!(found, (Entry::Solver, "penalty", NotFinite));
    let found = refused(planar(), |s| s.solver.energy_tolerance = Some([1.0e-7, 1.0e-5]));
    assert_eq!(found, (Entry::Solver, "energy_tolerance", LimitOrder([1.0e-7, 1.0e-5])));
}

#[test]
fn names_are_there_free_and_different() {
    let found = refused(planar(), |s| s.bodies[1].name = "upper".into());
    assert_eq!(found, (Entry::Body(1), "name", SceneFault::DuplicateName(0)));
    let found = refused(planar(), |s| s.bodies[0].name = "ground".into());
    assert_eq!(found, (Entry::Body(0), "name", SceneFault::ReservedName));
    let found = refused(planar(), |s| s.joints[1].name = " ".into());
    assert_eq!(found, (Entry::Joint(1), "name", SceneFault::ReservedName));
    let twice =
        |name: &str| Output::new(Quantity::JointRate { joint: JointId::new(0) }).named(name);
    let found = refused(planar(), |s| s.outputs = vec![twice("a"), twice("a")]);
    assert_eq!(found, (Entry::Output(1), "name", SceneFault::DuplicateName(0)));
    let found = refused(planar(), |s| s.outputs = vec![twice("t")]);
    assert_eq!(found, (Entry::Output(0), "name", SceneFault::ReservedName));
}

#[test]
fn inertia_obeys_the_triangle_inequality_in_principal_moments() {
    let spoil = |six| refused(spatial(), |s| s.bodies[1].inertia = Inertia::Spatial(six));
    let found = spoil([1.0, 1.0, 2.5, 0.0, 0.0, 0.0]);
    assert_eq!(found, (Entry::Body(1), "inertia", SceneFault::TriangleInequality([2.5, 2.0])));
    // The diagonal moments are possible. The principal moments, in axes rotated by 45 degrees, are 0.5, 1.5, 2.5, and impossible.
    let (.., fault) = spoil([1.0, 1.0, 2.5, 0.5, 0.0, 0.0]);
    assert!(matches!(fault, SceneFault::TriangleInequality(_)), "{fault}");
    let (.., fault) = spoil([1.0, 1.0, 1.0, 2.0, 0.0, 0.0]);
    assert!(matches!(fault, SceneFault::NegativeInertia(x) if (x + 1.0).abs() < 1e-14), "{fault}");
    let (.., fault) = refused(planar(), |s| s.bodies[1].inertia = Inertia::Planar(-0.1));
    assert_eq!(fault, SceneFault::NegativeInertia(-0.1));
}

/// Scene with a frame whose inertia is physically impossible, welded to `upper` or to the ground.
fn with_frame(mass: f64, six: [f64; 6], to: BodyId) -> Scene<f64> {
    let mut scene = spatial();
    scene.bodies.push(body("frame", mass, Inertia::Spatial(six)));
    scene.joints.push(joint("fixed", JointKind::Weld, [to, BodyId::Body(2)]));
    scene
}

#[test]
fn inertias_are_those_of_what_is_welded_together() {
    let (dummy, upper) = ([1e-6; 6], BodyId::Body(1));
    let mut scene = with_frame(0.001, dummy, upper);
    assert_eq!(scene.check(), Ok(()));
    let odd = scene.odd_parts();
    assert!(matches!(odd[..], [(2, SceneFault::TriangleInequality(_))]), "{odd:?}");
    // a frame without mass also adds its inertia to the sum
    scene.bodies[2].mass = 0.0;
    scene.bodies[2].inertia = Inertia::Spatial([1e-6, 1e-6, 1e-6, 0.0, 0.0, 0.0]);
    assert_eq!(scene.check(), Ok(()));
    assert_eq!(scene.odd_parts(), [(2, SceneFault::InertiaWithoutMass)]);
    // a frame on the ground does not move, so that any inertia passes
    assert_eq!(with_frame(0.0, [-1.0, 0.0, 0.0, 2.0, 0.0, 0.0], BodyId::Ground).check(), Ok(()));
    // a frame that makes the sum impossible is refused at its own entry, not at that of the heavy body
    let (entry, spoilt) = (Entry::Body(2), [0.1, 0.1, 2.0, 0.0, 0.0, 0.0]);
    let found = with_frame(0.001, spoilt, upper).check().unwrap_err();
    assert!(matches!(found.fault, SceneFault::TriangleInequality(_)), "{found}");
    assert_eq!((found.entry, found.field), (entry, "inertia"));
    // on a joint that moves, the frame is a separate body
    let mut scene = with_frame(0.001, dummy, upper);
    scene.joints[2].kind = JointKind::Spherical;
    assert_eq!(scene.check().map_err(|e| e.entry), Err(entry));
    let mut scene = planar();
    scene.bodies.push(body("disc", 0.0, Inertia::Planar(-0.05)));
    scene.joints.push(joint("fixed", JointKind::Weld, [upper, BodyId::Body(2)]));
    assert_eq!(scene.check(), Ok(()), "0.1 - 0.05 about z");
}

#[test]
fn tables_of_guides_that_jump_within_the_run_are_refused() {
    let rows = [[0.0, 0.0], [0.25, 0.1], [0.5, 0.3]];
    let at = |shift: f64, ends| {
        let mut scene = planar();
        let rows = rows.map(|[t, x]| [t + shift, x]).to_vec();
        scene.guides =
            vec![Guide { joint: JointId::new(0), number: 0, law: Motion::Table { rows, ends } }];
        scene.check().expect("nothing is wrong with it until the duration is known");
        move |duration| scene.check_run(duration)
    };
    let natural = at(0.0, TableEnds::Natural);
    let error = natural(1.0).unwrap_err();
    let SceneFault::TableSlope { row: 2, is_end: true, time, rate } = error.fault else {
        panic!("{error}")
    };
    // Natural spline: its second derivative at the middle row is c₁ = 6 (0.8 − 0.4)/(4 · 0.25). Its slope at the end is 0.8 + c₁
    // 0.25/6 = 0.9.
    assert_eq!((error.entry, error.field, time), (Entry::Guide(0), "table", 0.5));
    assert!((rate - 0.9).abs() < 1e-14, "{rate}");
    assert_eq!(natural(0.5), Ok(()), "a run may end in motion");
    assert_eq!(natural(0.5 + 1e-12), Ok(()), "and rounding of its end is none of a table's");
    assert_eq!(natural(0.4), Ok(()));
    let later = at(0.1, TableEnds::Natural);
    let error = later(0.5).unwrap_err();
    assert!(matches!(error.fault, SceneFault::TableSlope { row: 0, is_end: false, .. }), "{error}");
    assert_eq!(later(0.05), Ok(()), "it never begins");
    assert_eq!(at(-0.2, TableEnds::Natural)(0.3), Ok(()), "in motion at both ends of the run");
    assert!(at(-0.5, TableEnds::Natural)(0.3).is_err(), "it stops at t = 0");
    assert_eq!(at(-0.6, TableEnds::Natural)(0.3), Ok(()), "it has ended before");
    for shift in [0.0, 0.1, -0.2, -0.5] {
        assert_eq!(at(shift, TableEnds::Level)(1.0), Ok(()));
    }
}

#[test]
fn thin_rods_and_plates_pass_in_any_direction() {
    let mut scene = spatial();
    let n = [0.36, 0.48, 0.8];
    for k in 0..40 {
        // Inertia of a thin rod along n: m L²/12 (1 − n nᵀ). Sizes extend over 40 decades.
        let size = 10.0_f64.powi(k - 20);
        let [xx, yy, zz] = n.map(|c| size * (1.0 - c * c));
        let six = [xx, yy, zz, -size * n[0] * n[1], -size * n[1] * n[2], -size * n[2] * n[0]];
        scene.bodies[1].inertia = Inertia::Spatial(six);
        assert_eq!(scene.check(), Ok(()), "{six:?}");
    }
    scene.bodies[1].inertia = Inertia::Spatial([0.0, 1.0 / 12.0, 1.0 / 12.0, 0.0, 0.0, 0.0]);
    assert_eq!(scene.check(), Ok(()));
}

#[test]
fn mass_properties_fit_the_scene() {
    let found = refused(planar(), |s| s.bodies[1].mass = 0.0);
    assert_eq!(found, (Entry::Body(1), "inertia", SceneFault::InertiaWithoutMass));
    let found = refused(spatial(), |s| s.bodies[1].inertia = Inertia::Planar(0.1));
    assert_eq!(found, (Entry::Body(1), "inertia", SceneFault::WrongDimension));
    let rod = Inertia::Rod { from: [1.0, 2.0, 0.0], to: [1.0, 2.0, 0.0] };
    let found = refused(planar(), |s| s.bodies[0].inertia = rod);
    assert_eq!(found, (Entry::Body(0), "rod", SceneFault::CoincidentPoints));
    let found = refused(planar(), |s| s.bodies[0].center[2] = 0.1);
    assert_eq!(found, (Entry::Body(0), "center", SceneFault::OutOfPlane(0.1)));
}

#[test]
fn joints_have_two_bodies_and_the_axes_of_their_kind() {
    let found = refused(planar(), |s| s.joints[1].bodies = [BodyId::Body(1); 2]);
    assert_eq!(found, (Entry::Joint(1), "bodies", SceneFault::SameBody));
    let found = refused(planar(), |s| s.joints[1].bodies[0] = BodyId::Body(7));
    assert_eq!(found, (Entry::Joint(1), "bodies", SceneFault::UnknownReference));
    let found = refused(planar(), |s| s.joints[1].kind = JointKind::Spherical);
    assert_eq!(found, (Entry::Joint(1), "kind", SceneFault::NeedsSpatial));
    let found = refused(planar(), |s| s.joints[1].points[1][0] = 1.0);
    assert_eq!(found, (Entry::Joint(1), "at", SceneFault::PointsDiffer));
    let found = refused(spatial(), |s| s.joints[1].axes[0] = Some([0.0; 3]));
    assert_eq!(found, (Entry::Joint(1), "axis", SceneFault::ZeroAxis));
    let found = refused(spatial(), |s| s.joints[1].axes[0] = None);
    assert_eq!(found, (Entry::Joint(1), "axis", SceneFault::Missing));
    let found = refused(spatial(), |s| {
        s.joints[1].kind = JointKind::Universal;
        s.joints[1].axes = [Some([1.0, 2.0, 3.0]), Some([-2.0, -4.0, -6.0])];
    });
    assert_eq!(found, (Entry::Joint(1), "axes", SceneFault::ParallelAxes));
    let found = refused(spatial(), |s| {
        s.joints[1].kind = JointKind::Planar;
        s.joints[1].axes = [Some([0.0, 0.0, 3.0]), Some([0.0, 0.0, 1.0e-3])];
    });
    assert_eq!(found, (Entry::Joint(1), "direction", SceneFault::ParallelAxes));
    let found = refused(planar(), |s| s.joints[1].kind = JointKind::Distance);
    assert_eq!(found, (Entry::Joint(1), "points", SceneFault::CoincidentPoints));
}

#[test]
fn guides_have_one_coordinate_once_and_ordered_rows() {
    let guide = |joint, law| Guide { joint, number: 0, law };
    let ramp = || Motion::Ramp { rate: 1.0 };
    let found = refused(planar(), |s| {
        s.joints[0].kind = JointKind::Weld;
        s.guides = vec![guide(JointId::new(0), ramp())];
    });
    assert_eq!(found, (Entry::Guide(0), "joint", SceneFault::NoSingleCoordinate(0)));
    let found = refused(planar(), |s| {
        s.guides = vec![guide(JointId::new(0), ramp()), guide(JointId::new(0), ramp())]
    });
    assert_eq!(found, (Entry::Guide(1), "joint", SceneFault::GivenTwice(0)));
    let rows = natural(vec![[0.0, 0.0], [1.0, 1.0], [1.0, 2.0]]);
    let found = refused(planar(), |s| s.guides = vec![guide(JointId::new(0), rows)]);
    assert_eq!(found, (Entry::Guide(0), "table", SceneFault::TableOrder(2)));
}

#[test]
fn initial_values_agree_with_guides_and_counts() {
    let law = Motion::Sine { amplitude: 2.0, frequency: 0.5, phase: 0.0 };
    let rate = 2.0 * core::f64::consts::PI;
    let mut guided = planar();
    guided.guides = vec![Guide { joint: JointId::new(0), number: 0, law }];
    guided.initials = vec![value(0, Some(vec![0.0]), Some(vec![rate + 1.0e-10]))];
    let (entry, field, fault) =
        refused(guided, |s| s.initials = vec![value(0, None, Some(vec![rate + 1.0e-6]))]);
    assert_eq!((entry, field), (Entry::Initial(0), "rate"));
    assert!(matches!(fault, SceneFault::Contradiction { .. }), "{fault}");
    let found = refused(planar(), |s| s.initials = vec![value(1, Some(vec![0.0, 1.0]), None)]);
    let count = SceneFault::WrongCount { needed: 1, found: 2 };
    assert_eq!(found, (Entry::Initial(0), "value", count));
    let twice = || value(1, Some(vec![0.0]), None);
    let found = refused(planar(), |s| s.initials = vec![twice(), twice()]);
    assert_eq!(found, (Entry::Initial(1), "value", SceneFault::GivenTwice(0)));
}

#[test]
fn effects_act_between_different_points_and_on_rotations() {
    let (ground, upper) = (BodyId::Ground, BodyId::Body(0));
    let apart = [[0.0; 3], [1.0, 0.0, 0.0]];
    let found = refused(planar(), |s| s.effects = vec![spring([[1.0; 3]; 2], [ground, upper])]);
    assert_eq!(found, (Entry::Effect(0), "points", SceneFault::OutOfPlane(1.0)));
    let found = refused(planar(), |s| s.effects = vec![spring([[0.0; 3]; 2], [ground, upper])]);
    assert_eq!(found, (Entry::Effect(0), "points", SceneFault::CoincidentPoints));
    let found = refused(planar(), |s| s.effects = vec![spring(apart, [upper, upper])]);
    assert_eq!(found, (Entry::Effect(0), "bodies", SceneFault::SameBody));
    let found = refused(spatial(), |s| {
        (s.joints[1].kind, s.joints[1].axes) = (JointKind::Weld, [None; 2]);
        let course = Signal::Constant([1.0, 0.0, 0.0]);
        let kind = EffectKind::JointTorque(JointTorque {
            joint: JointId::new(1),
            coordinate: None,
            course,
        });
        s.effects = vec![Effect { name: "motor".into(), enabled: true, kind }];
    });
    assert_eq!(found, (Entry::Effect(0), "joint", SceneFault::NoSingleRotation(0)));
}

#[test]
fn unusual_scenes_pass() {
    let mut scene = planar();
    scene.joints.push(joint("again", JointKind::Revolute, scene.joints[0].bodies));
    scene.bodies.push(body("loose", 1.0, Inertia::Planar(0.0)));
    scene.bodies.push(body("link", 0.0, Inertia::Planar(0.0)));
    assert_eq!(scene.check(), Ok(()));
}

#[test]
fn messages_are_sentences_with_numbers_and_advice() {
    let mut scene = planar();
    scene.bodies[1].mass = -2.5;
    let text: String = format!("{}", scene.check().unwrap_err());
    assert_eq!(text, "`mass` of body 2 must not be negative, but is -2.5; write zero or more");
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![any::<f64>(), -2.0..2.0_f64, Just(0.0), Just(1.0)]
}

fn any_vector() -> impl Strategy<Value = [f64; 3]> {
    [any_number(), any_number(), any_number()]
}

fn any_joint() -> impl Strategy<Value = Joint<f64>> {
    let reference = || prop_oneof![Just(BodyId::Ground), (0..3_usize).prop_map(BodyId::Body)];
    let axis = || proptest::option::of(any_vector());
    let kind = (0..JointKind::ALL.len()).prop_map(|i| JointKind::ALL[i]);
    (kind, [reference(), reference()], [any_vector(), any_vector()], [axis(), axis()]).prop_map(
        |(kind, bodies, points, axes)| Joint {
            name: "j".into(),
            kind,
            bodies,
            points,
            axes,
            limits: JointLimits::NONE,
        },
    )
}

proptest! {
    #[test]
    fn arbitrary_data_never_panics(
        numbers in proptest::collection::vec(any_number(), 24),
        joints in proptest::collection::vec(any_joint(), 0..4),
        references in proptest::collection::vec(0..5_usize, 4),
        is_planar in any::<bool>(),
    ) {
        let mut scene = if is_planar { planar() } else { spatial() };
        let vector = |i: usize| [numbers[i], numbers[i + 1], numbers[i + 2]];
        scene.duration = numbers[0].abs() + 1.0;
        if !joints.is_empty() {
            scene.joints = joints;
            for (i, joint) in scene.joints.iter_mut().enumerate() {
                joint.name = format!("j{i}");
            }
        }
        let six = core::array::from_fn(|i| numbers[i]);
        scene.bodies[0].inertia = Inertia::Spatial(six);
        let rows = (0..4).map(|i| [numbers[2 * i], numbers[2 * i + 1]]).collect();
        scene.guides = vec![Guide { joint: JointId::new(references[0]), number: 0, law: natural(rows) }];
        scene.initials = vec![value(references[1], Some(numbers[..references[2]].to_vec()), None)];
        scene.effects = vec![spring([vector(3), vector(6)], [BodyId::Body(references[3]), BodyId::Ground])];
        let rows = (0..4).map(|i| [numbers[2 * i], numbers[2 * i + 1]]).collect();
        let (start, length, height) = (numbers[8], numbers[9], numbers[10]);
        let rounding = numbers[11];
        scene.road.left = vec![
            RoadFeature::Rise { start, length, height, rounding },
            RoadFeature::Bump { start, length, amplitude: height },
            RoadFeature::Table(rows),
        ];
        let _ = scene.check();
        let piece = |i: usize| PolynomialPiece {
            lower: numbers[i],
            upper: numbers[i + 1],
            coefficients: numbers[..references[1] * 3].to_vec(),
        };
        let kind = EffectKind::Polynomial(Polynomial {
            bodies: [BodyId::Body(references[0]), BodyId::Ground],
            points: [vector(3), vector(6)],
            direction: is_planar.then(|| vector(9)),
            of_rate: false,
            pieces: vec![piece(0), piece(1)],
        });
        scene.effects = effects::effect(kind);
        let _ = scene.check();
        scene.bodies.pop();
        scene.joints.clear();
        let _ = scene.check();
    }
}

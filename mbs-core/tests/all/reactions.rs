//! Joint reactions, compared with closed forms and with the balance of the whole mechanism.

use crate::small::{GROUND, add_body, add_joint, add_rod, guide, hold, scene, start};
use mbs_core::algebra::{Vector, rotation};
use mbs_core::outputs::{LARGEST_BLOCK, ReactionError, Reactions};
use mbs_core::scene::{
    AxisFrame, BodyId, BodyTorque, Dimension, Effect, EffectKind, Force, Inertia, Joint, JointId,
    JointKind, JointLimits, JointTorque, Motion, Scene, Signal, SpringDamper, TorsionSpring,
};

const G: f64 = 9.81;
/// Allowed error: forces are of order 10 to 100 N, and assembled accelerations have eleven digits.
const CLOSED: f64 = 1e-9;
const PLANE: [f64; 3] = [0.0, -G, 0.0];

fn reactions<const D: usize>(scene: &Scene<f64>) -> Reactions<f64, D> {
    let (model, state) = start::<D>(scene);
    let mut reactions = Reactions::new(scene, &model).expect("reactions");
    reactions.update(&state);
    assert!(reactions.residual() < CLOSED, "{:e} N are left", reactions.residual());
    reactions
}

fn assert_near(found: [f64; 6], expected: [f64; 6]) {
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() < CLOSED, "{found:?} is not {expected:?}");
    }
}

/// Planar reaction in the six components of an output.
fn planar(x: f64, y: f64, moment: f64) -> [f64; 6] {
    [x, y, moment, 0.0, 0.0, 0.0]
}

/// Scene of a rod of 2 kg and 1.5 m along x that swings about the origin.
fn pendulum() -> Scene<f64> {
    let mut s = scene(Dimension::Planar, PLANE);
    let rod = add_rod(&mut s, 2.0, [0.0; 3], [1.5, 0.0, 0.0]);
    add_joint(&mut s, JointKind::Revolute, [GROUND, rod], [0.0; 3], [None; 2]);
    s
}

#[test]
fn a_hanging_pendulum_carries_its_weight() {
    let mut s = pendulum();
    hold(&mut s, 0, &[-core::f64::consts::FRAC_PI_2], &[0.0]);
    let r = reactions::<2>(&s);
    assert_near(r.reaction(0), planar(0.0, 2.0 * G, 0.0));
    assert!(r.is_unique(0));
}

#[test]
fn a_swinging_pendulum_feels_weight_and_centrifugal_force() {
    let mut s = pendulum();
    let (angle, rate) = (-0.9_f64, 2.5);
    hold(&mut s, 0, &[angle], &[rate]);
    let (sin, cos) = angle.sin_cos();
    // along the rod: m g sin - m l/2 w^2; perpendicular to it: m g cos / 4
    let (along, across) = (2.0 * (G * sin - 0.75 * rate * rate), 2.0 * G * cos / 4.0);
    let expected = planar(along * cos - across * sin, along * sin + across * cos, 0.0);
    assert_near(reactions::<2>(&s).reaction(0), expected);
}

/// Scene of a body on an axis along x, whose centre is beside and below the bearing.
fn offset_pendulum(bodies: [usize; 2]) -> Scene<f64> {
    let mut s = scene(Dimension::Spatial, [0.0, 0.0, -G]);
    let inertia = Inertia::Spatial([0.3, 0.4, 0.5, 0.02, 0.01, -0.03]);
    let body = add_body(&mut s, 3.0, [0.4, 0.0, -0.7], inertia);
    let pair = bodies.map(|i| [GROUND, body][i]);
    let axis = [Some([2.0, 0.0, 0.0]), None];
    add_joint(&mut s, JointKind::Revolute, pair, [0.0; 3], axis);
    s
}

#[test]
fn an_offset_bearing_carries_moments_across_its_axis() {
    let mut s = offset_pendulum([0, 1]);
    let w = 1.7;
    hold(&mut s, 0, &[], &[w]);
    let force = 3.0 * (G + w * w * 0.7);
    // moments (c - p) x F and w x I w, with the products Ixy = 0.02, Izx = -0.03
    let expected = [0.0, 0.0, force, 0.0, -0.4 * force + 0.03 * w * w, 0.02 * w * w];
    let r = reactions::<3>(&s);
    assert_near(r.reaction(0), expected);
    assert!(r.is_unique(0));
}

#[test]
fn reversing_the_bodies_of_a_joint_reverses_its_reaction() {
    let [a, b] = [([0, 1], 1.7), ([1, 0], -1.7)].map(|(pair, rate)| {
        let mut s = offset_pendulum(pair);
        hold(&mut s, 0, &[0.3 * f64::signum(rate)], &[rate]);
        reactions::<3>(&s).reaction(0)
    });
    assert_near(a, b.map(|x| -x));
}

#[test]
fn a_guided_joint_carries_the_torque_of_inverse_dynamics() {
    let mut s = pendulum();
    let (amplitude, frequency, phase) = (0.6, 0.8, 0.4);
    guide(&mut s, 0, Motion::Sine { amplitude, frequency, phase });
    let omega = 2.0 * core::f64::consts::PI * frequency;
    let angle: f64 = amplitude * f64::sin(phase);
    let rate = amplitude * omega * f64::cos(phase);
    let alpha = -omega * omega * angle;
    let torque = 2.0 * 1.5 * 1.5 / 3.0 * alpha + 2.0 * G * 0.75 * angle.cos();
    let (along, across) =
        (2.0 * (G * angle.sin() - 0.75 * rate * rate), 2.0 * (G * angle.cos() + 0.75 * alpha));
    let (sin, cos) = angle.sin_cos();
    let expected = planar(along * cos - across * sin, along * sin + across * cos, torque);
    let r = reactions::<2>(&s);
    assert_near(r.reaction(0), expected);
    assert!(r.is_unique(0));
}

/// Scene of two rods of 1 m in line, welded together. A joint of `kind` holds the first one at the origin.
fn beam(kind: JointKind) -> Scene<f64> {
    let mut s = scene(Dimension::Planar, PLANE);
    let a = add_rod(&mut s, 2.0, [0.0; 3], [1.0, 0.0, 0.0]);
    let b = add_rod(&mut s, 3.0, [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]);
    add_joint(&mut s, kind, [GROUND, a], [0.0; 3], [None; 2]);
    add_joint(&mut s, JointKind::Weld, [a, b], [1.0, 0.0, 0.0], [None; 2]);
    s
}

#[test]
fn a_beam_of_two_welded_spans_passes_shear_and_bending() {
    let r = reactions::<2>(&beam(JointKind::Weld));
    assert_near(r.reaction(0), planar(0.0, 5.0 * G, 2.0 * G * 0.5 + 3.0 * G * 1.5));
    assert_near(r.reaction(1), planar(0.0, 3.0 * G, 3.0 * G * 0.5));
    assert!(r.is_unique(0) && r.is_unique(1));
}

#[test]
fn a_weld_inside_a_falling_beam_passes_what_its_second_part_needs() {
    let r = reactions::<2>(&beam(JointKind::Revolute));
    let about_end = 2.0 / 3.0 + 3.0 * (1.0 / 12.0 + 2.25);
    let alpha = -G * (2.0 * 0.5 + 3.0 * 1.5) / about_end;
    let shear = 3.0 * (1.5 * alpha + G);
    assert_near(r.reaction(1), planar(0.0, shear, 0.5 * shear + 0.25 * alpha));
    assert_near(r.reaction(0), planar(0.0, 5.0 * G + alpha * (2.0 * 0.5 + 3.0 * 1.5), 0.0));
}

#[test]
fn a_beam_clamped_at_both_ends_is_marked_and_its_smallest_reactions_are_symmetric() {
    let mut s = beam(JointKind::Weld);
    s.bodies[1].mass = 2.0;
    let end = [2.0, 0.0, 0.0];
    add_joint(&mut s, JointKind::Weld, [GROUND, BodyId::Body(1)], end, [None; 2]);
    let r = reactions::<2>(&s);
    let (left, right) = (r.reaction(0), r.reaction(2));
    assert_near(left, planar(0.0, 2.0 * G, left[2]));
    assert_near(right, planar(0.0, 2.0 * G, -left[2]));
    assert!(!r.is_unique(0) && !r.is_unique(1) && !r.is_unique(2));
}

/// Scene of a four-bar linkage in the plane z = 0, without a drive. Every place is rotated by the rotation vector `w`.
fn four_bar(dimension: Dimension, w: [f64; 3]) -> Scene<f64> {
    let turned =
        |x: [f64; 3]| -> [f64; 3] { (rotation(&Vector::from(w)) * Vector::from(x)).into() };
    let mut s = scene(dimension, turned(PLANE));
    let [a, b, c, d] = [[0.0; 3], [0.0, 1.0, 0.0], [1.5, 1.4, 0.0], [1.2, 0.0, 0.0]].map(turned);
    let inertia = match dimension {
        Dimension::Planar => Inertia::Planar(0.2),
        // equal moments, so that the rotation does not change the inertia
        Dimension::Spatial => Inertia::Spatial([0.2, 0.2, 0.2, 0.0, 0.0, 0.0]),
    };
    let bars = [(a, b), (b, c), (c, d)].map(|(p, q)| {
        let center = core::array::from_fn(|i| 0.5 * (p[i] + q[i]));
        add_body(&mut s, 1.3, center, inertia)
    });
    let axis = [(dimension == Dimension::Spatial).then(|| turned([0.0, 0.0, 1.0])), None];
    let pairs = [[GROUND, bars[0]], [bars[0], bars[1]], [bars[1], bars[2]], [bars[2], GROUND]];
    for (pair, at) in pairs.into_iter().zip([a, b, c, d]) {
        add_joint(&mut s, JointKind::Revolute, pair, at, axis);
    }
    hold(&mut s, 0, &[], &[1.4]);
    s
}

#[test]
fn the_planar_four_bar_is_determined_and_the_spatial_one_is_not() {
    let flat = reactions::<2>(&four_bar(Dimension::Planar, [0.0; 3]));
    let deep = reactions::<3>(&four_bar(Dimension::Spatial, [0.0; 3]));
    for joint in 0..4 {
        assert!(flat.is_unique(joint) && !deep.is_unique(joint));
        let [x, y, moment, ..] = flat.reaction(joint);
        // no force acts out of the plane, so that the smallest reactions stay in the plane
        assert_near(deep.reaction(joint), [x, y, 0.0, 0.0, 0.0, moment]);
    }
}

#[test]
fn the_reactions_of_the_ground_give_the_mass_its_acceleration() {
    let s = four_bar(Dimension::Spatial, [0.3, -0.5, 0.8]);
    let (model, state) = start::<3>(&s);
    let mut r = Reactions::new(&s, &model).unwrap();
    r.update(&state);
    let mut total = Vector::<f64, 3>::zeros();
    for (joint, sign) in [(0, 1.0), (3, -1.0)] {
        let [x, y, z, ..] = r.reaction(joint);
        total += Vector::<f64, 3>::from([x, y, z]) * sign;
    }
    let gravity = Vector::<f64, 3>::from(s.gravity.unwrap());
    for (b, body) in s.bodies.iter().enumerate() {
        let center = model.point(BodyId::Body(b), body.center);
        total -= (center.rate(&state.a) - gravity) * body.mass;
    }
    assert!(total.iter().all(|x| x.abs() < CLOSED), "{total}");
}

#[test]
fn turning_the_whole_scene_turns_its_reactions() {
    let w = [0.7, -0.4, 1.1];
    let still = reactions::<3>(&four_bar(Dimension::Spatial, [0.0; 3]));
    let turned = reactions::<3>(&four_bar(Dimension::Spatial, w));
    let r = rotation(&Vector::<f64, 3>::from(w));
    for joint in 0..4 {
        let [a, b, c, d, e, f] = still.reaction(joint);
        let (force, moment) = (r * Vector::from([a, b, c]), r * Vector::from([d, e, f]));
        let expected = [force[0], force[1], force[2], moment[0], moment[1], moment[2]];
        assert_near(turned.reaction(joint), expected);
    }
}

#[test]
fn two_hinges_of_a_door_share_its_weight_and_are_marked() {
    let mut s = scene(Dimension::Spatial, [0.0, 0.0, -G]);
    let inertia = Inertia::Spatial([0.3, 0.4, 0.5, 0.0, 0.0, 0.0]);
    let door = add_body(&mut s, 8.0, [0.5, 0.0, 1.0], inertia);
    let axis = [Some([0.0, 0.0, 1.0]), None];
    for height in [0.2, 1.8] {
        add_joint(&mut s, JointKind::Revolute, [GROUND, door], [0.0, 0.0, height], axis);
    }
    let r = reactions::<3>(&s);
    for hinge in 0..2 {
        assert!((r.reaction(hinge)[2] - 4.0 * G).abs() < CLOSED);
        assert!(!r.is_unique(hinge));
    }
}

#[test]
fn a_joint_named_twice_is_split_evenly_and_the_others_stay_unique() {
    let mut s = pendulum();
    let tip = [1.5, 0.0, 0.0];
    let second = add_rod(&mut s, 1.0, tip, [2.5, 0.0, 0.0]);
    for _ in 0..2 {
        add_joint(&mut s, JointKind::Revolute, [BodyId::Body(0), second], tip, [None; 2]);
    }
    let doubled = reactions::<2>(&s);
    s.joints.pop();
    let once = reactions::<2>(&s);
    assert_near(doubled.reaction(1), once.reaction(1).map(|x| 0.5 * x));
    assert_near(doubled.reaction(2), doubled.reaction(1));
    assert_near(doubled.reaction(0), once.reaction(0));
    assert_eq!([0, 1, 2].map(|j| doubled.is_unique(j)), [true, false, false]);
}

/// Scene of seven spatial bodies in a row with a joint of every kind, closed by a hinged link.
fn every_joint() -> Scene<f64> {
    let mut s = scene(Dimension::Spatial, [0.3, -1.0, -G]);
    let inertia = Inertia::Spatial([0.3, 0.4, 0.5, 0.02, 0.01, -0.03]);
    let (a, b) = ([0.1, 0.2, 1.0], [1.0, -0.3, 0.2]);
    let kinds = [
        (JointKind::Revolute, [Some(a), None]),
        (JointKind::Universal, [Some(b), Some(a)]),
        (JointKind::Cylindrical, [Some(b), None]),
        (JointKind::Weld, [None; 2]),
        (JointKind::Spherical, [None; 2]),
        (JointKind::Prismatic, [Some(a), None]),
        (JointKind::Planar, [Some(b), Some(a)]),
    ];
    let mut last = GROUND;
    for (i, (kind, axes)) in kinds.into_iter().enumerate() {
        let x = 0.6 * i as f64;
        let center = [x + 0.3, 0.2 * (x * 3.0).sin(), 0.1 * (x * 2.0).cos()];
        let body = add_body(&mut s, 1.0 + 0.3 * x, center, inertia);
        add_joint(&mut s, kind, [last, body], [x, 0.1 * x, 0.0], axes);
        last = body;
    }
    let points = [[4.0, 1.0, -0.5], [4.2, 0.1, 0.3]];
    let (name, bodies) = ("link".into(), [GROUND, last]);
    let (kind, axes, limits) = (JointKind::Distance, [Some(a), None], JointLimits::NONE);
    s.joints.push(Joint { name, kind, bodies, points, axes, limits });
    for (joint, rate) in [(0, vec![0.8]), (2, vec![0.3, -0.6]), (5, vec![0.5])] {
        hold(&mut s, joint, &[], &rate);
    }
    s
}

/// Adds an effect of each kind and variant.
fn add_effects(s: &mut Scene<f64>) {
    let rising = |end: [f64; 3]| Signal::Table(vec![(-1.0, [1.0, 2.0, -1.0]), (1.0, end)]);
    let spring = |(joint, coordinate), [stiffness, damping, free_value]: [f64; 3]| {
        let joint = JointId::new(joint);
        EffectKind::TorsionSpring(TorsionSpring {
            joint,
            coordinate,
            stiffness,
            damping,
            free_value,
        })
    };
    let kinds = [
        EffectKind::SpringDamper(SpringDamper {
            bodies: [BodyId::Body(1), BodyId::Body(6)],
            points: [[0.5, 0.4, 0.3], [3.9, -0.5, 0.2]],
            stiffness: 120.0,
            damping: 15.0,
            free_length: 2.0,
        }),
        spring((2, None), [40.0, 3.0, 0.4]),
        spring((2, Some(0)), [300.0, 4.0, 0.3]),
        EffectKind::JointTorque(JointTorque {
            joint: JointId::new(1),
            coordinate: Some(0),
            course: Signal::Constant([3.0, 0.0, 0.0]),
        }),
        spring((1, Some(1)), [25.0, 2.0, 0.8]),
        spring((6, Some(1)), [90.0, 1.0, -0.2]),
        EffectKind::JointTorque(JointTorque {
            joint: JointId::new(0),
            coordinate: None,
            course: Signal::Constant([7.0, 0.0, 0.0]),
        }),
        EffectKind::Force(Force {
            body: BodyId::Body(4),
            at: [2.5, 0.3, -0.2],
            course: rising([5.0, -3.0, 8.0]),
            frame: AxisFrame::Global,
        }),
        EffectKind::Force(Force {
            body: BodyId::Body(5),
            at: [3.5, 0.3, 0.2],
            course: Signal::Constant([2.0, 5.0, -4.0]),
            frame: AxisFrame::Body,
        }),
        EffectKind::BodyTorque(BodyTorque {
            body: BodyId::Body(3),
            course: rising([0.0, 4.0, -2.0]),
        }),
    ];
    for kind in kinds {
        s.effects.push(Effect { name: format!("effect {}", s.effects.len()), enabled: true, kind });
    }
}

#[test]
fn the_balance_closes_with_every_kind_of_joint_and_effect() {
    let mut s = every_joint();
    let r = reactions::<3>(&s);
    assert!((0..s.joints.len()).all(|joint| r.is_unique(joint)));
    add_effects(&mut s);
    hold(&mut s, 1, &[0.2, -0.3], &[]);
    // `reactions` itself asserts that all forces are balanced
    let loaded = reactions::<3>(&s);
    assert!((r.reaction(0)[2] - loaded.reaction(0)[2]).abs() > 1.0);
}

#[test]
fn a_rod_between_balls_and_a_planar_slide_are_balanced() {
    let mut s = scene(Dimension::Spatial, [0.0, 0.0, -G]);
    let rod = add_rod(&mut s, 1.0, [0.0; 3], [1.0, 0.0, 0.5]);
    add_joint(&mut s, JointKind::Spherical, [GROUND, rod], [0.0; 3], [None; 2]);
    let r = reactions::<3>(&s);
    assert!(r.is_unique(0));
    let mut s = scene(Dimension::Planar, PLANE);
    let block = add_body(&mut s, 2.0, [1.0, 0.5, 0.0], Inertia::Planar(0.1));
    let axis = [Some([3.0, 4.0, 0.0]), None];
    add_joint(&mut s, JointKind::Prismatic, [GROUND, block], [0.0; 3], axis);
    // the normal force m g cos, with the moment about the joint's place
    let normal = 2.0 * G * 0.6;
    let (x, y) = (-0.8 * normal, 0.6 * normal);
    assert_near(reactions::<2>(&s).reaction(0), planar(x, y, y - 0.5 * x));
}

#[test]
fn long_trees_pass_and_loops_beyond_the_limit_are_refused() {
    let mut s = scene(Dimension::Planar, PLANE);
    let mut last = GROUND;
    let n = LARGEST_BLOCK / 2;
    for i in 0..n {
        let at = [i as f64, 0.0, 0.0];
        let rod = add_rod(&mut s, 1.0, at, [at[0] + 1.0, 0.0, 0.0]);
        add_joint(&mut s, JointKind::Revolute, [last, rod], at, [None; 2]);
        last = rod;
    }
    let model = mbs_core::natural::NaturalModel::<f64, 2>::new(&s).unwrap();
    assert!(Reactions::new(&s, &model).is_ok());
    add_joint(&mut s, JointKind::Revolute, [last, GROUND], [n as f64, 0.0, 0.0], [None; 2]);
    let model = mbs_core::natural::NaturalModel::<f64, 2>::new(&s).unwrap();
    let error = Reactions::new(&s, &model).unwrap_err();
    assert_eq!(
        error,
        ReactionError::TooLarge { unknowns: LARGEST_BLOCK + 2, limit: LARGEST_BLOCK }
    );
}

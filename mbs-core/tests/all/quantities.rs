//! Energies, momenta and orientation, and forces of effects, couplings and guides, compared with closed forms.

use crate::small::{GROUND, add_body, add_joint, add_rod, guide, hold, output, scene, start};
use core::f64::consts::PI;
use mbs_core::algebra::{Vector, norm, rotation};
use mbs_core::outputs::{Forces, Measures, RelativePoint};
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{
    AxisFrame, BodyId, Bumper, Bushing, Coupling, CouplingId, CouplingMeasure, CouplingTerm,
    Dimension, Effect, EffectId, EffectKind, Force, Inertia, JointId, JointKind, JointTorque,
    Limit, Motion, Quantity, Scene, Signal, SpringDamper,
};

const G: f64 = 9.81;
/// Error of the assembly: rounding of a few products of numbers of order ten.
const CLOSED: f64 = 1e-10;

/// Values of quantities at the start of a scene.
fn measured<const D: usize>(scene: &Scene<f64>, quantities: &[Quantity<f64>]) -> Vec<f64> {
    let mut scene = scene.clone();
    quantities.iter().for_each(|quantity| output(&mut scene, quantity.clone()));
    let (model, state) = start::<D>(&scene);
    let mut forces = Forces::new(&scene, &model).expect("reactions");
    forces.update(&state);
    let mut measures = Measures::new(&scene, &model).expect("channels");
    let mut out = vec![f64::NAN; measures.n_components()];
    measures.write(&state, Some(&forces), &mut out).expect("turns are known");
    out
}

fn assert_near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() < CLOSED, "{found:?} is not {expected:?}");
    }
}

fn add_effect(scene: &mut Scene<f64>, kind: impl Into<EffectKind<f64>>) -> EffectId {
    let name = format!("effect {}", scene.effects.len());
    scene.effects.push(Effect { name, kind: kind.into(), enabled: true });
    EffectId::new(scene.effects.len() - 1)
}

/// Scene of a rod of 3 kg and 2 m that swings about the origin.
fn pendulum(angle: f64, rate: f64) -> Scene<f64> {
    let mut s = scene(Dimension::Planar, [0.0, -G, 0.0]);
    let rod = add_rod(&mut s, 3.0, [0.0; 3], [2.0, 0.0, 0.0]);
    add_joint(&mut s, JointKind::Revolute, [GROUND, rod], [0.0; 3], [None; 2]);
    hold(&mut s, 0, &[angle], &[rate]);
    s
}

#[test]
fn a_pendulum_has_the_energy_and_the_momentum_of_its_rod() {
    let (angle, rate) = (0.4_f64, 1.5);
    let (joint, body) = (JointId::new(0), BodyId::Body(0));
    let (sin, cos) = angle.sin_cos();
    let (kinetic, potential) = (0.5 * (3.0 * 4.0 / 3.0) * rate * rate, 3.0 * G * sin);
    let alpha = -1.5 * G * cos / 2.0;
    let quantities = [
        Quantity::KineticEnergy,
        Quantity::BodyKineticEnergy { body },
        Quantity::PotentialEnergy,
        Quantity::Energy,
        Quantity::CenterOfMass,
        Quantity::Momentum,
        Quantity::AngularMomentum,
        Quantity::Orientation { body },
        Quantity::AngularAcceleration { body },
        Quantity::JointAcceleration { joint },
        Quantity::JointEffort { joint },
    ];
    let expected = [
        kinetic,
        kinetic,
        potential,
        kinetic + potential,
        cos,
        sin,
        -3.0 * rate * sin,
        3.0 * rate * cos,
        rate,
        angle,
        alpha,
        alpha,
        0.0,
    ];
    assert_near(&measured::<2>(&pendulum(angle, rate), &quantities), &expected);
}

#[test]
fn a_free_body_has_the_angular_momentum_of_its_turning_wherever_it_is() {
    let mut s = scene(Dimension::Spatial, [0.0; 3]);
    let inertia = [0.3, 0.4, 0.5, 0.02, 0.01, -0.03];
    let body = add_body(&mut s, 2.0, [0.2, 0.5, 0.1], Inertia::Spatial(inertia));
    add_joint(&mut s, JointKind::Free, [GROUND, body], [0.2, 0.5, 0.1], [None; 2]);
    let (v, w) = ([0.3, -0.2, 0.7], [1.0, 2.0, -0.5]);
    hold(&mut s, 0, &[0.0; 6], &[v, w].concat());
    let [xx, yy, zz, xy, yz, zx] = inertia;
    let rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    let dot = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let spin = rows.map(|row| dot(&row, &w));
    let energy = 0.5 * (2.0 * dot(&v, &v) + dot(&w, &spin));
    let quantities = [
        Quantity::Momentum,
        Quantity::AngularMomentum,
        Quantity::KineticEnergy,
        Quantity::Energy,
        Quantity::CenterOfMass,
        Quantity::Orientation { body },
    ];
    let mut expected = v.map(|v| 2.0 * v).to_vec();
    expected.extend(spin);
    expected.extend([energy, energy, 0.2, 0.5, 0.1, 1.0, 0.0, 0.0, 0.0]);
    assert_near(&measured::<3>(&s, &quantities), &expected);
}

#[test]
fn two_bodies_have_the_angular_momentum_of_their_going_round_each_other() {
    let mut s = scene(Dimension::Planar, [0.0; 3]);
    for (x, mass, v) in [(0.0, 2.0, 0.5), (3.0, 1.0, 2.0)] {
        let body = add_body(&mut s, mass, [x, 1.0, 0.0], Inertia::Planar(0.1));
        let joint = add_joint(&mut s, JointKind::Free, [GROUND, body], [x, 1.0, 0.0], [None; 2]);
        hold(&mut s, joint, &[0.0; 3], &[0.0, v, 0.0]);
    }
    // angular momentum: reduced mass times distance times relative speed
    let expected = [1.0, 1.0, 0.0, 3.0, 2.0 / 3.0 * 3.0 * 1.5];
    let quantities = [Quantity::CenterOfMass, Quantity::Momentum, Quantity::AngularMomentum];
    assert_near(&measured::<2>(&s, &quantities), &expected);
}

#[test]
fn a_quaternion_continues_over_two_turns_and_the_angle_of_the_plane_too() {
    let axis = Vector::<f64, 3>::new(2.0, -1.0, 0.5);
    let axis = axis * (1.0 / norm(&axis));
    let mut s = scene(Dimension::Spatial, [0.0; 3]);
    let body = add_body(&mut s, 1.0, [0.0; 3], Inertia::Spatial([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]));
    output(&mut s, Quantity::Orientation { body });
    let (model, mut state) = start::<3>(&s);
    let mut measures = Measures::new(&s, &model).expect("channels");
    let mut out = [0.0; 4];
    for i in 0..=80 {
        let angle = f64::from(i) * PI / 20.0;
        let motion = RigidMotion {
            rotation: rotation(&(axis * angle)),
            ..RigidMotion::at_rest(Vector::zeros())
        };
        model.write_motions(&[motion], &mut state);
        state.t = f64::from(i);
        measures.write(&state, None, &mut out).expect("turns are known");
        let (sin, cos) = (0.5 * angle).sin_cos();
        assert_near(&out, &[cos, axis[0] * sin, axis[1] * sin, axis[2] * sin]);
    }
    let turns = measured::<2>(&pendulum(0.4, 1.5), &[Quantity::Orientation { body }]);
    assert_near(&turns, &[0.4]);
}

#[test]
fn a_rotation_is_a_vector_over_two_turns_and_a_matrix() {
    let axis = Vector::<f64, 3>::new(2.0, -1.0, 0.5);
    let axis = axis * (1.0 / norm(&axis));
    let mut s = scene(Dimension::Spatial, [0.0; 3]);
    let body = add_body(&mut s, 1.0, [0.0; 3], Inertia::Spatial([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]));
    output(&mut s, Quantity::RotationVector { body });
    output(&mut s, Quantity::RotationMatrix { body });
    let seen =
        RelativePoint { body, at: [0.3, 0.0, 0.4], relative_to: GROUND, origin: [0.0, 0.0, 0.0] };
    output(&mut s, Quantity::Distance(seen));
    let (model, mut state) = start::<3>(&s);
    let mut measures = Measures::new(&s, &model).expect("channels");
    let mut out = [0.0; 13];
    for i in 0..=80 {
        let angle = f64::from(i) * PI / 20.0;
        let rotation = rotation(&(axis * angle));
        let motion = RigidMotion { rotation, ..RigidMotion::at_rest(Vector::zeros()) };
        model.write_motions(&[motion], &mut state);
        state.t = f64::from(i);
        measures.write(&state, None, &mut out).expect("turns are known");
        let rows: Vec<f64> = (0..9).map(|k| rotation[(k / 3, k % 3)]).collect();
        let vector = axis * angle;
        assert_near(&out, &[vector.as_slice(), &rows, &[0.5]].concat());
    }
    let mut planar = pendulum(0.4, 1.5);
    let (sin, cos) = 0.4_f64.sin_cos();
    let quantities = [Quantity::RotationVector { body }, Quantity::RotationMatrix { body }];
    assert_near(&measured::<2>(&planar, &quantities), &[0.4, cos, -sin, sin, cos]);
    // effects that measure several numbers, or have neither a free value nor a gap
    let push = Force {
        body,
        at: [2.0, 0.0, 0.0],
        course: Signal::Constant([0.0, 5.0, 0.0]),
        frame: AxisFrame::Body,
    };
    let effect = add_effect(&mut planar, push);
    assert!(Quantity::EffectDeflection { effect }.components(&planar).is_empty());
}

#[test]
fn a_spring_pulls_stores_and_gives_what_its_law_says() {
    let (angle, rate) = (0.4_f64, 1.5);
    let mut s = pendulum(angle, rate);
    let (k, c, free) = (50.0, 3.0, 0.7);
    let kind = SpringDamper {
        bodies: [GROUND, BodyId::Body(0)],
        points: [[0.0, -1.0, 0.0], [2.0, 0.0, 0.0]],
        stiffness: k,
        damping: c,
        free_length: free,
    };
    let effect = add_effect(&mut s, kind);
    // one end at (2 cos, 2 sin), the other at (0, -1)
    let (sin, cos) = angle.sin_cos();
    let length = (4.0 * cos * cos + (2.0 * sin + 1.0).powi(2)).sqrt();
    let speed = 2.0 * cos * rate / length;
    let (tension, stored) =
        (k * (length - free) + c * speed, 0.5 * k * (length - free) * (length - free));
    let quantities = [
        Quantity::EffectForce { effect },
        Quantity::EffectValue { effect },
        Quantity::EffectRate { effect },
        Quantity::EffectEnergy { effect },
        Quantity::EffectPower { effect },
        Quantity::EffectDeflection { effect },
        Quantity::PotentialEnergy,
    ];
    let energy = stored + 3.0 * G * sin;
    let expected = [tension, length, speed, stored, -tension * speed, length - free, energy];
    assert_near(&measured::<2>(&s, &quantities), &expected);
    // an effect that is switched off gives zeros
    s.effects[0].enabled = false;
    assert_near(&measured::<2>(&s, &quantities[..6]), &[0.0; 6]);
}

#[test]
fn stops_are_in_contact_beyond_their_range_alone() {
    for (angle, expected) in [(0.0, 0.0), (0.29, 0.0), (0.31, 1.0), (-0.21, 1.0), (-0.19, 0.0)] {
        let mut s = pendulum(angle, 1.5);
        let (lower, upper, stiffness, damping) = (-0.2, 0.3, 100.0, 0.0);
        let (joint, coordinate, range) = (JointId::new(0), None, false);
        let kind = Limit { joint, coordinate, range, lower, upper, stiffness, damping };
        let effect = add_effect(&mut s, kind);
        // the tip of the rod is 2 sin above its height in the reference configuration, its bumper a tenth below
        let points = [[2.0, -1.0, 0.0], [2.0, 0.0, 0.0]];
        let (bodies, clearance) = ([GROUND, BodyId::Body(0)], 0.1);
        let bumper = add_effect(&mut s, Bumper { bodies, points, stiffness, damping, clearance });
        let quantities = [
            Quantity::EffectContact { effect },
            Quantity::EffectDeflection { effect },
            Quantity::EffectContact { effect: bumper },
            Quantity::EffectDeflection { effect: bumper },
        ];
        let length = ((2.0 * angle.cos() - 2.0).powi(2) + (2.0 * angle.sin() + 1.0).powi(2)).sqrt();
        let touches = f64::from(u8::from(length < 1.0 - clearance));
        let turned = (angle - upper).max(lower - angle).max(0.0);
        let pressed = (1.0 - clearance - length).max(0.0);
        assert_near(&measured::<2>(&s, &quantities), &[expected, turned, touches, pressed]);
        // an effect that is switched off gives zeros
        s.effects[0].enabled = false;
        assert_near(&measured::<2>(&s, &quantities[..2]), &[0.0; 2]);
    }
}

#[test]
fn motors_forces_and_bushings_give_their_power() {
    let (angle, rate) = (0.4_f64, 1.5);
    let mut s = pendulum(angle, rate);
    let motor = JointTorque {
        joint: JointId::new(0),
        coordinate: None,
        course: Signal::Constant([0.8, 0.0, 0.0]),
    };
    let motor = add_effect(&mut s, motor);
    let push = Force {
        body: BodyId::Body(0),
        at: [2.0, 0.0, 0.0],
        course: Signal::Constant([0.0, 5.0, 0.0]),
        frame: AxisFrame::Body,
    };
    let push = add_effect(&mut s, push);
    let bushing = Bushing {
        bodies: [GROUND, BodyId::Body(0)],
        at: [0.0; 3],
        stiffness: [100.0, 100.0, 0.0, 0.0, 0.0, 7.0],
        damping: [0.0; 6],
    };
    let bushing = add_effect(&mut s, bushing);
    let (sin, cos) = angle.sin_cos();
    let quantities = [
        Quantity::EffectForce { effect: motor },
        Quantity::EffectValue { effect: motor },
        Quantity::EffectPower { effect: motor },
        Quantity::EffectForce { effect: push },
        Quantity::EffectPower { effect: push },
        Quantity::EffectForce { effect: bushing },
        Quantity::EffectEnergy { effect: bushing },
        Quantity::EffectPower { effect: bushing },
    ];
    let expected = [
        -0.8,
        angle,
        0.8 * rate,
        -5.0 * sin,
        5.0 * cos,
        0.0,
        5.0 * 2.0 * rate,
        0.0,
        0.0,
        -7.0 * angle,
        3.5 * angle * angle,
        -7.0 * angle * rate,
    ];
    assert_near(&measured::<2>(&s, &quantities), &expected);
}

#[test]
fn a_driven_coupling_and_a_guide_give_what_the_motion_needs() {
    /// Prescribed motion by an input: value, rate and acceleration.
    const INPUT: [f64; 3] = [7.0, 1.5, 4.0];
    let mut s = scene(Dimension::Planar, [0.0; 3]);
    let wheel = add_body(&mut s, 1.0, [0.0; 3], Inertia::Planar(0.3));
    add_joint(&mut s, JointKind::Revolute, [GROUND, wheel], [0.0; 3], [None; 2]);
    let mut guided = s.clone();
    guide(&mut guided, 0, Motion::Input(INPUT));
    let joint = JointId::new(0);
    let effort = [
        Quantity::JointEffort { joint },
        Quantity::JointValue { joint },
        Quantity::JointPower { joint },
    ];
    assert_near(&measured::<2>(&guided, &effort), &[0.3 * 4.0, 7.0, 0.3 * 4.0 * 1.5]);

    // coupling: 2 angle = the input
    let of = CouplingMeasure::Coordinate { joint, number: 0 };
    let terms = vec![CouplingTerm { factor: 2.0, of, curve: None }];
    let motion = Some(Motion::Input(INPUT));
    s.couplings.push(Coupling { name: "drive".into(), motion, ..Coupling::sum(terms, 0.0) });
    let coupling = CouplingId::new(0);
    let quantities = [
        Quantity::Effort { coupling },
        Quantity::CouplingValue { coupling },
        Quantity::CouplingRate { coupling },
        Quantity::CouplingPower { coupling },
        Quantity::JointEffort { joint },
    ];
    // 2 effort = I alpha,   alpha = 4 / 2
    let effort = 0.3 * 2.0 / 2.0;
    assert_near(&measured::<2>(&s, &quantities), &[effort, 7.0, 1.5, effort * 1.5, 0.0]);
    // a constant coupling gives no power
    s.couplings[0].motion = None;
    assert_near(&measured::<2>(&s, &quantities), &[0.0; 5]);
}

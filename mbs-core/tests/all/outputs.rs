//! Output channels, measured at states with known values.

mod coordinate;
mod cubic;
mod event;
mod frame;
mod leaf_elimination;
mod minimum_norm;

use crate::small::{GROUND, add_body, add_joint, add_rod, hold, output, scene, start};
use mbs_core::algebra::{Matrix, Vector, rotation, rotation_vector};
use mbs_core::natural::NaturalModel;
use mbs_core::outputs::{Forces, Measures, QUANTITIES};
use mbs_core::scene::{
    BodyId, Coupling, CouplingMeasure, CouplingTerm, Dimension, EffectId, EffectKind, Inertia,
    JointId, JointKind, Limit, Motion, Quantity, Scene, TableEnds,
};
use mbs_testkit::{PLANAR, SPATIAL, quantities};

/// Error of the assembly: rounding of a few products of numbers of order one.
const CLOSED: f64 = 1e-11;

fn measured<const D: usize>(scene: &Scene<f64>) -> Vec<f64> {
    let (model, state) = start::<D>(scene);
    let mut measures = Measures::new(scene, &model).expect("channels");
    let mut out = vec![0.0; measures.n_components()];
    measures.write(&state, None, &mut out).expect("turns are known");
    out
}

fn assert_near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() < CLOSED, "{found:?} is not {expected:?}");
    }
}

/// Scene of a spatial body on the ground by one joint, at a place off all axes.
fn single(kind: JointKind, axes: [Option<[f64; 3]>; 2]) -> Scene<f64> {
    let mut s = scene(Dimension::Spatial, [0.0, 0.0, -9.81]);
    let inertia = Inertia::Spatial([0.3, 0.4, 0.5, 0.02, 0.01, -0.03]);
    let body = add_body(&mut s, 1.0, [0.2, 0.5, 0.1], inertia);
    add_joint(&mut s, kind, [GROUND, body], [0.1, -0.2, 0.3], axes);
    s
}

#[test]
fn a_planar_pendulum_moves_as_a_circle_says() {
    let mut s = scene(Dimension::Planar, [0.0, -9.81, 0.0]);
    let rod = add_rod(&mut s, 2.0, [0.0; 3], [2.0, 0.0, 0.0]);
    let pivot = add_joint(&mut s, JointKind::Revolute, [GROUND, rod], [0.0; 3], [None; 2]);
    let (angle, rate) = (0.4_f64, 1.5);
    hold(&mut s, pivot, &[angle], &[rate]);
    let at = [2.0, 0.0, 0.0];
    output(&mut s, Quantity::Acceleration { body: BodyId::Body(0), at });
    output(&mut s, Quantity::Position { body: BodyId::Body(0), at });
    output(&mut s, Quantity::JointRate { joint: JointId::new(pivot) });
    output(&mut s, Quantity::Velocity { body: BodyId::Body(0), at });
    output(&mut s, Quantity::JointValue { joint: JointId::new(pivot) });
    output(&mut s, Quantity::AngularVelocity { body: BodyId::Body(0) });
    let (sin, cos) = angle.sin_cos();
    // rod about its end: alpha = -3 g cos / (2 l)
    let alpha = -1.5 * 9.81 * cos / 2.0;
    let acceleration =
        [2.0 * (-alpha * sin - rate * rate * cos), 2.0 * (alpha * cos - rate * rate * sin)];
    let mut expected = acceleration.to_vec();
    expected.extend([2.0 * cos, 2.0 * sin, rate, -2.0 * rate * sin, 2.0 * rate * cos, angle, rate]);
    assert_near(&measured::<2>(&s), &expected);
}

fn is_as_its_row_says<const D: usize>(text: &str) {
    let mut scene = mbs_testkit::scene(text);
    let all = quantities::every(&scene);
    for quantity in &all {
        let row = quantity.row();
        assert!(QUANTITIES.contains(row), "{row:?}");
        assert_eq!(Quantity::of(row.name, quantity.target()).as_ref(), Some(quantity));
        // Conversion to another type of number and back.
        let there = quantity.map(&mut |x: &f64| x.to_bits());
        assert_eq!(&there.map(&mut |x| f64::from_bits(*x)), quantity);
    }
    quantities::show(&mut scene, all);
    let (model, state) = start::<D>(&scene);
    let mut forces = Forces::new(&scene, &model).expect("reactions");
    forces.update(&state);
    let mut measures = Measures::new(&scene, &model).expect("channels");
    let mut out = vec![f64::NAN; measures.n_components()];
    measures.write(&state, Some(&forces), &mut out).expect("turns are known");
    assert!(out.iter().all(|x| x.is_finite()), "{out:?}");
}

#[test]
fn every_quantity_fills_the_components_of_its_row_on_every_kind_of_joint() {
    is_as_its_row_says::<2>(PLANAR);
    is_as_its_row_says::<3>(SPATIAL);
}

#[test]
fn without_outputs_every_joint_coordinate_is_a_channel() {
    let mut s = single(JointKind::Spherical, [None; 2]);
    let inertia = Inertia::Spatial([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
    let slider = add_body(&mut s, 1.0, [1.0, 0.0, 0.0], inertia);
    let welded = add_body(&mut s, 1.0, [2.0, 0.0, 0.0], inertia);
    let axis = [Some([2.0, 0.0, 0.0]), None];
    add_joint(&mut s, JointKind::Weld, [slider, welded], [1.5, 0.0, 0.0], [None; 2]);
    add_joint(&mut s, JointKind::Cylindrical, [GROUND, slider], [1.0, 0.0, 0.0], axis);
    let (model, _) = start::<3>(&s);
    let measures = Measures::new(&s, &model).unwrap();
    assert_eq!(measures.lengths().collect::<Vec<_>>(), [3, 2]);
    assert_eq!(measures.n_components(), 5);
}

/// Kind of a joint, axes, prescribed values, and prescribed rates.
type Case = (JointKind, [Option<[f64; 3]>; 2], &'static [f64], &'static [f64]);

#[test]
fn held_values_and_rates_are_measured_as_they_were_held() {
    let (a, b) = (Some([0.0, 3.0, 4.0]), Some([1.0, 0.5, 0.2]));
    let cases: [Case; 7] = [
        (JointKind::Revolute, [a, None], &[1.2], &[-0.7]),
        (JointKind::Prismatic, [a, None], &[0.3], &[0.4]),
        (JointKind::Cylindrical, [a, None], &[-0.3, 2.5], &[0.4, 1.1]),
        (JointKind::Universal, [a, b], &[0.6, -0.8], &[0.5, 1.5]),
        (JointKind::Planar, [a, b], &[0.2, -0.1, 0.9], &[0.3, 0.6, -0.4]),
        (JointKind::Spherical, [None; 2], &[0.5, -0.4, 0.8], &[1.0, 2.0, -0.5]),
        (
            JointKind::Free,
            [None; 2],
            &[0.1, 0.2, -0.3, 0.5, -0.4, 0.8],
            &[0.3, -0.2, 0.7, 1.0, 2.0, -0.5],
        ),
    ];
    for (kind, axes, value, rate) in cases {
        let mut s = single(kind, axes);
        hold(&mut s, 0, value, rate);
        output(&mut s, Quantity::JointValue { joint: JointId::new(0) });
        output(&mut s, Quantity::JointRate { joint: JointId::new(0) });
        let found = measured::<3>(&s);
        assert_near(&found, &[value, rate].concat());
    }
}

#[test]
fn a_body_on_a_skew_axis_turns_by_its_rate_along_that_axis() {
    let (axis, rate) = ([0.0, 3.0, 4.0], -0.7);
    let mut s = single(JointKind::Revolute, [Some(axis), None]);
    hold(&mut s, 0, &[1.2], &[rate]);
    output(&mut s, Quantity::AngularVelocity { body: BodyId::Body(0) });
    assert_near(&measured::<3>(&s), &axis.map(|x| rate * x / 5.0));
}

#[test]
fn a_rod_between_balls_turns_across_itself() {
    let mut s = scene(Dimension::Spatial, [0.0, 0.0, -9.81]);
    let rod = add_rod(&mut s, 1.0, [0.0; 3], [2.0, 0.0, 0.0]);
    add_joint(&mut s, JointKind::Spherical, [GROUND, rod], [0.0; 3], [None; 2]);
    output(&mut s, Quantity::AngularVelocity { body: rod });
    let (model, mut state) = start::<3>(&s);
    assert!(!model.has_full_rotation(rod));
    // velocity of the end: omega x (2, 0, 0)
    state.v[..3].copy_from_slice(&[0.0, 3.0, -1.0]);
    let mut out = [0.0; 3];
    let mut measures = Measures::new(&s, &model).expect("channels");
    measures.write(&state, None, &mut out).expect("turns are known");
    assert_near(&out, &[0.0, 0.5, 1.5]);
}

/// Current directions of the body's axes, from positions of its points.
fn frame_of(s: &Scene<f64>, body: BodyId) -> Matrix<f64, 3> {
    let (model, state) = start::<3>(s);
    let unit = |i: usize| core::array::from_fn(|k| if k == i { 1.0 } else { 0.0 });
    Matrix::from_columns(&[0, 1, 2].map(|i| model.direction(body, unit(i)).value(&state.q)))
}

#[test]
fn universal_angles_turn_the_body_first_about_its_first_axis_of_the_ground() {
    let (a, b) = ([0.0, 0.6, 0.8], [0.6, 0.0, 0.8]);
    let mut s = single(JointKind::Universal, [Some(a), Some(b)]);
    let (first, second) = (0.7, -1.1);
    hold(&mut s, 0, &[first, second], &[]);
    let turned = rotation(&(Vector::<f64, 3>::from(a) * first))
        * rotation(&(Vector::<f64, 3>::from(b) * second));
    let gap = frame_of(&s, BodyId::Body(0)) - turned;
    assert!(gap.iter().all(|x| x.abs() < CLOSED), "{gap}");
    assert_near(&measured::<3>(&s), &[first, second]);
}

#[test]
fn a_spherical_joint_between_moving_bodies_measures_in_the_first_body() {
    let mut s = single(JointKind::Spherical, [None; 2]);
    let inertia = Inertia::Spatial([0.3, 0.4, 0.5, 0.0, 0.0, 0.0]);
    let second = add_body(&mut s, 1.0, [1.0, 0.0, 0.0], inertia);
    add_joint(&mut s, JointKind::Spherical, [BodyId::Body(0), second], [0.6, 0.3, 0.0], [None; 2]);
    let (w, u) = ([0.4, -0.3, 0.2], [-0.5, 0.6, 0.1]);
    hold(&mut s, 0, &w, &[0.1, 0.2, 0.3]);
    hold(&mut s, 1, &u, &[1.0, -1.0, 0.5]);
    let together = rotation(&Vector::from(w)) * rotation(&Vector::from(u));
    let gap = frame_of(&s, second) - together;
    assert!(gap.iter().all(|x| x.abs() < CLOSED), "{gap}");
    assert_near(&measured::<3>(&s), &[w, u].concat());
}

#[test]
fn turns_are_counted_over_three_turns_and_back() {
    let mut s = scene(Dimension::Planar, [0.0; 3]);
    let rod = add_rod(&mut s, 1.0, [0.0; 3], [1.0, 0.0, 0.0]);
    add_joint(&mut s, JointKind::Revolute, [GROUND, rod], [0.0; 3], [None; 2]);
    let (model, mut state) = start::<2>(&s);
    let mut measures = Measures::new(&s, &model).unwrap();
    let mut out = [0.0];
    let path = (0..=60).chain((0..60).rev());
    for i in path {
        let angle = f64::from(i) * core::f64::consts::PI / 10.0;
        // one free point on a circle, with two unknowns
        let (sin, cos) = angle.sin_cos();
        (state.q[0], state.q[1]) = (cos, sin);
        measures.track(&state).expect("turns are known");
        if i % 7 == 0 {
            measures.write(&state, None, &mut out).expect("turns are known");
            assert!((out[0] - angle).abs() < CLOSED, "{} {angle}", out[0]);
        }
    }
}

#[test]
fn counting_starts_from_the_initial_value_or_the_guide() {
    for is_guided in [false, true] {
        let mut s = scene(Dimension::Planar, [0.0; 3]);
        let rod = add_rod(&mut s, 1.0, [0.0; 3], [1.0, 0.0, 0.0]);
        let pivot = add_joint(&mut s, JointKind::Revolute, [GROUND, rod], [0.0; 3], [None; 2]);
        if is_guided {
            let law =
                Motion::Table { rows: vec![[0.0, 7.5], [1.0, 8.0]], ends: TableEnds::Natural };
            crate::small::guide(&mut s, pivot, law);
        } else {
            hold(&mut s, pivot, &[7.5], &[]);
        }
        assert_near(&measured::<2>(&s), &[7.5]);
    }
}

#[test]
fn the_unit_of_an_effect_is_that_of_its_coordinate() {
    let unit = |coordinate| {
        let mut s = scene(Dimension::Spatial, [0.0; 3]);
        let inertia = Inertia::Spatial([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
        let body = add_body(&mut s, 1.0, [0.0; 3], inertia);
        let axis = [Some([0.0, 0.0, 1.0]), None];
        add_joint(&mut s, JointKind::Cylindrical, [GROUND, body], [0.0; 3], axis);
        let (joint, range) = (JointId::new(0), false);
        let (lower, upper, stiffness, damping) = (-0.2, 0.3, 100.0, 0.0);
        let kind = Limit { joint, coordinate, range, lower, upper, stiffness, damping };
        let kind = EffectKind::Limit(kind);
        s.effects.push(mbs_core::scene::Effect { name: "stop".into(), enabled: true, kind });
        let effect = EffectId::new(0);
        Quantity::EffectValue { effect }.components(&s)[0].unit.clone()
    };
    assert_eq!([Some(0), Some(1), None].map(unit), ["m", "rad", "rad"]);
}

#[test]
fn a_rope_beside_the_line_of_a_rod_gives_the_rod_its_rotation() {
    let held = |beside: f64| {
        let mut s = scene(Dimension::Spatial, [0.0, 0.0, -9.81]);
        let rod = add_rod(&mut s, 1.0, [0.0; 3], [1.0, 0.0, 0.0]);
        add_joint(&mut s, JointKind::Spherical, [GROUND, rod], [0.0; 3], [None; 2]);
        let points = vec![(GROUND, [0.5, 0.0, 1.0]), (rod, [0.5, beside, 0.0])];
        let of = CouplingMeasure::Length { points };
        let terms = vec![CouplingTerm { factor: 1.0, of, curve: None }];
        s.couplings.push(Coupling { name: "rope".into(), ..Coupling::sum(terms, 0.0) });
        let model = NaturalModel::<f64, 3>::new(&s).expect("a model");
        model.has_full_rotation(rod)
    };
    assert!(held(0.1));
    assert!(!held(0.0));
}

#[test]
fn a_rod_between_balls_turns_by_the_smallest_rotation() {
    let mut s = scene(Dimension::Spatial, [0.0, 0.0, -9.81]);
    let rod = add_rod(&mut s, 1.0, [0.0; 3], [1.0, 0.0, 0.0]);
    add_joint(&mut s, JointKind::Spherical, [GROUND, rod], [0.0; 3], [None; 2]);
    output(&mut s, Quantity::JointValue { joint: JointId::new(0) });
    output(&mut s, Quantity::JointRate { joint: JointId::new(0) });
    let (model, mut state) = start::<3>(&s);
    assert!(!model.has_full_rotation(rod));
    let mut measures = Measures::new(&s, &model).unwrap();
    let turned = rotation(&Vector::from([0.0, 0.3, -0.4])) * Vector::<f64, 3>::new(1.0, 0.0, 0.0);
    state.q[..3].copy_from_slice(turned.as_slice());
    let mut out = [0.0; 6];
    measures.write(&state, None, &mut out).expect("turns are known");
    let r = rotation(&Vector::<f64, 3>::from([out[0], out[1], out[2]]));
    let gap = rotation_vector(&r) - Vector::from([0.0, 0.3, -0.4]);
    assert!(gap.iter().all(|x| x.abs() < CLOSED), "{gap}");
    assert_near(&out[3..], &[0.0; 3]);
}

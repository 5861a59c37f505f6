//! Camber, toe and caster of a carrier, compared with composed rotations.

use crate::small::{GROUND, add_body, add_joint, hold, output, scene, start};
use core::f64::consts::PI;
use mbs_core::algebra::{Matrix, Vector, norm, rotation};
use mbs_core::outputs::{Measures, VehicleSide, WheelCarrier};
use mbs_core::scene::{BodyId, Dimension, Inertia, JointKind, Quantity};

/// Allowed error: rounding of products of numbers of order one, and the error of the assembly [rad].
const CLOSED: f64 = 1e-12;

type V = Vector<f64, 3>;
type R = Matrix<f64, 3>;

/// Angles of turning, also beyond a right angle, and angles of leaning up to almost a right angle, in both senses [rad].
const TURNS: [f64; 7] = [-3.0, -1.2, -0.05, 0.0, 1e-7, 0.4, 2.6];
const LEANS: [f64; 6] = [-1.5, -0.3, 0.0, 1e-7, 0.02, 1.4];

fn about(axis: V, angle: f64) -> R {
    rotation(&(axis * angle))
}

/// Rotation vector of a rotation matrix.
fn vector_of(r: &R) -> V {
    let sines = V::from([r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]]);
    let (sine, cosine) = (0.5 * norm(&sines), 0.5 * (r.trace() - 1.0));
    let angle = sine.atan2(cosine);
    assert!(angle < PI - 1e-3, "half a turn has two of them");
    if sine > 0.0 { sines * (0.5 * angle / sine) } else { V::zeros() }
}

/// Data of a wheel: its side, the directions up and forward, and optionally an axis.
#[derive(Clone, Copy)]
struct Given {
    side: VehicleSide,
    up: [f64; 3],
    forward: [f64; 3],
    axis: Option<[f64; 3]>,
}

/// Data of a wheel with the defaults of a scene file.
fn usual(side: VehicleSide) -> Given {
    Given { side, up: [0.0, 0.0, 1.0], forward: [1.0, 0.0, 0.0], axis: None }
}

/// Camber, toe and caster if vehicle body and carrier are rotated by these rotations.
fn angles([vehicle, carrier]: [&R; 2], given: Given) -> [f64; 3] {
    let mut s = scene(Dimension::Spatial, [0.0; 3]);
    let ball = Inertia::Spatial([0.2, 0.3, 0.25, 0.0, 0.0, 0.0]);
    let [body, wheel] = [0.0, 1.0].map(|y| add_body(&mut s, 1.0, [0.0, y, 0.0], ball));
    for (i, (of, turn)) in [(body, vehicle), (wheel, carrier)].into_iter().enumerate() {
        add_joint(&mut s, JointKind::Spherical, [GROUND, of], [0.0, 1.0, 0.0], [None; 2]);
        hold(&mut s, i, vector_of(turn).as_slice(), &[0.0; 3]);
    }
    let Given { side, up, forward, axis } = given;
    let of = WheelCarrier { body: wheel, relative_to: body, side, up, forward, axis };
    [Quantity::Camber(of), Quantity::Toe(of), Quantity::Caster(of)]
        .into_iter()
        .for_each(|quantity| output(&mut s, quantity));
    let (model, state) = start::<3>(&s);
    let mut measures = Measures::new(&s, &model).expect("channels");
    let mut out = [f64::NAN; 3];
    measures.write(&state, None, &mut out).expect("turns are known");
    out
}

fn assert_near(found: [f64; 3], expected: [f64; 3], what: &str) {
    for (f, e) in found.iter().zip(expected) {
        let difference = (f - e + PI).rem_euclid(2.0 * PI) - PI;
        assert!(difference.abs() < CLOSED, "{what}: {found:?} is not {expected:?}");
    }
}

/// Mirror image of a rotation, by the middle plane of the vehicle.
fn mirrored(r: &R) -> R {
    let sign = |i: usize| if i == 1 { -1.0 } else { 1.0 };
    let columns = [0, 1, 2].map(|j| V::from_fn(|i, _| sign(i) * sign(j) * r[(i, j)]));
    R::from_columns(&columns)
}

#[test]
fn a_steered_and_leaning_wheel_has_the_angles_that_it_was_turned_by() {
    for turn in TURNS {
        for lean in LEANS {
            // leaned about x, then steered about z, with an initial spin about the wheel's axis: to the left and to the right
            let r = about(V::z(), turn) * about(V::x(), lean) * about(V::y(), 0.3);
            let [camber, toe, _] = angles([&R::identity(), &r], usual(VehicleSide::Left));
            assert_near([camber, toe, 0.0], [-lean, -turn, 0.0], "left");
            let [camber, toe, _] = angles([&R::identity(), &r], usual(VehicleSide::Right));
            assert_near([camber, toe, 0.0], [lean, turn, 0.0], "right");
            // leaned, then tilted about y: equal on both sides
            let r = about(V::y(), turn) * about(V::x(), lean) * about(V::z(), 0.3);
            for side in [VehicleSide::Left, VehicleSide::Right] {
                let [_, _, caster] = angles([&R::identity(), &r], usual(side));
                assert_near([caster, 0.0, 0.0], [-turn, 0.0, 0.0], "caster");
            }
        }
    }
}

#[test]
fn tops_that_lean_out_fronts_that_point_in_and_steering_axes_that_lean_back_are_positive() {
    // a left wheel: the top moves to +y, then the front to -y, then the top of the steering axis to -x
    let identity = R::identity();
    for (r, at) in [about(-V::x(), 0.1), about(-V::z(), 0.1), about(-V::y(), 0.1)].iter().zip(0..) {
        let left = angles([&identity, r], usual(VehicleSide::Left));
        let right = angles([&identity, &mirrored(r)], usual(VehicleSide::Right));
        let mut expected = [0.0; 3];
        expected[at] = 0.1;
        assert_near(left, expected, "left");
        assert_near(right, expected, "right");
    }
}

#[test]
fn both_sides_mirror_each_other_and_the_vehicle_may_stand_anyhow() {
    let turns = [[0.3, -0.2, 0.9], [-1.1, 0.4, 0.2], [2.0, 0.1, -0.8], [0.02, 0.01, -0.03]];
    for turn in turns {
        let r = rotation(&V::from(turn));
        let left = angles([&R::identity(), &r], usual(VehicleSide::Left));
        let right = angles([&R::identity(), &mirrored(&r)], usual(VehicleSide::Right));
        assert_near(right, left, "mirrored");
        for stance in [[0.0, 0.0, 3.0], [1.9, -0.6, 0.4], [0.0, -1.5, 0.3]] {
            let q = rotation(&V::from(stance));
            let found = angles([&q, &(q * r)], usual(VehicleSide::Left));
            assert_near(found, left, "the whole vehicle turned");
        }
    }
}

#[test]
fn up_and_forward_are_those_of_the_drawing() {
    let r = rotation(&V::from([0.3, -0.2, 0.9]));
    let usual = usual(VehicleSide::Right);
    let expected = angles([&R::identity(), &r], usual);
    for drawn in [[0.0, 0.0, 1.0], [1.5, 0.0, 0.0], [0.4, -0.9, 2.0]] {
        let q = rotation(&V::from(drawn));
        // the directions may have any length, and forward any angle to up except zero
        let [up, forward] = [q * V::z() * 3.0, q * (V::x() + V::z() * 0.4)];
        let given = Given { up: up.into(), forward: forward.into(), ..usual };
        assert_near(angles([&R::identity(), &(q * r * q.transpose())], given), expected, "drawn");
    }
}

#[test]
fn the_axis_of_the_drawing_counts_in_either_sense() {
    let (lean, turn, tilt) = (0.05, -0.02, 0.09);
    let drawn = about(V::z(), turn) * about(V::x(), lean) * V::y();
    let steering = about(V::y(), tilt) * V::z();
    let own = rotation(&V::from([0.1, 0.2, -0.3]));
    for side in [VehicleSide::Left, VehicleSide::Right] {
        let sign = if side == VehicleSide::Left { -1.0 } else { 1.0 };
        for sense in [2.0, -1.0] {
            let wheel = Given { axis: Some((drawn * sense).into()), ..usual(side) };
            let [camber, toe, _] = angles([&R::identity(), &R::identity()], wheel);
            assert_near([camber, toe, 0.0], [sign * lean, sign * turn, 0.0], "as drawn");
            let steered = Given { axis: Some((steering * sense).into()), ..usual(side) };
            let [_, _, caster] = angles([&R::identity(), &R::identity()], steered);
            assert_near([caster, 0.0, 0.0], [-tilt, 0.0, 0.0], "as drawn");
            // drawn straight and rotated by the joint, or drawn rotated
            let straight = angles([&R::identity(), &own], usual(side));
            let axis = Some((own * V::y() * sense).into());
            let [camber, toe, _] =
                angles([&R::identity(), &R::identity()], Given { axis, ..wheel });
            assert_near([camber, toe, 0.0], [straight[0], straight[1], 0.0], "drawn turned");
        }
    }
}

#[test]
fn wheels_are_refused_in_the_plane_and_without_directions() {
    use mbs_core::scene::SceneFault::{NeedsSpatial, NotFinite, ParallelAxes, ZeroAxis};
    let given = usual(VehicleSide::Left);
    let cases = [
        (Dimension::Planar, given, "quantity", NeedsSpatial),
        (Dimension::Spatial, Given { up: [0.0; 3], ..given }, "up", ZeroAxis),
        (Dimension::Spatial, Given { forward: [0.0, 0.0, -2.0], ..given }, "forward", ParallelAxes),
        (Dimension::Spatial, Given { axis: Some([0.0; 3]), ..given }, "axis", ZeroAxis),
        (Dimension::Spatial, Given { up: [f64::NAN, 0.0, 1.0], ..given }, "up", NotFinite),
    ];
    for (dimension, Given { side, up, forward, axis }, field, fault) in cases {
        let mut s = scene(dimension, [0.0; 3]);
        let inertia = match dimension {
            Dimension::Planar => Inertia::Planar(1.0),
            Dimension::Spatial => Inertia::Spatial([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]),
        };
        let body = add_body(&mut s, 1.0, [0.0; 3], inertia);
        let of = WheelCarrier { body, relative_to: BodyId::Ground, side, up, forward, axis };
        output(&mut s, Quantity::Camber(of));
        let error = s.check().expect_err("it is refused");
        assert_eq!((error.field, error.fault), (field, fault));
    }
}

//! Outputs in degrees against the same in radians: rows, statistics and units. Angles of wheels against rotation matrices.

use crate::common::{by, run, scene};
use mbs::core::outputs::{Quantity, VehicleSide, WheelCarrier};
use mbs::core::scene::{BodyId, JointId, JointKind, Output, Scene};
use mbs::results::{ResultTable, difference};
use mbs::{FormulationKind, Method, Outcome};
use mbs_testkit::repository::field;

/// Relative difference of a product from the product in another order [-].
const ROUNDING: f64 = 1e-14;
/// Relative difference of peaks, which are interpolated between steps [-].
const PEAKS: f64 = 1e-12;
/// Difference of an angle from one entry of a rotation matrix and from its whole column [rad]. The violation of the constraints changes the
/// length of columns.
const VIOLATION: f64 = 1e-8;
/// Number of degrees in a radian.
const DEGREES: f64 = 180.0 / core::f64::consts::PI;

/// Returns the scene with only these outputs, in degrees or radians.
fn with(scene: &Scene<f64>, quantities: &[Quantity<f64>], is_in_degrees: bool) -> Scene<f64> {
    let named = |(i, quantity): (usize, &Quantity<f64>)| Output {
        is_in_degrees,
        ..Output::new(quantity.clone()).named(&format!("output {i}"))
    };
    let outputs = quantities.iter().enumerate().map(named).collect();
    Scene { outputs, ..scene.clone() }
}

fn assert_scaled(found: &Outcome, of: &Outcome) {
    assert!(found.summary.completed && found.rows().len() == of.rows().len());
    for ((t, degrees), (_, radians)) in found.rows().iter().zip(of.rows()) {
        for (degrees, radians) in degrees.iter().zip(radians) {
            let expected = DEGREES * radians;
            assert!((degrees - expected).abs() <= ROUNDING * expected.abs(), "{t}: {degrees}");
        }
    }
    // peaks between rows are interpolated
    for (degrees, radians) in found.summary.channels.iter().zip(&of.summary.channels) {
        for (a, b) in [(&degrees.min, &radians.min), (&degrees.max, &radians.max)] {
            for (a, b) in a.iter().zip(b) {
                assert!((a - DEGREES * b).abs() <= PEAKS * a.abs(), "{a} {b}");
            }
        }
    }
}

#[test]
fn angles_rates_and_accelerations_are_scaled_in_rows_and_statistics_of_every_formulation() {
    let base = scene("double-pendulum");
    let (joint, body) = (JointId::new(1), BodyId::Body(1));
    let quantities = [
        Quantity::JointValue { joint },
        Quantity::JointRate { joint },
        Quantity::JointAcceleration { joint },
        Quantity::Orientation { body },
        Quantity::AngularVelocity { body },
    ];
    for formulation in FormulationKind::ALL.map(FormulationKind::name) {
        let method = Method { duration: Some(0.3), ..by(formulation) };
        let [radians, degrees] = [false, true].map(|x| run(&with(&base, &quantities, x), &method));
        assert_scaled(&degrees, &radians);
        let units: Vec<_> = degrees.summary.channels.iter().map(|x| x.unit.as_deref()).collect();
        let expected = ["deg", "deg/s", "deg/s^2", "deg", "deg/s"].map(Some);
        assert_eq!(units, expected, "{formulation}");
    }
}

#[test]
fn magnitudes_are_in_degrees_and_numbers_that_are_no_angles_stay() {
    let base = scene("free-body");
    let body = BodyId::Body(0);
    let quantities = [Quantity::AngularVelocity { body }, Quantity::RotationVector { body }];
    let method = Method { duration: Some(0.1), ..Method::default() };
    let runs = [false, true].map(|is_in_degrees| {
        let mut scene = with(&base, &quantities, is_in_degrees);
        scene.outputs.iter_mut().for_each(|output| output.magnitude = true);
        run(&scene, &method)
    });
    assert_scaled(&runs[1], &runs[0]);
    assert_eq!(runs[1].rows()[0].1.len(), 8);
}

#[test]
fn a_joint_that_slides_and_turns_has_its_angle_alone_in_degrees() {
    let base = field("17-torque-on-reversed-cylindrical");
    let slides = |joint: &mbs::core::scene::Joint<f64>| joint.kind == JointKind::Cylindrical;
    let joint = JointId::new(base.joints.iter().position(slides).expect("a cylindrical joint"));
    let method = Method { duration: Some(0.1), ..Method::default() };
    let [radians, degrees] =
        [false, true].map(|x| run(&with(&base, &[Quantity::JointValue { joint }], x), &method));
    let units = &degrees.summary.channels[0].units;
    assert_eq!(units, &["m", "deg"]);
    for ((_, a), (_, b)) in degrees.rows().iter().zip(radians.rows()) {
        assert!(
            a[0].total_cmp(&b[0]).is_eq() && (a[1] - DEGREES * b[1]).abs() <= ROUNDING,
            "{a:?}"
        );
    }
}

#[test]
fn runs_in_degrees_and_in_radians_are_compared_in_one_unit() {
    let base = scene("double-pendulum");
    let quantities = [Quantity::JointRate { joint: JointId::new(0) }];
    let method = Method { duration: Some(0.2), ..Method::default() };
    let [radians, degrees] = [false, true].map(|is_in_degrees| {
        let outcome = run(&with(&base, &quantities, is_in_degrees), &method);
        ResultTable::of_outcome(&outcome).expect("rows")
    });
    for (a, b) in [(&radians, &degrees), (&degrees, &radians)] {
        let mut b = b.clone();
        b.in_units_of(a);
        let found = difference(a, &b, &[]);
        assert!(found.is_within(ROUNDING), "{found:?}");
        assert_eq!(found.columns[0].unit, a.columns[0].unit);
    }
}

#[test]
fn angles_of_a_wheel_are_those_of_its_rotation_in_the_vehicle_body_in_every_formulation() {
    let base = scene("iltis-suspension");
    let bodies = base.bodies.len();
    let [vehicle, carrier] = [0, bodies - 1].map(BodyId::Body);
    let (up, forward, axis) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], None);
    let of = |side| WheelCarrier { body: carrier, relative_to: vehicle, side, up, forward, axis };
    let [left, right] = [VehicleSide::Left, VehicleSide::Right].map(of);
    let quantities = [
        Quantity::RotationMatrix { body: vehicle },
        Quantity::RotationMatrix { body: carrier },
        Quantity::Camber(left),
        Quantity::Toe(left),
        Quantity::Caster(left),
        Quantity::Camber(right),
        Quantity::Toe(right),
        Quantity::Caster(right),
    ];
    let scene = with(&base, &quantities, false);
    let mut largest = 0.0_f64;
    for formulation in FormulationKind::ALL.map(FormulationKind::name) {
        let outcome = run(&scene, &Method { duration: Some(0.2), ..by(formulation) });
        assert!(outcome.summary.completed, "{formulation}: {:?}", outcome.error);
        for (t, row) in outcome.rows() {
            let [o, b] = [&row[..9], &row[9..18]];
            // `r` is an entry of the wheel's rotation relative to its carrier, R = R_o^T R_b; y is to the left
            let r = |i: usize, j: usize| (0..3).map(|k| o[3 * k + i] * b[3 * k + j]).sum::<f64>();
            let (lean, turn) = (r(2, 1).asin(), (-r(0, 1)).atan2(r(1, 1)));
            let tilt = (-r(0, 2)).atan2(r(2, 2));
            let expected = [-lean, -turn, tilt, lean, turn, tilt];
            for (found, expected) in row[18..].iter().zip(expected) {
                assert!((found - expected).abs() < VIOLATION, "{formulation}, {t}: {row:?}");
            }
            largest = largest.max(lean.abs());
        }
    }
    assert!(largest > 1e-3, "{largest}");
}

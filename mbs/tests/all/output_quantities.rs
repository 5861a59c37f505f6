//! Quantities of tires and accelerometers against equilibrium, against other outputs, and against the equations of a wheel.

use crate::common::{run, scene};
use mbs::core::effects::Value;
use mbs::core::outputs::Quantity;
use mbs::core::scene::{BodyId, EffectId, JointId, Output, Scene};
use mbs::inside::turning_point;
use mbs::record::Provenance;
use mbs::{Method, Search, StaticEquilibrium};

/// Relative difference from the weight at an equilibrium, whose residual is below 1e-12 [-].
const SAME: f64 = 1e-9;
/// Relative rounding difference of a sum in two orders of its terms [-].
const ROUNDING: f64 = 1e-9;
/// Gravity of the scenes [m/s^2].
const GRAVITY: f64 = 9.81;
/// Speed below which the tire law regularises slip [m/s].
const STANDSTILL: f64 = 0.1;

/// Effects that are tires on the road.
fn tires(scene: &Scene<f64>) -> Vec<EffectId> {
    let effects = scene.effects.iter().enumerate();
    let tires = effects.filter(|(_, effect)| effect.kind.row().needs_road);
    tires.map(|(i, _)| EffectId::new(i)).collect()
}

fn show(scene: &mut Scene<f64>, quantities: Vec<Quantity<f64>>) {
    let named = |(i, quantity): (usize, _)| Output::new(quantity).named(&i.to_string());
    scene.outputs = quantities.into_iter().enumerate().map(named).collect();
}

#[test]
fn tires_at_rest_carry_the_weight_and_an_accelerometer_shows_gravity() {
    let mut scene = scene("iltis-equilibrium");
    let tires = tires(&scene);
    assert_eq!(tires.len(), 4);
    let mut quantities: Vec<_> =
        tires.iter().map(|&effect| Quantity::TireLoad { effect }).collect();
    quantities.push(Quantity::ProperAcceleration { body: BodyId::Body(0), at: [1.0, 0.5, 0.3] });
    show(&mut scene, quantities);
    let rest = StaticEquilibrium::new(&scene, Search::Down).expect("it stands").to_json();
    let outputs = &rest["outputs"];
    let number = |name: &str| outputs[name][0].as_f64().expect("a number");
    let load: f64 = (0..4).map(|i| number(&i.to_string())).sum();
    let weight = GRAVITY * scene.bodies.iter().map(|body| body.mass).sum::<f64>();
    assert!((load - weight).abs() < SAME * weight, "{load} for {weight}");
    let shown: Vec<f64> =
        outputs["4"].as_array().expect("a vector").iter().filter_map(|x| x.as_f64()).collect();
    for (found, expected) in shown.iter().zip([0.0, 0.0, GRAVITY]) {
        assert!((found - expected).abs() < SAME * GRAVITY, "{shown:?}");
    }
    assert_eq!(shown.len(), 3);
}

#[test]
fn a_point_in_free_fall_has_no_proper_acceleration() {
    let mut scene = scene("free-body");
    scene.gravity = Some([0.0, 0.0, -GRAVITY]);
    let at = scene.bodies[0].center;
    let body = BodyId::Body(0);
    show(&mut scene, vec![Quantity::ProperAcceleration { body, at }]);
    let outcome = run(&scene, &Method { duration: Some(0.1), ..Method::default() });
    let rows = outcome.rows();
    assert!(rows.len() > 10 && outcome.summary.completed, "{:?}", outcome.error);
    for (t, row) in rows {
        assert!(row.iter().all(|x| x.abs() < SAME * GRAVITY), "{t}: {row:?}");
    }
}

#[test]
fn a_column_of_magnitudes_is_the_root_of_the_sum_of_squares_of_its_components() {
    let mut scene = scene("iltis-suspension");
    let joint = JointId::new(0);
    show(&mut scene, vec![Quantity::Reaction { joint }]);
    scene.outputs[0].magnitude = true;
    let outcome = run(&scene, &Method { duration: Some(0.1), ..Method::default() });
    let mut largest = 0.0_f64;
    for (t, row) in outcome.rows() {
        let [force, moment] = [&row[..3], &row[3..6]].map(|x| x.iter().map(|x| x * x).sum::<f64>());
        assert!((row[6] - force.sqrt()).abs() <= ROUNDING * row[6], "{t}: {row:?}");
        assert!((row[7] - moment.sqrt()).abs() <= ROUNDING * row[7], "{t}: {row:?}");
        assert_eq!(row.len(), 8);
        largest = largest.max(row[6]);
    }
    let peaks = outcome.rows().windows(5).filter_map(|rows| {
        let of = |x: &dyn Fn(usize) -> f64| core::array::from_fn(x);
        turning_point(of(&|i| rows[i].0), of(&|i| rows[i].1[6]))
    });
    largest = peaks.map(|(_, peak)| peak).fold(largest, f64::max);
    // the statistics have each magnitude only once
    let stats = &outcome.record(Provenance::default()).channels[0].stats;
    assert_eq!(stats.len(), 8);
    assert!((stats[6].of.max - largest).abs() <= ROUNDING * largest, "{stats:?}");
    assert!(largest > 1.0);
}

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[test]
fn forces_of_a_tire_are_the_parts_of_its_wrench_and_its_slip_is_that_of_its_contact_point() {
    let mut scene = scene("iltis-slalom");
    let effect = tires(&scene)[0];
    let (body, hub) = wheel(&scene, effect);
    show(
        &mut scene,
        vec![
            Quantity::EffectForce { effect },
            Quantity::TireLoad { effect },
            Quantity::TireSideForce { effect },
            Quantity::TireLongitudinalForce { effect },
            Quantity::TireAligningTorque { effect },
            Quantity::TireSlipAngle { effect },
            Quantity::TireContactPoint { effect },
            Quantity::Position { body, at: hub },
            Quantity::Velocity { body, at: hub },
            Quantity::AngularVelocity { body },
            Quantity::RotationMatrix { body },
        ],
    );
    let outcome = run(&scene, &Method { duration: Some(1.5), ..Method::default() });
    assert!(outcome.summary.completed, "{:?}", outcome.error);
    let (mut most_side, mut most_slip) = (0.0_f64, 0.0_f64);
    for (t, row) in outcome.rows() {
        let three = |at: usize| -> Vector { [row[at], row[at + 1], row[at + 2]] };
        let (force, moment) = (three(0), three(3));
        let [load, side, along_force, aligning, slip] = [row[6], row[7], row[8], row[9], row[10]];
        let [contact, hub, velocity, spin] = [three(11), three(14), three(17), three(20)];
        // the second column of the rotation matrix is the axis, which is y in the reference configuration
        let axis = [row[24], row[27], row[30]];
        let normal = [0.0, 0.0, 1.0];
        let width = axis[0].hypot(axis[1]);
        let across = [axis[0] / width, axis[1] / width, 0.0];
        let along = cross(across, normal);
        let arm = minus(contact, hub);
        let close = |found: f64, expected: f64, size: f64, what: &str| {
            let error = (found - expected).abs();
            assert!(error < ROUNDING * size, "{what} at {t}: {found} for {expected}");
        };
        close(load, force[2], load, "load");
        close(side, dot(force, across), load, "side force");
        close(along_force, dot(force, along), load, "longitudinal force");
        let side_moment = cross(arm, [side * across[0], side * across[1], 0.0]);
        close(aligning + side_moment[2], moment[2], load, "aligning torque");
        // the lowest point of the disc is in its plane, and below the road by the deflection
        close(dot(arm, axis), 0.0, 1.0, "plane");
        let at_contact: Vector = core::array::from_fn(|i| velocity[i] + cross(spin, arm)[i]);
        let effective = dot(velocity, along).hypot(STANDSTILL);
        close(slip, dot(at_contact, across).atan2(effective), 1.0, "slip angle");
        most_side = most_side.max(side.abs());
        most_slip = most_slip.max(slip.abs());
    }
    assert!(most_side > 100.0 && most_slip > 1e-3, "{most_side} N, {most_slip} rad");
}

/// Body of a tire, and the centre of the wheel.
fn wheel(scene: &Scene<f64>, effect: EffectId) -> (BodyId, Vector) {
    let (mut body, mut center) = (None, None);
    for value in scene.effects[effect.index()].kind.values() {
        match value {
            Value::Body(of) => body = Some(of),
            Value::Point(at) => center = Some(at),
            _ => {}
        }
    }
    body.zip(center).expect("a tire has a body and a centre")
}

#[test]
fn the_invariant_error_is_that_of_the_summary_to_the_bit() {
    // the three cases have fixed steps without losses, dampers and inputs on a road, and controlled steps
    let controlled = Method { step_control: Some("error".to_owned()), ..Method::default() };
    for (name, method) in [
        ("double-pendulum", Method::default()),
        ("quarter-car", Method::default()),
        ("double-pendulum", controlled),
    ] {
        let mut scene = scene(name);
        show(&mut scene, vec![Quantity::InvariantError, Quantity::Energy]);
        let outcome = run(&scene, &Method { duration: Some(0.5), ..method });
        assert!(outcome.summary.completed, "{name}: {:?}", outcome.error);
        let energy = outcome.summary.energy;
        let stats = &outcome.record(Provenance::default()).channels[0].stats[0].of;
        assert_eq!(stats.max.max(-stats.min).to_bits(), energy.max_error.to_bits(), "{name}");
        assert_eq!(stats.end.abs().to_bits(), energy.final_error.to_bits(), "{name}");
        assert!(energy.max_error > 0.0, "{name}");
        if name == "double-pendulum" {
            // no part takes or gives energy here: the error is the change of the energy
            let rows = outcome.rows();
            let size = rows.iter().map(|(_, row)| row[1].abs()).fold(1.0, f64::max);
            for (t, row) in rows {
                let change = row[1] - rows[0].1[1];
                assert!((row[0] - change).abs() < ROUNDING * size, "{t}: {row:?}");
            }
        }
    }
}

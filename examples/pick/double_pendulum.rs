//! The scene of these examples: two uniform rods of 1 m and 1 kg, let go from the horizontal.

use mbs_core::scene::{Body, BodyId, Dimension, Inertia, Joint, JointKind, JointLimits, Scene};

/// Position of the tip in the reference configuration [m].
pub const TIP: [f64; 3] = [2.0, 0.0, 0.0];

/// Position of the tip after 1 s, by an extrapolation with 34 digits [m].
pub const TIP_AFTER_ONE_SECOND: [f64; 2] = [-1.662_115_135_816_127_6, -1.041_466_667_193_224_7];

/// Error of the tip after 1 s by the trapezoidal rule with steps of 1 ms: 10.5 m/s^2 times the square of the step [m].
pub const TRAPEZOIDAL: f64 = 1.1e-5;

/// Asserts that the tip is where it should be, within `tolerance` [m].
pub fn check(method: &str, tip: [f64; 2], tolerance: f64) {
    let off = (tip[0] - TIP_AFTER_ONE_SECOND[0]).hypot(tip[1] - TIP_AFTER_ONE_SECOND[1]);
    println!(
        "{method}: tip at ({:.6}, {:.6}) m after 1 s, {off:.1e} m from the reference",
        tip[0], tip[1]
    );
    assert!(off <= tolerance, "at most {tolerance:.1e} m");
}

/// The scene, as a file in `scenes/` would describe it.
pub fn double_pendulum() -> Scene<f64> {
    let rod = |name: &str, from: [f64; 3], to: [f64; 3]| Body {
        name: name.into(),
        mass: 1.0,
        center: [(from[0] + to[0]) / 2.0, 0.0, 0.0],
        inertia: Inertia::Rod { from, to },
        gravity_scale: None,
    };
    let revolute = |name: &str, bodies: [BodyId; 2], at: [f64; 3]| Joint {
        name: name.into(),
        kind: JointKind::Revolute,
        bodies,
        points: [at; 2],
        axes: [None; 2],
        limits: JointLimits::NONE,
    };
    let (pivot, elbow) = ([0.0; 3], [1.0, 0.0, 0.0]);
    let (upper, lower) = (BodyId::Body(0), BodyId::Body(1));
    Scene {
        gravity: Some([0.0, -9.81, 0.0]),
        bodies: vec![rod("upper", pivot, elbow), rod("lower", elbow, TIP)],
        joints: vec![
            revolute("pivot", [BodyId::Ground, upper], pivot),
            revolute("elbow", [upper, lower], elbow),
        ],
        ..Scene::empty("double pendulum", Dimension::Planar, 1.0)
    }
}

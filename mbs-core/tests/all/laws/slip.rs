//! Longitudinal slip force of a tire, and its slope.

use mbs_core::laws::slip::{LongitudinalSlip, share, slope};

const SLIP: LongitudinalSlip<f64> = LongitudinalSlip { stiffness: 6e4, friction: 0.8 };

#[test]
fn the_force_is_the_brush_models_and_all_friction_from_three_on() {
    // The largest force is 3200 N. The force is 1 - (1 - r/3)^3 times this.
    for (slip, force) in [(0.02, 1056.25), (0.08, 2800.0), (0.16, 3200.0), (1.0, 3200.0)] {
        let found = SLIP.force(4000.0, slip, 0.0).resistance;
        assert!((found - force).abs() < 1e-6, "{slip}: {found}");
        assert!((SLIP.force(4000.0, -slip, 0.0).resistance + found).abs() < 1e-12);
    }
}

#[test]
fn its_slope_is_that_of_differences() {
    let h = 1e-7;
    for slip in [-0.3, -0.1, -0.01, 0.004, 0.1, 0.15, 0.4] {
        for sideways in [0.0, 900.0, -4000.0, 2e4] {
            let at = |slip: f64| SLIP.force(4000.0, slip, sideways).resistance;
            let slope = (at(slip + h) - at(slip - h)) / (2.0 * h);
            let found = SLIP.force(4000.0, slip, sideways).slope;
            assert!((slope - found).abs() < 1e-3, "{slip}, {sideways}: {slope}, {found}");
        }
    }
}

#[test]
fn the_foreseen_slope_at_a_solution_is_the_tangent_and_converges_from_anywhere() {
    // v + c F(v) = b: v is the slip velocity, c a step over an inertia, b the velocity without the tire. F is a force by slip over
    // 5 m/s.
    let law = |v: f64| {
        let force = SLIP.force(4000.0, v / 5.0, 0.0);
        (force.resistance, force.slope / 5.0, force.scale * 5.0)
    };
    for v in [-2.0, -0.3, 1e-3, 0.1, 0.6, 3.0] {
        let (force, tangent, scale) = law(v);
        let found = slope((force, v), scale, force).unwrap();
        assert!((found - tangent).abs() < 1e-9 * SLIP.stiffness, "{v}: {found}, {tangent}");
    }
    for (c, b) in [(1e-5, 0.01), (1e-3, 3.1), (1e-3, 3.3), (0.1, 100.0), (0.1, 400.0)] {
        for start in [-5.0, -0.01, 0.0, 0.02, 3.0] {
            let (mut v, mut last, mut n) = (start, None, 0);
            loop {
                let (force, tangent, scale) = law(v);
                let by = last.and_then(|(before, force_before, by)| {
                    slope((force, v), scale, force_before + by * (v - before))
                });
                let by: f64 = by.unwrap_or(tangent);
                let correction = -(v + c * force - b) / (1.0 + c * by);
                last = Some((v, force, by));
                v += correction;
                n += 1;
                assert!(n < 40, "c = {c}, b = {b}, from {start}: {v}");
                if correction.abs() < 1e-13 * (1.0 + v.abs()) {
                    break;
                }
            }
        }
    }
}

#[test]
fn both_forces_stay_within_friction() {
    for i in 0..200 {
        let slip = -1.0 + 0.01 * f64::from(i);
        for sideways in [0.0, 500.0, 3000.0, 9000.0, 1e5] {
            let force = SLIP.force(4000.0, slip, sideways);
            let alone = sideways * share(sideways / 3200.0);
            let both = force.resistance.hypot(alone * force.side_share);
            assert!(both <= 3200.0 * (1.0 + 1e-12), "{slip}, {sideways}: {both}");
        }
    }
}

#[test]
fn a_wheel_that_slides_whole_is_held_against_its_slide() {
    // with equal stiffnesses the force is opposite to (1, tan a)
    let force = SLIP.force(4000.0, 1.0, 6e4 * 0.5);
    let alone = 6e4 * 0.5 * share(6e4 * 0.5 / 3200.0);
    assert!((alone * force.side_share / force.resistance - 0.5).abs() < 1e-12);
    assert!((force.resistance.hypot(alone * force.side_share) - 3200.0).abs() < 1e-9);
}

//! Forces of a bumper and their derivatives.

use mbs_core::laws::bumper::contact;

/// Stiffness [N/m] and damping [N s/m] of a stiff bumper.
const LAW: [f64; 2] = [1e5, 2e3];

#[test]
fn contact_never_pulls_and_begins_and_ends_without_a_jump() {
    for rate in [-5.0, -0.3, 0.0, 0.3, 5.0] {
        let mut last = 0.0;
        for i in -50..3000 {
            let x = f64::from(i) * 1e-6;
            let force = contact(LAW, x, rate).force;
            assert!(force >= 0.0);
            assert!(i > 0 || force == 0.0);
            // The largest change is (k + 1.5 c |x'| / x_s) times the step of 1e-6 m.
            assert!((force - last).abs() < 20.0, "{x} {rate}");
            last = force;
        }
    }
}

#[test]
fn derivatives_are_those_of_the_force_while_pressing_in() {
    let h = 1e-8;
    for x in [2e-4, 7e-4, 2e-3, 0.1] {
        for rate in [0.01, 0.4, 3.0] {
            let f = |x, rate| contact(LAW, x, rate).force;
            let at = contact(LAW, x, rate);
            // Central differences: rounding is 1e-16 of 1e4 N over 1e-8, relative to 1e5 N/m.
            let by_x = (f(x + h, rate) - f(x - h, rate)) / (2.0 * h);
            let by_rate = (f(x, rate + h) - f(x, rate - h)) / (2.0 * h);
            assert!((by_x - at.stiffness).abs() < 1e-4 * at.stiffness, "{x} {rate}");
            assert!((by_rate - at.damping).abs() < 1e-4 * (1.0 + at.damping), "{x} {rate}");
        }
    }
}

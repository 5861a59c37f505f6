//! Forces of the Calspan tire model against its formulas and published values.

use mbs_core::laws::calspan::{Coefficients, Side, side};

/// Load, slip, camber, side force and torque, computed independently from the formulas with 34 digits.
const CASES: [[f64; 5]; 10] = [
    [2000.0, 0.05, 0.0, -1106.773098, 16.905052],
    [2000.0, 0.05, 0.03, -1184.170908, 16.519986],
    [3829.6, 0.02, 0.0, -777.277661, 40.569784],
    [3829.6, 0.05, 0.0, -1747.978450, 62.220566],
    [3829.6, 0.10, 0.0, -2909.227384, 45.786502],
    [3829.6, 0.30, 0.0, -4086.507319, -17.952497],
    [3829.6, 0.05, 0.03, -1888.211804, 62.684361],
    [3829.6, 0.0, 0.03, -204.160317, 12.656923],
    [6000.0, 0.05, 0.0, -2126.184551, 140.843236],
    [14000.0, 0.05, 0.0, -130.551687, 30.962626],
];

#[test]
fn evaluations_are_those_of_the_formulas() {
    let c = Coefficients::<f64>::iltis();
    for [f, slip, camber, force, torque] in CASES {
        let side = side(&c, f, slip, camber);
        // The references have six digits after the decimal point.
        assert!((side.force - force).abs() < 6e-7, "{f} {slip} {camber}: {side:?}");
        assert!((side.torque - torque).abs() < 6e-7, "{f} {slip} {camber}: {side:?}");
    }
}

#[test]
fn cornering_stiffness_camber_stiffness_and_trail_are_the_published_ones() {
    // Load [N], cornering stiffness [N/rad], camber stiffness [N/rad], trail [m]; published with four digits.
    let c = Coefficients::<f64>::iltis();
    for [f, slip, camber, trail] in
        [[3831.31, 41641.0, 6925.0, 0.06553], [3591.91, 40162.0, 6600.0, 0.06142]]
    {
        let h = 1e-7;
        let by_slip = side(&c, f, h, 0.0);
        let by_camber = side(&c, f, 0.0, h);
        assert!((-by_slip.force / h / slip - 1.0).abs() < 2e-4);
        assert!((by_slip.stiffness / slip - 1.0).abs() < 2e-4);
        assert!((-by_camber.force / h / camber - 1.0).abs() < 2e-4);
        assert!((-by_slip.torque / by_slip.force / trail - 1.0).abs() < 4e-4);
    }
}

#[test]
fn force_is_odd_in_slip_and_camber_and_continuous_in_all() {
    let c = Coefficients::<f64>::iltis();
    for f in [100.0, 3000.0, 12929.999, 12930.001, 20000.0] {
        for slip in [-0.4, -0.05, 0.0, 1e-4, 0.07, 0.5] {
            let (a, b) = (side(&c, f, slip, 0.02), side(&c, f, -slip, -0.02));
            assert!((a.force + b.force).abs() < 1e-9 && (a.torque + b.torque).abs() < 1e-9);
            let h = 1e-6;
            for near in [side(&c, f + h, slip, 0.02), side(&c, f, slip + h, 0.02)] {
                // The slopes are below 5e4 N/rad.
                assert!((near.force - a.force).abs() < 0.1, "{f} {slip}");
            }
        }
    }
    assert_eq!(side(&c, 0.0, 0.1, 0.0), Side::default());
    // At loads far beyond the model, the force is still opposite to the slip.
    assert!(side(&c, 40_000.0, 0.1, 0.0).force < 0.0);
}

#[test]
fn stiffness_is_the_slope_of_the_force() {
    let c = Coefficients::<f64>::iltis();
    let h = 1e-6;
    for [f, slip, camber, ..] in CASES {
        let by =
            (side(&c, f, slip + h, camber).force - side(&c, f, slip - h, camber).force) / (2.0 * h);
        let stiffness = side(&c, f, slip, camber).stiffness;
        assert!((by + stiffness).abs() < 1e-5 * 4e4, "{f} {slip}: {by} {stiffness}");
    }
}

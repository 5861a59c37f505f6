//! Friction of a joint: its force, its slope, and Newton's method with it.

use mbs_core::effects::laws::FrictionLaw;

const LAW: FrictionLaw<f64> = FrictionLaw {
    coulomb: 2.0,
    r#static: 3.0,
    stribeck: 0.1,
    viscous: 0.05,
    regularisation: 1e-3,
    course: None,
};

#[test]
fn friction_is_odd_and_dissipates() {
    for i in 0..400 {
        let rate = 1e-5 * 1.05_f64.powi(i);
        let (f, _) = LAW.force(rate);
        assert!(f > 0.0 && f <= 3.0 + 0.05 * rate);
        assert!((f + LAW.force(-rate).0).abs() < 1e-15);
    }
    assert_eq!(LAW.force(0.0).0.to_bits(), 0);
}

#[test]
fn friction_reaches_both_levels() {
    // At 1e-2 the bell curve of static friction is 0.99, and the regularisation 0.995.
    assert!((LAW.force(1e-2).0 - 2.975).abs() < 0.02);
    assert!((LAW.force(10.0).0 - 2.5).abs() < 1e-3);
}

#[test]
fn newtons_method_by_the_foreseen_share_converges_from_anywhere() {
    // r + c f(r) = b: r is the rate, c a step over an inertia, b the rate without friction.
    let law = FrictionLaw { r#static: 2.0, ..LAW };
    for (c, b) in [(1e-3, 1e-2), (1e-2, 0.019), (1e-2, 0.021), (0.1, 0.12), (10.0, 19.0)] {
        for start in [-5.0, -0.01, 0.0, 0.02, 3.0] {
            let (mut rate, mut last, mut n) = (start, None, 0);
            loop {
                let (force, tangent) = law.force(rate);
                let slope = last.map_or(tangent, |last| law.slope(rate, law.foreseen(rate, last)));
                let correction = -(rate + c * force - b) / (1.0 + c * slope);
                last = Some((rate, force, slope));
                rate += correction;
                n += 1;
                assert!(n < 30, "c = {c}, b = {b}, from {start}: {rate}");
                if correction.abs() < 1e-14 {
                    break;
                }
            }
        }
    }
}

#[test]
fn slope_is_that_of_the_force_where_it_rises() {
    let h = 1e-7;
    for rate in [0.0, 5e-4, -2e-3, 1e-3, 5.0] {
        let slope = (LAW.force(rate + h).0 - LAW.force(rate - h).0) / (2.0 * h);
        let tangent = LAW.force(rate).1;
        assert!(
            (slope.max(0.0) - tangent).abs() < 1e-5 * (1.0 + tangent),
            "{rate}: {slope} {tangent}"
        );
    }
}

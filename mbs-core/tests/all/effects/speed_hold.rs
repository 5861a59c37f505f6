//! Drive that holds a constant speed.

use mbs_core::effects::laws::SpeedHoldLaw;

#[test]
fn force_is_proportional_near_the_speed_and_never_above_the_limit() {
    let hold = SpeedHoldLaw::<f64> { speed: 5.0, gain: 1e4, limit: 1e4 };
    let (force, slope) = hold.force(4.99);
    assert!((force - 100.0).abs() < 0.01 && (slope - 1e4).abs() < 10.0);
    assert!(hold.force(-100.0).0 <= 1e4 && hold.force(200.0).0 >= -1e4);
    let h = 1e-6;
    for v in [0.0, 4.0, 5.0, 6.5] {
        let slope = (hold.force(v + h).0 - hold.force(v - h).0) / (2.0 * h);
        assert!((slope + hold.force(v).1).abs() < 1e-4, "{v}");
    }
}

//! Steps across a depth in which a force fades in.

use mbs_core::inside::outputs::fading;

#[test]
fn means_of_the_ends_of_cut_steps_are_the_fade_s_own() {
    let force = |r: f64| r * r * (3.0 - 2.0 * r);
    // step lengths from a little less than half of the fade to forty times the fade
    for way in [0.45, 0.7, 0.85, 1.5, 4.0, 40.0] {
        let (mut at, mut impulse) = (0.0, 0.0);
        while at < 1.0 - 1e-9 {
            let share = fading(1.0 - at, (1.0, way)).unwrap_or(1.0);
            let end = at + share * way;
            impulse += 0.5 * (end - at) * (force(at) + force(end.min(1.0)));
            at = end;
        }
        // A step that ends less than a tenth of the fade beyond it is not cut. Its part beyond the fade adds the full force.
        let passed = at - 1.0;
        assert!(passed < 0.1, "a step of {way} fades ends {passed} beyond it");
        assert!((impulse - 0.5 - passed).abs() < 0.02, "{way}: {impulse}");
    }
}

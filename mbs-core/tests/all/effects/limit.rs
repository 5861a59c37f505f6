//! Limits (stops) of a joint coordinate.

use mbs_core::effects::laws::LimitLaw;
use mbs_core::laws::LawInputs;
use mbs_core::laws::bumper::Contact;
use mbs_core::laws::scalar::TensionLaw;

const NONE: LawInputs<'_, f64> = LawInputs::courses(&[]);

#[test]
fn stops_push_back_into_the_range() {
    let limit = LimitLaw::<f64> { lower: -0.2, upper: 0.3, stiffness: 1e3, damping: 0.0 };
    assert_eq!(limit.tension(0.0, 5.0), Contact::default());
    assert!((limit.tension(0.35, 0.0).force - 50.0).abs() < 1e-12);
    assert!((limit.tension(-0.25, 0.0).force + 50.0).abs() < 1e-12);
    assert!((limit.energy(0.35, &NONE) - 1.25).abs() < 1e-13);
    assert!((limit.energy(-0.25, &NONE) - 1.25).abs() < 1e-13);
}

//! Problems of users, each as the smallest scene that shows it (`mbs/tests/field`). Values are from closed forms or other programs. Each
//! problem represents a kind, and further tests cover other members of the kind.

mod analyses;
mod couplings;
mod formulations;
mod laws;
mod outputs;
mod start;

use mbs::{Method, Outcome};
pub(crate) use mbs_testkit::repository::{field, read, text, tilted};

/// Values of the last row.
pub(crate) fn last(outcome: &Outcome) -> &[f64] {
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    &outcome.rows().last().expect("the start is recorded").1
}

/// By steps whose length is chosen for this tolerance, at most `most` long [s].
pub(crate) fn by_tolerance(integrator: &str, most: Option<f64>) -> Method {
    Method {
        formulation: Some("recursive".into()),
        integrator: Some(integrator.into()),
        tolerance: Some(1e-11),
        step_max: most,
        ..Method::default()
    }
}

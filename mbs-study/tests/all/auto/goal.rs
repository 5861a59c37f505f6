//! Checks of goals, and parsing of times with units.

use mbs::{Method, Precision};
use mbs_study::auto::{Goal, GoalError, time};
use mbs_study::inside::auto::check_goal;

#[test]
fn times_are_read_with_their_units_and_minutes_are_not_guessed() {
    let read = |text: &str| time(text).unwrap();
    for (text, seconds) in [("0.001", 1e-3), ("1ms", 1e-3), ("500 us", 5e-4), ("2s", 2.0)] {
        assert!((read(text) - seconds).abs() < 1e-15, "{text}");
    }
    for text in ["1m", "fast", "", "1 h", "ms"] {
        assert!(time(text).is_err(), "{text}");
    }
}

#[test]
fn malformed_goals_are_refused() {
    let none = Method::default();
    let check = |error: Option<f64>, deadline: Option<f64>| {
        check_goal(&Goal { error, deadline }, &none, (10.0, Precision::F64))
    };
    let error = |e: f64| check(Some(e), None);
    for e in [0.0, -1e-3, 1.0, 20.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(error(e), Err(GoalError::Error(_))), "{e}");
    }
    assert_eq!(error(1e-4), Ok(()));
    let deadline = |d: f64| check(None, Some(d));
    assert!(matches!(deadline(-1.0), Err(GoalError::Deadline(_))));
    assert!(matches!(deadline(20.0), Err(GoalError::TooLong(..))));
    let given = Method { step: Some(1e-3), ..Method::default() };
    let both = Goal { error: Some(1e-3), deadline: Some(1e-3) };
    let refused = check_goal(&both, &given, (10.0, Precision::F64));
    assert_eq!(refused, Err(GoalError::Chosen("--step")));
}

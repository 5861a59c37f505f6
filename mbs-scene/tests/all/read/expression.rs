//! Expressions: values to 31 digits, and faults with their places in the text.

#![allow(clippy::float_cmp, reason = "numbers are rounded once")]

use mbs_core::real::DoubleDouble;
use mbs_scene::inside::expression::{EvaluationFault, evaluate, of_key};

fn value(text: &str) -> DoubleDouble {
    let mut named = |name: &str| match name {
        "k" => Ok(DoubleDouble::from_f64(3.0)),
        _ => Err([format!("`{name}` is no parameter"), String::new()]),
    };
    evaluate(text, &mut named).unwrap_or_else(|fault| panic!("{text}: {fault:?}")).value
}

fn fault(text: &str) -> EvaluationFault {
    let mut named = |name: &str| Err([format!("`{name}` is no parameter"), String::new()]);
    evaluate(text, &mut named).expect_err(text)
}

/// Leading parts and remainders of the expected values are from arithmetic of 50 digits (mpmath).
#[test]
fn values_have_thirty_one_digits() {
    for (text, near, far) in [
        ("2/3", 6.666_666_666_666_666e-1, 3.700_743_415_417_188e-17),
        ("sqrt(2)", core::f64::consts::SQRT_2, -9.667_293_313_452_912e-17),
        ("72 km/h", 20.0, 0.0),
        ("sin(30 deg)", 0.5, 0.0),
        ("2^10", 1024.0, 0.0),
        ("-2^2", -4.0, 0.0),
        ("2^-2", 0.25, 0.0),
        ("(1 + 2)*k - 1", 8.0, 0.0),
        ("min(3, 2) + max(1, 5) + abs(-4)", 11.0, 0.0),
        ("atan2(0, 1) + tan(0)", 0.0, 0.0),
        ("6/2/3", 1.0, 0.0),
        ("2 kg*m^2", 2.0, 0.0),
        ("5 m/s^2", 5.0, 0.0),
        ("3 min", 180.0, 0.0),
        ("1 m/k", 0.333_333_333_333_333_3, 1.850_371_707_708_594e-17),
    ] {
        let found = value(text);
        assert_eq!(found.hi(), near, "{text}");
        assert!((found.lo() - far).abs() <= 1e-31 * near.abs().max(1.0), "{text}: {}", found.lo());
    }
    let rpm = value("50 rpm");
    assert_eq!(rpm.hi(), 5.235_987_755_982_989);
    assert!((rpm.lo() + 9.195e-17).abs() < 1e-20, "{}", rpm.lo());
}

/// A quotient of whole numbers is rounded once. A length in millimetres is therefore the number nearest to its decimal in metres.
#[test]
fn a_number_with_a_unit_is_the_number_nearest_to_its_decimal_in_si() {
    for k in 1..=1000_u32 {
        let si = format!("{}e-3", k);
        assert_eq!(value(&format!("{k} mm")).hi(), si.parse::<f64>().expect("a number"), "{k}");
        assert_eq!(value(&format!("{k} g")).hi(), si.parse::<f64>().expect("a number"), "{k}");
    }
    assert_eq!(value("0.1 + 0.2").hi(), 0.3);
    assert_eq!(value("35.9 kN/m").hi(), 35_900.0);
    assert_eq!(value("1 in").hi(), 0.0254);
}

#[test]
fn faults_stand_at_their_place() {
    for (text, start, message) in [
        ("2*x", 2, "`x` is no parameter"),
        ("2 x", 2, "`x` is no unit"),
        ("2 +", 3, "the expression ends too early"),
        ("", 0, "the expression ends too early"),
        ("(1 + 2", 0, "a bracket is not closed"),
        ("1/(2 - 2)", 2, "division by zero"),
        ("0^-1", 2, "division by zero"),
        ("sqrt(-1)", 0, "the root of a negative number"),
        ("2^1.5", 3, "`.` cannot stand here"),
        ("2^x", 2, "an exponent is a whole number"),
        ("2^65", 2, "an exponent is a whole number"),
        ("sin", 0, "`sin` is a function"),
        ("min(1)", 0, "`min` takes two numbers"),
        ("kg", 0, "`kg` is a unit"),
        ("1 € 2", 2, "`€` cannot stand here"),
        ("1e200*1e200", 0, "the value is not finite"),
    ] {
        let found = fault(text);
        assert_eq!((found.span.start, found.message.as_str()), (start, message), "{text}");
        assert!(text.is_char_boundary(found.span.end.min(text.len())), "{text}");
    }
    let deep = "(".repeat(70);
    assert!(fault(&deep).message.starts_with("more than 64"));
    assert!(fault(&"-".repeat(100)).message.starts_with("more than 64"));
}

#[test]
fn dimensions_of_keys_and_of_numbers_agree() {
    let of = |text: &str| {
        let mut none = |_: &str| Err([String::new(), String::new()]);
        evaluate(text, &mut none).ok().and_then(|found| found.dimensions)
    };
    for (text, key) in [
        ("40 mm", "m"),
        ("3 kN/m", "N/m"),
        ("2 N*s/m", "N s/m"),
        ("5 N*m/rad", "N m/rad or N/m"),
        ("3 deg", "rad or m"),
        ("1 g*cm^2", "kg m^2"),
        ("7 km/h", "m/s"),
    ] {
        assert!(of_key(key).contains(&of(text).expect("alone")), "{text}, {key}");
    }
    assert!(!of_key("N/m").contains(&of("40 mm").expect("alone")));
    for other in ["2*3 mm", "40", "1 mm + 1 mm", "k"] {
        assert_eq!(of(other), None, "{other}");
    }
    assert!(of_key("-").is_empty() && of_key("s, value").is_empty());
}

//! Tests of the text of numbers, and of counts with their nouns.

use mbs_scene::format::*;

#[test]
fn rounding_keeps_leading_digits() {
    assert_eq!(rounded(123_456.789, 4).to_bits(), 123_500.0_f64.to_bits());
    assert!(rounded(f64::NAN, 4).is_nan());
}

#[test]
fn numbers_are_short_and_never_lose_their_size() {
    let texts = [-0.0, 1.0, -2.5e-5, 123_456_789.4, 1e12, f64::NAN].map(significant);
    assert_eq!(texts, ["0", "1", "-2.5e-5", "123456789", "1e12", "NaN"]);
}

#[test]
fn nouns_have_their_plurals() {
    assert_eq!(counted(1, "body"), "1 body");
    assert_eq!(counted(0, "body"), "0 bodies");
    assert_eq!(counted(2, "degree of freedom"), "2 degrees of freedom");
    assert_eq!(counted(3, "equation"), "3 equations");
}

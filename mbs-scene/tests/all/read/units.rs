//! Hints for units that are written without quotes.

use mbs_scene::inside::units::{hint, of_json, of_line};

#[test]
fn numbers_with_units_are_converted_to_si() {
    for (text, expected) in [
        ("1 kg", "write 1, in SI units, or \"1 kg\" in quotes"),
        ("5mm", "write 0.005, in SI units, or \"5 mm\" in quotes"),
        ("-2.5e-1 kN/m", "write -250, in SI units, or \"-2.5e-1 kN/m\" in quotes"),
        ("90°", "write 1.5707963267948966, in SI units, or \"90 deg\" in quotes"),
        ("72 km/h", "write 20, in SI units, or \"72 km/h\" in quotes"),
        ("3 N m", "write 3, in SI units, or \"3 N*m\" in quotes"),
        ("3 furlongs", "write a number alone, in SI units (m, kg, s, N, rad)"),
    ] {
        assert_eq!(hint(text).as_deref(), Some(expected), "{text}");
    }
}

#[test]
fn lines_whose_fault_is_another_are_left_alone() {
    assert!(of_line("mass = 1.0 kg # heavy").expect("a unit").starts_with("write 1.0,"));
    assert!(of_line("stiffness = 3e4N/m").expect("a unit").starts_with("write 3e4,"));
    let place = of_line("rod = { from = [0.0, 0.0], to = [40 mm, 0] }").expect("a unit");
    assert!(place.starts_with("write 0.04,"), "{place}");
    assert_eq!(of_line("mass = 2,5").as_deref(), Some("write 2.5, with a decimal point"));
    assert!(of_json("\"mass\": 1.0 kg,").expect("a unit").starts_with("write 1.0,"));
    for line in ["mass = 1.0", "mass 1.0 kg", "name = \"a", "at = [1, 2", "[scene", "x = 1 = 2"] {
        assert_eq!(of_line(line), None, "{line}");
    }
}

//! Numbers that are written with a unit: scene files have SI numbers without one.

/// Units by name, with what they are in SI: numerator, denominator, and the SI unit.
const UNITS: [(&str, f64, f64, &str); 38] = [
    ("m", 1.0, 1.0, "m"),
    ("mm", 1.0, 1e3, "m"),
    ("cm", 1.0, 1e2, "m"),
    ("um", 1.0, 1e6, "m"),
    ("km", 1e3, 1.0, "m"),
    ("in", 254.0, 1e4, "m"),
    ("kg", 1.0, 1.0, "kg"),
    ("g", 1.0, 1e3, "kg"),
    ("mg", 1.0, 1e6, "kg"),
    ("t", 1e3, 1.0, "kg"),
    ("s", 1.0, 1.0, "s"),
    ("sec", 1.0, 1.0, "s"),
    ("ms", 1.0, 1e3, "s"),
    ("us", 1.0, 1e6, "s"),
    ("min", 60.0, 1.0, "s"),
    ("h", 3600.0, 1.0, "s"),
    ("N", 1.0, 1.0, "N"),
    ("kN", 1e3, 1.0, "N"),
    ("MN", 1e6, 1.0, "N"),
    ("Nm", 1.0, 1.0, "N m"),
    ("N*m", 1.0, 1.0, "N m"),
    ("N m", 1.0, 1.0, "N m"),
    ("N/m", 1.0, 1.0, "N/m"),
    ("N/mm", 1e3, 1.0, "N/m"),
    ("kN/m", 1e3, 1.0, "N/m"),
    ("N*s/m", 1.0, 1.0, "N s/m"),
    ("Ns/m", 1.0, 1.0, "N s/m"),
    ("m/s", 1.0, 1.0, "m/s"),
    ("km/h", 1e3, 3600.0, "m/s"),
    ("m/s^2", 1.0, 1.0, "m/s^2"),
    ("rad", 1.0, 1.0, "rad"),
    ("rad/s", 1.0, 1.0, "rad/s"),
    ("deg", core::f64::consts::PI, 180.0, "rad"),
    ("\u{b0}", core::f64::consts::PI, 180.0, "rad"),
    ("rpm", core::f64::consts::PI, 30.0, "rad/s"),
    ("Hz", 1.0, 1.0, "Hz"),
    ("kg*m^2", 1.0, 1.0, "kg m^2"),
    ("kg m^2", 1.0, 1.0, "kg m^2"),
];

/// A text that begins with a decimal number: that number, and what follows it.
pub(crate) fn quantity(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-' | '_');
    let mut end = text.find(|c| !is_part(c)).unwrap_or(text.len());
    // an exponent, if digits follow its letter
    if let Some(rest) = text[end..].strip_prefix(['e', 'E']) {
        let digits = rest.find(|c: char| !is_part(c)).unwrap_or(rest.len());
        if rest[..digits].contains(|c: char| c.is_ascii_digit()) {
            end += 1 + digits;
        }
    }
    let (number, rest) = text.split_at(end);
    number.replace('_', "").parse::<f64>().ok().filter(|x| x.is_finite())?;
    Some((number, rest.trim()))
}

/// What to write instead of a text.
pub(crate) fn hint(text: &str) -> String {
    let Some((number, unit)) = quantity(text) else {
        return "write a number, in SI units and without quotes".to_owned();
    };
    if unit.is_empty() {
        return format!("write {number}, without quotes");
    }
    let known = UNITS.iter().find(|(name, ..)| *name == unit);
    let (Some((_, over, under, si)), Ok(value)) = (known, number.replace('_', "").parse::<f64>())
    else {
        return "write a number alone: all numbers are in SI units (m, kg, s, N, rad)".to_owned();
    };
    #[allow(clippy::float_cmp, reason = "both are written as one")]
    let number =
        if over == under { number.to_owned() } else { format!("{:?}", value * over / under) };
    format!("write {number}: all numbers are in SI units, here in {si}")
}

/// What to do about a line that is not TOML because a number in it has a unit.
pub(crate) fn of_line(line: &str) -> Option<String> {
    let (_, value) = line.split_once('=')?;
    let value = value.split('#').next()?;
    let is_unit = |unit: &str| unit.starts_with(|c: char| c.is_alphabetic() || c == '\u{b0}');
    let parts = value.split([',', '[', ']', '{', '}', '=']);
    parts
        .map(str::trim)
        .find(|part| quantity(part).is_some_and(|(_, unit)| is_unit(unit)))
        .map(hint)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_with_units_are_converted_to_si() {
        for (text, expected) in [
            ("1 kg", "write 1: all numbers are in SI units, here in kg"),
            ("5mm", "write 0.005: all numbers are in SI units, here in m"),
            ("-2.5e-1 kN/m", "write -250.0: all numbers are in SI units, here in N/m"),
            ("90 deg", "write 1.5707963267948966: all numbers are in SI units, here in rad"),
            ("72 km/h", "write 20.0: all numbers are in SI units, here in m/s"),
            ("1 in", "write 0.0254: all numbers are in SI units, here in m"),
            ("1.0", "write 1.0, without quotes"),
            ("3 furlongs", "write a number alone: all numbers are in SI units (m, kg, s, N, rad)"),
            ("much", "write a number, in SI units and without quotes"),
            ("", "write a number, in SI units and without quotes"),
        ] {
            assert_eq!(hint(text), expected, "{text}");
        }
    }

    #[test]
    fn lines_whose_fault_is_another_are_left_alone() {
        assert!(of_line("mass = 1.0 kg # heavy").expect("a unit").starts_with("write 1.0:"));
        assert!(of_line("stiffness = 3e4N/m").expect("a unit").starts_with("write 3e4:"));
        let place = of_line("rod = { from = [0.0, 0.0], to = [40 mm, 0] }").expect("a unit");
        assert!(place.starts_with("write 0.04:"), "{place}");
        for line in ["mass = 1.0", "mass 1.0 kg", "name = \"a", "at = [1, 2", "[scene", "x = 1 = 2"]
        {
            assert_eq!(of_line(line), None, "{line}");
        }
    }
}

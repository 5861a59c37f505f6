//! Hints for numbers with a unit but without quotes, which are not valid TOML or JSON.

use super::expression::evaluate;
use crate::format::shortest;

/// Splits a text that begins with a decimal number into that number and the text after it.
fn quantity(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | '+' | '-' | '_');
    let mut end = text.find(|c| !is_part(c)).unwrap_or(text.len());
    // The letter of an exponent counts only with digits after it.
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

/// Hint that says what to write instead of a number with a unit.
pub fn hint(text: &str) -> Option<String> {
    let (number, unit) = quantity(text)?;
    let plain = number.replace('_', "");
    let unit =
        unit.replace('\u{b0}', "deg").replace("Nm", "N*m").replace("Ns", "N*s").replace(' ', "*");
    let with_unit = format!("{plain} {unit}");
    let mut none = |_: &str| Err([String::new(), String::new()]);
    let value = evaluate(&with_unit, &mut none).ok().map(|found| found.value.hi());
    let Some(value) = value else {
        return Some("write a number alone, in SI units (m, kg, s, N, rad)".to_owned());
    };
    #[allow(clippy::float_cmp, reason = "is it the same number?")]
    let is_same = plain.parse::<f64>().is_ok_and(|number| number == value);
    let si = if is_same { number.to_owned() } else { shortest(value) };
    Some(format!("write {si}, in SI units, or \"{with_unit}\" in quotes"))
}

/// Hint for a line that is not TOML because a number in it has a unit.
pub fn of_line(line: &str) -> Option<String> {
    let (_, value) = line.split_once('=')?;
    of_value(value.split('#').next()?)
}

/// Hint for a line that is not JSON because a number in it has a unit.
pub fn of_json(line: &str) -> Option<String> {
    of_value(line.split_once(':')?.1)
}

fn of_value(value: &str) -> Option<String> {
    let comma = value.trim().split_once(',');
    let is_digits = |text: &str| !text.is_empty() && text.chars().all(|c| c.is_ascii_digit());
    if let Some((whole, part)) = comma
        && is_digits(whole.trim_start_matches('-'))
        && is_digits(part)
    {
        return Some(format!("write {whole}.{part}, with a decimal point"));
    }
    let is_unit = |unit: &str| unit.starts_with(|c: char| c.is_alphabetic() || c == '\u{b0}');
    let parts = value.split([',', '[', ']', '{', '}', '=', ':']);
    let mut parts = parts.map(str::trim);
    parts.find(|part| quantity(part).is_some_and(|(_, unit)| is_unit(unit))).and_then(hint)
}

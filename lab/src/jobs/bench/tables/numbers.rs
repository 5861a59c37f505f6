//! Numbers as the tables write them.

use super::super::measured::{Measured, Scene};

/// A time with three digits and its unit.
pub(super) fn time(seconds: f64) -> String {
    let (number, unit) = match seconds {
        x if x < 1e-6 => (x * 1e9, "ns"),
        x if x < 1e-3 => (x * 1e6, "µs"),
        x if x < 1.0 => (x * 1e3, "ms"),
        x => (x, "s"),
    };
    let digits = if number < 10.0 { 2 } else { usize::from(number < 100.0) };
    format!("{number:.digits$} {unit}")
}

/// A count with its thousands apart.
pub(super) fn count(x: Option<f64>) -> String {
    let Some(x) = x else { return String::new() };
    let digits = format!("{x:.0}");
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A number with one digit behind the point, as counts of one step are; empty where there is none.
pub(super) fn average(x: Option<f64>) -> String {
    x.map(|x| format!("{x:.1}")).unwrap_or_default()
}

/// A ratio; empty where there is none.
pub(super) fn ratio(x: Option<f64>) -> String {
    x.map(|x| format!("{x:.2}")).unwrap_or_default()
}

/// A share.
pub(super) fn percent(x: f64) -> String {
    // Without a minus on zero.
    format!("{:.0} %", (x * 100.0).round() + 0.0)
}

/// Least and largest of some numbers.
pub(super) fn span(numbers: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    numbers.fold(None, |span, x| {
        let [low, high] = span.unwrap_or([x, x]);
        Some([low.min(x), high.max(x)])
    })
}

/// Scenes in the order of their unknowns.
pub(super) fn by_size(measured: &Measured) -> Vec<&Scene> {
    let mut scenes: Vec<_> = measured.scenes.iter().collect();
    let size = |scene: &Scene| scene.size("unknowns").unwrap_or(0.0);
    scenes.sort_by(|a, b| size(a).total_cmp(&size(b)));
    scenes
}

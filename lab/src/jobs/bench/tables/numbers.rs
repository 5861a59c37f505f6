//! Numbers as the tables write them.

use super::super::measured::{Measured, Scene};
pub(super) use crate::format::{span, time};

/// A count, with spaces between thousands.
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

/// A number with one decimal, such as an average count per step; empty without a number.
pub(super) fn average(x: Option<f64>) -> String {
    x.map(|x| format!("{x:.1}")).unwrap_or_default()
}

/// Writes a ratio; empty without a number.
pub(super) fn ratio(x: Option<f64>) -> String {
    x.map(|x| format!("{x:.2}")).unwrap_or_default()
}

/// Writes a fraction in percent.
pub(super) fn percent(x: f64) -> String {
    // adding zero removes the sign of a negative zero
    format!("{:.0} %", (x * 100.0).round() + 0.0)
}

/// Scenes in increasing order of their unknowns.
pub(super) fn by_size(measured: &Measured) -> Vec<&Scene> {
    let mut scenes: Vec<_> = measured.scenes.iter().collect();
    let size = |scene: &Scene| scene.size("unknowns").unwrap_or(0.0);
    scenes.sort_by(|a, b| size(a).total_cmp(&size(b)));
    scenes
}

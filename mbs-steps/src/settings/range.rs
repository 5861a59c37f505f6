//! Checks of the names and values of settings: names must be available, and numbers must be positive.

use super::error::SettingsError;

/// Returns the selected name and its value. The caller's name has priority over the scene's name, and the scene's name over the default.
pub(super) fn named<U: Copy, const N: usize>(
    key: &'static str,
    (from_caller, from_scene, default): (&Option<String>, &Option<String>, &str),
    names: &'static [&'static str; N],
    values: [U; N],
) -> Result<(String, U), SettingsError> {
    let name = from_caller.as_deref().or(from_scene.as_deref()).unwrap_or(default);
    match names.iter().position(|n| *n == name) {
        Some(i) => Ok((name.to_owned(), values[i])),
        None => Err(SettingsError::NotBuilt {
            key,
            value: name.to_owned(),
            built: names,
            from_scene: from_caller.is_none(),
        }),
    }
}

pub(super) fn positive(key: &'static str, value: f64) -> Result<f64, SettingsError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(SettingsError::NotPositive { key, value })
    }
}

/// Checks the limits U and L of the energy rule: both must be positive, and U must be larger than L.
pub(super) fn ordered([upper, lower]: [f64; 2]) -> Result<[f64; 2], SettingsError> {
    let limits = [positive("energy_tolerance", upper)?, positive("energy_tolerance", lower)?];
    if upper > lower { Ok(limits) } else { Err(SettingsError::LimitOrder(limits)) }
}

pub(super) fn checked(key: &'static str, value: Option<f64>) -> Result<Option<f64>, SettingsError> {
    value.map(|x| positive(key, x)).transpose()
}

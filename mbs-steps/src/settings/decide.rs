//! Decisions between what the command line gives, what the scene says, and what holds without both.

use super::{Method, SettingsError};
use crate::choice::{INTEGRATORS, IntegratorKind, STEP_RULES, StepRule};
use crate::methods::{FORMULATIONS, FormulationKind, PenaltyUse};
use mbs_core::Real;
use mbs_core::control::EnergyRule;
use mbs_core::scene::SolverTable;

/// The formulation as asked and as it runs, and the integrator.
pub(super) fn method<T>(
    solver: &SolverTable<T>,
    overrides: &Method,
) -> Result<(String, FormulationKind, IntegratorKind), SettingsError> {
    let (asked, formulation) = named(
        "formulation",
        (&overrides.formulation, &solver.formulation, "auto"),
        &FORMULATIONS,
        // `auto` stands before them.
        core::array::from_fn(|i| i.checked_sub(1).map(|i| FormulationKind::ALL[i])),
    )?;
    let (_, integrator) = named(
        "integrator",
        (&overrides.integrator, &solver.integrator, "trapezoidal"),
        &INTEGRATORS,
        IntegratorKind::ALL,
    )?;
    let formulation = match formulation {
        Some(formulation) => formulation,
        None if integrator.is_of_first_order() => FormulationKind::RELATIVE,
        None => FormulationKind::DEFAULT,
    };
    if !formulation.runs_with(integrator) {
        let option = format!("integrator {}", integrator.name());
        return Err(SettingsError::NotTogether { formulation, option });
    }
    if formulation.row().penalty == PenaltyUse::None && overrides.penalty.is_some() {
        let option = "penalty".to_owned();
        return Err(SettingsError::NotTogether { formulation, option });
    }
    Ok((asked, formulation, integrator))
}

/// Rule that chooses the length of the steps. The rule that the command line names comes first, then one that it gives tolerances for. Next is
/// the rule that the scene names, and last the one of its error tolerance. The energy limits of a scene are meant for multi-index, which has the
/// energy rule anyway.
pub(super) fn step_rule<T>(
    solver: &SolverTable<T>,
    overrides: &Method,
    (formulation, integrator): (FormulationKind, IntegratorKind),
) -> Result<StepRule, SettingsError> {
    let of_formulation = formulation.row().energy_rule;
    let given = [overrides.energy_tolerance.is_some(), overrides.error_tolerance.is_some()];
    let is_named = overrides.step_control.is_some() || solver.step_control.is_some();
    let (from_caller, default) = if overrides.step_control.is_none() && given != [false; 2] {
        let rule = StepRule::of(given[0] || of_formulation, given[1]);
        (Some(rule.name().to_owned()), rule)
    } else {
        let default = StepRule::of(of_formulation, solver.error_tolerance.is_some());
        (overrides.step_control.clone(), default)
    };
    let [from_caller, from_scene] = [&from_caller, &solver.step_control]
        .map(|name| name.as_deref().map(|name| StepRule::canonical(name).to_owned()));
    let names = (&from_caller, &from_scene, default.name());
    let (_, rule) = named("step_control", names, &STEP_RULES, StepRule::ALL)?;
    if rule == StepRule::Fixed || !integrator.is_of_first_order() {
        return Ok(rule);
    }
    // A tolerance in the scene is for integrators that can use it.
    if !is_named && given == [false; 2] {
        return Ok(StepRule::Fixed);
    }
    let option = format!("step control {} beside integrator {}", rule.name(), integrator.name());
    Err(SettingsError::NotTogether { formulation, option })
}

/// U and L of the energy rule: the caller's, the scene's, or the usual ones.
pub(super) fn energy_limits<T: Real>(solver: &SolverTable<T>, overrides: &Method) -> [f64; 2] {
    let of_scene = solver.energy_tolerance.map(|limits| limits.map(T::to_f64));
    let usual = EnergyRule::default();
    overrides.energy_tolerance.or(of_scene).unwrap_or([usual.upper, usual.lower])
}

/// The value that belongs to the first name given: override, scene, default.
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

/// U and L of the energy rule.
pub(super) fn ordered([upper, lower]: [f64; 2]) -> Result<[f64; 2], SettingsError> {
    let limits = [positive("energy_tolerance", upper)?, positive("energy_tolerance", lower)?];
    if upper > lower { Ok(limits) } else { Err(SettingsError::LimitOrder(limits)) }
}

pub(super) fn checked(key: &'static str, value: Option<f64>) -> Result<Option<f64>, SettingsError> {
    value.map(|x| positive(key, x)).transpose()
}

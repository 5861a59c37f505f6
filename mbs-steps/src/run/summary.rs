//! Functions that compute the parts of a run's summary.

use super::Outcome;
use super::record::Counts;
use crate::names::Names;
use crate::record::{
    Channel, Contact, EnergySummary, MethodUsed, RunRecord, RunSummary, StepSeries,
};
use crate::settings::ResolvedMethod;
use crate::stop::StopError;
use crate::words::{stop_text, summary_rows};
use mbs_core::Real;
use mbs_core::control::Invariant;
use mbs_core::outputs;
use mbs_core::scene::Scene;

/// Converts an instant of contact, with the name of its effect.
pub(super) fn contact<T: Real>(scene: &Scene<T>, instant: &outputs::Instant) -> Contact {
    let effect = &scene.effects[instant.effect];
    Contact {
        time: instant.t,
        effect: effect.name.clone(),
        end: effect.kind.row().ends.get(instant.end).copied(),
        event: if instant.makes { "made" } else { "broken" },
    }
}

/// Summary of the energy invariant over all steps.
pub(super) fn energy_summary(invariant: &Invariant) -> EnergySummary {
    EnergySummary {
        initial: invariant.initial(),
        max_error: invariant.max_error(),
        final_error: invariant.error().abs(),
        turned_over: invariant.turned_over(),
        scatter: invariant.scatter(),
        drift: invariant.drift(),
    }
}

/// Method that the run used, and counts of its steps up to time `reached` [s].
pub(super) fn method_used(settings: &ResolvedMethod, counts: &Counts, reached: f64) -> MethodUsed {
    let control = &counts.control;
    // If the two counts differ, the integrator has made internal steps of unknown length.
    let is_known = control.accepted == counts.steps && counts.steps > 0;
    #[allow(clippy::cast_precision_loss, reason = "step counts stay far below 2^53")]
    let mean_step = reached / counts.steps.max(1) as f64;
    MethodUsed {
        steps: counts.steps,
        smallest_step: is_known.then_some(control.smallest_step),
        largest_step: is_known.then_some(control.largest_step),
        mean_step,
        ..plain_method(settings)
    }
}

fn plain_method(settings: &ResolvedMethod) -> MethodUsed {
    MethodUsed {
        formulation: settings.formulation.name().to_owned(),
        integrator: settings.integrator.name().to_owned(),
        ..MethodUsed::default()
    }
}

pub(super) fn plain_summary<T: Real>(scene: &Scene<T>, settings: &ResolvedMethod) -> RunSummary {
    RunSummary {
        scene: scene.name.clone(),
        formulation: settings.asked.clone(),
        integrator: settings.integrator.name().to_owned(),
        precision: settings.precision.name().to_owned(),
        method_used: plain_method(settings),
        dimension: scene.dimension.count(),
        step: settings.step,
        chosen: settings.chosen(),
        ..RunSummary::default()
    }
}

pub(super) fn not_started<T: Real>(
    scene: &Scene<T>,
    settings: &ResolvedMethod,
    channels: &[Channel],
    error: StopError,
) -> Outcome {
    let report = error.report(0.0, &Names::new(scene));
    let summary = RunSummary { error: Some(report), ..plain_summary(scene, settings) };
    let record = RunRecord {
        scene: scene.name.clone(),
        summary: summary_rows(&summary),
        error: summary.error.as_ref().map(stop_text),
        ..RunRecord::default()
    };
    Outcome {
        summary,
        error: Some(error),
        record,
        channels: channels.to_vec(),
        table: Vec::new(),
        long_table: Vec::new(),
        ranges: Vec::new(),
        steps: StepSeries::default(),
    }
}

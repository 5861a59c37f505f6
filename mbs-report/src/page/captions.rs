//! Sentences below the plots of a page, made from the numbers in each plot.

use mbs::record::{EnergySeries, IterationSeries, StepSeries, ViolationSeries};
use mbs_scene::format::significant;

pub(super) fn energy_error(series: &EnergySeries) -> String {
    let Some((time, value)) = peak(&series.times, &series.invariant_error) else {
        return String::new();
    };
    if value == 0.0 {
        return "The energy invariant Pi = T + V - work of dampers, forces and guides stayed where it was, \
                to the last digit."
            .to_owned();
    }
    let time = significant(time);
    format!(
        "How far the energy invariant Pi = T + V - work of dampers, forces and guides is from its \
         start: at most {value:.3e} J, at t = {time} s. A drift grows; rounding scatters."
    )
}

pub(super) fn energies() -> String {
    "Kinetic energy T and potential energy V: what one loses the other gains, but for work done from \
     outside and by dampers."
        .to_owned()
}

pub(super) fn violation(series: &ViolationSeries) -> String {
    let largest = |values| peak(&series.times, values).map_or(0.0, |(_, value)| value);
    format!(
        "How far the constraints are from being met, largest residual at each level: position {:.1e} \
         m, velocity {:.1e} m/s, acceleration {:.1e} m/s^2 (or rad). The lines are upper edges; zeros have \
         no place on a logarithmic axis, which shows sixteen decades at most.",
        largest(&series.position),
        largest(&series.velocity),
        largest(&series.acceleration)
    )
}

pub(super) fn iterations(series: &IterationSeries) -> String {
    let n = series.counts.len().max(1);
    let sum: u64 = series.counts.iter().map(|count| u64::from(*count)).sum();
    let most = series.counts.iter().max().copied().unwrap_or(0);
    #[allow(clippy::cast_precision_loss, reason = "a mean for reading")]
    let mean = sum as f64 / n as f64;
    format!(
        "Newton iterations of each step: {mean:.2} on average, {most} at most. The line is an upper edge."
    )
}

pub(super) fn steps(series: &StepSeries) -> String {
    let c = &series.totals;
    if c.accepted == 0 {
        return String::new();
    }
    let index = match c.index_1_steps {
        0 => String::new(),
        n => format!(" {n} were made in index-1."),
    };
    format!(
        "Length of the {} steps: {:.1e} s at least, {:.1e} s at most; {} trials were rejected.{index}",
        c.accepted, c.smallest_step, c.largest_step, c.rejected
    )
}

pub(super) fn channel(names: &[&str], unit: &str) -> String {
    let verb = if names.len() == 1 { "Output" } else { "Outputs" };
    format!("{verb} {} over time [{unit}].", names.join(", "))
}

/// Returns the time and the size of the largest absolute value.
fn peak(times: &[f64], values: &[f64]) -> Option<(f64, f64)> {
    let pairs = times.iter().zip(values).filter(|(_, value)| value.is_finite());
    pairs.map(|(t, x)| (*t, x.abs())).max_by(|(_, a), (_, b)| a.total_cmp(b))
}

//! Sentences below the diagrams, made from the numbers in each diagram.

use super::text::{seconds, short};
use mbs_study::compare::results::{Comparison, ConvergenceMap, MethodRuns, RunEntry, Status};

/// Returns the run that represents a method: the middle one of its completed runs.
pub(super) fn typical(m: &MethodRuns) -> Option<&RunEntry> {
    let n = m.completed().count();
    m.completed().nth(n / 2)
}

pub(super) fn work_precision(c: &Comparison) -> String {
    let all = || c.methods.iter().flat_map(|m| &m.runs);
    let count = |status| all().filter(|run| run.status == status).count();
    let mut text = String::new();
    for level in &c.ranking {
        let first: Vec<String> =
            level.ranks.iter().filter(|r| r.rank == 1).map(|r| r.name.clone()).collect();
        let Some(best) = level.ranks.first() else { continue };
        let take = if first.len() > 1 { "(called equal) take" } else { "takes" };
        text += &format!(
            "At an error of {:.0e} {} {take} least, {}. ",
            level.error,
            first.join(", "),
            seconds(level.ranks.iter().map(|r| r.seconds).fold(best.seconds, f64::min))
        );
    }
    let (failed, not_run) = (count(Status::Failed), count(Status::NotRun));
    text += &format!("{} runs were completed", count(Status::Completed));
    if failed > 0 {
        text += &format!(
            "; {failed} failed and stand on the rail at the right, at the CPU time they had spent"
        );
    }
    if not_run > 0 {
        text += &format!("; {not_run} were not made and are in the table of all runs");
    }
    text += ". Further left is more accurate, further down is cheaper";
    let is_slow = |run: &&RunEntry| run.cpu_least.is_some_and(|cpu| cpu > c.compared);
    text + match all().any(|run| is_slow(&run)) {
        true => "; below the line of real time a method keeps up with the clock.",
        false => "; all keep up with the clock.",
    }
}

pub(super) fn orders(c: &Comparison) -> String {
    let fits = || c.methods.iter().filter_map(|m| Some((m, m.fit.as_ref()?)));
    let orders: Vec<(f64, &str)> =
        fits().filter_map(|(m, fit)| Some((fit.order?, m.name.as_str()))).collect();
    let text = match (
        orders.iter().min_by(|a, b| a.0.total_cmp(&b.0)),
        orders.iter().max_by(|a, b| a.0.total_cmp(&b.0)),
    ) {
        (Some((low, a)), Some((high, b))) if orders.len() > 1 => format!(
            "Orders, fitted where at least three runs lie on a line, go from {low:.2} ({a}) to {high:.2} ({b})."
        ),
        (Some((order, name)), _) => format!("The fitted order of {name} is {order:.2}."),
        _ => "No three runs of a method lie on a line, so no order is fitted.".to_owned(),
    };
    let rounding: Vec<&str> = fits()
        .filter(|(_, fit)| fit.rounding_below.is_some())
        .map(|(m, _)| m.name.as_str())
        .collect();
    match rounding.len() {
        0 => text + " No error grows again as the step falls: rounding is not reached.",
        n if n <= 4 => {
            format!("{text} Rounding takes over at the shortest steps in {}.", rounding.join("; "))
        }
        n => format!(
            "{text} Rounding takes over at the shortest steps in {n} methods; the list says where."
        ),
    }
}

pub(super) fn times(c: &Comparison) -> String {
    let costs = c.methods.iter().filter_map(|m| {
        let run = typical(m)?;
        #[allow(clippy::cast_precision_loss, reason = "a mean for reading")]
        Some((run.cpu_least? / run.steps.max(1) as f64, m.name.as_str()))
    });
    let costs: Vec<(f64, &str)> = costs.collect();
    let (Some(low), Some(high)) = (
        costs.iter().min_by(|a, b| a.0.total_cmp(&b.0)),
        costs.iter().max_by(|a, b| a.0.total_cmp(&b.0)),
    ) else {
        return "No run was timed.".to_owned();
    };
    format!(
        "The cheapest step is that of {} ({}), the most expensive that of {} ({}); at steps of one length the cost is that of a step times \
         their number.",
        low.1,
        seconds(low.0),
        high.1,
        seconds(high.0)
    )
}

pub(super) fn drift(c: &Comparison) -> String {
    let of = |run: &RunEntry| run.energy.drift.map(f64::abs);
    format!(
        "Slope of the straight line through Pi(t) - Pi(0): what a run gains or loses for good. {}",
        extremes(c, of, "W")
    )
}

pub(super) fn scatter(c: &Comparison) -> String {
    format!(
        "Root mean square of the changes of Pi from step to step: what comes and goes, and rounding. {}",
        extremes(c, |run| run.energy.scatter, "J")
    )
}

pub(super) fn violation(c: &Comparison, level: usize) -> String {
    let unit = ["m or rad", "m/s or rad/s", "m/s² or rad/s²"][level.min(2)];
    format!(
        "Largest residual of the constraints over every step. {}",
        extremes(c, |run| run.violation.get(level).copied(), unit)
    )
}

/// Returns a text on the largest and the smallest value of completed runs.
fn extremes(c: &Comparison, value: impl Fn(&RunEntry) -> Option<f64>, unit: &str) -> String {
    let runs = c.methods.iter().flat_map(|m| m.completed().map(move |run| (m, run)));
    let values: Vec<(f64, &MethodRuns, &RunEntry)> =
        runs.filter_map(|(m, run)| Some((value(run)?, m, run))).collect();
    let by = |a: &&(f64, &MethodRuns, &RunEntry), b: &&(f64, &MethodRuns, &RunEntry)| {
        a.0.total_cmp(&b.0)
    };
    let (Some(most), Some(least)) = (values.iter().max_by(by), values.iter().min_by(by)) else {
        return "There is none to show.".to_owned();
    };
    let at = |(x, m, run): &(f64, &MethodRuns, &RunEntry)| {
        format!("{x:.1e} {unit} ({} at {})", m.name, short(run.setting))
    };
    let zeros = values.iter().filter(|(x, ..)| *x == 0.0).count();
    let note = if zeros > 0 { " Zeros lie on the lower edge." } else { "" };
    format!("Largest {}, smallest {}.{note}", at(most), at(least))
}

pub(super) fn histogram(c: &Comparison) -> String {
    let typical = c.methods.iter().filter_map(|m| Some((m, typical(m)?.step_times.clone()?)));
    let all: Vec<_> = typical.collect();
    let slow = all.iter().max_by(|a, b| (a.1.max / a.1.p50).total_cmp(&(b.1.max / b.1.p50)));
    let best = all.iter().min_by(|a, b| a.1.p99.total_cmp(&b.1.p99));
    let (Some(slow), Some(best)) = (slow, best) else {
        return "No steps were timed.".to_owned();
    };
    format!(
        "Steps of the middle run of each method, timed one by one in an extra run. The shortest p99 is {} ({}, p50 {}, max {}); the slowest step \
         is furthest from the p50 in {}: {} beside {}. A slowest step may be the system's doing.",
        seconds(best.1.p99),
        best.0.name,
        seconds(best.1.p50),
        seconds(best.1.max),
        slow.0.name,
        seconds(slow.1.max),
        seconds(slow.1.p50)
    )
}

pub(super) fn map(map: &ConvergenceMap) -> String {
    let cells = || map.cells.iter().flatten();
    let n = cells().count();
    let done = cells().filter(|cell| cell.failure.is_empty()).count();
    let mut best: Option<(f64, f64, f64)> = None;
    for (row, penalty) in map.cells.iter().zip(&map.penalties) {
        for (cell, step) in row.iter().zip(&map.steps) {
            if let Some(error) = cell.error.filter(|e| best.is_none_or(|(b, ..)| *e < b)) {
                best = Some((error, *step, *penalty));
            }
        }
    }
    let best = best.map_or(String::new(), |(error, step, penalty)| {
        format!(
            " The least error, {error:.1e}, is at a step of {} s and a penalty of {penalty:.0e}.",
            short(step)
        )
    });
    format!(
        "{done} of {n} runs over {} s are completed.{best} A cell has the exponent of its error (-4: 1e-4 to 1e-3), dark where the error is \
         large, above the mean iterations of a step, and x where the run stops.",
        short(map.span)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use mbs_study::compare::results::{Cell, Fit};

    #[test]
    fn captions_say_what_the_numbers_say() {
        let mut c = Comparison::default();
        assert!(work_precision(&c).starts_with("0 runs"));
        assert!(orders(&c).starts_with("No three runs") && times(&c) == "No run was timed.");
        let fit = Fit { order: Some(2.0), rounding_below: Some(1e-4), ..Fit::default() };
        let run = RunEntry {
            status: Status::Completed,
            setting: 1e-3,
            steps: 10,
            cpu_least: Some(1e-4),
            violation: [0.0, 2e-7, 0.0],
            ..RunEntry::default()
        };
        c.methods = vec![MethodRuns {
            name: "a".into(),
            fit: Some(fit),
            runs: vec![run],
            ..MethodRuns::default()
        }];
        assert!(orders(&c).contains("order of a is 2.00") && orders(&c).contains("in a."));
        assert!(times(&c).contains("10 us"), "{}", times(&c));
        assert!(violation(&c, 1).contains("2.0e-7 m/s or rad/s (a at 0.001)"));
        assert!(violation(&c, 0).contains("lower edge"));
    }

    #[test]
    fn a_map_names_its_best_cell() {
        let cell = |error: Option<f64>, failure: &str| Cell {
            error,
            failure: failure.into(),
            iterations: 2.0,
        };
        let cells = vec![
            vec![cell(Some(1e-3), ""), cell(None, "not-converged")],
            vec![cell(Some(1e-5), ""), cell(Some(1e-4), "")],
        ];
        let (steps, penalties) = (vec![1e-2, 1e-3], vec![1e3, 1e7]);
        let map_ =
            ConvergenceMap { cells, steps, penalties, span: 0.2, ..ConvergenceMap::default() };
        let text = map(&map_);
        assert!(
            text.starts_with("3 of 4 runs over 0.2 s")
                && text.contains("0.01 s and a penalty of 1e7"),
            "{text}"
        );
    }
}

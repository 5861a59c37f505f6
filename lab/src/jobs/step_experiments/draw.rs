//! Drawings of several experiments: histories of runs, and errors over tolerances and times.

use crate::chart::{Axis, Chart, Kind, Look, Series};
use crate::lab::Run;
use crate::lab::record::Record;

/// Style of index 3. Styles have the same meaning in every drawing.
pub(crate) const INDEX_3: usize = 2;
/// Style of index 1.
pub(crate) const INDEX_1: usize = 1;
/// Style of runs that change between both indices.
pub(crate) const MULTI: usize = 0;
/// Style of any other formulation.
const OTHER: usize = 3;
/// Style of a single line.
pub(crate) const ALONE: usize = 0;

/// The style of a formulation.
pub(crate) fn style(formulation: &str) -> usize {
    match formulation {
        "index-3" => INDEX_3,
        "index-1" => INDEX_1,
        "multi-index" => MULTI,
        _ => OTHER,
    }
}

/// Makes a series that is a line.
pub(crate) fn line(name: impl Into<String>, style: usize, points: Vec<[f64; 2]>) -> Series {
    Series::new(name, style, Look::Line, points)
}

/// A line with marks, with its points in increasing order of x.
pub(crate) fn curve(name: impl Into<String>, style: usize, mut points: Vec<[f64; 2]>) -> Series {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    Series::new(name, style, Look::Both, points)
}

/// The steps of a run over time. Steps in index 1 have marks of their own.
pub(crate) fn steps(record: &Record, name: &str, style: usize) -> Vec<Series> {
    let is_index_1 = |t: &[f64; 2]| {
        let i = record.steps.partition_point(|step| step.t < t[0]);
        record.steps.get(i).is_some_and(|step| step.is_index_1)
    };
    let all = record.points(|step| step.step);
    let index_1 = all.iter().copied().filter(is_index_1).collect();
    let marks = Series::new("its steps in index 1", INDEX_1, Look::Marks, index_1);
    vec![line(name, style, all), marks]
}

/// A chart over time.
pub(crate) fn over_time(label: &str, kind: Kind, series: Vec<Series>) -> Chart {
    Chart::new(Axis::time(), Axis::new(label, kind), series)
}

/// Points of the runs that have both numbers.
pub(crate) fn points<'a>(
    runs: impl IntoIterator<Item = &'a Run>,
    x: impl Fn(&Run) -> Option<f64>,
    y: impl Fn(&Run) -> Option<f64>,
) -> Vec<[f64; 2]> {
    runs.into_iter().filter_map(|run| Some([x(run)?, y(run)?])).collect()
}

/// Error over CPU time, with a curve for each formulation under each rule.
pub(crate) fn work_precision(
    runs: &[Run],
    label: &str,
    error: impl Fn(&Run) -> Option<f64>,
) -> Chart {
    let kind = |run: &Run| (run.case.formulation, run.case.rule());
    let mut kinds: Vec<_> = Vec::new();
    for run in runs {
        if !kinds.contains(&kind(run)) {
            kinds.push(kind(run));
        }
    }
    let series = kinds.iter().map(|&(formulation, rule)| {
        let these = runs.iter().filter(|run| kind(run) == (formulation, rule));
        // two rules of one formulation get different styles
        let like = kinds.iter().filter(|other| other.0 == formulation);
        let place = like.take_while(|other| other.1 != rule).count();
        let style = if place == 0 { style(formulation) } else { OTHER + place - 1 };
        curve(format!("{formulation}, {rule}"), style, points(these, Run::seconds, &error))
    });
    Chart::log_log("CPU [s]", label, series.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::record::Step;

    #[test]
    fn steps_in_index_1_have_marks() {
        let step = |t, is_index_1| Step {
            t,
            step: 0.5,
            is_index_1,
            energy_error: 0.0,
            energy_change: 0.0,
            penalty_energy: 0.0,
        };
        let steps_of_it = vec![step(0.5, false), step(1.0, true), step(1.5, false)];
        let record = Record { steps: steps_of_it, channels: Vec::new() };
        let series = steps(&record, "steps", MULTI);
        assert_eq!(series[0].points.len(), 3);
        assert_eq!(series[1].points, [[1.0, 0.5]]);
    }
}

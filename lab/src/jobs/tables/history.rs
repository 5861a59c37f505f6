//! Histories of one channel in the runs of a table, drawn in one chart.

use super::report::History;
use crate::chart::{Axis, Chart, Kind, Look, Series};

/// Caption of the drawing.
pub(crate) const CAPTION: &str =
    "Each method at its first step, and the first method at its last one.";

/// Style of the history of the first method at its last step.
const FINEST: usize = 4;

/// One line: its name in the legend, and its points (time, value) from the CSV of a run.
pub(crate) type Line = (String, Vec<[f64; 2]>);

/// The drawing of all lines. The first line, which has the finest step, is below the others.
pub(crate) fn chart(history: &History, lines: Vec<Line>) -> Chart {
    let scaled = |[t, x]: [f64; 2]| [t, x * history.scale];
    let series = |(i, (name, points)): (usize, Line)| {
        let points = points.into_iter().map(scaled).collect();
        Series::new(name, i.checked_sub(1).unwrap_or(FINEST), Look::Line, points)
    };
    let series = lines.into_iter().enumerate().map(series).collect();
    Chart::new(Axis::time(), Axis::new(history.label, Kind::FromZero), series)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HISTORY: History = History { column: "a.z", label: "a [g]", scale: 0.5 };

    #[test]
    fn a_drawing_scales_its_lines_and_names_its_axes() {
        let line = |name: &str, x: f64| (name.to_owned(), vec![[0.0, x], [1.0, -x]]);
        let chart = chart(&HISTORY, vec![line("reference", 1.0), line("index-3", 0.9)]);
        assert_eq!(chart.series[0].points, [[0.0, 0.5], [1.0, -0.5]]);
        let text = chart.svg().unwrap();
        assert!(text.contains("a [g]") && text.contains("t [s]"));
    }
}

//! Histories of one channel in the runs of a table, drawn over each other as one SVG.

use super::report::History;
use plotters::prelude::*;
use std::path::Path;

/// Size of a drawing in its own units.
const SIZE: (u32, u32) = (960, 320);
/// Slices of time of which the least and the largest value are drawn.
const SLICES: usize = 900;
/// Text and axes, readable on light and dark paper.
const INK: RGBColor = RGBColor(125, 133, 144);
/// Colours of the lines.
const COLORS: [RGBColor; 4] = [
    RGBColor(155, 164, 174),
    RGBColor(31, 119, 220),
    RGBColor(226, 128, 30),
    RGBColor(40, 160, 90),
];

/// One line: what it is, and its points (time, value).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Line {
    /// Its name in the legend.
    pub(crate) name: String,
    /// Its points.
    pub(crate) points: Vec<[f64; 2]>,
}

/// Reads a column of the CSV of a run.
///
/// # Errors
///
/// What is missing.
pub(crate) fn read(file: &Path, history: &History) -> Result<Vec<[f64; 2]>, String> {
    let place = |why: String| format!("{}: {why}", file.display());
    let mut reader = csv::Reader::from_path(file).map_err(|e| place(e.to_string()))?;
    let header = reader.headers().map_err(|e| place(e.to_string()))?.clone();
    let column = header.iter().position(|name| name == history.column);
    let column = column.ok_or_else(|| place(format!("no column `{}`", history.column)))?;
    let mut points = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| place(e.to_string()))?;
        let number = |i: usize| record.get(i).and_then(|x| x.parse::<f64>().ok());
        let (Some(t), Some(x)) = (number(0), number(column)) else {
            return Err(place(format!("no number in row {}", points.len() + 1)));
        };
        points.push([t, x * history.scale]);
    }
    Ok(points)
}

/// The least and the largest value of each slice of time, in their order.
fn extremes(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let every = points.len().div_ceil(SLICES).max(1);
    let mut kept = Vec::new();
    for slice in points.chunks(every) {
        let by = |a: &&[f64; 2], b: &&[f64; 2]| a[1].total_cmp(&b[1]);
        let (Some(least), Some(most)) = (slice.iter().min_by(by), slice.iter().max_by(by)) else {
            continue;
        };
        let (first, second) = if least[0] <= most[0] { (least, most) } else { (most, least) };
        kept.extend([*first, *second]);
    }
    kept
}

/// The drawing of all lines, the first one below the others.
///
/// # Errors
///
/// What the drawing library says, or that there is nothing to draw.
pub(crate) fn svg(history: &History, lines: &[Line]) -> Result<String, String> {
    let all = || lines.iter().flat_map(|line| &line.points);
    let end = all().fold(0.0_f64, |end, p| end.max(p[0]));
    let (low, high) = all().fold((0.0_f64, 0.0_f64), |(l, h), p| (l.min(p[1]), h.max(p[1])));
    if !(end > 0.0 && high > low) {
        return Err(format!("nothing to draw of `{}`", history.column));
    }
    let mut text = String::new();
    draw(&mut text, history, lines, [end, low, high]).map_err(|e| e.to_string())?;
    Ok(text)
}

fn draw(
    text: &mut String,
    history: &History,
    lines: &[Line],
    [end, low, high]: [f64; 3],
) -> Result<(), Box<dyn std::error::Error>> {
    let area = SVGBackend::with_string(text, SIZE).into_drawing_area();
    let margin = 0.05 * (high - low);
    let mut chart = ChartBuilder::on(&area)
        .margin(8)
        .margin_right(24)
        .x_label_area_size(36)
        .y_label_area_size(52)
        .build_cartesian_2d(0.0..end, low - margin..high + margin)?;
    let font = ("sans-serif", 14).into_font().color(&INK);
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(INK.mix(0.25))
        .axis_style(INK)
        .label_style(font.clone())
        .x_desc("t [s]")
        .y_desc(history.label)
        .draw()?;
    for (line, color) in lines.iter().zip(COLORS.iter().cycle()) {
        let points = extremes(&line.points).into_iter().map(|[t, x]| (t, x));
        chart
            .draw_series(LineSeries::new(points, color.stroke_width(1)))?
            .label(&line.name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], color.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .border_style(TRANSPARENT)
        .label_font(font)
        .draw()?;
    area.present()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const HISTORY: History = History { column: "a.z", label: "a [g]", scale: 0.5 };

    #[test]
    fn a_column_is_read_scaled_and_its_absence_is_named() {
        let file = std::env::temp_dir().join(format!("mbs-history-{}.csv", std::process::id()));
        std::fs::write(&file, "t,a.x,a.z\n0,1,2\n0.5,3,-4\n").unwrap();
        let points = read(&file, &HISTORY);
        let absent = read(&file, &History { column: "b", ..HISTORY });
        std::fs::remove_file(&file).unwrap();
        assert_eq!(points.unwrap(), [[0.0, 1.0], [0.5, -2.0]]);
        assert!(absent.unwrap_err().contains("`b`"));
    }

    #[test]
    fn peaks_survive_the_thinning() {
        let mut points: Vec<_> = (0..100_000).map(|i| [f64::from(i), 0.0]).collect();
        (points[77_777][1], points[12_345][1]) = (9.0, -7.0);
        let kept = extremes(&points);
        assert!(kept.len() <= 2 * SLICES && kept.is_sorted_by(|a, b| a[0] <= b[0]));
        assert!(kept.contains(&[77_777.0, 9.0]) && kept.contains(&[12_345.0, -7.0]));
    }

    #[test]
    fn a_drawing_names_its_lines_and_axes() {
        let line =
            |name: &str, x: f64| Line { name: name.into(), points: vec![[0.0, x], [1.0, -x]] };
        let text = svg(&HISTORY, &[line("reference", 1.0), line("index-3", 0.9)]).unwrap();
        for word in ["<svg", "reference", "index-3", "a [g]", "t [s]"] {
            assert!(text.contains(word), "{word}");
        }
        assert!(svg(&HISTORY, &[]).is_err());
    }
}

//! Pictures of runs: panels below each other, with a line for each run; and the conversion of pictures to files.

use super::pdf::PdfBackend;
use crate::refusal::Refusal;
use mbs::scene_file::format::{rounded, significant};
use plotters::coord::Shift;
use plotters::prelude::*;

/// Width of a picture, and height of each panel in it [px]. Chosen, not tuned.
const PANEL: (u32, u32) = (900, 300);
/// Number of parts into which a line is divided along its panel. The least and the largest point of each part are drawn, so that no peak is
/// lost.
const PARTS: usize = 900;
/// Margin beyond the values, relative to their range [-]. Chosen, not tuned.
const MARGIN: f64 = 0.05;
/// Range of an axis for values that are all equal, relative to the value [-]. Chosen, not tuned.
const LEAST_RANGE: f64 = 1e-6;
/// Height of texts, and room for the numbers of the axes [px]. Chosen, not tuned.
const TEXT: [u32; 3] = [13, 70, 38];
/// Digits of the numbers of an axis [-]. Chosen, not tuned.
const AXIS_DIGITS: usize = 6;
/// Colours of the runs, in their order. People with colour blindness can distinguish them (Okabe and Ito).
pub(super) const COLOURS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

/// A number of an axis without trailing zeros.
pub(super) fn number(x: f64) -> String {
    significant(rounded(x, AXIS_DIGITS))
}

/// A line of a run.
#[derive(Debug)]
pub(super) struct Line {
    pub(super) label: String,
    /// Number of the run, which determines the colour.
    pub(super) run: usize,
    pub(super) points: Vec<(f64, f64)>,
}

/// Lines over the same axes.
#[derive(Debug)]
pub(super) struct Panel {
    /// Titles of the horizontal and of the vertical axis.
    pub(super) titles: [String; 2],
    pub(super) lines: Vec<Line>,
    /// True if magnitudes are shown by their logarithm.
    pub(super) is_log: bool,
}

/// Error that stops a drawing.
pub(super) type Fault<B> = DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>;

/// Picture that can be drawn as a file of each kind.
pub(super) trait Picture {
    /// Returns the width and the height of the picture [px].
    fn size(&self) -> (u32, u32);

    /// Draws the picture into an area.
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), Fault<B>>;
}

/// True for an extension of picture files.
pub(crate) fn is_picture(ending: &str) -> bool {
    matches!(ending, "svg" | "pdf")
}

/// A picture as PDF or SVG, by the extension of its file; otherwise the refusal of a picture that cannot be drawn.
pub(super) fn drawn(picture: &(impl Picture + ?Sized), ending: &str) -> Result<Vec<u8>, Refusal> {
    let (mut bytes, mut text) = (Vec::new(), String::new());
    if ending == "pdf" {
        present(picture, PdfBackend::new(&mut bytes, picture.size()))?;
        return Ok(bytes);
    }
    present(picture, SVGBackend::with_string(&mut text, picture.size()))?;
    Ok(text.into_bytes())
}

fn present<B: DrawingBackend>(
    picture: &(impl Picture + ?Sized),
    backend: B,
) -> Result<(), Refusal> {
    let area = backend.into_drawing_area();
    let done = area.fill(&WHITE).and_then(|()| picture.draw(&area)).and_then(|()| area.present());
    done.map_err(|error| {
        Refusal::new("out-unwritable", format!("the picture cannot be drawn: {error}"), "")
    })
}

impl Picture for [Panel] {
    fn size(&self) -> (u32, u32) {
        (PANEL.0, PANEL.1 * u32::try_from(self.len()).unwrap_or(1).max(1))
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), Fault<B>> {
        let places = area.split_evenly((self.len().max(1), 1));
        self.iter().zip(&places).try_for_each(|(panel, place)| draw(panel, place))
    }
}

fn draw<B: DrawingBackend>(panel: &Panel, place: &DrawingArea<B, Shift>) -> Result<(), Fault<B>> {
    let lines: Vec<(&Line, Vec<(f64, f64)>)> =
        panel.lines.iter().map(|line| (line, shown(&line.points, panel.is_log))).collect();
    let all = || lines.iter().flat_map(|(_, points)| points);
    let [x, y] = [range(all().map(|p| p.0)), range(all().map(|p| p.1))];
    let [height, left, below] = TEXT;
    let mut chart = ChartBuilder::on(place)
        .margin(8)
        .x_label_area_size(below)
        .y_label_area_size(left)
        .build_cartesian_2d(x, y)?;
    let (is_log, font) = (panel.is_log, ("sans-serif", height).into_font());
    let of_axis = |y: &f64| if is_log { number(10_f64.powf(*y)) } else { number(*y) };
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .bold_line_style(RGBColor(225, 225, 225))
        .label_style(font.clone())
        .axis_desc_style(font.clone())
        .x_desc(panel.titles[0].as_str())
        .y_desc(panel.titles[1].as_str())
        .x_label_formatter(&|x| number(*x))
        .y_label_formatter(&of_axis)
        .y_labels(6)
        .draw()?;
    let is_named = lines.len() > 1;
    for (line, points) in lines {
        let colour = COLOURS[line.run % COLOURS.len()];
        let series = chart.draw_series(LineSeries::new(points, colour.stroke_width(2)))?;
        if is_named {
            let sample =
                move |(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2));
            series.label(line.label.as_str()).legend(sample);
        }
    }
    if is_named {
        let labels = &mut chart.configure_series_labels();
        labels.background_style(WHITE.mix(0.8)).border_style(RGBColor(200, 200, 200));
        labels.label_font(font).position(SeriesLabelPosition::UpperRight).draw()?;
    }
    Ok(())
}

/// The drawn points: the least and the largest of each part of the line, in their order. Zeros are left out on a logarithmic axis.
fn shown(points: &[(f64, f64)], is_log: bool) -> Vec<(f64, f64)> {
    let mapped = points.iter().map(|&(x, y)| (x, if is_log { y.abs().log10() } else { y }));
    let points: Vec<(f64, f64)> = mapped.filter(|point| point.1.is_finite()).collect();
    if points.len() <= 2 * PARTS {
        return points;
    }
    let part = |part: &[(f64, f64)]| {
        let by = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let place = |of: Option<&(f64, f64)>| {
            of.and_then(|of| part.iter().position(|point| core::ptr::eq(point, of)))
        };
        let mut both = [place(part.iter().min_by(by)), place(part.iter().max_by(by))];
        both.sort_unstable();
        both.into_iter().flatten().map(|i| part[i]).collect::<Vec<_>>()
    };
    points.chunks(points.len().div_ceil(PARTS)).flat_map(part).collect()
}

/// The range of an axis for these values.
pub(super) fn range(values: impl Iterator<Item = f64>) -> core::ops::Range<f64> {
    let ends = [f64::INFINITY, f64::NEG_INFINITY];
    let [low, high] = values.fold(ends, |[low, high], x| [low.min(x), high.max(x)]);
    if low > high {
        return 0.0..1.0;
    }
    let least = LEAST_RANGE * low.abs().max(high.abs()).max(LEAST_RANGE);
    let room = MARGIN * (high - low).max(least);
    low - room..high + room
}

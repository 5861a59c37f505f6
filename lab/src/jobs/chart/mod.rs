//! Drawings as SVG: lines and marks over linear and logarithmic axes.

pub(crate) mod picture;
mod scale;
pub(crate) mod style;
mod thin;

use plotters::prelude::*;
pub(crate) use scale::Kind;
use scale::Scale;
use style::{CURRENT, Style};

/// A drawing: its axes and series.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chart {
    /// Horizontal axis of the drawing.
    pub(crate) x: Axis,
    /// Axis that points upwards.
    pub(crate) y: Axis,
    /// Series of the drawing; the first is drawn below the others.
    pub(crate) series: Vec<Series>,
    /// A range of x that is shaded.
    pub(crate) shade: Option<[f64; 2]>,
}

/// An axis with its label and its spacing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axis {
    /// Label of the axis.
    pub(crate) label: String,
    /// Spacing of the numbers on the axis.
    pub(crate) kind: Kind,
}

/// Points that belong together.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Series {
    /// Name of the series in the legend. A series with an empty name is not in the legend.
    pub(crate) name: String,
    /// Number of its style: colour, dashes and mark.
    pub(crate) style: usize,
    /// Look of the series: a line, marks, or both.
    pub(crate) look: Look,
    /// Points (x, y) of the series.
    pub(crate) points: Vec<[f64; 2]>,
}

impl Series {
    /// Makes a series of points with a name, a style and a look.
    pub(crate) fn new(
        name: impl Into<String>,
        style: usize,
        look: Look,
        points: Vec<[f64; 2]>,
    ) -> Self {
        Self { name: name.into(), style, look, points }
    }

    /// A sample of the series for a legend: its line, its mark, or both.
    pub(crate) fn sample(&self) -> String {
        let has_line = matches!(self.look, Look::Line | Look::Both);
        Style::of(self.style).sample(has_line, self.look != Look::Line)
    }
}

/// Look of a series: a line, marks, or both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Look {
    /// Series as a line.
    Line,
    /// Series as small marks.
    Marks,
    /// Series as a line with a mark at each point.
    Both,
    /// Series as marks of the same size as in `Both`, without a line.
    Dots,
}

/// Width and height of a drawing, in pixels.
const SIZE: (u32, u32) = (960, 340);

impl Axis {
    /// An axis with its label.
    pub(crate) fn new(label: impl Into<String>, kind: Kind) -> Self {
        Self { label: label.into(), kind }
    }

    /// Makes the axis of time.
    pub(crate) fn time() -> Self {
        Self::new("t [s]", Kind::Linear)
    }

    /// True if the axis can show this number.
    fn shows(&self, x: f64) -> bool {
        x.is_finite() && (self.kind != Kind::Log || x > 0.0)
    }
}

impl Series {
    /// The points that the axes show, reduced to as many as can be distinguished: by slices of time for lines, by cells for marks.
    fn visible(&self, chart: &Chart, scales: (&Scale, &Scale)) -> Vec<(f64, f64)> {
        let points = self.points.iter().copied();
        let shown: Vec<_> =
            points.filter(|[x, y]| chart.x.shows(*x) && chart.y.shows(*y)).collect();
        match self.look {
            Look::Line => thin::extremes(&shown),
            Look::Both | Look::Dots => shown.into_iter().map(|[x, y]| (x, y)).collect(),
            Look::Marks => thin::cells(&shown, scales),
        }
    }
}

impl Chart {
    /// A chart without a shaded span.
    pub(crate) fn new(x: Axis, y: Axis, series: Vec<Series>) -> Self {
        Self { x, y, series, shade: None }
    }

    /// A chart with two logarithmic axes.
    pub(crate) fn log_log(x: &str, y: &str, series: Vec<Series>) -> Self {
        Self::new(Axis::new(x, Kind::Log), Axis::new(y, Kind::Log), series)
    }

    /// The series that are in the legend.
    pub(crate) fn named(&self) -> impl Iterator<Item = &Series> {
        self.series.iter().filter(|s| !s.name.is_empty() && !s.points.is_empty())
    }

    /// Draws the chart as SVG.
    ///
    /// # Errors
    ///
    /// There is nothing to draw, or the drawing library fails.
    pub(crate) fn svg(&self) -> Result<String, String> {
        let shown = |[x, y]: &&[f64; 2]| self.x.shows(*x) && self.y.shows(*y);
        let points = || self.series.iter().flat_map(|s| &s.points).filter(shown);
        let scales = Scale::over(self.x.kind, points().map(|p| p[0]))
            .zip(Scale::over(self.y.kind, points().map(|p| p[1])));
        let (x, y) = scales.ok_or_else(|| format!("nothing to draw of `{}`", self.y.label))?;
        let mut text = String::new();
        self.draw(&mut text, x, y).map_err(|e| e.to_string())?;
        let used = self.series.iter().map(|series| Style::of(series.style));
        Ok(style::finish(&text, used))
    }

    fn draw(
        &self,
        text: &mut String,
        x: Scale,
        y: Scale,
    ) -> Result<(), Box<dyn std::error::Error>> {
        let area = SVGBackend::with_string(text, SIZE).into_drawing_area();
        let mut chart = ChartBuilder::on(&area)
            .margin(6)
            .margin_right(18)
            .x_label_area_size(42)
            .y_label_area_size(66)
            .build_cartesian_2d(x.clone(), y.clone())?;
        if let Some([from, to]) = self.shade {
            let corners = [(from, y.low()), (to, y.high())];
            chart.draw_series([Rectangle::new(corners, CURRENT.mix(0.14).filled())])?;
        }
        let font = ("sans-serif", 15).into_font().color(&CURRENT);
        chart
            .configure_mesh()
            .x_labels(11)
            .y_labels(8)
            .light_line_style(TRANSPARENT)
            .bold_line_style(CURRENT.mix(0.22))
            .axis_style(CURRENT)
            .label_style(font)
            .x_desc(&*self.x.label)
            .y_desc(&*self.y.label)
            .draw()?;
        for series in &self.series {
            let style = Style::of(series.style);
            let points = series.visible(self, (&x, &y));
            if matches!(series.look, Look::Line | Look::Both) {
                let line = points.iter().copied();
                chart.draw_series(LineSeries::new(line, style.color.stroke_width(2)))?;
            }
            let radius = match series.look {
                Look::Line => continue,
                Look::Marks => 2,
                Look::Both | Look::Dots => 4,
            };
            let mark = style.mark(radius);
            chart.draw_series(points.into_iter().map(|point| {
                EmptyElement::at(point) + Polygon::new(mark.clone(), style.color.filled())
            }))?;
        }
        area.present()?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(look: Look, points: &[[f64; 2]]) -> Series {
        Series::new("a", 1, look, points.to_vec())
    }

    #[test]
    fn a_drawing_has_its_axes_and_its_points() {
        let points = [[1e-3, 1.0], [1e-5, 2.0], [0.0, 1.5], [1e-4, f64::NAN]];
        let axes = |x, y| (Axis::new("tolerance [-]", x), Axis::new("error [m]", y));
        let (x, y) = axes(Kind::Log, Kind::Linear);
        let mut chart = Chart::new(x, y, vec![series(Look::Both, &points)]);
        chart.shade = Some([1e-4, 2e-4]);
        let text = chart.svg().unwrap();
        for word in ["<svg", "tolerance [-]", "error [m]", "1e-4", "stroke-dasharray"] {
            assert!(text.contains(word), "{word}");
        }
        assert_eq!(text.matches("<polygon").count(), 2, "what is not positive is left out");
        assert!(text.contains("currentColor"), "ink is that of the page");
        chart.series.clear();
        assert!(chart.svg().unwrap_err().contains("error [m]"));
    }

    #[test]
    fn marks_that_cover_each_other_are_drawn_once() {
        let points: Vec<_> = (0..20_000).map(|i| [f64::from(i), f64::from(i % 2)]).collect();
        let axes = || (Axis::time(), Axis::new("index", Kind::FromZero));
        let (x, y) = axes();
        let text = Chart::new(x, y, vec![series(Look::Marks, &points)]).svg().unwrap();
        let n = text.matches("<polygon").count();
        assert!((200..2000).contains(&n), "{n}");
    }
}

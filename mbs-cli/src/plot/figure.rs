//! The work-precision diagram of a comparison as a picture: CPU time over error, both logarithmic.

use super::dashes::Dashed;
use super::picture::{COLOURS, Fault, Picture, drawn, number, range};
use crate::refusal::Refusal;
use mbs_study::compare::results::{Comparison, MethodRuns};
use plotters::coord::Shift;
use plotters::prelude::*;

/// Size of the picture with the names at its right [px]. Chosen, not tuned.
const SIZE: (u32, u32) = (1080, 620);
/// Width of the names of the lines [px], by the longest name.
const NAMES: u32 = 250;
/// Height of a line in the list of names [px]. Chosen, not tuned.
const ROW: i32 = 18;
/// Height of texts, and room for the numbers of the axes [px]. Chosen, not tuned.
const TEXT: [u32; 2] = [13, 56];
/// Marks of the integrators, as corners relative to a point [px].
const MARKS: [&[(i32, i32)]; 6] = [
    &[(-4, 0), (-3, -3), (0, -4), (3, -3), (4, 0), (3, 3), (0, 4), (-3, 3)],
    &[(-4, -4), (4, -4), (4, 4), (-4, 4)],
    &[(0, -5), (5, 4), (-5, 4)],
    &[(0, -6), (6, 0), (0, 6), (-6, 0)],
    &[(0, 5), (5, -4), (-5, -4)],
    &[(-5, -5), (5, -5), (-5, 5), (5, 5)],
];
/// Dashes of the formulations, as lengths of strokes and gaps [px]; the first is solid.
const DASHES: [[u32; 2]; 6] = [[1, 0], [8, 4], [2, 3], [12, 3], [5, 5], [1, 4]];

/// Style of a line: numbers of its integrator and its formulation, and whether steps are fixed.
#[derive(Debug, Clone, Copy)]
struct Look {
    integrator: usize,
    formulation: usize,
    is_fixed: bool,
}

/// Line of a method: the errors and CPU times of its runs.
struct Line<'a> {
    name: &'a str,
    look: Look,
    points: Vec<(f64, f64)>,
}

/// Work-precision diagram of a scene, with its lines.
struct Diagram<'a> {
    scene: &'a str,
    lines: Vec<Line<'a>>,
}

impl Picture for Diagram<'_> {
    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), Fault<B>> {
        draw(self.scene, &self.lines, area)
    }
}

/// The diagram as a file. It shows double precision if the comparison has it. Otherwise the refusal of a picture that cannot be drawn.
pub(crate) fn work_precision(comparison: &Comparison, ending: &str) -> Result<Vec<u8>, Refusal> {
    drawn(&Diagram { scene: &comparison.scene, lines: lines(comparison) }, ending)
}

fn lines(comparison: &Comparison) -> Vec<Line<'_>> {
    let has_double = comparison.methods.iter().any(|m| m.precision == "f64");
    let methods = || comparison.methods.iter().filter(|m| !has_double || m.precision != "f32");
    let place = |of: fn(&MethodRuns) -> &str, m: &MethodRuns| -> [usize; 2] {
        let mut names: Vec<&str> = Vec::new();
        for name in methods().map(of) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        let place = names.iter().position(|name| *name == of(m)).unwrap_or(0);
        [place, names.len() - 1 - place]
    };
    let line = |m| {
        let look = Look {
            integrator: place(|m: &MethodRuns| &m.integrator, m)[0] % COLOURS.len(),
            // the last formulation, recursive, has the most lines, and gets solid ones
            formulation: place(|m: &MethodRuns| &m.formulation, m)[1] % DASHES.len(),
            is_fixed: m.control == "fixed",
        };
        let runs = m.completed().filter_map(|run| Some((run.error?, run.cpu_least?)));
        let points = runs.filter(|p| p.0 > 0.0 && p.1 > 0.0).collect();
        Line { name: &m.name, look, points }
    };
    methods().map(line).filter(|line| !line.points.is_empty()).collect()
}

fn draw<B: DrawingBackend>(
    scene: &str,
    lines: &[Line<'_>],
    area: &DrawingArea<B, Shift>,
) -> Result<(), Fault<B>> {
    let (left, right) = area.split_horizontally(SIZE.0 - NAMES);
    let points = || lines.iter().flat_map(|line| &line.points);
    let powers = |range: core::ops::Range<f64>| {
        (10_f64.powf(range.start)..10_f64.powf(range.end)).log_scale()
    };
    let x = powers(range(points().map(|p| p.0.log10())));
    let y = powers(range(points().map(|p| p.1.log10())));
    let font = ("sans-serif", TEXT[0]).into_font();
    let mut chart = ChartBuilder::on(&left)
        .margin(10)
        .caption(format!("{scene}: work and precision"), ("sans-serif", TEXT[0] + 3))
        .x_label_area_size(TEXT[1])
        .y_label_area_size(TEXT[1] + 20)
        .build_cartesian_2d(x, y)?;
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .label_style(font.clone())
        .x_desc("error [-]")
        .y_desc("CPU time [s]")
        .x_label_formatter(&|x| number(*x))
        .y_label_formatter(&|y| number(*y))
        .draw()?;
    for (row, line) in lines.iter().enumerate() {
        let colour = COLOURS[line.look.integrator];
        let dashes = DASHES[line.look.formulation];
        let style = colour.stroke_width(2);
        if dashes[1] == 0 {
            chart.draw_series(LineSeries::new(line.points.iter().copied(), style))?;
        } else {
            chart.draw_series([Dashed::new(line.points.clone(), dashes, style)])?;
        }
        for point in &line.points {
            let (fill, edge) = mark(line.look, (0, 0));
            chart.draw_series([EmptyElement::at(*point) + fill + edge])?;
        }
        let y = ROW * (2 + i32::try_from(row).unwrap_or(0));
        let key = [(12, y), (40, y)];
        if dashes[1] == 0 {
            right.draw(&PathElement::new(key, style))?;
        } else {
            right.draw(&Dashed::new(key.to_vec(), dashes, style))?;
        }
        let (fill, edge) = mark(line.look, (26, y));
        right.draw(&fill)?;
        right.draw(&edge)?;
        right.draw(&Text::new(line.name.to_owned(), (48, y - 6), font.clone()))?;
    }
    Ok(())
}

type Corner = (i32, i32);

/// The mark of a line at a place: a filled polygon, and its edge.
fn mark(look: Look, (x, y): Corner) -> (Polygon<Corner>, PathElement<Corner>) {
    let colour = COLOURS[look.integrator];
    let corners = MARKS[look.integrator].iter().map(|(dx, dy)| (x + dx, y + dy));
    let corners: Vec<Corner> = corners.collect();
    let edge = corners.iter().chain(corners.first()).copied().collect::<Vec<_>>();
    let fill = if look.is_fixed { colour } else { WHITE };
    (Polygon::new(corners, fill.filled()), PathElement::new(edge, colour.stroke_width(1)))
}

//! Plots of a run: assignment of lines to panels, and their packed points.

use super::captions;
use super::decimate::{envelope, kept};
use super::motion::times_of;
use super::pack::{Column, Pack, ends};
use super::section::PlotFrame;
use mbs::core::outputs::in_radians;
use mbs::record::{ChannelSeries, DrawnForce, RunRecord};
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Largest number of lines of a panel [-]. There are no more distinct colours.
const MAX_LINES: usize = 6;
/// Largest ratio of two ranges in one panel [-]. If the ratio is larger, lines get separate panels, because the smaller line would look
/// flat.
const MAX_RATIO: f64 = 20.0;
/// A channel counts as constant if its range is below this fraction of the largest size among channels of its unit [-]. Such changes are
/// rounding errors.
const STILL: f64 = 1e-9;

/// Plots of a run in the form in which a pack contains them.
#[derive(Debug, Default)]
pub(super) struct Panels {
    panels: Vec<Panel>,
    /// Largest number of points of a line [-].
    most: usize,
    /// Times that several lines have in common, with their packed column.
    shared: Vec<(Vec<f64>, Column)>,
    /// Components of each channel in the panels, by the channel's name.
    parts: BTreeMap<String, Vec<Part>>,
}

/// Position of a channel's component: its panel and line; for a constant component its value instead.
#[derive(Debug, Clone, Copy, Serialize)]
#[serde(untagged)]
enum Part {
    Line(usize, usize),
    Still(f64),
}

#[derive(Debug, Serialize)]
struct Panel {
    #[serde(skip)]
    frame: PlotFrame,
    /// Name of the vector to which all lines of the panel belong.
    #[serde(skip)]
    owner: Option<String>,
    /// Range of the first line.
    #[serde(skip)]
    range: f64,
    title: String,
    unit: String,
    /// Name of the quantity on the horizontal axis, if it is not time.
    #[serde(skip_serializing_if = "String::is_empty")]
    across: String,
    log: bool,
    steps: bool,
    lines: Vec<Line>,
    /// Smallest and largest value of all runs at each time.
    #[serde(skip_serializing_if = "Option::is_none")]
    band: Option<Band>,
}

#[derive(Debug, Serialize)]
struct Band {
    t: Column,
    low: Column,
    high: Column,
}

#[derive(Debug, Serialize)]
struct Line {
    name: String,
    t: Column,
    #[serde(skip_serializing_if = "Option::is_none")]
    x: Option<Column>,
    y: Column,
}

/// Curve over time, or over another column.
#[derive(Debug, Clone, Copy)]
pub(super) struct Curve<'a> {
    pub(super) name: &'a str,
    pub(super) times: &'a [f64],
    /// Values on the horizontal axis, if they are not times.
    pub(super) across: Option<&'a [f64]>,
    pub(super) values: &'a [f64],
}

/// Rule for the choice of the points of a line that are drawn.
#[derive(Debug, Clone, Copy)]
enum Thinning {
    /// Peaks of both signs.
    Peaks,
    /// Upper envelope, for residuals. The minima of a residual between its peaks have no meaning.
    Edge,
}

impl Panels {
    /// Creates panels for lines of at most `most` points.
    pub(super) fn new(most: usize) -> Self {
        Self { most, ..Self::default() }
    }

    /// Returns the panels as JSON for the pack.
    pub(super) fn json(&self) -> Value {
        serde_json::to_value(&self.panels).unwrap_or_default()
    }

    fn line(
        &mut self,
        (name, thinning): (&str, Thinning),
        (times, values): (&[f64], &[f64]),
        pack: &mut Pack,
    ) -> Line {
        let n = times.len().min(values.len());
        let indices = match thinning {
            Thinning::Peaks => kept(&values[..n], self.most),
            Thinning::Edge => envelope(&values[..n]),
        };
        let t: Vec<f64> = indices.iter().map(|i| times[*i]).collect();
        let y: Vec<f64> = indices.iter().map(|i| values[*i]).collect();
        let column = match self.shared.iter().find(|(times, _)| *times == t) {
            Some((_, column)) => *column,
            None => {
                let column = times_of(&t, pack);
                self.shared.push((t, column));
                column
            }
        };
        Line { name: name.to_owned(), t: column, x: None, y: pack.ranged(&[y])[0] }
    }

    /// Adds a panel of curves; a logarithmic panel shows their magnitudes.
    pub(super) fn add_curves(
        &mut self,
        text: (&str, &str, String),
        curves: &[Curve<'_>],
        (is_log, across): (bool, &str),
        pack: &mut Pack,
    ) -> PlotFrame {
        let lines = curves.iter().map(|curve| {
            let sizes: Vec<f64>;
            let mut values = curve.values;
            if is_log {
                sizes = logarithms(&values.iter().map(|y| y.abs()).collect::<Vec<_>>());
                values = &sizes;
            }
            match curve.across {
                Some(across) => self.over((curve, across), values, pack),
                None => self.line((curve.name, Thinning::Peaks), (curve.times, values), pack),
            }
        });
        let lines = lines.collect();
        let panel = self.named(text, lines);
        panel.log = is_log;
        across.clone_into(&mut panel.across);
        panel.frame.clone()
    }

    /// Adds a band to a panel, given by times and the smallest and largest value at each time. Peaks of both edges are kept.
    pub(super) fn add_band(
        &mut self,
        frame: &PlotFrame,
        [times, low, high]: &[Vec<f64>; 3],
        pack: &mut Pack,
    ) {
        let indices = self.kept_of_both([low, high]);
        let of = |all: &[f64]| -> Vec<f64> { indices.iter().map(|i| all[*i]).collect() };
        let columns = pack.ranged(&[of(low), of(high)]);
        let t = times_of(&of(times), pack);
        self.panels[frame.panel].band = Some(Band { t, low: columns[0], high: columns[1] });
    }

    /// Returns the indices of the points at the peaks of either of two columns.
    fn kept_of_both(&self, columns: [&[f64]; 2]) -> Vec<usize> {
        let mut indices = columns.map(|column| kept(column, self.most / 2)).concat();
        indices.sort_unstable();
        indices.dedup();
        indices
    }

    /// Adds a line over another column. The points at the peaks of both columns are kept.
    fn over(&self, (curve, across): (&Curve<'_>, &[f64]), values: &[f64], pack: &mut Pack) -> Line {
        let indices = self.kept_of_both([across, values]);
        let of = |all: &[f64]| -> Vec<f64> { indices.iter().map(|i| all[*i]).collect() };
        let columns = pack.ranged(&[of(across), of(values)]);
        let t = times_of(&of(curve.times), pack);
        Line { name: curve.name.to_owned(), t, x: Some(columns[0]), y: columns[1] }
    }

    /// Adds plots of channels. A vector has a panel for each unit. Scalar channels with the same unit are drawn in one panel, unless their
    /// ranges differ too much. Returns the frames of the plots. Also returns the constant components, each with name, value and unit.
    pub(super) fn add_channels(
        &mut self,
        channels: &[ChannelSeries],
        pack: &mut Pack,
    ) -> (Vec<PlotFrame>, Vec<Vec<String>>) {
        let first = self.panels.len();
        let mut still = Vec::new();
        let sizes = sizes(channels);
        for series in channels {
            let channel = &series.channel;
            let owner = (channel.components.len() > 1).then(|| channel.name.clone());
            let columns = channel.components.iter().zip(channel.columns()).zip(&series.values);
            for ((component, column), values) in columns {
                let range = extent(values).0;
                let (unit, n) = in_radians(&component.unit);
                let size = sizes.get(unit).map_or(0.0, |size| size * n);
                if range <= STILL * size && values.len() > 1 && range.is_finite() {
                    let value = mbs_scene::format::significant(values[0]);
                    still.push(vec![column, format!("{value} {}", component.unit)]);
                    self.part(&channel.name, Part::Still(values[0]));
                    continue;
                }
                let line = self.line((&column, Thinning::Peaks), (&series.times, values), pack);
                let open = self.panels[first..].iter().position(|panel| {
                    panel.owner == owner
                        && panel.unit == component.unit
                        && panel.lines.len() < MAX_LINES
                        && (range.max(panel.range) <= MAX_RATIO * range.min(panel.range))
                });
                let at = match open {
                    Some(i) => first + i,
                    None => {
                        self.push((&component.unit, owner.clone(), range), Vec::new());
                        self.panels.len() - 1
                    }
                };
                self.panels[at].lines.push(line);
                self.part(&channel.name, Part::Line(at, self.panels[at].lines.len() - 1));
            }
        }
        for panel in &mut self.panels[first..] {
            let names: Vec<&str> = panel.lines.iter().map(|line| line.name.as_str()).collect();
            panel.frame.caption = captions::channel(&names, &panel.unit);
            let is_whole = |owner: &&String| names.len() > 1 && !owner.is_empty();
            let title = panel.owner.as_ref().filter(is_whole).cloned();
            panel.title = title.unwrap_or_else(|| names.join(", "));
            panel.frame.title.clone_from(&panel.title);
        }
        (self.frames(first), still)
    }

    fn part(&mut self, channel: &str, part: Part) {
        self.parts.entry(channel.to_owned()).or_default().push(part);
    }

    /// Returns the drawn forces and moments that have channels, with their points and with the lines of their components.
    pub(super) fn forces(&self, places: &[DrawnForce]) -> Vec<Value> {
        let force = |at: &DrawnForce| {
            let DrawnForce { point, axes } = at;
            let parts = self.parts.get(&point.name).filter(|parts| parts.len() >= 3)?;
            Some(json!({ "name": point.name, "place": point.place, "parts": parts, "axes": axes }))
        };
        places.iter().filter_map(force).collect()
    }

    fn push(&mut self, (unit, owner, range): (&str, Option<String>, f64), lines: Vec<Line>) {
        let frame =
            PlotFrame { panel: self.panels.len(), unit: unit.to_owned(), ..PlotFrame::default() };
        let (title, unit) = (String::new(), unit.to_owned());
        self.panels.push(Panel {
            frame,
            owner,
            range,
            title,
            unit,
            across: String::new(),
            log: false,
            steps: false,
            lines,
            band: None,
        });
    }

    fn frames(&self, first: usize) -> Vec<PlotFrame> {
        self.panels[first..].iter().map(|panel| panel.frame.clone()).collect()
    }

    fn named(
        &mut self,
        (title, unit, caption): (&str, &str, String),
        lines: Vec<Line>,
    ) -> &mut Panel {
        let at = self.panels.len();
        self.push((unit, None, 0.0), lines);
        let panel = &mut self.panels[at];
        title.clone_into(&mut panel.title);
        title.clone_into(&mut panel.frame.title);
        panel.frame.caption = caption;
        panel
    }

    /// Adds the plots of a run's health: energy error, violation, iterations, steps.
    pub(super) fn add_health(&mut self, record: &RunRecord, pack: &mut Pack) -> Vec<PlotFrame> {
        let first = self.panels.len();
        let peaks = |name| (name, Thinning::Peaks);
        let edge = |name| (name, Thinning::Edge);
        if let Some(energy) = &record.energy {
            let t = &energy.times;
            let error = self.line(peaks("Pi(t) - Pi(0)"), (t, &energy.invariant_error), pack);
            self.named(("energy error", "J", captions::energy_error(energy)), vec![error]);
            let kinetic = self.line(peaks("T"), (t, &energy.kinetic), pack);
            let potential = self.line(peaks("V"), (t, &energy.potential), pack);
            self.named(("energies", "J", captions::energies()), vec![kinetic, potential]);
        }
        if let Some(violation) = &record.violation {
            let levels = [
                ("position", &violation.position),
                ("velocity", &violation.velocity),
                ("acceleration", &violation.acceleration),
            ];
            let lines = levels.map(|(name, values)| {
                self.line(edge(name), (&violation.times, &logarithms(values)), pack)
            });
            let caption = captions::violation(violation);
            let text = ("constraint violation", "m, m/s, m/s^2 (rad, ...)", caption);
            self.named(text, lines.into()).log = true;
        }
        if let Some(iterations) = &record.iterations {
            let counts: Vec<f64> = iterations.counts.iter().map(|n| f64::from(*n)).collect();
            let line = self.line(edge("iterations"), (&iterations.times, &counts), pack);
            let caption = captions::iterations(iterations);
            self.named(("Newton iterations", "per step", caption), vec![line]).steps = true;
        }
        if let Some(steps) = &record.steps {
            let lengths: Vec<f64> = steps.rows.iter().map(|row| row.length).collect();
            let line = self.line(peaks("step"), (&steps.times, &logarithms(&lengths)), pack);
            let panel = self.named(("step size", "s", captions::steps(steps)), vec![line]);
            (panel.log, panel.steps) = (true, true);
        }
        self.frames(first)
    }
}

/// Returns the exponents of ten for a logarithmic axis, so that values are packed evenly over the decades. A value of zero or less is a gap.
fn logarithms(values: &[f64]) -> Vec<f64> {
    values.iter().map(|x| if *x > 0.0 { x.log10() } else { f64::NAN }).collect()
}

/// Returns the range of the finite values and the largest absolute value. Returns infinity and zero if no value is finite.
fn extent(values: &[f64]) -> (f64, f64) {
    let of = |[low, high]: [f64; 2]| (high - low, low.abs().max(high.abs()));
    ends(values).map_or((f64::INFINITY, 0.0), of)
}

/// Returns the largest absolute value among the channels of each unit, with degrees converted to radians. For angles it is at least one
/// radian, so that rounding errors count as constant.
fn sizes(channels: &[ChannelSeries]) -> BTreeMap<&str, f64> {
    let mut sizes = BTreeMap::new();
    for series in channels {
        for (component, values) in series.channel.components.iter().zip(&series.values) {
            let (_, size) = extent(values);
            let (unit, n) = in_radians(&component.unit);
            let least = if unit == "rad" { 1.0 } else { 0.0_f64 };
            let largest = sizes.entry(unit).or_insert(least);
            *largest = largest.max(size / n);
        }
    }
    sizes
}

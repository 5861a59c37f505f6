//! Differences between the outputs of two runs.

use crate::record::{Channel, OutputChange};
use crate::run::Outcome;
use mbs_core::cluster::scene_length;
use mbs_core::once::found;
use mbs_core::outputs::in_radians;
use mbs_core::scene::Scene;
use mbs_core::{Real, instances};

/// Largest change of an output that counts as rounding error or iteration error, relative to the largest value among outputs of the same
/// unit [-]. Chosen, not tuned.
const ROUNDING: f64 = 1e-9;

/// The output ranges of the run with all effects, to which changes are compared.
#[derive(Debug)]
pub struct OutputRanges<'a> {
    run: &'a Outcome,
    parts: Vec<Part>,
}

/// Components of a channel that have the same unit.
#[derive(Debug)]
struct Part {
    channel: String,
    unit: String,
    columns: Vec<usize>,
    /// Largest range of a component; the range is the maximum minus the minimum over the run.
    range: f64,
    /// Largest change that counts as rounding error.
    floor: f64,
}

type New<T> = for<'a> fn(&Scene<T>, &'a Outcome) -> OutputRanges<'a>;
instances!(NEW: New<T> = ranges::<T>, {});

fn ranges<'a, T: Real>(scene: &Scene<T>, run: &'a Outcome) -> OutputRanges<'a> {
    OutputRanges::of(scene, run)
}

impl<'a> OutputRanges<'a> {
    /// Computes the ranges of the outputs of a run.
    pub fn new<T: Real>(scene: &Scene<T>, run: &'a Outcome) -> Self {
        if T::HAS_INSTANCES {
            return found::<New<T>>(NEW)(scene, run);
        }
        Self::of(scene, run)
    }

    fn of<T: Real>(scene: &Scene<T>, run: &'a Outcome) -> Self {
        let mut parts: Vec<Part> = Vec::new();
        let mut column = 0;
        for channel in &Channel::of_scene(scene) {
            let first = parts.len();
            for component in &channel.components {
                match parts[first..].iter_mut().find(|part| part.unit == component.unit) {
                    Some(part) => part.columns.push(column),
                    None => parts.push(Part {
                        channel: channel.name.clone(),
                        unit: component.unit.clone(),
                        columns: vec![column],
                        range: 0.0,
                        floor: 0.0,
                    }),
                }
                column += 1;
            }
        }
        let mut outputs = Self { run, parts };
        outputs.measure(scene_length(scene).to_f64());
        outputs
    }

    /// Computes for each part its range, and the largest change that counts as rounding error. That change is relative to the largest value
    /// with the same unit, which is at least the scene's length for m, and at least 1 for rad.
    fn measure(&mut self, length: f64) {
        let rows = self.run.rows();
        let extremes = |part: &Part| {
            let mut largest = [0.0_f64; 2];
            for &c in &part.columns {
                let values = || rows.iter().map(|(_, row)| row[c]);
                let [low, high] = [
                    values().fold(f64::INFINITY, f64::min),
                    values().fold(f64::NEG_INFINITY, f64::max),
                ];
                largest = [largest[0].max(high - low), largest[1].max(high.abs()).max(low.abs())];
            }
            largest
        };
        let found: Vec<[f64; 2]> = self.parts.iter().map(extremes).collect();
        // Degrees are converted to radians, so that both count as one unit.
        let of_unit = |(part, [_, size]): (&Part, &[f64; 2])| {
            let (unit, n) = in_radians(&part.unit);
            (unit.to_owned(), size / n)
        };
        let sizes: Vec<(String, f64)> = self.parts.iter().zip(&found).map(of_unit).collect();
        for (part, [range, _]) in self.parts.iter_mut().zip(&found) {
            let (unit, n) = in_radians(&part.unit);
            let same = sizes.iter().filter(|(other, _)| other == unit);
            let least = match unit {
                "m" => length,
                "rad" => 1.0,
                _ => 0.0,
            };
            part.range = *range;
            part.floor = ROUNDING * (n * same.map(|(_, size)| *size).fold(least, f64::max));
        }
    }

    /// Returns the largest difference of each output between the two runs. Rows are compared from the start, as long as their times agree.
    pub fn changes(&self, other: &Outcome) -> Vec<OutputChange> {
        let pairs = || {
            let pairs = self.run.rows().iter().zip(other.rows());
            pairs.take_while(|(a, b)| a.0.total_cmp(&b.0).is_eq())
        };
        let change = |part: &Part| {
            let mut largest = 0.0;
            for ((_, a), (_, b)) in pairs() {
                largest = part.columns.iter().fold(largest, |x, &c| larger(x, (a[c] - b[c]).abs()));
            }
            OutputChange {
                output: part.channel.clone(),
                unit: part.unit.clone(),
                largest,
                range: part.range,
                relative: (part.range > part.floor).then(|| largest / part.range),
                is_rounding: largest <= part.floor,
            }
        };
        self.parts.iter().map(change).collect()
    }
}

/// The larger of two numbers; NaN if one of them is NaN.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

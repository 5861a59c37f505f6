//! Scales of outputs, and distances from a reference relative to them.

use super::data::OutputScale;
use mbs::record::Channel;
use mbs_core::outputs::in_radians;

/// Smallest scale of an output, relative to the largest range of its unit [-]. Chosen, not tuned.
pub const FLOOR: f64 = 1e-3;

/// Computes the scales of all channels. Components of a channel with the same unit have one scale: their largest range over the reference. It
/// is at least a thousandth of the largest range of all outputs of that unit. For lengths it is also at least a thousandth of the scene's
/// length [m]. For angles it is at least a thousandth of a radian. Outputs of the run itself, such as its energy error, have no scale and are
/// not compared.
#[must_use]
pub fn output_scales(channels: &[Channel], rows: &[Vec<f64>], length: f64) -> Vec<OutputScale> {
    let mut scales: Vec<OutputScale> = Vec::new();
    let mut column = 0;
    for channel in channels {
        let first = scales.len();
        for component in &channel.components {
            let range = range(rows, column);
            match scales[first..].iter_mut().find(|scale| scale.unit == component.unit) {
                Some(scale) => {
                    scale.columns.push(column);
                    scale.range = scale.range.max(range);
                }
                None => scales.push(OutputScale {
                    output: channel.name.clone(),
                    unit: component.unit.clone(),
                    scale: None,
                    range,
                    columns: vec![column],
                }),
            }
            column += 1;
        }
    }
    let is_of_run = |scale: &OutputScale| {
        channels.iter().any(|channel| channel.name == scale.output && channel.is_of_run())
    };
    let judged = scales.iter().filter(|scale| !is_of_run(scale));
    // degrees are converted to radians
    let of_unit = |scale: &OutputScale| {
        let (unit, n) = in_radians(&scale.unit);
        (unit.to_owned(), scale.range / n)
    };
    let ranges: Vec<(String, f64)> = judged.map(of_unit).collect();
    for scale in scales.iter_mut().filter(|scale| !is_of_run(scale)) {
        let (unit, n) = in_radians(&scale.unit);
        let least = match unit {
            "m" => length,
            "rad" => 1.0,
            _ => 0.0,
        };
        let same = ranges.iter().filter(|(other, _)| other == unit);
        let largest = same.fold(least, |most, (_, range)| most.max(*range));
        let size = scale.range.max(FLOOR * (largest * n));
        scale.scale = (size > 0.0 && size.is_finite()).then_some(size);
    }
    scales
}

fn range(rows: &[Vec<f64>], column: usize) -> f64 {
    let values = || rows.iter().filter_map(|row| row.get(column).copied());
    let low = values().fold(f64::INFINITY, f64::min);
    let high = values().fold(f64::NEG_INFINITY, f64::max);
    if low <= high { high - low } else { 0.0 }
}

/// Largest distance and root mean square distance of two rows, relative to the scales. NaN if a component is NaN.
#[must_use]
pub fn row_distance(scales: &[OutputScale], a: &[f64], b: &[f64]) -> [f64; 2] {
    let (mut largest, mut squares, mut n) = (0.0_f64, 0.0, 0.0);
    for scale in scales {
        let Some(size) = scale.scale else { continue };
        for &c in &scale.columns {
            let (Some(x), Some(y)) = (a.get(c), b.get(c)) else { continue };
            let d = (x - y).abs() / size;
            largest = if d.is_nan() { d } else { largest.max(d) };
            squares += d * d;
            n += 1.0;
            if largest.is_nan() {
                return [f64::NAN; 2];
            }
        }
    }
    [largest, if n > 0.0 { libm::sqrt(squares / n) } else { 0.0 }]
}

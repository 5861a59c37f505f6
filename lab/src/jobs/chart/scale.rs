//! Scale of an axis: positions of numbers along the axis, and the numbers that are written.

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use std::ops::Range;

/// Margin beyond the outermost numbers, relative to the range [-].
const MARGIN: f64 = 0.04;

/// Spacing of numbers on an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    /// Linear spacing over the range of the numbers.
    Linear,
    /// Linear spacing over a range that includes zero.
    FromZero,
    /// Logarithmic spacing; numbers that are not positive are left out.
    Log,
}

/// An axis over a range of numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scale {
    is_log: bool,
    /// Ends of the range; for a logarithmic scale, logarithms of these.
    ends: [f64; 2],
}

impl Scale {
    /// The scale that shows all these numbers; `None` without numbers.
    pub(crate) fn over(kind: Kind, numbers: impl Iterator<Item = f64>) -> Option<Self> {
        let is_log = kind == Kind::Log;
        let zero = (kind == Kind::FromZero).then_some(0.0);
        let numbers = numbers.map(|x| if is_log { x.log10() } else { x }).chain(zero);
        let [low, high] =
            numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)]);
        if low > high {
            return None;
        }
        // a single number is in the middle
        let least = if is_log { 0.3 } else { 1e-12_f64.max(1e-6 * low.abs()) };
        let span = (high - low).max(least);
        let middle = 0.5 * (low + high);
        let half = (0.5 + MARGIN) * span;
        Some(Self { is_log, ends: [middle - half, middle + half] })
    }

    /// Position of a number as a fraction of the axis.
    pub(crate) fn share(&self, x: f64) -> f64 {
        let x = if self.is_log { x.log10() } else { x };
        (x - self.ends[0]) / (self.ends[1] - self.ends[0])
    }

    /// Returns the lowest number of the axis.
    pub(crate) fn low(&self) -> f64 {
        self.number(self.ends[0])
    }

    /// Returns the highest number of the axis.
    pub(crate) fn high(&self) -> f64 {
        self.number(self.ends[1])
    }

    fn number(&self, x: f64) -> f64 {
        if self.is_log { 10_f64.powf(x) } else { x }
    }

    /// Numbers that are written at the axis, `n` at most.
    fn ticks(&self, n: usize) -> Vec<f64> {
        let [low, high] = self.ends;
        let n = count(n.max(2));
        // over a decade or two, 1, 2 and 5 times the powers of ten are written
        if self.is_log && 3.0 * (high - low) <= n {
            let decades = multiples(low - 1.0, high, 1.0).into_iter();
            let ticks = decades.flat_map(|k| [1.0, 2.0, 5.0].map(|m| m * 10_f64.powf(k)));
            return ticks.filter(|&x| low <= x.log10() && x.log10() <= high).collect();
        }
        let rough = (high - low) / n;
        let unit = 10_f64.powf(rough.log10().floor());
        let nice = [1.0, 2.0, 5.0, 10.0].map(|m| m * unit);
        let step = nice.into_iter().find(|step| *step >= rough).unwrap_or(rough);
        let step = if self.is_log { step.max(1.0) } else { step };
        multiples(low, high, step).into_iter().map(|x| self.number(x)).collect()
    }
}

/// Converts a count to a floating-point number.
fn count(n: usize) -> f64 {
    f64::from(u32::try_from(n).unwrap_or(u32::MAX))
}

/// The multiples of a step within a range.
fn multiples(low: f64, high: f64, step: f64) -> Vec<f64> {
    let first = (low / step).ceil();
    (0..).map(|i| (first + f64::from(i)) * step).take_while(|x| *x <= high + 1e-9 * step).collect()
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let place = f64::from(limit.1 - limit.0) * self.share(*value);
        // the conversion is safe: drawings are only some hundred pixels wide
        #[allow(clippy::cast_possible_truncation, reason = "a place within the drawing")]
        let place = place.round() as i32;
        limit.0 + place
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        let light = hint.weight().allow_light_points();
        if light { Vec::new() } else { self.ticks(hint.max_num_points()) }
    }

    fn range(&self) -> Range<f64> {
        self.low()..self.high()
    }
}

impl ValueFormatter<f64> for Scale {
    fn format_ext(&self, value: &f64) -> String {
        let most = if self.is_log { *value } else { self.ends[0].abs().max(self.ends[1].abs()) };
        if !(1e-2..1e4).contains(&most) {
            // a number that differs from zero only by rounding is written as zero
            let x = if value.abs() < 1e-9 * most { 0.0 } else { *value };
            let text = format!("{x:.2e}");
            let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
            let digits = digits.trim_end_matches('0').trim_end_matches('.');
            return if digits == "0" { "0".into() } else { format!("{digits}e{exponent}") };
        }
        let text = format!("{:.4}", if value.abs() < 1e-9 { 0.0 } else { *value });
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(kind: Kind, numbers: &[f64], n: usize) -> Vec<String> {
        let scale = Scale::over(kind, numbers.iter().copied()).unwrap();
        scale.ticks(n).iter().map(|x| scale.format_ext(x)).collect()
    }

    #[test]
    fn round_numbers_are_written() {
        assert_eq!(written(Kind::Linear, &[0.0, 6.0], 8), ["0", "1", "2", "3", "4", "5", "6"]);
        assert_eq!(
            written(Kind::Linear, &[0.35, 0.44], 5),
            ["0.36", "0.38", "0.4", "0.42", "0.44"]
        );
        assert_eq!(written(Kind::FromZero, &[2e-4], 5), ["0", "5e-5", "1e-4", "1.5e-4", "2e-4"]);
        assert_eq!(
            written(Kind::Log, &[1e-9, 1e-3], 8),
            ["1e-9", "1e-8", "1e-7", "1e-6", "1e-5", "1e-4", "1e-3"]
        );
        assert_eq!(written(Kind::Log, &[1e-9, 1e-3], 4), ["1e-8", "1e-6", "1e-4"]);
        assert_eq!(written(Kind::Log, &[0.03, 0.3], 6), ["0.05", "0.1", "0.2"]);
    }

    #[test]
    fn one_number_alone_has_room() {
        let scale = Scale::over(Kind::Log, [1e-3].into_iter()).unwrap();
        assert!((scale.share(1e-3) - 0.5).abs() < 1e-12);
        assert!(scale.low() < 1e-3 && scale.high() > 1e-3);
        assert_eq!(Scale::over(Kind::Linear, [].into_iter()), None);
    }
}

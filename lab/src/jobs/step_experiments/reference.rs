//! References for the value of a channel at the end of a run.

use crate::format::error;
use crate::lab::case::{Case, Rule};
use crate::lab::{Lab, Run};
use crate::mbs::outcome::Figures;

/// A channel whose value at the end of a run is compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Watched {
    /// Scene of the channel, by its file.
    pub(crate) scene: &'static str,
    /// Name of the channel; all channels if it is empty.
    pub(crate) channel: &'static str,
    /// Unit of the channel.
    pub(crate) unit: &'static str,
    /// Time at which the value is compared [s]; `None` for the scene's end.
    pub(crate) time: Option<f64>,
    /// Value of the channel with all digits, if it is published.
    pub(crate) digits: &'static [f64],
}

/// Reference value of a channel, with its source and its uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Reference {
    /// Value at the watched time.
    pub(crate) value: Vec<f64>,
    /// Uncertainty of the value.
    pub(crate) doubt: f64,
    /// Source of the value, in words.
    pub(crate) source: String,
}

/// Tolerances of two runs of the explicit method; the second gives the value.
const EXPLICIT: [[&str; 4]; 2] = [
    ["--integrator", "rk54", "--tolerance", "1e-12"],
    ["--integrator", "rk54", "--tolerance", "1e-13"],
];
/// First and largest step of the explicit method [s].
const LONGEST: f64 = 1e-3;
/// Two fixed steps of index 3; the second is half of the first [s].
const FINEST: [f64; 2] = [1e-4, 5e-5];
/// Relative rounding error of a number [-].
const ROUNDING: f64 = 1e-15;

impl Watched {
    /// Value of the channel in a completed run.
    fn value(&self, figures: &Figures) -> Option<Vec<f64>> {
        if self.channel.is_empty() {
            return Some(figures.outputs.values().flatten().copied().collect());
        }
        figures.outputs.get(self.channel).cloned()
    }

    /// Returns the label of the error.
    pub(crate) fn label(&self) -> String {
        let channel = if self.channel.is_empty() { "all channels" } else { self.channel };
        format!("error of {channel} [{}]", self.unit)
    }

    /// Finds the reference: published digits, an independent formulation and integrator, or extrapolation of fixed steps, in this order.
    ///
    /// # Errors
    ///
    /// The reason why the runs cannot be made.
    pub(crate) fn reference(&self, lab: &Lab<'_>) -> Result<Option<Reference>, String> {
        if !self.digits.is_empty() {
            let (value, source) = (self.digits.to_vec(), "printed with all digits".to_owned());
            let doubt = ROUNDING * norm(&value);
            return Ok(Some(Reference { value, doubt, source }));
        }
        let explicit = EXPLICIT.each_ref().map(|arguments| Case {
            arguments,
            ..Case::fixed(self.scene, "recursive", LONGEST).lasting(self.time)
        });
        if let Some([a, b]) = self.pair(lab, &explicit)? {
            let doubt = distance(&a, &b).max(ROUNDING * norm(&b));
            let source = "recursive, explicit Runge-Kutta at 1e-13".to_owned();
            return Ok(Some(Reference { value: b, doubt, source }));
        }
        let fixed = FINEST.map(|step| Case::fixed(self.scene, "index-3", step).lasting(self.time));
        let Some([a, b]) = self.pair(lab, &fixed)? else { return Ok(None) };
        let value: Vec<_> = a.iter().zip(&b).map(|(a, b)| (4.0 * b - a) / 3.0).collect();
        let doubt = distance(&value, &b);
        let source = format!("index 3 at {:e} and {:e} s, extrapolated", FINEST[0], FINEST[1]);
        Ok(Some(Reference { value, doubt, source }))
    }

    /// The values of two runs, if both are completed.
    fn pair(&self, lab: &Lab<'_>, cases: &[Case; 2]) -> Result<Option<[Vec<f64>; 2]>, String> {
        let runs = lab.measure(cases, 1)?;
        let value = |run: &Run| run.figures().and_then(|figures| self.value(figures));
        Ok(value(&runs[0]).zip(value(&runs[1])).map(<[_; 2]>::from))
    }

    /// Runs cases, and computes their true errors.
    ///
    /// # Errors
    ///
    /// The reason why a case cannot be run.
    pub(crate) fn measure(
        &self,
        lab: &Lab<'_>,
        reference: &Reference,
        cases: &[Case],
        repeats: u32,
    ) -> Result<Vec<Run>, String> {
        let mut runs = lab.measure(cases, repeats)?;
        for run in &mut runs {
            let value = run.figures().and_then(|figures| self.value(figures));
            run.true_error = value.map(|value| distance(&value, &reference.value));
        }
        Ok(runs)
    }

    /// A run in index 3 until the time of comparison.
    pub(crate) fn case(&self, rule: Rule, steps: [f64; 2]) -> Case {
        Case::variable(self.scene, "index-3", rule, steps).lasting(self.time)
    }
}

impl Reference {
    /// Sentence on the source of the value and its uncertainty.
    pub(crate) fn sentence(&self, watched: &Watched) -> String {
        let when = watched.time.map_or("the end".to_owned(), |t| format!("{t} s"));
        let channel = if watched.channel.is_empty() { "all channels" } else { watched.channel };
        format!(
            "The true error is the distance of {channel} at {when} from its reference ({}), which is known to {} {}.",
            self.source,
            error(self.doubt),
            watched.unit
        )
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Distance of two values; NaN if their lengths differ.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let apart: Vec<_> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    if a.len() == b.len() { norm(&apart) } else { f64::NAN }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::fake;

    const TIP: Watched = Watched {
        scene: "double-pendulum",
        channel: "tip",
        unit: "m",
        time: Some(3.0),
        digits: &[1.0, -2.0],
    };

    #[test]
    fn printed_digits_come_before_runs() {
        fake::with_lab(|lab| {
            let printed = TIP.reference(lab).unwrap().unwrap();
            assert_eq!(
                (printed.value.as_slice(), printed.source.as_str()),
                (TIP.digits, "printed with all digits")
            );
            let run = Watched { digits: &[], ..TIP }.reference(lab).unwrap().unwrap();
            assert!(run.source.contains("Runge-Kutta") && run.doubt < 1e-10, "{run:?}");
            // the made-up vehicle cannot run in relative coordinates
            let stairs = Watched { scene: "iltis-stairs", channel: "nose", digits: &[], ..TIP };
            let extrapolated = stairs.reference(lab).unwrap().unwrap();
            assert!(extrapolated.source.contains("extrapolated"));
            assert!(extrapolated.sentence(&stairs).contains("nose at 3 s"));
        });
    }

    #[test]
    fn distances_need_equal_lengths() {
        assert!((distance(&[3.0, 0.0], &[0.0, 4.0]) - 5.0).abs() < 1e-15);
        assert!(distance(&[1.0], &[1.0, 2.0]).is_nan());
    }
}

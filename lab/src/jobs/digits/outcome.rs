//! Outcome of a run, from the line of the program.

use crate::format::error;
use serde_json::Value;

/// A run: its figures, or the reason why there are none.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Run {
    /// Figures of a run that was completed, or that stopped: figures of the steps that it made.
    Made(Figures),
    /// Reason why a run could not be made, or took too long.
    None(String),
}

/// Figures of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Figures {
    /// Largest energy error, and largest kinetic energy [J].
    pub(super) energy_error: f64,
    pub(super) turned_over: f64,
    /// Largest residual of positions, velocities and accelerations.
    pub(super) violation: [f64; 3],
    pub(super) steps: f64,
    /// Iterations per step, and wall-clock time per step [s].
    pub(super) iterations: f64,
    pub(super) seconds: f64,
    /// Number of corrections per refined solution.
    pub(super) corrections: Option<f64>,
    /// Time [s] and reason of a stop.
    pub(super) stopped: Option<(f64, String)>,
}

impl Run {
    /// Reads the outcome from the lines of the program.
    pub(super) fn read(lines: Result<Vec<Value>, String>) -> Self {
        let line = match lines.as_deref() {
            Ok([line]) => line,
            Ok(lines) => return Self::None(format!("{} lines came back", lines.len())),
            Err(why) => return Self::None(why.clone()),
        };
        // JSON has no NaN: a missing number stands for it
        let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
        let stopped =
            line["reason"].as_str().map(|why| (number(&line["stopped_at"]), why.to_owned()));
        Self::Made(Figures {
            energy_error: number(&line["energy_error"]),
            turned_over: number(&line["turned_over"]),
            violation: [0, 1, 2].map(|level| number(&line["violation"][level])),
            steps: number(&line["steps"]),
            iterations: number(&line["iterations"]),
            seconds: number(&line["seconds"]),
            corrections: line["corrections"].as_f64(),
            stopped,
        })
    }

    /// Figures of a completed run.
    pub(super) fn completed(&self) -> Option<&Figures> {
        match self {
            Self::Made(figures) if figures.stopped.is_none() => Some(figures),
            _ => None,
        }
    }

    /// Writes the energy error of the run [J], or the time at which it stopped.
    pub(super) fn text(&self) -> String {
        match self {
            Self::Made(Figures { steps, .. }) if self.completed().is_none() && *steps < 1.0 => {
                "no step".to_owned()
            }
            Self::Made(Figures { stopped: Some((t, _)), .. }) if *t < 0.01 => {
                format!("stops at {t:.0e} s")
            }
            Self::Made(Figures { stopped: Some((t, _)), .. }) => format!("stops at {t:.2} s"),
            Self::Made(figures) => error(figures.energy_error),
            Self::None(_) => "not run".to_owned(),
        }
    }

    /// Reason why the run has no error.
    pub(super) fn reason(&self) -> String {
        match self {
            Self::Made(figures) => {
                figures.stopped.as_ref().map(|s| s.1.clone()).unwrap_or_default()
            }
            Self::None(why) => why.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_line_is_read_with_its_failure_and_what_is_no_number_stays_none() {
        let line = json!({
            "energy_error": null, "turned_over": 19.0, "violation": [1e-9, 1e-8, 1e-7], "steps": 594, "iterations": 19.9,
            "seconds": 3e-5, "stopped_at": 0.594, "reason": "no convergence",
        });
        let run = Run::read(Ok(vec![line.clone()]));
        assert_eq!((run.text(), run.reason()), ("stops at 0.59 s".into(), "no convergence".into()));
        let Run::Made(figures) = run else { panic!("it has figures") };
        assert!(figures.energy_error.is_nan() && figures.corrections.is_none());
        assert_eq!(Run::read(Err("took too long".into())).text(), "not run");
        assert_eq!(Run::read(Ok(vec![line.clone(), line])).reason(), "2 lines came back");
    }
}

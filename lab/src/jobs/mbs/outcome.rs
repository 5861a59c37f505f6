//! Outcome of a run of `mbs run --json`, read from its output.

use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Outcome of a run.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Outcome {
    /// The run was completed.
    Completed(Figures),
    /// The run stopped with a typed error.
    Stopped {
        /// The code of the error.
        code: String,
        /// Message of the error.
        message: String,
        /// Time of the stop [s].
        time: f64,
    },
    /// The run was refused, since the formulation cannot run this scene or an option does not exist; with the reason.
    Refused(String),
    /// The build lacks the formulation.
    NotBuilt,
    /// The run was ended after this many seconds.
    TooLong(f64),
}

impl Outcome {
    /// True if the run made steps, so that it has rows.
    pub(crate) fn has_run(&self) -> bool {
        matches!(self, Self::Completed(_) | Self::Stopped { .. })
    }

    /// The figures of a completed run.
    pub(crate) fn figures(&self) -> Option<&Figures> {
        if let Self::Completed(figures) = self { Some(figures) } else { None }
    }

    /// Reason why there are no figures; empty for a completed run.
    pub(crate) fn reason(&self) -> String {
        match self {
            Self::Completed(_) => String::new(),
            Self::Stopped { code, message, time } => {
                format!("{code} at {} s: {message}", (time * 1e6).round() / 1e6)
            }
            Self::Refused(why) => format!("refused: {why}"),
            Self::NotBuilt => "not built".to_owned(),
            Self::TooLong(limit) => format!("took more than {limit} s"),
        }
    }
}

/// The figures of a completed run.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Figures {
    /// Largest error of the energy balance [J].
    pub(crate) energy_error: f64,
    /// Largest kinetic energy plus gross work [J].
    pub(crate) turned_over: f64,
    /// CPU time of the stepping [s].
    pub(crate) seconds: f64,
    /// Coordinates, constraints and freedoms.
    pub(crate) sizes: [u64; 3],
    /// Steps, iterations and factorisations.
    pub(crate) work: [u64; 3],
    /// Work of step control, if the steps were controlled.
    pub(crate) control: Option<Control>,
    /// Values of the channels at the end.
    pub(crate) outputs: BTreeMap<String, Vec<f64>>,
}

/// Work of step control.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Control {
    /// Number of rejected steps.
    pub(crate) rejected: u64,
    /// Smallest and largest step [s].
    pub(crate) steps: [f64; 2],
    /// Number of changes of the index.
    pub(crate) index_changes: u64,
    /// Number of steps in index 1.
    pub(crate) index_1_steps: u64,
    /// Number of steps that ended at an event.
    pub(crate) events: u64,
}

impl Figures {
    /// The energy error relative to the exchanged energy.
    pub(crate) fn share(&self) -> f64 {
        self.energy_error / self.turned_over
    }

    /// Distance of a channel's value at the end from its reference.
    ///
    /// # Errors
    ///
    /// The channel does not exist, or has another number of components.
    pub(crate) fn distance(&self, channel: &str, reference: &[f64]) -> Result<f64, String> {
        let value = self.outputs.get(channel).filter(|value| value.len() == reference.len());
        let value = value.ok_or_else(|| format!("no channel `{channel}`"))?;
        let squares = value.iter().zip(reference).map(|(x, y)| (x - y) * (x - y));
        Ok(squares.sum::<f64>().sqrt())
    }
}

/// Reads the outcome from a run's exit status, standard output and standard error.
///
/// # Errors
///
/// The missing value, if the output is not that of `mbs run --json`.
pub(crate) fn read(status: Option<i32>, stdout: &[u8], stderr: &[u8]) -> Result<Outcome, String> {
    if status == Some(1) || (status == Some(2) && stdout.is_empty()) {
        let text = String::from_utf8_lossy(stderr);
        let line =
            text.lines().find(|line| !line.trim().is_empty()).unwrap_or("no reason is given");
        let is_built = !line.contains("is not built");
        let why = line.trim_start_matches("error: ").to_owned();
        return Ok(if is_built { Outcome::Refused(why) } else { Outcome::NotBuilt });
    }
    let json: Value = serde_json::from_slice(stdout)
        .map_err(|e| format!("no JSON came with exit status {status:?}: {e}"))?;
    if json["completed"].as_bool() == Some(true) {
        completed(&json).map(Outcome::Completed)
    } else {
        stopped(&json["error"])
    }
}

/// The number at a path in the output.
fn number(json: &Value, place: &str) -> Result<f64, String> {
    let value = json.pointer(place).and_then(Value::as_f64);
    value.ok_or_else(|| format!("the output has no number at {place}"))
}

/// The count with a name in the output.
fn count(json: &Value, name: &str) -> Result<u64, String> {
    json[name].as_u64().ok_or_else(|| format!("the output has no count {name}"))
}

/// The text with a name in the output.
fn text(json: &Value, name: &str) -> Result<String, String> {
    let value = json[name].as_str().map(str::to_owned);
    value.ok_or_else(|| format!("the error has no {name}"))
}

fn completed(json: &Value) -> Result<Figures, String> {
    let control = json.get("control").filter(|control| control.is_object());
    Ok(Figures {
        energy_error: number(json, "/energy/max_error")?,
        turned_over: number(json, "/energy/turned_over")?,
        seconds: number(json, "/cpu_seconds")?,
        sizes: [count(json, "coordinates")?, count(json, "constraints")?, count(json, "dof")?],
        work: [count(json, "steps")?, count(json, "iterations")?, count(json, "factorizations")?],
        control: control.map(controlled).transpose()?,
        outputs: json["outputs"].as_object().map(channels).unwrap_or_default(),
    })
}

fn controlled(json: &Value) -> Result<Control, String> {
    Ok(Control {
        rejected: count(json, "rejected")?,
        steps: [number(json, "/smallest_step")?, number(json, "/largest_step")?],
        index_changes: count(json, "index_changes")?,
        index_1_steps: count(json, "index_1_steps")?,
        events: count(json, "events")?,
    })
}

/// Channels with their components. One component is a number, several are a list.
fn channels(outputs: &Map<String, Value>) -> BTreeMap<String, Vec<f64>> {
    let components = |channel: &Value| {
        let one = std::slice::from_ref(channel);
        let components = channel.as_array().map_or(one, Vec::as_slice);
        components.iter().map(Value::as_f64).collect::<Option<Vec<f64>>>()
    };
    outputs.iter().filter_map(|(name, x)| Some((name.clone(), components(x)?))).collect()
}

fn stopped(error: &Value) -> Result<Outcome, String> {
    Ok(Outcome::Stopped {
        code: text(error, "code")?,
        message: text(error, "message")?,
        time: number(error, "/time")?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The JSON object of a completed run.
    const DONE: &[u8] = br#"{"completed": true, "error": null, "cpu_seconds": 0.25,
        "coordinates": 4, "constraints": 2, "dof": 2, "steps": 7, "iterations": 21, "factorizations": 14,
        "energy": {"initial": 1.0, "max_error": 2e-3, "final_error": 1e-3, "turned_over": 4.0},
        "outputs": {"tip": [1.3, 2.4], "beta": 0.25}}"#;

    #[test]
    fn completed_run_gives_its_figures() {
        let Ok(Outcome::Completed(figures)) = read(Some(0), DONE, b"") else { panic!() };
        assert!((figures.distance("tip", &[1.0, 2.0]).unwrap() - 0.5).abs() < 1e-15);
        assert!((figures.distance("beta", &[0.5]).unwrap() - 0.25).abs() < 1e-15);
        assert!((figures.share() - 5e-4).abs() < 1e-18);
        assert!((figures.seconds - 0.25).abs() < 1e-15);
        assert_eq!((figures.sizes, figures.work), ([4, 2, 2], [7, 21, 14]));
        assert_eq!(figures.control, None);
    }

    #[test]
    fn controlled_run_gives_what_its_control_did() {
        let control = r#""control": {"rule": "energy", "accepted": 7, "rejected": 2, "smallest_step": 1e-4,
            "largest_step": 1e-2, "index_changes": 1, "index_1_steps": 3, "events": 5}, "#;
        let json =
            String::from_utf8_lossy(DONE).replace("\"error\"", &format!("{control}\"error\""));
        let Ok(Outcome::Completed(figures)) = read(Some(0), json.as_bytes(), b"") else { panic!() };
        let expected = Control {
            rejected: 2,
            steps: [1e-4, 1e-2],
            index_changes: 1,
            index_1_steps: 3,
            events: 5,
        };
        assert_eq!(figures.control, Some(expected));
        let odd = json.replace("\"rejected\": 2", "\"rejected\": -2");
        assert!(read(Some(0), odd.as_bytes(), b"").unwrap_err().contains("rejected"));
    }

    #[test]
    fn stopped_run_gives_its_typed_error() {
        let json = br#"{"completed": false, "error": {"code": "not-converged", "message": "no convergence",
            "time": 0.5, "hint": "try a smaller step"}}"#;
        let stopped = Outcome::Stopped {
            code: "not-converged".into(),
            message: "no convergence".into(),
            time: 0.5,
        };
        assert!(stopped.reason().starts_with("not-converged at 0.5 s: no convergence"));
        assert_eq!(read(Some(2), json, b""), Ok(stopped));
    }

    #[test]
    fn refusals_are_distinguished_from_what_is_not_built() {
        let stderr = b"error: formulation `recursive` is not built yet\nhint: built are: auto\n";
        assert_eq!(read(Some(1), b"", stderr), Ok(Outcome::NotBuilt));
        let stderr = b"error: the loops cannot be closed\n";
        let refused = Outcome::Refused("the loops cannot be closed".into());
        assert_eq!(read(Some(1), b"", stderr), Ok(refused));
        let stderr = b"error: unexpected argument '--steps' found\n";
        let refused = Outcome::Refused("unexpected argument '--steps' found".into());
        assert_eq!(read(Some(2), b"", stderr), Ok(refused));
    }

    #[test]
    fn output_that_lacks_something_is_named() {
        assert!(read(Some(101), b"", b"panicked").unwrap_err().contains("101"));
        assert!(read(None, b"", b"").is_err());
        let figures = Figures::default();
        assert!(figures.distance("toe", &[1.0]).unwrap_err().contains("toe"));
        let json = br#"{"completed": true, "outputs": {"tip": [1, 2]}}"#;
        assert!(read(Some(0), json, b"").unwrap_err().contains("max_error"));
        assert!(read(Some(2), br#"{"completed": false}"#, b"").is_err());
    }
}

//! What a run of `mbs run --json` came to, read from its output.

use super::report::Reference;
use serde_json::Value;

/// What a run came to.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Outcome {
    /// It reached the end.
    Completed(Figures),
    /// It stopped with a typed error.
    Stopped {
        /// The code of the error.
        code: String,
        /// What it says.
        message: String,
        /// When [s].
        time: f64,
    },
    /// It was refused: the formulation cannot run this scene, and says why.
    Refused(String),
    /// The formulation is not built.
    NotBuilt,
}

impl Outcome {
    /// Did it make steps, so that there are rows of it?
    pub(crate) fn has_run(&self) -> bool {
        matches!(self, Self::Completed(_) | Self::Stopped { .. })
    }
}

/// The figures of a run that reached its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Figures {
    /// Largest error of the energy invariant [J].
    pub(crate) energy_error: f64,
    /// Largest kinetic energy plus gross work [J].
    pub(crate) turned_over: f64,
    /// Distance from the reference at the end, where there is one.
    pub(crate) distance: Option<f64>,
    /// CPU time of the stepping [s].
    pub(crate) seconds: f64,
    /// Coordinates, constraints and freedoms.
    pub(crate) sizes: [u64; 3],
}

impl Figures {
    /// The energy error as a share of the energy turned over.
    pub(crate) fn share(&self) -> f64 {
        self.energy_error / self.turned_over
    }
}

/// Reads the outcome from a run's exit status, standard output and standard error.
///
/// # Errors
///
/// What is missing, where the output is not that of `mbs run --json`.
pub(crate) fn read(
    status: Option<i32>,
    stdout: &[u8],
    stderr: &[u8],
    reference: Option<Reference>,
) -> Result<Outcome, String> {
    if status == Some(1) {
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
        completed(&json, reference).map(Outcome::Completed)
    } else {
        stopped(&json["error"])
    }
}

/// The number at a place in the output.
fn number(json: &Value, place: &str) -> Result<f64, String> {
    let value = json.pointer(place).and_then(Value::as_f64);
    value.ok_or_else(|| format!("the output has no number at {place}"))
}

/// The count of that name in the output.
fn count(json: &Value, name: &str) -> Result<u64, String> {
    json[name].as_u64().ok_or_else(|| format!("the output has no count {name}"))
}

/// The text at a place in the output.
fn text(json: &Value, name: &str) -> Result<String, String> {
    let value = json[name].as_str().map(str::to_owned);
    value.ok_or_else(|| format!("the error has no {name}"))
}

fn completed(json: &Value, reference: Option<Reference>) -> Result<Figures, String> {
    Ok(Figures {
        energy_error: number(json, "/energy/max_error")?,
        turned_over: number(json, "/energy/turned_over")?,
        seconds: number(json, "/cpu_seconds")?,
        sizes: [count(json, "coordinates")?, count(json, "constraints")?, count(json, "dof")?],
        distance: reference
            .map(|reference| distance(&json["outputs"][reference.channel], reference))
            .transpose()?,
    })
}

/// Distance of a channel's components from the reference; one component is a number, several are a list.
fn distance(channel: &Value, reference: Reference) -> Result<f64, String> {
    let one = std::slice::from_ref(channel);
    let components = channel.as_array().map_or(one, Vec::as_slice);
    let numbers: Option<Vec<f64>> = components.iter().map(Value::as_f64).collect();
    let numbers = numbers.filter(|numbers| numbers.len() == reference.value.len());
    let numbers = numbers.ok_or_else(|| format!("no channel `{}`", reference.channel))?;
    let squares = numbers.iter().zip(reference.value).map(|(x, y)| (x - y) * (x - y));
    Ok(squares.sum::<f64>().sqrt())
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

    const POINT: Option<Reference> =
        Some(Reference { channel: "tip", label: "", value: &[1.0, 2.0] });
    const ANGLE: Option<Reference> = Some(Reference { channel: "beta", label: "", value: &[0.5] });

    const DONE: &[u8] = br#"{"completed": true, "error": null, "cpu_seconds": 0.25,
        "coordinates": 4, "constraints": 2, "dof": 2,
        "energy": {"initial": 1.0, "max_error": 2e-3, "final_error": 1e-3, "turned_over": 4.0},
        "outputs": {"tip": [1.3, 2.4], "beta": 0.25}}"#;

    #[test]
    fn completed_run_gives_its_figures() {
        let Ok(Outcome::Completed(figures)) = read(Some(0), DONE, b"", POINT) else { panic!() };
        assert!((figures.distance.unwrap() - 0.5).abs() < 1e-15);
        assert!((figures.share() - 5e-4).abs() < 1e-18);
        assert!((figures.seconds - 0.25).abs() < 1e-15);
        assert_eq!(figures.sizes, [4, 2, 2]);
        let Ok(Outcome::Completed(figures)) = read(Some(0), DONE, b"", None) else { panic!() };
        assert_eq!(figures.distance, None);
        let Ok(Outcome::Completed(figures)) = read(Some(0), DONE, b"", ANGLE) else { panic!() };
        assert!((figures.distance.unwrap() - 0.25).abs() < 1e-15);
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
        assert_eq!(read(Some(2), json, b"", POINT), Ok(stopped));
    }

    #[test]
    fn refusals_are_told_from_what_is_not_built() {
        let stderr = b"error: formulation `recursive` is not built yet\nhint: built are: auto\n";
        assert_eq!(read(Some(1), b"", stderr, POINT), Ok(Outcome::NotBuilt));
        let stderr = b"error: the loops cannot be closed\n";
        let refused = Outcome::Refused("the loops cannot be closed".into());
        assert_eq!(read(Some(1), b"", stderr, POINT), Ok(refused));
    }

    #[test]
    fn output_that_lacks_something_is_named() {
        assert!(read(Some(101), b"", b"panicked", POINT).unwrap_err().contains("101"));
        assert!(read(None, b"", b"", POINT).is_err());
        let absent = POINT.map(|point| Reference { channel: "toe", ..point });
        assert!(read(Some(0), DONE, b"", absent).unwrap_err().contains("toe"));
        let json = br#"{"completed": true, "outputs": {"tip": [1, 2]}}"#;
        assert!(read(Some(0), json, b"", POINT).unwrap_err().contains("max_error"));
        assert!(read(Some(2), br#"{"completed": false}"#, b"", POINT).is_err());
    }
}

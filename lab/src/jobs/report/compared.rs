//! Methods with runs that are known to stop, by scene. Other stops are reported as surprises.

use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Methods with runs that stop before their end. Controlled steps with a tolerance of 1e-3 change the pendulum's energy too much. Explicit
/// integrators do not keep the nearly singular leaf springs of the vehicle on their constraints. Runs in f32 stop if a tolerance is smaller
/// than their rounding errors. Long steps are the first of every method's range.
const STOPPED: [(&str, &[&str]); 4] = [
    (
        "double-pendulum",
        &["state-space, error-controlled, f64", "state-space, error-controlled, f32"],
    ),
    ("andrews", &[]),
    ("iltis-suspension", &["recursive rk54, f32"]),
    (
        "iltis-stairs",
        &[
            "index-1, f64",
            "recursive rk4, f64",
            "recursive rk54, f64",
            "recursive gbs, f64",
            "index-3, f32",
            "index-1, f32",
            "recursive rk4, f32",
            "recursive rk54, f32",
            "recursive gbs, f32",
        ],
    ),
];

/// Numbers of completed and of stopped runs, and differences from the list.
#[derive(Debug, PartialEq)]
pub(super) struct Judged {
    /// Number of completed runs, and number of runs that stopped.
    pub(super) counts: [usize; 2],
    /// Methods that stop and are not listed, and listed methods that do not stop.
    pub(super) surprises: Vec<String>,
}

/// Reads the results of a scene's comparison.
///
/// # Errors
///
/// The file that cannot be read.
pub(super) fn read(folder: &Path) -> Result<Value, String> {
    let path = folder.join("compare.json");
    let text = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    serde_json::from_str(&text).map_err(|e| format!("{}: {e}", path.display()))
}

/// Compares the results of a scene with the list.
pub(super) fn judge(scene: &str, comparison: &Value) -> Judged {
    let listed = STOPPED.iter().find(|(name, _)| *name == scene).map_or(&[][..], |(_, l)| l);
    judged(scene, comparison, listed)
}

fn judged(scene: &str, json: &Value, listed: &[&str]) -> Judged {
    let (mut counts, mut stopped) = ([0; 2], BTreeMap::<&str, (usize, &str)>::new());
    for method in json["methods"].as_array().into_iter().flatten() {
        let name = method["name"].as_str().unwrap_or_default();
        for run in method["runs"].as_array().into_iter().flatten() {
            match run["status"].as_str() {
                Some("completed") => counts[0] += 1,
                Some("failed") => {
                    counts[1] += 1;
                    let reason = run["failure"]["message"].as_str().unwrap_or_default();
                    stopped.entry(name).or_insert((0, reason)).0 += 1;
                }
                _ => {}
            }
        }
    }
    let unlisted = stopped.iter().filter(|(name, _)| !listed.contains(name));
    let unlisted =
        unlisted.map(|(name, (n, why))| format!("{scene}, {name}: {n} runs stop; {why}"));
    let finished = listed.iter().filter(|name| !stopped.contains_key(*name));
    let finished =
        finished.map(|name| format!("{scene}, {name}: every run ends, and it is listed to stop"));
    Judged { counts, surprises: unlisted.chain(finished).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_stops_unlisted_and_what_ends_though_listed_are_surprises() {
        let run = |status: &str| json!({ "status": status, "failure": { "message": "why" } });
        let json = json!({ "methods": [
            { "name": "a", "runs": [run("completed"), run("failed"), run("not-run")] },
            { "name": "b", "runs": [run("completed")] },
        ] });
        assert_eq!(judged("s", &json, &["a"]), Judged { counts: [2, 1], surprises: vec![] });
        let surprises = judged("s", &json, &["b"]).surprises;
        assert_eq!(
            surprises,
            ["s, a: 1 runs stop; why", "s, b: every run ends, and it is listed to stop"]
        );
    }

    #[test]
    fn every_scene_that_is_compared_has_its_list() {
        let compared = super::super::index::COMPARED.map(|page| page.scene);
        assert_eq!(STOPPED.map(|(scene, _)| scene), compared);
    }
}

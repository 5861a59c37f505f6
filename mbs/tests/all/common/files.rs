//! Files of the repository and of a run, for the tests of the library and of the command.

pub(crate) use mbs_testkit::repository::path;
use std::path::{Path, PathBuf};

/// Scenes of the repository, except those of vehicles.
pub(crate) const SCENES: [&str; 21] = [
    "simple-pendulum",
    "double-pendulum",
    "two-four-bars",
    "n-four-bar-10",
    "four-bar",
    "n-four-bar-40",
    "slider-crank",
    "guided-four-bar",
    "spinning-top",
    "free-body",
    "spatial-four-bar",
    "spatial-chain-20",
    "rssr",
    "tree-30",
    "andrews",
    "planetary-gear",
    "cam-follower",
    "crane",
    "servo-arm",
    "rolling-disc",
    "hexapod",
];

/// An empty directory for one test.
pub(crate) fn scratch(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).expect("the scratch directory can be made");
    path
}

/// Keys of the JSON object whose values are times.
const CLOCKS: [&str; 3] = ["cpu_seconds", "real_time_factor", "worst_step_seconds"];
/// Returns a JSON object without its times.
pub(crate) fn without_clocks(json: &str) -> String {
    let mut json: serde_json::Value = serde_json::from_str(json).expect("JSON");
    let object = json.as_object_mut().expect("an object");
    for clock in CLOCKS {
        assert!(object.remove(clock).is_some(), "{clock}");
    }
    json.to_string()
}

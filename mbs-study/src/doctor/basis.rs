//! Common parts of the examinations: limits of the effort, the start of the scene, and reasons of a stop.

use mbs::inside::AssembledScene;
use mbs::inside::poses;
use mbs::{Names, StopError};
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::Scene;
use mbs_core::start::Assembled;

/// Limits of the examination along the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Number of positions along the motion. With `0` the motion is not examined.
    pub positions: u64,
    /// Time limit for the motion [s]. A longer motion is reported as not examined to its end. The limit must be positive.
    pub seconds: f64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { positions: 400, seconds: 20.0 }
    }
}

/// Start of a scene: the model, its assembled state, and the poses of the bodies.
pub(super) struct Begun<const D: usize> {
    pub(super) model: NaturalModel<f64, D>,
    pub(super) start: Assembled<f64>,
    pub(super) poses: Vec<RigidMotion<f64>>,
}

/// Message and hint for a start or run that failed.
pub(super) fn stopped(scene: &Scene<f64>, error: &StopError, time: f64) -> (String, &'static str) {
    let report = error.report(time, &Names::new(scene));
    let whose = match (&report.joint, &report.body) {
        (Some(joint), _) => format!(" (joint `{joint}`)"),
        (None, Some(body)) => format!(" (body `{body}`)"),
        (None, None) => String::new(),
    };
    (format!("{}{whose}", report.message), error.hint())
}

/// Returns the poses of the bodies at a state.
pub(super) fn places<const D: usize>(
    scene: &Scene<f64>,
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
) -> Vec<RigidMotion<f64>> {
    poses(scene, model, state)
}

/// Assembles the scene, and finds its equilibrium if the scene starts there.
pub(super) fn begin<const D: usize>(scene: &Scene<f64>) -> Result<Begun<D>, StopError> {
    let AssembledScene { model, start, .. } = AssembledScene::new(scene)?;
    let poses = places(scene, &model, &start.state);
    Ok(Begun { model, start, poses })
}

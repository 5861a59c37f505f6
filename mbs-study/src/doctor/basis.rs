//! Shared basis of the examinations: how much may be looked at, the start, and why a run stopped.

use mbs::inside::AssembledScene;
use mbs::inside::poses;
use mbs::{Names, StopError};
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::Scene;
use mbs_core::start::Assembled;

/// Limits of what is looked at along the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Positions along the motion. `0`: the motion is left out.
    pub positions: u64,
    /// Time for the motion [s]; what lies beyond it is said to be not looked at. `> 0`.
    pub seconds: f64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { positions: 400, seconds: 20.0 }
    }
}

/// Start of a scene: the model, its assembled state, and where the bodies are.
pub(super) struct Begun<const D: usize> {
    pub(super) model: NaturalModel<f64, D>,
    pub(super) start: Assembled<f64>,
    pub(super) poses: Vec<RigidMotion<f64>>,
}

/// A failed start or run as words.
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

/// Assembles, and settles where the scene asks for it.
pub(super) fn begin<const D: usize>(scene: &Scene<f64>) -> Result<Begun<D>, StopError> {
    let AssembledScene { model, start, .. } = AssembledScene::new(scene)?;
    let poses = places(scene, &model, &start.state);
    Ok(Begun { model, start, poses })
}

//! What a tree is asked for whatever its dimension.

use super::layout::Layout;
use crate::stop::StopError;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{BodyId, Scene};
use mbs_recursive::space::Space;
use mbs_recursive::{EffortTerms, TreeModel, TreeState, Workspace};
use std::fmt::Debug;

/// A tree with its state, in the coordinates of its links.
pub(super) trait Inner: Debug + Send + Sync {
    fn clone_box(&self) -> Box<dyn Inner>;
    fn layout(&self, scene: &Scene<f64>) -> Layout;
    fn cut_joints(&self) -> Vec<usize>;
    fn n_rows(&self) -> usize;
    fn state(&mut self) -> &mut TreeState<f64>;
    /// Value, rate and acceleration of a guide that is an input; others follow their law.
    fn set_guide(&mut self, guide: usize, motion: [f64; 3]);
    fn read(&mut self, scene: &Scene<f64>, motions: &[RigidMotion<f64>]);
    /// Motions of the bodies at the state's accelerations.
    fn motions(&mut self) -> &[RigidMotion<f64>];
    fn write_mass(&mut self, mass: &mut [f64]);
    fn write_efforts(&mut self, terms: EffortTerms, efforts: &mut [f64]);
    fn write_loop_rows(&mut self, rows: &mut [f64]);
    /// Of a body's point, or of the centre of mass.
    fn write_jacobian(&mut self, of: Option<(BodyId, [f64; 3])>, rows: &mut [f64]);
    fn center_of_mass(&mut self) -> [[f64; 3]; 3];
    fn accelerate(&mut self, efforts: &[f64]) -> Result<(), StopError>;
}

impl Clone for Box<dyn Inner> {
    fn clone(&self) -> Self {
        self.clone_box()
    }
}

/// In the plane or in space.
#[derive(Debug, Clone)]
struct Typed<S: Space<f64>> {
    model: TreeModel<f64, S>,
    workspace: Workspace<f64, S>,
    state: TreeState<f64>,
    motions: Vec<RigidMotion<f64>>,
}

/// The tree of a scene, at rest in the reference configuration.
pub(super) fn of_scene<S: Space<f64>>(scene: &Scene<f64>) -> Result<Box<dyn Inner>, StopError> {
    let model = TreeModel::<f64, S>::new(scene).map_err(StopError::tree)?;
    let (workspace, state) = (Workspace::new(&model), TreeState::at_rest(&model));
    let at_rest = |body: &mbs_core::scene::Body<f64>| RigidMotion::at_rest(body.center.into());
    let motions = scene.bodies.iter().map(at_rest).collect();
    Ok(Box::new(Typed { model, workspace, state, motions }))
}

impl<S: Space<f64>> Inner for Typed<S> {
    fn clone_box(&self) -> Box<dyn Inner> {
        Box::new(self.clone())
    }
    fn layout(&self, scene: &Scene<f64>) -> Layout {
        Layout::new(scene, &self.model)
    }
    fn cut_joints(&self) -> Vec<usize> {
        self.model.cut_joints().collect()
    }
    fn n_rows(&self) -> usize {
        self.model.n_rows()
    }
    fn state(&mut self) -> &mut TreeState<f64> {
        &mut self.state
    }
    fn set_guide(&mut self, guide: usize, motion: [f64; 3]) {
        // Refused where the guide follows a law of time: it does so here too.
        let _ = self.model.set_guide(guide, motion);
    }
    fn read(&mut self, scene: &Scene<f64>, motions: &[RigidMotion<f64>]) {
        self.model.read_motions(scene, motions, &mut self.state);
    }
    fn motions(&mut self) -> &[RigidMotion<f64>] {
        self.model.write_motions(&self.state, &mut self.workspace, &mut self.motions);
        &self.motions
    }
    fn write_mass(&mut self, mass: &mut [f64]) {
        self.model.write_tree_mass_matrix(&self.state, &mut self.workspace, mass);
    }
    fn write_efforts(&mut self, terms: EffortTerms, efforts: &mut [f64]) {
        self.model.write_efforts((&self.state, terms), &mut self.workspace, efforts);
    }
    fn write_loop_rows(&mut self, rows: &mut [f64]) {
        self.model.place(&self.state, &mut self.workspace);
        self.model.write_loop_rows(&mut self.workspace, rows);
    }
    fn write_jacobian(&mut self, of: Option<(BodyId, [f64; 3])>, rows: &mut [f64]) {
        self.model.place(&self.state, &mut self.workspace);
        match of {
            Some(point) => self.model.write_jacobian(point, &mut self.workspace, rows),
            None => self.model.write_center_jacobian(&mut self.workspace, rows),
        }
    }
    fn center_of_mass(&mut self) -> [[f64; 3]; 3] {
        self.model.center_of_mass(&self.state, &mut self.workspace)
    }
    fn accelerate(&mut self, efforts: &[f64]) -> Result<(), StopError> {
        let Self { model, workspace, state, .. } = self;
        let done = model.accelerate_under(efforts, state, workspace);
        done.map_err(|error| {
            StopError::step(error, |u| model.owner_of_unknown(u), |row| model.owner_of_row(row))
        })
    }
}

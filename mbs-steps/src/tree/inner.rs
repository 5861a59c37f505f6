//! Tree with its state in the coordinates of its links, for the plane and for space.

use super::layout::Layout;
use crate::stop::StopError;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{Dimension, Scene};
use mbs_core::step::StepError;
use mbs_recursive::own::{MovingColumns, OwnFreedoms};
use mbs_recursive::space::Space;
use mbs_recursive::{Planar, Spatial, TreeModel, TreeState, Workspace};

/// Tree in the plane or in space.
#[derive(Debug, Clone)]
pub(super) enum Inner {
    Planar(Box<Typed<Planar>>),
    Spatial(Box<Typed<Spatial>>),
}

/// Model, state and workspace of a tree.
#[derive(Debug, Clone)]
pub(super) struct Typed<S: Space<f64>> {
    pub model: TreeModel<f64, S>,
    pub workspace: Workspace<f64, S>,
    pub state: TreeState<f64>,
    pub motions: Vec<RigidMotion<f64>>,
    pub own: OwnFreedoms<f64, S>,
    /// Columns of derivatives by coordinates and velocities. The first call that needs derivatives allocates them.
    pub moving: Option<MovingColumns<f64>>,
}

/// Tree, layout of its coordinates, and the reason why it has no accelerations; `None` if it has accelerations.
type Made<X> = (X, Layout, Option<StopError>);

/// Evaluates the same expression for the planar and the spatial tree.
macro_rules! with {
    ($inner:expr, $tree:ident => $done:expr) => {
        match $inner {
            Inner::Planar($tree) => $done,
            Inner::Spatial($tree) => $done,
        }
    };
}
pub(super) use with;

impl Inner {
    /// Builds the tree of a scene, at rest in the reference configuration. Also returns the reason why it has no accelerations, if there is
    /// one.
    pub(super) fn new(scene: &Scene<f64>) -> Result<Made<Self>, StopError> {
        Ok(match scene.dimension {
            Dimension::Planar => {
                let (typed, layout, lack) = Typed::new(scene)?;
                (Self::Planar(Box::new(typed)), layout, lack)
            }
            Dimension::Spatial => {
                let (typed, layout, lack) = Typed::new(scene)?;
                (Self::Spatial(Box::new(typed)), layout, lack)
            }
        })
    }

    pub(super) fn state(&mut self) -> &mut TreeState<f64> {
        with!(self, tree => &mut tree.state)
    }
}

impl<S: Space<f64>> Typed<S> {
    /// Converts an error of a step to the reason of a stop, with the parts of the scene that it concerns.
    pub(super) fn reason(model: &TreeModel<f64, S>, error: StepError) -> StopError {
        let freedom = |unknown| model.owner_of_unknown(unknown);
        StopError::step(error, freedom, |row| model.owner_of_row(row))
    }

    fn new(scene: &Scene<f64>) -> Result<Made<Self>, StopError> {
        let (model, lack) = TreeModel::with_lack(scene).map_err(StopError::tree)?;
        let layout = Layout::new(scene, &model);
        let own = OwnFreedoms::new(&model, &layout.freedoms(model.n_links()));
        let (workspace, state) = (Workspace::new(&model), TreeState::at_rest(&model));
        let motions = scene.bodies.iter().map(|b| RigidMotion::at_rest(b.center.into())).collect();
        let made = Self { model, workspace, state, motions, own, moving: None };
        Ok((made, layout, lack.map(StopError::tree)))
    }
}

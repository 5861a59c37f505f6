//! A scene at the state that it is linearised about.

use crate::equilibrium::{Search, find_equilibrium};
use crate::ready::AssembledScene;
use crate::rest::{LeftOut, at_rest, effects_left_out, left_out};
use crate::stop::StopError;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::Scene;
use mbs_linear::{Equilibrium, Instant};

mbs_core::named! {
    /// About which state.
    pub enum Place {
        /// The static equilibrium near the start, at rest.
        Equilibrium = "equilibrium",
        /// The start of runs, with its velocities and the guides' rates.
        Initial = "initial",
        /// The positions of the static equilibrium with the scene's initial velocities: a vehicle that drives straight.
        Moving = "moving",
    }
}

/// A scene with its model and the state of a place.
#[allow(
    missing_debug_implementations,
    reason = "it holds what has none, and is made and used in one call"
)]
pub struct PlacedScene<const D: usize> {
    /// Scene at its place; in an equilibrium without what only motion makes.
    pub scene: Scene<f64>,
    /// Model of the scene, whose start is at the place.
    pub ready: AssembledScene<f64, D>,
    /// The equilibrium, if that is the place.
    pub found: Option<Equilibrium<f64>>,
    /// Parts that are left out of the scene; for a moving state, out of the search for its equilibrium alone.
    pub left_out: Vec<LeftOut>,
    /// Motion of the guides at the place.
    pub instant: Instant,
}

impl<const D: usize> PlacedScene<D> {
    /// Assembles a scene, and seeks its equilibrium if that is the place.
    ///
    /// # Errors
    /// [`StopError`] when there is no model, consistent start or equilibrium.
    pub fn new(scene: &Scene<f64>, place: Place, search: Search) -> Result<Self, StopError> {
        let left_out = match place {
            Place::Equilibrium => left_out(scene),
            Place::Initial => Vec::new(),
            Place::Moving => effects_left_out(scene),
        };
        let (scene, ready, found) = match place {
            Place::Equilibrium => {
                let still = at_rest(scene);
                let mut ready = AssembledScene::<f64, D>::assembled(&still)?;
                let found = find_equilibrium(&still, &ready.model, search, &mut ready.start.state)?;
                (still, ready, Some(found))
            }
            Place::Initial => (scene.clone(), AssembledScene::new(scene)?, None),
            Place::Moving => {
                let (ready, found) = AssembledScene::settled(scene, search)?;
                (scene.clone(), ready, Some(found))
            }
        };
        let is_at_rest = place == Place::Equilibrium;
        let instant = if is_at_rest { Instant::Rest } else { Instant::Motion };
        Ok(Self { scene, ready, found, left_out, instant })
    }

    /// A scene whose bodies move as `motions` say, which meet the constraints. Guides are where they begin, and move as they do there.
    ///
    /// # Errors
    /// [`StopError`] when there is no model, or no accelerations.
    pub fn given(scene: &Scene<f64>, motions: &[RigidMotion<f64>]) -> Result<Self, StopError> {
        let ready = AssembledScene::placed(scene, (0.0, motions))?;
        let (found, left_out, instant) = (None, Vec::new(), Instant::Motion);
        Ok(Self { scene: scene.clone(), ready, found, left_out, instant })
    }
}

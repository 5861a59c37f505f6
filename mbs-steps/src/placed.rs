//! A scene at the state about which it is linearised.

use crate::equilibrium::{Search, find_equilibrium};
use crate::ready::AssembledScene;
use crate::rest::{LeftOut, at_rest, effects_left_out, left_out};
use crate::stop::StopError;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::Scene;
use mbs_linear::{Equilibrium, Instant};

mbs_core::named! {
    /// State about which a scene is linearised.
    pub enum Place {
        /// The static equilibrium closest to the start, at rest.
        Equilibrium = "equilibrium",
        /// The start of a run, with its velocities and the rates of its guides.
        Initial = "initial",
        /// Positions of the static equilibrium with the scene's initial velocities, for example for a vehicle that drives straight ahead.
        Moving = "moving",
    }
}

/// Scene with its model, at the state of a place.
#[allow(
    missing_debug_implementations,
    reason = "it holds what has none, and is made and used in one call"
)]
pub struct PlacedScene<const D: usize> {
    /// Scene at its place. At an equilibrium, effects that act only in motion are omitted.
    pub scene: Scene<f64>,
    /// Model of the scene; its start is the state of the place.
    pub ready: AssembledScene<f64, D>,
    /// The equilibrium, if the place is an equilibrium.
    pub found: Option<Equilibrium<f64>>,
    /// Parts that are omitted from the scene. For a moving state they are omitted only during the search for its equilibrium.
    pub left_out: Vec<LeftOut>,
    /// Motion of the guides at the place: they are held, or they move.
    pub instant: Instant,
}

impl<const D: usize> PlacedScene<D> {
    /// Assembles a scene, and searches for its equilibrium if the place needs one.
    ///
    /// # Errors
    /// [`StopError`] when there is no model, no consistent start or no equilibrium.
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

    /// Scene whose bodies move as given by `motions`, which satisfy the constraints. Guides have their initial values and rates.
    ///
    /// # Errors
    /// [`StopError`] if the model cannot be built, or the accelerations cannot be computed.
    pub fn given(scene: &Scene<f64>, motions: &[RigidMotion<f64>]) -> Result<Self, StopError> {
        let ready = AssembledScene::placed(scene, (0.0, motions))?;
        let (found, left_out, instant) = (None, Vec::new(), Instant::Motion);
        Ok(Self { scene: scene.clone(), ready, found, left_out, instant })
    }
}

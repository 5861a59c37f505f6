//! Models of a mechanism: its simulation, its tree in relative coordinates, and the model of a study.

use super::failure::SimulationError;
use super::inner::built;
use super::inputs::Inputs;
use super::mechanism::Mechanism;
use super::simulation::Simulation;
use super::tree::{Tree, with_mass};
use crate::names::Names;
use crate::precision::{ReadScene, Source};
use crate::settings::{Method, ResolvedMethod};
use crate::statics::StaticEquilibrium;
use mbs_core::Real;
use mbs_core::scene::Scene;
use std::borrow::Cow;

impl Mechanism {
    /// Builds the model, assembles it and allocates all memory that a step needs. Settings that `method` leaves open are taken from the
    /// mechanism. Default, where neither sets them: index-3 with steps of 1 ms.
    ///
    /// # Errors
    /// [`SimulationError`] for a part, a method or a start that is refused.
    pub fn simulate(&self, method: &Method) -> Result<Simulation, SimulationError> {
        let (read, settings, scene) = self.prepared(method)?;
        let names = Names::new(&scene);
        let inner = built(&read, &settings);
        let inner = inner.map_err(|error| SimulationError::stopped(error, 0.0, &names))?;
        Ok(Simulation::of(inner, Inputs::new(&scene), names, self.functions()))
    }

    /// Builds the tree of the mechanism: its model in relative coordinates, for any position and velocity.
    ///
    /// # Errors
    /// [`SimulationError`] for a part that is refused, or for a mechanism without a spanning tree.
    pub fn tree(&self) -> Result<Tree, SimulationError> {
        Ok(Tree::new(&self.resolve_scene()?)?)
    }

    /// Returns the mechanism with bodies of 1 kg and 1 kg m^2 in place of their own masses. With them, a mechanism that lacks masses can be
    /// assembled: positions and velocities that fulfil joints and initial conditions can be found for any masses.
    #[must_use]
    pub fn with_fictitious_masses(&self) -> Self {
        let mut heavy = self.clone();
        let dimension = heavy.scene_mut().dimension;
        for body in &mut heavy.scene_mut().bodies {
            *body = with_mass(body, dimension, 1.0);
        }
        heavy
    }

    /// Starts later simulations and runs from an equilibrium of this mechanism, with the initial velocities of the mechanism. Each start
    /// searches the equilibrium anew, from the same configuration and by the same search.
    pub fn start_from(&mut self, rest: &StaticEquilibrium) -> &mut Self {
        self.scene_mut().start = rest.search.start();
        self
    }

    /// Returns the scene in the precision of the settings, the settings, and the scene in `f64`.
    pub(super) fn prepared(
        &self,
        method: &Method,
    ) -> Result<(ReadScene<'static>, ResolvedMethod, Scene<f64>), SimulationError> {
        let scene = self.resolve_scene()?;
        let settings = ResolvedMethod::new(&scene, method)?;
        let read = ReadScene::of(self, Cow::Owned(scene.clone()), settings.precision)?;
        Ok((read, settings, scene))
    }
}

impl Source for Mechanism {
    type Error = SimulationError;

    fn scene_in<T: Real>(&self) -> Result<Scene<T>, SimulationError> {
        self.resolved().map_err(|error| self.located(error))
    }
}

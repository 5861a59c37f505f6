//! From a mechanism to what moves: its simulation, its tree, and what a study of it runs.

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
    /// Builds the model, assembles it and allocates all that a step needs. What the method leaves open is what the mechanism's file asks for,
    /// else index-3 with steps of 1 ms.
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

    /// The mechanism in relative coordinates, at any position and velocity.
    ///
    /// # Errors
    /// [`SimulationError`] for a part that is refused, or a mechanism that has no tree.
    pub fn tree(&self) -> Result<Tree, SimulationError> {
        Ok(Tree::new(&self.resolve_scene()?)?)
    }

    /// Returns the mechanism with 1 kg and 1 kg m^2 for each body in place of its own masses. Positions and velocities that fulfil joints and
    /// initial conditions need no others: of a mechanism that lacks masses they are found with these.
    #[must_use]
    pub fn with_fictitious_masses(&self) -> Self {
        let mut heavy = self.clone();
        let dimension = heavy.scene_mut().dimension;
        for body in &mut heavy.scene_mut().bodies {
            *body = with_mass(body, dimension, 1.0);
        }
        heavy
    }

    /// Starts from an equilibrium of this mechanism: what is simulated or run from now on begins there, with the initial velocities of the
    /// mechanism. Each start seeks it anew, from the same configuration and in the same way.
    pub fn start_from(&mut self, rest: &StaticEquilibrium) -> &mut Self {
        self.scene_mut().start = rest.search.start();
        self
    }

    /// The scene in the precision of its settings, the settings, and the scene in `f64`.
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

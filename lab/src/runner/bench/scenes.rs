//! Scenes by name: files of `scenes/`, and large generated scenes.

use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::Scene;
use mbs_core::start::assemble;
use mbs_core::{Cliques, Real};
use mbs_scene::{Family, SceneFile, generate};
use mbs_sparse::{Multifrontal, Options};
use serde_json::{Value, json};
use std::time::Instant;

/// Distance between the vehicles of a convoy [m].
const SPACING: f64 = 8.0;
/// Name of the scene whose vehicle a convoy has.
const VEHICLE: &str = "iltis-stairs";
/// Step of a scene without a step of its own [s].
const STEP: f64 = 1e-3;

/// A scene by its name: a file in `scenes/`, or FAMILY-N.
pub(crate) fn read<T: Real>(name: &str) -> Result<Scene<T>, String> {
    let document = match file(name) {
        Ok(document) => document,
        Err(missing) => {
            let Some((family, n)) = family(name) else { return Err(missing) };
            SceneFile::parse(&made(family, n)?, name).map_err(|e| e.render())?
        }
    };
    document.scene().map_err(|e| e.render())
}

/// The family and the size in the name of a generated scene.
fn family(name: &str) -> Option<(&str, usize)> {
    let (family, n) = name.rsplit_once('-')?;
    let known = ["chain", "tree", "n-four-bar", "net", "convoy"];
    Some((known.into_iter().find(|known| *known == family)?, n.parse().ok()?))
}

/// The text of a generated scene.
fn made(family: &str, n: usize) -> Result<String, String> {
    let vehicle = file(VEHICLE);
    let family = match family {
        "chain" => Family::Chain { bodies: n },
        "tree" => Family::Tree { bodies: n },
        "n-four-bar" => Family::FourBars { loops: n },
        "net" => Family::net_of(n),
        _ => Family::Convoy { vehicle: vehicle.as_ref()?, count: n, spacing: SPACING },
    };
    generate(&family, "cargo xtask bench").map_err(|e| e.to_string())
}

/// Reads a file of `scenes/`.
fn file(name: &str) -> Result<SceneFile, String> {
    let path = format!("scenes/{name}.toml");
    let bytes = std::fs::read(&path).map_err(|e| format!("no scene `{name}`: {path}: {e}"))?;
    SceneFile::from_bytes(&bytes, &path).map_err(|e| e.render())
}

/// A scene's model and its assembled initial state.
#[derive(Debug)]
pub(crate) struct Prepared<const D: usize, T: Real = f64> {
    pub(crate) scene: Scene<T>,
    pub(crate) model: NaturalModel<T, D>,
    pub(crate) start: State<T>,
    /// Step of the scene [s], and number of steps of its run.
    pub(crate) dt: f64,
    pub(crate) n_steps: u32,
    /// Time of building the model and assembling the start [s].
    seconds: f64,
}

impl<const D: usize, T: Real> Prepared<D, T> {
    /// Builds the model and assembles the start.
    pub(crate) fn new(scene: Scene<T>) -> Result<Self, String> {
        let clock = Instant::now();
        let model = NaturalModel::<T, D>::new(&scene).map_err(|e| e.to_string())?;
        let analyse = Options::default();
        let mut solver = Multifrontal::analyse(&model, analyse);
        let mut start =
            assemble(&scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver)
                .map_err(|e| e.to_string())?;
        if let Some(search) = mbs::Search::of_start(scene.start) {
            mbs::equilibrium_start(&scene, &model, search, &mut solver, &mut start)
                .map_err(|e| e.to_string())?;
        }
        let (dt, n_steps) = steps(&scene);
        let seconds = clock.elapsed().as_secs_f64();
        Ok(Self { scene, model, start: start.state, dt, n_steps, seconds })
    }
}

impl<const D: usize> Prepared<D> {
    /// Sizes of the model as a line.
    pub(crate) fn json(&self) -> Value {
        let scene = &self.scene;
        json!({
            "kind": "scene", "title": scene.name, "bodies": scene.bodies.len(),
            "joints": scene.joints.len(), "step": self.dt, "duration": scene.duration,
            "unknowns": self.model.n_unknowns(), "rows": self.model.n_constraints(),
            "elements": self.model.n_elements(), "prepared_in": self.seconds,
        })
    }
}

/// Step of a scene [s], and number of steps of its run.
pub(crate) fn steps<T: Real>(scene: &Scene<T>) -> (f64, u32) {
    let dt = scene.solver.step.map_or(STEP, T::to_f64);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count of steps")]
    let n = (scene.duration.to_f64() / dt).round().clamp(1.0, 1e9) as u32;
    (dt, n)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A chain of this many links.
    pub(crate) fn chain(n: usize) -> Scene<f64> {
        let text = made("chain", n).unwrap();
        SceneFile::parse(&text, "chain").unwrap().scene().unwrap()
    }

    #[test]
    fn names_of_large_scenes_end_with_their_size() {
        assert_eq!(family("chain-1000"), Some(("chain", 1000)));
        assert_eq!(family("n-four-bar-40"), Some(("n-four-bar", 40)));
        assert_eq!([family("andrews"), family("chain-x"), family("ring-3")], [None; 3]);
        assert_eq!(Prepared::<3>::new(chain(12)).unwrap().n_steps, 500);
    }
}

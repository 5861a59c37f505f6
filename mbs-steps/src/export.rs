//! Export of scenes as tables for controllers: `mbs export`.

use crate::settings::ResolvedMethod;
use crate::simulation::Simulation;
use crate::stop::StopError;
use mbs_core::effects::Value as EffectValue;
use mbs_core::once::found;
use mbs_core::scene::{CouplingMeasure, CouplingTerm, Dimension, Effect, Scene, SignalKind};
use mbs_core::{Real, instances};
use mbs_nostd::export::{Collected, MovingSignal, bytes, source};
use mbs_nostd::format::Axes;
use mbs_nostd::operation_bound::{Operations, step as step_bound};
use mbs_nostd::{Bounds, LoadError};
use mbs_recursive::link::LinkKind;
use mbs_recursive::space::Space;
use mbs_recursive::{Planar, Spatial, StartError, TreeModel, TreeState};
use serde_json::Value;

/// Tables of a scene, in two forms.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exported {
    /// Source text of a Rust file with the tables.
    pub rust: String,
    /// Bytes that `mbs_nostd::Tables::read` reads.
    pub bytes: Vec<u8>,
}

/// Reason why a scene has no tables.
#[derive(Debug)]
pub enum ExportError {
    /// The scene does not start.
    Stop(StopError),
    /// An effect of this name is a user-defined law, which has no table.
    Effect(String),
    /// An effect of this name acts on an angle of a ball joint, which controllers do not support.
    Sum(String),
    /// A signal of this name is a wave, a ramp, or a table that holds or repeats its values. Or a guide follows a signal of this name that
    /// is neither a spline nor a step.
    Signal(String),
    /// A coupling of this name is a user-defined relation.
    Relation(String),
    /// A signal of this name measures a length or an angle of a ball joint, which controllers do not support.
    Measure(String),
    /// The guide of a joint of this name gives a rotation vector, which controllers do not support.
    Guide(String),
    /// The degrade ladder names an effect that the scene does not have, or its file is no list of effect costs.
    Ladder(String),
}

impl core::fmt::Display for ExportError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Stop(error) => write!(f, "{error}"),
            Self::Effect(name) => {
                write!(f, "effect `{name}` is a law in code, which cannot be written as a table")
            }
            Self::Sum(name) => {
                write!(
                    f,
                    "effect `{name}` cannot be written for a controller: it acts on an angle of a ball"
                )
            }
            Self::Signal(name) => {
                write!(
                    f,
                    "signal `{name}` cannot be written for a controller: it is a wave, a ramp or a table that holds or repeats, or a \
                     guide follows it that is no spline or step"
                )
            }
            Self::Relation(name) => {
                write!(
                    f,
                    "coupling `{name}` is a relation in code, which cannot be written as a table"
                )
            }
            Self::Measure(name) => {
                write!(
                    f,
                    "signal `{name}` cannot be written for a controller: it measures a length or an angle of a ball"
                )
            }
            Self::Guide(name) => {
                write!(
                    f,
                    "the guide of joint `{name}` cannot be written for a controller: it gives a rotation vector"
                )
            }
            Self::Ladder(what) => write!(f, "{what}"),
        }
    }
}

impl core::error::Error for ExportError {}

impl From<StopError> for ExportError {
    fn from(error: StopError) -> Self {
        Self::Stop(error)
    }
}

/// Writes a scene as tables in single or double precision; start and tables are computed in double precision. The first part of `form` has
/// the indices of the effects in the degrade ladder; the first effect is dropped first. The second part is true for single precision.
///
/// # Errors
/// [`ExportError`] if the scene cannot start or cannot be written as tables.
pub fn export(
    scene: &Scene<f64>,
    settings: &ResolvedMethod,
    form: (&[usize], bool),
) -> Result<Exported, ExportError> {
    match scene.dimension {
        Dimension::Planar => in_space::<Planar, 2>(scene, settings, form),
        Dimension::Spatial => in_space::<Spatial, 3>(scene, settings, form),
    }
}

fn in_space<S: Axes<f64>, const D: usize>(
    scene: &Scene<f64>,
    settings: &ResolvedMethod,
    (ladder, is_single): (&[usize], bool),
) -> Result<Exported, ExportError> {
    if let Some(name) = guided_ball(scene) {
        return Err(ExportError::Guide(name));
    }
    if let Some(coupling) = scene.couplings.iter().find(|coupling| coupling.relation.is_some()) {
        return Err(ExportError::Relation(coupling.name.clone()));
    }
    let is_no_coordinate = |kind: &SignalKind<f64>| matches!(kind, SignalKind::Measure { of, .. } if of.coordinate().is_none());
    if let Some(signal) = scene.signals.iter().find(|signal| is_no_coordinate(&signal.kind)) {
        return Err(ExportError::Measure(signal.name.clone()));
    }
    let simulation = Simulation::<f64, D>::new(scene, settings)?;
    let tree = TreeModel::<f64, S>::new(scene);
    let tree = tree.map_err(StopError::tree)?;
    let start = tree.start(scene, simulation.model(), simulation.state());
    let start = start.map_err(|error| match error {
        StartError::Tree(error) => StopError::tree(error),
        StartError::Step(error) => {
            StopError::step(error, |u| tree.owner_of_unknown(u), |row| tree.owner_of_row(row))
        }
        _ => StopError::tree(mbs_recursive::TreeError::Dimension),
    })?;
    let name = |moving: MovingSignal| scene.signals[moving.signal].name.clone();
    let collected = Collected::new(&tree, &start, ladder);
    let collected = collected.map_err(|moving| ExportError::Signal(name(moving)))?;
    let model = collected.model();
    let in_code = || {
        let mut effects = scene.effects.iter();
        let found = effects.find(|effect| effect.enabled && effect.kind.row().names.is_empty());
        ExportError::Effect(found.map(|effect| effect.name.clone()).unwrap_or_default())
    };
    let title = format!("The scene \"{}\"", scene.name.escape_default());
    let rust = source(&model, (&title, is_single)).map_err(|error| match error {
        LoadError::Sum { .. } => ExportError::Sum(on_sum(scene)),
        _ => in_code(),
    })?;
    let bytes = bytes(&model, is_single).ok_or_else(in_code)?;
    Ok(Exported { rust, bytes })
}

/// Bound of the number of operations of a tree's step on a controller; `None` if controllers do not support the tree.
///
/// Cost: the construction of the tables, linear in their size.
#[must_use]
pub fn operation_bound<T: Real, S: Space<T>>(tree: &TreeModel<T, S>) -> Option<Operations> {
    if T::HAS_INSTANCES {
        return found::<OperationBound<T, S>>(OPERATION_BOUND)(tree);
    }
    bound_here(tree)
}

type OperationBound<T, S> = fn(&TreeModel<T, S>) -> Option<Operations>;
instances!(
    OPERATION_BOUND: OperationBound<T, S> = bound_here::<T, S>,
    { type S = Planar; } { type S = Spatial; }
);

fn bound_here<T: Real, S: Space<T>>(tree: &TreeModel<T, S>) -> Option<Operations> {
    // Controllers do not support guided rotation vectors.
    let is_exported = tree.mechanism().links.iter().all(|link| link.kind != LinkKind::GuidedBall);
    let rest = TreeState::at_rest(tree);
    let collected = Collected::new(tree, &rest, &[]).ok().filter(|_| is_exported)?;
    Some(step_bound(&collected.model(), Bounds::default()))
}

/// The name of the first joint whose rotation vector a guide prescribes.
fn guided_ball<T>(scene: &Scene<T>) -> Option<String> {
    let joints = scene.guides.iter().map(|guide| (&scene.joints[guide.joint], guide.number));
    let mut balls =
        joints.filter(|(joint, number)| joint.kind.freedom(scene.dimension, *number).is_none());
    balls.next().map(|(joint, _)| joint.name.clone())
}

/// The name of the first enabled effect on an angle of a ball joint.
fn on_sum<T: Clone>(scene: &Scene<T>) -> String {
    let is_ball = |term: &CouplingTerm<T>| matches!(term.of, CouplingMeasure::Ball { .. });
    let is_it = |effect: &&Effect<T>| {
        effect.enabled
            && effect.kind.values().iter().any(|value| match value {
                EffectValue::Terms(terms) => terms.iter().any(is_ball),
                _ => false,
            })
    };
    scene.effects.iter().find(is_it).map(|effect| effect.name.clone()).unwrap_or_default()
}

/// Reads the degrade ladder from a list of effect costs, the JSON of `mbs explain`. The ladder has the effects with a cost, without which
/// the run completes. The effect that changes the outputs least comes first.
///
/// # Errors
/// [`ExportError::Ladder`] if the text is no list of effect costs of this scene.
pub fn ladder<T>(prices: &str, scene: &Scene<T>) -> Result<Vec<usize>, ExportError> {
    let fault = |what: &str| ExportError::Ladder(what.to_owned());
    let json: Value =
        serde_json::from_str(prices).map_err(|_| fault("the list of effect costs is not JSON"))?;
    let entries = json["prices"]["effects"].as_array();
    let entries = entries.ok_or_else(|| fault("the JSON has no prices of effects"))?;
    let mut rungs = Vec::new();
    for entry in entries {
        let costs = entry["share"].as_f64().is_some_and(|share| share > 0.0);
        if !costs || entry["completed"] != true {
            continue;
        }
        let changes = entry["changes"].as_array().map_or(&[][..], Vec::as_slice);
        let change = changes.iter().filter_map(|change| change["relative"].as_f64());
        let change = change.fold(0.0, f64::max);
        let name = entry["names"][0].as_str().unwrap_or_default();
        let index = scene.effects.iter().position(|effect| effect.name == name);
        let index = index.ok_or_else(|| {
            ExportError::Ladder(format!(
                "the list of effect costs has \"{name}\", and the scene has not"
            ))
        })?;
        rungs.push((change, index));
    }
    rungs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    Ok(rungs.into_iter().map(|(_, index)| index).collect())
}

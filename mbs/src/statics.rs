//! Static equilibrium of a scene: as a start of a run, and reported in joints, reactions and outputs.

use crate::channels::Channels;
use crate::modes::{eigenvalues, neutral_directions};
use crate::ready::AssembledScene;
use crate::rest::{LeftOut, at_rest, left_out};
use crate::simulation::rank;
use crate::stop::StopError;
use mbs_core::algebra::{norm, rotation_vector};
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{Dimension, Joint, JointId, Output, Quantity, Scene, Start};
use mbs_core::start::{Assembled, restart};
use mbs_core::{Cliques, Real, SpdSolver};
use mbs_linear::{
    Equilibrium, Instant, LinearOptions, Options, Saddle, Workspace, equilibrium, equilibrium_near,
    linearise,
};
use mbs_scene::Channel;
use mbs_sparse::{Indefinite, Multifrontal};
use serde_json::{Map, Value, json};

/// Scratch of a static or linear analysis of a model.
pub(crate) fn workspace<T: Real, const D: usize>(
    model: &NaturalModel<T, D>,
) -> Workspace<T, Indefinite<T>> {
    let solver = Indefinite::analyse(&Saddle::new(model), mbs_sparse::Options::default());
    Workspace::new(model, solver)
}

/// How an equilibrium is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Search {
    /// Down from the start, to one that is stable.
    #[default]
    Down,
    /// By Newton's method from the start, to the one nearby, stable or not.
    Near,
}

impl Search {
    /// How a scene with this start seeks its equilibrium; nothing where it starts from its initial conditions.
    #[must_use]
    pub fn of_start(start: Start) -> Option<Self> {
        match start {
            Start::Initial => None,
            Start::Equilibrium => Some(Self::Down),
            Start::EquilibriumNear => Some(Self::Near),
        }
    }

    /// The start of a scene that seeks its equilibrium so.
    #[must_use]
    pub fn start(self) -> Start {
        match self {
            Self::Down => Start::Equilibrium,
            Self::Near => Start::EquilibriumNear,
        }
    }
}

/// Moves a state to a static equilibrium, at rest and with guides at their values at the start. What only motion makes does not act:
/// drives, drag, dry friction, and what a tire does when it rolls.
///
/// # Errors
/// [`StopError::Equilibrium`]; positions are then unchanged.
pub fn find_equilibrium<T: Real, const D: usize>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
    search: Search,
    state: &mut State<T>,
) -> Result<Equilibrium<T>, StopError> {
    let still = at_rest(scene);
    if still == *scene {
        return settle_model(model, search, state);
    }
    let quiet = NaturalModel::<T, D>::new(&still).map_err(|e| StopError::Start(e.into()))?;
    let mut there = State::at_rest(&quiet);
    there.t = state.t;
    tell((scene, model), state, &quiet, &mut there);
    let found = settle_model(&quiet, search, &mut there)?;
    tell((&still, &quiet), &there, model, state);
    Ok(found)
}

/// Converts a state of one model to another of the same bodies and joints.
fn tell<T: Real, const D: usize>(
    (scene, from): (&Scene<T>, &NaturalModel<T, D>),
    state: &State<T>,
    to: &NaturalModel<T, D>,
    told: &mut State<T>,
) {
    let motions: Vec<_> = (0..scene.bodies.len()).map(|b| from.motion(scene, b, state)).collect();
    to.take_motions(&motions, &mut to.terms(), told);
}

fn settle_model<T: Real, const D: usize>(
    model: &NaturalModel<T, D>,
    search: Search,
    state: &mut State<T>,
) -> Result<Equilibrium<T>, StopError> {
    state.v.fill(T::ZERO);
    let (options, mut workspace) = (Options::default(), workspace(model));
    let found = match search {
        Search::Down => equilibrium(model, &options, state, &mut workspace),
        Search::Near => equilibrium_near(model, &options, state, &mut workspace),
    };
    found.map_err(|error| {
        let n = model.n_unknowns();
        StopError::equilibrium(
            error,
            n,
            |u| model.owner_of_unknown(u),
            |row| model.owner_of_row(row),
        )
        .or_law(model.codes())
    })
}

/// Turns the start of a scene into one from its static equilibrium: positions settle from those assembled, with guides held;
/// then velocities follow from the scene's initial ones, and accelerations. Initial positions only say where the search begins.
///
/// # Errors
/// [`StopError`] when there is no equilibrium, or the initial velocities do not fit there.
pub fn equilibrium_start<T: Real, const D: usize>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
    search: Search,
    solver: &mut impl SpdSolver<T>,
    start: &mut Assembled<T>,
) -> Result<Equilibrium<T>, StopError> {
    let found = find_equilibrium(scene, model, search, &mut start.state)?;
    let analyse = mbs_sparse::Options::default();
    let state = &mut start.state;
    let residual = restart(scene, model, |p| Multifrontal::analyse(p, analyse), solver, state);
    start.residual = residual.map_err(|error| StopError::Start(error).or_law(model.codes()))?;
    let mut reference = vec![T::ZERO; model.n_extended()];
    model.write_reference(&mut reference);
    let changes = reference.iter().zip(&start.state.q).map(|(&r, &q)| (q - r).abs());
    start.change = changes.fold(T::ZERO, T::max);
    Ok(found)
}

/// How far bodies are from where they started: a way or a turn at most, and which body's it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Moved {
    /// Of a centre of mass [m], or about any axis, from 0 to pi [rad].
    pub size: f64,
    /// Name of the body.
    pub body: String,
}

/// A static equilibrium, with its names.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticEquilibrium {
    /// Name of the scene.
    pub scene: String,
    /// Coordinates, constraints, their rank.
    pub sizes: [usize; 3],
    /// How it was searched.
    pub search: Search,
    /// What the search found.
    pub found: Equilibrium<f64>,
    /// How far centres of mass went from the start, and how far bodies turned; without bodies nothing.
    pub moved: Option<[Moved; 2]>,
    /// What is left out.
    pub left_out: Vec<LeftOut>,
    /// Modes that grow, by the eigenvalues of the equations of motion; `None` where they cannot be linearised.
    pub unstable: Option<usize>,
    /// Directions in which it may stand anywhere; likewise.
    pub neutral: Option<usize>,
    /// Potential energy of gravity, constant forces and springs [J].
    pub potential: f64,
    /// Joint coordinates [rad or m].
    pub joints: Vec<(Channel, Vec<f64>)>,
    /// What the first body of each joint does to the second; empty where the loops are too large for reactions.
    pub reactions: Vec<(Channel, Vec<f64>)>,
    /// Joints whose reaction is not unique: the smallest is given.
    pub not_unique: Vec<String>,
    /// The scene's outputs.
    pub outputs: Vec<(Channel, Vec<f64>)>,
}

impl StaticEquilibrium {
    /// Assembles a scene and lets it settle.
    ///
    /// # Errors
    /// [`StopError`] when there is no model, no consistent start or no equilibrium.
    pub fn new(scene: &Scene<f64>, search: Search) -> Result<Self, StopError> {
        match scene.dimension {
            Dimension::Planar => Self::in_space::<2>(scene, search),
            Dimension::Spatial => Self::in_space::<3>(scene, search),
        }
    }

    fn in_space<const D: usize>(scene: &Scene<f64>, search: Search) -> Result<Self, StopError> {
        let left_out = left_out(scene);
        let scene = &at_rest(scene);
        let AssembledScene { model, start, .. } = AssembledScene::<f64, D>::assembled(scene)?;
        let mut state = start.state;
        let places = |state: &State<f64>| -> Vec<RigidMotion<f64>> {
            (0..scene.bodies.len()).map(|body| model.motion(scene, body, state)).collect()
        };
        let from = places(&state);
        let found = find_equilibrium(scene, &model, search, &mut state)?;
        let moved = moved(scene, &from, &places(&state));
        let reaction = |(index, joint): (usize, &Joint<f64>)| {
            let quantity = Quantity::Reaction { joint: JointId::new(index) };
            Output { name: joint.name.clone(), quantity }
        };
        let reactions = scene.joints.iter().enumerate().map(reaction).collect();
        let joints = Scene { outputs: Vec::new(), ..scene.clone() }.channels();
        let stability = stability(&model, &state);
        let told = |outputs| measured(outputs, scene, &model, &state);
        let (joints, _) = told(joints)?;
        let (reactions, not_unique) = told(reactions).unwrap_or_default();
        let (outputs, _) = told(scene.outputs.clone())?;
        let mut terms = model.terms();
        model.set_inputs(state.t, &state, &mut terms);
        model.evaluate(&state.q, &mut terms);
        model.evaluate_forces(&state.q, &state.v, &mut terms);
        let sizes = [model.n_unknowns(), model.n_constraints(), rank(&model, &state)];
        Ok(Self {
            scene: scene.name.clone(),
            sizes,
            search,
            found,
            moved,
            left_out,
            unstable: stability.map(|s| s[0]),
            neutral: stability.map(|s| s[1]),
            potential: model.potential_energy(&state.q, &terms),
            joints,
            reactions,
            not_unique,
            outputs,
        })
    }

    /// One JSON object.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let found = &self.found;
        let [coordinates, constraints, rank] = self.sizes;
        let [way, turn] = self.moved.clone().map_or([None, None], |both| both.map(Some));
        let moved = |m: Option<Moved>| m.map(|m| json!({ "size": m.size, "body": m.body }));
        json!({
            "scene": self.scene,
            "completed": true,
            "error": null,
            "coordinates": coordinates,
            "constraints": constraints,
            "constraint_rank": rank,
            "dof": coordinates - rank,
            "stable": self.unstable.map(|n| n == 0),
            "unstable_modes": self.unstable,
            "neutral_directions": self.neutral,
            "residual": found.residual,
            "relative_residual": found.relative,
            "violation": found.violation,
            "change": found.change,
            "moved": { "distance": moved(way), "turn": moved(turn) },
            "left_out": left_out_json(&self.left_out),
            "iterations": found.iterations,
            "factorizations": found.factorizations,
            "potential_energy": self.potential,
            "joints": object(&self.joints),
            "reactions": object(&self.reactions),
            "not_unique": self.not_unique,
            "outputs": object(&self.outputs),
        })
    }
}

/// As it stands in JSON.
pub(crate) fn left_out_json(left_out: &[LeftOut]) -> Value {
    left_out.iter().map(|l| json!({ "effect": l.effect, "part": l.part })).collect()
}

/// The longest way of a centre of mass, and the largest turn.
fn moved(
    scene: &Scene<f64>,
    from: &[RigidMotion<f64>],
    to: &[RigidMotion<f64>],
) -> Option<[Moved; 2]> {
    let of_body = |b: usize| {
        let center = scene.bodies[b].center.into();
        let [way, turn] = [
            to[b].point(&center)[0] - from[b].point(&center)[0],
            rotation_vector(&(to[b].rotation * from[b].rotation.transpose())),
        ];
        [norm(&way), norm(&turn)]
    };
    let most = |k: usize| {
        let sizes = (0..scene.bodies.len()).map(|b| (of_body(b)[k], b));
        let (size, body) = sizes.max_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(Moved { size, body: scene.bodies[body].name.clone() })
    };
    Some([most(0)?, most(1)?])
}

/// Growing modes and neutral directions at an equilibrium; none where there is no linearisation.
fn stability<const D: usize>(
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
) -> Option<[usize; 2]> {
    let how = (Instant::Rest, &LinearOptions::default());
    let linear = linearise(model, how, state, &mut workspace(model)).ok()?;
    let growing = eigenvalues(&linear).ok()?.iter().filter(|mode| mode.grows()).count();
    Some([growing, neutral_directions(&linear).ok()?])
}

fn object(channels: &[(Channel, Vec<f64>)]) -> Map<String, Value> {
    channels.iter().map(|(channel, values)| (channel.name.clone(), json!(values))).collect()
}

/// Channels with their values.
type Told = Vec<(Channel, Vec<f64>)>;

/// Outputs of a scene at a state, and the joints whose reaction is not unique.
fn measured<const D: usize>(
    outputs: Vec<Output<f64>>,
    scene: &Scene<f64>,
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
) -> Result<(Told, Vec<String>), StopError> {
    if outputs.is_empty() {
        return Ok(Default::default());
    }
    let scene = &Scene { outputs, ..scene.clone() };
    let mut measures = Channels::new(scene, model)?;
    let channels = Channel::of_scene(scene);
    let mut values = vec![0.0; channels.iter().map(|c| c.components.len()).sum()];
    measures.write(state, &mut values)?;
    let mut rest = values.into_iter();
    let told = channels.into_iter().map(|channel| {
        let n = channel.components.len();
        (channel, rest.by_ref().take(n).collect())
    });
    Ok((told.collect(), measures.not_unique(scene)))
}

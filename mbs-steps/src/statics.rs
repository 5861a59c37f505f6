//! Static equilibrium of a scene, with its joint coordinates, reactions and outputs.

use crate::channels::Channels;
use crate::equilibrium::{Search, find_equilibrium, workspace};
use crate::modes::{eigenvalues, neutral_directions};
use crate::ready::{AssembledScene, rank};
use crate::record::Channel;
use crate::rest::{LeftOut, at_rest, left_out, left_out_json};
use crate::stop::StopError;
use mbs_core::Cliques;
use mbs_core::algebra::{norm, rotation_vector};
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{Dimension, Joint, JointId, Output, Quantity, Scene};
use mbs_linear::{Equilibrium, Instant, LinearOptions, linearise};
use serde_json::{Map, Value, json};

/// Largest displacement or rotation of a body from its start, and the name of that body.
#[derive(Debug, Clone, PartialEq)]
pub struct Moved {
    /// Displacement of the centre of mass [m], or angle of rotation from 0 to pi [rad].
    pub size: f64,
    /// Name of the body.
    pub body: String,
}

/// A static equilibrium, with the names of the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticEquilibrium {
    /// Name of the scene.
    pub scene: String,
    /// Number of coordinates, number of constraints, rank of the constraints.
    pub sizes: [usize; 3],
    /// Search by which the equilibrium was found.
    pub search: Search,
    /// Equilibrium that the search found.
    pub found: Equilibrium<f64>,
    /// Largest displacement of a centre of mass, and largest rotation of a body, both from the start; `None` without bodies.
    pub moved: Option<[Moved; 2]>,
    /// Parts of the scene that are omitted in the search.
    pub left_out: Vec<LeftOut>,
    /// Number of modes that grow, from the eigenvalues of the equations of motion; `None` if the equations cannot be linearised.
    pub unstable: Option<usize>,
    /// Number of directions in which the equilibrium is neutral; `None` if the equations of motion cannot be linearised.
    pub neutral: Option<usize>,
    /// Potential energy of gravity, constant forces and springs [J].
    pub potential: f64,
    /// Joint coordinates [rad or m].
    pub joints: Vec<(Channel, Vec<f64>)>,
    /// Reactions of the joints, as loads that the first body exerts on the second. Empty if the closed loops are too large for the
    /// computation.
    pub reactions: Vec<(Channel, Vec<f64>)>,
    /// Joints whose reaction is not unique. The list of reactions then has the reaction of smallest norm.
    pub not_unique: Vec<String>,
    /// Values of the scene's outputs.
    pub outputs: Vec<(Channel, Vec<f64>)>,
}

impl StaticEquilibrium {
    /// Assembles a scene and searches for its static equilibrium.
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
            Output::new(quantity).named(&joint.name)
        };
        let reactions = scene.joints.iter().enumerate().map(reaction).collect();
        let joints = scene.joint_outputs();
        let stability = stability(&model, &state);
        let values = |outputs| measured(outputs, scene, &model, &state);
        let (joints, _) = values(joints)?;
        let (reactions, not_unique) = values(reactions).unwrap_or_default();
        let (outputs, _) = values(scene.outputs.clone())?;
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

    /// Returns the equilibrium as one JSON object.
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
            "search": self.search.name(),
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

/// Returns the largest displacement of a centre of mass, and the largest rotation of a body.
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

/// Number of growing modes and number of neutral directions at an equilibrium; `None` if the equations of motion cannot be linearised.
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
type ChannelValues = Vec<(Channel, Vec<f64>)>;

/// Outputs of a scene at a state, and the joints whose reaction is not unique.
fn measured<const D: usize>(
    outputs: Vec<Output<f64>>,
    scene: &Scene<f64>,
    model: &NaturalModel<f64, D>,
    state: &State<f64>,
) -> Result<(ChannelValues, Vec<String>), StopError> {
    if outputs.is_empty() {
        return Ok(Default::default());
    }
    let mut measures = Channels::of_outputs(&outputs, scene, model)?;
    let channels = Channel::of_outputs(outputs, scene);
    let mut values = vec![0.0; channels.iter().map(|c| c.components.len()).sum()];
    measures.write_at(state, &mut values)?;
    let mut rest = values.into_iter();
    let pairs = channels.into_iter().map(|channel| {
        let n = channel.components.len();
        (channel, rest.by_ref().take(n).collect())
    });
    Ok((pairs.collect(), measures.not_unique(scene)))
}

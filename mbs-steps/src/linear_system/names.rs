//! Names of inputs, outputs and states of signals, and their indices.

use crate::erased::SimulationError;
use crate::erased::UnknownName;
use crate::erased::inputs::{InputInfo, InputOwner, Inputs};
use crate::record::Channel;
use mbs_core::feedback::FeedbackOperation;
use mbs_core::model::Model;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{Output, Scene};

/// The requested inputs, and their indices among the inputs of a state.
#[derive(Debug, Default)]
pub(crate) struct InputPlaces {
    pub(super) names: Vec<String>,
    pub(super) places: Vec<usize>,
}

impl InputPlaces {
    /// Finds the inputs with the given names; `None` stands for all inputs. The model may be that of the scene at rest.
    pub(super) fn new<const D: usize>(
        scene: &Scene<f64>,
        model: &NaturalModel<f64, D>,
        asked: Option<&[&str]>,
    ) -> Result<Self, SimulationError> {
        let inputs = Inputs::new(scene);
        let list = inputs.list();
        let all: Vec<&InputInfo> = match asked {
            None => list.iter().collect(),
            Some(asked) => asked.iter().map(|name| named(list, name)).collect::<Result<_, _>>()?,
        };
        let places = all.iter().map(|info| place(model, info));
        let places = places.collect::<Result<_, _>>()?;
        Ok(Self { places, names: all.into_iter().map(|info| info.name.clone()).collect() })
    }
}

fn named<'a>(list: &'a [InputInfo], name: &str) -> Result<&'a InputInfo, UnknownName> {
    list.iter().find(|info| info.name == name).ok_or_else(|| UnknownName {
        word: "input",
        name: name.to_owned(),
        known: list.iter().map(|info| info.name.clone()).collect(),
    })
}

fn place<const D: usize>(
    model: &NaturalModel<f64, D>,
    info: &InputInfo,
) -> Result<usize, SimulationError> {
    let prescribed = model.prescribed();
    let first = match info.owner {
        InputOwner::Effect(effect) => prescribed.input(effect.index()).map(|range| range.start),
        InputOwner::Guide(guide) | InputOwner::Coupling { sum: guide, .. } => {
            prescribed.guide_input(guide.index()).map(|range| range.start)
        }
        // An input signal here drives no guide, because the scene check rejects guides that follow an input signal: inputs can jump.
        InputOwner::Signal(signal) => prescribed.signal_input(signal.index()),
    };
    first.map(|first| first + info.component).map_err(|error| {
        let message =
            format!("input `{}` belongs to an effect that is left out at rest", info.name);
        let hint = "leave it out, or linearise about the start or the moving state";
        SimulationError::new("input-refused", message, hint).with_cause(error)
    })
}

/// Names of the states of signals, in order.
pub(super) fn signal_states<const D: usize>(
    scene: &Scene<f64>,
    model: &NaturalModel<f64, D>,
) -> Vec<String> {
    let mut names = vec![String::new(); model.n_signal_states()];
    for step in model.prescribed().feedback().steps {
        let (state, suffix) = match step.operation {
            FeedbackOperation::Lag { state, .. } | FeedbackOperation::Integral { state, .. } => {
                (state, "")
            }
            FeedbackOperation::Pid { state, .. } => (state, ".integral"),
            _ => continue,
        };
        let signal = scene.signals.get(step.to as usize);
        if let (Some(name), Some(signal)) = (names.get_mut(state as usize), signal) {
            *name = format!("{}{suffix}", signal.name);
        }
    }
    names
}

/// The requested columns of outputs.
#[derive(Debug, Default)]
pub(crate) struct OutputColumns {
    /// Outputs of which these columns are components.
    pub(super) measured: Vec<Output<f64>>,
    /// Indices of the columns among all components of these outputs.
    pub(super) places: Vec<usize>,
    pub(super) names: Vec<String>,
}

impl OutputColumns {
    /// Finds the columns with the given names; the name of an output stands for all its columns. `None` stands for all columns of the
    /// motion, without columns about the run itself.
    pub(super) fn new(scene: &Scene<f64>, asked: Option<&[&str]>) -> Result<Self, UnknownName> {
        let (mut measured, mut columns) = (Vec::new(), Vec::new());
        for (output, channel) in scene.channels().into_iter().zip(Channel::of_scene(scene)) {
            let is_asked = |column: &String| {
                asked.is_none_or(|names| {
                    names.iter().any(|name| column == name || channel.name == *name)
                })
            };
            let own: Vec<String> = channel.columns().collect();
            if !channel.is_of_run() && own.iter().any(is_asked) {
                measured.push(output);
                columns.extend(own.into_iter().map(|column| (channel.name.clone(), column)));
            }
        }
        let mut places = Vec::new();
        match asked {
            None => places.extend(0..columns.len()),
            Some(names) => {
                for name in names {
                    let is_it =
                        |(channel, column): &(String, String)| column == name || channel == name;
                    let found = (0..columns.len()).filter(|&i| is_it(&columns[i]));
                    let before = places.len();
                    places.extend(found);
                    if places.len() == before {
                        return Err(unknown(scene, name));
                    }
                }
            }
        }
        let names = places.iter().map(|&place: &usize| columns[place].1.clone()).collect();
        Ok(Self { measured, places, names })
    }
}

fn unknown(scene: &Scene<f64>, name: &str) -> UnknownName {
    let channels = Channel::of_scene(scene);
    let known = channels.iter().filter(|c| !c.is_of_run()).flat_map(Channel::columns).collect();
    UnknownName { word: "output", name: name.to_owned(), known }
}

//! Channels of a run: what is recorded, with names and units.

use mbs_core::outputs::{Component, QUANTITIES};
use mbs_core::scene::{Output, Scene};

/// Recorded channel, with its name and its components.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Channel {
    /// Name, unique among the channels.
    pub name: String,
    /// Quantity that the channel measures, as scene files call it; empty of an output that is code.
    pub quantity: &'static str,
    /// Components in the order of the record; one for a number.
    pub components: Vec<Component>,
}

impl Channel {
    /// Is it of the run itself, as its energy error, so that an error of it says nothing of the motion?
    #[must_use]
    pub fn is_of_run(&self) -> bool {
        QUANTITIES.iter().any(|row| row.name == self.quantity && row.is_of_run)
    }

    /// The channels of a scene: its outputs, or every joint coordinate when it names none.
    ///
    /// Vectors have components `x`, `y`, `z`; joints with several coordinates `1`, `2`, ...; reactions
    /// `Fx`, `Fy`, `Mz` or `Fx`, `Fy`, `Fz`, `Mx`, `My`, `Mz`.
    ///
    /// # Panics
    /// If an output points to a joint that is not there; [`Scene::check`] refuses those.
    #[must_use]
    pub fn of_scene<T: Clone>(scene: &Scene<T>) -> Vec<Self> {
        Self::of_outputs(scene.channels(), scene)
    }

    /// The channels of outputs of a scene, as [`of_scene`](Self::of_scene) has those of all.
    #[must_use]
    pub fn of_outputs<T: Clone>(
        outputs: impl IntoIterator<Item = Output<T>>,
        scene: &Scene<T>,
    ) -> Vec<Self> {
        let channel = |output: Output<T>| Self {
            quantity: output.quantity.row().name,
            components: output.components(scene),
            name: output.name,
        };
        outputs.into_iter().map(channel).collect()
    }

    /// The names of its columns: `name`, or `name.x`, `name.y`, ...
    pub fn columns(&self) -> impl Iterator<Item = String> + '_ {
        self.components.iter().map(|component| {
            if component.label.is_empty() {
                return self.name.clone();
            }
            format!("{}.{}", self.name, component.label)
        })
    }
}

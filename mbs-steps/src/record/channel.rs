//! Channels of a run: the recorded quantities, with names and units.

use mbs_core::outputs::{Component, QUANTITIES};
use mbs_core::scene::{Output, Scene};

/// Recorded channel, with its name and its components.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Channel {
    /// Name of the channel, unique in a run.
    pub name: String,
    /// Quantity that the channel measures, as named in scene files; empty for a user-defined output.
    pub quantity: &'static str,
    /// Components in the order of the record; a scalar has one component.
    pub components: Vec<Component>,
}

impl Channel {
    /// True if the channel belongs to the run itself, such as its energy error. The accuracy of such a channel does not show the accuracy
    /// of the motion.
    #[must_use]
    pub fn is_of_run(&self) -> bool {
        QUANTITIES.iter().any(|row| row.name == self.quantity && row.is_of_run)
    }

    /// Channels of a scene: its outputs, or all joint coordinates if the scene names no outputs.
    ///
    /// Vectors have the components `x`, `y`, `z`. Joints with several coordinates have `1`, `2`, ... Reactions have `Fx`, `Fy`, `Mz` in the
    /// plane, and `Fx`, `Fy`, `Fz`, `Mx`, `My`, `Mz` in space.
    ///
    /// # Panics
    /// If an output refers to a joint that does not exist; [`Scene::check`] reports such outputs as errors.
    #[must_use]
    pub fn of_scene<T: Clone>(scene: &Scene<T>) -> Vec<Self> {
        Self::of_outputs(scene.channels(), scene)
    }

    /// Channels of some outputs of a scene, with the components described at [`of_scene`](Self::of_scene).
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

    /// Names of the channel's columns: `name`, or `name.x`, `name.y`, ...
    pub fn columns(&self) -> impl Iterator<Item = String> + '_ {
        self.components.iter().map(|component| {
            if component.label.is_empty() {
                return self.name.clone();
            }
            format!("{}.{}", self.name, component.label)
        })
    }
}

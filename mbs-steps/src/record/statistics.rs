//! Statistics of channels over every step of a run.

use super::channel::Channel;
use mbs_core::outputs::magnitudes;

/// Statistics of a number over every step, the start among them. Least and largest value may lie between steps, where five neighbouring
/// values agree on a turning point.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Statistics {
    /// Least value of the number.
    pub min: f64,
    /// When it was first reached [s].
    pub at_min: f64,
    /// Largest value of the number.
    pub max: f64,
    /// When it was first reached [s].
    pub at_max: f64,
    /// Root of the mean square over time, by the trapezoidal rule over the steps as they were.
    pub rms: f64,
    /// Value at the end.
    pub end: f64,
}

/// Statistics of a component of a channel, or of the magnitude of a vector in it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ComponentStatistics {
    /// Label as in a column's name; of a magnitude `abs`, or `F` and `M` of a wrench. Empty: the channel is one number.
    pub label: String,
    /// Unit of the component.
    pub unit: String,
    /// Is it the magnitude of a vector?
    pub is_magnitude: bool,
    /// Statistics of the component or magnitude.
    pub of: Statistics,
}

/// The statistics of a channel as an object: lists have a place for each component, then for the magnitude of each vector.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct ChannelSummary {
    /// Name of the channel.
    pub name: String,
    /// Quantity that the channel measures; empty of an output that is code.
    pub quantity: String,
    /// The unit of all components; absent where they differ.
    pub unit: Option<String>,
    /// Labels as in the names of columns; empty: the channel is one number.
    pub components: Vec<String>,
    /// Units of the components and magnitudes.
    pub units: Vec<String>,
    /// Least value of each.
    pub min: Vec<f64>,
    /// When they were first reached [s].
    pub at_min: Vec<f64>,
    /// Largest value of each.
    pub max: Vec<f64>,
    /// When they were first reached [s].
    pub at_max: Vec<f64>,
    /// Roots of the mean squares over time.
    pub rms: Vec<f64>,
    /// Values at the end.
    pub end: Vec<f64>,
}

impl ChannelSummary {
    /// Makes the summary of a channel with its statistics.
    #[must_use]
    pub fn new(channel: &Channel, stats: &[ComponentStatistics]) -> Self {
        let mut units = channel.components.iter().map(|component| &component.unit);
        let first = units.next().filter(|first| units.all(|unit| unit == *first));
        let each = |of: fn(&Statistics) -> f64| stats.iter().map(|x| of(&x.of)).collect();
        Self {
            name: channel.name.clone(),
            quantity: channel.quantity.to_owned(),
            unit: first.cloned(),
            components: stats.iter().map(|x| x.label.clone()).collect(),
            units: stats.iter().map(|x| x.unit.clone()).collect(),
            min: each(|x| x.min),
            at_min: each(|x| x.at_min),
            max: each(|x| x.max),
            at_max: each(|x| x.at_max),
            rms: each(|x| x.rms),
            end: each(|x| x.end),
        }
    }
}

/// Returns statistics without values for each component of a channel, then for the magnitude of each vector that is no component already. Each
/// comes with the range of the components that it is made of.
pub fn measured(channel: &Channel) -> Vec<(ComponentStatistics, core::ops::Range<usize>)> {
    let components = &channel.components;
    let one = |label: &str, unit: &str| {
        let (label, unit) = (label.to_owned(), unit.to_owned());
        ComponentStatistics { label, unit, ..ComponentStatistics::default() }
    };
    let each = components.iter().enumerate().map(|(i, x)| (one(&x.label, &x.unit), i..i + 1));
    let is_new = |label: &str| components.iter().all(|component| component.label != label);
    let vectors = magnitudes(components).into_iter().filter(|x| is_new(x.label));
    let vectors = vectors.map(|vector| {
        let one = one(vector.label, &vector.unit);
        (ComponentStatistics { is_magnitude: true, ..one }, vector.places)
    });
    each.chain(vectors).collect()
}

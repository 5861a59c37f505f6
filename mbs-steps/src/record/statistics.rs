//! Statistics of channels over every step of a run.

use super::channel::Channel;
use mbs_core::outputs::magnitudes;

/// Statistics of a quantity over all steps, including the start. The least or the greatest value may be at a time between steps: the
/// extremum of a polynomial through five neighbouring values.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Statistics {
    /// Least value of the quantity.
    pub min: f64,
    /// Time at which the least value was first reached [s].
    pub at_min: f64,
    /// Greatest value of the quantity.
    pub max: f64,
    /// Time at which the greatest value was first reached [s].
    pub at_max: f64,
    /// Root mean square over time, by the trapezoidal rule over the steps of the run.
    pub rms: f64,
    /// Value at the end of the run.
    pub end: f64,
}

/// Statistics of a component of a channel, or of the magnitude of a vector in the channel.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ComponentStatistics {
    /// Label as in the column name; empty for a scalar channel. The magnitude of a vector has the label `abs`. The magnitudes of a wrench's
    /// force and moment have the labels `F` and `M`.
    pub label: String,
    /// Unit of the component.
    pub unit: String,
    /// True for the magnitude of a vector.
    pub is_magnitude: bool,
    /// Statistics of the component or magnitude.
    pub of: Statistics,
}

/// Statistics of a channel for JSON. Each list has one entry for each component, then one for the magnitude of each vector.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct ChannelSummary {
    /// Name of the channel.
    pub name: String,
    /// Quantity that the channel measures; empty for a user-defined output.
    pub quantity: String,
    /// Common unit of all components; absent if the components have different units.
    pub unit: Option<String>,
    /// Labels of the components as in the column names; empty for a scalar channel.
    pub components: Vec<String>,
    /// Units of the components and magnitudes.
    pub units: Vec<String>,
    /// Least value of each entry.
    pub min: Vec<f64>,
    /// Times at which the least values were first reached [s].
    pub at_min: Vec<f64>,
    /// Greatest value of each entry.
    pub max: Vec<f64>,
    /// Times at which the greatest values were first reached [s].
    pub at_max: Vec<f64>,
    /// Root mean square of each entry over time.
    pub rms: Vec<f64>,
    /// Value of each entry at the end of the run.
    pub end: Vec<f64>,
}

impl ChannelSummary {
    /// Creates the summary of a channel from its statistics.
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

/// Returns empty statistics for each component of a channel, then for the magnitude of each vector that is not already a component. Each
/// entry also has the index range of the components from which it is computed.
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

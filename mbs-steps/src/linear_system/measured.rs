//! What is measured at each state of a linearisation: outputs, and coordinates of joints and bodies with their rates.

use super::names::OutputColumns;
use crate::channels::Channels;
use crate::record::Channel;
use crate::stop::StopError;
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{BodyId, Dimension, Freedom, JointId, Output, Quantity, Scene};
use mbs_linear::LinearError;

/// Way of a difference along the velocity, relative to the scene's length [-]: its fourth power is rounding of a rate.
const WAY: f64 = 1e-3;

/// Where the numbers of a measurement are: outputs; then coordinates, rates, derivatives of the coordinates, and accelerations.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    /// Which of the measured components are outputs, in their order, and how many there are.
    outputs: Vec<usize>,
    n_measured: usize,
    /// The coordinates that may be states, those of joints first.
    names: Vec<String>,
    pub(super) n_of_joints: usize,
}

impl Layout {
    /// The rows of one part for each coordinate.
    fn part(&self, part: usize) -> impl Fn(usize) -> usize {
        let start = self.n_measured + part * self.names.len();
        move |coordinate| start + coordinate
    }

    /// Outputs.
    pub(super) fn output_rows(&self) -> impl Iterator<Item = usize> + '_ {
        self.outputs.iter().copied()
    }

    /// How coordinates that may be states change with each freedom, a row for each, of what all that is measured changes by, freedom by
    /// freedom.
    pub(super) fn slopes(&self, of_all: &[f64]) -> Vec<Vec<f64>> {
        let all = self.n_measured + 4 * self.names.len();
        let rows = (0..self.names.len()).map(self.part(0));
        rows.map(|row| of_all.chunks_exact(all.max(1)).map(|of| of[row]).collect()).collect()
    }

    /// Coordinates that are states, then their rates.
    pub(super) fn state_rows(&self, chosen: &[usize]) -> impl Iterator<Item = usize> {
        self.both(chosen, [0, 1])
    }

    /// The derivatives of both.
    pub(super) fn rate_rows(&self, chosen: &[usize]) -> impl Iterator<Item = usize> {
        self.both(chosen, [2, 3])
    }

    fn both(&self, chosen: &[usize], parts: [usize; 2]) -> impl Iterator<Item = usize> {
        let of = |part| chosen.iter().copied().map(self.part(part));
        of(parts[0]).chain(of(parts[1])).collect::<Vec<_>>().into_iter()
    }

    /// Names of the states.
    pub(super) fn state_names(&self, chosen: &[usize], of_signals: Vec<String>) -> Vec<String> {
        let names = || chosen.iter().map(|&i| &self.names[i]);
        let rates = names().map(|name| format!("{name}.rate"));
        names().cloned().chain(rates).chain(of_signals).collect()
    }
}

/// Reads outputs and coordinates.
pub(super) struct Measured<const D: usize> {
    pub(super) layout: Layout,
    outputs: Option<Channels<f64, D>>,
    coordinates: Option<[Channels<f64, D>; 3]>,
    /// Coordinates of a rotation: their rates are angular velocities.
    turns: Vec<bool>,
    /// The scene's length [m].
    length: f64,
    /// Why the last measurement failed.
    pub(super) stop: Option<StopError>,
}

impl<const D: usize> Measured<D> {
    /// Prepares it.
    pub(super) fn new(
        scene: &Scene<f64>,
        model: &NaturalModel<f64, D>,
        columns: &OutputColumns,
    ) -> Result<Self, StopError> {
        let channels = |outputs: Vec<Output<f64>>| {
            let scene = Scene { outputs, ..scene.clone() };
            // without outputs a scene has other channels
            let is_none = scene.outputs.is_empty();
            (!is_none).then(|| Channels::new(&scene, model)).transpose()
        };
        let outputs = channels(columns.measured.clone())?;
        let n_measured = outputs.as_ref().map_or(0, |outputs| outputs.lengths().sum());
        let Coordinates { quantities, names, turns, n_of_joints } = Coordinates::new(scene);
        let [mut values, mut rates, mut accelerations] = [Vec::new(), Vec::new(), Vec::new()];
        for [value, rate, acceleration] in quantities {
            values.push(value);
            rates.push(rate);
            accelerations.push(acceleration);
        }
        let three = [channels(values)?, channels(rates)?, channels(accelerations)?];
        let coordinates = match three {
            [Some(values), Some(rates), Some(accelerations)] => {
                Some([values, rates, accelerations])
            }
            _ => None,
        };
        let layout = Layout { outputs: columns.places.clone(), n_measured, names, n_of_joints };
        let length = model.length();
        Ok(Self { layout, outputs, coordinates, turns, length, stop: None })
    }

    /// All numbers at a state.
    pub(super) fn write(&mut self, s: &State<f64>) -> Result<Vec<f64>, LinearError> {
        self.try_write(s).map_err(|stop| {
            let output = if let StopError::Output { output } = stop { output } else { 0 };
            self.stop = Some(stop);
            LinearError::Output { output }
        })
    }

    fn try_write(&mut self, s: &State<f64>) -> Result<Vec<f64>, StopError> {
        let (first, n) = (self.layout.n_measured, self.layout.names.len());
        let mut all = vec![0.0; first + 4 * n];
        let (outputs, rest) = all.split_at_mut(first);
        if let Some(channels) = &mut self.outputs {
            channels.write_at(s, outputs)?;
        }
        let Some([values, rates, accelerations]) = &mut self.coordinates else { return Ok(all) };
        let (value, rest) = rest.split_at_mut(n);
        let (rate, rest) = rest.split_at_mut(n);
        let (change, acceleration) = rest.split_at_mut(n);
        values.write_at(s, value)?;
        rates.write_at(s, rate)?;
        accelerations.write_at(s, acceleration)?;
        change.copy_from_slice(rate);
        if self.turns.contains(&true) {
            let found = along(values, s, self.length, n)?;
            for (to, (found, _)) in change
                .iter_mut()
                .zip(found.iter().zip(&self.turns))
                .filter(|(_, (_, turns))| **turns)
            {
                *to = *found;
            }
        }
        Ok(all)
    }

    /// What has a reaction, an effort or a force that was not unique.
    pub(super) fn not_unique(&self, scene: &Scene<f64>) -> Vec<String> {
        self.outputs.as_ref().map_or_else(Vec::new, |outputs| outputs.not_unique(scene))
    }
}

/// The derivatives of coordinates along the velocity, by differences of fourth order.
fn along<const D: usize>(
    values: &mut Channels<f64, D>,
    s: &State<f64>,
    length: f64,
    n: usize,
) -> Result<Vec<f64>, StopError> {
    let speed = s.v.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    if speed == 0.0 {
        return Ok(vec![0.0; n]);
    }
    let (h, mut moved) = (WAY * length.min(1.0) / speed, s.clone());
    let mut at = |h: f64| {
        for ((q, q0), v) in moved.q.iter_mut().zip(&s.q).zip(&s.v) {
            *q = q0 + h * v;
        }
        let mut out = vec![0.0; n];
        values.write_at(&moved, &mut out).map(|()| out)
    };
    let [a, b, c, d] = [at(h)?, at(-h)?, at(2.0 * h)?, at(-2.0 * h)?];
    let slope = |i: usize| (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h);
    Ok((0..n).map(slope).collect())
}

/// The coordinates that may be states.
struct Coordinates {
    /// Value, rate and acceleration.
    quantities: Vec<[Output<f64>; 3]>,
    /// Of each component.
    names: Vec<String>,
    turns: Vec<bool>,
    n_of_joints: usize,
}

impl Coordinates {
    /// Those of all joints, then centres of mass and rotations of all bodies.
    fn new(scene: &Scene<f64>) -> Self {
        let mut all =
            Self { quantities: Vec::new(), names: Vec::new(), turns: Vec::new(), n_of_joints: 0 };
        let joints = Scene { outputs: Vec::new(), ..scene.clone() };
        let channels = Channel::of_scene(&joints);
        for (output, channel) in joints.channels().iter().zip(&channels) {
            let Quantity::JointValue { joint } = output.quantity else { continue };
            all.add_joint(scene, joint, channel);
        }
        all.n_of_joints = all.names.len();
        for (b, body) in scene.bodies.iter().enumerate() {
            let (of, at, axes) = (BodyId::Body(b), body.center, ["x", "y", "z"]);
            let n = scene.dimension.count();
            all.quantities.push([
                Output::new(Quantity::Position { body: of, at }),
                Output::new(Quantity::Velocity { body: of, at }),
                Output::new(Quantity::Acceleration { body: of, at }),
            ]);
            all.name(axes[..n].iter().map(|x| format!("{}.{x}", body.name)), false);
            all.quantities.push([
                Output::new(Quantity::RotationVector { body: of }),
                Output::new(Quantity::AngularVelocity { body: of }),
                Output::new(Quantity::AngularAcceleration { body: of }),
            ]);
            let (about, turns) = match scene.dimension {
                Dimension::Planar => (&axes[2..], false),
                Dimension::Spatial => (&axes[..], true),
            };
            all.name(about.iter().map(|x| format!("{}.r{x}", body.name)), turns);
        }
        all
    }

    fn add_joint(&mut self, scene: &Scene<f64>, joint: JointId, channel: &Channel) {
        self.quantities.push([
            Output::new(Quantity::JointValue { joint }),
            Output::new(Quantity::JointRate { joint }),
            Output::new(Quantity::JointAcceleration { joint }),
        ]);
        let freedoms = scene.joints[joint.index()].freedoms(scene.dimension);
        let turns = freedoms.iter().flat_map(|freedom| {
            core::iter::repeat_n(*freedom == Freedom::Ball, freedom.n_coordinates())
        });
        self.turns.extend(turns);
        self.names.extend(channel.columns());
    }

    fn name(&mut self, names: impl Iterator<Item = String>, turns: bool) {
        self.names.extend(names);
        self.turns.resize(self.names.len(), turns);
    }
}

//! Quantities evaluated at each state of a linearisation: outputs, and coordinates and rates of joints and bodies.
//!
//! About a motion, rotation vectors delta are relative to the rotations R_r of that motion, in global axes. R is the rotation of a body.
//! omega and omega_r are the angular velocities of the body and of the reference motion. For a ball joint, delta_1 and delta_2 belong to
//! its first and second body:
//!
//! ```text
//! R = exp(delta) R_r:   delta' = omega - omega_r + omega_r x delta,      of a joint delta_2 - delta_1
//! ```

use super::coordinates::{Ball, Coordinates};
use super::names::OutputColumns;
use crate::channels::Channels;
use crate::stop::StopError;
use mbs_core::algebra::{Matrix, Vector, rotation, rotation_vector};
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{Output, Scene};
use mbs_linear::LinearError;

/// Step of a difference quotient along the velocity, relative to the scene's length [-]. The relative error of a rate is the fourth power
/// of this step.
const WAY: f64 = 1e-3;

/// Indices in a vector of measured values. The order is: outputs, coordinates, rates, derivatives of the coordinates, accelerations.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    /// Indices of the outputs among the components of the measured outputs, and the number of these components.
    outputs: Vec<usize>,
    n_measured: usize,
    /// Names of the coordinates that can be states, coordinates of joints first, and the number of coordinates of joints.
    pub(super) names: Vec<String>,
    pub(super) n_of_joints: usize,
    /// True for each joint coordinate that is part of a vector in body axes: in a ball joint, or in a joint with two translations.
    pub(super) of_vectors: Vec<bool>,
    /// First index and number of components of each vector in global axes: positions and rotations of bodies.
    pub(super) vectors: Vec<[usize; 2]>,
    /// Units of the coordinates.
    pub(super) units: Vec<&'static str>,
}

impl Layout {
    /// Returns a function from the index of a coordinate to its row. `part` selects the rows: 0 coordinates, 1 rates, 2 derivatives of the
    /// coordinates, 3 accelerations.
    pub(super) fn part(&self, part: usize) -> impl Fn(usize) -> usize {
        let start = self.n_measured + part * self.names.len();
        move |coordinate| start + coordinate
    }

    /// Row numbers of the outputs.
    pub(super) fn output_rows(&self) -> impl Iterator<Item = usize> + '_ {
        self.outputs.iter().copied()
    }

    /// Returns the derivatives of the coordinates by each freedom, one row for each coordinate. `of_all` has the derivatives of all
    /// measured values by the first freedom, then by the second, and so on.
    pub(super) fn slopes(&self, of_all: &[f64]) -> Vec<Vec<f64>> {
        let all = self.n_measured + 4 * self.names.len();
        let rows = (0..self.names.len()).map(self.part(0));
        rows.map(|row| of_all.chunks_exact(all.max(1)).map(|of| of[row]).collect()).collect()
    }

    /// Row numbers of the coordinates that are states, then row numbers of their rates.
    pub(super) fn state_rows(&self, chosen: &[usize]) -> impl Iterator<Item = usize> {
        let of = |part| chosen.iter().copied().map(self.part(part));
        of(0).chain(of(1)).collect::<Vec<_>>().into_iter()
    }

    /// Names of the states: coordinates, rates, and states of signals.
    pub(super) fn state_names(&self, chosen: &[usize], of_signals: Vec<String>) -> Vec<String> {
        let names = || chosen.iter().map(|&i| &self.names[i]);
        let rates = names().map(|name| format!("{name}.rate"));
        names().cloned().chain(rates).chain(of_signals).collect()
    }
}

/// Evaluator of outputs and coordinates at a state.
pub(super) struct Measured<const D: usize> {
    pub(super) layout: Layout,
    outputs: Option<Channels<f64, D>>,
    coordinates: Option<[Channels<f64, D>; 3]>,
    /// True for each coordinate of a rotation, whose rate is a component of the angular velocity.
    turns: Vec<bool>,
    /// Index of the first rotation coordinate of each body; then the ball joints, each with its first coordinate and its bodies.
    rotations: Vec<usize>,
    balls: Vec<Ball>,
    /// Motion to which rotations are relative; `None` about an equilibrium.
    reference: Option<Reference>,
    /// The scene's length [m].
    length: f64,
    /// Reason why the last evaluation failed.
    pub(super) stop: Option<StopError>,
}

impl<const D: usize> Measured<D> {
    /// Prepares the measurements of a scene.
    pub(super) fn new(
        scene: &Scene<f64>,
        model: &NaturalModel<f64, D>,
        columns: &OutputColumns,
    ) -> Result<Self, StopError> {
        let channels = |outputs: &[Output<f64>]| {
            let is_none = outputs.is_empty();
            (!is_none).then(|| Channels::of_outputs(outputs, scene, model)).transpose()
        };
        let outputs = channels(&columns.measured)?;
        let n_measured = outputs.as_ref().map_or(0, |outputs| outputs.lengths().sum());
        let coordinates = Coordinates::new(scene);
        let [mut values, mut rates, mut accelerations] = [Vec::new(), Vec::new(), Vec::new()];
        for [value, rate, acceleration] in coordinates.quantities {
            values.push(value);
            rates.push(rate);
            accelerations.push(acceleration);
        }
        let three = [channels(&values)?, channels(&rates)?, channels(&accelerations)?];
        let measured = match three {
            [Some(values), Some(rates), Some(accelerations)] => {
                Some([values, rates, accelerations])
            }
            _ => None,
        };
        let Coordinates {
            names,
            units,
            turns,
            n_of_joints,
            of_vectors,
            vectors,
            rotations,
            balls,
            ..
        } = coordinates;
        let outputs_of = columns.places.clone();
        let layout = Layout {
            outputs: outputs_of,
            n_measured,
            names,
            n_of_joints,
            of_vectors,
            vectors,
            units,
        };
        Ok(Self {
            layout,
            outputs,
            coordinates: measured,
            turns,
            rotations,
            balls,
            reference: None,
            length: model.length(),
            stop: None,
        })
    }

    /// Makes rotations relative to those of the state `s`, if the mechanism moves in this state.
    pub(super) fn count_from(&mut self, s: &State<f64>) -> Result<(), StopError> {
        self.reference = None;
        let is_moving = s.v.iter().any(|v| *v != 0.0);
        let Some([values, rates, _]) = self.coordinates.as_mut().filter(|_| D == 3 && is_moving)
        else {
            return Ok(());
        };
        let [mut value, mut rate] = [0, 1].map(|_| vec![0.0; self.turns.len()]);
        values.write_at(s, &mut value)?;
        rates.write_at(s, &mut rate)?;
        let of = |from: &[f64], at: usize| Vector::from_fn(|i, _| from[at + i]);
        let bodies = self.rotations.iter().map(|&at| (rotation(&of(&value, at)), of(&rate, at)));
        self.reference = Some(Reference { bodies: bodies.collect(), values: value });
        Ok(())
    }

    /// Coordinates of the reference motion. Their rotations are relative to the reference configuration.
    pub(super) fn reference_values(&self) -> Option<&[f64]> {
        self.reference.as_ref().map(|reference| &reference.values[..])
    }

    /// Evaluates all values at a state.
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
        if let Some(reference) = &self.reference {
            reference.count((&self.rotations, &self.balls), (value, rate, change));
        } else if self.turns.contains(&true) {
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

    /// Names of joints, couplings and rolling contacts whose reaction, effort or force was not unique.
    pub(super) fn not_unique(&self, scene: &Scene<f64>) -> Vec<String> {
        self.outputs.as_ref().map_or_else(Vec::new, |outputs| outputs.not_unique(scene))
    }
}

/// Derivatives of the coordinates along the velocity, by difference quotients of fourth order.
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

/// Motion to which rotations are relative.
struct Reference {
    /// Rotation and angular velocity of each body.
    bodies: Vec<(Matrix<f64, 3>, Vector<f64, 3>)>,
    /// Values of all coordinates.
    values: Vec<f64>,
}

impl Reference {
    /// Replaces the rotations of bodies and ball joints by rotations relative to this motion, and computes their derivatives.
    fn count(
        &self,
        (rotations, balls): (&[usize], &[Ball]),
        (value, rate, change): (&mut [f64], &[f64], &mut [f64]),
    ) {
        let of =
            |from: &[f64], at: usize| -> Vector<f64, 3> { Vector::from_fn(|i, _| from[at + i]) };
        let deviation = |(&at, (from, before)): (&usize, &(Matrix<f64, 3>, Vector<f64, 3>))| {
            let turn = rotation(&of(value, at)) * from.transpose();
            [rotation_vector(&turn), of(rate, at) - turn * before]
        };
        let all: Vec<_> = rotations.iter().zip(&self.bodies).map(deviation).collect();
        let mut set = |at: usize, [turn, turns]: [Vector<f64, 3>; 2]| {
            value[at..at + 3].copy_from_slice(turn.as_slice());
            change[at..at + 3].copy_from_slice(turns.as_slice());
        };
        for (&at, &both) in rotations.iter().zip(&all) {
            set(at, both);
        }
        let zero = [Vector::zeros(); 2];
        for &(at, bodies) in balls {
            let [first, second] = bodies.map(|body| body.map_or(zero, |body| all[body]));
            set(at, [second[0] - first[0], second[1] - first[1]]);
        }
    }
}

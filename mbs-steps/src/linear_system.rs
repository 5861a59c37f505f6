//! The linear motion of a mechanism about a state, with inputs and outputs.
//!
//! ```text
//! dx/dt = A x + B u,   y = C x + D u
//! w = (z, z', s):   x = S w + T u,   dx/dt = R w + W u,   y = P w + Q u
//! A = R S^-1,   B = W - A T,   C = P S^-1,   D = Q - C T
//! ```
//!
//! w are coordinates, their rates and the states of signals: x but for rotations, whose rates are angular velocities. S, T, R, W, P and Q are differences of what is measured at states
//! next to it (`mbs_linear::linearise_ports`). T is not zero where a guide is an input: the joints that it moves are states as well.

mod measured;
mod names;
mod shapes;
pub mod solve;
pub mod states;

pub use shapes::ModeShape;

use crate::equilibrium::{Search, workspace};
use crate::erased::SimulationError;
use crate::names::Names;
use crate::placed::{Place, PlacedScene};
use crate::rest::LeftOut;
use crate::stop::StopError;
use crate::tree::Matrix;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{Dimension, Scene};
use mbs_linear::{Equilibrium, Linear, LinearError, LinearOptions, LinearPorts};
use mbs_linear::{Ports, linearise_ports};
use measured::{Layout, Measured};
use names::{InputPlaces, OutputColumns};

/// About which state a mechanism is linearised.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LinearizeOptions {
    /// The state. Default: the static equilibrium near the start.
    pub place: Place,
    /// How the equilibrium is sought. Default: downhill, to a stable one.
    pub search: Search,
}

impl Default for LinearizeOptions {
    fn default() -> Self {
        Self { place: Place::Equilibrium, search: Search::default() }
    }
}

/// dx/dt = A x + B u, y = C x + D u: deviations from a state, in SI units.
///
/// **States** are as many joint coordinates as there are freedoms, the first ones of the scene that are independent: `JOINT`, or `JOINT.1`
/// where a joint has several. Where joints have too few, places of bodies follow: `BODY.x` of the centre of mass and `BODY.rx` of the
/// rotation vector. Then come their rates in the same order (`JOINT.rate`), and the states of signals: `SIGNAL`, or `SIGNAL.integral` of a
/// controller. The rate of a rotation vector is the angular velocity, in global axes; of a joint the second body's against the first.
///
/// **Inputs** that are the value, rate and acceleration of one guide are three inputs, of which each is the derivative of the one before.
///
/// About a rest, and about straight driving, the matrices are constant. Where bodies turn they hold for an instant.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LinearSystem {
    /// Name of the scene.
    pub scene: String,
    /// About which state; of one that was given nothing.
    pub place: Option<Place>,
    /// The equilibrium, if that is the place.
    pub found: Option<Equilibrium<f64>>,
    /// What is left out, of the equilibrium too.
    pub left_out: Vec<LeftOut>,
    /// Names of the states.
    pub states: Vec<String>,
    /// Names of the inputs.
    pub inputs: Vec<String>,
    /// Names of the outputs: the columns of a run.
    pub outputs: Vec<String>,
    /// A, a row for each state.
    pub a: Matrix,
    /// B, a row for each state, a column for each input.
    pub b: Matrix,
    /// C, a row for each output.
    pub c: Matrix,
    /// D, a row for each output, a column for each input.
    pub d: Matrix,
    /// The states at the state itself, from which x counts.
    pub state_values: Vec<f64>,
    /// The inputs there, from which u counts.
    pub input_values: Vec<f64>,
    /// The outputs there, from which y counts.
    pub output_values: Vec<f64>,
    /// Joints, couplings and rollings whose reaction, effort or force is an output and not unique: the smallest is linearised.
    pub not_unique: Vec<String>,
    /// Rounding of squares of eigenvalues [1/s^2]: those of this size are zero.
    noise: f64,
}

impl LinearSystem {
    /// Assembles a scene, seeks its equilibrium if that is the place, and linearises it.
    ///
    /// Cost: that of [`linearise_ports`], and n^3 operations for n states.
    ///
    /// # Errors
    /// As for [`linearize`](crate::linearize).
    pub fn new(
        scene: &Scene<f64>,
        options: &LinearizeOptions,
        inputs: Option<&[&str]>,
        outputs: Option<&[&str]>,
    ) -> Result<Self, SimulationError> {
        let LinearizeOptions { place, search } = *options;
        let asked = Asked { place: Some(place), inputs, outputs };
        let stopped = |error| SimulationError::stopped(error, 0.0, &Names::new(scene));
        match scene.dimension {
            Dimension::Planar => {
                let placed = PlacedScene::<2>::new(scene, place, search);
                asked.system(scene, &placed.map_err(stopped)?)
            }
            Dimension::Spatial => {
                let placed = PlacedScene::<3>::new(scene, place, search);
                asked.system(scene, &placed.map_err(stopped)?)
            }
        }
    }

    /// Linearises a scene whose bodies move as `motions` say, which meet the constraints; angles are next to the scene's initial values.
    ///
    /// # Errors
    /// As for [`linearize_at`](crate::linearize_at).
    pub fn at(
        scene: &Scene<f64>,
        motions: &[RigidMotion<f64>],
        inputs: Option<&[&str]>,
        outputs: Option<&[&str]>,
    ) -> Result<Self, SimulationError> {
        let asked = Asked { place: None, inputs, outputs };
        let stopped = |error| SimulationError::stopped(error, 0.0, &Names::new(scene));
        match scene.dimension {
            Dimension::Planar => {
                let placed = PlacedScene::<2>::given(scene, motions);
                asked.system(scene, &placed.map_err(stopped)?)
            }
            Dimension::Spatial => {
                let placed = PlacedScene::<3>::given(scene, motions);
                asked.system(scene, &placed.map_err(stopped)?)
            }
        }
    }
}

/// What is asked for.
struct Asked<'a> {
    place: Option<Place>,
    inputs: Option<&'a [&'a str]>,
    outputs: Option<&'a [&'a str]>,
}

impl Asked<'_> {
    fn system<const D: usize>(
        &self,
        scene: &Scene<f64>,
        placed: &PlacedScene<D>,
    ) -> Result<LinearSystem, SimulationError> {
        let stopped = |error| SimulationError::stopped(error, 0.0, &Names::new(scene));
        let columns = OutputColumns::new(scene, self.outputs)?;
        let (model, state) = (&placed.ready.model, &placed.ready.start.state);
        let inputs = InputPlaces::new(scene, model, self.inputs)?;
        let mut measured = Measured::new(&placed.scene, model, &columns).map_err(stopped)?;
        let (layout, mut chosen) = (measured.layout.clone(), Vec::new());
        let mut measure = |s: &_| measured.write(s);
        let mut choose = |slopes: &[f64]| {
            let slopes = layout.slopes(slopes);
            chosen = states::choose(&slopes, layout.n_of_joints)?;
            let columns = 0..chosen.len();
            Some(
                columns
                    .flat_map(|j| chosen.iter().map(|&i| slopes[i][j]).collect::<Vec<_>>())
                    .collect(),
            )
        };
        let ports =
            Ports { inputs: &inputs.places, outputs: &mut measure, coordinates: Some(&mut choose) };
        let how = (placed.instant, &LinearOptions::default());
        let found = linearise_ports(model, how, state, &mut workspace(model), ports);
        let (linear, ports) = found.map_err(|error| {
            let of_output = matches!(error, LinearError::Output { .. });
            let stop = measured.stop.take().filter(|_| of_output);
            let stop = stop.unwrap_or(StopError::Linear(error));
            stopped(stop.or_law(model.codes()))
        })?;
        let parts = Parts { linear: &linear, ports: &ports };
        let singular = || stopped(StopError::Linear(LinearError::Singular { freedom: 0 }));
        let [a, b, c, d] = parts.matrices(&layout, &chosen).ok_or_else(singular)?;
        let at = |place: usize| ports.values[place];
        let mut state_values: Vec<f64> = layout.state_rows(&chosen).map(at).collect();
        state_values.extend(state.signals[..linear.signals.n].iter().map(|[value, _]| *value));
        Ok(LinearSystem {
            scene: scene.name.clone(),
            place: self.place,
            found: placed.found,
            left_out: placed.left_out.clone(),
            states: layout.state_names(&chosen, names::signal_states(scene, model)),
            input_values: inputs.places.iter().map(|&place| state.inputs[place]).collect(),
            inputs: inputs.names,
            output_values: layout.output_rows().map(at).collect(),
            not_unique: measured.not_unique(&placed.scene),
            outputs: columns.names,
            a,
            b,
            c,
            d,
            state_values,
            noise: linear.noise,
        })
    }
}

/// The linear motion in tangent coordinates, with what is measured of it.
struct Parts<'a> {
    linear: &'a Linear<f64>,
    ports: &'a LinearPorts<f64>,
}

impl Parts<'_> {
    /// What is measured, by (z, z', s) and by the inputs: [P, Q] of these rows.
    fn of(&self, rows: impl Iterator<Item = usize>) -> [Matrix; 2] {
        let (rows, all) = (rows.collect::<Vec<_>>(), self.ports.values.len());
        let [by_states, by_inputs] = [&self.ports.outputs, &self.ports.feedthrough];
        [(self.linear.order(), by_states), (self.ports.n_inputs, by_inputs)]
            .map(|(n, from)| matrix(rows.len(), n, |i, j| from[j * all + rows[i]]))
    }

    /// A, B, C and D; nothing where the coordinates do not determine the motion.
    fn matrices(&self, layout: &Layout, chosen: &[usize]) -> Option<[Matrix; 4]> {
        let (n, m) = (self.linear.order(), self.ports.n_inputs);
        let first = 2 * self.linear.n_freedoms;
        let (a, b) = (self.linear.state_matrix(), self.ports.input_matrix(first / 2));
        let [mut s, mut t] = self.of(layout.state_rows(chosen));
        let [mut r, mut w] = self.of(layout.rate_rows(chosen));
        for i in first..n {
            s.data.extend((0..n).map(|j| if i == j { 1.0 } else { 0.0 }));
            t.data.extend((0..m).map(|_| 0.0));
            r.data.extend((0..n).map(|j| a[j * n + i]));
            w.data.extend((0..m).map(|j| b[j * n + i]));
        }
        for square in [&mut s, &mut t, &mut r, &mut w] {
            square.rows = n;
        }
        let [p, q] = self.of(layout.output_rows());
        let [a, c] = solve::divided([&r, &p], &s)?;
        let [b, d] = [(&a, w), (&c, q)].map(|(by, mut own)| {
            for i in 0..own.rows {
                for j in 0..m {
                    own[(i, j)] -= (0..n).map(|k| by[(i, k)] * t[(k, j)]).sum::<f64>();
                }
            }
            own
        });
        Some([a, b, c, d])
    }
}

/// A matrix by its entries.
fn matrix(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> f64) -> Matrix {
    let entries = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
    Matrix { rows, columns, data: entries.map(|(i, j)| entry(i, j)).collect() }
}

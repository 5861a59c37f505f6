//! Linear motion about one state. To test whether the motion is steady, it is linearised again a short time later.

use super::data::LinearSystem;
use super::measured::{Layout, Measured};
use super::names::{self, InputPlaces, OutputColumns};
use super::parts::Parts;
use super::states;
use super::steady::{Sizes, Turning, accelerating, changing};
use crate::equilibrium::workspace;
use crate::placed::PlacedScene;
use crate::stop::StopError;
use crate::unsteady::Unsteady;
use mbs_core::model::State;
use mbs_core::scene::Scene;
use mbs_linear::{
    Linear, LinearError, LinearOptions, LinearPorts, Ports, advance, linearise, linearise_ports,
};

/// Axes in which a motion is linearised.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Axes {
    /// Axes that do not turn.
    Standing,
    /// Axes that turn with the motion. A test checks that the motion is steady in these axes.
    Turning,
    /// Axes that turn with the motion if the motion is steady in them. Otherwise axes that do not turn; the linear system then holds at
    /// this instant only.
    TurningOrStanding,
}

/// Scene to be linearised about a state, with its inputs, outputs and axes.
pub(crate) struct About<'a, const D: usize> {
    pub(super) scene: &'a Scene<f64>,
    pub(super) placed: &'a PlacedScene<D>,
    pub(super) columns: OutputColumns,
    pub(super) inputs: InputPlaces,
    pub(super) axes: Axes,
}

/// Measured quantities at a state, and the linear motion about this state.
struct At {
    layout: Layout,
    /// Indices of the coordinates that are states.
    chosen: Vec<usize>,
    linear: Linear<f64>,
    ports: LinearPorts<f64>,
    /// Values of all coordinates, with rotations relative to the reference configuration.
    values: Option<Vec<f64>>,
    not_unique: Vec<String>,
}

impl<'a, const D: usize> About<'a, D> {
    /// Prepares the linearisation of a placed scene without inputs and outputs.
    pub(crate) fn alone(scene: &'a Scene<f64>, placed: &'a PlacedScene<D>, axes: Axes) -> Self {
        let (columns, inputs) = (OutputColumns::default(), InputPlaces::default());
        Self { scene, placed, columns, inputs, axes }
    }

    /// Linearises at the placed state.
    ///
    /// # Errors
    /// [`StopError`] if a measured quantity is not finite, or if the motion cannot be linearised.
    pub(crate) fn system(&self) -> Result<LinearSystem, StopError> {
        let found = self.system_in(self.axes != Axes::Standing)?;
        match (self.axes, &found.unsteady) {
            (Axes::TurningOrStanding, Some(_)) => {
                let unsteady = found.unsteady;
                Ok(LinearSystem { unsteady, ..self.system_in(false)? })
            }
            _ => Ok(found),
        }
    }

    /// Linearises in axes that turn with the motion, or in axes that do not turn.
    fn system_in(&self, turns: bool) -> Result<LinearSystem, StopError> {
        let (scene, placed) = (self.scene, self.placed);
        let (model, state) = (&placed.ready.model, &placed.ready.start.state);
        let at = self.measured((state, turns), None)?;
        let sizes = at.sizes(model.length());
        let is_tested = turns && sizes.has_motion();
        let (layout, chosen) = (&at.layout, &at.chosen[..]);
        let turning = if is_tested {
            Turning::of(&placed.scene, (layout, chosen), (&at.ports.values, &sizes))
        } else {
            Turning::none()
        };
        let [a, b, c, d] = at.matrices(&turning)?;
        let signals = names::signal_states(scene, model);
        let states = layout.state_names(chosen, signals);
        let mut unsteady = at.accelerating(&turning, (&a, &sizes));
        if is_tested && unsteady.is_none() {
            let h = sizes.later();
            let later = advance(model, h, state, &mut workspace(model))
                .map_err(|error| StopError::Linear(error).or_law(model.codes()))?;
            let after = self.measured((&later, turns), Some(chosen))?;
            let turned = turning.after(h);
            let [later, ..] = after.matrices(&turned)?;
            let changed = || changing(&states, [&a, &later], at.linear.noise);
            unsteady = after.accelerating(&turned, (&later, &sizes)).or_else(changed);
        }
        let is_rest = unsteady.is_none() && !sizes.has_motion();
        let rest = is_rest.then(|| at_rest(placed)).transpose()?;
        let rest = rest.filter(|linear| linear.order() == a.rows);
        let value = |place: usize| at.ports.values[place];
        let mut state_values: Vec<f64> = layout.state_rows(chosen).map(value).collect();
        if let Some(values) = &at.values {
            state_values.iter_mut().zip(chosen).for_each(|(to, &i)| *to = values[i]);
        }
        let of_signals = &state.signals[..at.linear.signals.n];
        state_values.extend(of_signals.iter().map(|[value, _]| *value));
        Ok(LinearSystem {
            scene: scene.name.clone(),
            place: None,
            found: placed.found,
            left_out: placed.left_out.clone(),
            states,
            input_values: self.inputs.places.iter().map(|&place| state.inputs[place]).collect(),
            inputs: self.inputs.names.clone(),
            output_values: layout.output_rows().map(value).collect(),
            not_unique: at.not_unique.clone(),
            outputs: self.columns.names.clone(),
            a,
            b,
            c,
            d,
            state_values,
            unsteady,
            turning: at.linear.turning,
            n_freedoms: at.linear.n_freedoms,
            noise: rest.as_ref().map_or(at.linear.noise, |linear| linear.noise),
            rest: rest.map(|linear| linear.state_matrix()),
        })
    }

    /// Linearises about the state `state`. The states of the linear system are the coordinates `given`. If `given` is `None`, they are
    /// chosen here, for axes that turn or do not turn.
    fn measured(
        &self,
        (state, turns): (&State<f64>, bool),
        given: Option<&[usize]>,
    ) -> Result<At, StopError> {
        let (scene, model) = (&self.placed.scene, &self.placed.ready.model);
        let mut measured = Measured::new(scene, model, &self.columns)?;
        measured.count_from(state)?;
        let layout = measured.layout.clone();
        let is_moving = state.v.iter().any(|v| *v != 0.0);
        let mut chosen = given.unwrap_or_default().to_vec();
        let mut choose = |slopes: &[f64]| {
            let mut slopes = layout.slopes(slopes);
            if turns && is_moving {
                let rows = slopes.iter_mut().zip(&layout.of_vectors);
                rows.filter(|(_, is)| **is).for_each(|(row, _)| row.fill(0.0));
            }
            if given.is_none() {
                chosen = states::choose(&slopes, layout.n_of_joints)?;
            }
            let columns = 0..chosen.len();
            let column = |j: usize| chosen.iter().map(|&i| slopes[i][j]).collect::<Vec<_>>();
            Some(columns.flat_map(column).collect())
        };
        let mut measure = |s: &_| measured.write(s);
        let ports = Ports {
            inputs: &self.inputs.places,
            outputs: &mut measure,
            coordinates: Some(&mut choose),
        };
        let how = (self.placed.instant, &LinearOptions::default());
        let found = linearise_ports(model, how, state, &mut workspace(model), ports);
        let (linear, ports) = found.map_err(|error| {
            let of_output = matches!(error, LinearError::Output { .. });
            let stop = measured.stop.take().filter(|_| of_output);
            stop.unwrap_or(StopError::Linear(error)).or_law(model.codes())
        })?;
        let values = measured.reference_values().map(<[f64]>::to_vec);
        let not_unique = measured.not_unique(scene);
        Ok(At { layout, chosen, linear, ports, values, not_unique })
    }
}

/// Linear motion about an equilibrium, in tangent coordinates, which have no names. These coordinates are well conditioned, so the
/// eigenvalues are accurate.
///
/// # Errors
/// [`StopError`] if the motion cannot be linearised.
pub(crate) fn at_rest<const D: usize>(placed: &PlacedScene<D>) -> Result<Linear<f64>, StopError> {
    let (model, state) = (&placed.ready.model, &placed.ready.start.state);
    let how = (placed.instant, &LinearOptions::default());
    linearise(model, how, state, &mut workspace(model))
        .map_err(|error| StopError::Linear(error).or_law(model.codes()))
}

impl At {
    /// Computes A, B, C and D in the given axes.
    fn matrices(&self, turning: &Turning) -> Result<[crate::tree::Matrix; 4], StopError> {
        let parts = Parts { linear: &self.linear, ports: &self.ports };
        let singular = || StopError::Linear(LinearError::Singular { freedom: 0 });
        parts.matrices(&self.layout, &self.chosen, turning).ok_or_else(singular)
    }

    /// Returns the reference sizes for accelerations.
    fn sizes(&self, length: f64) -> Sizes {
        let mut sizes = Sizes { length, rate: 0.0, lively: self.linear.lively };
        let rates = self.layout.part(1);
        let of = |i: usize| self.ports.values[rates(i)].abs() / sizes.of(self.layout.units[i]);
        sizes.rate = (0..self.layout.names.len()).map(of).fold(0.0, f64::max);
        sizes
    }

    /// Returns the state with the largest acceleration in the given axes, relative to its limit; `None` if no acceleration exceeds its
    /// limit.
    fn accelerating(
        &self,
        turning: &Turning,
        of: (&crate::tree::Matrix, &Sizes),
    ) -> Option<Unsteady> {
        let states = (&self.layout, &self.chosen[..]);
        accelerating(states, (turning, &self.ports.values), of)
    }
}

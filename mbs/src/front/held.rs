//! Values at which the inputs of a mechanism begin.

use super::failure::SimulationError;
use super::inputs::{InputInfo, InputOwner};
use super::mechanism::Mechanism;
use crate::erased::input_table::InputTable;
use mbs_core::effects::Value;
use mbs_core::scene::{Effect, Motion, Number, Signal, SignalKind};

impl Mechanism {
    /// Sets the values at which the inputs begin, in the order of [`inputs`](Self::inputs). Each simulation, equilibrium or linearisation
    /// made afterwards starts with these values.
    ///
    /// # Errors
    /// [`SimulationError`] for a wrong number of values, for a value that is not finite, and for the errors of [`inputs`](Self::inputs). No
    /// input is set then.
    ///
    /// # Examples
    /// A level bar of 2 kg, whose centre of mass is at 0.5 m, is held by the torque of a motor:
    /// ```
    /// use mbs::{Body, Effect, GROUND, Joint, Mechanism, Signal};
    /// let mut m = Mechanism::planar("held bar");
    /// m.set_gravity([0.0, -9.81]);
    /// let bar = m.add(Body::planar([0.5, 0.0], 2.0, 0.1));
    /// let pivot = m.add(Joint::revolute([GROUND, bar], [0.0, 0.0]));
    /// m.add(Effect::torque(pivot, Signal::input(0.0)));
    /// m.set_inputs(&[2.0 * 9.81 * 0.5])?;
    /// assert!(m.tree()?.accelerations()?[0].abs() < 1e-12);
    /// # Ok::<(), mbs::SimulationError>(())
    /// ```
    pub fn set_inputs(&mut self, values: &[f64]) -> Result<&mut Self, SimulationError> {
        let inputs = self.inputs()?;
        check(&inputs, values)?;
        let scene = self.scene_mut();
        for (info, value) in inputs.iter().zip(values) {
            let (value, i) = (Number::from(*value), info.component);
            match info.owner {
                InputOwner::Effect(effect) => set_effect(&mut scene.effects[effect], i, &value),
                InputOwner::Guide(guide) => {
                    if let Motion::Input(start) = &mut scene.guides[guide].law {
                        start[i] = value;
                    }
                }
                InputOwner::Coupling { coupling, .. } => {
                    if let Some(Motion::Input(start)) = &mut scene.couplings[coupling].motion {
                        start[i] = value;
                    }
                }
                InputOwner::Signal(signal) => {
                    if let SignalKind::Input { value: start, .. } = &mut scene.signals[signal].kind
                    {
                        *start = value;
                    }
                }
                _ => {
                    let message = format!("the start of input `{}` cannot be set", info.name);
                    return Err(SimulationError::new("input-refused", message, "leave it out"));
                }
            }
        }
        Ok(self)
    }
}

impl Mechanism {
    /// Returns a copy of the mechanism whose inputs follow a table over time. Values between two times of the table are interpolated
    /// linearly. Outside the table, its first or last value holds. A guide or a coupling follows the cubic spline through the values instead.
    ///
    /// # Errors
    /// [`SimulationError`] for a table that is refused, and for the errors of [`inputs`](Self::inputs).
    pub fn following(&self, table: &InputTable) -> Result<Self, SimulationError> {
        let inputs = self.inputs()?;
        let mut driven = self.clone();
        table.put_into(driven.scene_mut(), &inputs)?;
        Ok(driven)
    }
}

/// Checks that the number of values is the number of inputs, and that all values are finite.
fn check(inputs: &[InputInfo], values: &[f64]) -> Result<(), SimulationError> {
    let names = || inputs.iter().map(|info| info.name.as_str()).collect::<Vec<_>>().join(", ");
    if inputs.len() != values.len() {
        let message = format!("{} values for {} inputs", values.len(), inputs.len());
        let hint = format!("give a value for each of: {}", names());
        return Err(SimulationError::new("input-refused", message, hint));
    }
    let bad = inputs.iter().zip(values).find(|(_, value)| !value.is_finite());
    bad.map_or(Ok(()), |(info, value)| {
        let message = format!("input `{}` is {value}", info.name);
        Err(SimulationError::new("input-refused", message, "give a finite number"))
    })
}

/// Sets one component of the signal input of an effect.
fn set_effect(effect: &mut Effect<Number>, component: usize, value: &Number) {
    let values = effect.kind.values().into_iter().map(|old| match old {
        Value::Signal(Signal::Input(mut start)) => {
            start[component] = value.clone();
            Value::Signal(Signal::Input(start))
        }
        other => other,
    });
    if let Some(kind) = effect.kind.with(values) {
        effect.kind = kind;
    }
}

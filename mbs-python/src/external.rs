//! External forces: by the name of a frame or body a force and a moment, in global axes, at the frame's origin.

use crate::array::Numbers;
use crate::error::{Class, guarded, raised, usage};
use crate::forces::{External, Forces, parts};
use crate::import::Read;
use crate::mechanism::Mechanism;
use crate::value;
use mbs::core::scene::{Dimension, Effect, Number, Signal};
use mbs::{BodyId, SimulationError, Tree};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Hint for an argument of external forces.
const HINT: &str = "give {NAME: (force, moment)}, three numbers each, by names of frames or bodies";

/// Adds what forces do along the velocities: Jᵀ (f, m).
pub(crate) fn add_efforts(tree: &mut Tree, given: &[External], efforts: &mut [f64]) {
    for External { body, at, wrench, .. } in given {
        let jacobian = tree.jacobian_at(*body, *at);
        for (row, x) in wrench.iter().enumerate() {
            efforts.iter_mut().zip(jacobian.row(row)).for_each(|(to, j)| *to += j * x);
        }
    }
}

impl Mechanism {
    /// The forces of an argument, without one none.
    pub(crate) fn external(
        &self,
        py: Python<'_>,
        f_ext: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Vec<External>> {
        let Some(f_ext) = f_ext else { return Ok(Vec::new()) };
        let one = |(name, value): (String, Bound<'_, PyAny>)| {
            let (body, at) = self.force_place(py, &name)?;
            Ok(External { body, at, wrench: self.wrench(&value)?, name })
        };
        value::items(f_ext, "f_ext", HINT)?.into_iter().map(one).collect()
    }

    /// Body and place of a frame, which must move.
    fn force_place(&self, py: Python<'_>, name: &str) -> PyResult<(BodyId, [f64; 3])> {
        let place = self.first(py)?.frame_place(name);
        let (body, at) = place.map_err(|_| self.no_frame(py, ("f_ext", name)))?;
        if body == BodyId::Ground {
            let message = format!("`{name}` is on the ground, which no force moves");
            return Err(usage(py, "usage", &message, "name a frame of a body", "f_ext"));
        }
        Ok((body, at))
    }

    /// A force and a moment: a pair of vectors, or six numbers.
    fn wrench(&self, value: &Bound<'_, PyAny>) -> PyResult<[f64; 6]> {
        let py = value.py();
        let wrong = || usage(py, "wrong-shape", "f_ext is no force and moment", HINT, "f_ext");
        let numbers = |value: &Bound<'_, PyAny>| {
            let numbers = Numbers::new(value, "f_ext", false)?;
            numbers.check_finite(py, "f_ext")?;
            Ok::<_, PyErr>(numbers.into_data())
        };
        if value.len().ok() == Some(2) {
            let (force, moment) = (numbers(&value.get_item(0)?)?, numbers(&value.get_item(1)?)?);
            let is_planar = self.shared.scene.dimension == Dimension::Planar;
            return match (&force[..], &moment[..]) {
                (&[a, b, c], &[d, e, f]) => Ok([a, b, c, d, e, f]),
                (&[a, b], &[f]) if is_planar => Ok([a, b, 0.0, 0.0, 0.0, f]),
                _ => Err(wrong()),
            };
        }
        numbers(value)?.try_into().map_err(|_| wrong())
    }
}

#[pymethods]
impl Mechanism {
    /// The mechanism with forces and moments on frames or bodies as inputs `NAME.force.x` ... `NAME.moment.z`: its simulations take `f_ext`
    /// in their steps. `u` may then have the inputs of this mechanism alone.
    #[pyo3(signature = (*names))]
    fn with_forces(&self, py: Python<'_>, names: Vec<String>) -> PyResult<Self> {
        let mut mechanism = self.shared.mechanism.clone();
        for name in &names {
            let (body, at) = self.force_place(py, name)?;
            let at = at.map(Number::from);
            let input = || Signal::Input(core::array::from_fn(|_| Number::from(0.0)));
            mechanism.add(Effect::force(body, at, input()).named(&format!("{name}.force")));
            mechanism.add(Effect::body_torque(body, input()).named(&format!("{name}.moment")));
        }
        let file = mechanism.to_file().map_err(SimulationError::from);
        let file = file.map_err(|error| raised(py, &error, Class::Scene))?;
        let of_effects = |info: &&mbs::InputInfo| matches!(info.owner, mbs::InputOwner::Effect(_));
        let first = self.shared.inputs.iter().filter(of_effects).count();
        let parts = parts(self.shared.scene.dimension);
        let folder = self.shared.folder.clone();
        let read = Read { file, folder, model: self.shared.model.clone() };
        guarded(py, || Self::with(py, read, Forces { names, first, parts }))
    }

    /// For rollouts under forces: values at which inputs begin, places of those that are no forces, and those of each force.
    fn _force_inputs<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Vec<f64>, Vec<usize>, Bound<'py, PyDict>)> {
        let (inputs, forces) = (&self.shared.inputs, &self.shared.forces);
        let (range, n) = (forces.range(), forces.parts.len());
        let places = PyDict::new(py);
        for (k, name) in forces.names.iter().enumerate() {
            let first = forces.first + k * n;
            places
                .set_item(name, ((first..first + n).collect::<Vec<_>>(), forces.parts.to_vec()))?;
        }
        let own = (0..inputs.len()).filter(|i| !range.contains(i)).collect();
        Ok((inputs.iter().map(|info| info.start).collect(), own, places))
    }
}

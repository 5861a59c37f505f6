//! Readings of a simulation by name: outputs, joints, bodies, forces.

use crate::array::{array, vector};
use crate::error::{Class, raised, unknown_name, usage};
use crate::mechanism::{pair, pose};
use crate::simulation::Simulation;
use pyo3::prelude::*;

#[pymethods]
impl Simulation {
    /// The components of an output of the scene, or the number of a column.
    fn output<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let shared = &self.this().shared;
        let of = |column: &str| {
            column == name || column.strip_prefix(name).is_some_and(|rest| rest.starts_with('.'))
        };
        let places: Vec<usize> =
            (0..shared.columns.len()).filter(|&i| of(&shared.columns[i][0])).collect();
        if places.is_empty() {
            let known: Vec<&str> = shared.columns.iter().map(|[name, _]| name.as_str()).collect();
            return Err(unknown_name(py, ["output", "outputs"], ("name", name), &known));
        }
        let moving = self.moving(py)?;
        let mut row = vec![0.0; moving.simulation.n_outputs()];
        let written = moving.simulation.write_outputs(&mut row);
        written.map_err(|error| raised(py, &error, Class::Stop))?;
        let values: Vec<f64> = places.into_iter().filter_map(|i| row.get(i).copied()).collect();
        Ok(vector(py, &values))
    }

    /// The first coordinate of a joint from the reference configuration, turns counted [rad, m].
    fn value(&self, py: Python<'_>, joint: &str) -> PyResult<f64> {
        let id = self.this().joint(py, joint)?;
        let values = self.moving(py)?.simulation.values(id);
        values.first().copied().ok_or_else(|| {
            usage(py, "no-coordinates", "the joint has no coordinates", "ask for another", "joint")
        })
    }

    /// All coordinates of a joint [rad, m].
    fn values<'py>(&self, py: Python<'py>, joint: &str) -> PyResult<Bound<'py, PyAny>> {
        let joint = self.this().joint(py, joint)?;
        Ok(vector(py, &self.moving(py)?.simulation.values(joint)))
    }

    /// Their rates; of a ball the relative angular velocity in global axes.
    fn rates<'py>(&self, py: Python<'py>, joint: &str) -> PyResult<Bound<'py, PyAny>> {
        let joint = self.this().joint(py, joint)?;
        Ok(vector(py, &self.moving(py)?.simulation.rates(joint)))
    }

    /// Force [N] and moment [N m] of the first body of a joint on the second, at its place on the second.
    fn reaction<'py>(
        &self,
        py: Python<'py>,
        joint: &str,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let joint = self.this().joint(py, joint)?;
        let wrench = self.moving(py)?.simulation.reaction(joint);
        let wrench = wrench.map_err(|error| raised(py, &error, Class::Stop))?;
        Ok(pair(py, [wrench.force, wrench.moment]))
    }

    /// Force [N] and moment [N m] of an effect.
    fn effect_force<'py>(
        &self,
        py: Python<'py>,
        effect: &str,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let effect = self.this().effect(py, effect)?;
        let wrench = self.moving(py)?.simulation.effect_force(effect);
        let wrench = wrench.map_err(|error| raised(py, &error, Class::Stop))?;
        Ok(pair(py, [wrench.force, wrench.moment]))
    }

    /// Centre of mass (3,) of a body, and its rotation (3, 3) from the reference configuration.
    fn pose<'py>(
        &self,
        py: Python<'py>,
        body: &str,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let body = self.this().body(py, body)?;
        pose(py, &self.moving(py)?.simulation.pose(body))
    }

    /// Position, velocity and acceleration (3, 3) of a point of a body, which is at `at` in the reference configuration.
    fn point<'py>(
        &self,
        py: Python<'py>,
        body: &str,
        at: &Bound<'_, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let body = self.this().body(py, body)?;
        let at = self.this().point(at)?;
        let point = self.moving(py)?.simulation.point(body, at);
        let rows = [point.position, point.velocity, point.acceleration];
        array(py, rows.into_iter().flatten().collect(), &[3, 3])
    }

    /// Kinetic energy, potential energy, and work of dampers, guides and inputs since the start [J].
    fn energies(&self, py: Python<'_>) -> PyResult<(f64, f64, f64)> {
        let energies = self.moving(py)?.simulation.energies();
        Ok((energies.kinetic, energies.potential, energies.work))
    }
}

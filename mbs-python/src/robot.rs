//! Quantities of a mechanism at a state, or at many.

use crate::array::{Numbers, array, point, vector, wrong_shape};
use crate::error::{Class, raised, unknown_name, usage};
use crate::external::add_efforts;
use crate::mechanism::{Mechanism, pose};
use crate::values;
use mbs::{FrameTarget, InverseKinematicsEnd, Matrix, Tree, TreeError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

fn copy(matrix: &Matrix, out: &mut [f64]) {
    out.copy_from_slice(&matrix.data);
}

#[pymethods]
impl Mechanism {
    /// Accelerations (nv,) under all effects and inputs `u` (nu,), signals as they begin. All arguments are of one state, or of k states.
    /// `f_ext` are forces and moments on frames or bodies, {NAME: (force, moment)}: global axes, at the origin of the frame.
    #[pyo3(signature = (q, v, u = None, *, time = 0.0, f_ext = None, strict = false))]
    #[allow(clippy::too_many_arguments, reason = "they are keywords of Python")]
    fn accelerations<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        u: Option<&Bound<'py, PyAny>>,
        time: f64,
        f_ext: Option<&Bound<'py, PyAny>>,
        strict: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let external = self.external(py, f_ext)?;
        let ([nq, nv], nu) = (self.sizes(py)?, self.shared.inputs.len());
        if !time.is_finite() {
            let message = format!("time is {time}");
            return Err(usage(py, "not-finite", &message, "give a finite number", "time"));
        }
        let mut arguments = vec![(q, "q", nq), (v, "v", nv)];
        arguments.extend(u.map(|u| (u, "u", nu)));
        let has_inputs = u.is_some();
        self.each(py, (&arguments, strict), &[nv], |tree, x, out| {
            tree.set_time(time);
            tree.set(x[0], x[1])?;
            if has_inputs {
                tree.set_inputs(x[2])?;
            }
            out.copy_from_slice(tree.accelerations()?);
            if !external.is_empty() {
                // accelerations are linear in efforts
                let mut efforts = vec![0.0; out.len()];
                let without = tree.forward_dynamics(&efforts)?.to_vec();
                add_efforts(tree, &external, &mut efforts);
                let with = tree.forward_dynamics(&efforts)?.iter().zip(&without);
                out.iter_mut().zip(with).for_each(|(to, (with, without))| *to += with - without);
            }
            Ok(())
        })
        .map_err(|error| self.about_inputs(py, error))
    }

    /// Accelerations (nv,) under efforts along v, gravity and `f_ext` alone, loops closed.
    #[pyo3(signature = (q, v, effort, *, f_ext = None, strict = false))]
    #[allow(clippy::too_many_arguments, reason = "they are keywords of Python")]
    fn forward_dynamics<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        effort: &Bound<'py, PyAny>,
        f_ext: Option<&Bound<'py, PyAny>>,
        strict: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let external = self.external(py, f_ext)?;
        let [nq, nv] = self.sizes(py)?;
        let arguments = [(q, "q", nq), (v, "v", nv), (effort, "effort", nv)];
        self.each(py, (&arguments, strict), &[nv], |tree, x, out| {
            tree.set(x[0], x[1])?;
            out.copy_from_slice(x[2]);
            add_efforts(tree, &external, out);
            let efforts = out.to_vec();
            out.copy_from_slice(tree.forward_dynamics(&efforts)?);
            Ok(())
        })
    }

    /// Efforts (nv,) that make accelerations `a`: M a + bias, less what `f_ext` does.
    #[pyo3(signature = (q, v, a, *, f_ext = None, strict = false))]
    #[allow(clippy::too_many_arguments, reason = "they are keywords of Python")]
    fn inverse_dynamics<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        a: &Bound<'py, PyAny>,
        f_ext: Option<&Bound<'py, PyAny>>,
        strict: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let external = self.external(py, f_ext)?;
        let [nq, nv] = self.sizes(py)?;
        let arguments = [(q, "q", nq), (v, "v", nv), (a, "a", nv)];
        self.each(py, (&arguments, strict), &[nv], |tree, x, out| {
            tree.set(x[0], x[1])?;
            let mut pushed = vec![0.0; out.len()];
            add_efforts(tree, &external, &mut pushed);
            let efforts = tree.inverse_dynamics(x[2])?.iter().zip(&pushed);
            out.iter_mut().zip(efforts).for_each(|(to, (effort, pushed))| *to = effort - pushed);
            Ok(())
        })
    }

    /// Mass matrix (nv, nv), loops open.
    #[pyo3(signature = (q, *, strict = false))]
    fn mass_matrix<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        strict: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let nv = self.sizes(py)?[1];
        self.at_rest(py, (q, strict), &[nv, nv], |tree, out| copy(tree.mass_matrix(), out))
    }

    /// Efforts (nv,) that keep all velocities as they are: centrifugal and Coriolis forces, and gravity.
    #[pyo3(signature = (q, v, *, strict = false))]
    fn bias<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        strict: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let nv = self.sizes(py)?[1];
        self.moving(py, ([q, v], strict), &[nv], |tree, out| {
            out.copy_from_slice(tree.bias_forces());
        })
    }

    /// Efforts (nv,) that hold the mechanism at rest against gravity.
    #[pyo3(signature = (q, *, strict = false))]
    fn gravity<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        strict: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let nv = self.sizes(py)?[1];
        self.at_rest(py, (q, strict), &[nv], |tree, out| {
            out.copy_from_slice(tree.gravity_forces());
        })
    }

    /// Jacobian (6, nv) of a frame's origin by (frame, q), of a point that moves with a body or a frame by (name, at, q), which is at `at` in
    /// the reference configuration: linear, then angular, global axes.
    #[pyo3(signature = (body, at = None, q = None, *, strict = false))]
    fn jacobian<'py>(
        &self,
        py: Python<'py>,
        body: &str,
        at: Option<&Bound<'py, PyAny>>,
        q: Option<&Bound<'py, PyAny>>,
        strict: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let nv = self.sizes(py)?[1];
        let Some(last) = q.or(at) else {
            return Err(usage(py, "missing", "q is missing", "give the coordinates", "q"));
        };
        let (q, at) = (last, at.filter(|_| q.is_some()));
        let place = self.first(py)?.frame_place(body);
        let (body, at) = match at {
            Some(at) => {
                let body = place.map_or_else(|_| self.body(py, body), |(body, _)| Ok(body))?;
                (body, self.point(at)?)
            }
            None => place.map_err(|_| self.no_frame(py, ("frame", body)))?,
        };
        self.at_rest(py, (q, strict), &[6, nv], |tree, out| copy(tree.jacobian_at(body, at), out))
    }

    /// Jacobian (rows, nv) of the joints that close loops.
    #[pyo3(signature = (q, *, strict = false))]
    fn loop_jacobian<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        strict: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let nv = self.sizes(py)?[1];
        let rows = self.with_tree(py, |tree| tree.loop_jacobian().rows)?;
        self.at_rest(py, (q, strict), &[rows, nv], |tree, out| copy(tree.loop_jacobian(), out))
    }

    /// Kinetic energy, and potential energy of gravity, constant forces and springs [J].
    fn energies<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let both = self.moving(py, ([q, v], false), &[2], |tree, out| {
            out.copy_from_slice(&tree.energies());
        })?;
        let columns = both.getattr("T")?;
        PyTuple::new(py, [columns.get_item(0)?, columns.get_item(1)?])
    }

    /// Linear momentum [kg m/s], and angular momentum about the centre of mass [kg m^2/s], (3,) each.
    fn momentum<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let all = self.moving(py, ([q, v], false), &[2, 3], |tree, out| {
            let momentum = tree.momentum();
            out[..3].copy_from_slice(&momentum.linear);
            out[3..].copy_from_slice(&momentum.angular);
        })?;
        let first = |i: usize| {
            let ellipsis = py.import("builtins")?.getattr("Ellipsis")?;
            all.get_item((ellipsis, i, pyo3::types::PySlice::full(py)))
        };
        PyTuple::new(py, [first(0)?, first(1)?])
    }

    /// Centre of mass (3,) of a body, and its rotation (3, 3) from the reference configuration.
    fn pose<'py>(
        &self,
        py: Python<'py>,
        body: &str,
        q: &Bound<'py, PyAny>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let (body, q) = (self.body(py, body)?, self.coordinates_of(q)?);
        let at_rest = vec![0.0; self.sizes(py)?[1]];
        let found = self.with_tree(py, |tree| {
            tree.set(&q, &at_rest)?;
            Ok::<_, TreeError>(tree.pose(body))
        })?;
        pose(py, &found.map_err(|error| raised(py, &error.into(), Class::Usage))?)
    }

    /// Centre of mass (3,) of all bodies.
    #[pyo3(signature = (q))]
    fn center_of_mass<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.at_rest(py, (q, false), &[3], |tree, out| {
            out.copy_from_slice(&tree.center_of_mass().position);
        })
    }

    /// A frame at a state: position (3,), rotation (3, 3), velocity (3,), angular_velocity (3,), in global axes; of a body without a frame of
    /// its name the centre of mass.
    #[pyo3(signature = (name, q, v = None))]
    fn frame<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        q: &Bound<'py, PyAny>,
        v: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let q = self.coordinates_of(q)?;
        let n = self.sizes(py)?[1];
        let v = v.map_or_else(|| Ok(vec![0.0; n]), |v| Numbers::row(v, "v", n))?;
        let found = self.with_tree(py, |tree| {
            tree.set(&q, &v)?;
            Ok::<_, TreeError>(tree.frame(name).ok())
        })?;
        let found = found.map_err(|error| raised(py, &error.into(), Class::Usage))?;
        let Some(frame) = found else { return Err(self.no_frame(py, ("name", name))) };
        let dict = PyDict::new(py);
        dict.set_item("position", vector(py, &frame.position))?;
        let rotation = frame.rotation.iter().flatten().copied().collect();
        dict.set_item("rotation", array(py, rotation, &[3, 3])?)?;
        dict.set_item("velocity", vector(py, &frame.velocity))?;
        dict.set_item("angular_velocity", vector(py, &frame.angular_velocity))?;
        Ok(dict)
    }

    /// Derivatives of `forward_dynamics` by q, v and effort, (nv, nv) each. Those by q are by moves along v.
    fn forward_derivatives<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        effort: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.derivatives(py, [q, v, effort], "effort", |tree, x| {
            let d = tree.forward_dynamics_derivatives(x)?;
            Ok([&d.q, &d.v, &d.effort])
        })
    }

    /// Derivatives of `inverse_dynamics` by q, v and a, (nv, nv) each. Those by q are by moves along v.
    fn inverse_derivatives<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        v: &Bound<'py, PyAny>,
        a: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.derivatives(py, [q, v, a], "a", |tree, x| {
            let d = tree.inverse_dynamics_derivatives(x)?;
            Ok([&d.q, &d.v, &d.acceleration])
        })
    }

    /// q moved by `step` (nv,) along the velocities.
    fn integrate<'py>(
        &self,
        py: Python<'py>,
        q: &Bound<'py, PyAny>,
        step: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let [nq, nv] = self.sizes(py)?;
        self.each(py, (&[(q, "q", nq), (step, "step", nv)], false), &[nq], |tree, x, out| {
            tree.integrate(x[0], x[1], out)
        })
    }

    /// The step (nv,) that moves q0 to q1; rotations by the shorter way.
    fn difference<'py>(
        &self,
        py: Python<'py>,
        q0: &Bound<'py, PyAny>,
        q1: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let [nq, nv] = self.sizes(py)?;
        self.each(py, (&[(q0, "q0", nq), (q1, "q1", nq)], false), &[nv], |tree, x, out| {
            tree.difference(x[0], x[1], out)
        })
    }

    /// Coordinates (nq,) in which a frame is at a position (3,) with a rotation (3, 3), from `q` on; of a body without a frame of its name it is
    /// the centre of mass. What is left out is free; loops stay closed.
    #[pyo3(signature = (frame, q = None, *, position = None, rotation = None))]
    fn inverse_kinematics<'py>(
        &self,
        py: Python<'py>,
        frame: &str,
        q: Option<&Bound<'py, PyAny>>,
        position: Option<&Bound<'py, PyAny>>,
        rotation: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let first = self.first(py)?;
        first.frame_place(frame).map_err(|_| self.no_frame(py, ("frame", frame)))?;
        let start =
            q.map_or_else(|| Ok(first.coordinates().to_vec()), |q| self.coordinates_of(q))?;
        let position = position.map(|x| Numbers::row(x, "position", 3)).transpose()?;
        let rotation = rotation.map(rows).transpose()?;
        let target = FrameTarget { position: position.map(|x| [x[0], x[1], x[2]]), rotation };
        let at_rest = vec![0.0; first.velocities().len()];
        let found = self.with_tree(py, |tree| {
            py.detach(|| {
                tree.set(&start, &at_rest)?;
                let found = tree.inverse_kinematics_of(frame, &target)?;
                Ok::<_, TreeError>((found, tree.coordinates().to_vec()))
            })
        })?;
        let (found, q) = found.map_err(|error| raised(py, &error.into(), Class::Usage))?;
        if found.end != InverseKinematicsEnd::Reached {
            // zero without a sign
            let (distance, angle) = (found.distance + 0.0, found.angle + 0.0);
            let message = format!(
                "`{frame}` stays {distance:.3e} m and {angle:.3e} rad away from its target"
            );
            let hint = "give a target within reach, or begin from another q";
            return Err(usage(py, "not-reached", &message, hint, "position"));
        }
        Ok(vector(py, &q))
    }
}

/// Three rows of three numbers.
fn rows(value: &Bound<'_, PyAny>) -> PyResult<[[f64; 3]; 3]> {
    let numbers = Numbers::new(value, "rotation", false)?;
    match (numbers.shape(), numbers.slice()) {
        ([3, 3], &[a, b, c, d, e, f, g, h, i]) => Ok([[a, b, c], [d, e, f], [g, h, i]]),
        (shape, _) => Err(wrong_shape(value.py(), "rotation", shape, "(3, 3)")),
    }
}

impl Mechanism {
    /// Evaluates numbers of coordinates alone, of one state or of many.
    fn at_rest<'py>(
        &self,
        py: Python<'py>,
        (q, strict): (&Bound<'py, PyAny>, bool),
        shape: &[usize],
        one: impl Fn(&mut Tree, &mut [f64]) + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        let [nq, nv] = self.sizes(py)?;
        let at_rest = vec![0.0; nv];
        self.each(py, (&[(q, "q", nq)], strict), shape, |tree, x, out| {
            tree.set(x[0], &at_rest)?;
            one(tree, out);
            Ok(())
        })
    }

    /// Evaluates numbers of coordinates and velocities, of one state or of many.
    fn moving<'py>(
        &self,
        py: Python<'py>,
        ([q, v], strict): ([&Bound<'py, PyAny>; 2], bool),
        shape: &[usize],
        one: impl Fn(&mut Tree, &mut [f64]) + Sync,
    ) -> PyResult<Bound<'py, PyAny>> {
        let [nq, nv] = self.sizes(py)?;
        self.each(py, (&[(q, "q", nq), (v, "v", nv)], strict), shape, |tree, x, out| {
            tree.set(x[0], x[1])?;
            one(tree, out);
            Ok(())
        })
    }

    /// The three derivatives of one kind of dynamics, of one state or of many.
    fn derivatives<'py>(
        &self,
        py: Python<'py>,
        [q, v, third]: [&Bound<'py, PyAny>; 3],
        name: &str,
        of: for<'t> fn(&'t mut Tree, &[f64]) -> Result<[&'t Matrix; 3], TreeError>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let [nq, nv] = self.sizes(py)?;
        let arguments = [(q, "q", nq), (v, "v", nv), (third, name, nv)];
        let all = self.each(py, (&arguments, false), &[3, nv, nv], |tree, x, out| {
            tree.set(x[0], x[1])?;
            let parts = of(tree, x[2])?;
            out.chunks_exact_mut((nv * nv).max(1)).zip(parts).for_each(|(to, from)| copy(from, to));
            Ok(())
        })?;
        derivatives(&all)
    }

    /// Refuses the name of a frame.
    pub(crate) fn no_frame(&self, py: Python<'_>, of: (&str, &str)) -> PyErr {
        let scene = &self.shared.scene;
        let frames = scene.frames.iter().map(|frame| frame.name.as_str());
        let known: Vec<&str> =
            frames.chain(scene.bodies.iter().map(|body| body.name.as_str())).collect();
        unknown_name(py, ["frame", "frames"], of, &known)
    }

    /// A point of a body in the reference configuration.
    pub(crate) fn point(&self, at: &Bound<'_, PyAny>) -> PyResult<[f64; 3]> {
        point(at, self.shared.scene.dimension.count())
    }

    /// Reads the coordinates of one state.
    pub(crate) fn coordinates_of(&self, q: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
        Numbers::row(q, "q", self.sizes(q.py())?[0])
    }
}

/// The three parts of derivatives, of one state or of many.
fn derivatives<'py>(all: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = all.py();
    let full = || pyo3::types::PySlice::full(py);
    let part = |i: usize| {
        let ellipsis = py.import("builtins")?.getattr("Ellipsis")?;
        all.get_item((ellipsis, i, full(), full()))
    };
    values::make(py, "Derivatives", (part(0)?, part(1)?, part(2)?))
}

//! States that the program sets, for example in an observer.

use super::{Solver, put, states};
use crate::check::Checked;
use crate::inputs::Written;
use crate::state_error::StateError;
use mbs_core::Real;
use mbs_core::step::StepError;
use mbs_recursive::Outside;
use mbs_recursive::link::{Link, LinkKind};
use mbs_recursive::passes::slices::TreeSlices;
use mbs_recursive::space::Space;
use mbs_recursive::step::set_state::{self, StateReport};
use mbs_recursive::step::trapezoidal::Start;

impl<
    T: Real,
    S: Space<T>,
    const L: usize,
    const Z: usize,
    const V: usize,
    const R: usize,
    const B: usize,
    const N: usize,
    const G: usize,
    const C: usize,
    const M: usize,
    const F: usize,
    const K: usize,
    const W: usize,
> Solver<T, S, L, Z, V, R, B, N, G, C, M, F, K, W>
{
    /// Sets the state of the model at the present time, and closes the loops of the model, beginning at this state. Accelerations and
    /// multipliers are then evaluated, and the next step starts from them.
    ///
    /// `z` and `v` have the order of [`coordinates`](Self::coordinates) and [`velocities`](Self::velocities), which is the order of the
    /// exported links. [`Link::z`](mbs_recursive::link::Link::z) and [`Link::v`](mbs_recursive::link::Link::v) are the indices of a link's
    /// first numbers. The numbers of each kind of link are:
    ///
    /// | link | in `z` | in `v` |
    /// |---|---|---|
    /// | revolute | angle [rad] | rate [rad/s] |
    /// | prismatic | slide [m] | rate [m/s] |
    /// | ball | unit quaternion (w, x, y, z) against the parent | angular velocity against the parent, in the link's axes [rad/s] |
    /// | free, space | unit quaternion against the ground; position of the link's origin from `mechanism.base`, global axes [m] | angular velocity, in the link's axes [rad/s]; velocity, global axes [m/s] |
    /// | free, plane | angle [rad]; position of the link's origin from `mechanism.base`, global axes [m] | rate [rad/s]; velocity, global axes [m/s] |
    /// | guided | none | none |
    ///
    /// A quaternion q and its negative −q are the same attitude, but different twists of a bushing or a torsion spring. Give the quaternion
    /// that is nearer to the present quaternion of the link.
    ///
    /// All loops are closed together, first in positions, then in velocities. To first order, the change is the smallest in the norm of the
    /// mass matrix. In a model with loops any coordinate may change. In a model without loops all values are used exactly as given, except
    /// quaternions that are not of unit length. Time, inputs, the states of signals and the rung of the ladder are unchanged. The guides
    /// have their motions at the end of the last step.
    ///
    /// Cost: without loops one evaluation, which is about nine tenths of a step with its default bounds. With loops two evaluations, and
    /// one response for each sweep. The report counts the sweeps: about five near a closed state. If the loops are far from closed, there
    /// are at most five evaluations. There are at most `5 (options.max_sweeps + 1)` sweeps for the loops and thirty for the accelerations.
    /// No allocation. A program that does not call this function does not contain its code.
    ///
    /// # Errors
    /// [`StateError`] if a list has another length, a number is not finite, or a quaternion is too short or too long to be normalised. Also
    /// if the loops do not close, or if the state has no accelerations. All outputs and later steps of the solver are then the same, to the
    /// bit, as without the call.
    ///
    /// ```
    /// # mod model { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/pick/nostd/src/model.rs")); }
    /// use mbs_nostd::{Checked, StateError, Unwatched};
    /// use model::{MODEL, ModelSolver};
    ///
    /// let model = Checked::new(&MODEL)?;
    /// let mut observer = ModelSolver::new(&model)?;
    /// let measured = [0.1, -0.2]; // the angles of both joints [rad], from their encoders
    /// for _ in 0..400 {
    ///     observer.step(&model, 1e-3, &mut Unwatched).expect("a pendulum swings");
    ///     // z += h l (y - z), v += h l² / 4 (y - z): both roots of the error are at -l / 2 = -20 / s
    ///     let (mut z, mut v) = ([0.0; 2], [0.0; 2]);
    ///     for i in 0..2 {
    ///         let error = measured[i] - observer.coordinates()[i];
    ///         z[i] = observer.coordinates()[i] + 0.04 * error;
    ///         v[i] = observer.velocities()[i] + 0.4 * error;
    ///     }
    ///     observer.set_state(&model, &z, &v).expect("finite numbers");
    /// }
    /// let refused = observer.set_state(&model, &[0.0, f64::NAN], &[0.0; 2]);
    /// assert_eq!(refused, Err(StateError::NotFinite { of: "coordinates", entry: 1 }));
    /// # Ok::<(), mbs_nostd::LoadError>(())
    /// ```
    pub fn set_state(
        &mut self,
        model: &Checked<'_, T, S>,
        z: &[T],
        v: &[T],
    ) -> Result<StateReport<T>, StateError> {
        if model.sizes() != self.sizes {
            return Err(StepError::Tables.into());
        }
        check("coordinates", z, self.sizes.coordinates)?;
        check("velocities", v, self.sizes.freedoms)?;
        check_quaternions::<T, S>(model.model().mechanism.links, z)?;
        let rank = self.scratch.rank;
        let done = self.close(model, z, v);
        if done.is_err() {
            // Later calls that close loops use the largest rank so far, so it is restored.
            self.scratch.rank = rank;
        }
        Ok(done?)
    }

    /// Closes the loops, beginning at a finite state. If this fails, only the scratch is changed.
    fn close(
        &mut self,
        model: &Checked<'_, T, S>,
        z: &[T],
        v: &[T],
    ) -> Result<StateReport<T>, StepError> {
        let whole = &model.model().mechanism;
        let loads = model.kept_on(self.ladder.rung()).unwrap_or(whole.loads);
        let mechanism = TreeSlices { loads, ..*whole };
        // The guides have their motions at the end of the last step.
        let inputs = Written {
            laws: model.model().prescriptions,
            guides: &self.inputs.ended,
            courses: &self.inputs.courses,
        };
        let signals = states(&self.signals, self.sizes.states);
        let start = Start { t: self.t, z, v, a: &[], signals };
        let mut s = self.scratch.store(&self.sizes).map_err(|Outside| StepError::Tables)?;
        let report = set_state::set_state(&mechanism, &inputs, &self.options, &start, &mut s)?;
        for (to, from) in [
            (&mut self.z[..], &*s.z),
            (&mut self.v, &*s.v),
            (&mut self.a, &*s.zdd),
            (&mut self.lambda, &*s.lambda),
        ] {
            put(from, to);
        }
        put(s.signals.ends, &mut self.signals);
        self.inputs.has_new = false;
        Ok(report)
    }
}

/// Checks that a list has the needed length and that its numbers are finite.
fn check<T: Real>(of: &'static str, list: &[T], needed: usize) -> Result<(), StateError> {
    if list.len() != needed {
        return Err(StateError::Length { of, given: list.len(), needed });
    }
    match list.iter().position(|x| !x.is_finite()) {
        Some(entry) => Err(StateError::NotFinite { of, entry }),
        None => Ok(()),
    }
}

/// Checks that the quaternions of ball joints and free links can be normalised: their squared length is finite and above rounding.
fn check_quaternions<T: Real, S: Space<T>>(
    links: &[Link<T, S>],
    z: &[T],
) -> Result<(), StateError> {
    for link in links.iter().skip(1) {
        if S::DIMENSION < 3 || !matches!(link.kind, LinkKind::Ball | LinkKind::Free) {
            continue;
        }
        let entry = link.z as usize;
        let quaternion = z.iter().skip(entry).take(4);
        let square = quaternion.fold(T::ZERO, |sum, &x| sum + x * x);
        if !(square > T::EPSILON && square.is_finite()) {
            return Err(StateError::Quaternion { entry });
        }
    }
    Ok(())
}

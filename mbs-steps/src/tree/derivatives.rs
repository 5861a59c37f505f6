//! Derivatives of inverse and forward dynamics of a [`Tree`].

use super::inner::{Inner, with};
use super::{
    AccelerationDerivatives, EffortDerivatives, Matrix, Tree, TreeError, TreeErrorKind, checked,
};
use crate::stop::StopError;
use mbs_core::scene::{CouplingMeasure, CouplingTerm, Freedom};
use mbs_recursive::own::{EffortSlopes, MovingColumns};

impl Tree {
    /// Derivatives of [`inverse_dynamics`](Self::inverse_dynamics) at given accelerations. Couplings of joints by constant ratios are
    /// allowed. Other closed loops are an error.
    ///
    /// ∂/∂q is the derivative along v, as in a step of [`integrate`](Self::integrate). For a ball joint this is a rotation about axes of
    /// the second body, so ∂/∂q is square too. Effects are not included, as in all equations of a tree.
    ///
    /// Cost: an outward pass, and operations proportional to the number of bodies times the depth of the tree.
    ///
    /// # Errors
    /// [`TreeErrorKind::Loops`] with the joint that closes a loop; [`TreeErrorKind::Length`], [`TreeErrorKind::NotFinite`] for invalid
    /// accelerations.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// tree.set(&[0.5, 0.0], &[0.0, 0.0])?;
    /// // at rest only gravity changes: two rods of 1 m and 1 kg, of which the second one hangs on the first
    /// let slopes = tree.inverse_dynamics_derivatives(&[0.0, 0.0])?;
    /// assert!((slopes.q[(0, 0)] + 9.81 * (0.5 + 1.5) * 0.5_f64.sin()).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn inverse_dynamics_derivatives(
        &mut self,
        accelerations: &[f64],
    ) -> Result<&EffortDerivatives, TreeError> {
        checked("accelerations", accelerations, self.v.len())?;
        self.has_constant_rows("derivatives of efforts")?;
        self.place_accelerations(Some(accelerations));
        let to = &mut self.of_effort;
        let mut slopes = slopes_in([&mut to.q, &mut to.v, &mut to.acceleration]);
        with!(&mut self.inner, t => {
            let moving = t.moving.get_or_insert_with(|| MovingColumns::new(&t.model));
            let scratch = (&mut t.workspace, moving);
            t.own.write_effort_slopes(&t.model, &t.state, scratch, &mut slopes);
        });
        Ok(&self.of_effort)
    }

    /// Derivatives of [`forward_dynamics`](Self::forward_dynamics) at given efforts τ: ∂v̇/∂(q, v) = −K ∂τ/∂(q, v), ∂v̇/∂τ = K. In an open
    /// tree K is M⁻¹. Couplings of constant ratio require J v̇ = 0; then K is M⁻¹ − M⁻¹ Jᵀ (J M⁻¹ Jᵀ)⁻¹ J M⁻¹. Other closed loops are an
    /// error.
    ///
    /// ∂/∂q is the derivative along v, as in [`inverse_dynamics_derivatives`](Self::inverse_dynamics_derivatives). The components of the
    /// efforts along v are held constant.
    ///
    /// Cost: both dynamics and their derivatives, and n² times the depth of the tree.
    ///
    /// # Errors
    /// [`TreeErrorKind::Loops`] with the joint that closes a loop; further errors as for [`forward_dynamics`](Self::forward_dynamics).
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// let slopes = tree.forward_dynamics_derivatives(&[0.0, 0.0])?.clone();
    /// let (one, more) = (tree.forward_dynamics(&[0.0, 0.0])?.to_vec(), tree.forward_dynamics(&[1.0, 0.0])?);
    /// assert!((more[1] - one[1] - slopes.effort[(1, 0)]).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn forward_dynamics_derivatives(
        &mut self,
        effort: &[f64],
    ) -> Result<&AccelerationDerivatives, TreeError> {
        checked("effort", effort, self.v.len())?;
        self.has_constant_rows("derivatives of accelerations")?;
        self.accelerate(Some(effort))?;
        let to = &mut self.by_effort;
        let mut slopes = slopes_in([&mut to.q, &mut to.v, &mut self.mass]);
        with!(&mut self.inner, t => {
            let moving = t.moving.get_or_insert_with(|| MovingColumns::new(&t.model));
            let scratch = (&mut t.workspace, moving);
            // The scratch memory contains the accelerations of the links from the forward dynamics.
            t.own.write_effort_slopes_here(&t.model, scratch, &mut slopes);
        });
        self.factor()?;
        let (n, to) = (self.v.len(), &mut self.by_effort);
        to.effort.resize_rows(n);
        to.effort.data.fill(0.0);
        to.effort.data.iter_mut().step_by(n + 1).for_each(|x| *x = 1.0);
        for square in [&mut to.q.data, &mut to.v.data] {
            square.iter_mut().for_each(|x| *x = -*x);
        }
        for square in [&mut to.q.data, &mut to.v.data, &mut to.effort.data] {
            with!(&mut self.inner, t => t.own.solve(&self.mass.data, square));
        }
        self.keep_rows();
        Ok(&self.by_effort)
    }

    /// Projects the derivatives, so that accelerations satisfy the rows of couplings. At the start K is M⁻¹. For each constant row j, each
    /// matrix X of derivatives becomes X − K jᵀ (j X) / (j K jᵀ), and K itself is changed last. A row that depends on earlier rows is
    /// skipped.
    fn keep_rows(&mut self) {
        /// Smallest ratio of j K jᵀ to j M⁻¹ jᵀ for an independent row j [-]. With a smaller ratio, j depends on earlier rows, and j K jᵀ
        /// is rounding error.
        const ROUNDING: f64 = 1e-12;
        if self.loops.rows == 0 {
            return;
        }
        let rows = self.loop_jacobian().clone();
        let AccelerationDerivatives { q, v, effort } = &mut self.by_effort;
        let product = |x: &Matrix, j: &[f64]| -> Vec<f64> {
            (0..x.rows).map(|i| x.row(i).iter().zip(j).map(|(x, j)| x * j).sum()).collect()
        };
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let inverse = effort.clone();
        for j in (0..rows.rows).map(|row| rows.row(row)) {
            let (pushed, whole) = (product(effort, j), dot(j, &product(&inverse, j)));
            let size = dot(j, &pushed);
            if size <= ROUNDING * whole {
                continue;
            }
            for square in [&mut *q, &mut *v, &mut *effort] {
                let n = square.columns;
                let row = |c: usize| j.iter().enumerate().map(|(i, j)| j * square[(i, c)]).sum();
                let moved: Vec<f64> = (0..n).map(row).collect();
                for (i, pushed) in pushed.iter().enumerate() {
                    let to = &mut square.data[i * n..][..n];
                    to.iter_mut().zip(&moved).for_each(|(x, moved)| *x -= pushed * moved / size);
                }
            }
        }
    }

    /// Checks that the rows of all loops are constant. Rows of cut joints, rolling contacts, curves and lines change with the position.
    fn has_constant_rows(&self, what: &'static str) -> Result<(), TreeError> {
        let is_constant = |term: &CouplingTerm<f64>| {
            let CouplingMeasure::Coordinate { joint, number } = &term.of else { return false };
            let kind = self.scene.joints[*joint].kind;
            let freedom = kind.freedom(self.scene.dimension, *number);
            let is_rate = matches!(freedom, Some(Freedom::Slide(_) | Freedom::Turn(_)));
            is_rate && term.curve.is_none()
        };
        let mut couplings = self.scene.couplings.iter().flat_map(|coupling| &coupling.terms);
        let has_cut = with!(&self.inner, t => t.model.cut_joints().next().is_some());
        if !has_cut && self.scene.rollings.is_empty() && couplings.all(is_constant) {
            return Ok(());
        }
        self.open(what)
    }

    /// Replaces the mass matrix by its factors.
    pub fn factor(&mut self) -> Result<(), TreeError> {
        self.needs_inertia()?;
        let mass = &mut self.mass.data;
        with!(&mut self.inner, t => t.own.factor(mass).map_err(|link| {
            let owner = t.model.owner_of_link(link);
            let reason = StopError::tree(mbs_recursive::TreeError::NoInertia { owner });
            TreeError::of_model(TreeErrorKind::NoAccelerations, (reason, &self.names))
        }))
    }

    /// Checks that the tree has no closed loops; `what` names the quantity that only open trees have.
    pub fn open(&self, what: &'static str) -> Result<(), TreeError> {
        if self.loops.rows == 0 {
            return Ok(());
        }
        let owner = with!(&self.inner, t => t.model.owner_of_row(0));
        Err(TreeError::of_owner(TreeErrorKind::Loops(what), (Some(owner), &self.names)))
    }
}

/// Makes the matrices of derivatives square, and returns their data. The derivatives are by positions, velocities and accelerations.
fn slopes_in(squares: [&mut Matrix; 3]) -> EffortSlopes<'_, f64> {
    let [q, v, a] = squares.map(|square| {
        square.resize_rows(square.columns);
        &mut square.data[..]
    });
    EffortSlopes { q, v, a }
}

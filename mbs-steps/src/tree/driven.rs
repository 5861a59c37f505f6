//! Dynamics of a tree with all effects, signals and inputs.

use super::inner::{Inner, Typed, with};
use super::{Tree, TreeError, TreeErrorKind, checked};
use crate::erased::inputs::InputInfo;
use mbs_recursive::Options;

impl Tree {
    /// Inputs that can be set, in the order of effects, guides, couplings and signals.
    #[must_use]
    pub fn inputs(&self) -> &[InputInfo] {
        &self.input_list
    }

    /// Sets all inputs, in the order of [`inputs`](Self::inputs).
    ///
    /// # Errors
    /// [`TreeErrorKind::Length`], [`TreeErrorKind::NotFinite`]; no input is set then.
    ///
    /// ```
    /// use mbs::{Body, Effect, GROUND, Joint, Mechanism, Signal};
    /// let mut m = Mechanism::planar("arm");
    /// let arm = m.add(Body::planar([1.0, 0.0], 2.0, 0.0));
    /// let pivot = m.add(Joint::revolute([GROUND, arm], [0.0, 0.0]));
    /// m.add(Effect::torque(pivot, Signal::input(0.0)));
    /// let mut tree = m.tree()?;
    /// tree.set_inputs(&[3.0])?;
    /// // 3 N m on 2 kg at 1 m
    /// assert_eq!(tree.accelerations()?, [1.5]);
    /// # Ok::<(), mbs::SimulationError>(())
    /// ```
    pub fn set_inputs(&mut self, all: &[f64]) -> Result<(), TreeError> {
        checked("inputs", all, self.input_list.len())?;
        let state = self.inner.state();
        for (&place, &value) in self.input_places.iter().zip(all) {
            state.inputs[place] = value;
        }
        state.applied.copy_from_slice(&state.inputs);
        Ok(())
    }

    /// Accelerations v̇ under all effects, signals and inputs, with closed loops satisfied. States of signals have their initial values.
    /// After a call of [`follow`](Self::follow) they have the values of the simulation.
    ///
    /// Cost: one evaluation; no allocation.
    ///
    /// # Errors
    /// [`TreeErrorKind::NoAccelerations`] at a singular position, or if the force of an effect cannot be computed.
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// // without effects it falls as it does without efforts
    /// let free = tree.forward_dynamics(&[0.0, 0.0])?.to_vec();
    /// let all = tree.accelerations()?;
    /// assert!(all.iter().zip(&free).all(|(a, b)| (a - b).abs() < 1e-12));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn accelerations(&mut self) -> Result<&[f64], TreeError> {
        self.needs_inertia()?;
        let names = &self.names;
        with!(&mut self.inner, tree => {
            let Typed { model, state, workspace, .. } = &mut **tree;
            model.accelerate(&Options::default(), state, workspace).map_err(|error| {
                let reason = (Typed::reason(model, error), names);
                TreeError::of_model(TreeErrorKind::NoAccelerations, reason)
            })
        })?;
        let state = self.inner.state();
        let velocities = [&self.v[..], &state.v];
        self.layout.accelerations_outward(velocities, (&state.a, &mut self.answer));
        Ok(&self.answer)
    }

    /// Kinetic energy, and potential energy of gravity, constant forces and springs [J].
    ///
    /// ```
    /// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes/double-pendulum.toml");
    /// let mut tree = mbs::Mechanism::read(path)?.tree()?;
    /// tree.set(&[0.0, 0.0], &[1.0, 0.0])?;
    /// // rods of 1 m and 1 kg in a line turn about the end: 8/3 kg m²
    /// assert!((tree.energies()[0] - 4.0 / 3.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn energies(&mut self) -> [f64; 2] {
        with!(&mut self.inner, t => t.model.energies(&t.state, &mut t.workspace))
    }

    /// Projects the coordinates onto the constraints of the loops, with the smallest motion in the norm of the mass matrix. The velocities
    /// are projected in the same way. Returns the largest change of a coordinate [rad, m].
    ///
    /// # Errors
    /// [`TreeErrorKind::OpenLoops`] if no small motion closes the loops, [`TreeErrorKind::NoAccelerations`] for a tree without
    /// loops whose accelerations cannot be computed; the tree is unchanged then.
    pub fn make_consistent(&mut self) -> Result<f64, TreeError> {
        self.needs_inertia()?;
        let names = &self.names;
        with!(&mut self.inner, tree => {
            let Typed { model, state, workspace, .. } = &mut **tree;
            model.settle(state, workspace).map_err(|error| {
                let reason = (Typed::reason(model, error), names);
                let kind: fn(_) -> _ = match model.n_rows() {
                    0 => TreeErrorKind::NoAccelerations,
                    _ => TreeErrorKind::OpenLoops,
                };
                TreeError::of_model(kind, reason)
            })
        })?;
        let state = self.inner.state();
        let before = self.q.clone();
        self.layout.coordinates_outward(&state.z, &mut self.q);
        self.layout.velocities_outward(&state.v, &mut self.v);
        self.layout.difference(&before, &self.q, &mut self.answer);
        Ok(self.answer.iter().fold(0.0, |most: f64, x| most.max(x.abs())))
    }
}

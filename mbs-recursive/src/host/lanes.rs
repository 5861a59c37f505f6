//! Several states of one mechanism in one evaluation: for ensembles, sensitivities and finite differences.
//!
//! A tree in [`Lanes`] evaluates accelerations, efforts, energies and mass matrices of `N` states at once. Each result has the same bits as
//! a separate evaluation. All lanes would follow the same branch of a condition, even if their numbers differ. Trees with such conditions
//! are therefore refused: trees with loops, because lanes need different numbers of sweeps, and trees with effects whose laws have pieces.
//! A spring must have a positive length in every lane. The methods of [`TreeModel::step`] also make each decision for all lanes at once.
//! Integrate each lane separately, or write steps of fixed length that call [`TreeModel::accelerate`].

use crate::build::{LanesError, TreeModel};
use crate::host::state::TreeState;
use crate::space::Space;
use mbs_core::real::Lanes;
use mbs_core::scene::Scene;

impl<S: Space<Lanes<N>>, const N: usize> TreeModel<Lanes<N>, S> {
    /// Makes the tree of a scene whose numbers are equal in all lanes, for example a scene that was read from a file.
    ///
    /// Cost: that of [`TreeModel::new`].
    ///
    /// # Errors
    /// [`LanesError`] names the loops or the effect whose branches may differ between lanes.
    pub fn in_lanes(scene: &Scene<Lanes<N>>) -> Result<Self, LanesError> {
        let branching = scene.effects.iter().position(|e| e.enabled && e.kind.has_branches());
        if let Some(effect) = branching {
            return Err(LanesError::Effect { effect });
        }
        let model = Self::new(scene).map_err(LanesError::Tree)?;
        match model.n_rows() {
            0 => Ok(model),
            rows => Err(LanesError::Closed { rows }),
        }
    }
}

impl<const N: usize> TreeState<Lanes<N>> {
    /// Writes coordinates and velocities into one lane.
    ///
    /// # Panics
    /// If the lengths of `z` and `v` differ from those of the state, or if `lane` is not below `N`.
    pub fn set_lane(&mut self, lane: usize, z: &[f64], v: &[f64]) {
        assert_eq!((self.z.len(), self.v.len()), (z.len(), v.len()), "a state of this mechanism");
        let pairs = self.z.iter_mut().zip(z).chain(self.v.iter_mut().zip(v));
        for (wide, &x) in pairs {
            wide.0[lane] = x;
        }
    }

    /// Returns the accelerations of one lane.
    ///
    /// # Panics
    /// If `lane` is not below `N`.
    pub fn lane_accelerations(&self, lane: usize) -> impl Iterator<Item = f64> + '_ {
        assert!(lane < N, "a lane of {N}");
        self.a.iter().map(move |wide| wide.0[lane])
    }
}

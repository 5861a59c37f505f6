//! Several states of one mechanism in one evaluation: for ensembles, sensitivities and finite differences.
//!
//! A tree in [`Lanes`] evaluates accelerations, efforts, energies and mass matrices of `N` states at once, each with the bits that it
//! would have alone. Branches that numbers decide would be taken for all lanes: loops, which are swept until they close, and effects
//! whose laws have pieces are refused. A spring must have a length in every lane. Steps decide by numbers for all lanes at once: integrate
//! lane by lane, or by steps of fixed length around [`TreeModel::accelerate`].

use crate::build::{LanesError, TreeModel};
use crate::host::state::TreeState;
use crate::space::Space;
use mbs_core::real::Lanes;
use mbs_core::scene::Scene;

impl<S: Space<Lanes<N>>, const N: usize> TreeModel<Lanes<N>, S> {
    /// The tree of a scene whose numbers are the same in all lanes, such as one that was read.
    ///
    /// Cost: that of [`TreeModel::new`].
    ///
    /// # Errors
    /// [`LanesError`] names what has branches that lanes would not take alike.
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
    /// Puts coordinates and velocities into a lane.
    ///
    /// # Panics
    /// If there are not as many of them as the state has, or the lane is not one of `N`.
    pub fn set_lane(&mut self, lane: usize, z: &[f64], v: &[f64]) {
        assert_eq!((self.z.len(), self.v.len()), (z.len(), v.len()), "a state of this mechanism");
        let pairs = self.z.iter_mut().zip(z).chain(self.v.iter_mut().zip(v));
        for (wide, &x) in pairs {
            wide.0[lane] = x;
        }
    }

    /// The accelerations of a lane.
    ///
    /// # Panics
    /// If the lane is not one of `N`.
    pub fn lane_accelerations(&self, lane: usize) -> impl Iterator<Item = f64> + '_ {
        assert!(lane < N, "a lane of {N}");
        self.a.iter().map(move |wide| wide.0[lane])
    }
}

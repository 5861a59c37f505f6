//! Checks that every joint of a tree moves some inertia. Forces do not determine the acceleration of a joint that moves no inertia.

use crate::build::error::TreeError;
use crate::build::own_tables::own;
use crate::build::tree::TreeModel;
use crate::link::plan::Plan;
use crate::link::{ArticulatedInertia, LinkMotion};
use crate::loops::{Fault, LoopStore, Loops, Regularisation};
use crate::passes;
use crate::rows::coupled::Couplings;
use crate::space::{Numbers, Space};
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Checks that no branch ends in a body without mass.
    pub(crate) fn check_ends(&self) -> Result<(), TreeError> {
        let mut is_heavy: Vec<bool> = self.links.iter().map(|l| l.mass > T::ZERO).collect();
        for (i, link) in self.links.iter().enumerate().skip(1) {
            let tensor = S::body_inertia(T::ZERO, &S::Point::zero(), &link.tensor, &S::identity());
            is_heavy[i] |= S::size(&tensor).0 > T::ZERO;
        }
        for i in (1..self.links.len()).rev() {
            if is_heavy[i] {
                is_heavy[self.links[i].parent as usize] = true;
            }
        }
        for seat in &self.seats {
            let is_guided = self.links[seat.link as usize].kind.is_guided();
            if !is_heavy[seat.link as usize] && !is_guided {
                let body = self.clusters.clusters[seat.branch.cluster].bodies[0];
                return Err(TreeError::MasslessEnd { body });
            }
        }
        Ok(())
    }

    /// Checks that every joint of the tree has a positive pivot (inertia along its freedom) in the reference configuration.
    pub(crate) fn check_inertia(&self) -> Result<(), TreeError> {
        let n = self.links.len();
        let mut z = vec![T::ZERO; self.n_coordinates];
        self.write_reference(&mut z);
        let v = vec![T::ZERO; self.n_freedoms];
        let guides = vec![[T::ZERO; 3]; self.prescribed.n_guides()];
        let mut placed = vec![LinkMotion::<T, S>::ground(); n];
        let mut condensed = vec![ArticulatedInertia::<T, S>::empty(); n];
        own(passes::kinematics(&self.links, (&z, &v, &guides), &mut placed));
        passes::inertias(&self.links, &placed, &mut condensed);
        let plan = Plan {
            stations: &[],
            passes: &[],
            pairs: &[],
            ends: &[],
            couplings: &[],
            updates: &[],
        };
        let couplings = Couplings::none();
        let none = Loops { loops: &[], rows: &[], plan, floor: self.floor, couplings };
        let mut store = LoopStore {
            k: &mut [],
            slopes: &mut [],
            l: &mut [],
            lambda: &mut [],
            blocks: &mut [],
            gains: &mut [],
            heads: &mut [],
            scales: &mut [],
            pivots: &mut [],
        };
        let setting = (&none, Regularisation::Fixed(T::ZERO), &S::Motion::zero());
        match passes::condense(&self.links, &placed, setting, &mut condensed, &mut store) {
            Err(Fault::NoInertia(fault)) => {
                Err(TreeError::NoInertia { owner: self.owner_of_link[fault.link as usize] })
            }
            _ => Ok(()),
        }
    }
}

//! Sparsity of the Jacobian by rows: the entities with nonzero gradients in each row, and the places of the gradients.
//!
//! ```text
//! rate_r = sum over the unknown entities e of row r of g_re . x_e         g_re: gradient, x_e: coordinates of e
//! ```

use super::coordinate_sets::CoordinateSet;
use super::group::{Group, index};
use crate::Real;
use alloc::vec::Vec;

/// Entity of a row, with its gradient.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Entry {
    /// First coordinate of the entity.
    slot: u32,
    /// Place of the entity's gradient in the Jacobian store.
    place: u32,
}

/// Entities that each row uses.
#[derive(Debug, Clone, Default)]
pub(super) struct Incidence {
    /// Start of each row in the list, then the end of the list.
    start: Vec<u32>,
    list: Vec<Entry>,
}

impl Incidence {
    /// Incidence of all rows of a model, after all groups are added.
    pub(super) fn of<const D: usize>(
        groups: &[Group],
        slots: &[u32],
        reach: &[CoordinateSet],
    ) -> Self {
        let mut incidence = Self { start: Vec::from([0]), list: Vec::new() };
        for group in groups {
            let slots = &group.slots.of(slots)[..group.n_unknown as usize];
            for (k, reach) in group.rows.of(reach).iter().enumerate() {
                let row = group.jacobian as usize + k * group.width as usize;
                for (e, &slot) in slots.iter().enumerate() {
                    if reach.pair().is_none_or(|pair| pair.contains(&(e * D))) {
                        incidence.list.push(Entry { slot, place: index(row + e * D) });
                    }
                }
                incidence.start.push(index(incidence.list.len()));
            }
        }
        incidence
    }

    /// Computes rates = J x of the rows from `first` on, one row for each rate.
    #[inline(always)]
    pub(super) fn multiply<T: Real, const D: usize>(
        &self,
        (jacobian, x): (&[T], &[T]),
        first: usize,
        rates: &mut [T],
    ) {
        let ends = &self.start[first..][..=rates.len()];
        let mut rest = &self.list[ends[0] as usize..ends[rates.len()] as usize];
        for (rate, ends) in rates.iter_mut().zip(ends.windows(2)) {
            let (own, others) = rest.split_at((ends[1] - ends[0]) as usize);
            rest = others;
            let mut sum = T::ZERO;
            for touch in own {
                let (g, x) = (&jacobian[touch.place as usize..], &x[touch.slot as usize..]);
                let (g, x) = (&g[..D], &x[..D]);
                for i in 0..D {
                    sum += g[i] * x[i];
                }
            }
            *rate = sum;
        }
    }
}

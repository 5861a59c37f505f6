//! The order of an elimination as plain data, and an elimination in a given order.

use super::Elimination;
use super::pattern::index;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;

/// An order of elimination, with the sizes of its pivots at the choice.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Order<T> {
    /// Row and column of each pivot.
    pub pivots: Vec<[u32; 2]>,
    /// Scale of each row in the choice.
    pub row_scales: Vec<T>,
    /// Size of each pivot in the scaled matrix.
    pub sizes: Vec<T>,
}

impl<T: Real> Elimination<T> {
    /// Returns the last chosen order.
    #[must_use]
    pub fn order(&self) -> Order<T> {
        let pivots = self.pivot_rows().iter().zip(self.dependent());
        Order {
            pivots: pivots.map(|(&row, &column)| [row, column]).collect(),
            row_scales: self.row_scales.clone(),
            sizes: self.chosen.clone(),
        }
    }

    /// Sets an order that another elimination of the same pattern has chosen. Call [`refactor`](Self::refactor) for the factors. Returns
    /// false, and changes nothing, if the order does not fit the pattern.
    ///
    /// Cost: the elimination once. Allocates.
    pub fn set_order(&mut self, order: &Order<T>) -> bool {
        let (m, n) = (self.pattern.n_rows(), self.pattern.n_columns);
        let (rank, Order { pivots, row_scales, sizes }) = (order.pivots.len(), order);
        if row_scales.len() != m || sizes.len() != rank || !are_distinct(pivots, [m, n]) {
            return false;
        }
        // The entries depend on the pattern alone, so any values can be used here.
        let ones = vec![T::ONE; self.pattern.columns.len()];
        let (chooser, scales) = (&mut self.chooser, (&row_scales[..], &self.column_scales[..]));
        chooser.load(&self.pattern, &ones);
        for (step, &[row, column]) in pivots.iter().enumerate() {
            let Some(at) = chooser.entry(row, column) else { return false };
            chooser.eliminate(at, index(step), scales);
        }
        self.row_scales.clone_from(row_scales);
        self.rows.clear();
        self.unknowns.clear();
        for &[row, column] in pivots {
            self.rows.push(row);
            self.unknowns.push(column);
        }
        self.rank = rank;
        self.close_order();
        self.chosen.clone_from(sizes);
        true
    }
}

/// True if every row and column occurs at most once and exists in the matrix.
fn are_distinct(pivots: &[[u32; 2]], sizes: [usize; 2]) -> bool {
    [0, 1].into_iter().all(|side| {
        let mut is_taken = vec![false; sizes[side]];
        pivots.iter().all(|pivot| {
            let place = is_taken.get_mut(pivot[side] as usize);
            place.is_some_and(|is_taken| !core::mem::replace(is_taken, true))
        })
    })
}

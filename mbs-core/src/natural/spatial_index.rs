//! The first of many places that is nearly a given one, without a look at all of them.

use crate::Real;
use crate::algebra::Vector;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;

/// Most places that are compared one by one [-]; more are sorted into cells. Chosen, not tuned: the result is the same.
const MAX_UNSORTED: usize = 16;

/// Numbers of places that the caller knows, by where they are.
#[derive(Debug, Clone)]
pub struct SpatialIndex {
    /// The first [`MAX_UNSORTED`], in order.
    few: Vec<usize>,
    /// All of them by cell, each in order, once there are more.
    cells: BTreeMap<[i64; 3], Vec<usize>>,
    /// Edge of a cell: four times the distance that counts as near, so that eight cells hold all that is near.
    edge: f64,
}

impl SpatialIndex {
    /// For places that are one when no component differs by more than `tolerance`.
    pub fn new<T: Real>(tolerance: T) -> Self {
        Self { few: Vec::new(), cells: BTreeMap::new(), edge: tolerance.to_f64() * 4.0 }
    }

    /// The smallest number that is `same`, of those near one of `around`. `place` is the place of a number.
    pub fn first<T: Real>(
        &mut self,
        around: &[Vector<T, 3>],
        same: impl Fn(usize) -> bool,
        place: impl Fn(usize) -> Vector<T, 3>,
    ) -> Option<usize> {
        if self.few.len() < MAX_UNSORTED {
            return self.few.iter().copied().find(|&i| same(i));
        }
        if self.cells.is_empty() {
            for i in self.few.clone() {
                self.sort_in(i, &place(i));
            }
        }
        let mut best: Option<usize> = None;
        for at in around {
            // Half an edge to each side is more than what counts as near, rounding included.
            let [low, high] = [-0.5, 0.5].map(|side| self.cell(at, side));
            for x in [low[0], high[0]] {
                for y in [low[1], high[1]] {
                    for z in [low[2], high[2]] {
                        let cell = self.cells.get(&[x, y, z]).map_or(&[][..], Vec::as_slice);
                        let found = cell.iter().copied().find(|&i| same(i));
                        best = [best, found].into_iter().flatten().min();
                    }
                }
            }
        }
        best
    }

    /// Adds a number, larger than those before, and its place.
    pub fn push<T: Real>(&mut self, i: usize, at: &Vector<T, 3>) {
        if self.few.len() < MAX_UNSORTED {
            self.few.push(i);
        } else {
            self.sort_in(i, at);
        }
    }

    fn sort_in<T: Real>(&mut self, i: usize, at: &Vector<T, 3>) {
        self.cells.entry(self.cell(at, 0.0)).or_default().push(i);
    }

    /// The cell of a place moved by `side` edges along each axis. Places too far for whole numbers share the last cell.
    #[allow(clippy::cast_possible_truncation, reason = "floats saturate when they are cast")]
    fn cell<T: Real>(&self, at: &Vector<T, 3>, side: f64) -> [i64; 3] {
        core::array::from_fn(|i| libm::floor(at[i].to_f64() / self.edge + side) as i64)
    }
}

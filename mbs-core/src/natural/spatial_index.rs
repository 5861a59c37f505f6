//! Search for the first of many points near a given one, without comparing all of them.

use crate::Real;
use crate::algebra::Vector;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;

/// Largest number of points that are compared one by one [-]. More points are sorted into cells, with the same result. Chosen, not
/// tuned.
const MAX_UNSORTED: usize = 16;

/// Numbers of points, sorted by where the points are. The caller knows the points.
#[derive(Debug, Clone)]
pub struct SpatialIndex {
    /// Numbers of the first [`MAX_UNSORTED`] points, in order.
    few: Vec<usize>,
    /// Numbers of all points by cell, each cell in order. Empty until there are more than `MAX_UNSORTED` points.
    cells: BTreeMap<[i64; 3], Vec<usize>>,
    /// Edge of a cell: four times the tolerance, so that eight cells contain all points within it.
    edge: f64,
}

impl SpatialIndex {
    /// Creates an empty index of points that count as equal if no component differs by more than `tolerance`.
    pub fn new<T: Real>(tolerance: T) -> Self {
        Self { few: Vec::new(), cells: BTreeMap::new(), edge: tolerance.to_f64() * 4.0 }
    }

    /// Returns the smallest number of a point that is near one of the points `around` and satisfies `same`. `place` gives the point
    /// of a number.
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
            // Half an edge to each side is more than the tolerance, with rounding.
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

    /// Adds a point and its number, which is larger than all numbers before.
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

    /// Cell of a point that is moved by `side` edges along each axis. Points beyond the range of `i64` use the outermost cells.
    #[allow(clippy::cast_possible_truncation, reason = "floats saturate when they are cast")]
    fn cell<T: Real>(&self, at: &Vector<T, 3>, side: f64) -> [i64; 3] {
        core::array::from_fn(|i| libm::floor(at[i].to_f64() / self.edge + side) as i64)
    }
}

//! Options that the caller chooses, [`Options`], and the cost of a factorisation, [`Counters`].
//!
//! ```text
//! flops of one partial factorisation of p pivots in a front of f unknowns:
//!     sum_{k=0}^{p-1}  1 + c + c (c + 1),   c = f - k - 1   (one division, c scalings, c (c + 1) / 2 multiply-subtracts)
//! ```

/// Choice of pivots among the unknowns that a front may eliminate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pivoting {
    /// Pivots in the order of the analysis. This is the fastest choice, and sufficient for positive definite matrices.
    #[default]
    None,
    /// Pivots by size: the largest remaining diagonal entry of the front first. This reduces the growth of rounding errors in badly scaled
    /// matrices.
    Diagonal,
}

/// Order in which unknowns are eliminated. It changes results by rounding errors only.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ordering {
    /// Minimum degree by default. If that order gives threads little work, a dissection replaces it that costs at most a tenth more.
    #[default]
    Chosen,
    /// Order of approximate minimum degree: the least work for one thread.
    MinimumDegree,
    /// Dissection with this many levels, and minimum degree within the parts. This order gives threads the most work. On chains it costs up
    /// to 2.5 times as much.
    Dissection(u32),
}

/// Options that the caller chooses. Start from `Options::default()` and change the public fields as needed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Choice of pivots inside each front.
    pub pivoting: Pivoting,
    /// Largest number of unknowns of a system that is factored as one dense front in the given order.
    pub dense_up_to: usize,
    /// Order in which unknowns are eliminated.
    pub ordering: Ordering,
    /// Target time of the factorisation of a task [ns]; `u64::MAX` makes a single task. The rounding of a solution depends on the division into
    /// tasks, but never on the threads that do them.
    pub grain: u64,
}

impl Default for Options {
    /// Returns the defaults: no pivoting, one dense front up to 8 unknowns, tasks of 5 microseconds.
    ///
    /// The limit of 8 was measured on chains of 4, 6 and 12 unknowns per element. A dense front is 8 % faster at n = 6, equal at 8 and 9, and
    /// 6 to 13 % slower at 12. At 24 it takes 1.5 to 1.7 times as long.
    fn default() -> Self {
        Self { pivoting: Pivoting::None, dense_up_to: 8, ordering: Ordering::Chosen, grain: 5_000 }
    }
}

/// Exact sizes of one analysis; times are not included.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Counters {
    /// Number of unknowns n.
    pub n: usize,
    /// Number of elements analysed.
    pub n_elements: usize,
    /// Number of fronts: dense matrices that are factored one after another.
    pub n_fronts: usize,
    /// Number of unknowns of the largest front.
    pub largest_front: usize,
    /// Number of entries of L, including the diagonal and the zeros that merged fronts add.
    pub nonzeros: usize,
    /// Number of values stored for all fronts: factors and updates.
    pub stored: usize,
    /// Number of additions, multiplications and divisions of one factorisation, without the assembly.
    pub flops: u64,
    /// Number of additions that add updates to parent fronts.
    pub extend_adds: u64,
    /// Number of tasks into which the tree of fronts is divided.
    pub n_tasks: usize,
    /// Upper bound for the speed-up by a team [-]: the estimated time of all fronts, divided by that of the longest path from a leaf to a
    /// root.
    pub parallelism: f64,
}

impl Counters {
    /// Counts a front of `f` unknowns that eliminates `p` of them.
    pub(crate) fn count_front(&mut self, p: usize, f: usize) {
        self.n_fronts += 1;
        self.largest_front = self.largest_front.max(f);
        self.stored += f * (f + 1) / 2;
        for k in 0..p {
            let c = f - k - 1;
            self.nonzeros += c + 1;
            self.flops += (1 + c + c * (c + 1)) as u64;
        }
        let r = f - p;
        self.extend_adds += (r * (r + 1) / 2) as u64;
    }
}

//! Options that the caller chooses, [`Options`], and the cost of a factorisation, [`Counters`].
//!
//! ```text
//! flops of one partial factorisation of p pivots in a front of f unknowns:
//!     sum_{k=0}^{p-1}  1 + c + c (c + 1),   c = f - k - 1   (one division, c scalings, c (c + 1) / 2 multiply-subtracts)
//! ```

/// How pivots are chosen among the unknowns that a front may eliminate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pivoting {
    /// In the order of the analysis. Enough for every positive definite matrix, and the fastest.
    #[default]
    None,
    /// The largest remaining diagonal of the front first: smaller growth of rounding in badly scaled matrices.
    Diagonal,
}

/// In which order unknowns are eliminated. No number depends on it but by rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ordering {
    /// Order of minimum degree; where that leaves little to do at the same time, a dissection that costs at most a tenth more.
    #[default]
    Chosen,
    /// Order of approximate minimum degree: the least work for one thread.
    MinimumDegree,
    /// This many levels of cuts in half, parts by minimum degree: most to do at the same time, on chains up to two and a half times the work.
    Dissection(u32),
}

/// Options that the caller chooses. Public fields; start from `Options::default()`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Choice of pivots inside each front.
    pub pivoting: Pivoting,
    /// Systems of at most this many unknowns are one dense front in the given order.
    pub dense_up_to: usize,
    /// Order in which unknowns are eliminated.
    pub ordering: Ordering,
    /// Trees of fronts are cut into tasks of about this many nanoseconds of factorisation; `u64::MAX`: never. The sums of a
    /// solution depend on it, and never on who works on the tasks.
    pub grain: u64,
}

impl Default for Options {
    /// Options without pivoting; one dense front up to 8 unknowns. Measured on chains of 4, 6 and 12 unknowns an element. Dense is 8 %
    /// faster at n = 6, equal at 8 and 9, and 6 to 13 % slower at 12. It takes 1.5 to 1.7 times as long at 24.
    fn default() -> Self {
        Self { pivoting: Pivoting::None, dense_up_to: 8, ordering: Ordering::Chosen, grain: 5_000 }
    }
}

/// Exact sizes of one analysis; times are measured from outside.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Counters {
    /// Number of unknowns n.
    pub n: usize,
    /// Number of elements analysed.
    pub n_elements: usize,
    /// Number of fronts, dense matrices that are factored one after the other.
    pub n_fronts: usize,
    /// Unknowns of the largest front.
    pub largest_front: usize,
    /// Entries of L, diagonal included, with the zeros that merging of fronts adds.
    pub nonzeros: usize,
    /// Numbers stored for all fronts, factor and updates.
    pub stored: usize,
    /// Additions, multiplications and divisions of one factorisation, without the assembly.
    pub flops: u64,
    /// Additions that carry the updates of fronts into their parents.
    pub extend_adds: u64,
    /// Tasks that the tree of fronts is cut into.
    pub n_tasks: usize,
    /// Time of all fronts over that of the longest way from a leaf to a root, as estimated: no team is faster than that.
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

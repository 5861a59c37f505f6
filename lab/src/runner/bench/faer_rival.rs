//! faer's sparse Cholesky on the same sum of blocks, for comparison. It works entry by entry (simplicial) or by supernodes.
//!
//! ```text
//! upper triangle in compressed columns; slot[t] = place of packed entry t of all blocks in turn
//! ```

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};
use mbs_sparse::{BlockSource, Cliques};

pub(crate) struct Rival {
    pattern: SymbolicSparseColMat<usize>,
    values: Vec<f64>,
    slots: Vec<usize>,
    block: Vec<f64>,
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    memory: MemBuffer,
}

impl Rival {
    /// Analyses for factorisation entry by entry, which is faster for the small fronts of mechanisms.
    #[allow(dead_code, reason = "one of the programs names the way itself")]
    pub(crate) fn analyse(sum: &impl Cliques) -> Self {
        Self::analyse_by(sum, SupernodalThreshold::FORCE_SIMPLICIAL)
    }

    pub(crate) fn analyse_by(sum: &impl Cliques, threshold: SupernodalThreshold) -> Self {
        let n = sum.n_unknowns();
        let longest = (0..sum.n_elements()).map(|e| sum.clique(e).len()).max().unwrap_or(0);
        let mut entries: Vec<(usize, usize)> = Vec::new();
        for e in 0..sum.n_elements() {
            let clique = sum.clique(e);
            for (j, &a) in clique.iter().enumerate() {
                entries.extend(clique[j..].iter().map(|&b| (a.max(b) as usize, a.min(b) as usize)));
            }
        }
        let mut distinct = entries.clone();
        distinct.sort_unstable();
        distinct.dedup();
        let slots = entries.iter().map(|e| distinct.binary_search(e).expect("listed")).collect();
        let mut start = vec![0; n + 1];
        for &(col, _) in &distinct {
            start[col + 1] += 1;
        }
        for i in 0..n {
            start[i + 1] += start[i];
        }
        let rows = distinct.iter().map(|&(_, row)| row).collect();
        let pattern = SymbolicSparseColMat::new_checked(n, n, start, None, rows);
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: threshold,
            ..CholeskySymbolicParams::default()
        };
        let amd = SymmetricOrdering::Amd;
        let symbolic = factorize_symbolic_cholesky(pattern.as_ref(), Side::Upper, amd, params)
            .expect("memory");
        let scratch = StackReq::or(
            symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default()),
            symbolic.solve_in_place_scratch::<f64>(1, Par::Seq),
        );
        Self {
            values: vec![0.0; distinct.len()],
            pattern,
            slots,
            block: vec![0.0; longest * (longest + 1) / 2],
            factor: vec![0.0; symbolic.len_val()],
            symbolic,
            memory: MemBuffer::new(scratch),
        }
    }

    pub(crate) fn assemble(&mut self, cliques: &impl Cliques, source: &impl BlockSource<f64>) {
        self.values.fill(0.0);
        let mut slots = self.slots.iter();
        for e in 0..cliques.n_elements() {
            let k = cliques.clique(e).len();
            let block = &mut self.block[..k * (k + 1) / 2];
            source.write_block(e, block);
            for (&value, &slot) in block.iter().zip(&mut slots) {
                self.values[slot] += value;
            }
        }
    }

    /// Stored entries of the factor.
    #[allow(dead_code, reason = "not every program prints it")]
    pub(crate) fn n_entries(&self) -> usize {
        self.factor.len()
    }

    pub(crate) fn factor_and_solve(&mut self, x: &mut [f64]) {
        let a = SparseColMatRef::new(self.pattern.as_ref(), self.values.as_slice());
        let stack = MemStack::new(&mut self.memory);
        let factor = self
            .symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                a,
                Side::Upper,
                LltRegularization::default(),
                Par::Seq,
                stack,
                Default::default(),
            )
            .expect("positive definite");
        let n = x.len();
        let rhs = MatMut::from_column_major_slice_mut(x, n, 1);
        let stack = MemStack::new(&mut self.memory);
        factor.solve_in_place_with_conj(Conj::No, rhs, Par::Seq, stack);
    }
}

//! L D L^T of a sum of element blocks, front by front; no matrix of all unknowns is ever formed.
//!
//! ```text
//! front_s = sum of elements whose first unknown it eliminates + sum of updates of its children
//!         = [ L_11    ] [ D      ] [ L_11^T  L_21^T ]
//!           [ L_21  I ] [     U  ] [         I      ]          U: update for the parent
//! ```

use crate::kernel::{self, BadPivot};
use crate::options::{Counters, Options, Pivoting};
use crate::pivoting::eliminate_largest;
use crate::plan::{Front, Part, Place, Plan, column, plan};
use crate::sweep;
use mbs_core::{BlockSource, Cliques, FactorError, Real, SpdSolver};

/// Serial multifrontal L D L^T: analysed once, factored many times without allocation.
#[derive(Debug, Clone)]
pub struct Multifrontal<T: Real> {
    plan: Plan,
    pivoting: Pivoting,
    /// All fronts, one after the other.
    fronts: Vec<T>,
    pivots: Vec<T>,
    /// Unknowns in the order in which they were eliminated last.
    order: Vec<u32>,
    /// Whether there is one front, in the given order and without pivoting.
    is_one_block: bool,
    /// For each pivot its row in its front before the swaps of [`Pivoting::Diagonal`].
    taken: Vec<u32>,
    /// One block or one residual of an element.
    block: Vec<T>,
}

impl<T: Real> Multifrontal<T> {
    /// Orders the unknowns, finds the fronts and freezes every index map.
    ///
    /// Cost: near linear in the sum of the squares of the cliques' lengths plus the entries of L; the only place that
    /// allocates.
    ///
    /// # Panics
    /// When a clique names an unknown that does not exist, or one unknown twice; with more than 2^32 - 1 unknowns,
    /// elements or scattered entries.
    pub fn analyse(cliques: &impl Cliques, options: Options) -> Self {
        let plan = plan(cliques, options);
        let k = plan.largest_clique;
        let n_taken = if options.pivoting == Pivoting::Diagonal { plan.order.len() } else { 0 };
        Self {
            pivoting: options.pivoting,
            is_one_block: plan.fronts.len() == 1 && plan.is_natural && n_taken == 0,
            fronts: vec![T::ZERO; plan.counters.stored],
            pivots: vec![T::ZERO; plan.order.len()],
            order: plan.order.clone(),
            taken: vec![0; n_taken],
            block: vec![T::ZERO; k * (k + 1) / 2],
            plan,
        }
    }

    /// The exact sizes of this analysis.
    pub fn counters(&self) -> Counters {
        self.plan.counters
    }

    /// Eliminates the pivots of one assembled front.
    #[inline(always)]
    fn eliminate(&mut self, front: usize) -> Result<(), FactorError> {
        let Front { p, f, offset, first, .. } = self.plan.fronts[front];
        let a = &mut self.fronts[offset..offset + column(f, f)];
        let d = &mut self.pivots[first..first + p];
        let result = match self.pivoting {
            Pivoting::None => kernel::eliminate(a, d, f),
            Pivoting::Diagonal => {
                let taken = &mut self.taken[first..first + p];
                let result = eliminate_largest(a, d, taken, f);
                for (u, &row) in self.order[first..].iter_mut().zip(&*taken) {
                    *u = self.plan.order[first + row as usize];
                }
                result
            }
        };
        result.map_err(|BadPivot { column, pivot }| FactorError {
            unknown: self.order[first + column],
            pivot: pivot.to_f64(),
        })
    }

    /// Forward and backward sweep on `y`, in the order of the analysis.
    fn sweep(&self, y: &mut [T], scratch: &mut [T]) {
        for front in &self.plan.fronts {
            self.visit(front, y, scratch, Direction::Forward);
        }
        for front in self.plan.fronts.iter().rev() {
            self.visit(front, y, scratch, Direction::Backward);
        }
    }

    /// One front of one sweep.
    #[inline(always)]
    fn visit(&self, front: &Front, y: &mut [T], scratch: &mut [T], direction: Direction) {
        let Front { p, f, offset, first, .. } = *front;
        let a = &self.fronts[offset..offset + column(f, f)];
        let taken = self.taken.get(first..first + p);
        if taken.is_none() && front.is_consecutive {
            let z = &mut y[first..first + f];
            return match direction {
                Direction::Forward => sweep::forward(a, z, p),
                Direction::Backward => sweep::backward(a, z, p),
            };
        }
        let rows = &self.plan.rows[front.rows.clone()];
        let (z1, z2) = scratch[..f].split_at_mut(p);
        let place = |k: usize| first + taken.map_or(k, |taken| taken[k] as usize);
        match direction {
            Direction::Forward => (0..p).for_each(|k| z1[k] = y[place(k)]),
            Direction::Backward => z1.copy_from_slice(&y[first..first + p]),
        }
        for (z, &row) in z2.iter_mut().zip(rows) {
            *z = y[row as usize];
        }
        let z = &mut scratch[..f];
        match direction {
            Direction::Forward => {
                sweep::forward(a, z, p);
                y[first..first + p].copy_from_slice(&z[..p]);
                for (&z, &row) in z[p..].iter().zip(rows) {
                    y[row as usize] = z;
                }
            }
            Direction::Backward => {
                sweep::backward(a, z, p);
                (0..p).for_each(|k| y[place(k)] = z[k]);
            }
        }
    }
}

/// The two sweeps of a solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Direction {
    Forward,
    Backward,
}

/// Adds the packed triangle `from` of a part into the packed front `a` of `f` unknowns.
#[inline(always)]
pub(crate) fn add_part<T: Real>(a: &mut [T], f: usize, part: &Part, targets: &[u32], from: &[T]) {
    match part.place {
        Place::Tail(offset) => kernel::add(&mut a[offset as usize..], from),
        Place::Shifted(first) => {
            let (first, size) = (first as usize, part.size as usize);
            let mut from = from;
            for j in 0..size {
                let (head, rest) = from.split_at(size - j);
                let at = column(f, first + j);
                kernel::add(&mut a[at..at + size - j], head);
                from = rest;
            }
        }
        Place::Scattered(start) => {
            let targets = &targets[start as usize..][..from.len()];
            for (&target, &value) in targets.iter().zip(from) {
                a[target as usize] += value;
            }
        }
    }
}

impl<T: Real> SpdSolver<T> for Multifrontal<T> {
    /// Fails with the first pivot that is zero, negative, infinite or not a number.
    fn factor<S: BlockSource<T>>(&mut self, source: &S) -> Result<(), FactorError> {
        for s in 0..self.plan.fronts.len() {
            let front = &self.plan.fronts[s];
            let f = front.f;
            let (done, rest) = self.fronts.split_at_mut(front.offset);
            let a = &mut rest[..column(f, f)];
            let mut elements = &self.plan.elements[front.elements.clone()];
            if front.is_first_whole {
                source.write_block(elements[0].source, a);
                elements = &elements[1..];
            } else {
                a.fill(T::ZERO);
            }
            for part in elements {
                let size = part.size as usize;
                let block = &mut self.block[..size * (size + 1) / 2];
                source.write_block(part.source, block);
                add_part(a, f, part, &self.plan.targets, block);
            }
            for part in &self.plan.children[front.children.clone()] {
                let size = part.size as usize;
                let update = &done[part.source..part.source + size * (size + 1) / 2];
                add_part(a, f, part, &self.plan.targets, update);
            }
            self.eliminate(s)?;
        }
        Ok(())
    }

    fn solve(&self, x: &mut [T], scratch: &mut [T]) {
        let n = self.plan.order.len();
        assert_eq!(x.len(), n, "solve needs one number for each unknown");
        assert!(scratch.len() >= self.n_scratch(), "solve needs n_scratch() places");
        if self.is_one_block && sweep::solve_small(&self.fronts, x) {
            return;
        }
        if self.plan.is_natural {
            return self.sweep(x, scratch);
        }
        let (y, scratch) = scratch.split_at_mut(n);
        for (y, &u) in y.iter_mut().zip(&self.plan.order) {
            *y = x[u as usize];
        }
        self.sweep(y, scratch);
        for (&y, &u) in y.iter().zip(&self.plan.order) {
            x[u as usize] = y;
        }
    }

    fn n_scratch(&self) -> usize {
        self.plan.order.len() + self.plan.counters.largest_front
    }

    fn assemble<S: BlockSource<T>>(&mut self, source: &S, f: &mut [T]) {
        assert_eq!(f.len(), self.plan.order.len(), "assemble needs one place for each unknown");
        f.fill(T::ZERO);
        for e in 0..self.plan.cliques.len() {
            let clique = self.plan.cliques.get(e);
            let residual = &mut self.block[..clique.len()];
            source.write_residual(e, residual);
            for (&u, &value) in clique.iter().zip(&*residual) {
                f[u as usize] += value;
            }
        }
    }

    fn pivots(&self) -> &[T] {
        &self.pivots
    }

    fn elimination_order(&self) -> &[u32] {
        &self.order
    }
}

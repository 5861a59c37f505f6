//! L D L^T of a symmetric indefinite sum of blocks, front by front, with pivots of one and two unknowns and delayed pivots.
//!
//! ```text
//! front_s = sum of S_e T_e S_e of its elements + updates of its children + unknowns its children could not eliminate
//!         = [ L_11    ] [ D      ] [ L_11^T  L_21^T ]          D of 1x1 and 2x2 blocks, S an equilibration
//!           [ L_21  I ] [     U  ] [         I      ]          U: update for the parent, what was delayed comes first
//! ```
//!
//! The method of Duff and Reid (ACM TOMS 9, 1983). Delayed unknowns stand in front of the planned ones of a front, so that the
//! maps of the analysis hold for its tail: a factorisation without delays runs through frozen maps only. A root takes every
//! pivot that is more than rounding; what it must leave over is singular and named.
//!
//! Multipliers ([`Cliques::n_primal`]) are placed right after the last coordinate of their elements. Then no pivot is delayed
//! as long as the coordinates have mass, apart from threshold tests that fail by the numbers.

use crate::options::{Counters, Options};
use crate::part;
use crate::plan::{Front, Plan, column, plan};
use mbs_core::blocks::{Inertia, Weakest};
use mbs_core::dense::front::{self, Places, Tally, Thresholds};
use mbs_core::dense::scaling;
use mbs_core::{BlockSource, Cliques, FactorError, Real, SymmetricSolver};

/// Serial multifrontal L D L^T with pivoting: analysed once, factored many times.
///
/// Storage for the planned fronts, and as much again as their pivots may be delayed once, is reserved by the analysis; a
/// factorisation that delays more than any before lets it grow, and the next one of the same kind allocates nothing.
#[derive(Debug, Clone)]
pub struct Indefinite<T: Real> {
    plan: Plan,
    thresholds: Thresholds<T>,
    /// The fronts that each front receives updates from, in the order of `plan.children`.
    children: Vec<u32>,
    /// For each child the rows of its parent at which its remaining unknowns stand, and where they begin.
    maps: Vec<u32>,
    map_starts: Vec<usize>,
    /// All blocks of the last factorisation, and where each begins.
    blocks: Vec<T>,
    block_starts: Vec<usize>,
    /// S, and the size of each pivot's sum, by unknown.
    scale: Vec<T>,
    size: Vec<T>,
    /// One scaled block.
    block: Vec<T>,
    factors: Factors<T>,
}

/// The result of a factorisation.
#[derive(Debug, Clone)]
struct Factors<T> {
    /// One for each front.
    stretches: Vec<Stretch>,
    fronts: Vec<T>,
    /// The unknowns of all fronts in the order of their rows.
    order: Vec<u32>,
    /// Whether a pivot is the first of a pair, beside `order`.
    pairs: Vec<bool>,
    tally: Tally,
    delays: Delays,
}

/// Where a front lies, and how many pivots it had.
#[derive(Debug, Clone, Copy, Default)]
struct Stretch {
    offset: usize,
    first: usize,
    f: usize,
    n_pivots: usize,
}

/// What became of the plan in the last factorisation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Delays {
    /// Unknowns that a front passed on to its parent, counted once for every front.
    pub delayed: usize,
    /// Unknowns of the largest front.
    pub largest_front: usize,
    /// Numbers stored for all fronts.
    pub stored: usize,
}

impl<T: Real> Indefinite<T> {
    /// Orders the unknowns, finds the fronts and freezes every index map. Of `options` the size of a dense front counts.
    ///
    /// # Panics
    /// When a clique names an unknown that does not exist, or one unknown twice; with more than 2^32 - 1 unknowns,
    /// elements or scattered entries.
    pub fn analyse(cliques: &impl Cliques, options: Options) -> Self {
        let plan = plan(cliques, Options { grain: u64::MAX, ..options });
        let n = plan.order.len();
        let (mut children, mut maps, mut map_starts) = (Vec::new(), Vec::new(), vec![0]);
        for front in &plan.fronts {
            for part in &plan.children[front.children.clone()] {
                let c = plan.fronts.partition_point(|f| f.offset <= part.source) - 1;
                children.push(crate::graph::index(c));
                maps.extend(child_rows(&plan, front, &plan.fronts[c]));
                map_starts.push(maps.len());
            }
        }
        let mut block_starts = vec![0];
        for e in 0..plan.cliques.len() {
            let k = plan.cliques.get(e).len();
            block_starts.push(block_starts[e] + column(k, k));
        }
        // A delayed unknown lengthens every column of the front that it comes to.
        let margin: usize = plan.fronts.iter().map(|front| 2 * front.f + 1).sum();
        let rows: usize = plan.fronts.iter().map(|front| front.f).sum();
        let k = plan.largest_clique;
        Self {
            thresholds: Thresholds::default(),
            children,
            maps,
            map_starts,
            blocks: vec![T::ZERO; block_starts[plan.cliques.len()]],
            block_starts,
            scale: vec![T::ONE; n],
            size: vec![T::ZERO; n],
            block: vec![T::ZERO; column(k, k)],
            factors: Factors {
                stretches: vec![Stretch::default(); plan.fronts.len()],
                fronts: vec![T::ZERO; plan.counters.stored + margin],
                order: vec![0; rows + n],
                pairs: vec![false; rows + n],
                tally: Tally::default(),
                delays: Delays::default(),
            },
            plan,
        }
    }

    /// Replaces the thresholds of the pivots.
    #[must_use]
    pub fn with_thresholds(self, thresholds: Thresholds<T>) -> Self {
        Self { thresholds, ..self }
    }

    /// The exact sizes of this analysis, as planned without delays.
    pub fn counters(&self) -> Counters {
        self.plan.counters
    }

    /// What became of the plan in the last factorisation.
    pub fn delays(&self) -> Delays {
        self.factors.delays
    }

    /// Takes the blocks over and finds the scaling.
    fn gather<S: BlockSource<T>>(&mut self, source: &S) {
        let (cliques, starts) = (&self.plan.cliques, &self.block_starts);
        for e in 0..cliques.len() {
            source.write_block(e, &mut self.blocks[starts[e]..starts[e + 1]]);
        }
        let blocks = &self.blocks;
        let all = (0..cliques.len()).map(|e| (cliques.get(e), &blocks[starts[e]..starts[e + 1]]));
        scaling::equilibrate(all, &mut self.scale, &mut self.size);
        self.size.fill(T::ZERO);
    }

    /// S_e T_e S_e of one element in `block`; its largest entry in each row counts for the size of that row.
    fn scale_block(&mut self, e: usize) -> usize {
        let clique = self.plan.cliques.get(e);
        let from = &self.blocks[self.block_starts[e]..self.block_starts[e + 1]];
        let mut at = 0;
        for (j, &v) in clique.iter().enumerate() {
            let s = self.scale[v as usize];
            let mut most = self.size[v as usize];
            for &u in &clique[j..] {
                let x = from[at] * s * self.scale[u as usize];
                self.block[at] = x;
                most = most.max(x.abs());
                self.size[u as usize] = self.size[u as usize].max(x.abs());
                at += 1;
            }
            self.size[v as usize] = most;
        }
        at
    }

    /// Assembles and eliminates front `s`; `used` are the places taken of the two stores, before and after.
    fn eliminate(&mut self, s: usize, used: (usize, usize)) -> (usize, usize) {
        let Front { p, f: planned, first, .. } = self.plan.fronts[s];
        let children = self.plan.fronts[s].children.clone();
        let delayed: usize = children
            .clone()
            .map(|c| {
                let child = self.children[c] as usize;
                let Stretch { f, n_pivots, .. } = self.factors.stretches[child];
                f - n_pivots - self.plan.children[c].size as usize
            })
            .sum();
        let f = planned + delayed;
        let end = (used.0 + column(f, f), used.1 + f);
        self.factors.reserve(end);

        self.factors.fronts[used.0..end.0].fill(T::ZERO);
        let tail = used.0 + column(f, delayed);
        for at in self.plan.fronts[s].elements.clone() {
            let part = self.plan.elements[at];
            let len = self.scale_block(part.source);
            let a = &mut self.factors.fronts[tail..end.0];
            part::add(a, planned, &part, &self.plan.targets, &self.block[..len]);
        }
        let mut place = 0;
        for c in children {
            place = self.add_child(c, (used, f), (delayed, place));
        }
        let order = &mut self.factors.order[used.1 + delayed..end.1];
        order[..p].copy_from_slice(&self.plan.order[first..first + p]);
        let rows = &self.plan.rows[self.plan.fronts[s].rows.clone()];
        for (to, &q) in order[p..].iter_mut().zip(rows) {
            *to = self.plan.order[q as usize];
        }

        let a = &mut self.factors.fronts[used.0..end.0];
        let mut places = Places {
            order: &mut self.factors.order[used.1..end.1],
            pairs: &mut self.factors.pairs[used.1..end.1],
            size: &mut self.size,
        };
        let (candidates, tally) = (delayed + p, &mut self.factors.tally);
        let n_pivots = front::eliminate(a, candidates, &mut places, &self.thresholds, tally);
        if candidates == f {
            tally.note_left(a, places.order, n_pivots, places.size);
        } else {
            self.factors.delays.delayed += candidates - n_pivots;
        }
        let delays = &mut self.factors.delays;
        delays.largest_front = delays.largest_front.max(f);
        self.factors.stretches[s] = Stretch { offset: used.0, first: used.1, f, n_pivots };
        end
    }

    /// Adds the update of child `c` of the plan into the front of `f` unknowns at `used`; its delayed unknowns come to the
    /// places from `place` on, of the `delayed` ones. Returns the place after them.
    fn add_child(
        &mut self,
        c: usize,
        (used, f): ((usize, usize), usize),
        (delayed, place): (usize, usize),
    ) -> usize {
        let part = &self.plan.children[c];
        let r = part.size as usize;
        let child = self.factors.stretches[self.children[c] as usize];
        let n = child.f - child.n_pivots - r;
        let (done, a) = self.factors.fronts.split_at_mut(used.0);
        let from = &done[child.offset..child.offset + column(child.f, child.f)];
        let tail = column(f, delayed);
        let update = &from[column(child.f, child.f - r)..];
        part::add(&mut a[tail..], f - delayed, part, &self.plan.targets, update);
        let map = &self.maps[self.map_starts[c]..self.map_starts[c + 1]];
        for i in 0..n {
            let column_of_child = &from[column(child.f, child.n_pivots + i)..];
            let to = &mut a[column(f, place + i)..column(f, place + i + 1)];
            to[..n - i].copy_from_slice(&column_of_child[..n - i]);
            for (&row, &x) in map.iter().zip(&column_of_child[n - i..]) {
                to[delayed + row as usize - (place + i)] = x;
            }
        }
        let names = child.first + child.n_pivots;
        self.factors.order.copy_within(names..names + n, used.1 + place);
        place + n
    }

    /// The pivots of front `s` on z, gathered from x and put back.
    fn visit(
        &self,
        s: usize,
        x: &mut [T],
        scratch: &mut [T],
        sweep: impl Fn(&[T], &[bool], &mut [T]),
    ) {
        let Stretch { offset, first, f, n_pivots } = self.factors.stretches[s];
        let a = &self.factors.fronts[offset..offset + column(f, f)];
        let order = &self.factors.order[first..first + f];
        let z = &mut scratch[..f];
        for (z, &u) in z.iter_mut().zip(order) {
            *z = x[u as usize];
        }
        sweep(a, &self.factors.pairs[first..first + n_pivots], z);
        for (&z, &u) in z.iter().zip(order) {
            x[u as usize] = z;
        }
    }
}

impl<T: Real> Factors<T> {
    /// Makes room for so many numbers and names. Allocates only where more is wanted than ever before.
    fn reserve(&mut self, (numbers, names): (usize, usize)) {
        if self.fronts.len() < numbers {
            self.fronts.resize(numbers, T::ZERO);
        }
        if self.order.len() < names {
            self.order.resize(names, 0);
            self.pairs.resize(names, false);
        }
    }
}

/// The rows of `front` at which the remaining unknowns of its child stand.
fn child_rows<'a>(
    plan: &'a Plan,
    front: &'a Front,
    child: &Front,
) -> impl Iterator<Item = u32> + use<'a> {
    let rows = &plan.rows[front.rows.clone()];
    plan.rows[child.rows.clone()].iter().map(move |&q| {
        let row = match (q as usize).checked_sub(front.first) {
            Some(k) if k < front.p => k,
            _ => front.p + rows.partition_point(|&row| row < q),
        };
        crate::graph::index(row)
    })
}

impl<T: Real> SymmetricSolver<T> for Indefinite<T> {
    /// Cost: that of the fronts as planned, more where pivots are delayed; three passes over the blocks for the scaling.
    fn factor<S: BlockSource<T>>(&mut self, source: &S) -> Result<(), FactorError> {
        self.gather(source);
        self.factors.tally = Tally::default();
        self.factors.delays = Delays::default();
        let mut used = (0, 0);
        for s in 0..self.plan.fronts.len() {
            used = self.eliminate(s, used);
        }
        self.factors.delays.stored = used.0;
        self.factors.tally.verdict()
    }

    fn solve(&self, x: &mut [T], scratch: &mut [T]) {
        assert_eq!(x.len(), self.scale.len(), "solve needs one number for each unknown");
        assert!(scratch.len() >= self.n_scratch(), "solve needs n_scratch() places");
        for (x, &s) in x.iter_mut().zip(&self.scale) {
            *x *= s;
        }
        for s in 0..self.plan.fronts.len() {
            self.visit(s, x, scratch, front::forward);
        }
        for s in (0..self.plan.fronts.len()).rev() {
            self.visit(s, x, scratch, |a, pairs, z| front::backward(a, pairs, z, true));
        }
        for (x, &s) in x.iter_mut().zip(&self.scale) {
            *x *= s;
        }
    }

    fn n_scratch(&self) -> usize {
        self.scale.len()
    }

    fn assemble<S: BlockSource<T>>(&mut self, source: &S, f: &mut [T]) {
        assert_eq!(f.len(), self.scale.len(), "assemble needs one place for each unknown");
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

    fn subtract_product(&self, x: &[T], b: &mut [T]) {
        for e in 0..self.plan.cliques.len() {
            let block = &self.blocks[self.block_starts[e]..self.block_starts[e + 1]];
            scaling::subtract_product(self.plan.cliques.get(e), block, x, b);
        }
    }

    fn inertia(&self) -> Inertia {
        self.factors.tally.inertia
    }

    fn weakest(&self) -> Weakest {
        self.factors.tally.weakest
    }

    fn null_vector(&self, x: &mut [T], scratch: &mut [T]) {
        let unknown = self.factors.tally.weakest.unknown as usize;
        x.fill(T::ZERO);
        let Some(&unit) = self.scale.get(unknown) else { return };
        x[unknown] = T::ONE;
        for s in (0..self.plan.fronts.len()).rev() {
            self.visit(s, x, scratch, |a, pairs, z| front::backward(a, pairs, z, false));
        }
        for (x, &s) in x.iter_mut().zip(&self.scale) {
            *x *= s / unit;
        }
    }
}

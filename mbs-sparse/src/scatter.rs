//! Sums, by unknown, of values that elements write for their unknowns. One thread and several threads give the same bits.
//!
//! ```text
//! elements   [ stretch 1 | stretch 2 | ... ]        unknowns   [ first used in stretch 1 | in stretch 2 | ... ]
//! a stretch sums values of unknowns first used in it, and stores those of earlier unknowns; then the stored values are added
//! ```
//!
//! The values of one unknown are summed in the order of the elements: the stretch that uses the unknown first comes before all others.

use crate::graph::{Lists, index};
use crate::plan::Plan;
use mbs_math::blocks::combine;
use mbs_math::{BlockSource, Real, Team};

/// Number of elements of a stretch [-], which is work of some microseconds.
const ELEMENTS: usize = 128;

/// Scratch for the values, and the division of the elements into stretches.
#[derive(Debug, Clone)]
pub(crate) struct Scatter<T> {
    /// Values of one element. For a team: the stored values, and scratch for an element of each stretch.
    values: Vec<T>,
    /// Division for a team; `None` for one thread.
    cuts: Option<Cuts>,
}

/// Division of the elements into stretches for a team.
#[derive(Debug, Clone)]
struct Cuts {
    /// First element, first unknown and first stored value of each stretch; at the end the three totals.
    marks: Vec<[usize; 3]>,
    /// For each stretch, the unknowns that it uses first and for which later stretches store values.
    incoming: Lists,
    /// Index of the stored value for each entry of `incoming`.
    kept: Vec<u32>,
    /// Number of unknowns of the largest element.
    largest: usize,
}

impl Cuts {
    fn new(cliques: &Lists, n: usize, largest: usize) -> Self {
        let incoming = Lists::with_capacity(cliques.len() / ELEMENTS + 1);
        let mut cuts = Self { marks: Vec::new(), incoming, kept: Vec::new(), largest };
        let (mut met, mut kept_for) = (0, Vec::new());
        for first in (0..cliques.len()).step_by(ELEMENTS) {
            cuts.marks.push([first, met, kept_for.len()]);
            let stretch = first..cliques.len().min(first + ELEMENTS);
            let unknowns = || stretch.clone().flat_map(|e| cliques.get(e)).map(|&u| u as usize);
            for u in unknowns().filter(|&u| u < met) {
                let owner = cuts.marks.partition_point(|mark| mark[1] <= u) - 1;
                kept_for.push((owner, index(u), index(kept_for.len())));
            }
            met = met.max(unknowns().max().map_or(0, |u| u + 1));
        }
        cuts.marks.push([cliques.len(), n, kept_for.len()]);
        // The stable sort keeps the order of the values for one stretch.
        kept_for.sort_by_key(|&(owner, ..)| owner);
        let mut rest = kept_for.iter().peekable();
        for owner in 0..cuts.n_stretches() {
            while let Some(&(_, u, k)) = rest.next_if(|kept| kept.0 == owner) {
                cuts.incoming.items.push(u);
                cuts.kept.push(k);
            }
            cuts.incoming.close();
        }
        cuts
    }

    fn n_stretches(&self) -> usize {
        self.marks.len() - 1
    }

    fn n_kept(&self) -> usize {
        self.kept.len()
    }
}

impl<T: Real> Scatter<T> {
    /// Creates the scratch for the elements of `plan`.
    pub(crate) fn new(team: &impl Team, plan: &Plan) -> Self {
        let (cliques, largest) = (&plan.cliques, plan.largest_clique);
        let is_cut = team.size() > 1 && cliques.len() > 0;
        let cuts = is_cut.then(|| Cuts::new(cliques, plan.order.len(), largest));
        let n = cuts.as_ref().map_or(largest, |cuts| cuts.n_kept() + cuts.n_stretches() * largest);
        Self { values: vec![T::ZERO; n], cuts }
    }

    /// Starts each `out[u]` at zero and joins it with the values of all elements for u, in the order of the elements.
    #[inline(always)]
    pub(crate) fn combine<W: Team>(
        &mut self,
        team: &W,
        cliques: &Lists,
        out: &mut [T],
        write: impl Fn(usize, &mut [T]) + Sync,
        join: impl Fn(T, T) -> T + Sync,
    ) {
        let Some(cuts) = &self.cuts else {
            let all = (0..cliques.len()).map(|e| cliques.get(e));
            return combine(all, (&mut self.values, out), T::ZERO, write, join);
        };
        let work = Work { cuts, cliques, write, join };
        let (kept, rooms) = self.values.split_at_mut(cuts.n_kept());
        let all = (0, cuts.n_stretches());
        work.stretches(team, all, (kept, rooms), out);
        work.take(team, all, kept, out);
    }

    /// Sums the residuals of all elements.
    pub(crate) fn sum<W: Team, S: BlockSource<T>>(
        &mut self,
        team: &W,
        cliques: &Lists,
        source: &S,
        f: &mut [T],
    ) {
        if self.cuts.is_none() && source.sum_residuals(f) {
            return;
        }
        let write = |e: usize, residual: &mut [T]| source.write_residual(e, residual);
        self.combine(team, cliques, f, write, |sum, x| sum + x);
    }
}

/// Data for the work of a team.
struct Work<'a, F, J> {
    cuts: &'a Cuts,
    cliques: &'a Lists,
    write: F,
    join: J,
}

impl<F, J> Work<'_, F, J> {
    /// Evaluates the elements of stretches `from..to`.
    fn stretches<T: Real, W: Team>(
        &self,
        team: &W,
        (from, to): (usize, usize),
        (kept, rooms): (&mut [T], &mut [T]),
        out: &mut [T],
    ) where
        F: Fn(usize, &mut [T]) + Sync,
        J: Fn(T, T) -> T + Sync,
    {
        let marks = &self.cuts.marks;
        let [first, met, n_kept] = marks[from];
        if to - from > 1 {
            let half = from + (to - from) / 2;
            let (out_left, out_right) = out.split_at_mut(marks[half][1] - met);
            let (kept_left, kept_right) = kept.split_at_mut(marks[half][2] - n_kept);
            let (left, right) = rooms.split_at_mut((half - from) * self.cuts.largest);
            team.join(
                || self.stretches(team, (from, half), (kept_left, left), out_left),
                || self.stretches(team, (half, to), (kept_right, right), out_right),
            );
            return;
        }
        out.fill(T::ZERO);
        let mut kept = kept.iter_mut();
        for e in first..marks[to][0] {
            let clique = self.cliques.get(e);
            let values = &mut rooms[..clique.len()];
            (self.write)(e, values);
            for (&u, &value) in clique.iter().zip(&*values) {
                if let Some(own) = (u as usize).checked_sub(met) {
                    out[own] = (self.join)(out[own], value);
                } else if let Some(place) = kept.next() {
                    *place = value;
                }
            }
        }
    }

    /// Joins the stored values with those of the unknowns of stretches `from..to`.
    fn take<T: Real, W: Team>(
        &self,
        team: &W,
        (from, to): (usize, usize),
        kept: &[T],
        out: &mut [T],
    ) where
        F: Sync,
        J: Fn(T, T) -> T + Sync,
    {
        let Cuts { marks, incoming, kept: places, .. } = self.cuts;
        let met = marks[from][1];
        if to - from > 1 {
            let half = from + (to - from) / 2;
            let (left, right) = out.split_at_mut(marks[half][1] - met);
            team.join(
                || self.take(team, (from, half), kept, left),
                || self.take(team, (half, to), kept, right),
            );
            return;
        }
        for (&u, &k) in incoming.get(from).iter().zip(&places[incoming.start[from]..]) {
            let own = u as usize - met;
            out[own] = (self.join)(out[own], kept[k as usize]);
        }
    }
}

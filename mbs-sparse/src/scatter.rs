//! Sums the residuals of all elements, by one thread or by several: the same bits.
//!
//! ```text
//! elements   [ stretch 1 | stretch 2 | ... ]        unknowns   [ first met in stretch 1 | in stretch 2 | ... ]
//! a stretch adds to the unknowns first met in it, and keeps what it has for earlier ones; then each gets what was kept for it
//! ```
//!
//! Whoever adds them, the parts of an unknown are added in the order of the elements: those of the stretch where it is first
//! met come before all others.

use crate::graph::{Lists, index};
use mbs_core::{BlockSource, Real, Team};

/// Elements of a stretch: some microseconds of work.
const ELEMENTS: usize = 128;

/// Where the sum of all residuals is cut.
#[derive(Debug, Clone, Default)]
pub(crate) struct Cuts {
    /// First element, first unknown and first kept number of each stretch, and the ends.
    marks: Vec<[usize; 3]>,
    /// For each stretch the unknowns first met in it for which others keep numbers.
    incoming: Lists,
    /// Beside them, which numbers.
    kept: Vec<u32>,
}

impl Cuts {
    /// Cuts the elements for `n` unknowns.
    pub(crate) fn new(cliques: &Lists, n: usize) -> Self {
        let incoming = Lists::with_capacity(cliques.len() / ELEMENTS + 1);
        let mut cuts = Self { incoming, ..Self::default() };
        let (mut met, mut n_kept) = (0, 0);
        let mut kept_for = Vec::new();
        for first in (0..cliques.len()).step_by(ELEMENTS) {
            cuts.marks.push([first, met, n_kept]);
            let stretch = first..cliques.len().min(first + ELEMENTS);
            let unknowns = || stretch.clone().flat_map(|e| cliques.get(e)).map(|&u| u as usize);
            for u in unknowns().filter(|&u| u < met) {
                let owner = cuts.marks.partition_point(|mark| mark[1] <= u) - 1;
                kept_for.push((index(owner), index(u), index(n_kept)));
                n_kept += 1;
            }
            met = met.max(unknowns().max().map_or(0, |u| u + 1));
        }
        cuts.marks.push([cliques.len(), n, n_kept]);
        // The numbers of a stretch stay in their order.
        kept_for.sort_by_key(|&(owner, ..)| owner);
        let mut rest = kept_for.iter().peekable();
        for owner in 0..index(cuts.marks.len() - 1) {
            while let Some(&(_, u, k)) = rest.next_if(|kept| kept.0 == owner) {
                cuts.incoming.items.push(u);
                cuts.kept.push(k);
            }
            cuts.incoming.close();
        }
        cuts
    }

    /// Numbers that stretches keep for unknowns of earlier ones.
    pub(crate) fn n_kept(&self) -> usize {
        self.marks.last().map_or(0, |end| end[2])
    }
}

/// f <- the sum of all residuals, by one thread. `residual` has room for the largest.
pub(crate) fn scatter<T: Real>(
    source: &impl BlockSource<T>,
    cliques: &Lists,
    residual: &mut [T],
    f: &mut [T],
) {
    f.fill(T::ZERO);
    for e in 0..cliques.len() {
        let clique = cliques.get(e);
        let residual = &mut residual[..clique.len()];
        source.write_residual(e, residual);
        for (&u, &value) in clique.iter().zip(&*residual) {
            f[u as usize] += value;
        }
    }
}

/// The same sum for a team.
#[derive(Debug)]
pub(crate) struct Shared<'a, S> {
    pub(crate) source: &'a S,
    pub(crate) cliques: &'a Lists,
    pub(crate) cuts: &'a Cuts,
    pub(crate) largest: usize,
}

impl<S> Shared<'_, S> {
    /// Numbers of storage that it needs.
    pub(crate) fn n_storage(cuts: &Cuts, largest: usize) -> usize {
        cuts.n_kept() + (cuts.marks.len() - 1) * largest
    }

    /// f <- the sum of all residuals.
    pub(crate) fn sum<T: Real, W: Team>(&self, team: &W, storage: &mut [T], f: &mut [T])
    where
        S: BlockSource<T>,
    {
        let stretches = (0, self.cuts.marks.len() - 1);
        let (kept, rooms) = storage.split_at_mut(self.cuts.n_kept());
        if stretches.1 == 0 {
            return f.fill(T::ZERO);
        }
        self.write(team, stretches, (kept, rooms), f);
        self.take(team, stretches, kept, f);
    }

    /// The own parts of stretches `from..to`.
    fn write<T: Real, W: Team>(
        &self,
        team: &W,
        (from, to): (usize, usize),
        (kept, rooms): (&mut [T], &mut [T]),
        f: &mut [T],
    ) where
        S: BlockSource<T>,
    {
        let marks = &self.cuts.marks;
        let [first, met, n_kept] = marks[from];
        if to - from > 1 {
            let half = from + (to - from) / 2;
            let (f_left, f_right) = f.split_at_mut(marks[half][1] - met);
            let (kept_left, kept_right) = kept.split_at_mut(marks[half][2] - n_kept);
            let (left, right) = rooms.split_at_mut((half - from) * self.largest);
            team.join(
                || self.write(team, (from, half), (kept_left, left), f_left),
                || self.write(team, (half, to), (kept_right, right), f_right),
            );
            return;
        }
        f.fill(T::ZERO);
        let mut kept = kept.iter_mut();
        for e in first..marks[to][0] {
            let clique = self.cliques.get(e);
            let residual = &mut rooms[..clique.len()];
            self.source.write_residual(e, residual);
            for (&u, &value) in clique.iter().zip(&*residual) {
                if let Some(own) = (u as usize).checked_sub(met) {
                    f[own] += value;
                } else if let Some(place) = kept.next() {
                    *place = value;
                }
            }
        }
    }

    /// Adds what is kept for the unknowns of stretches `from..to`.
    fn take<T: Real, W: Team>(&self, team: &W, (from, to): (usize, usize), kept: &[T], f: &mut [T])
    where
        S: BlockSource<T>,
    {
        let met = self.cuts.marks[from][1];
        if to - from > 1 {
            let half = from + (to - from) / 2;
            let (left, right) = f.split_at_mut(self.cuts.marks[half][1] - met);
            team.join(
                || self.take(team, (from, half), kept, left),
                || self.take(team, (half, to), kept, right),
            );
            return;
        }
        let places = &self.cuts.kept[self.cuts.incoming.start[from]..];
        for (&u, &k) in self.cuts.incoming.get(from).iter().zip(places) {
            f[u as usize - met] += kept[k as usize];
        }
    }
}

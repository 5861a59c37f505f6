//! What elements write for their unknowns, brought together by unknown.
//!
//! ```text
//! one thread:  element by element, each value to its unknown        a team:  all elements write, then each unknown collects
//! ```
//!
//! Values of one unknown meet in the order of the elements either way: the same bits.

use crate::graph::Lists;
use crate::plan::Plan;
use mbs_core::blocks::combine;
use mbs_core::team::{Team, on_elements, on_stretches};
use mbs_core::{BlockSource, Real};

/// Room for the values, and where each unknown finds its own.
#[derive(Debug, Clone)]
pub(crate) struct Scatter<T> {
    /// Values of all elements; of one where the team is one.
    values: Vec<T>,
    /// For each unknown where it stands in `values`, in the order of the elements; empty where the team is one.
    parts: Lists,
}

impl<T: Real> Scatter<T> {
    /// Room for the elements of `plan`.
    pub(crate) fn new(team: &impl Team, plan: &Plan) -> Self {
        if team.size() == 1 {
            let values = vec![T::ZERO; plan.largest_clique];
            return Self { values, parts: Lists::default() };
        }
        let items = &plan.cliques.items;
        let single = Lists { start: (0..=items.len()).collect(), items: items.clone() };
        Self { values: vec![T::ZERO; items.len()], parts: single.transposed(plan.order.len()) }
    }

    /// out[u] = zero joined with what every element writes for u, in the order of the elements.
    #[inline(always)]
    pub(crate) fn combine<W: Team>(
        &mut self,
        team: &W,
        cliques: &Lists,
        out: &mut [T],
        write: impl Fn(usize, &mut [T]) + Sync,
        join: impl Fn(T, T) -> T + Sync,
    ) {
        if team.size() == 1 {
            let all = (0..cliques.len()).map(|e| cliques.get(e));
            combine(all, (&mut self.values, out), T::ZERO, write, join);
            return;
        }
        on_elements(team, &cliques.start, &mut self.values, write);
        let (values, parts) = (&self.values, &self.parts);
        on_stretches(team, [out], |first, [out]| {
            for (u, out) in out.iter_mut().enumerate() {
                let places = parts.get(first + u).iter();
                *out = places.fold(T::ZERO, |sum, &at| join(sum, values[at as usize]));
            }
        });
    }

    /// The residuals of all elements, summed.
    pub(crate) fn sum<W: Team, S: BlockSource<T>>(
        &mut self,
        team: &W,
        cliques: &Lists,
        source: &S,
        f: &mut [T],
    ) {
        let write = |e: usize, residual: &mut [T]| source.write_residual(e, residual);
        self.combine(team, cliques, f, write, |sum, x| sum + x);
    }
}

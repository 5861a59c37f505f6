//! Nested dissection of the graph of nodes, for the upper levels of the tree. Threads can eliminate separated halves at the same time.
//!
//! ```text
//! part = left + separator + right,   no edge between left and right      order: left, right, separator
//! ```
//!
//! Halves result from the levels of a breadth-first search that starts at a peripheral node (George 1973). The parts after the last
//! division are ordered by minimum degree. On a chain, the first cut adds no work. Every further cut replaces fronts of two links by fronts
//! of three.

use crate::graph::{Lists, index, minimum_degree, neighbours};

/// Smallest weight of a half relative to its part, if a cut with such halves exists [-]. Chosen, not tuned.
const LEAST_HALF: f64 = 0.3;

/// Returns the position of each node after `depth` levels of dissection.
pub(crate) fn dissected(elements: &Lists, weight: &[usize], depth: u32) -> Vec<u32> {
    let n = weight.len();
    let mut cutter = Cutter {
        neighbours: neighbours(elements, n),
        weight,
        level: vec![UNSEEN; n],
        part: vec![0; n],
        n_parts: 1,
    };
    let all: Vec<u32> = (0..n).map(index).collect();
    let mut order = Vec::with_capacity(n);
    let mut leaves = Vec::new();
    cutter.order(all, depth, &mut order, &mut leaves);
    order_leaves(elements, &mut order, &leaves);
    let mut place = vec![0; n];
    for (k, &v) in order.iter().enumerate() {
        place[v as usize] = index(k);
    }
    place
}

/// Level of a node that the current search has not reached.
const UNSEEN: u32 = u32::MAX;

struct Cutter<'a> {
    neighbours: Lists,
    weight: &'a [usize],
    /// Level of each node in the last search of its part. The level is the distance from the start of the search.
    level: Vec<u32>,
    /// Index of the part that each node belongs to.
    part: Vec<u32>,
    n_parts: u32,
}

impl Cutter<'_> {
    /// Appends the nodes of a part to the order; ranges that are not divided further are added to `leaves`.
    fn order(
        &mut self,
        part: Vec<u32>,
        depth: u32,
        order: &mut Vec<u32>,
        leaves: &mut Vec<(usize, usize)>,
    ) {
        let halves = if depth > 0 { self.halves(&part) } else { None };
        let Some([left, right, separator]) = halves else {
            leaves.push((order.len(), order.len() + part.len()));
            order.extend(part);
            return;
        };
        for half in [&left, &right, &separator] {
            for &v in half {
                self.part[v as usize] = self.n_parts;
            }
            self.n_parts += 1;
        }
        self.order(left, depth - 1, order, leaves);
        self.order(right, depth - 1, order, leaves);
        leaves.push((order.len(), order.len() + separator.len()));
        order.extend(separator);
    }

    /// Divides a part into two halves and a separator; `None` if the part is too small or too dense.
    fn halves(&mut self, part: &[u32]) -> Option<[Vec<u32>; 3]> {
        let (&first, id) = (part.first()?, self.part[*part.first()? as usize]);
        // The last node that a search reaches is peripheral. Two searches are enough.
        let mut from = first;
        for _ in 0..2 {
            self.forget(part);
            from = *self.search(from, id, 0).last()?;
        }
        self.forget(part);
        let mut seen = self.search(from, id, 0);
        // Each unconnected component has levels of its own, after those of the component before. Cuts between components need no separator.
        for &v in part {
            if self.level[v as usize] == UNSEEN {
                let next = self.level[*seen.last()? as usize] + 2;
                seen.extend(self.search(v, id, next));
            }
        }
        let cut = self.best_level(&seen)?;
        let (mut left, mut right, mut separator) = (Vec::new(), Vec::new(), Vec::new());
        for &v in part {
            let is_edge = || {
                let beyond = self.neighbours.get(v as usize).iter();
                let mut beyond = beyond.filter(|&&w| self.part[w as usize] == id);
                beyond.any(|&w| self.level[w as usize] == cut + 1)
            };
            match self.level[v as usize].cmp(&cut) {
                core::cmp::Ordering::Greater => right.push(v),
                core::cmp::Ordering::Equal if is_edge() => separator.push(v),
                _ => left.push(v),
            }
        }
        (!left.is_empty() && !right.is_empty()).then_some([left, right, separator])
    }

    fn forget(&mut self, part: &[u32]) {
        for &v in part {
            self.level[v as usize] = UNSEEN;
        }
    }

    /// Returns the nodes of part `id` that are connected with `from`, breadth first; `from` has the given `level`.
    fn search(&mut self, from: u32, id: u32, level: u32) -> Vec<u32> {
        let mut seen = vec![from];
        self.level[from as usize] = level;
        let mut at = 0;
        while at < seen.len() {
            let v = seen[at] as usize;
            for &w in self.neighbours.get(v) {
                let w_at = w as usize;
                if self.part[w_at] == id && self.level[w_at] == UNSEEN {
                    self.level[w_at] = self.level[v] + 1;
                    seen.push(w);
                }
            }
            at += 1;
        }
        seen
    }

    /// Returns the level of least weight that leaves enough weight on both sides. Among equal levels it returns the one closest to the
    /// middle.
    fn best_level(&self, seen: &[u32]) -> Option<u32> {
        let mut by_level = vec![0_usize; self.level[*seen.last()? as usize] as usize + 1];
        for &v in seen {
            by_level[self.level[v as usize] as usize] += self.weight[v as usize];
        }
        let total: usize = by_level.iter().sum();
        let mut before = 0;
        let mut best = None;
        for (level, &here) in by_level.iter().enumerate() {
            let after = total - before - here;
            let smaller = before.min(after);
            if smaller as f64 >= LEAST_HALF * (total - here) as f64 {
                let key = (here, before.abs_diff(after));
                if best.is_none_or(|(least, _)| key < least) {
                    best = Some((key, index(level)));
                }
            }
            before += here;
        }
        best.map(|(_, level)| level)
    }
}

/// Number of nodes that represent all later unknowns [-]. With enough of them, minimum degree places their neighbours last. Chosen, not
/// tuned.
const LATER: u32 = 8;

/// Orders each leaf (a part that is not divided further) by minimum degree. Nodes with neighbours in a later leaf are placed late.
fn order_leaves(elements: &Lists, order: &mut [u32], leaves: &[(usize, usize)]) {
    let n = order.len();
    let mut leaf = vec![0; n];
    let mut number = vec![0; n];
    for (l, &(from, to)) in leaves.iter().enumerate() {
        for (k, &v) in order[from..to].iter().enumerate() {
            (leaf[v as usize], number[v as usize]) = (l, index(k));
        }
    }
    // The elements of each leaf contain only the nodes of the leaf and nodes that represent all later leaves.
    let mut lists: Vec<Lists> = leaves.iter().map(|_| Lists::with_capacity(0)).collect();
    for e in 0..elements.len() {
        let mut owners: Vec<usize> = elements.get(e).iter().map(|&v| leaf[v as usize]).collect();
        owners.sort_unstable();
        owners.dedup();
        for (i, &l) in owners.iter().enumerate() {
            let own = elements.get(e).iter().filter(|&&v| leaf[v as usize] == l);
            lists[l].items.extend(own.map(|&v| number[v as usize]));
            if i + 1 < owners.len() {
                let n_own = index(leaves[l].1 - leaves[l].0);
                lists[l].items.extend(n_own..n_own + LATER);
            }
            lists[l].close();
        }
    }
    for (list, &(from, to)) in lists.iter().zip(leaves) {
        let place = minimum_degree(list, to - from + LATER as usize);
        let mut own: Vec<(u32, u32)> =
            place.into_iter().zip(order[from..to].iter().copied()).collect();
        own.sort_unstable();
        for (to, (_, v)) in order[from..to].iter_mut().zip(own) {
            *to = v;
        }
    }
}

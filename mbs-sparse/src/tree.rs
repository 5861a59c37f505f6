//! Elimination tree of the nodes, and the fronts that result from merging nodes with their parents.
//!
//! ```text
//! rows(v)   = ( union of elements whose first node is v,  and of rows(c), c child of v )  without v
//! parent(v) = first of rows(v)
//! a front merged into its parent:   p = p_child + p_parent,   f = p_child + f_parent
//! ```
//!
//! A child is merged if the zeros that it adds cost less than passing its update to the parent.

use crate::graph::Lists;

// Only ratios of these times matter. Other times were tried on chains of 4, 6, 12 and 13 unknowns per element. (0.25, 1.5, 20) changes
// nothing; (0.15, 1, 40) makes the chain of 4 one fifth slower. (0.12, 1, 80) makes every chain slower by a sixth or more.

/// Time of one multiply-subtract in a front [ns].
const MULTIPLY_SUBTRACT: f64 = 0.25;
/// Time to add one number of an update into the parent [ns].
const EXTEND_ADD: f64 = 0.6;
/// Constant time of a front of any size [ns].
const FRONT: f64 = 20.0;
/// Index that stands for no parent.
pub(crate) const NONE: u32 = u32::MAX;

/// The fronts in an order where children precede parents.
#[derive(Debug, Default)]
pub(crate) struct Fronts {
    /// Nodes eliminated by each front.
    pub(crate) pivots: Lists,
    /// Nodes that remain in each front, all eliminated later.
    pub(crate) rows: Lists,
    /// Parent of each front, or [`NONE`].
    pub(crate) parent: Vec<u32>,
    /// Estimated time of each front [ns].
    pub(crate) work: Vec<f64>,
}

/// Builds the fronts for nodes of `weight` unknowns, eliminated in the order of `place`. In a tree with more work than `grain` [ns], the
/// heaviest child of every front comes first. So the path from this child up to the next fork is contiguous.
pub(crate) fn fronts(elements: &Lists, place: &[u32], weight: &[usize], grain: f64) -> Fronts {
    let n = place.len();
    let mut at = vec![0_u32; n];
    for v in 0..n {
        at[place[v] as usize] = crate::graph::index(v);
    }
    let rows = structure(elements, place);
    let parent: Vec<u32> =
        (0..n).map(|v| rows.get(v).iter().copied().min().unwrap_or(NONE)).collect();
    let size = |v: usize| weight[at[v] as usize];
    let (representative, sizes) = merged(&rows, &parent, size);
    let work: Vec<f64> = sizes.iter().map(|&(p, f)| time(p, f)).collect();

    // Parent of each remaining front: the front into which its parent was merged.
    let above: Vec<u32> = (0..n)
        .map(|v| if parent[v] == NONE { NONE } else { representative[parent[v] as usize] })
        .collect();
    let survivors = || (0..n).filter(|&v| representative[v] as usize == v);
    let all: f64 = survivors().map(|v| work[v]).sum();
    let total = (all > grain).then(|| {
        let mut total = vec![0.0; n];
        for v in survivors() {
            total[v] += work[v];
            if above[v] != NONE {
                total[above[v] as usize] += total[v];
            }
        }
        total
    });
    let order = postorder(&representative, &above, total.as_ref());

    let mut number = vec![NONE; n];
    for (s, &v) in order.iter().enumerate() {
        number[v as usize] = crate::graph::index(s);
    }
    let front_of_node: Lists = Lists {
        start: (0..=n).collect(),
        items: representative.iter().map(|&r| number[r as usize]).collect(),
    };
    let mut pivots = front_of_node.transposed(order.len());
    let mut kept = Lists::with_capacity(order.len());
    for &v in &order {
        kept.items.extend(rows.get(v as usize).iter().map(|&w| at[w as usize]));
        kept.close();
    }
    for v in &mut pivots.items {
        *v = at[*v as usize];
    }
    let parent = order
        .iter()
        .map(|&v| match above[v as usize] {
            NONE => NONE,
            above => number[above as usize],
        })
        .collect();
    let work = order.iter().map(|&v| work[v as usize]).collect();
    Fronts { pivots, rows: kept, parent, work }
}

/// Returns rows(v), the later positions in the column of v, for every position v of the elimination.
fn structure(elements: &Lists, place: &[u32]) -> Lists {
    let n = place.len();
    let mut first_here = chains(n);
    for e in 0..elements.len() {
        let first = elements.get(e).iter().map(|&v| place[v as usize]).min();
        if let Some(first) = first {
            first_here.push(first as usize, e, elements.len());
        }
    }
    let mut children = chains(n);
    let mut last_seen = vec![usize::MAX; n];
    let mut rows = Lists::with_capacity(n);
    for v in 0..n {
        last_seen[v] = v;
        let mut see = |w: u32, items: &mut Vec<u32>| {
            if last_seen[w as usize] != v {
                last_seen[w as usize] = v;
                items.push(w);
            }
        };
        for e in first_here.iter(v) {
            for &node in elements.get(e) {
                see(place[node as usize], &mut rows.items);
            }
        }
        for child in children.iter(v) {
            for i in rows.start[child]..rows.start[child + 1] {
                let w = rows.items[i];
                see(w, &mut rows.items);
            }
        }
        rows.close();
        if let Some(&parent) = rows.get(v).iter().min() {
            children.push(parent as usize, v, n);
        }
    }
    rows
}

/// Merges fronts with their parents. Returns for each node the node whose front eliminates it. Also returns the numbers of pivots and of
/// unknowns of that front.
fn merged(
    rows: &Lists,
    parent: &[u32],
    size: impl Fn(usize) -> usize,
) -> (Vec<u32>, Vec<(usize, usize)>) {
    let n = parent.len();
    let mut p: Vec<usize> = (0..n).map(&size).collect();
    let mut f: Vec<usize> = (0..n)
        .map(|v| p[v] + rows.get(v).iter().map(|&w| size(w as usize)).sum::<usize>())
        .collect();
    let mut into: Vec<u32> = (0..n).map(crate::graph::index).collect();
    for child in 0..n {
        // A node is visited after all its children, and before its parent.
        let Some(&above) = parent.get(child).filter(|&&above| above != NONE) else { continue };
        let above_at = above as usize;
        if is_merge_cheaper((p[child], f[child]), (p[above_at], f[above_at])) {
            into[child] = above;
            p[above_at] += p[child];
            f[above_at] += p[child];
        }
    }
    for v in (0..n).rev() {
        into[v] = into[into[v] as usize];
    }
    (into, p.into_iter().zip(f).collect())
}

/// Time of a front of `p` pivots and `f` unknowns [ns].
pub(crate) fn time(p: usize, f: usize) -> f64 {
    let carried = ((f - p) * (f - p + 1) / 2) as f64;
    work(p, f) * MULTIPLY_SUBTRACT + carried * EXTEND_ADD + FRONT
}

/// True if a child front (pivots, size) costs less merged into its parent than separate.
fn is_merge_cheaper(child: (usize, usize), parent: (usize, usize)) -> bool {
    let update = child.1 - child.0;
    let together = work(child.0 + parent.0, child.0 + parent.1);
    let apart = work(child.0, child.1) + work(parent.0, parent.1);
    let carried = (update * (update + 1) / 2) as f64;
    (together - apart) * MULTIPLY_SUBTRACT < carried * EXTEND_ADD + FRONT
}

/// Returns the number of multiply-subtracts for `p` pivots in a front of `f` unknowns, including the two triangular sweeps.
fn work(p: usize, f: usize) -> f64 {
    (0..p).map(|k| ((f - k) * (f - k + 5)) as f64 / 2.0).sum()
}

/// Returns the remaining fronts, with children before parents and each subtree contiguous. If `total` has the work of each subtree, the
/// subtree with the most work is first.
fn postorder(representative: &[u32], above: &[u32], total: Option<&Vec<f64>>) -> Vec<u32> {
    let n = representative.len();
    let mut children = chains(n);
    let mut roots = Vec::new();
    for v in (0..n).rev().filter(|&v| representative[v] as usize == v) {
        match above[v] {
            NONE => roots.push(v),
            above => children.push(above as usize, v, n),
        }
    }
    // The list has parents before children, with the last child first. The reversed list is the postorder.
    let mut order = Vec::with_capacity(n);
    let mut open = roots;
    open.reverse();
    while let Some(v) = open.pop() {
        order.push(crate::graph::index(v));
        let from = open.len();
        open.extend(children.iter(v));
        if let Some(total) = total {
            // The list is reversed afterwards, so the last child becomes the first.
            let heaviest =
                (from..open.len()).max_by(|&a, &b| total[open[a]].total_cmp(&total[open[b]]));
            if let Some(heaviest) = heaviest {
                open[from..=heaviest].rotate_right(1);
            }
        }
    }
    order.reverse();
    order
}

/// Linked lists of members for a number of owners, the newest member first.
struct Chains {
    head: Vec<usize>,
    next: Vec<usize>,
}

/// Creates empty lists for `n` owners.
fn chains(n: usize) -> Chains {
    Chains { head: vec![usize::MAX; n], next: Vec::new() }
}

impl Chains {
    /// Adds `member`, one of `n_members`, at the front of the list of `owner`.
    fn push(&mut self, owner: usize, member: usize, n_members: usize) {
        if self.next.is_empty() {
            self.next = vec![usize::MAX; n_members];
        }
        self.next[member] = std::mem::replace(&mut self.head[owner], member);
    }

    /// Iterates over the members of `owner`.
    fn iter(&self, owner: usize) -> impl Iterator<Item = usize> + '_ {
        let some = |i: usize| (i != usize::MAX).then_some(i);
        std::iter::successors(some(self.head[owner]), move |&i| some(self.next[i]))
    }
}

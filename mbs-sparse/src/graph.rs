//! Graph of the cliques and its elimination order. Unknowns in the same elements form one node.
//!
//! ```text
//! u ~ v  when  { e : u in clique e } = { e : v in clique e }      (such unknowns have equal columns in the pattern)
//! nodes = classes of ~,   edges = pairs of nodes in a common element,   order = approximate minimum degree
//! ```
//!
//! The classes result from splitting one class by every clique in turn. This is exact, and linear in the length of the cliques.

use mbs_math::Cliques;

/// Lists of indices in one array: list `i` is `items[start[i]..start[i + 1]]`.
#[derive(Debug, Clone, Default)]
pub(crate) struct Lists {
    pub(crate) start: Vec<usize>,
    pub(crate) items: Vec<u32>,
}

impl Lists {
    /// Creates an empty collection with memory for `n_lists` lists.
    pub(crate) fn with_capacity(n_lists: usize) -> Self {
        let mut start = Vec::with_capacity(n_lists + 1);
        start.push(0);
        Self { start, items: Vec::new() }
    }

    /// Ends the list of the last pushed items.
    pub(crate) fn close(&mut self) {
        self.start.push(self.items.len());
    }

    /// Number of lists.
    pub(crate) fn len(&self) -> usize {
        self.start.len() - 1
    }

    /// Items of list `i`.
    pub(crate) fn get(&self, i: usize) -> &[u32] {
        &self.items[self.start[i]..self.start[i + 1]]
    }

    /// Returns for each value `< n` the lists that contain it, in ascending order.
    pub(crate) fn transposed(&self, n: usize) -> Self {
        let mut start = vec![0; n + 1];
        for &item in &self.items {
            start[item as usize + 1] += 1;
        }
        for i in 0..n {
            start[i + 1] += start[i];
        }
        let mut next = start.clone();
        let mut items = vec![0; self.items.len()];
        for i in 0..self.len() {
            for &item in self.get(i) {
                items[next[item as usize]] = index(i);
                next[item as usize] += 1;
            }
        }
        Self { start, items }
    }
}

/// Converts `i` to a stored index.
///
/// # Panics
/// When there are more than 2^32 - 1 unknowns or elements.
pub(crate) fn index(i: usize) -> u32 {
    u32::try_from(i).expect("at most 2^32 - 1 unknowns and elements")
}

/// Copies the cliques to lists and checks them.
///
/// # Panics
/// When a clique names an unknown outside `0..n` or names one twice.
pub(crate) fn checked_cliques(cliques: &impl Cliques) -> Lists {
    let n = cliques.n_unknowns();
    let mut last_seen = vec![usize::MAX; n];
    let mut lists = Lists::with_capacity(cliques.n_elements());
    for e in 0..cliques.n_elements() {
        for &u in cliques.clique(e) {
            assert!((u as usize) < n, "element {e} names unknown {u}, but there are {n}");
            assert!(last_seen[u as usize] != e, "element {e} names unknown {u} twice");
            last_seen[u as usize] = e;
        }
        lists.items.extend_from_slice(cliques.clique(e));
        lists.close();
    }
    lists
}

/// Returns the node of each unknown, and the number of nodes. The order of the nodes is that of their first unknowns. Unknowns from
/// `n_primal` on are never in one node with unknowns before `n_primal`.
pub(crate) fn nodes(cliques: &Lists, n: usize, n_primal: usize) -> (Vec<u32>, usize) {
    let mut class = vec![0_u32; n];
    let mut n_classes = 1;
    // `split_by[c]` is the last clique with members of class c, and `split_into[c]` is the class to which it moved them.
    let mut split_into = vec![0_u32];
    let mut split_by = vec![usize::MAX];
    let multipliers: Vec<u32> = (n_primal..n).map(index).collect();
    for e in 0..=cliques.len() {
        let clique = if e < cliques.len() { cliques.get(e) } else { &multipliers };
        for &u in clique {
            let c = class[u as usize] as usize;
            if split_by[c] != e {
                split_by[c] = e;
                split_into[c] = index(n_classes);
                n_classes += 1;
                split_into.push(0);
                split_by.push(usize::MAX);
            }
            class[u as usize] = split_into[c];
        }
    }
    // Unknowns without an element are in class 0. They are not neighbours, so each becomes a node.
    let mut node_of_class = vec![u32::MAX; n_classes];
    let mut n_nodes = 0;
    for c in &mut class {
        let seen = &mut node_of_class[*c as usize];
        if *c == 0 || *seen == u32::MAX {
            *seen = index(n_nodes);
            n_nodes += 1;
        }
        *c = *seen;
    }
    (class, n_nodes)
}

/// Returns the distinct nodes of every element.
pub(crate) fn elements_by_node(cliques: &Lists, node: &[u32], n_nodes: usize) -> Lists {
    let mut last_seen = vec![usize::MAX; n_nodes];
    let mut lists = Lists::with_capacity(cliques.len());
    for e in 0..cliques.len() {
        for &u in cliques.get(e) {
            let v = node[u as usize];
            if last_seen[v as usize] != e {
                last_seen[v as usize] = e;
                lists.items.push(v);
            }
        }
        lists.close();
    }
    lists
}

/// Returns the position of each node in an elimination order that gives few entries of L.
pub(crate) fn minimum_degree(elements: &Lists, n_nodes: usize) -> Vec<u32> {
    ordered_by_amd(&neighbours(elements, n_nodes), n_nodes)
}

/// Returns the nodes that have a common element with each node, in ascending order.
pub(crate) fn neighbours(elements: &Lists, n_nodes: usize) -> Lists {
    let of_node = elements.transposed(n_nodes);
    let mut last_seen = vec![usize::MAX; n_nodes];
    let mut neighbours = Lists::with_capacity(n_nodes);
    for v in 0..n_nodes {
        last_seen[v] = v;
        for &e in of_node.get(v) {
            for &w in elements.get(e as usize) {
                if last_seen[w as usize] != v {
                    last_seen[w as usize] = v;
                    neighbours.items.push(w);
                }
            }
        }
        let from = neighbours.start[v];
        neighbours.items[from..].sort_unstable();
        neighbours.close();
    }
    neighbours
}

/// Returns the position of each node. A node of multipliers is placed right after the last other node with which it shares an element.
/// `order` places the other nodes, given their elements and weights. So the coordinates of a multiplier's row are eliminated before the
/// multiplier, and its pivot then has their terms.
pub(crate) fn multipliers_after(
    elements: &Lists,
    (weight, is_multiplier): (&[usize], &[bool]),
    order: impl Fn(&Lists, &[usize]) -> Vec<u32>,
) -> Vec<u32> {
    if !is_multiplier.contains(&true) {
        return order(elements, weight);
    }
    let n_nodes = is_multiplier.len();
    let mut number = vec![0; n_nodes];
    let mut primal_weight = Vec::new();
    for v in (0..n_nodes).filter(|&v| !is_multiplier[v]) {
        number[v] = index(primal_weight.len());
        primal_weight.push(weight[v]);
    }
    let mut primal = Lists::with_capacity(elements.len());
    for e in 0..elements.len() {
        let nodes = elements.get(e).iter().filter(|&&v| !is_multiplier[v as usize]);
        primal.items.extend(nodes.map(|&v| number[v as usize]));
        primal.close();
    }
    let place = order(&primal, &primal_weight);
    let mut last = vec![0; n_nodes];
    for e in 0..elements.len() {
        let latest = primal.get(e).iter().map(|&v| place[v as usize] + 1).max().unwrap_or(0);
        for &v in elements.get(e).iter().filter(|&&v| is_multiplier[v as usize]) {
            last[v as usize] = latest.max(last[v as usize]);
        }
    }
    for v in (0..n_nodes).filter(|&v| !is_multiplier[v]) {
        last[v] = place[number[v] as usize] + 1;
    }
    let mut order: Vec<usize> = (0..n_nodes).collect();
    order.sort_by_key(|&v| (last[v], is_multiplier[v]));
    let mut place = vec![0; n_nodes];
    for (k, &v) in order.iter().enumerate() {
        place[v] = index(k);
    }
    place
}

/// Returns the position of each node by approximate minimum degree.
///
/// Never: the lists name nodes `< n_nodes`, each list is ascending, and the pattern includes the diagonal. `amd` requires the last in debug
/// builds.
fn ordered_by_amd(neighbours: &Lists, n_nodes: usize) -> Vec<u32> {
    let mut start = vec![0];
    let mut rows = Vec::with_capacity(neighbours.items.len() + n_nodes);
    for v in 0..n_nodes {
        let others = neighbours.get(v);
        let (before, after) = others.split_at(others.partition_point(|&w| (w as usize) < v));
        rows.extend(before.iter().map(|&w| w as usize));
        rows.push(v);
        rows.extend(after.iter().map(|&w| w as usize));
        start.push(rows.len());
    }
    let ordered = amd::order(n_nodes, &start, &rows, &amd::Control::default());
    let (_, place, _) = ordered.expect("a pattern of ascending lists");
    place.into_iter().map(index).collect()
}

#[cfg(test)]
mod tests;

//! Result of the analysis, without any numbers of the matrix: fronts, their storage and all index maps.
//!
//! A front of p pivots and f unknowns is a lower triangle, packed by columns. Its first p columns become columns of L. The remaining columns
//! become the update for the parent, in the same memory. The fronts are consecutive parts of one array.
//!
//! ```text
//! column j of a front starts at   j f - j (j - 1) / 2   and holds rows j, ..., f - 1
//! ```

use crate::dissection;
use crate::front::{Front, FrontInit, column};
use crate::graph::{self, Lists, index};
use crate::options::{Counters, Options, Ordering};
use crate::part::{self, Part, Place, place_of, triangle};
use crate::tasks::{Tasks, tasks};
use crate::tree::{self, Fronts};
use mbs_math::Cliques;
use std::collections::HashMap;

/// Fronts, tasks and index maps of a factorisation.
#[derive(Debug, Clone, Default)]
pub(crate) struct Plan {
    pub(crate) fronts: Vec<Front>,
    pub(crate) elements: Vec<Part>,
    pub(crate) children: Vec<Part>,
    /// Targets of the entries of scattered parts, as offsets in their front.
    pub(crate) targets: Vec<u32>,
    /// Positions, in the elimination order, of the remaining rows of all fronts.
    pub(crate) rows: Vec<u32>,
    /// Tasks that threads may do at the same time.
    pub(crate) tasks: Tasks,
    /// Unknown at each position of the elimination order.
    pub(crate) order: Vec<u32>,
    /// True if `order` is 0, 1, 2, ...
    pub(crate) is_natural: bool,
    pub(crate) cliques: Lists,
    pub(crate) largest_clique: usize,
    /// Size of the largest block, or of all small blocks that are added together in one front, if they are larger.
    pub(crate) n_block: usize,
    pub(crate) counters: Counters,
}

/// Plans the elimination for these cliques.
pub(crate) fn plan(cliques: &impl Cliques, options: Options) -> Plan {
    let (n, n_primal) = (cliques.n_unknowns(), cliques.n_primal());
    let cliques = graph::checked_cliques(cliques);
    let (node, fronts) = if n <= options.dense_up_to {
        (vec![0; n], one_front(n))
    } else {
        let (node, n_nodes) = graph::nodes(&cliques, n, n_primal);
        let mut weight = vec![0; n_nodes];
        let mut is_multiplier = vec![false; n_nodes];
        for (u, &v) in node.iter().enumerate() {
            weight[v as usize] += 1;
            is_multiplier[v as usize] = u >= n_primal;
        }
        let elements = graph::elements_by_node(&cliques, &node, n_nodes);
        let fronts = ordered(&elements, (&weight, &is_multiplier), options);
        (node, fronts)
    };
    Planner::new(cliques, &node, &fronts, options.grain as f64).finish(&fronts)
}

/// Largest accepted work of a dissection, relative to that of minimum degree [-]. It limits the loss for one thread. Chosen, not tuned.
const MORE_WORK: f64 = 1.1;
/// Parallelism of a tree from which no dissection is tried: the ratio of its work to its longest path [-]. This many threads then have
/// work. Chosen, not tuned.
const ROOM: f64 = 32.0;
/// Largest number of levels of dissection that are tried [-]. Six levels make 64 parts. Chosen, not tuned.
const MOST_LEVELS: u32 = 6;

/// Returns the fronts in the order that the options require. The choice depends on the structure alone.
fn ordered(
    elements: &Lists,
    (weight, is_multiplier): (&[usize], &[bool]),
    options: Options,
) -> Fronts {
    let grain = options.grain as f64;
    // Depth zero is minimum degree without dissection.
    let dissected = |depth| {
        let order = |elements: &Lists, weight: &[usize]| match depth {
            0 => graph::minimum_degree(elements, weight.len()),
            _ => dissection::dissected(elements, weight, depth),
        };
        let place = graph::multipliers_after(elements, (weight, is_multiplier), order);
        tree::fronts(elements, &place, weight, grain)
    };
    if let Ordering::Dissection(depth) = options.ordering {
        return dissected(depth);
    }
    let mut best = dissected(0);
    let work = |fronts: &Fronts| fronts.work.iter().sum::<f64>();
    let serial = work(&best);
    if options.ordering == Ordering::MinimumDegree || serial < 2.0 * grain {
        return best;
    }
    for depth in 1..=MOST_LEVELS {
        if parallelism(&best) >= ROOM.min(serial / grain) {
            break;
        }
        let cut = dissected(depth);
        let is_cheap = work(&cut) <= MORE_WORK * serial;
        if is_cheap && parallelism(&cut) > parallelism(&best) * MORE_WORK {
            best = cut;
        }
    }
    best
}

/// Returns one front for all unknowns. Returns no front if there are no unknowns.
fn one_front(n: usize) -> Fronts {
    let mut fronts = Fronts {
        pivots: Lists::with_capacity(1),
        rows: Lists::with_capacity(1),
        parent: Vec::new(),
        work: Vec::new(),
    };
    if n > 0 {
        fronts.work.push(0.0);
        fronts.pivots.items.push(0);
        fronts.pivots.close();
        fronts.rows.close();
        fronts.parent.push(tree::NONE);
    }
    fronts
}

/// State of the planner, which converts fronts of nodes into fronts of unknowns with all maps.
struct Planner {
    plan: Plan,
    /// Position of each unknown in the elimination order.
    place: Vec<u32>,
    /// Row of each position in the current front.
    row: Vec<u32>,
    /// The elements of each front.
    elements_of: Lists,
    /// Start of each target list that is known already. Lists are reused, because most fronts of a mechanism have the pattern of another
    /// front.
    known: HashMap<Vec<u32>, usize>,
}

impl Planner {
    /// Numbers the unknowns and computes the sizes of the fronts.
    fn new(cliques: Lists, node: &[u32], fronts: &Fronts, grain: f64) -> Self {
        let n = node.len();
        let n_fronts = fronts.parent.len();
        let by_node = Lists { start: (0..=n).collect(), items: node.to_vec() };
        let unknowns = by_node.transposed(node.iter().max().map_or(0, |&m| m as usize + 1));
        let mut plan = Plan { cliques, ..Plan::default() };
        let mut place = vec![0; n];
        let mut front_of_place = Vec::with_capacity(n);
        for s in 0..n_fronts {
            let first = plan.order.len();
            for &v in fronts.pivots.get(s) {
                plan.order.extend_from_slice(unknowns.get(v as usize));
            }
            // With ascending unknowns, the maps of ascending cliques are ascending too.
            plan.order[first..].sort_unstable();
            for k in first..plan.order.len() {
                place[plan.order[k] as usize] = index(k);
                front_of_place.push(index(s));
            }
            plan.fronts.push(Front {
                p: plan.order.len() - first,
                f: 0,
                offset: 0,
                first,
                rows: 0..0,
                init: FrontInit::Zeros,
                at: 0,
                elements: 0..0,
                children: 0..0,
            });
        }
        plan.is_natural = plan.order.iter().enumerate().all(|(k, &u)| k == u as usize);
        for (s, front) in plan.fronts.iter_mut().enumerate() {
            let start = plan.rows.len();
            for &v in fronts.rows.get(s) {
                plan.rows.extend(unknowns.get(v as usize).iter().map(|&u| place[u as usize]));
            }
            plan.rows[start..].sort_unstable();
            front.rows = start..plan.rows.len();
            front.f = front.p + front.rows.len();
        }
        plan.largest_clique =
            (0..plan.cliques.len()).map(|e| plan.cliques.get(e).len()).max().unwrap_or(0);
        let elements_of = elements_by_front(&plan.cliques, &place, &front_of_place, n_fronts);
        plan.n_block = plan.largest_blocks(&elements_of);
        let tree = (&plan.fronts[..], &fronts.parent[..]);
        plan.tasks = tasks(tree, &plan.rows, &fronts.work, (grain, plan.n_block));
        plan.place_fronts(&place);
        Self { plan, row: vec![0; n], place, elements_of, known: HashMap::new() }
    }

    /// Makes the maps of elements and children, front by front.
    fn finish(mut self, fronts: &Fronts) -> Plan {
        let children_of = children(&fronts.parent);
        for s in 0..self.plan.fronts.len() {
            let front = self.plan.fronts[s].clone();
            for k in 0..front.p {
                self.row[front.first + k] = index(k);
            }
            for (k, &q) in self.plan.rows[front.rows.clone()].iter().enumerate() {
                self.row[q as usize] = index(front.p + k);
            }
            self.add_elements(s, front.f);
            self.add_children(s, front.f, children_of.get(s));
            self.plan.counters.count_front(front.p, front.f);
        }
        let mut plan = self.plan;
        plan.counters.n = plan.order.len();
        plan.counters.n_elements = plan.cliques.len();
        plan.counters.n_tasks = plan.tasks.list.len();
        plan.counters.parallelism = parallelism(fronts);
        plan
    }

    /// Appends the elements of front `s`. An element with all unknowns of the front comes first; its block is written rather than added.
    fn add_elements(&mut self, s: usize, f: usize) {
        let (from, targets) = (self.plan.elements.len(), self.plan.targets.len());
        for &e in self.elements_of.get(s) {
            let clique = self.plan.cliques.get(e as usize);
            let map: Vec<u32> =
                clique.iter().map(|&u| self.row[self.place[u as usize] as usize]).collect();
            let place = place_of(&map, f, &mut self.plan.targets);
            self.plan.elements.push(Part { source: e as usize, size: index(map.len()), place });
        }
        share(&mut self.known, targets, &mut self.plan.targets, &mut self.plan.elements[from..]);
        let elements = &mut self.plan.elements[from..];
        let straight = elements.iter().position(|part| part.place == Place::Tail(0));
        let whole = straight.or_else(|| elements.iter().position(|part| part.size as usize == f));
        if let Some(whole) = whole {
            elements[..=whole].rotate_right(1);
        }
        let front = &mut self.plan.fronts[s];
        let is_small = |part: &Part| part.size as usize <= part::SMALL;
        front.init = match (straight, whole) {
            (Some(_), _) => FrontInit::Written,
            (None, Some(_)) => FrontInit::Permuted,
            (None, None) if elements.len() > 1 && elements.iter().all(is_small) => {
                FrontInit::Gathered
            }
            (None, None) => FrontInit::Zeros,
        };
        front.elements = from..self.plan.elements.len();
    }

    /// Appends the updates that front `s` receives.
    fn add_children(&mut self, s: usize, f: usize, children: &[u32]) {
        let (from, targets) = (self.plan.children.len(), self.plan.targets.len());
        for &c in children {
            let child = &self.plan.fronts[c as usize];
            let map: Vec<u32> =
                self.plan.rows[child.rows.clone()].iter().map(|&q| self.row[q as usize]).collect();
            let source = child.offset + column(child.f, child.p);
            let place = place_of(&map, f, &mut self.plan.targets);
            self.plan.children.push(Part { source, size: index(map.len()), place });
        }
        share(&mut self.known, targets, &mut self.plan.targets, &mut self.plan.children[from..]);
        self.plan.fronts[s].children = from..self.plan.children.len();
    }
}

impl Plan {
    /// Returns the size of the largest block, or of all small blocks of one front if they are larger.
    fn largest_blocks(&self, elements_of: &Lists) -> usize {
        let sizes =
            |s: usize| elements_of.get(s).iter().map(|&e| self.cliques.get(e as usize).len());
        let small = |s: usize| sizes(s).filter(|&k| k <= part::SMALL).map(triangle).sum();
        let gathered = (0..elements_of.len()).map(small).max().unwrap_or(0);
        gathered.max(triangle(self.largest_clique))
    }

    /// Assigns storage to fronts and unknowns, task by task.
    fn place_fronts(&mut self, place: &[u32]) {
        let mut stored_at_place = vec![0; place.len()];
        for task in &self.tasks.list {
            let mut offset = task.numbers[1];
            for front in &mut self.fronts[task.fronts.clone()] {
                front.at = front.first - task.places.start;
                front.offset = offset;
                offset += column(front.f, front.f);
            }
            for (k, q) in task.places.clone().enumerate() {
                stored_at_place[q] = index(task.vector[1] + k);
            }
        }
        self.tasks.stored_at = place.iter().map(|&q| stored_at_place[q as usize]).collect();
    }
}

/// Replaces the targets from index `from` on by equal targets of an earlier front, if such targets exist.
fn share(
    known: &mut HashMap<Vec<u32>, usize>,
    from: usize,
    targets: &mut Vec<u32>,
    parts: &mut [Part],
) {
    if targets.len() == from {
        return;
    }
    let Some(&first) = known.get(&targets[from..]) else {
        known.insert(targets[from..].to_vec(), from);
        return;
    };
    targets.truncate(from);
    for part in parts {
        if let Place::Scattered(start) = &mut part.place {
            *start -= index(from - first);
        }
    }
}

/// Returns the ratio of the work of all fronts to that of the longest path to a root.
fn parallelism(fronts: &Fronts) -> f64 {
    let mut longest = fronts.work.clone();
    let mut most = 0.0_f64;
    let mut below = vec![0.0_f64; longest.len()];
    for s in 0..longest.len() {
        longest[s] += below[s];
        most = most.max(longest[s]);
        if let Some(above) = below.get_mut(fronts.parent[s] as usize) {
            *above = above.max(longest[s]);
        }
    }
    let all: f64 = fronts.work.iter().sum();
    if most > 0.0 { all / most } else { 1.0 }
}

/// Returns the elements of each front: an element belongs to the front that eliminates its first unknown.
fn elements_by_front(cliques: &Lists, place: &[u32], front_of: &[u32], n_fronts: usize) -> Lists {
    let mut firsts = Lists::with_capacity(cliques.len());
    for e in 0..cliques.len() {
        let first = cliques.get(e).iter().map(|&u| place[u as usize]).min();
        firsts.items.extend(first.map(|q| front_of[q as usize]));
        firsts.close();
    }
    firsts.transposed(n_fronts)
}

/// Returns the children of each front in ascending order.
fn children(parent: &[u32]) -> Lists {
    let mut lists = Lists::with_capacity(parent.len());
    for &parent in parent {
        lists.items.extend((parent != tree::NONE).then_some(parent));
        lists.close();
    }
    lists.transposed(parent.len())
}

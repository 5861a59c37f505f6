//! Fronts of an indefinite factorisation, task by task, including the pivots that were delayed to each task.
//!
//! ```text
//! front = elements + updates of its children + unknowns that its children could not eliminate, which come first
//! ```
//!
//! Only a task itself writes its numbers. Their storage grows with the delayed pivots. A task reads the numbers of the tasks below it after
//! these have ended. An unknown is identified by its index in the storage of a vector. A delayed unknown keeps its index, which belongs to
//! a task below. Every task to which the unknown can be delayed may access that part of the storage.

use crate::front::{Front, column};
use crate::part;
use crate::plan::Plan;
use crate::subtree::{Direction, Sweep};
use crate::tasks::{Owned, Task};
use mbs_math::dense::front::{self, Places, Tally, Thresholds};
use mbs_math::{Real, Team};

/// A plan with additional data for delayed pivots.
#[derive(Debug, Clone)]
pub(crate) struct Layout {
    pub(crate) plan: Plan,
    /// The unknown at each index of the storage of a vector.
    pub(crate) unknown_at: Vec<u32>,
    /// Start of the block of each element, and the end of the last one.
    pub(crate) block_starts: Vec<usize>,
    task_of_front: Vec<u32>,
    /// The fronts from which each front receives updates, in the order of `plan.children`.
    children: Vec<u32>,
    /// For each child, the rows of its parent that correspond to the child's remaining unknowns, and the start of the child's list.
    maps: Vec<u32>,
    map_starts: Vec<usize>,
}

impl Layout {
    pub(crate) fn new(mut plan: Plan) -> Self {
        plan.tasks.widen(&plan.order);
        let mut unknown_at = vec![u32::MAX; plan.tasks.sizes[1]];
        for (u, &at) in (0_u32..).zip(&plan.tasks.stored_at) {
            unknown_at[at as usize] = u;
        }
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
        let mut task_of_front = Vec::with_capacity(plan.fronts.len());
        for (at, task) in (0_u32..).zip(&plan.tasks.list) {
            task_of_front.extend(task.fronts.clone().map(|_| at));
        }
        Self { plan, unknown_at, block_starts, task_of_front, children, maps, map_starts }
    }

    /// Allocates memory for the factored fronts of every task: the planned memory, and the same amount again for delayed pivots.
    pub(crate) fn shares<T: Real>(&self) -> Vec<Share<T>> {
        let block = self.plan.n_block;
        let share = |task: &Task| {
            let fronts = &self.plan.fronts[task.fronts.clone()];
            // A delayed unknown adds an entry to every column of the front to which it is added.
            let numbers = fronts.iter().map(|s| column(s.f, s.f) + 2 * s.f + 1).sum();
            let rows = fronts.iter().map(|s| s.f).sum::<usize>() + task.places.len();
            Share {
                stretches: vec![Stretch::default(); fronts.len()],
                numbers: vec![T::ZERO; numbers],
                order: vec![0; rows],
                size: vec![T::ZERO; rows],
                pairs: vec![false; rows],
                block: vec![T::ZERO; block],
                tally: Tally::default(),
                delays: Delays::default(),
            }
        };
        self.plan.tasks.list.iter().map(share).collect()
    }
}

/// Returns the rows of `front` that correspond to the remaining unknowns of its child.
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

/// Storage offsets of a front, its size, and its number of pivots.
#[derive(Debug, Clone, Copy, Default)]
struct Stretch {
    offset: usize,
    first: usize,
    f: usize,
    n_pivots: usize,
}

/// Deviations of the last factorisation from the plan, which delayed pivots cause.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Delays {
    /// Number of unknowns that a front could not eliminate and passed on to its parent, summed over all fronts.
    pub delayed: usize,
    /// Number of delayed unknowns that one task passed on to another.
    pub between_tasks: usize,
    /// Number of unknowns of the largest front.
    pub largest_front: usize,
    /// Numbers stored for all fronts together.
    pub stored: usize,
}

impl Delays {
    /// Returns the sum of the delays of two tasks.
    pub(crate) fn with(self, other: Self) -> Self {
        Self {
            delayed: self.delayed + other.delayed,
            between_tasks: self.between_tasks + other.between_tasks,
            largest_front: self.largest_front.max(other.largest_front),
            stored: self.stored + other.stored,
        }
    }
}

/// Factored fronts of one task.
#[derive(Debug, Clone)]
pub(crate) struct Share<T> {
    /// Storage of each front of the task.
    stretches: Vec<Stretch>,
    numbers: Vec<T>,
    /// Unknowns of the task's fronts in the order of their rows, as indices in the storage of a vector.
    order: Vec<u32>,
    /// Sum of absolute terms of each diagonal entry, in the order of `order`. For rows that a later front eliminates, only the terms of
    /// this front and its children are summed.
    size: Vec<T>,
    /// Whether a pivot is the first of a 2x2 pivot, in the order of `order`.
    pairs: Vec<bool>,
    /// Scratch for one scaled block.
    block: Vec<T>,
    pub(crate) tally: Tally,
    pub(crate) delays: Delays,
}

/// Factored fronts of neighbouring tasks and of all tasks below them.
pub(crate) struct Shares<'a, T>(pub(crate) &'a mut [Share<T>]);

impl<T: Send> Owned for Shares<'_, T> {
    fn cut(self, begin: &Task, cut: &Task) -> (Self, Self) {
        let (left, right) = self.0.split_at_mut(cut.first_task - begin.first_task);
        (Self(left), Self(right))
    }
}

/// Data that a factorisation reads.
#[derive(Debug)]
pub(crate) struct Job<'a, T, W> {
    pub(crate) layout: &'a Layout,
    pub(crate) team: &'a W,
    pub(crate) thresholds: &'a Thresholds<T>,
    /// Blocks of all elements.
    pub(crate) blocks: &'a [T],
    /// Scale S, and the largest entry of each row of S T S for the matrix T; one number for each unknown.
    pub(crate) scale: &'a [T],
    pub(crate) rows: &'a [T],
}

impl<T: Real, W: Team> Job<'_, T, W> {
    /// Factors task `at` after the tasks below; `shares` are those of all these tasks.
    pub(crate) fn factor_task(&self, at: usize, shares: &mut [Share<T>]) {
        let Some((own, below)) = shares.split_last_mut() else { return };
        let tasks = &self.layout.plan.tasks;
        let work = |at, Shares(shares): Shares<'_, T>| {
            self.factor_task(at, shares);
            Ok::<(), std::convert::Infallible>(())
        };
        let Ok(()) = tasks.each(self.team, tasks.below(at), Shares(below), &work);
        own.tally = Tally::default();
        own.delays = Delays::default();
        let mut used = (0, 0);
        for s in tasks.list[at].fronts.clone() {
            used = own.eliminate(self, (at, s), below, used);
        }
        own.delays.stored = used.0;
    }

    /// Returns the scaled block S_e T_e S_e of one element.
    #[inline(always)]
    fn scale_block<'a>(&self, e: usize, block: &'a mut [T]) -> &'a [T] {
        let layout = self.layout;
        let from = &self.blocks[layout.block_starts[e]..layout.block_starts[e + 1]];
        let clique = layout.plan.cliques.get(e);
        let block = &mut block[..from.len()];
        let (mut from, mut rest) = (from, &mut *block);
        for (j, &v) in clique.iter().enumerate() {
            let s = self.scale[v as usize];
            let (x, from_next) = from.split_at(clique.len() - j);
            let (to, next) = rest.split_at_mut(x.len());
            for ((to, &x), &u) in to.iter_mut().zip(x).zip(&clique[j..]) {
                *to = x * s * self.scale[u as usize];
            }
            (from, rest) = (from_next, next);
        }
        block
    }
}

/// Results of a finished task, for the fronts of the task above.
#[derive(Debug)]
struct Done<'a, T> {
    stretches: &'a [Stretch],
    numbers: &'a [T],
    order: &'a [u32],
    size: &'a [T],
}

impl<T: Real> Share<T> {
    /// Assembles and eliminates front `s`. `used` are the used lengths of the arrays of numbers and of unknowns. Returns both lengths with
    /// this front added.
    fn eliminate<W: Team>(
        &mut self,
        job: &Job<'_, T, W>,
        (at, s): (usize, usize),
        below: &[Self],
        used: (usize, usize),
    ) -> (usize, usize) {
        let (layout, plan) = (job.layout, &job.layout.plan);
        let Front { p, f: planned, .. } = plan.fronts[s];
        let mut delayed = 0;
        for c in plan.fronts[s].children.clone() {
            let (task, local) = layout.place_of_child(c);
            let stretches = if task == at {
                &self.stretches
            } else {
                &below[task - plan.tasks.list[at].first_task].stretches
            };
            let Stretch { f, n_pivots, .. } = stretches[local];
            delayed += f - n_pivots - plan.children[c].size as usize;
        }
        let f = planned + delayed;
        let end = (used.0 + column(f, f), used.1 + f);
        self.reserve(end);
        self.assemble(job, (at, s), below, (used, f, delayed));

        let a = &mut self.numbers[used.0..end.0];
        let mut places = Places {
            order: &mut self.order[used.1..end.1],
            pairs: &mut self.pairs[used.1..end.1],
            size: &mut self.size[used.1..end.1],
        };
        let (candidates, tally) = (delayed + p, &mut self.tally);
        let n_pivots = front::eliminate(a, candidates, &mut places, job.thresholds, tally);
        if candidates == f {
            tally.note_left(a, places.order, n_pivots, places.size);
        } else {
            self.delays.delayed += candidates - n_pivots;
        }
        self.delays.largest_front = self.delays.largest_front.max(f);
        let local = s - plan.tasks.list[at].fronts.start;
        self.stretches[local] = Stretch { offset: used.0, first: used.1, f, n_pivots };
        end
    }

    /// Assembles elements and children into the front of `f` unknowns at `used`, and sets its rows. `delayed` of the unknowns are not
    /// planned.
    fn assemble<W: Team>(
        &mut self,
        job: &Job<'_, T, W>,
        (at, s): (usize, usize),
        below: &[Self],
        (used, f, delayed): ((usize, usize), usize, usize),
    ) {
        let (plan, task) = (&job.layout.plan, &job.layout.plan.tasks.list[at]);
        let Front { p, f: planned, first, .. } = plan.fronts[s];
        let (done_numbers, a) = self.numbers.split_at_mut(used.0);
        let (done_order, order) = self.order.split_at_mut(used.1);
        let (done_size, size) = self.size.split_at_mut(used.1);
        let (a, order, size) = (&mut a[..column(f, f)], &mut order[..f], &mut size[..f]);
        a.fill(T::ZERO);
        size.fill(T::ZERO);
        let tail = column(f, delayed);
        for part in &plan.elements[plan.fronts[s].elements.clone()] {
            let block = job.scale_block(part.source, &mut self.block);
            part::add(&mut a[tail..], planned, part, &plan.targets, block);
        }
        let mut place = 0;
        for c in plan.fronts[s].children.clone() {
            let (child_task, local) = job.layout.place_of_child(c);
            let done = if child_task == at {
                Done {
                    stretches: &self.stretches,
                    numbers: done_numbers,
                    order: done_order,
                    size: done_size,
                }
            } else {
                let Self { stretches, numbers, order, size, .. } =
                    &below[child_task - task.first_task];
                Done { stretches, numbers, order, size }
            };
            let next = done.add(job.layout, (c, local), (delayed, place), (a, order, size));
            if child_task != at {
                self.delays.between_tasks += next - place;
            }
            place = next;
        }
        let names = &mut order[delayed..];
        let own = task.vector[1];
        for (k, name) in names[..p].iter_mut().enumerate() {
            *name = crate::graph::index(own + first - task.places.start + k);
            size[delayed + k] += job.rows[plan.order[first + k] as usize];
        }
        let rows = &plan.tasks.rows[plan.fronts[s].rows.clone()];
        for (name, &row) in names[p..].iter_mut().zip(rows) {
            *name = crate::graph::index(own + row as usize);
        }
    }

    /// Reserves memory for these lengths of the arrays of numbers and of unknowns. Allocates only if a length is larger than ever before.
    fn reserve(&mut self, (numbers, names): (usize, usize)) {
        if self.numbers.len() < numbers {
            self.numbers.resize(numbers, T::ZERO);
        }
        if self.order.len() < names {
            self.order.resize(names, 0);
            self.size.resize(names, T::ZERO);
            self.pairs.resize(names, false);
        }
    }
}

impl Layout {
    /// Returns the task of child `c` of the plan, and the index of the child among the fronts of that task.
    fn place_of_child(&self, c: usize) -> (usize, usize) {
        let s = self.children[c] as usize;
        let task = self.task_of_front[s] as usize;
        (task, s - self.plan.tasks.list[task].fronts.start)
    }
}

impl<T: Real> Done<'_, T> {
    /// Adds the update of child `c` of the plan into the front (a, order, size) above. The child is the front `local` of its task. Its
    /// delayed unknowns become rows of the front above from row `place` on; that front has `delayed` such rows. Returns the row after them.
    fn add(
        &self,
        layout: &Layout,
        (c, local): (usize, usize),
        (delayed, place): (usize, usize),
        (a, order, size): (&mut [T], &mut [u32], &mut [T]),
    ) -> usize {
        let (part, f) = (&layout.plan.children[c], order.len());
        let r = part.size as usize;
        let child = self.stretches[local];
        let n = child.f - child.n_pivots - r;
        let from = &self.numbers[child.offset..child.offset + column(child.f, child.f)];
        let update = &from[column(child.f, child.f - r)..];
        let tail = column(f, delayed);
        part::add(&mut a[tail..], f - delayed, part, &layout.plan.targets, update);
        let map = &layout.maps[layout.map_starts[c]..layout.map_starts[c + 1]];
        for i in 0..n {
            let column_of_child = &from[column(child.f, child.n_pivots + i)..];
            let to = &mut a[column(f, place + i)..column(f, place + i + 1)];
            to[..n - i].copy_from_slice(&column_of_child[..n - i]);
            for (&row, &x) in map.iter().zip(&column_of_child[n - i..]) {
                to[delayed + row as usize - (place + i)] = x;
            }
        }
        let left = child.first + child.n_pivots;
        order[place..place + n].copy_from_slice(&self.order[left..left + n]);
        size[place..place + n].copy_from_slice(&self.size[left..left + n]);
        for (&row, &x) in map.iter().zip(&self.size[left + n..left + n + r]) {
            size[delayed + row as usize] += x;
        }
        place + n
    }
}

/// Factored fronts that the sweeps of a solution read.
#[derive(Debug)]
pub(crate) struct Factor<'a, T> {
    pub(crate) layout: &'a Layout,
    pub(crate) shares: &'a [Share<T>],
    /// True if the backward sweep divides by D.
    pub(crate) is_divided: bool,
}

impl<T: Real> Sweep<T> for Factor<'_, T> {
    #[inline(always)]
    fn visit(&self, s: usize, task: &Task, storage: &mut [T], direction: Direction) {
        let share = &self.shares[self.layout.task_of_front[s] as usize];
        let Stretch { offset, first, f, n_pivots } = share.stretches[s - task.fronts.start];
        let a = &share.numbers[offset..offset + column(f, f)];
        let (order, pairs) = (&share.order[first..first + f], &share.pairs[first..][..n_pivots]);
        let begin = task.vector[0];
        let own = task.vector[1] - begin;
        let (x, scratch) = storage.split_at_mut(own + task.places.len() + task.outer.len());
        let z = &mut scratch[..f];
        for (z, &at) in z.iter_mut().zip(order) {
            *z = x[at as usize - begin];
        }
        let changed = match direction {
            Direction::Forward => {
                front::forward(a, pairs, z);
                f
            }
            Direction::Backward => {
                front::backward(a, pairs, z, self.is_divided);
                n_pivots
            }
        };
        for (&z, &at) in z[..changed].iter().zip(order) {
            x[at as usize - begin] = z;
        }
    }
}

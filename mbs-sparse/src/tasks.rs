//! The tree of fronts divided into tasks: subtrees that threads may work on at the same time.
//!
//! ```text
//! a task = neighbouring small subtrees, or the fronts from a fork of the tree up to the next fork, with the tasks below it
//! storage of a task alone:   numbers  [ its fronts | one block ]       vector  [ its pivots | rows further up | pivots of one front ]
//! storage of a task and all below:  [ of its children, in order | of the task alone ]
//! ```
//!
//! The division into tasks follows from the structure of the tree and [`Options::grain`](crate::Options::grain) alone, never from the number
//! of threads. Results of children are added in their order. A plan with one task is worked through front by front.

use crate::front::{Front, column};
use crate::graph::{Lists, index};
use crate::tree::NONE;
use mbs_math::Team;
use std::ops::Range;

/// Largest number of levels of tasks [-]. Each level needs space on the stack of a thread. Chosen, not tuned.
const DEEPEST: usize = 100;

/// A part of the tree of fronts that one thread works through.
#[derive(Debug, Clone, Default)]
pub(crate) struct Task {
    /// Fronts of the task itself, after those of its children.
    pub(crate) fronts: Range<usize>,
    /// Positions of the task's pivots in the elimination order.
    pub(crate) places: Range<usize>,
    /// First position of the task and all tasks below it, and the first of those tasks.
    pub(crate) first_place: usize,
    pub(crate) first_task: usize,
    /// Range in the list of outer rows. These are the rows of later tasks in which the task's fronts and children have entries, as
    /// ascending positions.
    pub(crate) outer: Range<usize>,
    /// Storage of numbers as three offsets: the start for the task with all tasks below it, the start for the task alone, and the end.
    pub(crate) numbers: [usize; 3],
    /// Storage of a vector as three offsets: the start for the task with all tasks below it, the start for the task alone, and the end.
    pub(crate) vector: [usize; 3],
    /// Estimated begin and end of the factorisation of the task with all tasks below it, if one thread did all tasks one after another
    /// [ns].
    pub(crate) work: [f64; 2],
}

/// All tasks of a tree; children come before parents.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tasks {
    pub(crate) list: Vec<Task>,
    /// The tasks directly below each task, in order.
    pub(crate) children: Lists,
    /// Tasks that have no task above.
    pub(crate) roots: Vec<u32>,
    /// Outer rows of all tasks, as positions in the elimination order.
    pub(crate) outer: Vec<u32>,
    /// For each outer row, its index in the vector of the task above.
    pub(crate) targets: Vec<u32>,
    /// For each entry of `Plan::rows`, the index of the row in the vector of its task.
    pub(crate) rows: Vec<u32>,
    /// For each unknown its index in the storage of a vector.
    pub(crate) stored_at: Vec<u32>,
    /// Sizes of the storage: of all numbers, and of a vector.
    pub(crate) sizes: [usize; 2],
}

/// Data that belong to neighbouring tasks and all tasks below them.
pub(crate) trait Owned: Send + Sized {
    /// Divides the data at the task `cut`, into those of the tasks before it and the rest; `begin` is the first task of all.
    fn cut(self, begin: &Task, cut: &Task) -> (Self, Self);
}

/// Part of the storage of a vector that belongs to some tasks.
pub(crate) struct Storage<'a, T>(pub(crate) &'a mut [T]);

impl<T: Send> Owned for Storage<'_, T> {
    fn cut(self, begin: &Task, cut: &Task) -> (Self, Self) {
        let (left, right) = self.0.split_at_mut(cut.vector[0] - begin.vector[0]);
        (Self(left), Self(right))
    }
}

impl Tasks {
    /// Number of tasks that have no task below them. Threads can do this many tasks at the same time.
    pub(crate) fn n_leaves(&self) -> usize {
        (0..self.list.len()).filter(|&task| self.below(task).is_empty()).count()
    }

    /// Returns the tasks directly below `task`.
    pub(crate) fn below(&self, task: usize) -> &[u32] {
        self.children.get(task)
    }

    /// Divides a list of two or more neighbouring tasks so that each part has about half of the work.
    pub(crate) fn halves<'a>(&self, list: &'a [u32]) -> (&'a [u32], &'a [u32]) {
        let work = |t: &u32| self.list[*t as usize].work;
        let ends = work(&list[0])[0] + work(&list[list.len() - 1])[1];
        let cut = list.partition_point(|t| work(t)[0] + work(t)[1] <= ends);
        list.split_at(cut.clamp(1, list.len() - 1))
    }

    /// Calls `work` for neighbouring tasks, each with its part of `all`, by recursive division of the list.
    ///
    /// # Errors
    /// The first error in the order of the list.
    pub(crate) fn each<W: Team, P: Owned, E: Send>(
        &self,
        team: &W,
        list: &[u32],
        all: P,
        work: &(impl Fn(usize, P) -> Result<(), E> + Sync),
    ) -> Result<(), E> {
        match list {
            [] => Ok(()),
            [task] => work(*task as usize, all),
            _ => {
                let (left, right) = self.halves(list);
                let first = |list: &[u32]| &self.list[list[0] as usize];
                let (a, b) = all.cut(first(left), first(right));
                let (a, b) = team
                    .join(|| self.each(team, left, a, work), || self.each(team, right, b, work));
                a.and(b)
            }
        }
    }

    /// Enlarges the storage of every task so that one front can have all unknowns of the task, the largest front that delayed pivots can
    /// cause. `order` has the unknown at each position.
    pub(crate) fn widen(&mut self, order: &[u32]) {
        let mut end = 0;
        for at in 0..self.list.len() {
            let below = self.below(at).first();
            let begin = below.map_or(end, |&c| self.list[c as usize].vector[0]);
            let task = &mut self.list[at];
            let longest = task.places.end - task.first_place + task.outer.len();
            let start = end;
            end += task.places.len() + task.outer.len() + longest;
            task.vector = [begin, start, end];
            for (k, &u) in order[task.places.clone()].iter().enumerate() {
                self.stored_at[u as usize] = index(start + k);
            }
        }
        self.sizes[1] = end;
    }
}

/// Divides the tree into tasks. `work` is the time of each front [ns], `grain` the least time of a task.
pub(crate) fn tasks(
    (fronts, parent): (&[Front], &[u32]),
    all_rows: &[u32],
    work: &[f64],
    (grain, largest_block): (f64, usize),
) -> Tasks {
    let mut cutter = Cutter::new(parent, work, grain);
    let roots: Vec<usize> = (0..parent.len()).filter(|&s| parent[s] == NONE).collect();
    let roots = cutter.siblings(&roots, 0);
    let mut tasks = Tasks {
        list: cutter
            .cut
            .iter()
            .map(|fronts| Task { fronts: fronts.clone(), ..Task::default() })
            .collect(),
        children: Lists::with_capacity(cutter.cut.len()),
        roots,
        ..Tasks::default()
    };
    for below in &cutter.below {
        tasks.children.items.extend_from_slice(below);
        tasks.children.close();
    }
    let mut now = 0.0;
    for at in 0..tasks.list.len() {
        tasks.lay_out(at, fronts, all_rows, largest_block);
        let begin = tasks.below(at).first().map_or(now, |&c| tasks.list[c as usize].work[0]);
        let task = &mut tasks.list[at];
        now += work[task.fronts.clone()].iter().sum::<f64>();
        task.work = [begin, now];
    }
    tasks
}

/// State of the division of a tree.
struct Cutter<'a> {
    children: Lists,
    /// First front of the subtree of each front, and the work of the subtree [ns].
    first: Vec<usize>,
    total: Vec<f64>,
    grain: f64,
    parent: &'a [u32],
    cut: Vec<Range<usize>>,
    below: Vec<Vec<u32>>,
}

impl<'a> Cutter<'a> {
    fn new(parent: &'a [u32], work: &[f64], grain: f64) -> Self {
        let n = parent.len();
        let mut children = Lists::with_capacity(n);
        let (mut first, mut total): (Vec<usize>, Vec<f64>) = ((0..n).collect(), work.to_vec());
        for s in 0..n {
            if parent[s] != NONE {
                let above = parent[s] as usize;
                first[above] = first[above].min(first[s]);
                total[above] += total[s];
                children.items.push(parent[s]);
            }
            children.close();
        }
        let children = children.transposed(n);
        Self { children, first, total, grain, parent, cut: Vec::new(), below: Vec::new() }
    }

    fn push(&mut self, fronts: Range<usize>, below: Vec<u32>) -> u32 {
        self.cut.push(fronts);
        self.below.push(below);
        index(self.cut.len() - 1)
    }

    /// Makes tasks of the subtrees of neighbouring siblings; small subtrees form one task.
    fn siblings(&mut self, roots: &[usize], depth: usize) -> Vec<u32> {
        let (mut made, mut from, mut gathered) = (Vec::new(), None, 0.0);
        for (i, &root) in roots.iter().enumerate() {
            let is_large = self.total[root] > self.grain && depth < DEEPEST;
            if is_large {
                let before = from.take().map(|from| self.push(from..self.first[root], Vec::new()));
                made.extend(before);
                made.push(self.subtree(root, depth));
                gathered = 0.0;
                continue;
            }
            from = from.or(Some(self.first[root]));
            gathered += self.total[root];
            if gathered > self.grain || i + 1 == roots.len() {
                made.extend(from.take().map(|from| self.push(from..root + 1, Vec::new())));
                gathered = 0.0;
            }
        }
        made
    }

    /// Makes the task that ends with front `root` and begins after the next fork of the tree that has enough work on two sides.
    fn subtree(&mut self, root: usize, depth: usize) -> u32 {
        let mut low = root;
        loop {
            let kids: Vec<usize> = self.children.get(low).iter().map(|&c| c as usize).collect();
            let Some((&heavy, light)) = kids.split_first() else {
                return self.push(low..root + 1, Vec::new());
            };
            let light: f64 = light.iter().map(|&c| self.total[c]).sum();
            if light > self.grain {
                // All fronts from `low` on belong to this task; those of the tasks below come before it.
                debug_assert!(kids.iter().all(|&c| self.parent[c] as usize == low));
                let below = self.siblings(&kids, depth + 1);
                return self.push(low..root + 1, below);
            }
            if self.total[heavy] <= self.grain {
                return self.push(self.first[low]..root + 1, Vec::new());
            }
            low = heavy;
        }
    }
}

impl Tasks {
    /// Computes the storage and the rows of task `at`. The storage of its children must be known.
    fn lay_out(&mut self, at: usize, fronts: &[Front], all_rows: &[u32], largest_block: usize) {
        let own = &fronts[self.list[at].fronts.clone()];
        let (first, last) = (own[0].first, &own[own.len() - 1]);
        let places = first..last.first + last.p;
        let mut outer: Vec<u32> = own
            .iter()
            .flat_map(|front| all_rows[front.rows.clone()].iter())
            .chain(
                self.below(at)
                    .iter()
                    .flat_map(|&c| &self.outer[self.list[c as usize].outer.clone()]),
            )
            .copied()
            .filter(|&q| q as usize >= places.end)
            .collect();
        outer.sort_unstable();
        outer.dedup();
        let local = |q: u32| {
            let q_at = q as usize;
            if q_at < places.end {
                q - index(places.start)
            } else {
                index(places.len() + outer.partition_point(|&o| o < q))
            }
        };
        for &child in self.children.get(at) {
            let range = self.list[child as usize].outer.clone();
            for k in range {
                self.targets[k] = local(self.outer[k]);
            }
        }
        debug_assert!(self.rows.len() <= all_rows.len());
        self.rows.resize(all_rows.len(), 0);
        for front in own {
            for k in front.rows.clone() {
                self.rows[k] = local(all_rows[k]);
            }
        }
        let most = own.iter().map(|front| front.p).max().unwrap_or(0);
        let numbers: usize = own.iter().map(|front| column(front.f, front.f)).sum();
        let begin = self.below(at).first().map_or(self.sizes, |&c| {
            let child = &self.list[c as usize];
            [child.numbers[0], child.vector[0]]
        });
        let first_place =
            self.below(at).first().map_or(places.start, |&c| self.list[c as usize].first_place);
        let first_task = self.below(at).first().map_or(at, |&c| self.list[c as usize].first_task);
        let start = self.outer.len();
        self.outer.extend_from_slice(&outer);
        self.targets.resize(self.outer.len(), 0);
        let [number, vector] = self.sizes;
        let ends = [number + numbers + largest_block, vector + places.len() + outer.len() + most];
        let task = &mut self.list[at];
        task.numbers = [begin[0], number, ends[0]];
        task.vector = [begin[1], vector, ends[1]];
        task.first_place = first_place;
        task.first_task = first_task;
        task.places = places;
        task.outer = start..self.outer.len();
        self.sizes = ends;
    }
}

//! Factorisation and the two sweeps, task by task. A task works on its own numbers and on those of the tasks below it.
//!
//! ```text
//! factor:    tasks below (at the same time, each with its part of the numbers), then the fronts of the task in order
//! forward:   tasks below, then the addition of their results in order, then the fronts of the task
//! backward:  the fronts of the task in reverse order, then the solved unknowns are passed to the tasks below
//! ```
//!
//! Every sum has one order, that of the plan. Parts are divided with `split_at_mut`, so that two tasks cannot access the same number.

use crate::front::{Front, FrontInit, column};
use crate::kernel::{self, BadPivot};
use crate::options::Pivoting;
use crate::part;
use crate::pivoting::eliminate_largest;
use crate::plan::Plan;
use crate::sweep;
use crate::tasks::{Owned, Storage, Task};
use mbs_math::{BlockSource, FactorError, Real, Team};
use std::convert::Infallible;

/// Numbers of a factorisation that belong to neighbouring tasks and all tasks below them.
#[derive(Debug)]
pub(crate) struct Numbers<'a, T> {
    pub(crate) fronts: &'a mut [T],
    pub(crate) pivots: &'a mut [T],
    pub(crate) order: &'a mut [u32],
    /// Rows that became pivots, one for each entry of `order`; empty without pivoting.
    pub(crate) taken: &'a mut [u32],
}

impl<'a, T: Real> Numbers<'a, T> {
    /// Divides the data in two: the first part has `numbers` numbers of fronts and `places` positions.
    fn split_at(self, numbers: usize, places: usize) -> (Self, Self) {
        let (fronts, fronts_right) = self.fronts.split_at_mut(numbers);
        let (pivots, pivots_right) = self.pivots.split_at_mut(places);
        let (order, order_right) = self.order.split_at_mut(places);
        let (taken, taken_right) = self.taken.split_at_mut(places.min(self.taken.len()));
        (
            Numbers { fronts, pivots, order, taken },
            Numbers {
                fronts: fronts_right,
                pivots: pivots_right,
                order: order_right,
                taken: taken_right,
            },
        )
    }

    /// Borrows the same numbers again.
    fn lent(&mut self) -> Numbers<'_, T> {
        let Numbers { fronts, pivots, order, taken } = self;
        Numbers { fronts, pivots, order, taken }
    }

    /// Assembles and factors all fronts.
    pub(crate) fn factor<W: Team, S: BlockSource<T>>(
        self,
        how: (&Plan, Pivoting),
        team: &W,
        source: &S,
    ) -> Result<(), FactorError> {
        let tasks = &how.0.tasks;
        tasks.each(team, &tasks.roots, self, &|at, own: Numbers<'a, T>| {
            own.factor_task(how, team, source, at)
        })
    }

    /// Factors the fronts of the tasks below, then those of the task itself.
    fn factor_task<W: Team, S: BlockSource<T>>(
        mut self,
        how: (&Plan, Pivoting),
        team: &W,
        source: &S,
        at: usize,
    ) -> Result<(), FactorError> {
        let task = &how.0.tasks.list[at];
        let below = how.0.tasks.below(at);
        if !below.is_empty() {
            let places = task.places.start - task.first_place;
            let (part, _) = self.lent().split_at(task.numbers[1] - task.numbers[0], places);
            how.0.tasks.each(team, below, part, &|at, own: Numbers<'_, T>| {
                own.factor_task(how, team, source, at)
            })?;
        }
        let (start, end) = (task.numbers[0], task.numbers[2]);
        let (fronts, block) = self.fronts[..end - start].split_at_mut(end - start - how.0.n_block);
        for front in &how.0.fronts[task.fronts.clone()] {
            assemble(how.0, front, source, (&mut *fronts, start), block);
            let at = front.first - task.first_place;
            let a = &mut fronts[front.offset - start..][..column(front.f, front.f)];
            let d = &mut self.pivots[at..at + front.p];
            let order = &mut self.order[at..at + front.p];
            let taken = self.taken.get_mut(at..at + front.p).unwrap_or_default();
            eliminate(how, front, (a, d), (order, taken))?;
        }
        Ok(())
    }
}

impl<T: Real> Owned for Numbers<'_, T> {
    fn cut(self, begin: &Task, cut: &Task) -> (Self, Self) {
        let numbers = cut.numbers[0] - begin.numbers[0];
        self.split_at(numbers, cut.first_place - begin.first_place)
    }
}

/// Assembles elements and updates of children into a front; `fronts` begins at index `start` of all numbers.
#[inline(always)]
fn assemble<T: Real, S: BlockSource<T>>(
    plan: &Plan,
    front: &Front,
    source: &S,
    (fronts, start): (&mut [T], usize),
    block: &mut [T],
) {
    let f = front.f;
    let (done, rest) = fronts.split_at_mut(front.offset - start);
    let a = &mut rest[..column(f, f)];
    let mut elements = &plan.elements[front.elements.clone()];
    match (front.init, elements) {
        (FrontInit::Written, [whole, others @ ..]) => {
            source.write_block(whole.source, a);
            elements = others;
        }
        (FrontInit::Permuted, [whole, others @ ..]) => {
            let block = &mut block[..a.len()];
            source.write_block(whole.source, block);
            part::permute(a, whole.targets(&plan.targets), block);
            elements = others;
        }
        (FrontInit::Gathered, [first, ..]) => {
            a.fill(T::ZERO);
            let mut n = 0;
            for element in elements {
                source.write_block(element.source, &mut block[n..n + element.len()]);
                n += element.len();
            }
            part::scatter(a, first.targets(&plan.targets), &block[..n]);
            elements = &[];
        }
        _ => a.fill(T::ZERO),
    }
    for element in elements.iter().filter(|element| source.has_block(element.source)) {
        let block = &mut block[..element.len()];
        source.write_block(element.source, block);
        part::add(a, f, element, &plan.targets, block);
    }
    for child in &plan.children[front.children.clone()] {
        let update = &done[child.source - start..][..child.len()];
        part::add(a, f, child, &plan.targets, update);
    }
}

/// Eliminates the pivots of one assembled front.
#[inline(always)]
fn eliminate<T: Real>(
    (plan, pivoting): (&Plan, Pivoting),
    front: &Front,
    (a, d): (&mut [T], &mut [T]),
    (order, taken): (&mut [u32], &mut [u32]),
) -> Result<(), FactorError> {
    let result = match pivoting {
        Pivoting::None => kernel::eliminate(a, d, front.f),
        Pivoting::Diagonal => {
            let result = eliminate_largest(a, d, taken, front.f);
            for (u, &row) in order.iter_mut().zip(&*taken) {
                *u = plan.order[front.first + row as usize];
            }
            result
        }
    };
    result.map_err(|BadPivot { column, pivot }| FactorError {
        unknown: order[column],
        pivot: pivot.to_f64(),
    })
}

/// Fronts of a factorisation, as visited by the sweeps of a solution.
pub(crate) trait Sweep<T>: Sync {
    /// Visits front `s` of a task in a sweep. `storage` belongs to the task and all tasks below it.
    fn visit(&self, s: usize, task: &Task, storage: &mut [T], direction: Direction);
}

/// A factorisation with the team that solves with it.
#[derive(Debug)]
pub(crate) struct Vectors<'a, W, F> {
    pub(crate) plan: &'a Plan,
    pub(crate) team: &'a W,
    pub(crate) fronts: F,
}

/// Direction of a sweep: forward elimination or back-substitution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Direction {
    Forward,
    Backward,
}

impl<W: Team, F> Vectors<'_, W, F> {
    /// Makes both sweeps with the right-hand side `x`, in the storage of all tasks.
    pub(crate) fn solve<T: Real>(&self, x: &[T], storage: &mut [T])
    where
        F: Sweep<T>,
    {
        self.forward_all(&self.plan.tasks.roots, x, storage);
        self.backward_all(&self.plan.tasks.roots, storage, None);
    }

    /// Makes the forward sweep of the neighbouring tasks of a list.
    fn forward_all<T: Real>(&self, list: &[u32], x: &[T], storage: &mut [T])
    where
        F: Sweep<T>,
    {
        let work = |at, Storage(own): Storage<'_, T>| {
            self.forward(at, x, own);
            Ok::<(), Infallible>(())
        };
        let Ok(()) = self.plan.tasks.each(self.team, list, Storage(storage), &work);
    }

    /// Makes the backward sweep of the neighbouring tasks of a list; `above` is the vector of the task above.
    pub(crate) fn backward_all<T: Real>(&self, list: &[u32], storage: &mut [T], above: Option<&[T]>)
    where
        F: Sweep<T>,
    {
        let work = |at, Storage(own): Storage<'_, T>| {
            self.backward(at, own, above);
            Ok::<(), Infallible>(())
        };
        let Ok(()) = self.plan.tasks.each(self.team, list, Storage(storage), &work);
    }

    fn forward<T: Real>(&self, at: usize, x: &[T], storage: &mut [T])
    where
        F: Sweep<T>,
    {
        let task = &self.plan.tasks.list[at];
        let (below, own) = storage.split_at_mut(task.vector[1] - task.vector[0]);
        let children = self.plan.tasks.below(at);
        self.forward_all(children, x, below);
        let (places, outer) = own.split_at_mut(task.places.len());
        for (z, &u) in places.iter_mut().zip(&self.plan.order[task.places.clone()]) {
            *z = x[u as usize];
        }
        outer[..task.outer.len()].fill(T::ZERO);
        for &child in children {
            let child = &self.plan.tasks.list[child as usize];
            let from = &below[child.outer_vector(task.vector[0])..];
            let targets = &self.plan.tasks.targets[child.outer.clone()];
            for (&target, &value) in targets.iter().zip(from) {
                own[target as usize] += value;
            }
        }
        for s in task.fronts.clone() {
            self.fronts.visit(s, task, storage, Direction::Forward);
        }
    }

    fn backward<T: Real>(&self, at: usize, storage: &mut [T], above: Option<&[T]>)
    where
        F: Sweep<T>,
    {
        let task = &self.plan.tasks.list[at];
        let begin = task.vector[1] - task.vector[0];
        if let Some(above) = above {
            let targets = &self.plan.tasks.targets[task.outer.clone()];
            for (z, &target) in storage[begin + task.places.len()..].iter_mut().zip(targets) {
                *z = above[target as usize];
            }
        }
        for s in task.fronts.clone().rev() {
            self.fronts.visit(s, task, storage, Direction::Backward);
        }
        let (below, own) = storage.split_at_mut(begin);
        self.backward_all(self.plan.tasks.below(at), below, Some(own));
    }
}

/// Factored fronts that the sweeps of a solution read.
#[derive(Debug)]
pub(crate) struct Factor<'a, T> {
    pub(crate) plan: &'a Plan,
    pub(crate) fronts: &'a [T],
    pub(crate) taken: &'a [u32],
}

impl<T: Real> Sweep<T> for Factor<'_, T> {
    #[inline(always)]
    fn visit(&self, s: usize, task: &Task, storage: &mut [T], direction: Direction) {
        let (front, own) = (&self.plan.fronts[s], &mut storage[task.vector[1] - task.vector[0]..]);
        let Front { p, f, offset, first, at, .. } = *front;
        let a = &self.fronts[offset..offset + column(f, f)];
        let rows = &self.plan.tasks.rows[front.rows.clone()];
        let Some(taken) = self.taken.get(first..first + p) else {
            return match direction {
                Direction::Forward => sweep::forward(a, own, (at, p), rows),
                Direction::Backward => sweep::backward(a, own, (at, p), rows),
            };
        };
        // Within the front the pivots are in swapped order, outside it in the order of the analysis.
        match direction {
            Direction::Forward => {
                let (own, scratch) = own.split_at_mut(own.len() - p);
                let pivots = &mut own[at..at + p];
                scratch.copy_from_slice(pivots);
                for (z, &row) in pivots.iter_mut().zip(taken) {
                    *z = scratch[row as usize];
                }
                sweep::forward(a, own, (at, p), rows);
            }
            Direction::Backward => {
                sweep::backward(a, own, (at, p), rows);
                let (own, scratch) = own.split_at_mut(own.len() - p);
                let pivots = &mut own[at..at + p];
                scratch.copy_from_slice(pivots);
                for (&z, &row) in scratch.iter().zip(taken) {
                    pivots[row as usize] = z;
                }
            }
        }
    }
}

impl Task {
    /// Returns the start, in a storage that begins at `start`, of the task's results for rows of the tasks above.
    fn outer_vector(&self, start: usize) -> usize {
        self.vector[1] + self.places.len() - start
    }
}

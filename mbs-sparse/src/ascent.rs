//! A vector carried up the tree of tasks: from the leaves to the roots, the tasks below before those above.
//!
//! ```text
//! own vector of a task:   [ its places | rows further up | scratch ]
//! begin with what the places hold, add what the tasks below leave for its rows, in their order, then work on its own fronts
//! ```

use crate::plan::Plan;
use crate::tasks::Task;
use mbs_core::{Real, Team};

/// What is done at each task.
pub(crate) trait Ascent<T>: Sync {
    /// Writes what the places of a task hold before anything is added.
    fn begin(&self, task: &Task, places: &mut [T]);
    /// The own work of a task on its own vector.
    fn work(&self, task: &Task, own: &mut [T]);
}

/// Works on the neighbouring tasks of a list and all below, by halves.
pub(crate) fn ascend<T: Real, W: Team>(
    (plan, team): (&Plan, &W),
    list: &[u32],
    storage: &mut [T],
    ascent: &impl Ascent<T>,
) {
    let tasks = &plan.tasks.list;
    let (left, right) = match list {
        [] => return,
        [task] => return visit((plan, team), *task as usize, storage, ascent),
        _ => plan.tasks.halves(list),
    };
    let begin = tasks[left[0] as usize].vector[0];
    let (a, b) = storage.split_at_mut(tasks[right[0] as usize].vector[0] - begin);
    team.join(|| ascend((plan, team), left, a, ascent), || ascend((plan, team), right, b, ascent));
}

fn visit<T: Real, W: Team>(
    (plan, team): (&Plan, &W),
    at: usize,
    storage: &mut [T],
    ascent: &impl Ascent<T>,
) {
    let task = &plan.tasks.list[at];
    let (below, own) = storage.split_at_mut(task.vector[1] - task.vector[0]);
    let children = plan.tasks.below(at);
    ascend((plan, team), children, below, ascent);
    let (places, outer) = own.split_at_mut(task.places.len());
    ascent.begin(task, places);
    outer[..task.outer.len()].fill(T::ZERO);
    for &child in children {
        let child = &plan.tasks.list[child as usize];
        let from = &below[child.outer_vector(task.vector[0])..];
        let targets = &plan.tasks.targets[child.outer.clone()];
        for (&target, &value) in targets.iter().zip(from) {
            own[target as usize] += value;
        }
    }
    ascent.work(task, own);
}

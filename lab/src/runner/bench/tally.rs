//! Operations by phases of a step: a meter for numbers that count their operations.

use crate::bench::clocked::{Meter, NAMES, Phase};
use crate::bench::counted::done;
use mbs_nostd::operation_bound::Operations;
use std::sync::Mutex;

/// Operations of each phase, and of the rest of the step.
pub(crate) struct Tally(Mutex<[Operations; NAMES.len() + 1]>);

impl Default for Tally {
    fn default() -> Self {
        Self(Mutex::new([Operations::NONE; _]))
    }
}

impl Tally {
    /// Sets all counts to zero.
    pub(crate) fn forget(&self) {
        done();
        if let Ok(mut sums) = self.0.lock() {
            sums.fill(Operations::NONE);
        }
    }

    /// Adds the operations since the last call to one of the sums.
    fn take(&self, of: usize) {
        if let Ok(mut sums) = self.0.lock() {
            add(&mut sums[of], &done());
        }
    }

    /// Adds the operations since the last phase to the rest of the step.
    pub(crate) fn end(&self) {
        self.take(NAMES.len());
    }

    /// Sums of all phases, with their names.
    pub(crate) fn phases(&self) -> impl Iterator<Item = (&'static str, Operations)> {
        let sums = self.0.lock().map_or([Operations::NONE; _], |sums| *sums);
        NAMES.into_iter().chain(["rest"]).zip(sums)
    }

    pub(crate) fn all(&self) -> Operations {
        let mut all = Operations::NONE;
        self.phases().for_each(|(_, done)| add(&mut all, &done));
        all
    }
}

impl Meter for Tally {
    fn read<R>(&self, phase: Phase, work: impl FnOnce() -> R) -> R {
        self.end();
        let result = work();
        self.take(phase as usize);
        result
    }
}

fn add(sum: &mut Operations, done: &Operations) {
    sum.products += done.products;
    sum.sums += done.sums;
    sum.quotients += done.quotients;
    sum.roots += done.roots;
    sum.turns += done.turns;
}

//! A thread team for the tests of this crate.

use mbs_sparse::Team;

/// Team with two threads at every fork, whose order of execution changes from run to run.
#[derive(Debug, Clone)]
pub(crate) struct Forking;

impl Team for Forking {
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        std::thread::scope(|scope| {
            let b = scope.spawn(b);
            let a = a();
            (a, b.join().expect("no panic"))
        })
    }
    fn size(&self) -> usize {
        2
    }
}

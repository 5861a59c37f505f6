//! Teams of threads for the work of one step. [`Pool`] uses rayon, and [`ThreadTeam`] a queue of crossbeam. [`Threads`] is chosen at run
//! time: a thread team, or the caller's thread alone.
//!
//! All of them give the same bits, because the division of work does not depend on the team ([`mbs_math::team`]).

mod job;
mod pool;
mod thread_team;

pub use pool::Pool;
pub use thread_team::ThreadTeam;

use mbs_math::team::Team;

/// A team chosen at run time.
#[derive(Debug, Clone, Default)]
pub enum Threads {
    /// The caller's thread alone.
    #[default]
    One,
    /// Threads that wait actively for work.
    ThreadTeam(ThreadTeam),
}

impl Threads {
    /// Creates a team: the caller's thread alone for `n` = 1 (or 0), or a [`ThreadTeam`] of `n` threads for more.
    ///
    /// # Errors
    /// When the operating system gives no threads.
    pub fn new(n: usize) -> std::io::Result<Self> {
        if n <= 1 { Ok(Self::One) } else { ThreadTeam::new(n).map(Self::ThreadTeam) }
    }
}

impl Team for Threads {
    #[inline]
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        match self {
            Self::One => (a(), b()),
            Self::ThreadTeam(team) => team.join(a, b),
        }
    }

    #[inline]
    fn size(&self) -> usize {
        match self {
            Self::One => 1,
            Self::ThreadTeam(team) => team.size(),
        }
    }
}

//! Teams of threads for the work of one step: [`Pool`] on rayon, [`ThreadTeam`] with a queue of crossbeam, and [`Threads`], a thread team
//! or none, chosen at run time.
//!
//! All of them give the same bits: how work is cut is none of their business ([`mbs_math::team`]).

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
    /// Threads that wait for work awake.
    ThreadTeam(ThreadTeam),
}

impl Threads {
    /// The caller's thread for `n` = 1 (or 0), a [`ThreadTeam`] of n for more.
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

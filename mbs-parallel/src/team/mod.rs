//! Teams of threads for the work of one step: [`Pool`] on rayon, [`Crew`] with a queue of crossbeam, and [`Threads`], a crew
//! or none, chosen at run time.
//!
//! All of them give the same bits: how work is cut is none of their business ([`mbs_core::team`]).

mod crew;
mod job;
mod pool;

pub use crew::Crew;
pub use pool::Pool;

use mbs_core::team::{Alone, Team};

/// A team chosen at run time.
#[derive(Debug, Clone, Default)]
pub enum Threads {
    /// The caller's thread.
    #[default]
    One,
    /// Threads that wait for work awake.
    Crew(Crew),
}

impl Threads {
    /// The caller's thread for `n` = 1 (or 0), a [`Crew`] of n for more.
    ///
    /// # Errors
    /// When the operating system gives no threads.
    pub fn new(n: usize) -> std::io::Result<Self> {
        if n <= 1 { Ok(Self::One) } else { Crew::new(n).map(Self::Crew) }
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
            Self::One => Alone.join(a, b),
            Self::Crew(crew) => crew.join(a, b),
        }
    }

    #[inline]
    fn size(&self) -> usize {
        match self {
            Self::One => 1,
            Self::Crew(crew) => crew.size(),
        }
    }
}

//! A team on rayon.

use mbs_math::team::Team;
use std::sync::Arc;

/// Threads of a rayon pool of its own; the program's global pool is left alone.
///
/// A step called from outside the pool enters and leaves it at every fork, which takes microseconds: run all steps inside
/// [`Pool::enter`].
#[derive(Debug, Clone)]
pub struct Pool {
    pool: Arc<rayon::ThreadPool>,
}

impl Pool {
    /// `n` threads, at least one.
    ///
    /// # Errors
    /// When the operating system gives no threads.
    pub fn new(n: usize) -> std::io::Result<Self> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n.max(1)).build();
        Ok(Self { pool: Arc::new(pool.map_err(std::io::Error::other)?) })
    }

    /// Runs `work` on one of the threads.
    pub fn enter<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.pool.install(work)
    }
}

impl Team for Pool {
    #[inline]
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        self.pool.join(a, b)
    }

    fn size(&self) -> usize {
        self.pool.current_num_threads()
    }
}

//! Thread team on a pool of rayon.

use mbs_math::team::Team;
use std::sync::Arc;

/// Threads of a separate rayon pool; the global pool of the program is not used.
///
/// A step that is called from outside the pool enters and leaves the pool at every fork, which takes microseconds. Run all steps inside
/// [`Pool::enter`] instead.
#[derive(Debug, Clone)]
pub struct Pool {
    pool: Arc<rayon::ThreadPool>,
}

impl Pool {
    /// Creates a pool of `n` threads, at least one.
    ///
    /// # Errors
    /// When the operating system gives no threads.
    pub fn new(n: usize) -> std::io::Result<Self> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n.max(1)).build();
        Ok(Self { pool: Arc::new(pool.map_err(std::io::Error::other)?) })
    }

    /// Runs `work` on one of the threads of the pool.
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

//! Ensembles of independent jobs on several threads, with one sink for the results.

#[cfg(test)]
mod tests;

use core::any::Any;
use core::fmt::{self, Display, Formatter};
use core::num::NonZeroUsize;
use core::ops::ControlFlow;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;

/// A pool of threads for ensembles, separate from rayon's global pool.
#[derive(Debug)]
pub struct Ensemble {
    pool: ThreadPool,
    threads: NonZeroUsize,
}

/// Error of an operating system that provides too few threads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum EnsembleError {
    /// The system could not start this number of threads.
    Threads(NonZeroUsize),
}

/// Message of a job that panicked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Panicked(String);

impl Ensemble {
    /// Starts `threads` threads; by default one for each processor of this process. One thread runs the same code as several threads.
    ///
    /// Cost: the threads exist until the ensemble is dropped, and wait without load.
    ///
    /// # Errors
    /// [`EnsembleError::Threads`] when the system provides fewer threads.
    pub fn new(threads: Option<NonZeroUsize>) -> Result<Self, EnsembleError> {
        let threads = threads.unwrap_or_else(available);
        let builder = ThreadPoolBuilder::new().num_threads(threads.get());
        let pool = builder.thread_name(|i| format!("ensemble-{i}")).build();
        let pool = pool.map_err(|_| EnsembleError::Threads(threads))?;
        Ok(Self { pool, threads })
    }

    /// Number of threads that run jobs.
    #[must_use]
    pub fn threads(&self) -> NonZeroUsize {
        self.threads
    }

    /// Runs `job(i)` for every `i` in `jobs`, and passes each result to `sink` in the order of completion.
    ///
    /// Jobs begin in the order of the list: each thread starts the next job when its last one has ended. `sink` is called on the calling
    /// thread, which runs no job. When `sink` breaks, no further job begins, and the results of running jobs are dropped. The result of a
    /// job that panics is its panic. Such a job may leave data half-changed, so jobs should share only data that they do not change.
    ///
    /// Cost: one atomic addition and one message for each job.
    pub fn run<R: Send>(
        &self,
        jobs: &[usize],
        job: impl Fn(usize) -> R + Sync,
        mut sink: impl FnMut(usize, Result<R, Panicked>) -> ControlFlow<()>,
    ) {
        let next = AtomicUsize::new(0);
        let (sender, receiver) = mpsc::channel();
        self.pool.in_place_scope(|scope| {
            let (next, job) = (&next, &job);
            scope.spawn_broadcast(move |_, _| {
                while let Some(&i) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let result = catch_unwind(AssertUnwindSafe(|| job(i)));
                    if sender.send((i, result.map_err(Panicked::new))).is_err() {
                        break;
                    }
                }
            });
            // the loop ends when every thread has dropped its sender
            for (i, result) in receiver {
                if sink(i, result).is_break() {
                    next.store(jobs.len(), Ordering::Relaxed);
                    break;
                }
            }
        });
    }
}

/// Returns the number of processors that this process may use. Returns one if the system does not report it.
#[must_use]
pub fn available() -> NonZeroUsize {
    std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
}

impl Panicked {
    /// Extracts the message of a panic; messages of [`panic!`] are texts.
    pub(crate) fn new(payload: Box<dyn Any + Send>) -> Self {
        let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
        let text = text.or_else(|| payload.downcast_ref::<String>().cloned());
        Self(text.unwrap_or_else(|| "no message".to_owned()))
    }

    /// Message of the panic.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.0
    }
}

impl Display for Panicked {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "panicked: {}", self.0)
    }
}

impl core::error::Error for Panicked {}

impl Display for EnsembleError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Threads(n) => write!(f, "{n} threads could not be started: try fewer"),
        }
    }
}

impl core::error::Error for EnsembleError {}

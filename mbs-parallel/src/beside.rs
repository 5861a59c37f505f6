//! A job on a thread of its own, looked at while it goes.

use crate::ensemble::Panicked;
use core::time::Duration;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;

/// Stack of the thread of a job [bytes]: that of a process's first thread on most systems.
const STACK: usize = 8 << 20;

/// Does a job on a thread of its own, and calls `look` on this one once in a `period` until it is done. A job that panics is a result too.
///
/// Cost: a thread; the end of the job is seen at once.
///
/// # Errors
/// [`Panicked`]: what the job said, or that the system gives no thread.
///
/// ```
/// use core::time::Duration;
/// let mut looks = 0;
/// let sum = mbs_parallel::beside(|| (1..=10).sum::<u32>(), Duration::from_secs(1), || looks += 1);
/// assert_eq!((sum, looks), (Ok(55), 0));
/// ```
pub fn beside<R: Send>(
    job: impl FnOnce() -> R + Send,
    period: Duration,
    mut look: impl FnMut(),
) -> Result<R, Panicked> {
    let (sender, receiver) = channel();
    thread::scope(|scope| {
        let started = thread::Builder::new().name("job".to_owned()).stack_size(STACK).spawn_scoped(
            scope,
            move || {
                let done = catch_unwind(AssertUnwindSafe(job)).map_err(Panicked::new);
                // somebody waits for it
                let _ = sender.send(done);
            },
        );
        if let Err(error) = started {
            return Err(Panicked::new(Box::new(error.to_string())));
        }
        loop {
            match receiver.recv_timeout(period) {
                Ok(done) => return done,
                Err(RecvTimeoutError::Timeout) => look(),
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(Panicked::new(Box::new("the job gave no result")));
                }
            }
        }
    })
}

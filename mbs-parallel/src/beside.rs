//! A job on a thread of its own, looked at while it goes.

use crate::ensemble::Panicked;
use core::ops::ControlFlow;
use core::time::Duration;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;

/// Stack of the thread of a job [bytes]: that of a process's first thread on most systems.
const STACK: usize = 8 << 20;

/// Result of a job, or its panic.
type Done<R> = Result<R, Panicked>;

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
    let (job, receiver) = reported(job);
    thread::scope(|scope| {
        builder().spawn_scoped(scope, job).map_err(no_thread)?;
        let look = || {
            look();
            ControlFlow::Continue(())
        };
        wait(&receiver, period, look).unwrap_or_else(|| Err(gone()))
    })
}

/// Does a job as [`beside`] does, but a `look` that breaks leaves the job to itself. The job then ends on its own, and what it gives is lost.
///
/// # Errors
/// As for [`beside`].
///
/// ```
/// use core::{ops::ControlFlow, time::Duration};
/// let long = || std::thread::sleep(Duration::from_millis(200));
/// assert_eq!(mbs_parallel::apart(long, Duration::from_millis(1), || ControlFlow::Break(())), Ok(None));
/// assert_eq!(mbs_parallel::apart(|| 1, Duration::from_secs(1), || ControlFlow::Break(())), Ok(Some(1)));
/// ```
pub fn apart<R: Send + 'static>(
    job: impl FnOnce() -> R + Send + 'static,
    period: Duration,
    look: impl FnMut() -> ControlFlow<()>,
) -> Result<Option<R>, Panicked> {
    let (job, receiver) = reported(job);
    builder().spawn(job).map_err(no_thread)?;
    wait(&receiver, period, look).transpose()
}

/// A job that sends what it gave, and where that arrives.
fn reported<R: Send>(job: impl FnOnce() -> R + Send) -> (impl FnOnce() + Send, Receiver<Done<R>>) {
    let (sender, receiver) = channel();
    let job = move || {
        let done = catch_unwind(AssertUnwindSafe(job)).map_err(Panicked::new);
        // perhaps it was left
        let _ = sender.send(done);
    };
    (job, receiver)
}

fn builder() -> thread::Builder {
    thread::Builder::new().name("job".to_owned()).stack_size(STACK)
}

fn no_thread(error: std::io::Error) -> Panicked {
    Panicked::new(Box::new(error.to_string()))
}

fn gone() -> Panicked {
    Panicked::new(Box::new("the job gave no result"))
}

/// Waits for a job and looks meanwhile; nothing where a look breaks.
fn wait<R>(
    receiver: &Receiver<Done<R>>,
    period: Duration,
    mut look: impl FnMut() -> ControlFlow<()>,
) -> Option<Done<R>> {
    loop {
        match receiver.recv_timeout(period) {
            Ok(done) => return Some(done),
            Err(RecvTimeoutError::Timeout) => {
                if look().is_break() {
                    return None;
                }
            }
            Err(RecvTimeoutError::Disconnected) => return Some(Err(gone())),
        }
    }
}

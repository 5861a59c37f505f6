//! A job on a separate thread, with regular calls on the calling thread until it ends.

use crate::ensemble::Panicked;
use core::ops::ControlFlow;
use core::time::Duration;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;

/// Stack size of the thread of a job [bytes]. It equals the stack size of the first thread of a process on most systems.
const STACK: usize = 8 << 20;

/// Result of a job, or its panic.
type Done<R> = Result<R, Panicked>;

/// Runs a job on a separate thread, and calls `look` on the calling thread once in each `period` until the job ends. If the job panics, the
/// function returns the panic as an error.
///
/// Cost: a thread. The function returns as soon as the job ends, without waiting for the end of a `period`.
///
/// # Errors
/// [`Panicked`] with the message of the job's panic, or with a message that the system provides no thread.
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

/// Runs a job as [`beside`] does, but stops waiting for the job when `look` breaks. The job then continues on its thread, and its result is
/// lost.
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

/// Returns a job that sends its result, and the receiver of the result.
fn reported<R: Send>(job: impl FnOnce() -> R + Send) -> (impl FnOnce() + Send, Receiver<Done<R>>) {
    let (sender, receiver) = channel();
    let job = move || {
        let done = catch_unwind(AssertUnwindSafe(job)).map_err(Panicked::new);
        // the receiver no longer exists if the caller has stopped waiting for the job
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

/// Waits for a job and calls `look` regularly. Returns `None` if `look` breaks.
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

//! A closure on the stack of one thread that another thread may run: the one place of this crate with `unsafe`.
//!
//! ```text
//! owner:   Job on its stack -> Handle into a queue ... waits until the job is done ... takes the result
//! runner:  takes the Handle out of the queue -> runs the closure -> stores the result -> marks the job done
//! ```
//!
//! # Proof
//!
//! 1. *A handle never outlives its job.* [`Job::with_handle`] is the only way to make one. It gives the handle to `lend`, and
//!    does not return (nor unwind) before `is_done` is true. A handle is consumed by [`Handle::run`], which is the last to touch
//!    the job: its last access is the store to `done`. A handle that is dropped instead of run would make the owner wait for
//!    ever, which is no memory fault; `lend` gets handles back that nobody took ([`Crew`](super::Crew) pops until all are run).
//! 2. *Nobody touches closure or result at the same time.* Before the handle is made only the owner can name the job. Then the
//!    owner reads nothing but `done` until it is true; the handle is neither `Clone` nor `Copy`, so there is one runner. The
//!    runner's writes happen before its `Release` store of `done`; the owner's `Acquire` load that sees it happens before its
//!    read of the result. The queue's own synchronisation orders the making of the job before the run.
//! 3. *Sending is sound.* The closure is `Send` and its result is `Send` (bounds of [`Job::with_handle`]), so a handle, which is
//!    no more than the right to run the one and leave the other, may go to another thread.
//! 4. *No unwinding through foreign frames.* The closure runs under `catch_unwind`; a panic is the result, and is resumed by the
//!    owner.

#![allow(unsafe_code, reason = "the proof is above")]

use std::cell::UnsafeCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};

/// The closure before it ran, its result after.
enum Cell<F, R> {
    Closure(F),
    Result(std::thread::Result<R>),
    Taken,
}

/// A closure that waits to be run, once.
pub(super) struct Job<F, R> {
    cell: UnsafeCell<Cell<F, R>>,
    done: AtomicBool,
}

/// The right, and the duty, to run a job.
#[derive(Debug)]
pub(super) struct Handle {
    job: *const (),
    run: unsafe fn(*const ()),
}

// SAFETY: point 3 of the proof; handles are made for `Send` closures with `Send` results only.
unsafe impl Send for Handle {}

impl Handle {
    /// Runs the job.
    pub(super) fn run(self) {
        // SAFETY: point 1: the job is alive until `done` is stored, which is the last that `run` does.
        unsafe { (self.run)(self.job) }
    }
}

/// Tells whether a job is done.
#[derive(Debug, Clone, Copy)]
pub(super) struct Done<'a>(&'a AtomicBool);

impl Done<'_> {
    pub(super) fn is_done(self) -> bool {
        self.0.load(Ordering::Acquire)
    }
}

impl<F: FnOnce() -> R + Send, R: Send> Job<F, R> {
    /// Makes a job of `closure`, hands it to `lend`, and gives its result when it is done. `lend` must see to it that the handle
    /// is run by somebody, and should return when it is; what it returns is passed on.
    pub(super) fn with_handle<A>(closure: F, lend: impl FnOnce(Handle, Done<'_>) -> A) -> (A, R) {
        let job =
            Self { cell: UnsafeCell::new(Cell::Closure(closure)), done: AtomicBool::new(false) };
        let handle = Handle { job: (&raw const job).cast(), run: Self::run };
        let lent = catch_unwind(AssertUnwindSafe(|| lend(handle, Done(&job.done))));
        while !Done(&job.done).is_done() {
            std::thread::yield_now();
        }
        // SAFETY: point 2: the runner is through, and the owner is the only one left.
        let result = std::mem::replace(unsafe { &mut *job.cell.get() }, Cell::Taken);
        let lent = lent.unwrap_or_else(|panic| resume_unwind(panic));
        match result {
            Cell::Result(Ok(result)) => (lent, result),
            Cell::Result(Err(panic)) => resume_unwind(panic),
            Cell::Closure(_) | Cell::Taken => unreachable!("a job that is done has its result"),
        }
    }

    /// Runs the closure of a job and leaves its result.
    ///
    /// # Safety
    /// `job` must point to a `Job<F, R>` that lives until `done` is stored, and this must be its only run.
    unsafe fn run(job: *const ()) {
        // SAFETY: the caller's promise; the owner touches nothing but `done` meanwhile (point 2).
        let job = unsafe { &*job.cast::<Self>() };
        // SAFETY: point 2.
        let closure = std::mem::replace(unsafe { &mut *job.cell.get() }, Cell::Taken);
        if let Cell::Closure(closure) = closure {
            let result = catch_unwind(AssertUnwindSafe(closure));
            // SAFETY: point 2.
            unsafe { *job.cell.get() = Cell::Result(result) };
        }
        job.done.store(true, Ordering::Release);
    }
}

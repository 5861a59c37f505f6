//! A closure on the stack of one thread that another thread may run: the only module of this crate with `unsafe`.
//!
//! ```text
//! owner:   Job on its stack -> Handle into a queue ... waits until the job is done ... takes the panic, if any
//! runner:  takes the Handle out of the queue -> runs the closure -> stores a panic -> marks the job done
//! ```
//!
//! # Proof
//!
//! 1. *A handle never outlives its job.* [`Job::with_handle`] is the only way to make one. It gives the handle to `lend`, and
//!    neither returns nor unwinds before `is_done` is true. [`Handle::run`] consumes the handle, and its last access to the job
//!    is the store to `done`. If a handle were dropped instead of run, the owner would wait for ever, which is no memory fault.
//!    `lend` gets back the handles that no thread took ([`ThreadTeam`](super::ThreadTeam) pops until all are run).
//! 2. *No two threads access closure or panic at the same time.* Before the handle is made, only the owner can name the job. Then
//!    the owner reads nothing but `done` until it is true. The handle is neither `Clone` nor `Copy`, so there is one runner. The
//!    runner's writes happen before its `Release` store of `done`. The owner's `Acquire` load that sees the store happens before
//!    its read of the panic. The synchronisation of the queue orders the creation of the job before the run.
//! 3. *Sending is sound.* The closure is `Send` (bound of [`Job::with_handle`]), and so is the payload of a panic. A handle is
//!    only the right to run the closure and to store the payload, so it may go to another thread.
//! 4. *No unwinding through foreign frames.* The closure runs under `catch_unwind`. A panic is stored, and the owner resumes it.
//! 5. *Lifetimes.* A handle does not have the lifetime of the closure's borrows. By point 1 it is run while the owner waits, and
//!    so within that lifetime.
//!
//! The closure is a trait object, so that one function makes the forks of all kinds of work. The virtual call takes less time than
//! the wait of another thread.

#![allow(unsafe_code, reason = "the proof is above")]

use std::any::Any;
use std::cell::UnsafeCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};

/// Closure that a job runs.
type Work<'a> = &'a mut (dyn FnMut() + Send);

/// A closure that waits to be run once.
pub(super) struct Job<'a> {
    work: UnsafeCell<Work<'a>>,
    panic: UnsafeCell<Option<Box<dyn Any + Send>>>,
    done: AtomicBool,
}

/// The right and the duty to run a job.
#[derive(Debug)]
pub(super) struct Handle(*const ());

// SAFETY: point 3 of the proof; handles are made for `Send` closures only.
unsafe impl Send for Handle {}

impl Handle {
    /// Runs the job and marks it as done.
    pub(super) fn run(self) {
        // SAFETY: points 1 and 5: the job is alive until `done` is stored, which is the last action here.
        let job = unsafe { &*self.0.cast::<Job<'_>>() };
        // SAFETY: point 2: until then the owner accesses nothing but `done`, and there is one runner.
        let (work, panic) = unsafe { (&mut *job.work.get(), &mut *job.panic.get()) };
        *panic = catch_unwind(AssertUnwindSafe(work)).err();
        job.done.store(true, Ordering::Release);
    }
}

/// Shows the owner of a job whether it is done.
#[derive(Debug, Clone, Copy)]
pub(super) struct Done<'a>(&'a AtomicBool);

impl Done<'_> {
    pub(super) fn is_done(self) -> bool {
        self.0.load(Ordering::Acquire)
    }
}

impl<'a> Job<'a> {
    /// Makes a job of `work`, passes its handle to `lend`, and returns when the job is done. `lend` must ensure that some thread runs the
    /// handle, and should return after that. Returns the value that `lend` returns. A panic of `work` or of `lend` continues in the caller.
    pub(super) fn with_handle<R>(work: Work<'a>, lend: impl FnOnce(Handle, Done<'_>) -> R) -> R {
        let job = Self {
            work: UnsafeCell::new(work),
            panic: UnsafeCell::new(None),
            done: AtomicBool::new(false),
        };
        let handle = Handle((&raw const job).cast());
        let lent = catch_unwind(AssertUnwindSafe(|| lend(handle, Done(&job.done))));
        while !Done(&job.done).is_done() {
            std::thread::yield_now();
        }
        let lent = lent.unwrap_or_else(|panic| resume_unwind(panic));
        match job.panic.into_inner() {
            Some(panic) => resume_unwind(panic),
            None => lent,
        }
    }
}

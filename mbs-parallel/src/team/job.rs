//! A closure on the stack of one thread that another thread may run: the one place of this crate with `unsafe`.
//!
//! ```text
//! owner:   Job on its stack -> Handle into a queue ... waits until the job is done ... takes the panic, if any
//! runner:  takes the Handle out of the queue -> runs the closure -> stores a panic -> marks the job done
//! ```
//!
//! # Proof
//!
//! 1. *A handle never outlives its job.* [`Job::with_handle`] is the only way to make one. It gives the handle to `lend`, and
//!    does not return (nor unwind) before `is_done` is true. A handle is consumed by [`Handle::run`], which is the last to touch
//!    the job: its last access is the store to `done`. A handle that is dropped instead of run would make the owner wait for
//!    ever, which is no memory fault. `lend` gets handles back that no thread took ([`ThreadTeam`](super::ThreadTeam) pops until all are run).
//! 2. *No two threads touch closure or panic at the same time.* Before the handle is made only the owner can name the job. Then the
//!    owner reads nothing but `done` until it is true; the handle is neither `Clone` nor `Copy`, so there is one runner. The
//!    runner's writes happen before its `Release` store of `done`; the owner's `Acquire` load that sees it happens before its
//!    read of the panic. The queue's own synchronisation orders the making of the job before the run.
//! 3. *Sending is sound.* The closure is `Send` (bound of [`Job::with_handle`]) and so is a panic's payload. A handle, which is
//!    no more than the right to run the one and leave the other, may go to another thread.
//! 4. *No unwinding through foreign frames.* The closure runs under `catch_unwind`; a panic is kept, and is resumed by the
//!    owner.
//! 5. *Lifetimes.* A handle forgets how long the closure may be borrowed; by point 1 it is run while the owner waits, and
//!    so within that time.
//!
//! The closure is dynamic, so that a fork is one function for all the work there is. It is called where another thread waits,
//! which takes longer than a virtual call.

#![allow(unsafe_code, reason = "the proof is above")]

use std::any::Any;
use std::cell::UnsafeCell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};

/// Closure that a job runs.
type Work<'a> = &'a mut (dyn FnMut() + Send);

/// A closure that waits to be run, once.
pub(super) struct Job<'a> {
    work: UnsafeCell<Work<'a>>,
    panic: UnsafeCell<Option<Box<dyn Any + Send>>>,
    done: AtomicBool,
}

/// The right, and the duty, to run a job.
#[derive(Debug)]
pub(super) struct Handle(*const ());

// SAFETY: point 3 of the proof; handles are made for `Send` closures only.
unsafe impl Send for Handle {}

impl Handle {
    /// Runs the job and marks it done.
    pub(super) fn run(self) {
        // SAFETY: points 1 and 5: the job is alive until `done` is stored, which is the last that happens here.
        let job = unsafe { &*self.0.cast::<Job<'_>>() };
        // SAFETY: point 2: the owner touches nothing but `done` meanwhile, and there is one runner.
        let (work, panic) = unsafe { (&mut *job.work.get(), &mut *job.panic.get()) };
        *panic = catch_unwind(AssertUnwindSafe(work)).err();
        job.done.store(true, Ordering::Release);
    }
}

/// Shows whether a job is done.
#[derive(Debug, Clone, Copy)]
pub(super) struct Done<'a>(&'a AtomicBool);

impl Done<'_> {
    pub(super) fn is_done(self) -> bool {
        self.0.load(Ordering::Acquire)
    }
}

impl<'a> Job<'a> {
    /// Makes a job of `work`, hands it to `lend`, and returns when it is done. `lend` must see to it that the handle is run by
    /// somebody, and should return when it is. What it returns is passed on, and so is a panic of either.
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

//! A team with one queue of forks. Threads wait actively for a while, so that another thread starts queued work in less than a microsecond.
//!
//! ```text
//! spare = threads without work - forks in the queue           a fork is made only while spare > 0
//! ```
//!
//! If no other thread waits, a thread does both parts of a fork one after the other. The numbers are then still in its cache, and such a
//! fork costs a nanosecond.

use super::job::{Handle, Job};
use crossbeam_queue::ArrayQueue;
use crossbeam_utils::sync::{Parker, Unparker};
use crossbeam_utils::{Backoff, CachePadded};
use mbs_math::team::Team;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicIsize, AtomicUsize, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Largest number of forks that wait in the queue. If the queue is full, the thread that makes a fork runs both parts. Chosen, not tuned.
const PLACES: usize = 1024;
/// Time for which a thread without work waits actively. It is longer than the time between two steps.
const AWAKE: Duration = Duration::from_micros(200);
/// Longest sleep of a thread. No result depends on when it wakes up, because a thread that forks also does the work itself.
const ASLEEP: Duration = Duration::from_millis(20);

/// The caller's thread and others that help it, until the last clone is dropped.
///
/// A thread team suits steps that follow one another closely, because its threads use processor time while they wait actively. For
/// occasional work use [`Pool`](super::Pool).
#[derive(Debug, Clone)]
pub struct ThreadTeam {
    shared: Arc<Shared>,
    hands: Arc<Hands>,
}

/// State that all threads of a team use.
#[derive(Debug)]
struct Shared {
    forks: ArrayQueue<Handle>,
    is_over: AtomicBool,
    /// Threads without work minus forks in the queue. The number stays the same when an idle thread takes a fork.
    spare: CachePadded<AtomicIsize>,
    n_asleep: CachePadded<AtomicUsize>,
}

/// Threads that help the caller, and the handles that wake them.
#[derive(Debug)]
struct Hands {
    shared: Arc<Shared>,
    threads: Vec<JoinHandle<()>>,
    wakers: Vec<Unparker>,
}

impl ThreadTeam {
    /// Starts a team of the caller and `n` - 1 more threads.
    ///
    /// # Errors
    /// When the operating system gives no threads.
    pub fn new(n: usize) -> std::io::Result<Self> {
        let shared = Arc::new(Shared {
            forks: ArrayQueue::new(PLACES),
            is_over: AtomicBool::new(false),
            spare: CachePadded::new(AtomicIsize::new(0)),
            n_asleep: CachePadded::new(AtomicUsize::new(0)),
        });
        let mut hands = Hands { shared: shared.clone(), threads: Vec::new(), wakers: Vec::new() };
        for k in 1..n {
            let parker = Parker::new();
            let (unparker, shared) = (parker.unparker().clone(), shared.clone());
            let name = format!("mbs team {k}");
            let thread =
                std::thread::Builder::new().name(name).spawn(move || help(&shared, &parker))?;
            hands.wakers.push(unparker);
            hands.threads.push(thread);
        }
        Ok(Self { shared, hands: Arc::new(hands) })
    }
}

impl Drop for Hands {
    fn drop(&mut self) {
        self.shared.is_over.store(true, Ordering::Release);
        self.wakers.iter().for_each(Unparker::unpark);
        for thread in self.threads.drain(..) {
            // Jobs catch their panics, so the thread cannot have panicked.
            let _ = thread.join();
        }
    }
}

impl Shared {
    /// Runs a fork of the queue, if there is one, for a thread that has no other work.
    fn run_one(&self) -> bool {
        let Some(fork) = self.forks.pop() else { return false };
        fork.run();
        self.spare.fetch_add(1, Ordering::Relaxed);
        true
    }
}

/// Body of a helping thread: runs forks until the team is dropped.
fn help(shared: &Shared, parker: &Parker) {
    let mut idle_since = None;
    shared.spare.fetch_add(1, Ordering::Relaxed);
    while !shared.is_over.load(Ordering::Acquire) {
        // The queue is checked a hundred times for each reading of the clock.
        for _ in 0..100 {
            if shared.run_one() {
                idle_since = None;
            } else {
                std::hint::spin_loop();
            }
        }
        let since = *idle_since.get_or_insert_with(Instant::now);
        if since.elapsed() > AWAKE {
            shared.n_asleep.fetch_add(1, Ordering::SeqCst);
            if shared.forks.is_empty() {
                parker.park_timeout(ASLEEP);
            }
            shared.n_asleep.fetch_sub(1, Ordering::SeqCst);
            idle_since = None;
        }
    }
}

impl Team for ThreadTeam {
    #[inline]
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        let (mut a, mut b) = (Piece::Waits(a), Piece::Waits(b));
        if self.shared.spare.load(Ordering::Relaxed) > 0 {
            self.fork(&mut || a.run(), &mut || b.run());
        } else {
            a.run();
            b.run();
        }
        match (a, b) {
            (Piece::Done(a), Piece::Done(b)) => (a, b),
            _ => unreachable!("both have been run when the fork returns"),
        }
    }

    fn size(&self) -> usize {
        self.hands.threads.len() + 1
    }
}

/// A part of the work before it is run, then its result. The type has little code, because each kind of work has a copy of it.
enum Piece<F, R> {
    Waits(F),
    Runs,
    Done(R),
}

impl<R, F: FnOnce() -> R> Piece<F, R> {
    #[inline]
    fn run(&mut self) {
        if let Self::Waits(work) = std::mem::replace(self, Self::Runs) {
            *self = Self::Done(work());
        }
    }
}

impl ThreadTeam {
    /// Puts `b` into the queue and runs `a`. Both have been run when it returns.
    #[inline(never)]
    fn fork(&self, a: &mut (dyn FnMut() + Send), b: &mut (dyn FnMut() + Send)) {
        let shared = &*self.shared;
        Job::with_handle(b, |handle, done| {
            if let Err(handle) = shared.forks.push(handle) {
                handle.run();
                return a();
            }
            shared.spare.fetch_sub(1, Ordering::Relaxed);
            if shared.n_asleep.load(Ordering::SeqCst) > 0 {
                self.hands.wakers.iter().for_each(Unparker::unpark);
            }
            // The queued work must be run even if `a` panics.
            let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(a));
            if !done.is_done() {
                // From here on this thread also has no work.
                shared.spare.fetch_add(1, Ordering::Relaxed);
                let backoff = Backoff::new();
                while !done.is_done() {
                    if shared.run_one() {
                        continue;
                    }
                    // Another thread runs the queued work.
                    if backoff.is_completed() { std::thread::yield_now() } else { backoff.snooze() }
                }
                shared.spare.fetch_sub(1, Ordering::Relaxed);
            }
            if let Err(panic) = result {
                std::panic::resume_unwind(panic);
            }
        })
    }
}

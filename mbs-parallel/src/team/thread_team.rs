//! A team with one queue of forks: threads wait awake for a while, so that work changes hands in less than a microsecond.
//!
//! ```text
//! spare = threads without work - forks in the queue           a fork is made only while spare > 0
//! ```
//!
//! Two pieces of work are done one after the other by the thread that has them, unless another one waits. So a thread stays
//! with the numbers that it has in its cache, and a fork that no thread takes costs a nanosecond.

use super::job::{Handle, Job};
use crossbeam_queue::ArrayQueue;
use crossbeam_utils::sync::{Parker, Unparker};
use crossbeam_utils::{Backoff, CachePadded};
use mbs_math::team::Team;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicIsize, AtomicUsize, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Most forks that wait at the same time; a fork that finds no place is run by the one that made it. Chosen, not tuned.
const PLACES: usize = 1024;
/// Time for which a thread without work stays awake: longer than the time between two steps.
const AWAKE: Duration = Duration::from_micros(200);
/// Longest sleep of a thread. No result depends on its waking up: a thread that forks works too.
const ASLEEP: Duration = Duration::from_millis(20);

/// The caller's thread and others that help it, until the last clone is dropped.
///
/// Meant for steps that follow one another closely: threads burn time while they wait awake. For work that comes now and then
/// take [`Pool`](super::Pool).
#[derive(Debug, Clone)]
pub struct ThreadTeam {
    shared: Arc<Shared>,
    hands: Arc<Hands>,
}

/// State that all threads of a thread team share.
#[derive(Debug)]
struct Shared {
    forks: ArrayQueue<Handle>,
    is_over: AtomicBool,
    /// Threads without work less forks in the queue: a fork that an idle thread takes changes nothing.
    spare: CachePadded<AtomicIsize>,
    n_asleep: CachePadded<AtomicUsize>,
}

/// Threads that help the caller, and what wakes them.
#[derive(Debug)]
struct Hands {
    shared: Arc<Shared>,
    threads: Vec<JoinHandle<()>>,
    wakers: Vec<Unparker>,
}

impl ThreadTeam {
    /// The caller and `n` - 1 threads more.
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
            // Jobs catch their panics, so a thread has none of its own to report.
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

/// The life of a thread that helps.
fn help(shared: &Shared, parker: &Parker) {
    let mut idle_since = None;
    shared.spare.fetch_add(1, Ordering::Relaxed);
    while !shared.is_over.load(Ordering::Acquire) {
        // A hundred looks at the queue for one at the clock.
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

/// A piece of work, and its result once it has been run: small code, since there is a copy for each kind of work.
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
    /// Puts `b` into the queue and runs `a`; both have been run when it returns.
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
            // What waits must be run even if `a` panics.
            let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(a));
            if !done.is_done() {
                // Now this thread has no work either.
                shared.spare.fetch_add(1, Ordering::Relaxed);
                let backoff = Backoff::new();
                while !done.is_done() {
                    if shared.run_one() {
                        continue;
                    }
                    // Another thread runs it.
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

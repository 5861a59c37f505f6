//! A team with one queue of forks: threads wait awake for a while, so that work changes hands in less than a microsecond.

use super::job::{Handle, Job};
use crossbeam_queue::ArrayQueue;
use crossbeam_utils::sync::{Parker, Unparker};
use crossbeam_utils::{Backoff, CachePadded};
use mbs_core::team::Team;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Forks that may wait at the same time; a fork that finds no place is run by the one that made it.
const PLACES: usize = 1024;
/// How long a thread without work stays awake: longer than what lies between two steps.
const AWAKE: Duration = Duration::from_micros(200);
/// How long it sleeps at most. Nobody depends on its waking up: who forks works too.
const ASLEEP: Duration = Duration::from_millis(20);

/// The caller's thread and others that help it, until the last clone is dropped.
///
/// Meant for steps that follow one another closely: threads burn time while they wait awake. For work that comes now and then
/// take [`Pool`](super::Pool).
#[derive(Debug, Clone)]
pub struct Crew {
    shared: Arc<Shared>,
    hands: Arc<Hands>,
}

/// What all threads of a crew see.
#[derive(Debug)]
struct Shared {
    forks: ArrayQueue<Handle>,
    is_over: AtomicBool,
    n_asleep: CachePadded<AtomicUsize>,
}

/// The other threads.
#[derive(Debug)]
struct Hands {
    shared: Arc<Shared>,
    threads: Vec<JoinHandle<()>>,
    wakers: Vec<Unparker>,
}

impl Crew {
    /// The caller and `n` - 1 threads more.
    ///
    /// # Errors
    /// When the operating system gives no threads.
    pub fn new(n: usize) -> std::io::Result<Self> {
        let shared = Arc::new(Shared {
            forks: ArrayQueue::new(PLACES),
            is_over: AtomicBool::new(false),
            n_asleep: CachePadded::new(AtomicUsize::new(0)),
        });
        let mut hands = Hands { shared: shared.clone(), threads: Vec::new(), wakers: Vec::new() };
        for k in 1..n {
            let parker = Parker::new();
            let (unparker, shared) = (parker.unparker().clone(), shared.clone());
            let name = format!("mbs crew {k}");
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
            // Jobs catch their panics, so a thread has none of its own to tell.
            let _ = thread.join();
        }
    }
}

/// The life of a thread that helps.
fn help(shared: &Shared, parker: &Parker) {
    let mut idle_since = None;
    while !shared.is_over.load(Ordering::Acquire) {
        let backoff = Backoff::new();
        // A hundred looks at the queue for one at the clock.
        for _ in 0..100 {
            if let Some(fork) = shared.forks.pop() {
                fork.run();
                idle_since = None;
            } else if backoff.is_completed() {
                std::hint::spin_loop();
            } else {
                backoff.spin();
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

impl Team for Crew {
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        Job::with_handle(b, |handle, done| {
            if let Err(handle) = self.shared.forks.push(handle) {
                handle.run();
                return a();
            }
            if self.shared.n_asleep.load(Ordering::SeqCst) > 0 {
                self.hands.wakers.iter().for_each(Unparker::unpark);
            }
            // What waits must be run even if `a` panics.
            let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(a));
            let backoff = Backoff::new();
            while !done.is_done() {
                match self.shared.forks.pop() {
                    Some(fork) => fork.run(),
                    // Another thread runs it.
                    None if backoff.is_completed() => std::thread::yield_now(),
                    None => backoff.snooze(),
                }
            }
            result.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        })
    }

    fn size(&self) -> usize {
        self.hands.threads.len() + 1
    }
}

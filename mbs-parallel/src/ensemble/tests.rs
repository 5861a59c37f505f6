//! Tests of an ensemble: order of jobs, panics, early ends and counts.

use super::*;
use std::collections::BTreeMap;
use std::thread::{ThreadId, current};

/// Numbers of threads that the tests use.
const THREADS: [usize; 4] = [1, 2, 3, 8];

fn ensemble(threads: usize) -> Ensemble {
    Ensemble::new(NonZeroUsize::new(threads)).expect("a few threads can be started")
}

fn all<R: Send>(
    threads: usize,
    jobs: &[usize],
    job: impl Fn(usize) -> R + Sync,
) -> BTreeMap<usize, Result<R, Panicked>> {
    let mut results = BTreeMap::new();
    ensemble(threads).run(jobs, job, |i, result| {
        assert!(results.insert(i, result).is_none(), "job {i} came twice");
        ControlFlow::Continue(())
    });
    results
}

#[test]
fn every_job_comes_once_whatever_the_threads() {
    let jobs: Vec<usize> = (0..1000).rev().collect();
    for threads in THREADS {
        let results = all(threads, &jobs, |i| i * i);
        assert_eq!(results.len(), jobs.len());
        assert!(results.iter().all(|(i, result)| *result == Ok(i * i)));
    }
}

#[test]
fn no_job_is_no_call() {
    assert!(all(2, &[], |_| unreachable!("there is no job")).is_empty());
}

#[test]
fn a_panic_is_the_result_of_its_own_job_alone() {
    for threads in THREADS {
        let results = all(threads, &[3, 4, 5, 6], |i| {
            assert!(i != 4, "job {i} is broken");
            i
        });
        assert_eq!(results[&4].as_ref().map_err(Panicked::message), Err("job 4 is broken"));
        assert_eq!(results.values().filter(|result| result.is_ok()).count(), 3);
    }
}

#[test]
fn a_sink_that_breaks_ends_the_ensemble() {
    for threads in THREADS {
        let mut seen = 0;
        ensemble(threads).run(
            &(0..10_000).collect::<Vec<_>>(),
            |_| (),
            |_, _| {
                seen += 1;
                if seen == 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
        );
        assert_eq!(seen, 5);
    }
}

#[test]
fn jobs_begin_in_order_on_one_thread_and_the_sink_stays_with_the_caller() {
    let caller = current().id();
    let mut order = Vec::new();
    ensemble(1).run(
        &[2, 0, 1],
        |_| current().id(),
        |i, id: Result<ThreadId, _>| {
            assert_ne!(id, Ok(caller), "one thread takes the same path as many");
            assert_eq!(current().id(), caller);
            order.push(i);
            ControlFlow::Continue(())
        },
    );
    assert_eq!(order, [2, 0, 1]);
}

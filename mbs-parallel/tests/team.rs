//! Tests of teams: every piece of work is done once, panics reach the caller, and no work remains.

use mbs_math::team::{self, Alone, Team};
use mbs_parallel::{Pool, ThreadTeam, Threads};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};

/// A team of any kind.
#[derive(Debug)]
enum Any {
    Threads(Threads),
    Pool(Pool),
}

impl Team for Any {
    fn join<A: Send, B: Send>(
        &self,
        a: impl FnOnce() -> A + Send,
        b: impl FnOnce() -> B + Send,
    ) -> (A, B) {
        match self {
            Self::Threads(threads) => threads.join(a, b),
            Self::Pool(pool) => pool.join(a, b),
        }
    }
    fn size(&self) -> usize {
        match self {
            Self::Threads(threads) => threads.size(),
            Self::Pool(pool) => pool.size(),
        }
    }
}

fn teams() -> Vec<Any> {
    let teams = [2, 3, 8].map(|n| Threads::ThreadTeam(ThreadTeam::new(n).expect("threads")));
    let threads = [Threads::One].into_iter().chain(teams);
    let mut teams: Vec<Any> = threads.map(Any::Threads).collect();
    // The race detector of `cargo xtask races` does not see rayon's locks, which are in the standard library.
    if option_env!("MBS_SANITIZED").is_none() {
        teams.extend([1, 2, 3].map(|n| Any::Pool(Pool::new(n).expect("threads"))));
    }
    teams
}

/// Runs a binary tree of forks with `level` levels. Counts the leaves and returns the sum of their numbers.
fn forks(team: &impl Team, level: u32, number: u64, leaves: &AtomicUsize) -> u64 {
    if level == 0 {
        leaves.fetch_add(1, Ordering::Relaxed);
        return number;
    }
    let (a, b) = team.join(
        || forks(team, level - 1, 2 * number, leaves),
        || forks(team, level - 1, 2 * number + 1, leaves),
    );
    a + b
}

#[test]
fn every_leaf_of_nested_forks_is_run_once() {
    // There are more forks than the queue of a thread team can hold. Leaves have the numbers 2^12 .. 2^13.
    for team in teams() {
        for _ in 0..20 {
            let leaves = AtomicUsize::new(0);
            let sum = forks(&team, 12, 1, &leaves);
            assert_eq!(leaves.into_inner(), 4096, "{team:?}");
            assert_eq!(sum, (4096..8192).sum::<u64>(), "{team:?}");
        }
    }
}

#[test]
fn the_two_sides_of_a_fork_may_borrow_and_give_values() {
    for team in teams() {
        let mut numbers = vec![1_u64; 1000];
        let (left, right) = numbers.split_at_mut(300);
        let (a, b) = team.join(
            || {
                left.fill(2);
                left.iter().sum::<u64>()
            },
            || {
                right.fill(3);
                format!("{}", right.len())
            },
        );
        assert_eq!((a, b.as_str()), (600, "700"));
        assert_eq!(numbers.iter().sum::<u64>(), 600 + 2100);
    }
}

#[test]
fn a_panic_on_either_side_reaches_the_caller_and_the_team_works_on() {
    for team in teams() {
        for side in [0, 1, 2] {
            let done = AtomicUsize::new(0);
            let act = |me: usize| {
                if side == me || side == 2 {
                    panic!("on purpose");
                }
                done.fetch_add(1, Ordering::Relaxed);
            };
            let result = catch_unwind(AssertUnwindSafe(|| team.join(|| act(0), || act(1))));
            assert!(result.is_err(), "{team:?}");
            // If one side of a fork panics, the other side may or may not have begun. It must not run after `join` has returned.
            let before = done.load(Ordering::Relaxed);
            let leaves = AtomicUsize::new(0);
            assert_eq!(forks(&team, 6, 1, &leaves), (64..128).sum::<u64>());
            assert_eq!(done.load(Ordering::Relaxed), before);
        }
    }
}

#[test]
fn values_of_a_fork_are_dropped_once() {
    struct Counted<'a>(&'a AtomicUsize);
    impl Drop for Counted<'_> {
        fn drop(&mut self) {
            self.0.fetch_add(1, Ordering::Relaxed);
        }
    }
    for team in teams() {
        let drops = AtomicUsize::new(0);
        let (captured, in_panic) = (Counted(&drops), Counted(&drops));
        let (a, b) = team.join(
            || Counted(&drops),
            || {
                let _captured = captured;
                Counted(&drops)
            },
        );
        assert_eq!(drops.load(Ordering::Relaxed), 1, "{team:?}");
        drop((a, b));
        let result = catch_unwind(AssertUnwindSafe(|| {
            team.join(
                || (),
                || {
                    let _in_panic = in_panic;
                    panic!("on purpose");
                },
            )
        }));
        assert!(result.is_err());
        assert_eq!(drops.load(Ordering::Relaxed), 4, "{team:?}");
    }
}

#[test]
fn a_crew_may_be_called_by_several_threads_and_dropped_by_any() {
    let shared = ThreadTeam::new(3).expect("threads");
    std::thread::scope(|scope| {
        for _ in 0..4 {
            let team = Threads::ThreadTeam(shared.clone());
            scope.spawn(move || {
                let leaves = AtomicUsize::new(0);
                for _ in 0..50 {
                    assert_eq!(forks(&team, 8, 1, &leaves), (256..512).sum::<u64>());
                }
            });
        }
    });
    drop(shared);
}

#[test]
fn a_crew_that_fell_asleep_works_on() {
    let team = Threads::ThreadTeam(ThreadTeam::new(3).expect("threads"));
    for _ in 0..3 {
        std::thread::sleep(std::time::Duration::from_millis(40));
        let leaves = AtomicUsize::new(0);
        assert_eq!(forks(&team, 8, 1, &leaves), (256..512).sum::<u64>());
    }
}

#[test]
fn vectors_and_sums_have_the_bits_of_one_thread() {
    let x: Vec<f64> = (0..100_003).map(|i| f64::from(i).sin() * 1e3).collect();
    let dot = |team: &Any| {
        team::sum(team, x.len(), |from, to| x[from..to].iter().fold(0.0, |sum, x| sum + x * x))
    };
    let expected = dot(&Any::Threads(Threads::One));
    // The tolerance for the difference from the sum in order covers rounding errors of 1e5 additions of values up to 1e6.
    let plain: f64 = x.iter().map(|x| x * x).sum();
    assert!((expected - plain).abs() < 1e-12 * plain);
    for team in teams() {
        assert_eq!(dot(&team).to_bits(), expected.to_bits(), "{team:?}");
        let largest = team::norm_inf(&team, &x);
        assert_eq!(largest.to_bits(), team::norm_inf(&Alone, &x).to_bits());
        let (mut y, mut z) = (x.clone(), vec![0.0; x.len()]);
        team::on_stretches(&team, [&mut y, &mut z], |first, [y, z]| {
            for (k, (y, z)) in y.iter_mut().zip(z).enumerate() {
                *y += x[first + k];
                *z = *y;
            }
        });
        assert!(y.iter().zip(&x).all(|(y, x)| y.to_bits() == (x + x).to_bits()), "{team:?}");
        assert!(y.iter().zip(&z).all(|(y, z)| y.to_bits() == z.to_bits()), "{team:?}");
    }
    let mut broken = x;
    broken[70_000] = f64::NAN;
    for team in teams() {
        assert!(!team::norm_inf(&team, &broken).is_finite(), "{team:?}");
    }
}

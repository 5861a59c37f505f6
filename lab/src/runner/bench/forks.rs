//! The time of a fork: a thread team joins two empty pieces of work.

use crate::bench::race::{Runner, Timing, Work, race, timed};
use crate::bench::request::{Request, merge, say};
use mbs_core::team::{Alone, Team};
use mbs_parallel::{Pool, ThreadTeam};
use serde_json::json;

/// A team inside a pool, where the whole measurement is made.
struct Inside<'a>(&'a Pool);

impl Runner for Inside<'_> {
    fn run(&mut self, n: u32) -> Result<f64, String> {
        let forks = || {
            (0..n).for_each(|_| fork(self.0));
            Ok(())
        };
        self.0.enter(|| timed(forks))
    }
}

/// Joins two empty pieces of work.
fn fork(team: &impl Team) {
    let both = team.join(|| std::hint::black_box(1), || std::hint::black_box(2));
    std::hint::black_box(both);
}

/// Measures a fork without a team, and with both kinds of team of each size.
pub(crate) fn measure(request: &Request) -> Result<(), String> {
    let mut sizes = request.threads.clone();
    sizes.retain(|&n| n > 1);
    print_lines("alone", 1, race(&mut [&mut Work(|| fork(&Alone))], request.seconds));
    for n in sizes {
        let crew = ThreadTeam::new(n).map_err(|e| format!("no {n} threads: {e}"))?;
        print_lines("crew", n, race(&mut [&mut Work(|| fork(&crew))], request.seconds));
        drop(crew);
        let pool = Pool::new(n).map_err(|e| format!("no {n} threads: {e}"))?;
        print_lines("pool", n, race(&mut [&mut Inside(&pool)], request.seconds));
    }
    Ok(())
}

fn print_lines(team: &str, threads: usize, timings: Vec<Result<Timing, String>>) {
    for timing in timings.into_iter().flatten() {
        let mut line = json!({ "kind": "fork", "team": team, "threads": threads });
        merge(&mut line, [timing.json()]);
        say(&line);
    }
}

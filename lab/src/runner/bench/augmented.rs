//! Measurements of the augmented Lagrangian formulations: counts, orders of elimination, phases of a step, and speedup by thread teams.

use crate::bench::clocked::Clock;
#[cfg(feature = "faer")]
use crate::bench::faer_beside;
use crate::bench::lane::{Lane, Method};
use crate::bench::race::{Runner, race};
use crate::bench::request::{Request, merge, say};
use crate::bench::scenes::Prepared;
use mbs_parallel::{Pool, ThreadTeam};
use mbs_sparse::{Counters, Multifrontal, Options, Ordering};
use serde_json::{Value, json};

/// Least number of elements of a chain for which different levels of cuts are measured. Chosen, not tuned.
const MANY: usize = 5000;
/// Levels of cuts that are measured for such a chain.
const LEVELS: [u32; 4] = [1, 2, 4, 8];

/// Measures one of the formulations. For index-3 it also measures counts and faer.
pub(crate) fn measure<const D: usize>(
    prepared: &Prepared<D>,
    formulation: &str,
    request: &Request,
) -> Result<(), String> {
    let analyse = |ordering| {
        let options = Options { ordering, ..Options::default() };
        Multifrontal::<f64>::analyse(&prepared.model, options)
    };
    let least = analyse(Ordering::MinimumDegree);
    let chosen = analyse(Ordering::Chosen);
    let is_first = formulation == "index-3";
    let mut cuts = Vec::new();
    if is_first {
        say(&order("minimum-degree", &least.counters()));
        say(&order("chosen", &chosen.counters()));
        #[cfg(feature = "faer")]
        faer_beside::measure(prepared, &least, request);
        if prepared.scene.joints.len() >= MANY {
            cuts.extend(
                LEVELS.map(|k| (format!("dissection-{k}"), analyse(Ordering::Dissection(k)))),
            );
        }
    }
    for (name, solver) in &cuts {
        say(&order(name, &solver.counters()));
    }
    let several: Vec<usize> = request.threads.iter().copied().filter(|&n| n > 1).collect();
    let crews = teams(&several, ThreadTeam::new)?;
    let pools = teams(&several, Pool::new)?;
    let clocks: Vec<Clock> = (0..=several.len()).map(|_| Clock::new()).collect();
    let clock = |i: usize| is_first.then(|| &clocks[i]);

    let Some(method) = Method::named(formulation) else { return Ok(()) };
    let alone = |solver: &Multifrontal<f64>, order: &str, clock| {
        Lane::alone(prepared, method, solver.clone(), (order, clock))
    };
    let mut lanes = vec![alone(&least, "minimum-degree", None)];
    if is_first {
        lanes.push(alone(&least, "minimum-degree", clock(0)));
        lanes.push(alone(&chosen, "chosen", None));
    }
    lanes.extend(cuts.iter().map(|(name, solver)| alone(solver, name, None)));
    for (i, (crew, pool)) in crews.iter().zip(&pools).enumerate() {
        let solver = || chosen.clone();
        lanes.push(Lane::shared(prepared, method, solver(), (crew, None)));
        if is_first {
            lanes.push(Lane::shared(prepared, method, solver(), (crew, clock(i + 1))));
        }
        lanes.push(Lane::shared(prepared, method, solver(), (pool, None)));
    }
    run(formulation, &mut lanes, request.seconds);
    Ok(())
}

/// Thread teams of the given sizes.
fn teams<W>(sizes: &[usize], new: impl Fn(usize) -> std::io::Result<W>) -> Result<Vec<W>, String> {
    sizes.iter().map(|&n| new(n).map_err(|e| format!("no {n} threads: {e}"))).collect()
}

/// Times the lanes interleaved, and prints a line for each.
fn run(formulation: &str, lanes: &mut [Lane<'_>], seconds: f64) {
    let mut runners: Vec<&mut dyn Runner> =
        lanes.iter_mut().map(|lane| lane as &mut dyn Runner).collect();
    let timings = race(&mut runners, seconds);
    for (lane, timing) in lanes.iter().zip(timings) {
        let name = &lane.name;
        let mut line = json!({
            "kind": "lane", "formulation": formulation, "team": name.team, "threads": name.threads,
            "order": name.order, "clocked": lane.clock.is_some(),
        });
        match timing {
            Ok(timing) => merge(&mut line, [timing.json(), json!({ "work": lane.sums.json() })]),
            Err(why) => merge(&mut line, [json!({ "reason": why })]),
        }
        if let Some(clock) = lane.clock {
            merge(&mut line, [clock.json(lane.sums.steps)]);
        }
        say(&line);
    }
}

/// Counts of an order of elimination.
fn order(name: &str, c: &Counters) -> Value {
    json!({
        "kind": "order", "order": name, "unknowns": c.n, "elements": c.n_elements, "fronts": c.n_fronts,
        "largest_front": c.largest_front, "flops": c.flops, "entries": c.nonzeros, "stored": c.stored,
        "tasks": c.n_tasks, "parallelism": c.parallelism,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_lane_steps_and_counts_alike() {
        let scene = crate::bench::scenes::tests::chain(12);
        let prepared = Prepared::<3>::new(scene).unwrap();
        let solver = Multifrontal::<f64>::analyse(&prepared.model, Options::default());
        let (crew, pool, clock) =
            (ThreadTeam::new(2).unwrap(), Pool::new(2).unwrap(), Clock::new());
        let method = Method::Three;
        let mut lanes = [
            Lane::alone(&prepared, method, solver.clone(), ("chosen", Some(&clock))),
            Lane::shared(&prepared, method, solver.clone(), (&crew, None)),
            Lane::shared(&prepared, method, solver.clone(), (&pool, None)),
        ];
        for lane in &mut lanes {
            lane.run(3).unwrap();
        }
        assert_eq!(lanes[0].sums.steps, 3);
        assert!(lanes.iter().all(|lane| lane.sums == lanes[0].sums));
        let line = clock.json(3);
        assert!(line["after_evaluation"].as_f64().unwrap() < line["step"].as_f64().unwrap());
    }
}

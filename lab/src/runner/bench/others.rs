//! Measurements of formulations with the steps of `mbs run`. The classical formulation is measured alone and with a thread team,
//! interleaved. Formulations without teams have one row each.

use crate::bench::lane::Sums;
use crate::bench::race::{Runner, Timing, race, timed};
use crate::bench::request::{Request, merge, say};
use crate::bench::scenes::steps;
use mbs::typed::Simulation;
use mbs::{FormulationKind, Method, ResolvedMethod};
use mbs_core::scene::Scene;
use serde_json::{Value, json};

/// Duration of the longest step that is measured more than once [s]. Chosen, not tuned.
const LONGEST: f64 = 2.0;

/// A simulation that is stepped, and its counts.
struct Steps<const D: usize> {
    simulation: Simulation<f64, D>,
    dt: f64,
    sums: Sums,
}

impl<const D: usize> Runner for Steps<D> {
    fn run(&mut self, n: u32) -> Result<f64, String> {
        timed(|| {
            for _ in 0..n {
                let step = self.simulation.advance(self.dt);
                let step = step.map_err(|e| self.simulation.explain(e).to_string())?;
                self.sums.add(&step.attempt.report);
            }
            Ok(())
        })
    }

    fn reset(&mut self) {
        self.sums = Sums::default();
    }
}

/// Measures a scene in one formulation, or prints why this is not possible.
pub(crate) fn measure<const D: usize>(
    scene: &Scene<f64>,
    formulation: &str,
    request: &Request,
) -> Result<(), String> {
    let print_line = |threads: usize, figures: [Value; 2]| {
        let team = if threads == 1 { "alone" } else { "crew" };
        let mut line = json!({
            "kind": "lane", "own": false, "formulation": formulation, "team": team, "threads": threads, "order": "chosen",
            "clocked": false,
        });
        merge(&mut line, figures);
        say(&line);
    };
    let (lanes, timings) = match raced::<D>(scene, formulation, request) {
        Ok(raced) => raced,
        Err(why) => {
            print_line(1, [json!({ "reason": why }), json!({})]);
            return Ok(());
        }
    };
    for ((threads, lane), timing) in lanes.iter().zip(timings) {
        print_line(
            *threads,
            match timing {
                Ok(timing) => [timing.json(), json!({ "work": lane.sums.json() })],
                Err(why) => [json!({ "reason": why }), json!({})],
            },
        );
    }
    Ok(())
}

/// Simulations with their numbers of threads, and their times.
type Raced<const D: usize> = (Vec<(usize, Steps<D>)>, Vec<Result<Timing, String>>);

fn raced<const D: usize>(
    scene: &Scene<f64>,
    formulation: &str,
    request: &Request,
) -> Result<Raced<D>, String> {
    let (dt, _) = steps(scene);
    let simulated = |threads: usize| {
        let asked = Method {
            formulation: Some(formulation.to_owned()),
            threads: Some(threads),
            ..Method::default()
        };
        let settings = ResolvedMethod::new(scene, &asked).map_err(|e| e.to_string())?;
        let simulation = Simulation::<f64, D>::new(scene, &settings).map_err(|e| e.to_string())?;
        Ok::<_, String>((threads, Steps { simulation, dt, sums: Sums::default() }))
    };
    let mut lanes = vec![simulated(1)?];
    let pilot = lanes[0].1.run(1)?;
    if pilot > LONGEST {
        return Err(format!("one step takes {pilot:.1} s: not measured further"));
    }
    if FormulationKind::of_name(formulation).is_some_and(|f| f.row().threads) {
        for &threads in request.threads.iter().filter(|&&n| n > 1) {
            lanes.push(simulated(threads)?);
        }
    }
    let mut runners: Vec<&mut dyn Runner> =
        lanes.iter_mut().map(|(_, lane)| lane as &mut dyn Runner).collect();
    let timings = race(&mut runners, request.seconds);
    Ok((lanes, timings))
}

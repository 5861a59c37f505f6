//! The formulations that have no team: one row each, as `mbs run` steps them.

use crate::augmented::merge;
use crate::lane::Sums;
use crate::race::{Runner, Timing, race, timed};
use crate::scenes::steps;
use crate::{Request, say};
use mbs::{InSpace, Overrides, Plane, Settings, Simulation};
use mbs_core::scene::Scene;
use serde_json::json;

/// A step that takes longer is not measured further [s].
const LONGEST: f64 = 2.0;

/// A simulation that is stepped, and its counts.
struct Steps<const D: usize>
where
    Plane<D>: InSpace<f64>,
{
    simulation: Simulation<f64, D>,
    dt: f64,
    sums: Sums,
}

impl<const D: usize> Runner for Steps<D>
where
    Plane<D>: InSpace<f64>,
{
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

/// Measures a scene in one formulation, or tells why not.
pub(crate) fn measure<const D: usize>(
    scene: &Scene<f64>,
    formulation: &str,
    request: &Request,
) -> Result<(), String>
where
    Plane<D>: InSpace<f64>,
{
    let mut line = json!({
        "kind": "lane", "formulation": formulation, "team": "alone", "threads": 1, "order": "chosen",
        "clocked": false,
    });
    let told = match raced::<D>(scene, formulation, request) {
        Ok((timing, sums)) => [timing.told(), json!({ "work": sums.told() })],
        Err(why) => [json!({ "reason": why }), json!({})],
    };
    merge(&mut line, told);
    say(&line);
    Ok(())
}

fn raced<const D: usize>(
    scene: &Scene<f64>,
    formulation: &str,
    request: &Request,
) -> Result<(Timing, Sums), String>
where
    Plane<D>: InSpace<f64>,
{
    let asked = Overrides { formulation: Some(formulation.to_owned()), ..Overrides::default() };
    let settings = Settings::new(scene, &asked).map_err(|e| e.to_string())?;
    let simulation = Simulation::<f64, D>::new(scene, &settings).map_err(|e| e.to_string())?;
    let (dt, _) = steps(scene);
    let mut steps = Steps { simulation, dt, sums: Sums::default() };
    let pilot = steps.run(1)?;
    if pilot > LONGEST {
        return Err(format!("one step takes {pilot:.1} s: not measured further"));
    }
    let mut timings = race(&mut [&mut steps], request.seconds);
    let timing = timings.pop().unwrap_or_else(|| Err("not measured".to_owned()))?;
    Ok((timing, steps.sums))
}

//! Measurements of the runner, read from the lines that it prints.

use super::machine::Machine;
use serde_json::Value;

/// All measurements of one run of the job.
#[derive(Debug, Clone)]
pub(crate) struct Measured {
    pub(crate) machine: Machine,
    /// Sizes of thread teams; size one is always among them.
    pub(crate) threads: Vec<usize>,
    /// All formulations, in the order of the tables.
    pub(crate) formulations: Vec<String>,
    /// Lines on empty forks.
    pub(crate) forks: Vec<Value>,
    pub(crate) scenes: Vec<Scene>,
}

/// A scene with all its lanes.
#[derive(Debug, Clone)]
pub(crate) struct Scene {
    pub(crate) name: String,
    /// Line with the sizes of the scene.
    pub(crate) sizes: Value,
    /// Lines on orders of elimination, with their counts.
    pub(crate) orders: Vec<Value>,
    /// Lines that compare faer with our solver, at the start and after some steps.
    pub(crate) faer: Vec<Value>,
    pub(crate) lanes: Vec<Lane>,
}

/// Measurement of a scene by one combination of formulation, team and order of elimination.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Lane {
    pub(crate) formulation: String,
    /// Name of the team: `alone`, `crew` or `pool`.
    pub(crate) team: String,
    pub(crate) threads: usize,
    pub(crate) order: String,
    /// True if the phases of the lane's steps were timed.
    pub(crate) clocked: bool,
    /// Median time of a step [s]; `None` if the lane has a reason instead of a time.
    pub(crate) seconds: Option<f64>,
    pub(crate) reason: Option<String>,
    /// Line of the lane.
    pub(crate) line: Value,
}

/// A number of a line, by its key.
pub(crate) fn number(line: &Value, key: &str) -> Option<f64> {
    line[key].as_f64()
}

impl Scene {
    pub(crate) fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            sizes: Value::Null,
            orders: Vec::new(),
            faer: Vec::new(),
            lanes: Vec::new(),
        }
    }

    /// Adds the lines of a scene.
    ///
    /// # Errors
    ///
    /// A line with an unknown kind or without its keys.
    pub(crate) fn read(&mut self, lines: &[Value]) -> Result<(), String> {
        for line in lines {
            match line["kind"].as_str() {
                Some("scene") => self.sizes = line.clone(),
                Some("order") => self.orders.push(line.clone()),
                Some("faer") => self.faer.push(line.clone()),
                Some("lane") => self.lanes.push(Lane::read(line).ok_or_else(|| line.to_string())?),
                _ => return Err(format!("cannot be read: {line}")),
            }
        }
        Ok(())
    }

    /// Adds a formulation that was not measured, with the reason.
    pub(crate) fn refuse(&mut self, formulation: &str, why: &str) {
        self.lanes.push(Lane {
            formulation: formulation.to_owned(),
            team: "alone".to_owned(),
            threads: 1,
            order: "chosen".to_owned(),
            clocked: false,
            seconds: None,
            reason: Some(why.to_owned()),
            line: Value::Null,
        });
    }

    /// The lane of a team without a clock.
    pub(crate) fn lane(&self, formulation: &str, team: &str, threads: usize) -> Option<&Lane> {
        let mut lanes = self.lanes.iter().filter(|lane| !lane.clocked);
        lanes.find(|l| l.formulation == formulation && l.team == team && l.threads == threads)
    }

    /// The best serial lane of a formulation: the first one, with the order of minimum degree.
    pub(crate) fn serial(&self, formulation: &str) -> Option<&Lane> {
        self.lane(formulation, "alone", 1)
    }

    /// The lane whose phases were timed, with the given number of threads.
    pub(crate) fn clocked(&self, formulation: &str, threads: usize) -> Option<&Lane> {
        let is_it = |lane: &&Lane| lane.formulation == formulation && lane.threads == threads;
        self.lanes.iter().filter(|lane| lane.clocked).find(is_it)
    }

    /// Counts of an order of elimination.
    pub(crate) fn order(&self, name: &str) -> Option<&Value> {
        self.orders.iter().find(|order| order["order"] == name)
    }

    /// Ratio of our time to that of faer's faster method, with given blocks: after some steps, or at the start.
    pub(crate) fn ratio_to_faer(&self) -> Option<f64> {
        self.faer.iter().rev().find_map(|line| ratio(&line["given"]))
    }

    /// Ratio of our time to that of faer's faster method, if both evaluate the blocks.
    pub(crate) fn ratio_with_blocks(&self) -> Option<f64> {
        self.faer.iter().rev().find_map(ratio)
    }

    /// A number of the scene's sizes.
    pub(crate) fn size(&self, key: &str) -> Option<f64> {
        number(&self.sizes, key)
    }
}

impl Lane {
    fn read(line: &Value) -> Option<Self> {
        let word = |key: &str| line[key].as_str().map(str::to_owned);
        let lane = Self {
            formulation: word("formulation")?,
            team: word("team")?,
            threads: usize::try_from(line["threads"].as_u64()?).ok()?,
            order: word("order")?,
            clocked: line["clocked"].as_bool()?,
            seconds: number(line, "seconds"),
            reason: word("reason"),
            line: line.clone(),
        };
        (lane.seconds.is_some() || lane.reason.is_some()).then_some(lane)
    }

    /// Work in one step, by the keys `iterations`, `factorizations`, `solves`.
    pub(crate) fn work(&self, key: &str) -> Option<f64> {
        self.line["work"][key].as_f64()
    }
}

/// Times of our solver, of faer entry by entry, and of faer by supernodes [s].
pub(crate) fn times(faer: &Value) -> Option<[f64; 3]> {
    let time = |way: &str| number(&faer[way], "seconds");
    Some([time("ours")?, time("simplicial")?, time("supernodal")?])
}

/// Ratio of our time to that of faer's faster method.
pub(crate) fn ratio(faer: &Value) -> Option<f64> {
    times(faer).map(|[ours, simplicial, supernodal]| ours / simplicial.min(supernodal))
}

/// Ratio of the best serial time to this time [-].
pub(crate) fn speed_up(serial: f64, seconds: f64) -> f64 {
    serial / seconds
}

/// Parallel efficiency: speedup divided by the number of threads [-].
pub(crate) fn efficiency(speed_up: f64, threads: usize) -> f64 {
    #[allow(clippy::cast_precision_loss, reason = "a number of threads")]
    let threads = threads.max(1) as f64;
    speed_up / threads
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use serde_json::json;

    /// Makes the line of a lane.
    pub(crate) fn lane(formulation: &str, team: &str, threads: usize, seconds: f64) -> Value {
        json!({
            "kind": "lane", "formulation": formulation, "team": team, "threads": threads, "clocked": false,
            "order": if threads == 1 { "minimum-degree" } else { "chosen" }, "seconds": seconds,
            "quartiles": [seconds * 0.9, seconds * 1.2], "rounds": 9, "batch": 1,
            "work": { "steps": 9, "iterations": 2.0, "factorizations": 1.5, "solves": 10.0 },
        })
    }

    /// Makes the line of a lane with its phases.
    pub(crate) fn clocked(team: &str, threads: usize, seconds: f64) -> Value {
        let mut line = lane("index-3", team, threads, seconds);
        let part = seconds / 10.0;
        line["clocked"] = json!(true);
        line["phases"] = json!({
            "evaluation": part, "forces": part, "bias": part, "residuals": part, "factorisation": 2.0 * part,
            "solves": 2.0 * part, "products": part, "rest": part,
        });
        line["step"] = json!(seconds);
        line["after_evaluation"] = json!(seconds * 0.4);
        line["readings"] = json!(40.0);
        line
    }

    fn order(name: &str, flops: u64, tasks: u64) -> Value {
        json!({
            "kind": "order", "order": name, "unknowns": 7500, "elements": 1250, "fronts": 1000, "largest_front": 15,
            "flops": flops, "entries": 71187, "stored": 88401, "tasks": tasks, "parallelism": 1.99,
        })
    }

    /// A small run with all kinds of lines.
    pub(crate) fn sample() -> Measured {
        let time = |seconds: f64| json!({ "seconds": seconds });
        let lines = [
            json!({ "kind": "scene", "bodies": 10, "unknowns": 90, "rows": 80, "elements": 37, "step": 0.0175, "duration": 10.0 }),
            order("minimum-degree", 1000, 1),
            order("chosen", 1100, 3),
            json!({ "kind": "faer", "after": 0, "ours": time(2e-5), "simplicial": time(3e-5), "supernodal": time(5e-5), "difference": 1e-11,
                "given": { "ours": time(1e-5), "simplicial": time(2e-5), "supernodal": time(4e-5) } }),
            json!({ "kind": "faer", "after": 20, "ours": time(2e-5), "simplicial": time(6e-5), "supernodal": time(4e-5), "difference": 1e-11,
                "given": { "ours": time(1e-5), "simplicial": time(5e-5), "supernodal": time(4e-5) } }),
            lane("index-3", "alone", 1, 4e-4),
            clocked("alone", 1, 4.1e-4),
            lane("index-3", "crew", 2, 2.5e-4),
            clocked("crew", 2, 2.6e-4),
            lane("index-3", "pool", 2, 5e-4),
            lane("recursive", "alone", 1, 2e-4),
        ];
        let mut scene = Scene::new("iltis-stairs");
        scene.read(&lines).unwrap();
        scene.refuse("state-space", "one step takes 3.0 s: not measured further");
        let fork = |team: &str, threads: usize, seconds: f64| json!({ "kind": "fork", "team": team, "threads": threads, "seconds": seconds, "quartiles": [seconds, seconds] });
        Measured {
            machine: Machine { cores: 2, processor: "P".into(), load: [Some(0.1), Some(1.0)] },
            threads: vec![1, 2],
            formulations: ["index-3", "state-space", "recursive"].map(str::to_owned).to_vec(),
            forks: vec![fork("alone", 1, 1e-9), fork("crew", 2, 2e-7), fork("pool", 2, 4e-8)],
            scenes: vec![scene],
        }
    }

    #[test]
    fn speed_up_is_against_the_best_serial_time() {
        let close = |a: f64, b: f64| (a - b).abs() < 1e-12;
        let scene = &sample().scenes[0];
        let serial = scene.serial("index-3").unwrap();
        assert_eq!(serial.order, "minimum-degree");
        let crew = scene.lane("index-3", "crew", 2).unwrap();
        let gain = speed_up(serial.seconds.unwrap(), crew.seconds.unwrap());
        assert!(close(gain, 1.6) && close(efficiency(gain, 2), 0.8));
        assert!(close(scene.ratio_to_faer().unwrap(), 0.25), "the faster way, after some steps");
        assert!(close(scene.ratio_with_blocks().unwrap(), 0.5));
        assert!(close(ratio(&scene.faer[0]).unwrap(), 2.0 / 3.0));
    }

    #[test]
    fn malformed_lines_are_refused() {
        let mut scene = Scene::new("x");
        assert!(scene.read(&[json!({ "kind": "other" })]).is_err());
        assert!(scene.read(&[json!({ "kind": "lane", "formulation": "index-3" })]).is_err());
    }
}

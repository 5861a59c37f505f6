//! Measurements as JSON: one row for each scene, formulation and team.

use super::measured::{Lane, Measured, Scene, efficiency, number, speed_up};
use super::papers;
use serde_json::{Map, Value, json};

/// Counts of a row that come from the order of elimination.
const OF_ORDER: [&str; 8] =
    ["unknowns", "elements", "fronts", "largest_front", "flops", "entries", "tasks", "parallelism"];

/// Returns all measurements of a run as JSON.
pub(crate) fn json(measured: &Measured) -> Value {
    let rows: Vec<Value> = measured.scenes.iter().flat_map(rows).collect();
    let each = |lines: fn(&Scene) -> &Vec<Value>| -> Vec<Value> {
        let of = |scene: &Scene| lines(scene).iter().map(|line| with_scene(scene, line)).collect();
        measured.scenes.iter().flat_map(|scene: &Scene| -> Vec<Value> { of(scene) }).collect()
    };
    json!({
        "machine": measured.machine.json(), "threads": measured.threads, "rows": rows,
        "forks": measured.forks, "faer": each(|scene| &scene.faer), "orders": each(|scene| &scene.orders),
        "report": report(),
    })
}

fn with_scene(scene: &Scene, line: &Value) -> Value {
    let mut line = line.clone();
    line["scene"] = json!(scene.name);
    line
}

/// The rows of a scene: one for each lane without a clock. The phases come from the lane with a clock that makes the same steps.
fn rows(scene: &Scene) -> Vec<Value> {
    scene.lanes.iter().filter(|lane| !lane.clocked).map(|lane| row(scene, lane)).collect()
}

/// Row of a lane in a scene.
fn row(scene: &Scene, lane: &Lane) -> Value {
    let serial = scene.serial(&lane.formulation).and_then(|lane| lane.seconds);
    let gain = serial.zip(lane.seconds).map(|(serial, seconds)| speed_up(serial, seconds));
    let is_first = scene.serial(&lane.formulation) == Some(lane);
    let clocked =
        scene.clocked(&lane.formulation, lane.threads).filter(|_| is_first || lane.team == "crew");
    let is_compared = is_first && lane.formulation == "index-3";
    let faer = scene.ratio_to_faer().filter(|_| is_compared);
    let with_blocks = scene.ratio_with_blocks().filter(|_| is_compared);
    json!({
        "scene": scene.name, "formulation": lane.formulation, "threads": lane.threads, "team": lane.team,
        "order": lane.order, "seconds": lane.seconds, "quartiles": lane.line["quartiles"],
        "measurements": lane.line["rounds"], "steps_in_each": lane.line["batch"], "speed_up": gain,
        "efficiency": gain.map(|gain| efficiency(gain, lane.threads)), "ratio_to_faer": faer,
        "ratio_to_faer_with_blocks": with_blocks,
        "counts": counts(scene, lane), "phases": clocked.map(phases), "reason": lane.reason,
    })
}

/// Sizes of the scene, and work of one step.
fn counts(scene: &Scene, lane: &Lane) -> Value {
    let mut counts = Map::new();
    let is_own = lane.line["own"] != false;
    if let Some(order) = scene.order(&lane.order).filter(|_| is_own) {
        for key in OF_ORDER {
            counts.insert(key.to_owned(), order[key].clone());
        }
        counts.insert("rows".to_owned(), scene.sizes["rows"].clone());
    }
    for key in ["iterations", "factorizations", "solves"] {
        counts.insert(key.to_owned(), json!(lane.work(key)));
    }
    Value::Object(counts)
}

/// Average seconds of each phase per step, with the complete step and the part after the last evaluation of the iteration.
fn phases(lane: &Lane) -> Value {
    let mut phases = lane.line["phases"].clone();
    for key in ["step", "after_evaluation"] {
        phases[key] = json!(number(&lane.line, key));
    }
    phases
}

/// Numbers of the report on processors, as JSON.
fn report() -> Value {
    let reductions = papers::REDUCTIONS.iter().map(|method| {
        json!({ "method": method.printed, "formulation": method.ours, "reduction_percent": method.reductions })
    });
    let times = papers::TIMES.iter().map(|(name, scene, seconds)| {
        json!({ "simulation": name, "scene": scene, "processors": 2, "seconds": seconds })
    });
    json!({
        "T6": { "source": "report, Table IV = publication 3, Table II", "rows": reductions.collect::<Vec<_>>() },
        "T7": { "source": "report, Table V", "rows": times.collect::<Vec<_>>() },
    })
}

#[cfg(test)]
mod tests {
    use super::super::measured::tests::sample;
    use super::*;

    #[test]
    fn rows_have_the_keys_that_are_promised() {
        let json = json(&sample());
        let rows = json["rows"].as_array().unwrap();
        assert_eq!(rows.len(), 5, "four measured without a clock, one refused");
        for row in rows {
            let row = row.as_object().unwrap();
            for key in [
                "scene",
                "formulation",
                "threads",
                "seconds",
                "speed_up",
                "ratio_to_faer",
                "ratio_to_faer_with_blocks",
                "counts",
                "phases",
            ] {
                assert!(row.contains_key(key), "{key}");
            }
        }
        let [first, crew] = [&rows[0], &rows[1]];
        let close = |value: &Value, x: f64| (value.as_f64().unwrap() - x).abs() < 1e-12;
        assert!(close(&first["speed_up"], 1.0) && close(&first["ratio_to_faer"], 0.25));
        assert!(close(&crew["speed_up"], 1.6) && crew["ratio_to_faer"].is_null());
        assert!(close(&crew["efficiency"], 0.8) && crew["threads"] == 2);
        assert!(close(&crew["phases"]["solves"], 5.2e-5) && crew["counts"]["tasks"] == 3);
        assert!(rows[2]["phases"].is_null() && rows[4]["seconds"].is_null());
        assert!(rows[4]["reason"].as_str().unwrap().contains("3.0 s"));
        assert_eq!(json["report"]["T6"]["rows"][0]["reduction_percent"][1], 22.7);
    }
}

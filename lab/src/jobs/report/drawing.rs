//! Work-precision diagram of a comparison: for each formulation, the runs for which no other of its runs is both faster and more exact.

use crate::chart::{Chart, Look, Series};
use serde_json::Value;

/// The drawing of a comparison, from its JSON: in double precision, a line for each formulation with its integrator.
pub(super) fn chart(comparison: &Value) -> Chart {
    let mut series: Vec<Series> = Vec::new();
    for method in comparison["methods"].as_array().into_iter().flatten() {
        let text = |key: &str| method[key].as_str().unwrap_or_default();
        if text("precision") != "f64" {
            continue;
        }
        let integrator = text("integrator");
        let name = match integrator {
            "trapezoidal" => text("formulation").to_owned(),
            other => format!("{} {other}", text("formulation")),
        };
        let runs = method["runs"].as_array().into_iter().flatten();
        let is_good = |run: &&Value| {
            run["status"].as_str() == Some("completed")
                && run["is_below_reference"].as_bool() == Some(false)
        };
        let point = |run: &Value| Some([run["error"].as_f64()?, run["cpu_least"].as_f64()?]);
        let points = runs.filter(is_good).filter_map(point);
        match series.iter_mut().find(|s| s.name == name) {
            Some(line) => line.points.extend(points),
            None => {
                let (style, points) = (series.len(), points.collect());
                series.push(Series::new(name, style, Look::Both, points));
            }
        }
    }
    for line in &mut series {
        line.points = unbeaten(std::mem::take(&mut line.points));
    }
    Chart::log_log("true error, in the scale of each output [-]", "CPU [s]", series)
}

/// The points for which no other point has both a smaller time and a smaller error, from the largest error on.
fn unbeaten(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut least = f64::INFINITY;
    points.retain(|[_, seconds]| {
        let is_less = *seconds < least;
        least = least.min(*seconds);
        is_less
    });
    points.reverse();
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_is_beaten_in_both_is_left_out() {
        let points = vec![[1e-2, 1.0], [1e-4, 4.0], [1e-3, 5.0], [1e-5, 9.0], [1e-2, 2.0]];
        assert_eq!(unbeaten(points), [[1e-2, 1.0], [1e-4, 4.0], [1e-5, 9.0]]);
    }

    #[test]
    fn a_line_stands_for_a_formulation_with_its_integrator_in_double_precision() {
        let run = |error: f64, below: bool| json!({ "status": "completed", "error": error, "cpu_least": 1.0 / error, "is_below_reference": below });
        let method = |control: &str, precision: &str, runs: Value| json!({ "formulation": "index-3", "integrator": "trapezoidal", "control": control, "precision": precision, "runs": runs });
        let comparison = json!({ "methods": [
            method("fixed", "f64", json!([run(1e-2, false), run(1e-9, true)])),
            method("error", "f64", json!([run(1e-3, false), { "status": "failed" }])),
            method("error", "f32", json!([run(1e-4, false)])),
        ] });
        let chart = chart(&comparison);
        assert_eq!(chart.series.len(), 1);
        assert_eq!(chart.series[0].points, [[1e-2, 1e2], [1e-3, 1e3]]);
    }
}

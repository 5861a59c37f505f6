//! The page of a comparison: one self-contained HTML file.

use super::captions;
use super::plots::{Look, Panel, looks, panels};
use crate::page::{STYLE, escape, fill};
use crate::report::Section;
use mbs_study::compare::results::{Comparison, ConvergenceMap};
use serde::Serialize;

const TEMPLATE: &str = include_str!("page.html");
const PLOT: &str = include_str!("plot.js");
const SCRIPT: &str = include_str!("page.js");
const OWN_STYLE: &str = include_str!("page.css");

#[derive(Serialize)]
struct Data<'a> {
    scene: &'a str,
    methods: Vec<Look>,
    panels: Vec<Panel>,
    maps: Vec<Map<'a>>,
}

#[derive(Serialize)]
struct Map<'a> {
    #[serde(flatten)]
    map: &'a ConvergenceMap,
    caption: String,
}

/// Writes the page of a comparison that was digested: one HTML file without references to anything outside.
#[must_use]
pub fn comparison_page(comparison: &Comparison) -> String {
    let data = Data {
        scene: &comparison.scene,
        methods: looks(comparison),
        panels: panels(comparison),
        maps: comparison.maps.iter().map(|map| Map { map, caption: captions::map(map) }).collect(),
    };
    // all keys are texts and the sink is memory: serialisation has nothing to fail on
    let data = serde_json::to_string(&data).unwrap_or_default();
    // `<` inside a text of the data must not end the script element it stands in
    let data = data.replace('<', "\\u003c");
    let report = super::text::report(comparison);
    let cards = |is_wanted: fn(&Section) -> bool| {
        let mut out = String::new();
        for section in report.sections.iter().filter(|s| is_wanted(s)) {
            section.write_card(&mut out);
        }
        out
    };
    let mut origin = String::new();
    Section::made(comparison.provenance.rows()).write_card(&mut origin);
    let is_rank: fn(&Section) -> bool = |s| s.title.starts_with("Fastest");
    let is_rest: fn(&Section) -> bool = |s| !s.title.starts_with("Fastest");
    fill(
        TEMPLATE,
        &[
            ("{{title}}", &escape(&report.title)),
            ("{{style}}", &[STYLE, OWN_STYLE].concat()),
            ("{{heading}}", &escape(&report.title)),
            ("{{ranking}}", &cards(is_rank)),
            ("{{tables}}", &cards(is_rest)),
            ("{{origin}}", &origin),
            ("{{data}}", &data),
            ("{{script}}", &[PLOT, SCRIPT].concat()),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use mbs::record::RunError;
    use mbs_study::compare::results::{MethodRuns, RunEntry, Status};

    fn page() -> String {
        let done = |h: f64| RunEntry {
            setting: h,
            mean_step: h,
            status: Status::Completed,
            error: Some(h * h),
            cpu_seconds: vec![1e-6 / h],
            ..RunEntry::default()
        };
        let failure = RunError { code: "rank-lost".into(), ..RunError::default() };
        let failed =
            RunEntry { status: Status::Failed, failure: Some(failure), ..RunEntry::default() };
        let runs = vec![failed, done(1e-2), done(1e-3)];
        let method = MethodRuns {
            name: "index-3 <x>".into(),
            formulation: "index-3".into(),
            integrator: "trapezoidal".into(),
            control: "fixed".into(),
            precision: "f64".into(),
            runs,
            ..MethodRuns::default()
        };
        let mut comparison = Comparison {
            scene: "a </script><b>{{data}}".into(),
            methods: vec![method],
            ..Comparison::default()
        };
        comparison.digest(&[1e-4]);
        comparison_page(&comparison)
    }

    #[test]
    fn the_page_is_self_contained() {
        let html = page();
        let links = html
            .replace("http://www.w3.org/2000/svg", "")
            .replace("http://www.w3.org/1999/xhtml", "");
        for word in ["http:", "https:", "src=", "@import", "url(", "index-3 <x>"] {
            assert!(!links.contains(word), "{word}");
        }
        assert_eq!(html.matches("</script>").count(), 2);
    }

    #[test]
    fn a_failed_run_is_drawn_on_the_rail() {
        let html = page();
        let start = html.find("id=\"data\">").unwrap() + "id=\"data\">".len();
        let end = start + html[start..].find("</script>").unwrap();
        let data: serde_json::Value = serde_json::from_str(&html[start..end]).unwrap();
        let line = &data["panels"][0]["lines"][0];
        assert_eq!(line["points"].as_array().unwrap().len(), 2);
        assert!(line["failed"][0][1].as_str().unwrap().contains("rank-lost"));
    }
}

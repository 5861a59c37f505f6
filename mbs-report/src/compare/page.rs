//! Page of a comparison: the work-precision diagram and the ranks are shown, all other parts are folded.

use super::captions;
use super::plots::{looks, panels};
use super::text::Tables;
use crate::page::{DiagramFrame, Pack, Page, PageSection};
use crate::table::Section;
use mbs_study::compare::results::Comparison;
use serde_json::json;

/// Explanation of the marks, colours and dashes of lines.
const KEY: &str = "Mark and colour: integrator; dash: formulation; filled: fixed steps, hollow: controlled steps; thin: single precision. \
                   Click a name to hide or show its lines in all diagrams.";

/// Writes the page of an evaluated comparison: one HTML file without references to other files.
#[must_use]
pub fn comparison_page(comparison: &Comparison) -> String {
    let tables = Tables(comparison);
    let panels = panels(comparison);
    let mut frames: Vec<_> = panels.iter().enumerate().map(|(i, panel)| panel.frame(i)).collect();
    let rest = frames.split_off(1);
    for frame in &mut frames {
        frame.caption = format!("{} {KEY}", frame.caption);
    }
    let maps = comparison.maps.iter().enumerate().map(|(number, map)| DiagramFrame {
        place: ("map", number),
        title: format!("Convergence: {}, {}", map.formulation, map.precision),
        caption: captions::map(map),
        has_keys: false,
    });
    let maps: Vec<_> = maps.collect();
    let mut sections: Vec<_> = tables.unverified().map(PageSection::Error).into_iter().collect();
    sections.push(PageSection::Diagrams(frames));
    sections.push(PageSection::Tables(tables.levels()));
    sections.extend(tables.choices().map(PageSection::Table));
    let fold = |title: &str, frames| {
        PageSection::Fold(title.to_owned(), vec![PageSection::Diagrams(frames)])
    };
    let folded = |section: Section| PageSection::of(section.folded());
    sections.push(folded(tables.basis()));
    sections.push(fold("Errors, times, energy and violation", rest));
    if !maps.is_empty() {
        sections.push(fold("Convergence over step and penalty", maps));
    }
    sections.push(folded(tables.by_method()));
    sections.extend(tables.failures().map(folded));
    sections.push(folded(tables.all_runs()));
    sections.push(folded(Section::made(comparison.provenance.rows())));
    let diagrams = json!({ "looks": looks(comparison), "panels": panels, "maps": comparison.maps });
    Page {
        title: tables.title(),
        sections,
        pack: Some(Pack::default().text(json!({ "diagrams": diagrams }))),
    }
    .html()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::tests::data;
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
        assert_eq!(html.matches("</script>").count(), 3);
    }

    #[test]
    fn a_failed_run_is_drawn_on_the_rail() {
        let (data, _) = data(&page());
        let line = &data["diagrams"]["panels"][0]["lines"][0];
        assert_eq!(line["points"].as_array().unwrap().len(), 2);
        assert!(line["failed"][0][1].as_str().unwrap().contains("rank-lost"));
    }

    #[test]
    fn the_diagram_is_first_then_the_ranks_and_runs_are_folded() {
        let html = page();
        let place = |text: &str| html.find(text).unwrap_or_else(|| panic!("no `{text}`"));
        let order = ["data-diagram=\"0\"", "Fastest at", "<details", "All runs"].map(place);
        assert!(order.is_sorted(), "{order:?}");
        let before = &html[..place("<details")];
        assert_eq!(before.matches("<figure").count(), 1);
    }

    #[test]
    fn integrators_have_colours_and_marks_of_their_own() {
        let method = |formulation: &str, integrator: &str| MethodRuns {
            name: format!("{formulation} {integrator}"),
            formulation: formulation.into(),
            integrator: integrator.into(),
            ..MethodRuns::default()
        };
        let rule = "trapezoidal";
        let mut methods = vec![method("index-3", rule), method("recursive", rule)];
        let own = ["rk4", "rk54", "rk853", "gbs", "radau5"];
        methods.extend(own.map(|integrator| method("recursive", integrator)));
        let comparison = Comparison { methods, ..Comparison::default() };
        let (data, _) = data(&comparison_page(&comparison));
        let looks = data["diagrams"]["looks"].as_array().unwrap();
        let kinds: Vec<_> = looks.iter().map(|look| look["kind"].as_u64().unwrap()).collect();
        assert_eq!(kinds, [0, 0, 1, 2, 3, 4, 5]);
        assert_ne!(looks[0]["dash"], looks[1]["dash"]);
    }
}

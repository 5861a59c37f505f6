//! The job `cargo xtask steps`: experiments on controlled steps compared with fixed ones, with drawings and claims.

mod draw;
mod events;
mod fit;
mod hammer;
mod index;
mod pendulum;
mod reference;
mod rows;
mod sight;
mod suspension;
mod tolerance;

use crate::lab::section::{self, Section};
use crate::lab::{self, Lab};
use crate::mbs::Mbs;
use xtask::process;

/// Function that runs an experiment.
type Experiment = fn(&Lab<'_>) -> Result<Section, String>;

/// The experiments, by their names.
const EXPERIMENTS: [(&str, Experiment); 6] = [
    ("F6", suspension::run),
    ("P2", pendulum::run),
    ("A", index::run),
    ("B", tolerance::run),
    ("C", events::run),
    ("H", hammer::run),
];

/// The title of the page.
const TITLE: &str = "Variable steps beside fixed ones";
/// Remark that holds for all experiments.
const REMARK: &str = "Energy error: largest error of the energy invariant over every step; its share is that of the energy turned \
    over, the largest kinetic energy plus the work done. CPU: of the stepping, the least of several runs in turn.";

/// Figures 6 and 7 of the report, with the runs for them.
///
/// # Errors
///
/// The reason why a case cannot be run.
pub(crate) fn figures(lab: &Lab<'_>) -> Result<Section, String> {
    suspension::run(lab)
}

/// Page of the experiments, with the numbers of its claims.
#[derive(Debug)]
pub(crate) struct Steps {
    /// Page as HTML.
    pub(crate) html: String,
    /// Number of claims, and number of claims that hold.
    pub(crate) claims: [usize; 2],
}

/// Builds `mbs`, runs the experiments one after the other, and writes the files under `target/steps`.
///
/// # Errors
///
/// An unknown name, or the reason why something cannot be run.
#[allow(clippy::print_stdout, reason = "the experiments are what is asked for")]
pub(crate) fn run(quick: bool, names: &[String]) -> Result<Steps, String> {
    let known = EXPERIMENTS.map(|(name, _)| name);
    if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(format!("no experiment `{name}`; there are {}", known.join(", ")));
    }
    let mbs = Mbs::build()?;
    let folder = process::target_dir().join("steps");
    let runner = lab::runner(&mbs, &folder);
    let lab = Lab { runner: &runner, quick, folder: folder.clone() };
    let sections = perform(&lab, names)?;
    process::progress("");
    println!("{}", section::text(&sections));
    process::write(&folder.join("steps.csv"), &rows::csv(&sections)?)?;
    let page = html(&sections);
    process::write(&folder.join("steps.html"), page.as_bytes())?;
    let claims = || sections.iter().flat_map(Section::claims);
    let hold = claims().filter(|claim| claim.holds == Some(true)).count();
    Ok(Steps { html: page, claims: [claims().count(), hold] })
}

/// Runs the experiments, or the named ones.
fn perform(lab: &Lab<'_>, names: &[String]) -> Result<Vec<Section>, String> {
    let is_wanted = |name: &str| names.is_empty() || names.iter().any(|n| n == name);
    let wanted = EXPERIMENTS.iter().filter(|(name, _)| is_wanted(name));
    wanted.map(|(_, experiment)| experiment(lab)).collect()
}

/// Makes the page: all claims first, then each experiment.
fn html(sections: &[Section]) -> String {
    let mut summary = Section::new("claims", "What holds");
    for claim in sections.iter().flat_map(Section::claims) {
        summary.claim(&*claim.what, claim.measured.clone(), claim.holds);
    }
    section::page(TITLE, REMARK, &[&[summary], sections].concat())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::fake;

    #[test]
    fn every_experiment_runs_and_its_page_needs_nothing_else() {
        fake::with_lab(|lab| {
            let sections = perform(lab, &[]).unwrap();
            let names: Vec<_> = sections.iter().map(|section| section.name).collect();
            assert_eq!(names, EXPERIMENTS.map(|(name, _)| name));
            let page = html(&sections);
            let text: String = sections.iter().map(Section::text).collect();
            fake::keep(&page, &text);
            assert!(!page.contains("{{") && !page.contains("src="), "nothing is fetched");
            assert!(!page.contains("No drawing"), "every drawing has its points");
            assert!(page.matches("<figure>").count() > 20);
            assert!(page.contains("<b>holds:</b>") && page.contains("<b>does not hold:</b>"));
            assert!(text.contains("(holds)") && !text.contains("NaN") && !page.contains("NaN"));
            let csv = rows::csv(&sections).unwrap();
            assert_eq!(
                csv.iter().filter(|b| **b == b'\n').count(),
                1 + sections.iter().map(|s| s.runs.len()).sum::<usize>()
            );
        });
    }

    #[test]
    fn without_the_new_options_the_page_says_what_is_refused() {
        fake::with_old_lab(|lab| {
            let sections = perform(lab, &[]).unwrap();
            let page = html(&sections);
            assert!(page.contains("refused: unexpected argument") && !page.contains("NaN"));
        });
    }

    #[test]
    fn experiments_are_chosen_by_their_names() {
        fake::with_lab(|lab| {
            let sections = perform(lab, &["A".to_owned()]).unwrap();
            assert_eq!(sections.iter().map(|s| s.name).collect::<Vec<_>>(), ["A"]);
        });
        assert!(run(true, &["Z".to_owned()]).unwrap_err().contains("F6, P2, A, B, C, H"));
    }
}

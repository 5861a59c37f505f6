//! Runs of experiments: cases one after the other, the least time of several runs, and the files of a run.

pub(crate) mod case;
#[cfg(test)]
pub(crate) mod fake;
pub(crate) mod record;
pub(crate) mod section;

use crate::mbs::outcome::{Figures, Outcome};
use crate::mbs::{self, Mbs};
use case::Case;
use record::Record;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;
use xtask::process;

/// Largest wall-clock time of a run. Chosen, not tuned.
const RUN_TIME: Duration = Duration::from_secs(300);
/// Time above which a run is not repeated for its time [s].
const LONG: f64 = 30.0;

/// A case and its outcome, with the least of its times.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Run {
    /// Case that was run.
    pub(crate) case: Case,
    /// Outcome of the run.
    pub(crate) outcome: Outcome,
    /// Distance of the watched channel from its reference at the end, if there is one.
    pub(crate) true_error: Option<f64>,
}

impl Run {
    /// Figures of the run, if it was completed.
    pub(crate) fn figures(&self) -> Option<&Figures> {
        self.outcome.figures()
    }

    /// CPU time of the run [s].
    pub(crate) fn seconds(&self) -> Option<f64> {
        self.figures().map(|f| f.seconds)
    }

    /// Largest energy error of the run [J].
    pub(crate) fn energy_error(&self) -> Option<f64> {
        self.figures().map(|f| f.energy_error)
    }
}

/// Function that runs a case. With a folder, the files of the run are written to it.
pub(crate) type Runner<'a> = dyn Fn(&Case, Option<&Path>) -> Result<Outcome, String> + 'a;

/// Environment of experiments: the runner of their cases, and the folder for files.
pub(crate) struct Lab<'a> {
    /// Function that runs a case.
    pub(crate) runner: &'a Runner<'a>,
    /// True if the finest runs are left out.
    pub(crate) quick: bool,
    /// The folder for files of runs.
    pub(crate) folder: PathBuf,
}

impl Lab<'_> {
    /// Runs the cases one after the other, and repeats this `repeats` times. Each case gets its least time.
    ///
    /// # Errors
    ///
    /// The reason why a case cannot be run.
    pub(crate) fn measure(&self, cases: &[Case], repeats: u32) -> Result<Vec<Run>, String> {
        let mut runs: Vec<Run> = Vec::new();
        for (i, case) in cases.iter().enumerate() {
            process::progress(&format!(
                "{} {} ({} of {})",
                case.scene,
                case.name(),
                i + 1,
                cases.len()
            ));
            let outcome = (self.runner)(case, None)?;
            runs.push(Run { case: case.clone(), outcome, true_error: None });
        }
        for turn in 1..repeats {
            for run in &mut runs {
                let Outcome::Completed(least) = &mut run.outcome else { continue };
                if least.seconds > LONG {
                    continue;
                }
                process::progress(&format!(
                    "{} {}, again ({turn})",
                    run.case.scene,
                    run.case.name()
                ));
                if let Outcome::Completed(figures) = (self.runner)(&run.case, None)? {
                    least.seconds = least.seconds.min(figures.seconds);
                }
            }
        }
        Ok(runs)
    }

    /// Runs a case once and reads its steps and some channels from its files; `None` if it makes no steps.
    ///
    /// # Errors
    ///
    /// The reason why the case cannot be run, or the part that is missing in its files.
    pub(crate) fn record(&self, case: &Case, channels: &[&str]) -> Result<Option<Record>, String> {
        process::progress(&format!("{} {}, with its files", case.scene, case.name()));
        let folder = self.folder.join("runs");
        // removes files of an earlier run; an error is ignored, since the folder may not exist
        let _ = fs::remove_dir_all(&folder);
        let outcome = (self.runner)(case, Some(&folder))?;
        outcome.has_run().then(|| Record::read(&folder, channels)).transpose()
    }
}

/// Runs cases with `mbs`. A scene with appended text is first written to the folder.
pub(crate) fn runner<'a>(
    mbs: &'a Mbs,
    folder: &'a Path,
) -> impl Fn(&Case, Option<&Path>) -> Result<Outcome, String> + 'a {
    move |case, out| run(mbs, &folder.join("scenes"), case, out)
}

fn run(mbs: &Mbs, folder: &Path, case: &Case, out: Option<&Path>) -> Result<Outcome, String> {
    let mut scene = mbs::scene(case.scene);
    if !scene.is_file() {
        return Ok(Outcome::Refused(format!("there is no scene `{}`", case.scene)));
    }
    if !case.appended.is_empty() {
        let place = |e: std::io::Error| format!("{}: {e}", scene.display());
        let text = fs::read_to_string(&scene).map_err(place)? + case.appended;
        let copy = folder.join(format!("{}.toml", case.scene));
        fs::create_dir_all(folder).and_then(|()| fs::write(&copy, text)).map_err(place)?;
        scene = copy;
    }
    mbs.run(&scene, &case.arguments(), out, Some(RUN_TIME))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn the_least_time_is_kept_and_what_stops_is_run_once() {
        let calls = Cell::new(0);
        let runner = |case: &Case, _: Option<&Path>| {
            calls.set(calls.get() + 1);
            let seconds = [0.3, 0.2, 0.4][calls.get() % 3];
            let figures = Figures { seconds, ..Figures::default() };
            Ok(if case.formulation == "index-3" {
                Outcome::Completed(figures)
            } else {
                Outcome::Refused("no".into())
            })
        };
        let lab = Lab { runner: &runner, quick: true, folder: PathBuf::new() };
        let cases = ["index-3", "index-1"].map(|f| Case::fixed("andrews", f, 1e-3));
        let runs = lab.measure(&cases, 4).unwrap();
        assert_eq!(calls.get(), 2 + 3);
        assert!((runs[0].seconds().unwrap() - 0.2).abs() < 1e-12);
        assert_eq!((runs[1].seconds(), runs[1].energy_error()), (None, None));
    }

    #[test]
    fn files_of_a_run_are_read_back() {
        fake::with_lab(|lab| {
            let case = Case::fixed("iltis-suspension-stiff", "index-3", 1e-2);
            let record = lab.record(&case, &["wheel.z"]).unwrap().unwrap();
            assert!(record.steps.len() > 100 && record.channels.len() == 1);
            let refused = Case { formulation: "absent", ..case };
            assert_eq!(lab.record(&refused, &[]), Ok(None));
        });
    }
}

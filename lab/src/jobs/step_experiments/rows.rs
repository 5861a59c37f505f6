//! Rows of runs, for the tables of a section and for the CSV.

use crate::format::{self, error, seconds, step};
use crate::lab::Run;
use crate::lab::case::size;
use crate::lab::section::Section;

/// Columns that every table of runs has.
pub(crate) const HEAD: [&str; 8] = [
    "run",
    "energy error [J]",
    "share",
    "CPU [s]",
    "steps",
    "rejected",
    "least step [s]",
    "in index 1",
];

/// A row of a table with those columns. A run that was not completed has its reason instead.
pub(crate) fn row(run: &Run) -> Vec<String> {
    let Some(figures) = run.figures() else {
        return vec![run.case.name(), run.outcome.reason()];
    };
    let mut cells = vec![
        run.case.name(),
        error(figures.energy_error),
        error(figures.share()),
        seconds(figures.seconds),
        figures.work[0].to_string(),
    ];
    cells.extend(match figures.control {
        Some(c) => [c.rejected.to_string(), size(c.steps[0]), c.index_1_steps.to_string()],
        None => Default::default(),
    });
    cells
}

/// A row with further cells. A reason gets no further cells.
pub(crate) fn row_with(run: &Run, further: impl IntoIterator<Item = String>) -> Vec<String> {
    let mut cells = row(run);
    if run.figures().is_some() {
        cells.extend(further);
    }
    cells
}

/// A number as a cell; empty without a number.
pub(crate) fn cell(number: Option<f64>, format: impl Fn(f64) -> String) -> String {
    number.map(format).unwrap_or_default()
}

/// A record for every run, as CSV.
///
/// # Errors
///
/// The message of the writer.
pub(crate) fn csv(sections: &[Section]) -> Result<Vec<u8>, String> {
    let head = "experiment,scene,formulation,control,step_s,largest_step_s,tolerance,events,duration_s,energy_error_j,\
        energy_error_share,true_error,cpu_s,steps,iterations,factorizations,rejected,smallest_step_used_s,\
        largest_step_used_s,index_changes,index_1_steps,steps_to_events,reason";
    let records = |section: &'_ Section| -> Vec<_> {
        section.runs.iter().map(|run| record(section.name, run)).collect()
    };
    format::csv(head, sections.iter().flat_map(records))
}

/// The record of one run, in the order of the header.
fn record(experiment: &str, run: &Run) -> Vec<String> {
    let (case, figures) = (&run.case, run.figures());
    let control = figures.and_then(|f| f.control);
    let exact = |x: Option<f64>| cell(x, |x| format!("{x:e}"));
    let count = |x: Option<u64>| x.map(|x| x.to_string()).unwrap_or_default();
    let events = case.events.map_or("", |events| if events { "on" } else { "off" });
    let mut cells =
        [experiment, case.scene, case.formulation, case.control()].map(str::to_owned).to_vec();
    cells.extend([step(case.step), step(case.largest), exact(case.tolerance())]);
    cells.extend([events.to_owned(), cell(case.duration, |x| x.to_string())]);
    cells.extend([
        exact(run.energy_error()),
        exact(figures.map(|f| f.share())),
        exact(run.true_error),
    ]);
    cells.push(exact(run.seconds()));
    cells.extend([0, 1, 2].map(|i| count(figures.map(|f| f.work[i]))));
    cells.push(count(control.map(|c| c.rejected)));
    cells.extend([0, 1].map(|i| exact(control.map(|c| c.steps[i]))));
    cells.extend([
        count(control.map(|c| c.index_changes)),
        count(control.map(|c| c.index_1_steps)),
        count(control.map(|c| c.events)),
        run.outcome.reason(),
    ]);
    cells
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::case::{Case, Rule};
    use crate::mbs::outcome::{Control, Figures, Outcome};

    fn runs() -> [Run; 2] {
        let case = Case::variable("andrews", "index-3", Rule::Both(1e-5), [1e-5, 1e-3]);
        let control = Control { rejected: 4, steps: [2e-6, 9e-4], ..Control::default() };
        let figures = Figures {
            energy_error: 2e-3,
            turned_over: 4.0,
            seconds: 0.5,
            work: [70, 210, 140],
            control: Some(control),
            ..Figures::default()
        };
        let stopped = Outcome::TooLong(300.0);
        [Outcome::Completed(figures), stopped].map(|outcome| Run {
            case: case.clone(),
            outcome,
            true_error: Some(1e-4),
        })
    }

    #[test]
    fn a_row_has_a_cell_for_each_column_or_its_reason() {
        let [done, stopped] = runs();
        let expected = ["index-3, both 1e-5", "2.0e-3", "5.0e-4", "0.500", "70", "4", "2e-6", "0"];
        assert_eq!(
            (row(&done), HEAD.len()),
            (expected.map(str::to_owned).to_vec(), expected.len())
        );
        assert_eq!(row_with(&done, ["x".to_owned()]).len(), 9);
        assert_eq!(row_with(&stopped, ["x".to_owned()])[1..], ["took more than 300 s"]);
    }

    #[test]
    fn csv_reads_back() {
        let mut section = Section::new("B", "title");
        section.runs = runs().to_vec();
        let bytes = csv(&[section]).unwrap();
        let mut reader = csv::Reader::from_reader(bytes.as_slice());
        let names = reader.headers().unwrap().clone();
        let records: Vec<_> = reader.records().map(Result::unwrap).collect();
        let cell =
            |row: usize, name: &str| &records[row][names.iter().position(|n| n == name).unwrap()];
        assert_eq!(records.len(), 2);
        assert_eq!(
            [cell(0, "control"), cell(0, "tolerance"), cell(0, "rejected")],
            ["both", "1e-5", "4"]
        );
        assert_eq!([cell(0, "energy_error_share"), cell(0, "true_error")], ["5e-4", "1e-4"]);
        assert_eq!([cell(1, "cpu_s"), cell(1, "reason")], ["", "took more than 300 s"]);
    }
}

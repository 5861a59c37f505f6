//! Rows for each method and step: our numbers beside the published ones, as words and as CSV.

use super::report::{Method, Printed, Table};
use crate::format::{self, error, seconds, step};
use crate::mbs::outcome::{Figures, Outcome};

/// One entry of a table, with the outcome of its run.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    /// Table of the entry.
    pub(crate) table: &'static Table,
    /// Method of the entry.
    pub(crate) method: &'static Method,
    /// Step of the entry [s].
    pub(crate) step: f64,
    /// Outcome of our run.
    pub(crate) outcome: Outcome,
    /// Entry that the report prints.
    pub(crate) printed: Printed,
}

impl Row {
    /// Makes a row from an entry and its outcome.
    pub(crate) fn new(
        table: &'static Table,
        method: &'static Method,
        step: f64,
        outcome: Outcome,
    ) -> Self {
        Self { table, method, step, outcome, printed: table.printed(method, step) }
    }

    /// Distance from the reference at the end, if the table has a reference.
    fn distance(&self) -> Option<f64> {
        let reference = self.table.reference?;
        self.outcome.figures()?.distance(reference.channel, reference.value).ok()
    }

    /// Our numbers: error [J], error relative to the exchanged energy, distance from the reference, time [s].
    pub(crate) fn ours(&self) -> [String; 4] {
        match &self.outcome {
            Outcome::Completed(f) => {
                let distance = self.distance().map(error).unwrap_or_default();
                [error(f.energy_error), error(f.share()), distance, seconds(f.seconds)]
            }
            _ => Default::default(),
        }
    }

    /// The published error, or the words in its place, and the published time [s].
    pub(crate) fn report(&self) -> [String; 2] {
        let words = |text: &str| [text.to_owned(), String::new()];
        match self.printed {
            Printed::Numbers(e, s) => [digits(e), s.map(time).unwrap_or_default()],
            Printed::Time(s) => [String::new(), time(s)],
            Printed::NoConvergence => words("no convergence"),
            Printed::Wrong => words("wrong results"),
            Printed::DoesNotWork => words("does not work"),
            Printed::Nothing => words(""),
        }
    }
}

/// The sizes of the models of a table, ours and the published ones. Methods with equal sizes are in one line.
pub(crate) fn sizes(table: &Table, rows: &[Row]) -> Vec<String> {
    let mut groups: Vec<(Vec<&str>, String)> = Vec::new();
    for row in rows {
        let Outcome::Completed(Figures { sizes: [coordinates, constraints, freedoms], .. }) =
            row.outcome
        else {
            continue;
        };
        let printed = table.sizes.iter().find(|(name, _)| *name == row.method.formulation);
        let printed = printed.map_or(String::new(), |(_, text)| format!("; the report: {text}"));
        let text = format!(
            "{coordinates} coordinates, {constraints} constraints, freedoms: {freedoms}{printed}"
        );
        let name = row.method.formulation;
        if groups.iter().any(|(names, _)| names.contains(&name)) {
            continue;
        }
        match groups.iter_mut().find(|(_, same)| *same == text) {
            Some((names, _)) => names.push(name),
            None => groups.push((vec![name], text)),
        }
    }
    groups.into_iter().map(|(names, text)| format!("{}: {text}.", names.join(", "))).collect()
}

/// A published error with two digits, or with all digits if there are more.
fn digits(x: f64) -> String {
    let (two, all) = (error(x), format!("{x:e}"));
    if all.len() > two.len() { all } else { two }
}

/// A published time [s].
fn time(x: f64) -> String {
    if x < 10.0 && x.fract() == 0.0 { format!("{x:.1}") } else { x.to_string() }
}

/// A record for every row, as CSV.
///
/// # Errors
///
/// The message of the writer.
pub(crate) fn csv(rows: &[Row]) -> Result<Vec<u8>, String> {
    let head = "table,scene,method,step_s,energy_error_j,energy_error_share,\
        reference_channel,reference_distance,cpu_s,coordinates,constraints,freedoms,reason,report_row,report_error,report_cpu_s";
    let record = |row: &Row| {
        let exact = match &row.outcome {
            Outcome::Completed(f) => {
                let exact = |x: f64| format!("{x:e}");
                let distance = row.distance().map(exact).unwrap_or_default();
                [exact(f.energy_error), exact(f.share()), distance, exact(f.seconds)]
            }
            _ => Default::default(),
        };
        let [energy, share, distance, cpu] = exact;
        let sizes = match &row.outcome {
            Outcome::Completed(figures) => figures.sizes.map(|n| n.to_string()),
            _ => Default::default(),
        };
        let [report_error, report_cpu] = row.report();
        [
            row.table.name,
            row.table.scene,
            row.method.name,
            &step(row.step),
            &energy,
            &share,
            row.table.reference.map_or("", |reference| reference.channel),
            &distance,
            &cpu,
            &sizes[0],
            &sizes[1],
            &sizes[2],
            &row.outcome.reason(),
            row.method.printed_name,
            &report_error,
            &report_cpu,
        ]
        .map(str::to_owned)
        .to_vec()
    };
    format::csv(head, rows.iter().map(record))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::super::report::TABLES;
    use super::*;

    /// A row of each kind.
    pub(crate) fn samples() -> Vec<Row> {
        let [t1, _, t2, ..] = &TABLES;
        let reference = t1.reference.unwrap().value;
        let tip = [reference[0] + 2.5e-2, reference[1]];
        let figures = Figures {
            energy_error: 4.636e-3,
            turned_over: 19.0,
            seconds: 0.0123,
            sizes: [4, 2, 2],
            outputs: [("tip".to_owned(), tip.to_vec())].into(),
            ..Figures::default()
        };
        let stopped = Outcome::Stopped {
            code: "not-converged".into(),
            message: "no convergence, \"try\" <less>".into(),
            time: 0.0082,
        };
        vec![
            Row::new(t1, &t1.methods[0], 1e-2, Outcome::Completed(figures)),
            Row::new(t1, &t1.methods[1], 1e-4, stopped),
            Row::new(t2, &t2.methods[3], 5e-2, Outcome::NotBuilt),
            Row::new(t2, &t2.methods[4], 5e-2, Outcome::Refused("singular & stuck".into())),
        ]
    }

    #[test]
    fn rows_stand_beside_the_report() {
        let rows = samples();
        assert_eq!(rows[0].ours(), ["4.6e-3", "2.4e-4", "2.5e-2", "0.012"]);
        assert_eq!(rows[0].report(), ["no convergence", ""]);
        assert_eq!(rows[1].report(), ["2.0e-5", "17.2"]);
        assert!(rows[1].outcome.reason().starts_with("not-converged at 0.0082 s: no convergence"));
        assert_eq!(rows[2].outcome.reason(), "not built");
        assert_eq!(rows[2].report(), ["", ""]);
        assert_eq!(rows[3].report(), ["does not work", ""]);
    }

    #[test]
    fn sizes_of_the_models_stand_beside_the_report() {
        let rows = samples();
        assert_eq!(
            sizes(rows[0].table, &rows[..2]),
            ["index-1: 4 coordinates, 2 constraints, freedoms: 2."]
        );
        let [.., t8] = &TABLES;
        let rows: Vec<_> = t8.methods[..4]
            .iter()
            .map(|m| Row::new(t8, m, 1e-3, rows[0].outcome.clone()))
            .collect();
        let lines = sizes(t8, &rows);
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert!(lines[0].starts_with("index-3, classical: 4 coord"), "{lines:?}");
        assert!(lines[0].ends_with("the report: 168 variables, 157 constraints and 1 guide, 11 freedoms with the guided one."));
    }

    #[test]
    fn csv_reads_back_with_its_quotes() {
        let bytes = csv(&samples()).unwrap();
        let mut reader = csv::Reader::from_reader(bytes.as_slice());
        let width = reader.headers().unwrap().len();
        let records: Vec<_> = reader.records().map(Result::unwrap).collect();
        assert_eq!(records.len(), 4);
        assert!(records.iter().all(|record| record.len() == width));
        assert_eq!(&records[0][4], "4.636e-3");
        assert!(records[1][12].ends_with("no convergence, \"try\" <less>"));
    }
}

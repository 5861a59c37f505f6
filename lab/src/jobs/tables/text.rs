//! The tables as text for a terminal.

use super::rows::{Row, by_table, sizes};
use crate::format::{paragraph, step};
use std::fmt::Write;

/// Widths of the columns: method, step, error, share, distance, time, the report's error and time.
const WIDTHS: [usize; 8] = [22, 7, 9, 9, 9, 8, 15, 8];

/// All tables.
pub(crate) fn text(rows: &[Row]) -> String {
    let mut text = String::new();
    for (table, rows) in by_table(rows) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}  {} ({})\n", table.name, table.title, table.source);
        let run =
            format!("Each row by mbs run scenes/{}.toml --formulation F --step H", table.scene);
        paragraph(&mut text, 0, &run);
        let (channel, off) =
            table.reference.map_or(("", ""), |reference| (reference.channel, "off by"));
        line(&mut text, ["", "dt", "error", "share", channel, "CPU", "report", "CPU"]);
        line(&mut text, ["", "[s]", "[J]", "[-]", off, "[s]", "error", "[s]"]);
        let mut last = "";
        for row in rows {
            if last != row.method.name && !last.is_empty() {
                text.push('\n');
            }
            last = row.method.name;
            let [mut error, share, distance, seconds] = row.ours();
            let mut reason = row.outcome.reason();
            // Few words stand in the row, more below it.
            if !reason.is_empty() && reason.len() <= WIDTHS[2] {
                error = std::mem::take(&mut reason);
            }
            let [report_error, report_seconds] = row.report();
            let (name, dt) = (row.method.name, step(row.step));
            let cells =
                [name, &dt, &error, &share, &distance, &seconds, &report_error, &report_seconds];
            line(&mut text, cells);
            if !reason.is_empty() {
                paragraph(&mut text, 30, &reason);
            }
        }
        text.push('\n');
        for sizes in sizes(table, rows) {
            paragraph(&mut text, 0, &sizes);
        }
        paragraph(&mut text, 0, table.note);
        text.push('\n');
    }
    paragraph(&mut text, 0, REMARK);
    text
}

/// What holds for all tables.
pub(crate) const REMARK: &str = "error: largest error of the energy invariant over every step; share: of the energy turned \
    over, the largest kinetic energy plus the work done; CPU: of the stepping. The report's times are those of its authors' machines.";

/// One line; names stand on the left of their columns, numbers on the right.
fn line(text: &mut String, cells: [&str; 8]) {
    let mut line = format!("{:<width$}", cells[0], width = WIDTHS[0]);
    for (cell, width) in cells.iter().zip(WIDTHS).skip(1) {
        let _ = write!(line, " {cell:>width$}");
    }
    let _ = writeln!(text, "{}", line.trim_end());
}

#[cfg(test)]
mod tests {
    use super::super::rows::tests::samples;

    #[test]
    fn text_has_every_row_and_its_reason() {
        let text = super::text(&samples());
        assert!(text.contains("T1  Double pendulum (publication 1, Table I)"));
        assert!(text.contains(
            "index-1                   1e-2    4.6e-3    2.4e-4    2.5e-2    0.012  no convergence\n"
        ));
        assert!(text.contains("2.0e-5     17.2\n"));
        assert!(text.contains("not-converged at 0.0082 s"));
        assert!(text.lines().all(|line| line.len() <= crate::format::PAGE), "{text}");
        assert!(text.contains("not built") && text.contains("refused: singular & stuck"));
    }
}

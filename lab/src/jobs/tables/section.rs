//! A table as a section: measured numbers beside the published ones, sizes, and reasons why runs stopped.

use super::report::Table;
use super::rows::{Row, sizes};
use crate::chart::Chart;
use crate::format::step;
use crate::lab::section::Section;
use crate::mbs::outcome::Outcome;

/// Remark that holds for all tables.
pub(crate) const REMARK: &str = "error: largest error of the energy invariant over every step; share: of the energy turned \
    over, the largest kinetic energy plus the work done; CPU: of the stepping. The report's times are those of its authors' machines.";

/// The section of a table with its rows and its drawing.
pub(crate) fn section(table: &Table, rows: &[Row], drawing: Option<(&Chart, &str)>) -> Section {
    let mut section = Section::new(table.name, table.title);
    let Table { name, source, scene, duration, .. } = table;
    section.words(format!(
        "{source}; scene {scene}, {duration} s; cargo xtask tables {name}, a row: mbs run scenes/{scene}.toml with its step and options."
    ));
    let distance = table.reference.map_or("", |reference| reference.label);
    let head = ["method, step [s]", "energy error [J]", "share of turnover", distance, "CPU [s]"];
    let head = [&head[..], &["report's error", "report's CPU [s]"]].concat();
    let is_shown = |i: usize| i != 3 || !distance.is_empty();
    let shown = |cells: Vec<String>| {
        cells.into_iter().enumerate().filter(|(i, _)| is_shown(*i)).map(|(_, cell)| cell).collect()
    };
    let named = |row: &Row| format!("{}, {}", row.method.name, step(row.step));
    let cells = |row: &Row| {
        let mut ours = row.ours();
        match &row.outcome {
            Outcome::Completed(_) => {}
            Outcome::Stopped { code, .. } => ours[0].clone_from(code),
            outcome => {
                outcome.reason().split(':').next().unwrap_or_default().clone_into(&mut ours[0])
            }
        }
        shown([vec![named(row)], ours.to_vec(), row.report().to_vec()].concat())
    };
    let head: Vec<_> = (0..head.len()).filter(|i| is_shown(*i)).map(|i| head[i]).collect();
    section.table(&head, rows.iter().map(cells).collect());
    if let Some((chart, caption)) = drawing {
        section.figure(chart, caption);
    }
    for row in rows.iter().filter(|row| !row.outcome.reason().is_empty()) {
        section.words(format!("{}: {}.", named(row), row.outcome.reason()));
    }
    for row in rows.chunk_by(|a, b| a.method.name == b.method.name).map(|rows| &rows[0]) {
        let printed = match row.method.printed_name {
            "" => String::new(),
            name => format!("; in the report {name}"),
        };
        section.words(format!("{}: {}{printed}.", row.method.name, row.method.options().join(" ")));
    }
    sizes(table, rows).into_iter().chain([table.note.to_owned()]).for_each(|s| section.words(s));
    section
}

#[cfg(test)]
mod tests {
    use super::super::rows::tests::samples;
    use super::*;
    use crate::lab::section::{page, text};

    #[test]
    fn text_and_page_have_every_row_and_its_reason_and_need_nothing_else() {
        let rows = samples();
        let sections = [&rows[..2], &rows[2..]].map(|rows| section(rows[0].table, rows, None));
        let (text, page) = (text(&sections), page("Tables", REMARK, &sections));
        assert!(text.contains("T1  Double pendulum") && text.contains("publication 1, Table I"));
        let line = ["index-1, 1e-2", "4.6e-3", "2.4e-4", "2.5e-2", "0.012", "no convergence"];
        let lines: Vec<_> =
            text.lines().map(|l| l.split_whitespace().collect::<Vec<_>>()).collect();
        assert!(lines.contains(&line.join(" ").split(' ').collect()), "{text}");
        assert!(text.contains("2.0e-5") && text.contains("17.2\n"));
        assert!(text.contains("not-converged at 0.0082 s"));
        assert!(text.contains("not built") && text.contains("refused: singular & stuck"));
        assert!(!page.contains("{{"), "every place is filled");
        assert!(!page.contains("http") && !page.contains("src="), "nothing is fetched");
        assert_eq!(page.matches("<section").count(), 2);
        assert_eq!(page.matches("data-label=\"CPU [s]\"").count(), 4);
        assert!(page.contains("no convergence, &quot;try&quot; &lt;less&gt;"));
        assert!(page.contains("singular &amp; stuck"));
        assert!(page.contains("<span class=\"number\">4.6e-3</span></td>"));
    }
}

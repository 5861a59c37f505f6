//! The tables as one HTML page that needs nothing else.

use super::report::Table;
use super::rows::{Row, by_table, sizes};
use super::text::REMARK;
use crate::format::step;
use crate::lab::section::Section;
use crate::mbs::outcome::Outcome;
use crate::page::{cell, escape, words};
use std::fmt::Write;

/// The page with all tables, and under some of them a figure; then what is made of sections.
pub(crate) fn page(rows: &[Row], drawings: &[(&str, String)], sections: &[Section]) -> String {
    let drawing = |table: &Table| {
        drawings.iter().find(|(name, _)| *name == table.name).map_or("", |(_, svg)| svg)
    };
    let tables: String =
        by_table(rows).map(|(table, rows)| section(table, rows, drawing(table))).collect();
    let sections: String = sections.iter().map(Section::html).collect();
    crate::page::page("The report's tables, run anew", REMARK, &(tables + &sections))
}

/// One table with its heading and note.
fn section(table: &Table, rows: &[Row], drawing: &str) -> String {
    let distance = table.reference.map_or("", |reference| reference.label);
    let mut html = format!(
        "<section class=\"card\">\n<h2><span class=\"tag\">{}</span> {}</h2>\n<p class=\"soft\">{}; scene \
         <code>{}</code>, {} s; <code>cargo xtask tables {}</code>, a row: <code>{}</code> with its step and options</p>\n<table>\n<thead>\n<tr><th rowspan=\"2\">method</th><th rowspan=\"2\">step [s]</th>\
         <th colspan=\"4\" class=\"group\">measured</th><th colspan=\"2\" class=\"group\">report</th></tr>\n<tr>\
         <th>energy error [J]</th><th>share of<br>turnover</th><th>{}</th><th>CPU [s]</th><th class=\"report\">error</th><th>CPU [s]</th></tr>\n\
         </thead>\n",
        escape(table.name),
        escape(table.title),
        escape(table.source),
        escape(table.scene),
        table.duration,
        escape(table.name),
        escape(&format!("mbs run scenes/{}.toml", table.scene)),
        escape(distance),
    );
    for rows in rows.chunk_by(|a, b| a.method.name == b.method.name) {
        html.push_str("<tbody>\n");
        for (i, row) in rows.iter().enumerate() {
            html.push_str(&line(row, distance, (i == 0).then_some(rows.len())));
        }
        html.push_str("</tbody>\n");
    }
    // Writing to a string cannot fail.
    let _ = writeln!(
        html,
        "</table>\n<p class=\"soft\">{}</p>\n<p class=\"soft\">{}</p>\n{}</section>",
        escape(&sizes(table, rows).join(" ")),
        escape(table.note),
        drawing
    );
    html
}

/// One row; the first of a method carries its name beside all of them.
fn line(row: &Row, distance: &str, span: Option<usize>) -> String {
    let mut html = String::from("<tr>");
    if let Some(span) = span {
        let (name, printed) = (escape(row.method.name), escape(row.method.printed_name));
        let printed =
            if printed.is_empty() { printed } else { format!("<small>report: {printed}</small>") };
        let options = escape(&row.method.options().join(" "));
        let _ = write!(
            html,
            "<th scope=\"rowgroup\" rowspan=\"{span}\">{name} {printed}<small><code>{options}</code></small></th>"
        );
    }
    html.push_str(&cell("step [s]", &step(row.step), "step"));
    if matches!(row.outcome, Outcome::Completed(_)) {
        let labels = ["energy error [J]", "share of turnover", distance, "CPU [s]"];
        for (label, value) in labels.iter().zip(row.ours()) {
            html.push_str(&cell(label, &value, ""));
        }
    } else {
        let kind = if row.outcome == Outcome::NotBuilt { "absent" } else { "stopped" };
        let reason = words(&row.outcome.reason());
        let _ = write!(
            html,
            "<td colspan=\"4\" data-label=\"measured\" class=\"{kind}\">{reason}</td>"
        );
    }
    let [error, seconds] = row.report();
    html.push_str(&cell("report's error", &error, "report divide"));
    html.push_str(&cell("report's CPU [s]", &seconds, "report"));
    html.push_str("</tr>\n");
    html
}

#[cfg(test)]
mod tests {
    use super::super::rows::tests::samples;

    #[test]
    fn page_has_every_row_escaped_and_needs_nothing_else() {
        let page = super::page(&samples(), &[("T1", "<figure>drawn</figure>".to_owned())], &[]);
        assert!(!page.contains("{{"), "every place is filled");
        assert!(!page.contains("http") && !page.contains("src="), "nothing is fetched");
        assert_eq!(page.matches("<section").count(), 2);
        assert_eq!(page.matches("<figure>drawn</figure>").count(), 1);
        assert_eq!(page.matches("data-label=\"step [s]\"").count(), 4);
        assert!(page.contains("no convergence, &quot;try&quot; &lt;less&gt;"));
        assert!(page.contains("singular &amp; stuck"));
        assert!(page.contains("class=\"absent\">not built<"));
        assert!(page.contains("<span class=\"number\">4.6e-3</span></td>"));
    }
}

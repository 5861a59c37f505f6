//! The tables as one HTML page that needs nothing else.

use super::outcome::Outcome;
use super::report::Table;
use super::rows::{Row, by_table, sizes, step};
use super::text::REMARK;
use std::fmt::Write;

/// The page around the tables, with its style.
const PAGE: &str = include_str!("page.html");

/// The page with all tables, and under some of them a drawing.
pub(crate) fn page(rows: &[Row], drawings: &[(&str, String)]) -> String {
    let drawing = |table: &Table| {
        drawings.iter().find(|(name, _)| *name == table.name).map_or("", |(_, svg)| svg)
    };
    let tables: String =
        by_table(rows).map(|(table, rows)| section(table, rows, drawing(table))).collect();
    PAGE.replace("{{remark}}", &escape(REMARK)).replace("{{tables}}", &tables)
}

/// One table with its heading and note.
fn section(table: &Table, rows: &[Row], drawing: &str) -> String {
    let distance = table.reference.map_or("", |reference| reference.label);
    let mut html = format!(
        "<section class=\"card\">\n<h2><span class=\"tag\">{}</span> {}</h2>\n<p class=\"soft\">{}; scene \
         <code>{}</code>, {} s</p>\n<table>\n<thead>\n<tr><th rowspan=\"2\">method</th><th rowspan=\"2\">step [s]</th>\
         <th colspan=\"4\" class=\"group\">measured</th><th colspan=\"2\" class=\"group\">report</th></tr>\n<tr>\
         <th>energy error [J]</th><th>share of<br>turnover</th><th>{}</th><th>CPU [s]</th><th class=\"report\">error</th><th>CPU [s]</th></tr>\n\
         </thead>\n",
        escape(table.name),
        escape(table.title),
        escape(table.source),
        escape(table.scene),
        table.duration,
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
        figure(drawing)
    );
    html
}

/// A drawing with its caption, if there is one.
fn figure(drawing: &str) -> String {
    if drawing.is_empty() {
        return String::new();
    }
    format!(
        "<figure>{drawing}<figcaption class=\"soft\">Each method at its first step; grey, the first method at its last one.\
         </figcaption></figure>\n"
    )
}

/// One row; the first of a method carries its name beside all of them.
fn line(row: &Row, distance: &str, span: Option<usize>) -> String {
    let mut html = String::from("<tr>");
    if let Some(span) = span {
        let (name, printed) = (escape(row.method.name), escape(row.method.printed_name));
        let printed =
            if printed.is_empty() { printed } else { format!("<small>report: {printed}</small>") };
        let _ = write!(html, "<th scope=\"rowgroup\" rowspan=\"{span}\">{name} {printed}</th>");
    }
    html.push_str(&cell("step [s]", &step(row.step), "step"));
    if matches!(row.outcome, Outcome::Completed(_)) {
        let labels = ["energy error [J]", "share of turnover", distance, "CPU [s]"];
        for (label, value) in labels.iter().zip(row.ours()) {
            html.push_str(&cell(label, &value, ""));
        }
    } else {
        let kind = if row.outcome == Outcome::NotBuilt { "absent" } else { "stopped" };
        let reason = words(&row.reason());
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

/// One cell; its label is shown where the columns do not fit.
fn cell(label: &str, value: &str, class: &str) -> String {
    let class = if value.is_empty() { format!("{class} none") } else { class.to_owned() };
    let (label, value) = (escape(label), escape(value));
    format!("<td data-label=\"{label}\" class=\"{class}\">{value}</td>")
}

/// A sentence whose numbers are not broken at the sign of their exponent.
fn words(sentence: &str) -> String {
    let is_number =
        |word: &str| word.contains("e-") && word.starts_with(|c: char| c.is_ascii_digit());
    let word = |word: &str| {
        let text = escape(word);
        if is_number(word) { format!("<span class=\"number\">{text}</span>") } else { text }
    };
    sentence.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

/// Text as HTML.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::super::rows::tests::samples;

    #[test]
    fn page_has_every_row_escaped_and_needs_nothing_else() {
        let page = super::page(&samples(), &[("T1", "<svg>drawn</svg>".to_owned())]);
        assert!(!page.contains("{{"), "every place is filled");
        assert!(!page.contains("http") && !page.contains("src="), "nothing is fetched");
        assert_eq!(page.matches("<section").count(), 2);
        assert_eq!(page.matches("<svg>drawn</svg><figcaption").count(), 1);
        assert_eq!(page.matches("data-label=\"step [s]\"").count(), 4);
        assert!(page.contains("no convergence, &quot;try&quot; &lt;less&gt;"));
        assert!(page.contains("singular &amp; stuck"));
        assert_eq!(super::words("2.5e-11 m < 3"), "<span class=\"number\">2.5e-11</span> m &lt; 3");
        assert!(page.contains("class=\"absent\">not built<"));
        assert!(page.contains(">4.6e-3</td>"));
    }
}

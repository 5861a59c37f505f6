//! What an experiment says: sentences, tables, drawings and claims, for a terminal and for a page.

use super::Run;
use crate::chart::Chart;
use crate::format::paragraph;
use crate::page::{cell, escape, figure, words};
use std::fmt::Write;

/// A claim and what the runs say of it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Claim {
    /// What is claimed.
    pub(crate) what: String,
    /// What was measured.
    pub(crate) measured: String,
    /// Does it hold? `None` where the runs do not say.
    pub(crate) holds: Option<bool>,
}

impl Claim {
    /// Its verdict.
    pub(crate) fn verdict(&self) -> &'static str {
        match self.holds {
            Some(true) => "holds",
            Some(false) => "does not hold",
            None => "not judged",
        }
    }

    fn class(&self) -> &'static str {
        match self.holds {
            Some(true) => "holds",
            Some(false) => "fails",
            None => "open",
        }
    }
}

/// A part of a section.
#[derive(Debug, Clone, PartialEq)]
enum Block {
    Heading(String),
    Words(String),
    Table(Vec<String>, Vec<Vec<String>>),
    /// A table whose cells lead to rows of another on the page.
    Leading(Vec<&'static str>, Vec<Vec<Leading>>),
    /// A table that is on the page alone, behind its title; rows that are led to have names.
    Behind(String, Vec<&'static str>, Vec<Vec<String>>, Vec<String>),
    Claim(Claim),
    /// A drawing, and its caption.
    Figure(String, String),
}

/// A cell that leads to a named row of another table on the page.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Leading {
    /// What stands in the cell.
    pub(crate) text: String,
    /// The name of the row, or empty.
    pub(crate) to: String,
}

/// An experiment.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Section {
    /// Its name on the command line.
    pub(crate) name: &'static str,
    /// What it is about.
    pub(crate) title: &'static str,
    /// All its runs.
    pub(crate) runs: Vec<Run>,
    blocks: Vec<Block>,
}

impl Section {
    /// An empty one.
    pub(crate) fn new(name: &'static str, title: &'static str) -> Self {
        Self { name, title, runs: Vec::new(), blocks: Vec::new() }
    }

    /// Adds a heading.
    pub(crate) fn heading(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Heading(text.into()));
    }

    /// Adds sentences.
    pub(crate) fn words(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Words(text.into()));
    }

    /// Adds a table; its first column has names.
    pub(crate) fn table(&mut self, head: &[&str], rows: Vec<Vec<String>>) {
        let head = head.iter().map(|&name| name.to_owned()).collect();
        self.blocks.push(Block::Table(head, rows));
    }

    /// Adds a long table that opens on the page at a touch, and is not on a terminal.
    pub(crate) fn behind(&mut self, title: &str, head: &[&'static str], rows: Vec<Vec<String>>) {
        self.blocks.push(Block::Behind(title.to_owned(), head.to_vec(), rows, Vec::new()));
    }

    /// The same with names of the rows that other tables lead to, or empty ones.
    pub(crate) fn behind_named(
        &mut self,
        title: &str,
        head: &[&'static str],
        (rows, names): (Vec<Vec<String>>, Vec<String>),
    ) {
        self.blocks.push(Block::Behind(title.to_owned(), head.to_vec(), rows, names));
    }

    /// Adds a table whose cells lead to named rows; its first column has names.
    pub(crate) fn leading(&mut self, head: &[&'static str], rows: Vec<Vec<Leading>>) {
        self.blocks.push(Block::Leading(head.to_vec(), rows));
    }

    /// Adds a claim.
    pub(crate) fn claim(&mut self, what: impl Into<String>, measured: String, holds: Option<bool>) {
        self.blocks.push(Block::Claim(Claim { what: what.into(), measured, holds }));
    }

    /// Adds a drawing with its caption; where there is nothing to draw, that is said.
    pub(crate) fn figure(&mut self, chart: &Chart, caption: &str) {
        self.blocks.push(match figure(chart, caption) {
            Ok(html) => Block::Figure(html, caption.to_owned()),
            Err(why) => Block::Words(format!("No drawing: {why}.")),
        });
    }

    /// Its claims.
    pub(crate) fn claims(&self) -> impl Iterator<Item = &Claim> {
        self.blocks.iter().filter_map(|block| match block {
            Block::Claim(claim) => Some(claim),
            _ => None,
        })
    }

    /// As text, with the captions of the drawings.
    pub(crate) fn text(&self) -> String {
        let mut text = format!("{}  {}\n\n", self.name, self.title);
        for block in &self.blocks {
            match block {
                Block::Heading(heading) => text.push_str(&format!("\n{heading}\n")),
                Block::Words(sentences) => paragraph(&mut text, 0, sentences),
                Block::Table(head, rows) => grid(&mut text, &borrowed(head), rows),
                Block::Leading(head, rows) => {
                    let row = |row: &Vec<Leading>| row.iter().map(|c| c.text.clone()).collect();
                    grid(&mut text, head, &rows.iter().map(row).collect::<Vec<_>>());
                }
                Block::Claim(claim) => {
                    let sentence =
                        format!("{}: {} ({})", claim.what, claim.measured, claim.verdict());
                    paragraph(&mut text, 2, &sentence);
                }
                Block::Figure(_, caption) => paragraph(&mut text, 0, caption),
                Block::Behind(..) => {}
            }
        }
        text
    }

    /// As a part of a page.
    pub(crate) fn html(&self) -> String {
        let mut html = format!(
            "<section class=\"card\" id=\"{0}\">\n<h2><span class=\"tag\">{0}</span> {1}</h2>\n",
            escape(self.name),
            escape(self.title)
        );
        for block in &self.blocks {
            match block {
                Block::Heading(heading) => {
                    html.push_str(&format!("<h3>{}</h3>\n", escape(heading)));
                }
                Block::Words(sentences) => {
                    html.push_str(&format!("<p>{}</p>\n", words(sentences)));
                }
                Block::Table(head, rows) => html.push_str(&table(&borrowed(head), rows, &[])),
                Block::Leading(head, rows) => html.push_str(&leading(head, rows)),
                Block::Claim(claim) => {
                    html.push_str(&format!("<ul class=\"claims\">{}</ul>\n", item(claim)));
                }
                Block::Figure(figure, _) => html.push_str(figure),
                Block::Behind(title, head, rows, names) => html.push_str(&format!(
                    "<details>\n<summary>{}</summary>\n{}</details>\n",
                    escape(title),
                    table(head, rows, names)
                )),
            }
        }
        html + "</section>\n"
    }
}

/// A claim as an item of a list.
pub(crate) fn item(claim: &Claim) -> String {
    format!(
        "<li class=\"{}\"><b>{}:</b> {}. <span class=\"soft\">{}</span></li>",
        claim.class(),
        claim.verdict(),
        words(&claim.what),
        words(&claim.measured)
    )
}

/// The beginning of a table on a page.
fn opened(head: &[&str]) -> String {
    let heads: String = head.iter().map(|name| format!("<th>{}</th>", words(name))).collect();
    format!("<table>\n<thead><tr>{heads}</tr></thead>\n<tbody>\n")
}

/// A table on a page whose cells lead elsewhere; in the first column are names.
fn leading(head: &[&str], rows: &[Vec<Leading>]) -> String {
    let mut html = opened(head);
    for row in rows {
        html.push_str("<tr>");
        for (i, (label, Leading { text, to })) in head.iter().zip(row).enumerate() {
            html.push_str(&match (i, to.is_empty()) {
                (0, _) => format!("<th scope=\"row\">{}</th>", words(text)),
                (_, true) => cell(label, text, ""),
                (_, false) => format!(
                    "<td data-label=\"{}\"><a href=\"#{}\">{}</a></td>",
                    escape(label),
                    escape(to),
                    words(text)
                ),
            });
        }
        html.push_str("</tr>\n");
    }
    html + "</tbody>\n</table>\n"
}

/// Names as slices.
fn borrowed(names: &[String]) -> Vec<&str> {
    names.iter().map(String::as_str).collect()
}

/// A table on a page; in the first column are names, and rows may have names that are led to.
fn table(head: &[&str], rows: &[Vec<String>], names: &[String]) -> String {
    let mut html = opened(head);
    for (i, row) in rows.iter().enumerate() {
        html.push_str(&match names.get(i).filter(|name| !name.is_empty()) {
            Some(name) => format!("<tr id=\"{}\">", escape(name)),
            None => "<tr>".to_owned(),
        });
        for (i, (label, value)) in head.iter().zip(row).enumerate() {
            html.push_str(&match i {
                0 => format!("<th scope=\"row\">{}</th>", words(value)),
                // What came instead of numbers.
                _ if row.len() < head.len() => format!(
                    "<td colspan=\"{}\" data-label=\"\" class=\"stopped\">{}</td>",
                    head.len() - 1,
                    words(value)
                ),
                _ => cell(label, value, ""),
            });
        }
        html.push_str("</tr>\n");
    }
    html + "</tbody>\n</table>\n"
}

/// A table on a terminal; a row that is shorter than the head has a sentence instead of numbers.
fn grid(text: &mut String, head: &[&str], rows: &[Vec<String>]) {
    let full = || rows.iter().filter(|row| row.len() == head.len());
    let wide = |i: usize| full().map(|row| row[i].len()).chain([head[i].len()]).max().unwrap_or(0);
    let first = rows.iter().map(|row| row[0].len()).max().unwrap_or(0);
    let line = |cells: &mut dyn Iterator<Item = &str>| {
        let cell = |(i, cell): (usize, &str)| match i {
            0 => format!("{cell:<width$}", width = wide(0).max(first)),
            _ => format!("  {cell:>width$}", width = wide(i)),
        };
        cells.enumerate().map(cell).collect::<String>()
    };
    text.push('\n');
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{}", line(&mut head.iter().copied()).trim_end());
    for row in rows {
        if row.len() < head.len() {
            paragraph(text, 0, &row.join(": "));
        } else {
            let _ = writeln!(text, "{}", line(&mut row.iter().map(String::as_str)).trim_end());
        }
    }
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_says_the_same_on_a_terminal_and_on_a_page() {
        let mut section = Section::new("X", "An experiment");
        section.words("First a word & another.");
        let row = |cells: &[&str]| cells.iter().map(|&cell| cell.to_owned()).collect();
        let rows = vec![row(&["index-3", "1.0e-3", "0.2"]), row(&["index-1", "stopped at 1 s"])];
        section.table(&["run", "error [J]", "CPU [s]"], rows);
        section.claim("a fourth of the time", "ratio 0.3".into(), Some(false));
        section.claim("a tenth", "no run".into(), None);
        section.behind("every run", &["run"], vec![row(&["hidden"])]);
        let text = section.text();
        assert!(!text.contains("hidden"), "long tables are on the page alone");
        for line in [
            "run      error [J]  CPU [s]",
            "index-3     1.0e-3      0.2",
            "index-1: stopped at 1 s",
        ] {
            assert!(text.contains(line), "{text}");
        }
        assert!(text.contains("a fourth of the time: ratio 0.3 (does not hold)"));
        let html = section.html();
        assert!(html.contains("a word &amp; another") && html.contains("class=\"fails\""));
        assert!(html.contains("colspan=\"2\"") && html.contains("<b>not judged:</b>"));
        assert!(html.contains("<summary>every run</summary>") && html.contains("hidden"));
        assert_eq!(section.claims().count(), 2);
    }
}

//! Sections of experiments: sentences, tables, drawings and claims, for a terminal and for a page.

use super::Run;
use crate::chart::Chart;
use crate::format::escape;
use crate::format::paragraph;
use crate::page::{figure, words};
use std::fmt::Write;

/// Number of letters up to which a cell is not broken into lines.
const LONG: usize = 16;

/// A claim, with its measurement and its verdict.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Claim {
    /// Statement that is claimed.
    pub(crate) what: String,
    /// Measurement on which the claim is based.
    pub(crate) measured: String,
    /// True if the claim holds; `None` if the runs do not show it.
    pub(crate) holds: Option<bool>,
}

impl Claim {
    /// Returns the verdict on the claim.
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
    /// A table of a section. With a title it is only on the page, where it opens on request.
    Table(Option<String>, Vec<String>, Vec<Vec<String>>),
    Claim(Claim),
    /// A drawing, and its caption.
    Figure(String, String),
}

/// An experiment with its results.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Section {
    /// Name of the experiment on the command line.
    pub(crate) name: &'static str,
    /// Title of the experiment.
    pub(crate) title: &'static str,
    /// Runs of the experiment, all of them.
    pub(crate) runs: Vec<Run>,
    blocks: Vec<Block>,
}

impl Section {
    /// Makes an empty section.
    pub(crate) fn new(name: &'static str, title: &'static str) -> Self {
        Self { name, title, runs: Vec::new(), blocks: Vec::new() }
    }

    /// Adds a heading to the section.
    pub(crate) fn heading(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Heading(text.into()));
    }

    /// Adds sentences to the section.
    pub(crate) fn words(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Words(text.into()));
    }

    /// Adds a table, whose first column has names. On the page a cell is a link to a row of the next table with a title: the first row that
    /// is named after the cell's row and column.
    pub(crate) fn table(&mut self, head: &[&str], rows: Vec<Vec<String>>) {
        self.blocks.push(Block::Table(None, owned(head), rows));
    }

    /// Adds a long table that opens on the page on request, and is not shown on a terminal.
    pub(crate) fn behind(&mut self, title: &str, head: &[&str], rows: Vec<Vec<String>>) {
        self.blocks.push(Block::Table(Some(title.to_owned()), owned(head), rows));
    }

    /// Adds a claim with its measurement and whether it holds.
    pub(crate) fn claim(&mut self, what: impl Into<String>, measured: String, holds: Option<bool>) {
        self.blocks.push(Block::Claim(Claim { what: what.into(), measured, holds }));
    }

    /// Adds a drawing with its caption; if there is nothing to draw, a sentence.
    pub(crate) fn figure(&mut self, chart: &Chart, caption: &str) {
        self.blocks.push(match figure(chart, caption) {
            Ok(html) => Block::Figure(html, caption.to_owned()),
            Err(why) => Block::Words(format!("No drawing: {why}.")),
        });
    }

    /// Returns the claims of the section.
    pub(crate) fn claims(&self) -> impl Iterator<Item = &Claim> {
        self.blocks.iter().filter_map(|block| match block {
            Block::Claim(claim) => Some(claim),
            _ => None,
        })
    }

    /// Writes the section as text, with the captions of the drawings.
    pub(crate) fn text(&self) -> String {
        let mut text = format!("{}  {}\n\n", self.name, self.title);
        for block in &self.blocks {
            match block {
                Block::Heading(heading) => text.push_str(&format!("\n{heading}\n")),
                Block::Words(sentences) => paragraph(&mut text, 0, sentences),
                Block::Table(None, head, rows) => grid(&mut text, head, rows),
                Block::Table(Some(_), ..) => {}
                Block::Claim(claim) => {
                    let sentence =
                        format!("{}: {} ({})", claim.what, claim.measured, claim.verdict());
                    paragraph(&mut text, 2, &sentence);
                }
                Block::Figure(_, caption) => paragraph(&mut text, 0, caption),
            }
        }
        text
    }

    /// Writes the section as a part of a page.
    pub(crate) fn html(&self) -> String {
        let mut html = format!(
            "<section class=\"card\" id=\"{0}\">\n<h2><span class=\"tag\">{0}</span> {1}</h2>\n",
            escape(self.name),
            escape(self.title)
        );
        for (at, block) in self.blocks.iter().enumerate() {
            html.push_str(&match block {
                Block::Heading(heading) => format!("<h3>{}</h3>\n", escape(heading)),
                Block::Words(sentences) => format!("<p>{}</p>\n", words(sentences)),
                Block::Table(None, head, rows) => self.table_at(at, head, rows),
                Block::Table(Some(title), head, rows) => format!(
                    "<details>\n<summary>{}</summary>\n{}</details>\n",
                    escape(title),
                    self.table_at(at, head, rows)
                ),
                Block::Claim(claim) => format!("<ul class=\"claims\">{}</ul>\n", item(claim)),
                Block::Figure(figure, _) => figure.clone(),
            });
        }
        html + "</section>\n"
    }

    /// A table on the page. A row that is shorter than the head has a sentence instead of numbers.
    fn table_at(&self, at: usize, head: &[String], rows: &[Vec<String>]) -> String {
        let (before, from) = self.blocks.split_at(at);
        let behind = |block: &Block| matches!(block, Block::Table(Some(_), ..));
        let group = before.iter().filter(|block| behind(block)).count();
        let id = |name: &str| {
            let text = format!("{} {group} {name}", self.name);
            text.replace(|c: char| !c.is_ascii_alphanumeric(), "-")
        };
        let next = from.iter().find(|block| behind(block));
        let named = |name: &str| match next {
            Some(Block::Table(_, _, rows)) => rows.iter().position(|row| row[0] == name),
            _ => None,
        };
        let heads: String = head.iter().map(|name| format!("<th>{}</th>", words(name))).collect();
        let mut html = format!("<table>\n<thead><tr>{heads}</tr></thead>\n<tbody>\n");
        for (i, row) in rows.iter().enumerate() {
            let is_led_to = behind(&from[0]) && named(&row[0]) == Some(i);
            let name = if is_led_to { format!(" id=\"{}\"", id(&row[0])) } else { String::new() };
            html.push_str(&format!("<tr{name}><th scope=\"row\">{}</th>", words(&row[0])));
            if row.len() < head.len() {
                let (n, reason) = (head.len() - 1, words(&row[1]));
                html.push_str(&format!("<td colspan=\"{n}\" class=\"stopped\">{reason}</td>"));
            } else {
                html.extend(head.iter().zip(row).skip(1).map(|(label, value)| {
                    let name = format!("{}, {label}", row[0]);
                    cell(label, value, named(&name).map(|_| id(&name)))
                }));
            }
            html.push_str("</tr>\n");
        }
        html + "</tbody>\n</table>\n"
    }
}

/// Writes a cell of a table. Its label is shown if the page is too narrow for the columns. The cell may be a link to a row.
fn cell(label: &str, value: &str, to: Option<String>) -> String {
    // on a narrow page words may be broken, numbers not
    let class = match value {
        "" => "none",
        _ if value.len() > LONG && value.contains(' ') => "said",
        _ => "",
    };
    let text = match to {
        Some(to) => format!("<a href=\"#{to}\">{}</a>", words(value)),
        None => words(value),
    };
    format!("<td data-label=\"{}\" class=\"{class}\">{text}</td>", escape(label))
}

/// Makes a page of sections.
pub(crate) fn page(title: &str, remark: &str, sections: &[Section]) -> String {
    let parts: String = sections.iter().map(Section::html).collect();
    crate::page::page(title, remark, &parts)
}

/// Writes sections for a terminal.
pub(crate) fn text(sections: &[Section]) -> String {
    sections.iter().map(|section| section.text() + "\n").collect()
}

/// Copies the names of columns.
fn owned(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

/// A claim as an item of a list.
fn item(claim: &Claim) -> String {
    format!(
        "<li class=\"{}\"><b>{}:</b> {}. <span class=\"soft\">{}</span></li>",
        claim.class(),
        claim.verdict(),
        words(&claim.what),
        words(&claim.measured)
    )
}

/// A table on a terminal. A row that is shorter than the head has a sentence instead of numbers.
fn grid(text: &mut String, head: &[String], rows: &[Vec<String>]) {
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
    // writing to a string cannot fail
    let _ = writeln!(text, "{}", line(&mut head.iter().map(String::as_str)).trim_end());
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
        let hidden = vec![row(&["hidden"]), row(&["index-3, CPU [s]"])];
        section.behind("every run", &["run"], hidden);
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
        assert!(html.contains("<a href=\"#X-0-index-3--CPU--s-\">0.2</a>"), "{html}");
        assert!(html.contains("<tr id=\"X-0-index-3--CPU--s-\">"));
        assert_eq!(section.claims().count(), 2);
    }
}

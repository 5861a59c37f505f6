//! A table with a title, as text and as a card of a page.

use crate::text::escape;
use core::fmt::Write;

/// Largest number of letters of a cell in a normal row. If a cell is longer, the cells of its row are shown below each other on a narrow
/// screen. Chosen, not tuned.
const MAX_CELL: usize = 60;

/// Table with a title.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Section {
    /// Title of the table.
    pub title: String,
    /// Caption that explains the numbers in one or two sentences; may be empty.
    pub caption: String,
    /// Names of the columns. If they are empty, the first column names the values in the others.
    pub head: Vec<String>,
    /// The cells, row by row.
    pub rows: Vec<Vec<String>>,
    /// Bars in a column: the index of the column, and a length from 0 to 1 for each row.
    pub bars: Option<(usize, Vec<f64>)>,
    /// True if the table is shown on the page only, and not in the terminal.
    pub is_detail: bool,
    /// True if the table is folded under its title on the page.
    pub is_folded: bool,
}

/// Returns a row with a label and its value.
pub(crate) fn row(label: &str, value: String) -> Vec<String> {
    vec![label.to_owned(), value]
}

impl Section {
    /// Creates a table; `head` has the names of its columns or is empty.
    pub(crate) fn new(title: &str, head: &[&str], rows: Vec<Vec<String>>) -> Self {
        let head = head.iter().map(|&name| name.to_owned()).collect();
        Self { title: title.to_owned(), head, rows, ..Self::default() }
    }

    /// Creates the table of provenance.
    pub(crate) fn made<'a>(rows: impl Iterator<Item = [&'a str; 2]>) -> Self {
        let rows = rows.map(|[label, value]| row(label, value.to_owned()));
        Self::new("How this was made", &[], rows.collect())
    }

    /// Returns the table with a mark that folds it on a page.
    pub(crate) fn folded(self) -> Self {
        Self { is_folded: true, ..self }
    }

    pub(crate) fn write_text(&self, out: &mut String) {
        let head = Some(&self.head).filter(|head| !head.is_empty());
        let rows = || head.into_iter().chain(&self.rows);
        let n = rows().map(Vec::len).max().unwrap_or(0);
        let width = |c: usize| rows().filter_map(|r| r.get(c)).map(|x| x.chars().count()).max();
        let widths: Vec<usize> = (0..n).map(|c| width(c).unwrap_or(0)).collect();
        for row in rows() {
            let cells = row.iter().zip(&widths).map(|(x, w)| format!("{x:<w$}"));
            let line = cells.collect::<Vec<_>>().join("  ");
            let _ = writeln!(out, "  {}", line.trim_end());
        }
        for line in wrapped(&self.caption, 100) {
            let _ = writeln!(out, "  {line}");
        }
    }

    pub(crate) fn write_card(&self, out: &mut String) {
        if self.rows.is_empty() {
            return;
        }
        let title = match self.title.as_str() {
            "" => String::new(),
            title => format!("<h2>{}</h2>", escape(title)),
        };
        let _ = writeln!(out, "<section class=\"card\">{title}");
        let is_long = |cell: &String| cell.chars().count() > MAX_CELL;
        let has_texts = !self.head.is_empty() && self.rows.iter().flatten().any(is_long);
        let class = match (self.head.is_empty(), has_texts) {
            (true, _) => "",
            (_, true) => " class=\"grid texts\"",
            (_, false) => " class=\"grid\"",
        };
        let _ = writeln!(out, "<div class=\"wide\"><table{class}>");
        if !self.head.is_empty() {
            let cells = self.head.iter().map(|x| format!("<th scope=\"col\">{}</th>", escape(x)));
            let _ = writeln!(out, "<thead><tr>{}</tr></thead>", cells.collect::<String>());
        }
        for (i, row) in self.rows.iter().enumerate() {
            let label = |c: usize| self.head.get(c).filter(|x| has_texts && !x.is_empty());
            let cells = row.iter().enumerate().map(|(c, x)| self.cell((i, c), x, label(c)));
            let _ = writeln!(out, "<tr>{}</tr>", cells.collect::<String>());
        }
        out.push_str("</table></div>\n");
        if !self.caption.is_empty() {
            let _ = writeln!(out, "<p class=\"caption\">{}</p>", escape(&self.caption));
        }
        out.push_str("</section>\n");
    }

    /// Returns the HTML of a cell. It includes the name of the column, which narrow screens show beside the cell.
    fn cell(&self, (row, column): (usize, usize), text: &str, label: Option<&String>) -> String {
        let text = escape(text);
        let label = label.map_or_else(String::new, |x| format!(" data-label=\"{}: \"", escape(x)));
        match &self.bars {
            Some((of, lengths)) if *of == column => {
                let length = lengths.get(row).copied().unwrap_or(0.0).clamp(0.0, 1.0);
                let percent = 100.0 * length;
                format!("<td{label}>{text}<i class=\"bar\" style=\"width:{percent:.1}%\"></i></td>")
            }
            _ => format!("<td{label}>{text}</td>"),
        }
    }
}

/// Breaks a text into lines of fewer than `width` characters. A single longer word is not broken.
pub(crate) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + word.chars().count() < width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

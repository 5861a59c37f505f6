//! A table with rows that open without scripts. Each row contains another table.

use crate::table::Section;
use crate::text::escape;
use core::fmt::Write;

/// A table whose rows can be opened.
#[derive(Debug, Default)]
pub(crate) struct OpenRows {
    /// Names of the columns.
    pub(crate) head: Vec<String>,
    /// Cells of each row, and the table that the row contains.
    pub(crate) rows: Vec<(Vec<String>, Section)>,
    pub(crate) caption: String,
}

impl OpenRows {
    pub(super) fn write(&self, out: &mut String) {
        let cells = |cells: &[String]| {
            cells.iter().map(|cell| format!("<span>{}</span>", escape(cell))).collect::<String>()
        };
        // writing to a String cannot fail
        let _ = writeln!(
            out,
            "<div class=\"wide\"><div class=\"rows\" style=\"--n: {}\"><div class=\"row head\">{}</div>",
            self.head.len(),
            cells(&self.head)
        );
        for (row, inner) in &self.rows {
            let _ = write!(out, "<details><summary class=\"row\">{}</summary>", cells(row));
            inner.write_card(out);
            out.push_str("</details>\n");
        }
        let _ = writeln!(out, "</div></div><p class=\"caption\">{}</p>", escape(&self.caption));
    }
}

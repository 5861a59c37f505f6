//! A report: titled tables, for the terminal as text and for a browser as one HTML file.

use crate::page::{Page, PageSection, escape};
use core::fmt::Write;
use mbs::record::Provenance;

/// What stands in a report.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Report {
    /// Title.
    pub title: String,
    /// What went wrong, if anything did.
    pub error: Option<String>,
    /// The tables, in order.
    pub sections: Vec<Section>,
    /// How it was made.
    pub provenance: Provenance,
}

/// A titled table.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Section {
    /// Title.
    pub title: String,
    /// What the numbers mean, in one or two sentences; may be empty.
    pub caption: String,
    /// Names of the columns; empty: the first column names what the others say.
    pub head: Vec<String>,
    /// The cells, row by row.
    pub rows: Vec<Vec<String>>,
    /// Bars of a column: its number, and a length from 0 to 1 for each row.
    pub bars: Option<(usize, Vec<f64>)>,
    /// Stands on the page only.
    pub is_detail: bool,
}

impl Report {
    /// As text, columns aligned.
    ///
    /// # Examples
    /// ```
    /// use mbs_report::{Report, Section};
    /// let rows = vec![vec!["bodies".into(), "2".into()], vec!["joints".into(), "3".into()]];
    /// let section = Section { title: "sizes".into(), rows, ..Section::default() };
    /// let report = Report { title: "pendulum".into(), sections: vec![section], ..Report::default() };
    /// assert_eq!(report.text(), "pendulum\n\nsizes\n  bodies  2\n  joints  3\n");
    /// ```
    #[must_use]
    pub fn text(&self) -> String {
        let mut out = format!("{}\n", self.title);
        for section in self.sections.iter().filter(|section| !section.is_detail) {
            // Writing into a String has nothing to fail on.
            let _ = writeln!(out, "\n{}", section.title);
            section.write_text(&mut out);
        }
        out
    }

    /// As one HTML file without references to anything outside; it needs no script.
    #[must_use]
    pub fn page(&self) -> String {
        let error = self.error.as_ref().map(|error| PageSection::Error(format!("The run {error}")));
        let tables = self.sections.iter().cloned().map(PageSection::Table);
        let made = PageSection::Table(Section::made(self.provenance.rows()));
        let sections = error.into_iter().chain(tables).chain([made]).collect();
        Page { title: self.title.clone(), sections, pack: None }.html()
    }
}

/// A label and its value as a row.
pub(crate) fn row(label: &str, value: String) -> Vec<String> {
    vec![label.to_owned(), value]
}

impl Section {
    /// A table, with the names of its columns or none.
    pub(crate) fn new(title: &str, head: &[&str], rows: Vec<Vec<String>>) -> Self {
        let head = head.iter().map(|&name| name.to_owned()).collect();
        Self { title: title.to_owned(), head, rows, ..Self::default() }
    }

    /// How something was made.
    pub(crate) fn made<'a>(rows: impl Iterator<Item = [&'a str; 2]>) -> Self {
        let rows = rows.map(|[label, value]| row(label, value.to_owned()));
        Self::new("How this was made", &[], rows.collect())
    }

    fn write_text(&self, out: &mut String) {
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
        let _ = writeln!(out, "<section class=\"card\"><h2>{}</h2>", escape(&self.title));
        let class = if self.head.is_empty() { "" } else { " class=\"grid\"" };
        let _ = writeln!(out, "<div class=\"wide\"><table{class}>");
        if !self.head.is_empty() {
            let cells = self.head.iter().map(|x| format!("<th scope=\"col\">{}</th>", escape(x)));
            let _ = writeln!(out, "<thead><tr>{}</tr></thead>", cells.collect::<String>());
        }
        for (i, row) in self.rows.iter().enumerate() {
            let cells = row.iter().enumerate().map(|(c, x)| self.cell(i, c, x));
            let _ = writeln!(out, "<tr>{}</tr>", cells.collect::<String>());
        }
        out.push_str("</table></div>\n");
        if !self.caption.is_empty() {
            let _ = writeln!(out, "<p class=\"caption\">{}</p>", escape(&self.caption));
        }
        out.push_str("</section>\n");
    }

    fn cell(&self, row: usize, column: usize, text: &str) -> String {
        let text = escape(text);
        match &self.bars {
            Some((of, lengths)) if *of == column => {
                let length = lengths.get(row).copied().unwrap_or(0.0).clamp(0.0, 1.0);
                let percent = 100.0 * length;
                format!("<td>{text}<i class=\"bar\" style=\"width:{percent:.1}%\"></i></td>")
            }
            _ => format!("<td>{text}</td>"),
        }
    }
}

/// A text in lines of fewer characters than a width, where its words allow.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn report() -> Report {
        let section = Section {
            title: "price <each>".into(),
            caption: "a & b".into(),
            head: vec!["effect".into(), "share".into()],
            rows: vec![vec!["a <b>".into(), "5 %".into()], vec!["c".into()]],
            bars: Some((1, vec![0.05])),
            is_detail: false,
        };
        let provenance = Provenance { command: "mbs explain a.toml".into(), ..Default::default() };
        Report { title: "x < y".into(), error: None, sections: vec![section], provenance }
    }

    #[test]
    fn the_page_is_self_contained_and_escapes_what_it_is_given() {
        let html = report().page();
        for word in ["http:", "https:", "src=", "href=", "@import", "url(", "<script", "a <b>"] {
            assert!(!html.contains(word), "{word}");
        }
        assert!(html.contains("<title>x &lt; y</title>") && html.contains("a &lt;b&gt;"));
        assert!(html.contains("width:5.0%") && html.contains("mbs explain a.toml"));
    }

    #[test]
    fn details_stand_on_the_page_only() {
        let mut report = report();
        report.sections[0].is_detail = true;
        assert_eq!(report.text(), "x < y\n");
        assert!(report.page().contains("price &lt;each&gt;"));
    }

    #[test]
    fn long_captions_are_wrapped_between_words() {
        let lines = wrapped(&"word ".repeat(50), 100);
        assert_eq!((lines.len(), lines[0].len()), (3, 99));
        assert!(wrapped("", 100).is_empty());
    }

    #[test]
    fn the_text_has_aligned_columns_and_short_rows_are_no_fault() {
        let text = report().text();
        assert_eq!(text, "x < y\n\nprice <each>\n  effect  share\n  a <b>   5 %\n  c\n  a & b\n");
    }
}

//! Reports: titled tables, as text for the terminal and as an HTML file for a browser.

use crate::page::{Page, PageSection, still_view};
pub use crate::table::Section;
pub(crate) use crate::table::{row, wrapped};
use core::fmt::Write;
use mbs::record::{Provenance, RecordedMotion};

/// Report of titled tables.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Report {
    /// Title of the report.
    pub title: String,
    /// Error that ended the run, if there was one.
    pub error: Option<String>,
    /// The tables, in order.
    pub sections: Vec<Section>,
    /// Motion that is drawn below the first table, with names of bodies and joints.
    pub motion: Option<RecordedMotion>,
    /// Provenance of the report: program, versions and inputs.
    pub provenance: Provenance,
}

impl Report {
    /// Returns the report as text with aligned columns.
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
            // writing to a String cannot fail
            let _ = writeln!(out, "\n{}", section.title);
            section.write_text(&mut out);
        }
        out
    }

    /// Returns the report as one HTML file without references to other files. Tables need no script. Folded tables are the last ones.
    #[must_use]
    pub fn page(&self) -> String {
        let error = self.error.as_ref().map(|error| PageSection::Error(format!("The run {error}")));
        let (folded, open): (Vec<_>, Vec<_>) =
            self.sections.iter().filter(|s| !s.rows.is_empty()).cloned().partition(|s| s.is_folded);
        let mut tables = open.into_iter().chain(folded).map(PageSection::of);
        let mut sections: Vec<_> = error.into_iter().chain(tables.next()).collect();
        let (view, pack) = self.motion.as_ref().and_then(still_view).unzip();
        sections.extend(view.into_iter().flatten());
        sections.extend(tables);
        sections.push(PageSection::of(Section::made(self.provenance.rows()).folded()));
        Page { title: self.title.clone(), sections, pack }.html()
    }
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
            ..Section::default()
        };
        let provenance = Provenance { command: "mbs explain a.toml".into(), ..Default::default() };
        Report { title: "x < y".into(), sections: vec![section], provenance, ..Report::default() }
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
    fn what_is_folded_stands_last_under_its_title() {
        let mut report = report();
        report.sections[0].is_folded = true;
        let rows = vec![vec!["open".into()]];
        report.sections.push(Section { title: "second".into(), rows, ..Section::default() });
        let html = report.page();
        let place = |text: &str| html.find(text).unwrap_or_else(|| panic!("no `{text}`"));
        let order = ["<h2>second</h2>", "<summary>price", "<summary>How"].map(place);
        assert!(order.is_sorted(), "{order:?}");
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

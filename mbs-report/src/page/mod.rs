//! The page of a run: one self-contained HTML file with animation and plots.
//!
//! Style, script and data are inside the file; it opens from disk and asks the network for nothing.

mod captions;
mod data;
mod decimate;
#[cfg(test)]
mod tests;

use mbs::record::RunRecord;

const TEMPLATE: &str = include_str!("page.html");
pub(crate) const STYLE: &str = include_str!("style.css");
pub(crate) const PLOT: &str = include_str!("plot.js");
const MOTION: &str = include_str!("motion.js");
const MAIN: &str = include_str!("main.js");

/// Writes the page of a run: one HTML file without references to anything outside.
///
/// Series are thinned to at most 1500 points per line; the smallest and largest value of every stretch stay,
/// so peaks survive. Numbers that are not finite leave gaps.
///
/// # Examples
/// ```
/// let record = mbs::record::RunRecord { scene: "pendulum".into(), ..Default::default() };
/// let html = mbs_report::page(&record);
/// assert!(html.starts_with("<!doctype html>") && html.contains("<title>pendulum</title>"));
/// ```
#[must_use]
pub fn page(record: &RunRecord) -> String {
    let title = escape(&record.scene);
    // `<` inside a text of the data must not end the script element it stands in
    let data = data::json(record).replace('<', "\\u003c");
    let scripts = [PLOT, MOTION, MAIN].concat();
    fill(
        TEMPLATE,
        &[
            ("{{title}}", &title),
            ("{{style}}", STYLE),
            ("{{data}}", &data),
            ("{{script}}", &scripts),
        ],
    )
}

/// Puts parts in the places of their marks, which stand in this order. One pass, so that what they contain is never taken for a
/// mark.
pub(crate) fn fill(template: &str, parts: &[(&str, &str)]) -> String {
    let mut out = String::new();
    let mut rest = template;
    for (mark, part) in parts {
        if let Some((before, after)) = rest.split_once(mark) {
            out += before;
            out += part;
            rest = after;
        }
    }
    out + rest
}

pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

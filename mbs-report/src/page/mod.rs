//! Pages: one self-contained HTML file each, made of sections; and the page of a run.
//!
//! Style, scripts and data are inside the file; it opens from disk and asks the network for nothing. Texts and tables are HTML, so a page has
//! its numbers without scripts.

mod captions;
mod decimate;
mod motion;
mod pack;
mod panels;
mod run;
mod section;
#[cfg(test)]
mod tests;

pub use run::page;
pub(crate) use section::{Page, PageSection, STYLE};

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

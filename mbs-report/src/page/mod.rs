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
mod statistics;
#[cfg(test)]
mod tests;
mod text;

pub use run::page;
pub(crate) use section::{Page, PageSection, STYLE};
pub(crate) use text::{escape, fill};

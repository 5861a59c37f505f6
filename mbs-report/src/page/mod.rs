//! HTML pages: one self-contained file each, made of sections; and the pages of runs.
//!
//! Style, scripts and data are inside the file; it opens from disk and asks the network for nothing. Texts and tables are HTML, so a page has
//! its numbers without scripts.

mod captions;
mod decimate;
mod diagram;
mod glossary;
mod meshes;
mod motion;
mod open_rows;
mod paced;
mod pack;
mod panels;
mod results;
mod run;
mod section;
mod statistics;
mod sweep;
#[cfg(test)]
pub(crate) mod tests;

pub(crate) use diagram::{Diagram, DiagramLine, Look};
pub(crate) use motion::still_view;
pub(crate) use pack::Pack;
pub use results::{difference_page, plots_page};
pub use run::{paced_page, page};
pub(crate) use section::{DiagramFrame, Page, PageSection};
pub use sweep::sweep_page;

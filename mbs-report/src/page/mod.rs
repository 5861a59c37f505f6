//! HTML pages of runs and other results. Each page is one self-contained file made of sections.
//!
//! Style, scripts and data are part of the file. It opens from disk and makes no network requests. Texts and tables are HTML, so that a page
//! shows its numbers without scripts too.

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

//! A comparison of methods as text and as a page.

mod captions;
mod page;
mod plots;
mod text;

pub use page::comparison_page;
pub use text::report;

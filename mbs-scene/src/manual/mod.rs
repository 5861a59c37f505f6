//! The manual of scene files, generated from the key tables: lists and pages for a terminal, Markdown, and a JSON Schema.

pub(crate) mod groups;
mod markdown;
mod page;
mod schema;

pub use markdown::markdown;
pub use page::{list, page};
pub use schema::schema;

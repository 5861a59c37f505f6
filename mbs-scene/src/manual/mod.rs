//! The manual of scene files, written from the tables of their keys: lists and pages for a terminal, Markdown, and a schema.

pub(crate) mod groups;
mod markdown;
mod page;
mod schema;

pub use markdown::markdown;
pub use page::{list, page};
pub use schema::schema;

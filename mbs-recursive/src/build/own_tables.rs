//! Access to the tables of a tree. Their indices and lengths are consistent by construction, so an error is a defect of the program.

use crate::link::indexing::Outside;

/// Returns a result that cannot fail, because the tree made all tables itself.
///
/// # Panics
/// If the tables are inconsistent.
#[track_caller]
pub(crate) fn own<X>(done: Result<X, Outside>) -> X {
    done.unwrap_or_else(|Outside| unreachable!("the tables of a tree fit each other"))
}

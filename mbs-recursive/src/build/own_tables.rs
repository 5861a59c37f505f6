//! The tables of a tree fit each other: where one of them does not, the tree was made wrong.

use crate::link::indexing::Outside;

/// Returns the result of tables that fit because a tree made them all.
///
/// # Panics
/// If they do not.
#[track_caller]
pub(crate) fn own<X>(done: Result<X, Outside>) -> X {
    done.unwrap_or_else(|Outside| unreachable!("the tables of a tree fit each other"))
}

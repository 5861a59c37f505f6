//! The page of a run.
use crate::record::RunRecord;
/// Page.
#[must_use]
pub fn page(_record: &RunRecord) -> String {
    String::new()
}

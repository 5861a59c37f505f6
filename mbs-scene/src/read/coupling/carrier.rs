//! Message and hint for a drawn coupling whose two parts have no common carrier.

/// Message of the fault. The arguments are the two bodies that carry the parts, and the joint whose axis the missing joint would have.
pub(crate) fn no_carrier([one, other]: &[String; 2], joint: &str) -> String {
    format!(
        "no body carries both axes: `{other}` does not turn on `{one}` about the axis of `{joint}`"
    )
}

/// Hint that names the joint to add.
pub(crate) fn joint_to_add([one, other]: &[String; 2], joint: &str) -> String {
    format!(
        "add a joint between `{one}` and `{other}` on the axis of `{joint}`, or write the sum as `linear`"
    )
}

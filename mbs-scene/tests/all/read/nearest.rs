//! Suggestion of the name nearest to a mistyped one.

use mbs_scene::inside::nearest;

#[test]
fn slips_of_the_pen_are_recognised() {
    let kinds = ["revolute", "prismatic", "spherical"];
    assert_eq!(nearest("revolut", &kinds), Some("revolute"));
    assert_eq!(nearest("Rveolute", &kinds), Some("revolute"));
    assert_eq!(nearest("hinge", &kinds), None);
    assert_eq!(nearest("", &kinds), None);
    assert_eq!(nearest("ab", &["cd", "ac"]), Some("ac"));
}

//! Hints for words of other programs.

use mbs_scene::inside::hints::{HINTS, of_word};

#[test]
fn a_hint_is_given_only_where_its_word_may_stand() {
    assert_eq!(
        of_word("Hinge", &["revolute", "weld"]).as_deref(),
        Some("did you mean `revolute`?")
    );
    assert_eq!(of_word("hinge", &["index-1"]), None);
    assert_eq!(
        of_word("center_of_mass", &["name", "center"]).as_deref(),
        Some("did you mean `center`?")
    );
    assert!(of_word("motor", &["revolute"]).is_some_and(|hint| hint.contains("[[guide]]")));
    assert!(
        of_word("belt", &["spring-damper", "torque"])
            .is_some_and(|hint| hint.contains("[[coupling]]"))
    );
}

#[test]
fn no_word_is_known_where_it_is_said_to_be_unknown() {
    for hint in HINTS {
        assert!(!hint.words.contains(&hint.among), "{}", hint.among);
    }
}

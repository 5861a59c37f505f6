//! Names in quotes, with escapes for special characters.

use mbs_scene::quoted;

#[test]
fn quotes_and_control_characters_in_names_are_escaped() {
    assert_eq!(quoted("a \"b\" \\ \n"), "\"a \\\"b\\\" \\\\ \\u000A\"");
}

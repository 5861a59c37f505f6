//! Tests of paths to numbers of a scene, part by part.

use mbs_scene::inside::{PathPart, parse};

#[test]
fn paths_are_read_part_by_part() {
    let key = |text: &str| PathPart::Key(text.to_owned());
    assert_eq!(parse("solver.step"), Ok(vec![key("solver"), key("step")]));
    let parts = vec![
        key("effect"),
        key("front left"),
        key("points"),
        PathPart::Index(1),
        PathPart::Index(0),
    ];
    assert_eq!(parse("effect.\"front left\".points[1][0]"), Ok(parts.clone()));
    assert_eq!(parse("effect.'front left'.points[1][0]"), Ok(parts));
    assert_eq!(parse("body[2].mass"), Ok(vec![key("body"), PathPart::Index(2), key("mass")]));
}

#[test]
fn what_is_no_path_is_distinguished() {
    for text in [
        "",
        ".",
        "body.",
        "body..mass",
        "body.a mass",
        "body[",
        "body[-1].mass",
        "body[x]",
        "a.\"b",
        "a]",
    ] {
        assert!(parse(text).is_err(), "{text}");
    }
}

//! Interpolation between the rows of tables: the words, their data, the written text, and errors at their place.

use super::{read, refused};
use mbs_core::scene::*;
use mbs_scene::SceneFile;
use mbs_scene::to_toml;

const SCENE: &str = r#"[scene]
dimension = 2
duration = 4
[[body]]
name = "arm"
mass = 2
center = [1, 0]
inertia = 0.1
[[body]]
name = "cart"
mass = 2
center = [0, 1]
inertia = 0.1
[[body]]
name = "block"
mass = 2
center = [0, 2]
inertia = 0.1
[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["ground", "arm"]
at = [0, 0]
[[joint]]
name = "slide"
kind = "prismatic"
bodies = ["ground", "cart"]
axis = [1, 0]
at = [0, 1]
[[joint]]
name = "way"
kind = "prismatic"
bodies = ["ground", "block"]
axis = [1, 0]
at = [0, 2]
[[guide]]
joint = "pivot"
table = [[0, 0], [1, 2], [5, 2]]
interpolation = "GUIDE"
ends = "level"
[[coupling]]
kind = "cam"
joints = ["pivot", "slide"]
table = [[0, 0], [1, 2], [3, 0]]
interpolation = "CAM"
periodic = true
[[coupling]]
kind = "linear"
terms = [{ joint = "way" }, { joint = "slide", table = [[0, 0], [1, 2]], interpolation = "TERM" }]
table = [[0, 0], [9, 2]]
interpolation = "SUM"
[[effect]]
name = "buffer"
kind = "spring-damper"
terms = [{ joint = "way", table = [[0, 0], [1, 2]], interpolation = "EFFECT" }]
stiffness = 3
[[signal]]
name = "course"
kind = "table"
table = [[0, 0], [1, 2]]
interpolation = "SIGNAL"
[[signal]]
name = "force"
kind = "curve"
of = "course"
table = [[0, 0], [1, 2]]
interpolation = "CURVE"
[road]
kind = "table"
points = [[0, 0], [9, 1]]
interpolation = "ROAD"
"#;

const PLACES: [&str; 8] = ["GUIDE", "CAM", "TERM", "SUM", "EFFECT", "SIGNAL", "CURVE", "ROAD"];

/// The scene with one word at one place, and another word at all other places.
fn with(place: &str, word: &str, others: &str) -> String {
    PLACES.iter().fold(SCENE.to_owned(), |text, other| {
        text.replace(
            &format!("\"{other}\""),
            &format!("\"{}\"", if *other == place { word } else { others }),
        )
    })
}

#[test]
fn every_table_has_its_interpolation_and_keeps_it_when_it_is_written() {
    let file = SceneFile::parse(&with("", "", "monotone"), "x.toml").expect("a scene");
    let scene = file.numbers().expect("a scene");
    let monotone = CurveShape::Monotone;
    let shaped = |curve: &Option<Curve<Number>>, is_periodic: bool| {
        matches!(curve, Some(Curve::Shaped { shape, periodic, .. })
            if *shape == monotone && *periodic == is_periodic)
    };
    assert!(matches!(scene.guides[0].law, Motion::Monotone { ends: TableEnds::Level, .. }));
    assert!(shaped(&scene.couplings[0].terms[1].curve, true));
    assert!(shaped(&scene.couplings[1].terms[1].curve, false));
    assert!(matches!(scene.couplings[1].motion, Some(Motion::Monotone { .. })));
    let RoadFeature::Shaped { shape, .. } = &scene.road.left[0] else { panic!("a table") };
    assert_eq!(*shape, monotone);
    let way = Interpolation::Monotone(TableEnds::Natural);
    let SignalKind::Table { interpolation, .. } = &scene.signals[0].kind else { panic!("a table") };
    assert_eq!(*interpolation, way);
    let again = SceneFile::parse(&to_toml(&scene).expect("no code"), "x.toml").expect("a scene");
    assert_eq!(again.numbers().expect("a scene"), scene);
}

#[test]
fn a_table_without_the_key_is_the_spline_that_the_word_names() {
    let named = with("", "", "spline");
    let without: String = named
        .lines()
        .filter(|line| !line.starts_with("interpolation"))
        .map(|line| format!("{line}\n"))
        .collect();
    let without = without.replace(", interpolation = \"spline\"", "");
    assert!(!without.contains("interpolation"));
    assert_eq!(read(&named), read(&without));
    let scene = read(&named).expect("a scene");
    assert!(matches!(scene.couplings[0].terms[1].curve, Some(Curve::Periodic(_))));
    assert!(matches!(scene.guides[0].law, Motion::Table { ends: TableEnds::Level, .. }));
}

#[test]
fn a_linear_table_is_refused_where_accelerations_follow_it() {
    let corners =
        "`interpolation` makes corners at the rows, where accelerations would have no bound";
    for (place, at) in [("GUIDE", "39:17"), ("CAM", "45:17"), ("SUM", "51:17")] {
        let e = read(&with(place, "linear", "spline")).unwrap_err();
        refused(&e, at, corners, "write \"monotone\"");
    }
    let e = read(&with("TERM", "linear", "spline")).unwrap_err();
    refused(&e, "49:9", &corners.replace("interpolation", "terms"), "write \"monotone\"");
    for place in ["EFFECT", "SIGNAL", "CURVE", "ROAD"] {
        let scene = read(&with(place, "linear", "spline"));
        assert!(scene.is_ok(), "{place}: {scene:?}");
    }
    let tire = "[[effect]]\nkind = \"tire\"\nbody = \"cart\"\ncenter = [0, 1]\nradius = 0.4\nstiffness = 1e5\ndamping = 1e3\n[road]";
    let wheeled = with("ROAD", "linear", "spline").replace("[road]", tire);
    let e = read(&wheeled).unwrap_err();
    refused(&e, "78:17", corners, "write \"monotone\"");
    let scene =
        read(&wheeled.replace("interpolation = \"linear\"\n", "interpolation = \"monotone\"\n"));
    assert!(scene.is_ok(), "{scene:?}");
}

#[test]
fn guides_and_couplings_do_not_follow_signals_with_corners() {
    let text = with("CURVE", "linear", "spline")
        .replace("table = [[0, 0], [9, 2]]\ninterpolation = \"spline\"", "signal = \"force\"");
    let e = read(&text).unwrap_err();
    refused(&e, "50:10", "`force` has a corner", "give it `interpolation = \"monotone\"`");
    for word in ["monotone", "spline"] {
        assert!(read(&text.replace("linear\"\n[road]", &format!("{word}\"\n[road]"))).is_ok());
    }
}

#[test]
fn unknown_words_and_words_without_a_table_are_refused_at_their_place() {
    for (place, at, known) in [
        ("GUIDE", "39:17", "choices: spline, monotone, linear"),
        ("SIGNAL", "61:17", "choices: spline, monotone, linear, hold"),
    ] {
        let e = read(&with(place, "steps", "spline")).unwrap_err();
        refused(&e, at, "unknown interpolation `steps`", known);
    }
    let e = read(&with("CURVE", "hold", "spline")).unwrap_err();
    refused(&e, "67:17", "unknown interpolation `hold`", "");
    let e = read(&with("CAM", "monoton", "spline")).unwrap_err();
    refused(&e, "45:17", "unknown interpolation `monoton`", "did you mean `monotone`?");
    let ramp = SCENE
        .replace("table = [[0, 0], [1, 2], [5, 2]]\n", "ramp = { rate = 1 }\n")
        .replace("ends = \"level\"\n", "");
    let e = read(&ramp).unwrap_err();
    refused(&e, "39:1", "`interpolation` has no meaning here", "remove it");
    let polynomial = with("", "", "spline").replace(
        "of = \"course\"\ntable = [[0, 0], [1, 2]]",
        "of = \"course\"\ncoefficients = [0, 1]",
    );
    let e = read(&polynomial).unwrap_err();
    refused(&e, "67:17", "both `coefficients` and `interpolation` are given", "");
}

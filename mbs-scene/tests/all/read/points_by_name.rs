//! Tests of `[[point]]`: places by name, mirrored and moved, in expressions, and refused entries.

use super::*;
use mbs_core::Real;
use mbs_core::real::DoubleDouble;

const SCENE: &str = "\
[scene]
dimension = 3
duration = 1.0

[parameters]
track = \"0.97 m\"

[[point]]
name = \"ball\"
at = [\"track\", 0.488, 0.241]

[[body]]
name = \"b\"
mass = 1.0
point = PLACE
";

fn scene(place: &str, more: &str) -> Result<Scene<f64>, ReadError> {
    SceneFile::parse(&(SCENE.replace("PLACE", place) + more), "test.toml")?.scene()
}

fn place(place: &str, more: &str) -> [f64; 3] {
    scene(place, more).unwrap_or_else(|e| panic!("{}", e.render())).bodies[0].center
}

#[test]
fn a_point_stands_for_its_numbers_mirrored_and_moved() {
    let right = "[[point]]\nname = \"right\"\nat = { of = \"ball\", mirror = \"y\" }\n";
    assert_eq!(place("\"ball\"", ""), [0.97, 0.488, 0.241]);
    assert_eq!(place("\"right\"", right), [0.97, -0.488, 0.241]);
    let moved = "{ of = \"right\", mirror = \"x\", plus = [0, 0, \"20 mm\"] }";
    assert_eq!(place(moved, right), [-0.97, -0.488, 0.261]);
    assert_eq!(place("[\"ball.x/2\", 0, \"right.y\"]", right), [0.485, 0.0, -0.488]);
}

#[test]
fn a_mirrored_number_keeps_all_its_digits() {
    let text = SCENE.replace("0.488", "0.12345678901234567890123456789").replace("PLACE", "\"r\"");
    let more = "[[point]]\nname = \"r\"\nat = { of = \"ball\", mirror = \"y\" }\n";
    let file = SceneFile::parse(&(text + more), "test.toml").expect("TOML");
    let [_, y, _] = file.scene::<DoubleDouble>().expect("a scene").bodies[0].center;
    assert_eq!(y, DoubleDouble::from_decimal("-0.12345678901234567890123456789").unwrap());
}

#[test]
fn a_direction_leads_from_one_place_to_another() {
    let joint = "[[joint]]\nname = \"j\"\nkind = \"revolute\"\nbodies = [\"ground\", \"c\"]\nat = \"ball\"\n\
                 axis = { from = \"ball\", to = { of = \"ball\", plus = [0, 0.5, 0] } }\n\
                 [[body]]\nname = \"c\"\nmass = 1.0\ncenter = \"ball\"\ninertia = [1, 1, 1, 0, 0, 0]\n";
    let scene = scene("\"ball\"", joint).unwrap_or_else(|e| panic!("{}", e.render()));
    assert_eq!(scene.joints[0].axes[0], Some([0.0, 0.5, 0.0]));
    assert_eq!(scene.joints[0].points[1], [0.97, 0.488, 0.241]);
}

#[test]
fn a_list_of_two_texts_is_two_places_where_places_are_wanted() {
    let distance = "[[joint]]\nname = \"d\"\nkind = \"distance\"\nbodies = [\"ground\", \"b\"]\npoints = [\"top\", \"ball\"]\n[[point]]\nname = \"top\"\nat = [0, 0, 2]\n";
    let points = scene("\"ball\"", distance).expect("a scene").joints[0].points;
    assert_eq!(points, [[0.0, 0.0, 2.0], [0.97, 0.488, 0.241]]);
}

#[test]
fn refusals_of_points_have_their_place() {
    let cases = [
        ("\"bal\"", "", "unknown point `bal`", "did you mean `ball`?", 15),
        ("[\"ball\", 0, 0]", "", "`ball` is a point", "write `ball.x`, or another axis", 15),
        ("[\"bal.x\", 0, 0]", "", "`bal` is no point", "did you mean `ball`?", 15),
        ("{ of = \"ball\", mirror = \"w\" }", "", "unknown mirror `w`", "", 15),
        ("{ mirror = \"y\" }", "", "`of` is missing", "", 15),
        ("{ of = \"ball\", plus = [1, 2] }", "", "expected 3 entries, found 2", "", 15),
        ("{ of = \"ball\", minus = [1, 2, 3] }", "", "unknown key `minus`", "", 15),
        ("3.0", "", "expected a place", "", 15),
        (
            "\"a\"",
            "[[point]]\nname = \"a\"\nat = \"a\"\n",
            "parameters and points that need one another: a -> a",
            "",
            18,
        ),
        (
            "\"ball\"",
            "[[point]]\nname = \"ball\"\nat = [0, 0, 0]\n",
            "`ball` is already the name of point 1",
            "",
            17,
        ),
        ("\"ball\"", "[[point]]\nname = \"c\"\n", "`at` is missing", "", 16),
        (
            "\"ball\"",
            "[[point]]\nname = \"c\"\nat = [1]\n",
            "expected the two or three numbers of a place, found 1",
            "",
            18,
        ),
        ("\"c\"", "[[point]]\nname = \"c\"\nat = [0, 0]\n", "expected 3 entries, found 2", "", 15),
    ];
    for (place, more, message, hint, line) in cases {
        let error = scene(place, more).expect_err(message);
        let text = error.render();
        assert!(text.contains(message) && text.contains(hint), "{text}");
        assert_eq!(error.place().line, line, "{text}");
    }
}

#[test]
fn parameters_may_need_points_and_points_parameters() {
    let more = "[[point]]\nname = \"c\"\nat = [\"2*track\", \"ball.z\", 0]\n";
    let text = SCENE
        .replace("[[point]]", "half = \"c.x/2\"\n[[point]]")
        .replace("PLACE", "[\"half\", 0, 0]");
    let scene = SceneFile::parse(&(text + more), "test.toml").and_then(|file| file.scene::<f64>());
    let scene = scene.unwrap_or_else(|e| panic!("{}", e.render()));
    assert_eq!(scene.bodies[0].center, [0.97, 0.0, 0.0]);
}

//! Numbers of a file that are replaced by their paths.

use mbs_core::scene::Number;
use mbs_scene::SceneFile;

/// A scene with numbers in all places: in tables, lists, inline tables, expressions and before comments.
const TOML: &str = r#"# a comment
[scene]
dimension = 2
duration = 1_0.50 # seconds
gravity = [ 0.0, -9.81 ]

[parameters]
k = "36 kN/m"

[[body]]
name = "rod"
rod = { from = [0.0, 0.0], to = [1.0, 0.0] } # one
mass = "2 * 3"

[[body]]
name.of = 1
center = [
    0.25, # x
    1e-3,
]
"#;
const JSON: &str = "{\"scene\": {\"duration\": 10.50, \"gravity\": [0.0,-9.81]}, \"body\": [{\"name\": \"rod\", \"mass\": 2}]}\n";

#[test]
fn a_file_with_another_number_is_that_of_its_text() {
    let of_toml = [
        "scene.duration",
        "scene.gravity[1]",
        "parameter.k",
        "body.rod.rod.to[0]",
        "body.rod.mass",
        "body[1].name.of",
        "body[1].center[0]",
        "body[1].center[1]",
    ];
    let of_json = ["scene.duration", "scene.gravity[0]", "body.rod.mass"];
    let numbers =
        ["2.5", "-3", "0", "1.00000000000000000000000001", "1e300", "+0.12345678901234567"];
    for (text, name, paths) in [(TOML, "a.toml", &of_toml[..]), (JSON, "a.json", &of_json)] {
        let first = SceneFile::parse(text, name).expect("a file");
        for number in numbers.map(|text| Number::from_decimal(text).expect("a number")) {
            let mut file = first.clone();
            for path in paths {
                let Ok(other) = file.with_number(path, &number) else {
                    assert!(number.text().starts_with('+') && name == "a.json", "{path}");
                    continue;
                };
                file = other;
                let again = SceneFile::parse(file.text(), name).expect("a file");
                assert_eq!(format!("{file:?}"), format!("{again:?}"), "{path}");
                assert_eq!(file.number(path), Ok(number.clone()), "{path}");
            }
            assert!(name == "a.json" || file.text().contains("# seconds"));
        }
        let none = first.with_number(paths[0], &Number::from(f64::NAN));
        assert!(none.is_err(), "{none:?}");
    }
}

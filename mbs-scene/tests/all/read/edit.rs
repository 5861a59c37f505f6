//! Replacement of numbers in a file by their paths.

use mbs_core::real::DoubleDouble;
use mbs_core::scene::Number;
use mbs_scene::SceneFile;

/// A scene with numbers in all syntactic places: tables, lists, inline tables, expressions, before comments, at the end, and after letters
/// of two bytes.
const TOML: &str = r#"# a comment, à côté
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
last = 0x1F"#;
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
        "body[1].last",
    ];
    let of_json = ["scene.duration", "scene.gravity[0]", "body.rod.mass"];
    let long = ["1.00000000000000000000000001", "+0.12345678901234567", "0012345678901234567"];
    let numbers = ["2.5", "-3", "0", "-0.0", "1e300"].into_iter().chain(long);
    let lines = TOML.replace('\n', "\r\n");
    let texts =
        [(TOML, "a.toml", &of_toml[..]), (&lines, "a.toml", &of_toml), (JSON, "a.json", &of_json)];
    for (text, name, paths) in texts {
        let first = SceneFile::parse(text, name).expect("a file");
        for number in numbers.clone().map(|text| Number::from_decimal(text).expect("a number")) {
            let mut file = first.clone();
            for path in paths {
                file = file.with_number(path, &number).expect("a number's path");
                let again = SceneFile::parse(file.text(), name).expect("a file");
                assert_eq!(format!("{file:?}"), format!("{again:?}"), "{path}");
                let read = file.number(path).expect("a number");
                assert_eq!(read.value::<DoubleDouble>(), number.value(), "{path}");
            }
            assert!(name == "a.json" || file.text().contains("# seconds"));
        }
        for number in [f64::NAN, f64::INFINITY] {
            let none = first.with_number(paths[0], &Number::from(number));
            assert!(none.is_err(), "{none:?}");
        }
    }
}

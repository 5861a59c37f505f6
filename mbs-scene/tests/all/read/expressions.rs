//! Expressions and parameters in scenes: they give the same scene as plain numbers. Errors have line and column.

use super::*;
use mbs_core::real::DoubleDouble;
use proptest::prelude::*;

const SCENE: &str = "\
[scene]
dimension = 2
duration = 1.0

[parameters]
";

const BODY: &str = "
[[body]]
name = \"b\"
mass = MASS
point = [X, 0.0]
";

/// A scene with these parameters, and a body with this mass and place.
fn scene(parameters: &str, [mass, x]: [&str; 2]) -> Result<SceneFile, ReadError> {
    let body = BODY.replace("MASS", mass).replace('X', x);
    SceneFile::parse(&format!("{SCENE}{parameters}\n{body}"), "test.toml")
}

fn refusal(parameters: &str, mass: &str) -> ReadError {
    let file = scene(parameters, [mass, "0.0"]).expect("TOML");
    file.numbers().expect_err(parameters)
}

#[test]
fn a_scene_of_expressions_is_that_of_its_numbers_in_all_digits() {
    let parameters = "m0 = \"350 kg\"\nhalf = 0.5\nplace = \"9 mm\"";
    let file = scene(parameters, ["\"2*half*m0\"", "\"place + 1 m\""]).expect("TOML");
    let plain = scene("", ["350.0", "1.009"]).expect("TOML");
    assert_eq!(file.scene::<f64>().expect("a scene"), plain.scene::<f64>().expect("a scene"));
    let [found, right] = [file, plain]
        .map(|file| file.scene::<DoubleDouble>().expect("a scene").bodies[0].center[0]);
    assert!((found - right).hi().abs() < 1e-31, "{found} {right}");
}

#[test]
fn a_third_has_the_digits_of_the_run() {
    let file = scene("", ["\"1/3\"", "0.0"]).expect("TOML");
    let mass = file.scene::<DoubleDouble>().expect("a scene").bodies[0].mass;
    let error = mass * DoubleDouble::from_f64(3.0) - DoubleDouble::from_f64(1.0);
    assert!(error.hi().abs() < 1e-31, "{error}");
    assert_eq!(file.scene::<f64>().expect("a scene").bodies[0].mass, 1.0 / 3.0);
}

#[test]
fn parameters_that_nothing_needs_are_named() {
    let parameters = "spare = 1.0\nhalf = 0.5\nm0 = \"2*half\"\nother = \"m0\"";
    let file = scene(parameters, ["\"m0\"", "0.0"]).expect("TOML");
    assert_eq!(file.unused_parameters(), ["spare", "other"]);
}

#[test]
fn a_parameter_is_evaluated_once() {
    let mut parameters = "p0 = 1.0\n".to_owned();
    for i in 1..60 {
        parameters += &format!("p{i} = \"p{} + p{}\"\n", i - 1, i - 1);
    }
    let file = scene(&parameters, ["p59", "0.0"].map(|x| if x == "p59" { "\"p59\"" } else { x }));
    let scene = file.expect("TOML").scene::<f64>().expect("a scene");
    assert_eq!(scene.bodies[0].mass, 2.0_f64.powi(59));
}

#[test]
fn what_has_no_value_is_refused_with_its_place() {
    for (parameters, mass, place, message, hint) in [
        (
            "a = \"b\"\nb = \"a + 1\"",
            "1.0",
            "6:5",
            "parameters and points that need one another: a -> b -> a",
            "a number",
        ),
        ("a = \"2*\"", "1.0", "6:8", "the expression ends too early", "missing"),
        ("m = 2.0", "1.0", "6:1", "`m` is a unit", "another name"),
        ("sin = 2.0", "1.0", "6:1", "`sin` has a meaning of its own", "another name"),
        ("\"a b\" = 2.0", "1.0", "6:1", "`a b` is no name of a parameter", "letters"),
        (
            "a = [1.0]",
            "1.0",
            "6:5",
            "expected a number, or an expression in quotes, found a list",
            "",
        ),
        ("mass0 = 2.0", "\"2*mass1\"", "10:11", "`mass1` is no parameter", "did you mean `mass0`?"),
        ("k = 2.0", "\"2 k\"", "10:11", "`k` is no unit", "`2*k`"),
        ("k = 2.0", "\"40 mm\"", "10:8", "`40 mm` is a length, `mass` is in kg", "in kg"),
        ("k = 2.0", "\"1/(k - 2)\"", "10:11", "division by zero", ""),
    ] {
        refused(&refusal(parameters, mass), place, message, hint);
    }
}

#[test]
fn a_chain_of_parameters_has_an_end() {
    let mut parameters = String::new();
    for i in 0..70 {
        parameters += &format!("p{i} = \"p{}\"\n", i + 1);
    }
    let error = refusal(&(parameters + "p70 = 1.0"), "1.0");
    assert!(error.to_string().contains("more than 64 parameters"), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2_000))]

    #[test]
    fn texts_of_expressions_never_panic(text in "[-+*/^()., 0-9a-z_µ°]{0,40}") {
        let toml = text.replace('\\', "");
        let file = scene("k = 2.0", [&format!("\"{toml}\""), "0.0"]).expect("TOML");
        let _ = file.numbers();
    }
}

//! Tests of `mbs run --precision dd`: numbers with 32 digits in its input and output.

use crate::{done as json, run, scene, text, written};
use mbs::core::Real;
use mbs::core::real::DoubleDouble as Pair;
use serde_json::Value;
use std::path::PathBuf;

fn pair(text: &str) -> Pair {
    Pair::from_decimal(text).expect("a number")
}

/// The final value of a channel of one component.
fn digits(run: &Value, channel: &str) -> Pair {
    pair(run["digits"][channel].as_str().expect("digits"))
}

/// Name and joint of each angle; its values at the start and at the end [rad] and its rate at the end [rad/s]. They were computed by an
/// extrapolation with 30 digits, with the same result for two settings.
const ANDREWS: [(&str, &str, [&str; 3]); 7] = [
    (
        "beta",
        "crank-pivot",
        ["-0.0617138900142764496358948458001", "15.810771195153707097", "1139.9203022591060642"],
    ),
    ("theta", "crank-pin", ["0", "-15.756371058411839470", "-1424.3792951775400732"]),
    (
        "gamma",
        "spring-arm-pivot",
        ["0.455279819163070380255912382449", "0.040822240119645804858", "11.032911910618593745"],
    ),
    (
        "phi",
        "upper-knee",
        ["0.222668390165885884674473185609", "-0.53473011634207959377", "19.293374105032040832"],
    ),
    (
        "delta",
        "upper-arm-pivot",
        ["0.487364979543842550225598953530", "0.52440996587995406937", "0.57356991482950245382"],
    ),
    (
        "omega",
        "lower-knee",
        ["-0.222668390165885884674473185609", "0.53473011634207959377", "-19.293374105032040832"],
    ),
    (
        "epsilon",
        "lower-arm-pivot",
        ["1.23054744454982119249735015568", "1.0480807410419378731", "0.32317914924913087499"],
    ),
];
/// Second derivative of beta at the end [rad/s²], and the length of the crank [m].
const CRANK: [&str; 2] = ["-24631.7631228746345", "0.007"];

/// The scene with the rates of its angles and the acceleration of the crank's end as outputs.
fn andrews() -> String {
    let mut text = std::fs::read_to_string(scene("andrews")).expect("the scene is there");
    for (name, joint, _) in ANDREWS {
        text += &format!(
            "\n[[output]]\nname = \"{name}-rate\"\njoint = \"{joint}\"\nquantity = \"rate\"\n"
        );
    }
    let end = text
        .rsplit("name = \"F\"")
        .next()
        .and_then(|rest| rest.lines().find(|l| l.starts_with("at")));
    let end = end.expect("where F is").to_owned();
    text += &format!(
        "\n[[output]]\nname = \"pull\"\nbody = \"crank\"\n{end}\nquantity = \"acceleration\"\n"
    );
    written("andrews-with-rates.toml", &text)
}

#[test]
fn the_command_finds_all_digits_of_andrews_mechanism() {
    let scene = andrews();
    let method = ["--precision", "dd", "--integrator", "gbs", "--tolerance", "1e-26"];
    let steps = ["--step", "1e-4", "--step-max", "3e-3", "--json"];
    let run = json(&run("run", &[&[scene.as_str()], &method[..], &steps[..]].concat()));
    println!("{} steps, {} s", run["steps"], run["cpu_seconds"]);
    assert_eq!(run["precision"], "dd");
    for (name, _, [start, end, rate]) in ANDREWS {
        let off = (pair(start) + digits(&run, name) - pair(end)).abs();
        // the values agree up to the last two digits
        assert!(off <= pair("1e-17"), "{name} is off by {off:.1e}");
        let off = (digits(&run, &format!("{name}-rate")) - pair(rate)).abs();
        println!("rate of {name}: off by {off:.1e}");
        assert!(off <= pair(rate).abs() * pair("1e-18"), "rate of {name} is off by {off:.1e}");
    }
    // the end of the crank moves on a circle about the origin: a = l (beta'' e' - beta'^2 e)
    let [_, beta, rate] = ANDREWS[0].2.map(pair);
    let [second, length] = CRANK.map(pair);
    let (sin, cos) = beta.sin_cos();
    let expected = [-second * sin - rate * rate * cos, second * cos - rate * rate * sin];
    let told = run["digits"]["pull"].as_array().expect("two numbers");
    for (told, expected) in told.iter().zip(expected) {
        let off = (pair(told.as_str().expect("digits")) - length * expected).abs();
        println!("acceleration: off by {off:.1e}");
        // the error of rate² is 1e-16 * 2 * 1140, and that of the second derivative 1e-13
        assert!(off <= pair("1e-15"), "the acceleration is off by {off:.1e}");
    }
}

#[test]
fn rows_have_32_digits_and_the_same_first_ones_as_in_f64() {
    let out = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("double-double");
    let scene = scene("double-pendulum");
    let rows = |precision: &str| {
        let out = out.join(precision);
        let place = out.to_str().expect("a path");
        let arguments = [&scene, "--precision", precision, "--duration", "0.1", "--out", place];
        json(&run("run", &[&arguments[..], &["--json"]].concat()));
        let text = std::fs::read_to_string(out.join("run.csv")).expect("rows");
        let last = text.lines().last().expect("a row").to_owned();
        last.split(',').map(str::to_owned).collect::<Vec<_>>()
    };
    let (short, long) = (rows("f64"), rows("dd"));
    for (short, long) in short.iter().zip(&long).skip(1) {
        // a hundred steps of a method that both precisions solve to machine precision: f64 loses some digits, the first digits agree
        let off = (pair(short) - pair(long)).abs();
        assert!(long.len() > 30 && off < pair("1e-13"), "{short} {long}");
    }
}

#[test]
fn commands_that_compute_in_f64_refuse_pairs() {
    let scene = scene("double-pendulum");
    let sweep = crate::scene("sweeps/double-pendulum-lengths");
    for (command, arguments) in [
        ("explain", vec![scene.as_str(), "--precision", "dd"]),
        ("sweep", vec![&scene, &sweep, "--precision", "dd"]),
    ] {
        let output = run(command, &arguments);
        let text = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{text}");
        assert!(text.contains("precision `dd` is for `mbs run`"), "{text}");
    }
}

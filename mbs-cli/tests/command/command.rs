//! Tests of the `mbs` command from outside: files, JSON, exit status, refusals.

use crate::{files, json, scene, status, text};
use serde_json::Value;
use std::path::PathBuf;
use std::process::Output;

/// An empty directory for one test.
fn scratch(name: &str) -> PathBuf {
    files::scratch(&format!("command-{name}"))
}

/// Runs `mbs run` with arguments.
fn run(arguments: &[&str]) -> Output {
    crate::run("run", arguments)
}

/// Keys of the JSON object of a run, as the contract lists them.
const KEYS: &str = "scene formulation integrator precision dimension coordinates constraints constraint_rank dof step steps completed \
    error end_time cpu_seconds real_time_factor worst_step_seconds iterations factorizations energy violation outputs chosen";

#[test]
fn json_is_one_object_with_the_keys_of_the_contract() {
    let output = run(&[&scene("double-pendulum"), "--json", "--step", "1e-2"]);
    assert_eq!(status(&output), 0);
    let value = json(&output);
    for key in KEYS.split_whitespace() {
        assert!(value.get(key).is_some(), "{key}: {value}");
    }
    for key in ["initial", "max_error", "final_error"] {
        assert!(value["energy"][key].is_number(), "energy.{key}");
    }
    for key in ["position", "velocity", "acceleration"] {
        assert!(value["violation"][key].is_number(), "violation.{key}");
    }
    assert_eq!(value["scene"], "double pendulum");
    assert_eq!(value["formulation"], "auto");
    assert_eq!(value["chosen"]["formulation"], "index-3");
    assert_eq!((&value["dof"], &value["dimension"]), (&2.into(), &2.into()));
    assert_eq!(value["steps"], 1000);
    assert_eq!(value["completed"], true);
    assert_eq!(value["error"], Value::Null);
    assert_eq!(value["end_time"], 10.0);
    assert_eq!(value["outputs"]["tip"].as_array().map(Vec::len), Some(2));
}

#[test]
fn json_repeats_formulation_and_step_as_asked() {
    let output =
        run(&[&scene("slider-crank"), "--json", "--formulation", "index-1", "--step", "2e-3"]);
    let value = json(&output);
    assert_eq!(value["formulation"], "index-1");
    assert_eq!(value["step"], 2e-3);
    assert!(value.get("chosen").is_none_or(Value::is_null));
}

#[test]
fn out_gets_csv_json_and_page_that_agree_with_standard_output() {
    let out = scratch("out");
    let directory = out.to_str().unwrap();
    let output = run(&[&scene("guided-four-bar"), "--json", "--out", directory]);
    assert_eq!(status(&output), 0);
    let csv = std::fs::read_to_string(out.join("run.csv")).unwrap();
    let header = csv.lines().next().unwrap();
    assert!(header.starts_with("t,crank-angle,"), "{header}");
    let columns = header.split(',').count();
    assert!(csv.lines().all(|l| l.split(',').count() == columns));
    assert_eq!(csv.lines().count(), 1 + 4001);
    let file: Value =
        serde_json::from_slice(&std::fs::read(out.join("run.json")).unwrap()).unwrap();
    assert_eq!(file, json(&output));
    let page = std::fs::read_to_string(out.join("run.html")).unwrap();
    assert!(page.contains("guided four-bar"));
    assert!(!page.contains("http://") || page.contains("http://www.w3.org"), "no network");
    assert!(!page.contains("https://"), "no network");
}

#[test]
fn two_runs_give_the_same_bytes() {
    let csv = ["first", "second"].map(|name| {
        let out = scratch(&format!("same-{name}"));
        let output = run(&[&scene("spatial-four-bar"), "--json", "--out", out.to_str().unwrap()]);
        assert_eq!(status(&output), 0);
        std::fs::read(out.join("run.csv")).unwrap()
    });
    assert!(csv[0] == csv[1]);
}

#[test]
fn durations_end_exactly_whether_or_not_the_step_divides_them() {
    for (duration, step, steps) in [
        ("0.1", "0.01", 10),
        ("1", "0.03", 34),
        ("0.005", "0.005", 1),
        ("0.07", "0.01", 7),
        ("10", "1e-3", 10_000),
    ] {
        let output =
            run(&[&scene("simple-pendulum"), "--json", "--duration", duration, "--step", step]);
        let value = json(&output);
        assert_eq!(status(&output), 0, "{value}");
        assert_eq!(value["steps"], steps, "{duration} in steps of {step}");
        assert_eq!(value["end_time"], duration.parse::<f64>().unwrap());
    }
}

/// A scene of one planar pendulum; `replace` changes parts of its text.
fn pendulum(replace: &[(&str, &str)]) -> String {
    let mut text = "[scene]\nname = \"one\"\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n\n\
        [[body]]\nname = \"bar\"\nmass = 1.0\ncenter = [0.5, 0.0]\ninertia = 0.1\n\n\
        [[joint]]\nname = \"pivot\"\nkind = \"revolute\"\nbodies = [\"ground\", \"bar\"]\nat = [0.0, 0.0]\n"
        .to_owned();
    for (from, to) in replace {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    text
}

/// Fault of a scene: its name, the replacements that change the pendulum, and the text that the message must point at.
type Case<'a> = (&'a str, Vec<(&'a str, &'a str)>, &'a str);

/// Writes a scene file and runs it.
fn run_text(name: &str, text: &str, arguments: &[&str]) -> (Output, String) {
    let path = scratch(name).join("scene.toml");
    std::fs::write(&path, text).expect("the scratch directory is ours");
    let file = path.to_str().expect("a plain path").to_owned();
    (run(&[&[file.as_str()], arguments].concat()), file)
}

#[test]
fn malformed_scenes_are_refused_with_place_and_hint() {
    let spatial: &[(&str, &str)] = &[
        ("dimension = 2", "dimension = 3"),
        ("[0.0, -9.81]", "[0.0, 0.0, -9.81]"),
        ("[0.5, 0.0]", "[0.5, 0.0, 0.0]"),
        ("at = [0.0, 0.0]", "at = [0.0, 0.0, 0.0]\naxis = [0.0, 0.0, 1.0]"),
        ("inertia = 0.1", "inertia = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0]"),
    ];
    let thin = "inertia = [0.1, 0.1, 0.5, 0.0, 0.0, 0.0]";
    let cases: [Case; 9] = [
        ("unknown-key", vec![("mass = 1.0", "mass = 1.0\nmas = 1.0")], "mas = 1.0"),
        ("unknown-body", vec![("\"ground\", \"bar\"", "\"ground\", \"baar\"")], "baar"),
        ("negative-mass", vec![("mass = 1.0", "mass = -1.0")], "mass = -1.0"),
        (
            "triangle",
            [spatial, &[("inertia = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0]", thin)]].concat(),
            thin,
        ),
        (
            "zero-axis",
            [spatial, &[("axis = [0.0, 0.0, 1.0]", "axis = [0.0, 0.0, 0.0]")]].concat(),
            "axis = [0.0, 0.0, 0.0]",
        ),
        (
            "duplicate",
            vec![(
                "[[joint]]",
                "[[body]]\nname = \"bar\" # again\nmass = 1.0\ncenter = [0.5, 0.0]\ninertia = 0.1\n\n[[joint]]",
            )],
            "\"bar\" # again",
        ),
        (
            "itself",
            vec![("\"ground\", \"bar\"", "\"bar\", \"bar\"")],
            "bodies = [\"bar\", \"bar\"]",
        ),
        ("nan", vec![("mass = 1.0", "mass = nan")], "mass = nan"),
        ("syntax", vec![("mass = 1.0", "mass = = 1.0")], "mass = = 1.0"),
    ];
    for (name, replace, offending) in cases {
        let scene = pendulum(&replace);
        let (output, file) = run_text(name, &scene, &["--json"]);
        let errors = text(&output.stderr);
        assert_eq!(status(&output), 1, "{name}: {errors}");
        let error = &json(&output)["error"];
        let line = scene.lines().position(|l| l.contains(offending)).unwrap() + 1;
        assert!(errors.contains(&format!("{file}:{line}:")), "{name}: line {line}: {errors}");
        assert_eq!((&error["code"], &error["line"]), (&"scene-refused".into(), &line.into()));
        assert_eq!(error["file"], *file);
        let column = errors.split(&format!("{file}:{line}:")).nth(1).unwrap();
        assert!(column.starts_with(|c: char| c.is_ascii_digit()), "{name}: {errors}");
        assert!(errors.contains("hint") || errors.contains("help"), "{name}: {errors}");
        let shown = scene.lines().nth(line - 1).unwrap();
        assert!(errors.contains(shown), "{name}: the line itself: {errors}");
    }
}

#[test]
fn outputs_that_are_not_finite_end_a_run_with_their_place() {
    // 14.7 rad/s^2 times 1e308 m overflows: at the start, and when the bar rotates fast enough
    let output = |quantity: &str| {
        let plain = pendulum(&[]);
        format!(
            "{plain}\n[[output]]\nname = \"far\"\nbody = \"bar\"\nat = [1e308, 0.0]\nquantity = \"{quantity}\"\n"
        )
    };
    for (name, quantity, is_later) in
        [("at-once", "acceleration", false), ("later", "velocity", true)]
    {
        let scene = output(quantity);
        let (told, file) = run_text(name, &scene, &[]);
        assert_eq!(status(&told), 2, "{name}: {}", text(&told.stderr));
        let line = scene.lines().position(|l| l.starts_with("at = [1e308")).unwrap() + 1;
        let errors = text(&told.stderr);
        assert!(errors.contains(&format!("{file}:{line}:")), "{name}: {errors}");
        assert!(errors.contains("nearer"), "{name}: {errors}");
        let json = run(&[&file, "--json"]).stdout;
        let json: Value = serde_json::from_slice(&json).expect("JSON");
        assert_eq!(json["error"]["code"], "output-not-finite", "{name}");
        assert_eq!(json["steps"].as_u64().unwrap() > 0, is_later, "{name}: {json}");
    }
}

#[test]
fn help_names_every_formulation_and_integrator() {
    let help = text(&run(&["--help"]).stdout);
    for name in mbs::FORMULATIONS.iter().chain(&mbs::INTEGRATORS) {
        assert!(help.contains(name), "{name}: {help}");
    }
}

#[test]
fn what_is_not_built_is_refused_with_the_list_of_what_is() {
    let file = scene("double-pendulum");
    for (arguments, built) in [
        (
            ["--formulation", "penalty"],
            "index-1, index-3, multi-index, classical, state-space, recursive",
        ),
        (["--integrator", "euler"], "trapezoidal, newmark"),
        (["--precision", "f16"], "f32, f64, dd"),
        (["--threads", "0"], "threads must be positive"),
    ] {
        let output = run(&[&[file.as_str(), "--json"], &arguments[..]].concat());
        let errors = text(&output.stderr);
        assert_eq!(status(&output), 1, "{arguments:?}");
        assert_eq!(json(&output)["error"]["code"], "settings-refused");
        assert!(errors.contains(built), "{arguments:?}: {errors}");
    }
    let asks =
        pendulum(&[("duration = 1.0", "duration = 1.0\n\n[solver]\nintegrator = \"euler\"")]);
    let (output, file) = run_text("asks", &asks, &[]);
    let errors = text(&output.stderr);
    assert_eq!(status(&output), 1);
    assert!(errors.contains(&format!("{file}:8:")) && errors.contains("trapezoidal"), "{errors}");
}

#[test]
fn error_control_begins_with_the_step_and_never_exceeds_the_largest() {
    let solver = "duration = 0.1\n\n[solver]\nintegrator = \"rk54\"\nstep_max = 0.1";
    let scene = pendulum(&[("duration = 1.0", solver)]);
    // every step is accepted, and the next one is five times as long: 0.001, 0.005, 0.025, 0.069; 0.01, 0.05, 0.04; 0.1; 0.1
    for (step, steps) in [("0.001", 4), ("0.01", 3), ("0.1", 1), ("0.7", 1)] {
        let arguments = ["--json", "--tolerance", "1e6", "--step", step];
        let (output, _) = run_text("first-step", &scene, &arguments);
        assert_eq!(json(&output)["steps"], steps, "{step}: {}", text(&output.stderr));
    }
}

#[test]
fn wrong_usage_and_missing_files_are_refused() {
    let file = scene("double-pendulum");
    for arguments in [
        &["no-such-scene.toml"][..],
        &[],
        &[&file, "--no-such-option"],
        &[&file, "--step", "0"],
        &[&file, "--step", "-1e-3"],
        &[&file, "--duration", "nan"],
        &[&file, "--step", "fast"],
    ] {
        let output = run(arguments);
        assert_eq!(status(&output), 1, "{arguments:?}");
        assert!(output.stdout.is_empty() && !output.stderr.is_empty(), "{arguments:?}");
    }
}

#[test]
fn a_run_that_cannot_continue_names_time_and_joint_and_keeps_its_rows() {
    let out = scratch("stops");
    // a guide rotates the crank of a rocker-rocker beyond the position where the linkage can no longer close
    let scene = "[scene]\nname = \"locks\"\ndimension = 2\nduration = 2.0\n\n\
        [[body]]\nname = \"crank\"\nrod = { from = [0.0, 0.0], to = [0.0, 1.0] }\nmass = 1.0\n\n\
        [[body]]\nname = \"coupler\"\nrod = { from = [0.0, 1.0], to = [1.0, 1.0] }\nmass = 1.0\n\n\
        [[body]]\nname = \"rocker\"\nrod = { from = [1.5, 0.0], to = [1.0, 1.0] }\nmass = 1.0\n\n\
        [[joint]]\nname = \"a\"\nkind = \"revolute\"\nbodies = [\"ground\", \"crank\"]\nat = [0.0, 0.0]\n\n\
        [[joint]]\nname = \"b\"\nkind = \"revolute\"\nbodies = [\"crank\", \"coupler\"]\nat = [0.0, 1.0]\n\n\
        [[joint]]\nname = \"c\"\nkind = \"revolute\"\nbodies = [\"coupler\", \"rocker\"]\nat = [1.0, 1.0]\n\n\
        [[joint]]\nname = \"d\"\nkind = \"revolute\"\nbodies = [\"rocker\", \"ground\"]\nat = [1.5, 0.0]\n\n\
        [[guide]]\njoint = \"a\"\nramp = { rate = 1.0 }\n";
    for formulation in ["index-3", "index-1"] {
        let (output, _) = run_text(
            "locks",
            scene,
            &["--json", "--formulation", formulation, "--out", out.to_str().unwrap()],
        );
        let value = json(&output);
        assert_eq!(status(&output), 2, "{value}");
        println!("{formulation}: {}", value["error"]);
        assert_eq!(value["completed"], false);
        let error = &value["error"];
        let end = value["end_time"].as_f64().unwrap();
        assert!(end > 0.1 && end < 2.0, "{value}");
        assert_eq!(error["time"], value["end_time"]);
        for key in ["code", "message", "hint"] {
            assert!(error[key].as_str().is_some_and(|s| !s.is_empty()), "{error}");
        }
        assert!(error["joint"].is_string() || error["body"].is_string(), "{error}");
        let csv = std::fs::read_to_string(out.join("run.csv")).unwrap();
        let last: f64 = csv.lines().last().unwrap().split(',').next().unwrap().parse().unwrap();
        assert!((last - end).abs() < 1e-9, "the last row is where the run stopped: {last} {end}");
        assert!(
            csv.lines()
                .skip(1)
                .all(|l| l.split(',').all(|x| x.parse::<f64>().is_ok_and(f64::is_finite)))
        );
        assert!(out.join("run.html").exists() && out.join("run.json").exists());
    }
}

#[test]
fn a_loop_that_cannot_close_at_the_start_gives_a_header_and_no_rows() {
    let out = scratch("impossible");
    let scene = pendulum(&[(
        "at = [0.0, 0.0]\n",
        "at = [0.0, 0.0]\n\n[[joint]]\nname = \"far\"\nkind = \"distance\"\nbodies = [\"ground\", \"bar\"]\npoints = [[0.0, 3.0], [0.5, 0.0]]\n\n[[initial]]\njoint = \"pivot\"\nvalue = 1.0\n",
    )]);
    let (output, _) =
        run_text("impossible-scene", &scene, &["--json", "--out", out.to_str().unwrap()]);
    let value = json(&output);
    println!("{}", value["error"]);
    assert_eq!(status(&output), 2);
    assert_eq!(value["completed"], false);
    assert_eq!(value["error"]["time"], 0.0);
    assert!(value["error"]["joint"].is_string(), "{value}");
    let csv = std::fs::read_to_string(out.join("run.csv")).unwrap();
    assert_eq!(csv.lines().count(), 1, "{csv}");
    assert!(csv.starts_with("t,"));
}

#[test]
fn the_table_of_a_run_has_its_peaks_and_fits_into_a_hundred_columns() {
    let scene = scene("slider-crank");
    let shown = text(&run(&[&scene, "--duration", "0.2", "--no-estimate"]).stdout);
    let head = shown.lines().position(|line| line.contains(" unit ")).expect("a table");
    let rows = shown.lines().skip(head).take_while(|line| line.starts_with("  "));
    assert!(rows.clone().all(|line| line.chars().count() <= 100) && rows.count() > 1, "{shown}");
    let object = json(&run(&[&scene, "--duration", "0.2", "--no-estimate", "--json"]));
    let channel = &object["channels"][0];
    let peak = format!("{:.4}", channel["at_max"][0].as_f64().expect("a time"));
    let row = shown.lines().nth(head + 1).expect("a row");
    assert!(
        row.contains(channel["name"].as_str().expect("a name")) && row.contains(&peak),
        "{row}"
    );
}

#[test]
fn units_are_a_line_of_their_own_where_they_are_asked_for() {
    let out = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("with-units");
    let out = out.to_str().expect("a plain path");
    let scene = scene("slider-crank");
    let both = [&["--units"][..], &[]].map(|more| {
        let arguments = [&[scene.as_str(), "--duration", "0.01", "--out", out], more].concat();
        assert_eq!(run(&arguments).status.code(), Some(0));
        std::fs::read_to_string(format!("{out}/run.csv")).expect("it is there")
    });
    let [with, without] = both.each_ref().map(|text| text.lines().collect::<Vec<_>>());
    assert_eq!((with[0], &with[2..]), (without[0], &without[1..]));
    assert!(with[1].starts_with("s,") && with[1].split(',').count() == with[0].split(',').count());
}

#[test]
fn the_method_that_ran_is_named_with_the_range_of_its_steps() {
    let scene = scene("slider-crank");
    let controlled = ["--duration", "0.2", "--step-control", "error", "--json", "--no-estimate"];
    let object = json(&run(&[&[scene.as_str()], &controlled[..]].concat()));
    let [used, control] = ["method_used", "control"].map(|key| &object[key]);
    assert_eq!(used["smallest_step"], control["smallest_step"]);
    assert_eq!(used["largest_step"], control["largest_step"]);
    assert_eq!((&used["steps"], &used["integrator"]), (&object["steps"], &object["integrator"]));
    assert_ne!(used["formulation"], "auto");
}

//! Tests of `mbs run --realtime`: files, JSON, exit status, refusals. Measures of the system's clock are checked for presence only.

use crate::{done, files, run, run_line, scene, status, text};

#[test]
fn the_command_has_an_object_realtime_and_a_line_for_each_overrun() {
    let out = files::scratch("realtime-out");
    let pace = "--realtime --overrun hold --period 0.005 --duration 0.1";
    let line = format!("run {} {pace} --json --out {}", scene("double-pendulum"), out.display());
    let value = done(&run_line(&line));
    let realtime = &value["realtime"];
    for key in ["jitter", "duration"] {
        for of in ["p50", "p99", "max"] {
            assert!(realtime[key][of].is_number(), "{key}.{of}: {realtime}");
        }
    }
    for key in ["latest", "real_time_factor", "elapsed", "behind", "skipped", "log_left_out"] {
        assert!(realtime[key].is_number(), "{key}: {realtime}");
    }
    assert!(realtime["margin"]["least"].is_number() && realtime["margin"]["p1"].is_number());
    assert_eq!((&realtime["overrun"], &realtime["period"]), (&"hold".into(), &0.005.into()));
    assert_eq!((&realtime["periods"], &realtime["degraded_periods"]), (&20.into(), &0.into()));
    let overruns = realtime["overruns"].as_u64().expect("a count");
    assert_eq!(realtime["deadline_held"], overruns == 0);
    let csv = std::fs::read_to_string(out.join("realtime.csv")).expect("it was written");
    assert_eq!(csv.lines().count() as u64, 1 + overruns, "{csv}");
    let page = std::fs::read_to_string(out.join("run.html")).expect("it was written");
    assert!(page.contains("deadline") && page.contains("--realtime --period 0.005 --overrun hold"));
    assert!(value["outputs"].get("realtime-level").is_none(), "there is no ladder");
}

#[test]
fn the_command_runs_in_pairs_of_doubles_and_degrades_what_it_is_told_to() {
    let run = |name: &str, options: &str| {
        done(&run_line(&format!("run {} --realtime --json {options}", scene(name))))
    };
    let value = run("double-pendulum", "--precision dd --duration 0.05");
    assert!(value["digits"].is_object() && value["realtime"]["periods"].is_number());
    let degrade =
        "--overrun degrade --degrade steps,damper --step 1e-3 --period 4e-3 --duration 0.1";
    let value = run("iltis-suspension", degrade);
    let levels = value["realtime"]["levels"].as_array().expect("a ladder");
    assert_eq!(levels.len(), 3);
    assert_eq!(
        (&levels[2]["without"][0], &levels[2]["step_times"]),
        (&"damper".into(), &2.0.into())
    );
    assert!(value["outputs"]["realtime-level"].is_number());
}

#[test]
fn the_command_refuses_what_is_no_pace() {
    let scene = scene("double-pendulum");
    for (arguments, word) in [
        (&["--realtime", "--period", "0"][..], "period cannot be 0 s"),
        (&["--realtime", "--period=-1"], "period cannot be -1 s"),
        (&["--realtime", "--overrun", "panic"], "write finish, hold or degrade"),
        (&["--period", "0.01"], "--realtime"),
        (&["--realtime", "--degrade", "steps"], "--overrun"),
        (&["--realtime", "--overrun", "hold", "--quiet", "9"], "are for --overrun degrade"),
        (&["--realtime", "--overrun", "degrade", "--degrade", "wind"], "no effect `wind`"),
    ] {
        let output = run("run", &[&[scene.as_str()], arguments].concat());
        let text = text(&output.stderr);
        assert_eq!(status(&output), 1, "{arguments:?}: {text}");
        assert!(text.contains(word), "{arguments:?}: {text}");
    }
}

//! Tests of sweeps through the command: the same table for any number of threads, failures among results, and a journal that survives a
//! kill.

use crate::{files, json, plain, run_line, scene, status};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::sync::atomic::{AtomicUsize, Ordering};

/// An empty directory for one test.
fn scratch(name: &str) -> PathBuf {
    files::scratch(&format!("sweep-{name}"))
}

/// Runs `mbs sweep` with arguments.
fn sweep(arguments: &[&str]) -> Output {
    crate::run("sweep", arguments)
}

/// Sweeps one second of the double pendulum by the text of a sweep. Returns the JSON and the table without its last column, CPU time.
fn table(out: &Path, text: &str, more: &[&str]) -> (Value, Vec<String>) {
    let file = out.join("sweep.toml");
    std::fs::write(&file, text).expect("the scratch directory is ours");
    let (file, out) = (file.to_str().expect("UTF-8"), out.to_str().expect("UTF-8"));
    let scene = scene("double-pendulum");
    let fixed = [&scene, file, "--out", out, "--json", "--duration", "1"];
    let report = json(&sweep(&[&fixed, more].concat()));
    (report, rows(Path::new(out)))
}

/// The rows of a table without CPU time.
fn rows(out: &Path) -> Vec<String> {
    let table = std::fs::read_to_string(out.join("table.csv")).expect("the table is there");
    let cut = |line: &str| line.rsplit_once(',').map(|(row, _)| row.to_owned());
    table.lines().filter_map(cut).collect()
}

/// Sweep of twelve members. It varies masses, which changes no places.
const MASSES: &str = "[sweep]\ncombine = 'latin-hypercube'\nsamples = 12\nseed = 3\n\
    [[vary]]\npath = 'body.upper.mass'\nfrom = 0.5\nto = 2\n\
    [[vary]]\npath = 'body.lower.mass'\nfrom = 0.01\nto = 100\nscale = 'log'\n";

#[test]
fn any_number_of_threads_gives_the_same_table() {
    let tables = ["1", "2", "3"].map(|threads| {
        let out = scratch(&format!("threads-{threads}"));
        let (report, rows) = table(&out, MASSES, &["--threads", threads]);
        assert_eq!(report["threads"].to_string(), threads);
        assert_eq!((&report["members"], &report["completed"]), (&12.into(), &12.into()));
        rows
    });
    assert_eq!(tables[0].len(), 13, "a header and twelve rows");
    assert!(tables[0][1].starts_with("1,") && tables[0][12].starts_with("12,"));
    assert_eq!(tables[0], tables[1]);
    assert_eq!(tables[0], tables[2]);
}

#[test]
fn the_page_of_a_sweep_has_a_diagram_for_each_result_and_parameter() {
    let out = scratch("page");
    let (_, rows) = table(&out, MASSES, &["--page", "--traces", "3"]);
    let html = std::fs::read_to_string(out.join("sweep.html")).expect("the page is there");
    // each output has three columns: its end, its least and its largest value
    let outputs = rows[0].split(',').filter(|name| name.ends_with(".min")).count();
    assert!(outputs > 0);
    assert_eq!(html.matches("data-diagram=").count(), 2 * outputs);
    assert_eq!(html.matches("data-panel=").count(), outputs);
    assert!(html.contains("Traces of 3 members") && html.contains("<summary>Members"));
    // the sentence occurs in the caption, and as the text of the picture
    assert_eq!(html.matches("The band is the least").count(), 2 * outputs);
    // the page shows the numbers of a member without scripts: each output in its table
    assert_eq!(html.matches("<details><summary class=\"row\">").count(), 12);
    assert_eq!(html.matches("<td>energy_max_error</td>").count(), 12);
    let refused = sweep(&[&scene("double-pendulum"), "sweep.toml", "--traces", "3"]);
    assert_eq!(status(&refused), 1, "traces are drawn on a page");
}

#[test]
fn a_member_is_the_run_of_the_scene_with_its_numbers() {
    let out = scratch("member");
    let text = "[[vary]]\npath = 'body.lower.mass'\nvalues = [2.5]\n";
    let (_, rows) = table(&out, text, &[]);
    let file = out.join("scene.toml");
    let text = std::fs::read_to_string(scene("double-pendulum")).expect("the scene is there");
    let (head, lower) = text.split_once("name = \"lower\"").expect("the scene has a lower rod");
    let lower = lower.replacen("mass = 1.0", "mass = 2.5", 1);
    std::fs::write(&file, format!("{head}name = \"lower\"{lower}")).expect("a scratch file");
    let [file, place] = [&file, &out].map(|path| path.to_str().expect("UTF-8"));
    let run = crate::run("run", &[file, "--json", "--duration", "1", "--out", place]);
    let summary = json(&run);
    let cells: Vec<&str> = rows[1].split(',').collect();
    let cell = |name: &str| {
        let column = rows[0].split(',').position(|column| column == name);
        cells[column.unwrap_or_else(|| panic!("no column {name}"))].parse::<f64>().unwrap()
    };
    let same = |name: &str, value: &Value| {
        assert_eq!(cell(name).to_bits(), value.as_f64().unwrap().to_bits(), "{name}");
    };
    same("steps", &summary["steps"]);
    same("end_time", &summary["end_time"]);
    same("energy_max_error", &summary["energy"]["max_error"]);
    same("violation_velocity", &summary["violation"]["velocity"]);
    same("tip.x", &summary["outputs"]["tip"][0]);
    let csv = std::fs::read_to_string(out.join("run.csv")).expect("the rows of the run");
    let tip =
        csv.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().parse::<f64>().unwrap());
    assert_eq!(cell("tip.x.min").to_bits(), tip.fold(f64::INFINITY, f64::min).to_bits());
}

#[test]
fn members_that_fail_keep_their_rows_and_leave_the_others() {
    // member 2 has a rod without length; member 4 has a step at which the check of the energy stops the run
    let text = "[sweep]\ncombine = 'zip'\n\
        [[vary]]\npath = 'body.lower.rod.to[0]'\nvalues = [2.0, 1.0, 2.5, 2.0]\n\
        [[vary]]\npath = 'solver.step'\nvalues = [1e-3, 1e-3, 1e-3, 0.25]\n";
    let out = scratch("failing");
    let (report, rows) = table(&out, text, &["--threads", "2"]);
    assert_eq!((&report["members"], &report["completed"]), (&4.into(), &2.into()));
    assert_eq!(report["failed"]["scene-refused"], 1);
    assert_eq!(report["failed"].as_object().map(|codes| codes.len()), Some(2), "{report}");
    assert_eq!(rows.len(), 5);
    assert!(rows[1].contains(",true,,,") && rows[3].contains(",true,,,"));
    assert!(
        rows[2].contains("false,scene-refused") && rows[2].contains("scenes/double-pendulum.toml:"),
        "{}",
        rows[2]
    );
    assert!(rows[4].contains("false,"), "{}", rows[4]);
    let file = out.join("sweep.toml");
    let (scene, file) = (scene("double-pendulum"), file.display());
    let again = run_line(&format!("sweep {scene} {file} --out {} --duration 1", out.display()));
    assert_eq!(status(&again), 2);
    let text = String::from_utf8_lossy(&again.stdout).into_owned();
    assert!(
        text.contains("2 of 4 members completed")
            && text.contains("4 members finished by an earlier start"),
        "{text}"
    );
    assert!(text.contains("1 member ended in scene-refused, first 2: "), "{text}");
}

#[test]
fn a_killed_sweep_resumes_where_it_was() {
    let out = scratch("resume");
    let (_, whole) = table(&out, MASSES, &["--threads", "2"]);
    let journal = std::fs::read(out.join("sweep.journal")).expect("the journal is there");
    let ends: Vec<usize> =
        (0..journal.len()).filter(|&i| journal[i] == b'\n').map(|i| i + 1).collect();
    assert_eq!(ends.len(), 13, "a head and twelve members");
    // the journal is cut within the head, after it, within a member, before and after a line end
    for (cut, resumed) in [(5, 0), (ends[0], 0), (ends[4] + 7, 4), (ends[9] - 1, 8), (ends[9], 9)] {
        std::fs::write(out.join("sweep.journal"), &journal[..cut]).unwrap();
        std::fs::remove_file(out.join("table.csv")).expect("the table is there");
        let (report, rows) = table(&out, MASSES, &["--threads", "1"]);
        assert_eq!(report["resumed"], resumed, "cut at byte {cut}");
        assert_eq!(rows, whole, "cut at byte {cut}");
        let journal = std::fs::read_to_string(out.join("sweep.journal")).unwrap();
        assert_eq!(journal.lines().count(), 13, "every member has one whole line");
    }
}

#[test]
fn a_process_that_is_killed_loses_no_finished_member() {
    let out = scratch("killed");
    let text = MASSES.replace("samples = 12", "samples = 400");
    let file = out.join("sweep.toml");
    std::fs::write(&file, &text).unwrap();
    let [scene, file, place] = [scene("double-pendulum"), plain(file), plain(out.clone())];
    let mut child = crate::mbs("sweep")
        .args([&scene, &file, "--out", &place, "--json", "--duration", "1"])
        .stdout(std::process::Stdio::null())
        .spawn()
        .expect("the command is built");
    let lines = || {
        std::fs::read_to_string(out.join("sweep.journal")).map_or(0, |text| text.lines().count())
    };
    while lines() < 20 && child.try_wait().expect("our child").is_none() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    child.kill().expect("our child");
    child.wait().expect("our child");
    let (report, rows) = table(&out, &text, &[]);
    assert!(report["resumed"].as_u64().is_some_and(|n| n >= 18), "{report}");
    assert_eq!(rows.len(), 401);
}

#[test]
fn parts_make_the_table_of_one_run_and_those_that_lack_are_named() {
    let out = scratch("parts");
    let (_, whole) = table(&out, MASSES, &[]);
    // with seven parts of twelve members, parts have different numbers of members
    for of in [1, 2, 7] {
        let parts = out.join(format!("of-{of}"));
        let part = |k: usize| format!("{k}/{of}");
        let place = plain(parts.clone());
        let base = [
            &scene("double-pendulum"),
            &plain(out.join("sweep.toml")),
            "--duration",
            "1",
            "--out",
            &place,
        ];
        let run = |more: &[&str]| sweep(&[&base, more].concat());
        // all parts but the first run at the same time, as a scheduler starts them
        std::thread::scope(|scope| {
            let all: Vec<_> =
                (2..=of).map(|k| scope.spawn(move || (k, run(&["--part", &part(k)])))).collect();
            for (k, output) in all.into_iter().map(|thread| thread.join().expect("no panic")) {
                assert_eq!(status(&output), 0, "{k}: {output:?}");
            }
        });
        let lacks = run(&["--join"]);
        let told = String::from_utf8_lossy(&lacks.stderr).into_owned();
        let (code, why) = if of == 1 { (1, "there are no parts") } else { (2, "part 1/") };
        assert_eq!(status(&lacks), code, "{told}");
        assert!(told.contains(why), "{told}");
        let first = run(&["--part", &part(1)]);
        assert!(String::from_utf8_lossy(&first.stdout).contains("--join"), "{first:?}");
        let joined = json(&run(&["--join", "--json"]));
        assert_eq!((&joined["members"], &joined["completed"]), (&12.into(), &12.into()));
        assert_eq!(rows(&parts), whole, "{of} parts");
    }
    for (wrong, why) in
        [(["--part", "3/2"], "write K/N"), (["--join", "--restart"], "cannot be used")]
    {
        assert!(refusal(MASSES, &wrong).contains(why), "{wrong:?}");
    }
}

#[test]
fn the_recipes_for_parts_run_as_they_are_written() {
    let text = include_str!("../../../docs/SWEEPS.md");
    let out = scratch("recipes");
    let [double, program] = [scene("double-pendulum"), plain(env!("CARGO_BIN_EXE_mbs").into())];
    std::fs::copy(double, out.join("scene.toml")).expect("the scratch directory is ours");
    std::fs::write(out.join("sweep.toml"), MASSES).expect("the scratch directory is ours");
    let shell = |line: &str| {
        let line = line.replace("mbs sweep", &format!("{program} sweep --duration 1"));
        let output =
            std::process::Command::new("sh").args(["-c", &line]).current_dir(&out).output();
        let output = output.expect("there is a shell");
        assert!(output.status.success(), "{line}: {output:?}");
    };
    let line = |start: &str| text.lines().find(|line| line.starts_with(start)).expect("a recipe");
    shell(line("seq 4 | xargs"));
    shell(line("mbs sweep scene.toml sweep.toml --join"));
    assert_eq!(rows(&out.join("out")).len(), 13);
    // an array of jobs uses the same line with its own number
    let array = line("mbs sweep scene.toml sweep.toml --part $SLURM");
    std::fs::remove_dir_all(out.join("out")).expect("it is there");
    shell(&format!("for SLURM_ARRAY_TASK_ID in 1 2 3 4; do {}; done", array.replace("/40", "/4")));
    shell(line("mbs sweep scene.toml sweep.toml --join"));
    assert_eq!(rows(&out.join("out")).len(), 13);
}

#[test]
fn another_sweep_in_the_same_directory_is_refused_until_restart() {
    let out = scratch("other");
    table(&out, MASSES, &[]);
    let changed = MASSES.replace("seed = 3", "seed = 4");
    let file = out.join("sweep.toml");
    std::fs::write(&file, &changed).unwrap();
    let scene = scene("double-pendulum");
    let base = [&scene, file.to_str().unwrap(), "--out", out.to_str().unwrap(), "--json"];
    let refused = |more: &[&str], what: &str| {
        let output = sweep(&[&base, more].concat());
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(status(&output), 1, "{told}");
        assert!(told.contains(what) && told.contains("--restart"), "{told}");
    };
    refused(&["--duration", "1"], "the sweep has changed");
    std::fs::write(&file, MASSES).unwrap();
    refused(&["--duration", "0.5"], "an option has changed");
    let (report, rows) = table(&out, &changed, &["--restart"]);
    assert_eq!((&report["resumed"], rows.len()), (&0.into(), 13));
    std::fs::write(out.join("sweep.journal"), "my diary\n").unwrap();
    let output = sweep(&base);
    assert_eq!(status(&output), 1);
    assert!(String::from_utf8_lossy(&output.stderr).contains("is not the journal of a sweep"));
    assert_eq!(std::fs::read_to_string(out.join("sweep.journal")).unwrap(), "my diary\n");
}

/// Runs a sweep that is refused, in a folder of its own since tests run in parallel. Returns the standard error.
fn refusal(text: &str, more: &[&str]) -> String {
    static N_REFUSALS: AtomicUsize = AtomicUsize::new(0);
    let out = scratch(&format!("refusal-{}", N_REFUSALS.fetch_add(1, Ordering::Relaxed)));
    let file = out.join("sweep.toml");
    std::fs::write(&file, text).expect("the scratch directory is ours");
    let results = out.join("results");
    let scene = scene("double-pendulum");
    let (file, directory) = (plain(file), plain(results.clone()));
    let fixed = [scene.as_str(), &file, "--out", &directory];
    let output = sweep(&[&fixed, more].concat());
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(status(&output), 1, "{told}");
    assert!(output.stdout.is_empty() && !results.exists(), "nothing is run or written");
    told
}

#[test]
fn wrong_sweeps_are_refused_with_their_place_before_anything_runs() {
    let mass = |more: &str| format!("[[vary]]\npath = 'body.lower.mass'\n{more}\n");
    let cases = [
        (mass("values = [1.0, -1.0]"), "sweep.toml:3:16: the scene refuses -1.0", "hint: "),
        (mass("values = [1.0, oops]"), "sweep.toml:3:16: not TOML", "hint: "),
        (mass("from = 1"), "sweep.toml:1:1: `to` is missing", "hint: add `to`"),
        (
            mass("values = [1.0]").replace("lower", "lowr"),
            "sweep.toml:2:8: the scene has no [[body]] called `lowr`",
            "did you mean `lower`?",
        ),
        (
            "[[vary]]\npath = 'solver.step'\nvalues = [1e-3, 0]\n".to_owned(),
            "sweep.toml:3:17: the scene refuses 0",
            "zero",
        ),
    ];
    for (text, message, hint) in cases {
        let told = refusal(&text, &[]);
        assert!(told.contains(message) && told.contains(hint) && told.contains('^'), "{told}");
    }
    let step = "[[vary]]\npath = 'solver.step'\nvalues = [1e-3, 2e-3]\n";
    assert!(refusal(step, &["--step", "1e-2"]).contains("varies `solver.step`"));
    assert!(refusal(step, &["--threads", "0"]).contains("--threads"));
    assert!(refusal(step, &["--formulation", "indx-3"]).contains("did you mean `index-3`?"));
}

#[test]
fn a_missing_file_is_named_for_what_it_should_be() {
    let scene = scene("double-pendulum");
    let output = sweep(&[&scene, "no-such-sweep.toml"]);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(status(&output), 1);
    assert!(
        told.contains("no-such-sweep.toml") && told.contains("the path of a sweep file"),
        "{told}"
    );
}

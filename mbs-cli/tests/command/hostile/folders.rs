//! Directories of results: one process at a time may use them, old results stay until the new ones are complete, and mixed results give a
//! warning.

use super::{Place, ended, output, results, wait_for};
use crate::{json, text};
use std::process::{Command, Stdio};

#[test]
fn two_commands_into_one_directory_are_one_too_many() {
    let place = Place::new("busy");
    let mut first = place.run("--step 1e-4 --duration 1e5 --out out");
    let mut first = first.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it is built");
    let number = first.id().to_string();
    let lock = || std::fs::read_to_string(place.0.join("out/.lock")).unwrap_or_default();
    wait_for("the lock", || lock().trim() == number);
    place.put("s.toml", "[[vary]]\npath = 'body.bar.mass'\nvalues = [1.0, 2.0]\n");
    for other in
        ["run p.toml", "explain p.toml", "doctor p.toml", "modes p.toml", "sweep p.toml s.toml"]
    {
        let refused = ended(&mut place.mbs(&format!("{other} --out out --json")));
        let said = text(&refused.stderr);
        assert_eq!(refused.status.code(), Some(1), "{other}: {said}");
        assert!(said.contains(&format!("being written by process {number}")), "{other}: {said}");
        assert_eq!(json(&refused)["error"]["code"], "out-busy", "{other}");
    }
    first.kill().expect("it runs");
    first.wait().expect("our child");
    // the lock of a killed process is free again
    assert_eq!(ended(&mut place.run("--out out")).status.code(), Some(0));
    assert_eq!(place.names("out"), ["run.csv", "run.html", "run.json", "steps.csv"]);
}

#[test]
fn many_commands_at_once_leave_the_results_of_one() {
    let place = Place::new("race");
    let start = |k: usize| {
        let mut command = place.run(&format!("--step 1e-{} --out out", 3 + k % 2));
        command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("it is built")
    };
    let all: Vec<_> = (0..8).map(start).collect();
    let ends: Vec<_> = all.into_iter().map(|child| output(child, "a run").status.code()).collect();
    assert!(
        ends.iter().all(|end| matches!(end, Some(0 | 1))) && ends.contains(&Some(0)),
        "{ends:?}"
    );
    assert_eq!(mbs::folder::Folder::mixed(&place.0.join("out")), None);
    assert_eq!(place.names("out"), ["run.csv", "run.html", "run.json", "steps.csv"]);
}

#[test]
fn a_full_disk_keeps_the_results_before_and_the_summary() {
    let place = Place::new("full");
    assert_eq!(ended(&mut place.run("--out out")).status.code(), Some(0));
    let old = results(&place.0.join("out"));
    for (options, left) in [("", false), ("--checkpoint 0.02", true)] {
        let mut shell = Command::new("bash");
        // the limit of a file is 300 kB, and the rows of this step need more
        let line = "ulimit -f 300; exec $M run p.toml --no-estimate --step 1e-5 --out out --json";
        shell.args(["-c", &format!("{line} {options}")]).current_dir(&place.0);
        let said = ended(shell.env("M", env!("CARGO_BIN_EXE_mbs")));
        let errors = text(&said.stderr);
        assert_eq!(said.status.code(), Some(2), "{errors}");
        assert!(errors.contains("run.csv") && errors.contains("after 307200 bytes"), "{errors}");
        let object = json(&said);
        assert_eq!((&object["completed"], &object["steps"]), (&true.into(), &10_000.into()));
        assert!(results(&place.0.join("out")) == old);
        let checkpoint = place.0.join("out/checkpoint.mbs");
        assert_eq!(place.names("out").len(), 4 + usize::from(left && checkpoint.exists()));
    }
}

#[test]
fn results_of_two_runs_are_reported_when_they_are_met() {
    let place = Place::new("mixed");
    assert_eq!(ended(&mut place.run("--out out")).status.code(), Some(0));
    assert_eq!(ended(&mut place.run("--step 1e-4 --out other")).status.code(), Some(0));
    let object = json(&ended(&mut place.run("--out out --json")));
    assert_eq!(object["files"]["run.csv"], place.read("out/run.csv").len());
    assert!(text(&place.read("out/run.html")).contains(object["id"].as_str().expect("an id")));
    for file in ["steps.csv", "run.html"] {
        std::fs::copy(place.0.join("other").join(file), place.0.join("out").join(file)).unwrap();
        let met = ended(&mut place.mbs("modes p.toml --out out"));
        let said = text(&met.stderr);
        assert_eq!(met.status.code(), Some(0), "{said}");
        assert!(said.contains("warning: ") && said.contains(file), "{said}");
        assert_eq!(ended(&mut place.run("--out out")).status.code(), Some(0));
    }
    let met = ended(&mut place.mbs("modes p.toml --out out"));
    assert!(met.stderr.is_empty(), "{}", text(&met.stderr));
}

#[test]
fn a_file_is_replaced_whole_or_not_at_all() {
    let place = Place::new("single");
    for line in ["generate chain --count 40 -o made", "export p.toml --rust made"] {
        place.put("made", "mine");
        let mut shell = Command::new("bash");
        shell.args(["-c", &format!("ulimit -f 1; exec $M {line}")]).current_dir(&place.0);
        let full = ended(shell.env("M", env!("CARGO_BIN_EXE_mbs")));
        assert_eq!(full.status.code(), Some(1), "{line}: {}", text(&full.stderr));
        assert_eq!(place.read("made"), b"mine", "{line}");
        assert_eq!(ended(&mut place.mbs(line)).status.code(), Some(0), "{line}");
        assert!(place.read("made").len() > 1024, "{line}");
        assert_eq!(place.names("."), ["made", "p.toml"], "{line}");
    }
}

#[test]
fn threads_beyond_use_give_the_bits_of_one() {
    let place = Place::new("threads");
    let rows = |threads: &str| {
        let made = ended(&mut place.run(&format!("--threads {threads} --out {threads}")));
        assert_eq!(made.status.code(), Some(0), "{}", text(&made.stderr));
        (place.read(&format!("{threads}/run.csv")), text(&made.stdout))
    };
    let ((one, plain), (many, noted)) = (rows("1"), rows("1000"));
    assert!(one == many && !plain.contains("note:"));
    assert!(noted.contains("note: 1 thread is used, not 1000"), "{noted}");
}

#[test]
fn a_sweep_on_a_full_disk_says_what_it_knows() {
    let place = Place::new("swept");
    let values = (1..=40).map(|k| format!("{k}.0")).collect::<Vec<_>>().join(", ");
    place.put("s.toml", format!("[[vary]]\npath = 'body.bar.mass'\nvalues = [{values}]\n"));
    let line = "sweep p.toml s.toml --duration 0.01 --out out --json";
    assert_eq!(ended(&mut place.mbs(line)).status.code(), Some(0));
    let (table, journal) = (place.read("out/table.csv"), place.read("out/sweep.journal"));
    // the journal exists already, and the table exceeds the limit of a file
    let mut shell = Command::new("bash");
    shell.args(["-c", &format!("ulimit -f 1; exec $M {line}")]).current_dir(&place.0);
    let said = ended(shell.env("M", env!("CARGO_BIN_EXE_mbs")));
    assert_eq!(said.status.code(), Some(2), "{}", text(&said.stderr));
    assert!(text(&said.stderr).contains("table.csv"), "{}", text(&said.stderr));
    assert_eq!(json(&said)["completed"], 40);
    assert!(place.read("out/table.csv") == table && place.read("out/sweep.journal") == journal);
}

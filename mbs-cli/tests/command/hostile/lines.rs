//! A table of wrong command lines, with the expected results.

use super::{Place, output};
use crate::{json, text};
use std::process::{Command, Stdio};

/// A line of a shell, in which `$M` is the command; its exit status; and a part of its standard error.
type Line = (&'static str, i32, &'static str);

const PATHS: &[Line] = &[
    ("$M", 1, "Usage"),
    ("$M nonsense", 1, "unrecognized subcommand"),
    ("$M run", 1, "<SCENE>"),
    ("$M run --json", 1, "<SCENE>"),
    ("$M sweep p.toml", 1, "<SWEEP>"),
    ("$M export p.toml", 1, "--rust"),
    ("$M generate chain", 1, "--count is missing"),
    ("$M run p.toml --step", 1, "--step"),
    ("$M run p.toml --checkpoint 1", 1, "--out"),
    ("$M compare p.toml --resume", 1, "--out"),
    ("$M run nowhere.toml --json", 1, "cannot read `nowhere.toml`"),
    ("$M run p --json", 1, "did you mean `p.toml`?"),
    ("$M run dir.toml --json", 1, "that is a directory"),
    ("$M run p.toml/", 1, "cannot read"),
    ("$M run ''", 1, "<SCENE>"),
    ("$M run loop.toml", 1, "cannot read"),
    ("$M run dangling.toml", 1, "cannot read"),
    ("$M run $(printf 'x%.0s' $(seq 5000))", 1, "cannot read"),
    ("$M run \"$(printf 'a\\377b')\"", 1, "cannot read"),
    ("$M run /dev/null --json", 1, "`[scene]` is missing"),
    ("$M run /dev/zero --json", 1, "larger than 64 MiB"),
    ("$M run big.toml --json", 1, "write --big"),
    ("$M run big.toml --big", 1, "not TOML"),
    ("$M run values.toml --json", 1, "more than 8 million values"),
    ("$M sweep dir.toml s.toml", 1, "that is a directory"),
    ("$M sweep p.toml dir.toml --json", 1, "that is a directory"),
    ("$M sweep p.toml /dev/zero", 1, "larger than 64 MiB"),
    ("$M explain dir.toml --json", 1, "that is a directory"),
    ("$M doctor dir.toml --json", 1, "that is a directory"),
    ("$M equilibrium dir.toml --json", 1, "that is a directory"),
    ("$M modes nowhere.toml --json", 1, "cannot read"),
    ("$M generate convoy --count 2 --of dir.toml", 1, "that is a directory"),
    ("$M export p.toml --rust r.rs --ladder dir.toml", 1, "that is a directory"),
    ("$M export p.toml --rust r.rs --ladder /dev/zero", 1, "larger than 64 MiB"),
    ("$M export p.toml --rust r.rs --ladder noise", 1, "not JSON"),
    ("$M run p.toml --out old --resume=noise --json", 1, "no checkpoint"),
    ("$M run p.toml --out old --resume=dir.toml --json", 1, "cannot be read"),
    ("$M run p.toml --out old --resume=/dev/zero", 1, "no checkpoint"),
    ("$M run p.toml --out old --resume", 1, "there is no checkpoint"),
    ("$M run p.toml --resume", 1, "--out"),
];

const PLACES: &[Line] = &[
    ("$M run p.toml --out file --json", 1, "that is a file"),
    ("$M run p.toml --out file/deep --json", 1, "cannot write to `file/deep`"),
    ("$M run p.toml --out ''", 1, "--out"),
    ("$M run p.toml --out /dev/null", 1, "cannot write"),
    ("$M run p.toml --out /proc/none/such", 1, "cannot write"),
    ("$M run p.toml --out $(printf 'x%.0s' $(seq 300))", 1, "cannot write"),
    ("$M run p.toml --out taken --json", 1, "run.csv` is a directory"),
    ("$M sweep p.toml s.toml --out file --json", 1, "that is a file"),
    ("$M explain p.toml --out file --json", 1, "that is a file"),
    ("$M doctor p.toml --out file --json", 1, "that is a file"),
    ("$M equilibrium p.toml --out file --json", 1, "that is a file"),
    ("$M modes p.toml --out file --json", 1, "that is a file"),
    ("$M generate chain --count 2 -o dir.toml", 1, "is a directory"),
    ("$M generate chain --count 2 -o file/deep", 1, "not a directory"),
    ("$M generate chain --count 2 -o /dev/full", 1, "no space left"),
    ("$M export p.toml --rust dir.toml/../p.toml", 1, "the scene that is read"),
    ("$M export p.toml --rust dir.toml", 1, "is a directory"),
    ("$M export p.toml --binary /dev/full", 1, "no space left"),
    ("$M generate chain --count 2 -o /dev/stdout | grep -q body", 0, ""),
    ("$M run p.toml --no-estimate --out left", 0, ""),
    ("$M run nowhere.toml --out old", 1, "cannot read"),
    ("$M run p.toml --out old --step 0", 1, "positive"),
    ("$M run p.toml --out old --penalty 1e308", 2, "the results that are in `old` stay there"),
];

const TEXTS: &[Line] = &[
    ("$M run empty.toml --json", 1, "`[scene]` is missing"),
    ("$M run utf16.toml --json", 1, "not UTF-8"),
    ("$M run cut.toml --json", 1, "not TOML"),
    ("$M run nul.toml --json", 1, "not TOML"),
    ("$M run deep.toml --json", 1, "not TOML"),
    ("$M run long.toml --json", 1, "`dimension` is missing"),
    ("$M run noise --json", 1, ""),
    ("$M run bom.toml --no-estimate", 0, ""),
    ("$M run crlf.toml --no-estimate", 0, ""),
    ("$M sweep p.toml p.toml --json", 1, "unknown key `scene`"),
    ("$M sweep p.toml noise --json", 1, ""),
    ("$M sweep p.toml many.toml --json", 1, "does not count"),
];

const NUMBERS: &[Line] = &[
    ("$M run p.toml --step -1e-3 --json", 1, "step must be positive"),
    ("$M run p.toml --step -1 --json", 1, "step must be positive"),
    ("$M run p.toml --step nan", 1, "NaN"),
    ("$M run p.toml --step inf", 1, "inf"),
    ("$M run p.toml --step 1e-300", 1, "too short"),
    ("$M run p.toml --step 1e999", 1, "inf"),
    ("$M run p.toml --step 0x10", 1, "invalid"),
    ("$M run p.toml --duration 1e300", 1, "too short for a run"),
    ("$M run p.toml --duration -1e-9", 1, "duration must be positive"),
    ("$M run p.toml --tolerance 0 --json", 1, "tolerance must be positive"),
    ("$M run p.toml --tolerance -1e-9", 1, "tolerance must be positive"),
    ("$M run p.toml --penalty -1e9", 1, "penalty must be positive"),
    ("$M run p.toml --penalty 1e308 --json", 2, ""),
    ("$M run p.toml --energy-alarm 0", 1, "energy_alarm"),
    ("$M run p.toml --energy-alarm 1e-300", 2, "the energy is off"),
    ("$M run p.toml --energy-tolerance 1", 1, "two numbers"),
    ("$M run p.toml --energy-tolerance 1e-5,1e-3", 1, "larger than L"),
    ("$M run p.toml --threads 0 --json", 1, "threads must be positive"),
    ("$M run p.toml --threads -1", 1, "-1"),
    ("$M run p.toml --threads 18446744073709551616", 1, "too large"),
    ("$M run p.toml --no-estimate --threads 1000 --json", 0, ""),
    ("$M run p.toml --no-estimate --threads 18446744073709551615", 0, ""),
    ("$M sweep p.toml s.toml --out swept --threads 100000 --json", 0, "note: 2 threads"),
    ("$M sweep p.toml s.toml --out other --threads 0", 1, "--threads"),
    ("$M run p.toml --error 0 --json", 1, "required error"),
    ("$M run p.toml --error -1e-3", 1, "required error"),
    ("$M run p.toml --error nan", 1, "required error"),
    ("$M run p.toml --error 1e300", 1, "required error"),
    ("$M run p.toml --deadline 0", 1, "deadline"),
    ("$M run p.toml --deadline 1e300", 1, "deadline"),
    ("$M run p.toml --out old --checkpoint nan --json", 1, "between checkpoints"),
    ("$M run p.toml --out old --checkpoint -1e-3", 1, "between checkpoints"),
    ("$M run p.toml --no-estimate --out kept --checkpoint 1e-300 --step 0.01", 0, ""),
    ("$M run p.toml --realtime --period 0 --json", 1, "period"),
    ("$M run p.toml --realtime --period 1e300", 1, "period"),
    ("$M run p.toml --realtime --awake -1e-3", 1, "awake"),
    ("$M run p.toml --integrator radau5 --tolerance 1e-300", 2, "step"),
    ("$M run p.toml --integrator gbs --tolerance 1e300", 0, ""),
    ("$M generate chain --count 0", 1, "at least 1"),
    ("$M generate chain --count -1", 1, "-1"),
    ("$M generate chain --count 18446744073709551615", 1, "at most"),
    ("$M generate net --rows 99999999 --columns 99999999", 1, "at most"),
    ("$M generate tree --count 4611686018427387904", 1, "at most"),
    ("$M generate n-four-bar --count 99999999999", 1, "at most"),
    ("$M generate convoy --count 99999999999 --of p.toml", 1, "at most"),
    ("$M generate convoy --count 2 --of p.toml --spacing nan", 1, "positive"),
    ("$M explain p.toml --step -1e-3 --json", 1, "step must be positive"),
    ("$M doctor p.toml --duration -1e300 --json", 1, "duration must be positive"),
    ("$M doctor p.toml --duration 1e300", 1, "too short for a run"),
    ("$M modes p.toml --at nonsense", 1, "--at"),
    ("$M modes p.toml --near --at initial --json", 1, "--near"),
];

const OUTPUTS: &[Line] = &[
    ("$M run p.toml --no-estimate --json > /dev/full", 2, "\"completed\": true"),
    ("$M run p.toml --no-estimate > /dev/full", 2, "no space left"),
    ("$M run p.toml --no-estimate > /dev/full 2>&1", 2, ""),
    ("$M run nowhere.toml 2> /dev/full", 1, ""),
    ("$M run nowhere.toml --json > /dev/full 2>&1", 2, ""),
    ("$M run nonsense --step 2> /dev/full", 1, ""),
    ("$M --help > /dev/full", 2, "no space left"),
    ("$M --version > /dev/full", 2, "no space left"),
    ("$M generate chain --count 2 > /dev/full", 2, "no space left"),
    ("$M sweep p.toml s.toml --out full > /dev/full", 2, "2 of 2 members"),
    ("$M explain p.toml --json > /dev/full", 2, "\"prices\""),
    ("$M doctor p.toml --json > /dev/full", 2, "no space left"),
    ("$M equilibrium p.toml --json > /dev/full", 2, "no space left"),
    ("$M modes p.toml --json > /dev/full", 2, "no space left"),
    ("set -o pipefail; $M run p.toml --no-estimate --json | true", 0, ""),
    ("set -o pipefail; $M generate chain --count 3000 | head -1 > /dev/null", 0, ""),
    ("set -o pipefail; $M --help | true", 0, ""),
    ("$M run p.toml --no-estimate >&-", 0, ""),
    ("$M run p.toml --no-estimate 2>&-", 0, ""),
    ("$M run nowhere.toml >&- 2>&-", 1, ""),
    ("$M run p.toml --no-estimate <&-", 0, ""),
];

/// Makes the files and folders that the lines use.
fn hostile(name: &str) -> Place {
    let place = Place::new(name);
    let scene = place.read("p.toml");
    place.put("s.toml", "[[vary]]\npath = 'body.bar.mass'\nvalues = [1.0, 2.0]\n");
    place.put(
        "many.toml",
        "[sweep]\ncombine = 'latin-hypercube'\nsamples = 9223372036854775807\nseed = 1\n\
         [[vary]]\npath = 'body.bar.mass'\nfrom = 1.0\nto = 2.0\n",
    );
    place.put("empty.toml", "");
    place.put("file", "mine");
    place.put("utf16.toml", [0xff, 0xfe, b'[', 0]);
    place.put("bom.toml", [&[0xef, 0xbb, 0xbf][..], &scene].concat());
    place.put("crlf.toml", super::SCENE.replace('\n', "\r\n"));
    place.put("cut.toml", &scene[..250]);
    place.put("nul.toml", [0; 1000]);
    place.put("deep.toml", format!("a = {}1{}", "[".repeat(5000), "]".repeat(5000)));
    place.put("long.toml", format!("[scene]\nname = \"{}\"\n", "x".repeat(1_000_000)));
    let noise = (0..5000_u32).map(|k| (k.wrapping_mul(2_654_435_761) >> 24) as u8);
    place.put("noise", noise.collect::<Vec<_>>());
    let make = |name: &str| std::fs::create_dir_all(place.0.join(name)).expect("it is ours");
    ["dir.toml", "taken/run.csv", "left/.part"].into_iter().for_each(make);
    place.put("left/.part/run.csv", "t\n");
    // a sparse file, which needs no space on the disk
    let big = std::fs::File::create(place.0.join("big.toml")).expect("it is ours");
    big.set_len(65 << 20).expect("a file of any size");
    place.put("values.toml", format!("x = [{}]\n", "1,".repeat(8_000_001)));
    for (name, to) in [("dangling.toml", "nowhere"), ("loop.toml", "loop.toml")] {
        std::os::unix::fs::symlink(to, place.0.join(name)).expect("a link");
    }
    let made = super::ended(&mut place.run("--out old"));
    assert_eq!(made.status.code(), Some(0), "{}", text(&made.stderr));
    place
}

/// Runs the lines of a table one by one. The results in the folder `old` must not change.
fn all(name: &str, lines: &[Line]) {
    let place = hostile(name);
    let old = super::results(&place.0.join("old"));
    assert_eq!(old.len(), 4);
    for (line, status, says) in lines {
        let mut shell = Command::new("bash");
        // the system ends a process after 50 s of CPU time
        shell.args(["-c", &format!("ulimit -t 50; {line}")]).current_dir(&place.0);
        shell.env("M", env!("CARGO_BIN_EXE_mbs")).stdin(Stdio::null());
        let child = shell.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
        let ended = output(child.expect("a shell"), line);
        let said = text(&ended.stderr);
        assert!(!said.contains("panicked"), "{line}: {said}");
        assert_eq!(ended.status.code(), Some(*status), "{line}: {said}");
        assert!(said.contains(says), "{line}: {said}");
        if line.ends_with("--json") {
            let object = json(&ended);
            let error = &object["error"];
            assert!(*status == 0 || error["code"].is_string(), "{line}: {object}");
            let hint = error["hint"].as_str().unwrap_or_default();
            assert!(*status != 1 || said.contains(hint), "{line}: {object} {said}");
        }
        assert!(super::results(&place.0.join("old")) == old, "{line}: it has lost what was there");
        assert_eq!(place.read("file"), b"mine", "{line}");
        assert_eq!(place.read("p.toml"), super::SCENE.as_bytes(), "{line}");
    }
    assert_eq!(place.names("old"), ["run.csv", "run.html", "run.json", "steps.csv"]);
}

#[test]
fn bad_paths_are_refused() {
    all("paths", PATHS);
}

#[test]
fn bad_places_for_results_are_refused_and_what_is_there_stays() {
    all("places", PLACES);
}

#[test]
fn bad_texts_are_refused() {
    all("texts", TEXTS);
}

#[test]
fn bad_numbers_are_refused() {
    all("numbers", NUMBERS);
}

#[test]
fn full_and_closed_outputs_lose_nothing() {
    all("outputs", OUTPUTS);
}

//! Hostile conditions that the command meets in the field: bad paths, torn texts, full disks, signals, other processes, kills. Nothing panics,
//! nothing hangs, and nothing that was there is lost.

mod folders;
mod killed;
mod lines;
mod signals;

use crate::files::scratch;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Longer than any of these commands takes on a loaded machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// A pendulum, which runs for a tenth of a second of its time.
const SCENE: &str = r#"[scene]
name = "one"
dimension = 2
gravity = [0.0, -9.81]
duration = 0.1

[[body]]
name = "bar"
mass = 1.0
center = [0.5, 0.0]
inertia = 0.1

[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["ground", "bar"]
at = [0.0, 0.0]

[[output]]
name = "tip"
body = "bar"
at = [1.0, 0.0]
quantity = "position"
"#;

/// A directory of a test, with a scene in it.
struct Place(PathBuf);

impl Place {
    fn new(name: &str) -> Self {
        let place = Self(scratch(&format!("hostile-{name}")));
        place.put("p.toml", SCENE);
        place
    }

    fn put(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.0.join(name), bytes).expect("the scratch directory is ours");
    }

    fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.0.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The names in a directory of it, in order.
    fn names(&self, name: &str) -> Vec<String> {
        let name_of = |entry: std::io::Result<std::fs::DirEntry>| {
            entry.expect("an entry").file_name().to_string_lossy().into_owned()
        };
        let entries = std::fs::read_dir(self.0.join(name)).expect("a directory");
        let mut names: Vec<_> = entries.map(name_of).collect();
        names.sort();
        names
    }

    /// Runs of the pendulum without an estimate, whose base depends on the time of the run.
    fn run(&self, arguments: &str) -> Command {
        self.mbs(&format!("run p.toml --no-estimate {arguments}"))
    }

    fn mbs(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_mbs"));
        command.args(arguments.split_whitespace()).current_dir(&self.0);
        command
    }
}

/// Runs a command, which must end in time; returns its output.
fn ended(command: &mut Command) -> Output {
    let command = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    output(command.spawn().expect("the command is built"), "")
}

/// Returns the output of a process, which must end in time.
fn output(mut child: Child, what: &str) -> Output {
    // pipes hold more than these say
    let begun = Instant::now();
    while child.try_wait().expect("our child").is_none() {
        if begun.elapsed() > PATIENCE {
            let _ = child.kill();
            panic!("it hangs: {what}");
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    child.wait_with_output().expect("our child")
}

/// Waits until something is so.
fn wait_for(what: &str, mut is_so: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !is_so() {
        assert!(begun.elapsed() < PATIENCE, "in vain: {what}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// All files of a directory with their bytes, those of the checkpoint and of processes left out.
fn results(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let names = ["run.csv", "steps.csv", "run.json", "run.html"];
    let read = |name: &str| std::fs::read(folder.join(name)).ok().map(|b| (name.to_owned(), b));
    names.iter().filter_map(|name| read(name)).collect()
}

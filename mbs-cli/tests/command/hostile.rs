//! Tests of adverse conditions for the command: bad paths, damaged texts, full disks, signals, other processes, kills. The command must not
//! panic or hang, and no existing file may be lost.

mod folders;
mod killed;
mod lines;
mod signals;

use crate::files::scratch;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Time limit of a command: longer than any of them takes on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// A pendulum with a duration of a tenth of a second.
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

/// The directory of a test, with a scene in it.
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

    /// The names in one of its subdirectories, in order.
    fn names(&self, name: &str) -> Vec<String> {
        let name_of = |entry: std::io::Result<std::fs::DirEntry>| {
            entry.expect("an entry").file_name().to_string_lossy().into_owned()
        };
        let entries = std::fs::read_dir(self.0.join(name)).expect("a directory");
        let mut names: Vec<_> = entries.map(name_of).collect();
        names.sort();
        names
    }

    /// A run of the pendulum without an estimate, since the basis of an estimate depends on the time of the run.
    fn run(&self, arguments: &str) -> Command {
        self.mbs(&format!("run p.toml --no-estimate {arguments}"))
    }

    fn mbs(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_mbs"));
        command.args(arguments.split_whitespace()).current_dir(&self.0);
        command
    }
}

/// Runs a command, which must end within the time limit. Returns its output.
fn ended(command: &mut Command) -> Output {
    let command = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    output(command.spawn().expect("the command is built"), "")
}

/// Returns the output of a process, which must end within the time limit.
fn output(mut child: Child, what: &str) -> Output {
    // the outputs are small enough for the buffers of the pipes
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

/// Waits until a condition holds.
fn wait_for(what: &str, mut is_so: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !is_so() {
        assert!(begun.elapsed() < PATIENCE, "in vain: {what}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// The result files of a directory with their bytes, without checkpoints and files of processes.
fn results(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let names = ["run.csv", "steps.csv", "run.json", "run.html"];
    let read = |name: &str| std::fs::read(folder.join(name)).ok().map(|b| (name.to_owned(), b));
    names.iter().filter_map(|name| read(name)).collect()
}

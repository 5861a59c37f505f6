//! The programs under lab/peers: their paths, their arguments and their output.

use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;
use xtask::child::printed;
use xtask::process::{self, output};

/// A program of ours or of a peer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Who {
    Ours,
    PinocchioOpen,
    PinocchioLoop,
    PinocchioRobot,
    MuJoCo,
    MuJoCoRobot,
    Exudyn,
    Drake,
    Simbody,
    Ida,
    Radau,
    RustChains,
    RustAndrews,
}

impl Who {
    /// All peers, in the order of the tables.
    pub(super) const PEERS: [Self; 12] = [
        Self::PinocchioOpen,
        Self::PinocchioLoop,
        Self::PinocchioRobot,
        Self::MuJoCo,
        Self::MuJoCoRobot,
        Self::RustChains,
        Self::Simbody,
        Self::Drake,
        Self::Exudyn,
        Self::RustAndrews,
        Self::Radau,
        Self::Ida,
    ];

    /// Returns the name of the program.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Ours => "mbs",
            Self::PinocchioOpen | Self::PinocchioLoop | Self::PinocchioRobot => "Pinocchio",
            Self::MuJoCo | Self::MuJoCoRobot => "MuJoCo",
            Self::Exudyn => "Exudyn",
            Self::Drake => "Drake",
            Self::Simbody => "Simbody",
            Self::Ida => "SUNDIALS",
            Self::Radau => "deSolve",
            Self::RustChains => "crates",
            Self::RustAndrews => "diffsol",
        }
    }

    /// Command by which the program is installed, or a sentence on it.
    pub(super) fn remedy(self) -> &'static str {
        match self {
            Self::Ours => "cargo builds it",
            Self::PinocchioOpen | Self::PinocchioLoop => "lab/peers/setup.sh pinocchio",
            Self::PinocchioRobot => "lab/peers/setup.sh pinocchio robots",
            Self::MuJoCo => "lab/peers/setup.sh mujoco",
            Self::MuJoCoRobot => "lab/peers/setup.sh mujoco robots",
            Self::Exudyn => "lab/peers/setup.sh exudyn",
            Self::Drake => "lab/peers/setup.sh drake",
            Self::Simbody => "lab/peers/setup.sh simbody",
            Self::Ida | Self::Radau => "lab/peers/setup.sh andrews",
            Self::RustChains | Self::RustAndrews => "cargo builds them, once it can fetch them",
        }
    }

    /// The file without which the program does not run.
    fn needed(self) -> PathBuf {
        let folder = folder();
        match self {
            Self::Ours => folder.join("ours/release/ours"),
            Self::PinocchioOpen => folder.join("pinocchio_open"),
            Self::PinocchioLoop => folder.join("pinocchio_loop"),
            Self::PinocchioRobot => folder.join("pinocchio_robot"),
            Self::MuJoCo => folder.join("mujoco"),
            Self::MuJoCoRobot => folder.join("mujoco_robot"),
            Self::Exudyn => package("exudyn"),
            Self::Drake => package("pydrake"),
            Self::Simbody => folder.join("simbody"),
            Self::Ida => folder.join("andrews_ida"),
            Self::Radau => folder.join("andrews_radau.so"),
            Self::RustChains => folder.join("rust/release/chains"),
            Self::RustAndrews => folder.join("rust/release/andrews"),
        }
    }

    /// True if the program can run here.
    pub(super) fn is_here(self) -> bool {
        self.needed().exists()
    }

    /// The command of the program without its arguments.
    fn command(self) -> Command {
        let script = |program: PathBuf, path: &str| {
            let mut command = Command::new(program);
            command.arg(sources().join(path));
            command
        };
        let python = folder().join("venv/bin/python");
        match self {
            Self::Exudyn => script(python, "exudyn/run.py"),
            Self::Drake => script(python, "drake/forward.py"),
            Self::Radau => script("Rscript".into(), "andrews/radau.R"),
            _ => Command::new(self.needed()),
        }
    }

    /// Returns the version of the program, as it reports it.
    pub(super) fn version(self) -> String {
        let text = match self {
            // the versions that Cargo.toml requires
            Self::RustChains => Some("dynibo 0.5.3, phyz-rigid 0.4.0".to_owned()),
            Self::RustAndrews => Some("0.18.0".to_owned()),
            Self::Ours => process::commit(),
            Self::PinocchioLoop | Self::PinocchioRobot => Some(Self::PinocchioOpen.version()),
            Self::MuJoCoRobot => Some(Self::MuJoCo.version()),
            _ => output(self.command().arg("version")),
        };
        let text = text.unwrap_or_default();
        text.lines().last().unwrap_or_default().to_owned()
    }

    /// Runs the program on a problem. Returns its lines.
    ///
    /// # Errors
    ///
    /// The program's message if it fails, or that it took too long.
    pub(super) fn run(self, asked: &Asked) -> Result<Vec<Line>, String> {
        let mut command = self.command();
        match self {
            Self::Radau => command.arg(self.needed()).arg(asked.number.to_string()),
            _ => command.args([asked.problem, &asked.n.to_string(), &asked.number.to_string()]),
        };
        // the folder with the robots
        command.env("PEERS_DIR", folder());
        let text = printed(&mut command, Duration::from_secs(300))?;
        let lines: Vec<Line> = text.lines().filter_map(Line::read).collect();
        if lines.is_empty() { Err(format!("no result: {}", text.trim())) } else { Ok(lines) }
    }
}

/// Request to a program: a problem, its size, and its time or step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked {
    pub(super) problem: &'static str,
    pub(super) n: usize,
    /// Measuring time, or the step of a run [s].
    pub(super) number: f64,
}

/// A line of a program: algorithm, seconds, value, name of the reference of the value.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Line {
    pub(super) algorithm: String,
    pub(super) seconds: f64,
    pub(super) value: f64,
    pub(super) reference: String,
}

impl Line {
    /// Reads a line; `None` for other output of the program's packages.
    fn read(text: &str) -> Option<Self> {
        let parts: Vec<&str> = text.split(',').collect();
        let [algorithm, seconds, value, reference] = parts[..] else { return None };
        Some(Self {
            algorithm: algorithm.to_owned(),
            seconds: seconds.parse().ok()?,
            value: value.parse().ok()?,
            reference: reference.to_owned(),
        })
    }
}

/// Folder of the sources of the programs.
fn sources() -> PathBuf {
    process::root().join("lab/peers")
}

/// Folder of the programs and the results.
pub(super) fn folder() -> PathBuf {
    process::target_dir().join("peers")
}

/// Folder of a Python package, if it is installed.
fn package(name: &str) -> PathBuf {
    let lib = folder().join("venv/lib");
    let versions = std::fs::read_dir(&lib).into_iter().flatten().flatten();
    let mut paths = versions.map(|entry| entry.path().join("site-packages").join(name));
    paths.find(|path| path.exists()).unwrap_or(lib.join(name))
}

/// Builds our program, and the peers that can be built here.
///
/// # Errors
///
/// Our program cannot be built.
pub(super) fn build() -> Result<(), String> {
    let package = |name: &str| {
        let mut command = process::cargo();
        command.args(["build", "--quiet", "--release", "--locked", "--manifest-path"]);
        command.arg(sources().join(name).join("Cargo.toml"));
        command.env("CARGO_TARGET_DIR", folder().join(name)).current_dir(process::root());
        command
    };
    // our program is built for any x86-64, without the flags of the environment; peers are built for this processor
    process::run(package("ours").env_remove("RUSTFLAGS"))?;
    for peers in [
        package("rust").env("RUSTFLAGS", "-C target-cpu=native"),
        Command::new(sources().join("build.sh")).env("PEERS_DIR", folder()),
    ] {
        // a peer that cannot be built counts as missing
        if let Err(why) = process::run(peers) {
            eprintln!("{why}");
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_read_and_the_rest_is_passed_over() {
        let line = Line::read("aba world,1.5e-6,-2.5,exact").unwrap();
        assert_eq!((line.seconds, line.value, line.reference.as_str()), (1.5e-6, -2.5, "exact"));
        assert_eq!([Line::read("Imported a package"), Line::read("a,b,c,d")], [None, None]);
    }

    #[test]
    fn every_peer_says_how_it_is_installed() {
        assert!(
            Who::PEERS
                .iter()
                .all(|who| who.remedy().contains("setup.sh") || who.remedy().contains("cargo"))
        );
    }
}

//! Search of a Rust toolchain that can compile for a bare target. Either the target's libraries are installed, or the system's Rust has its
//! sources. Debian's packages are installed where that is possible. Toolchains and targets of rustup are never downloaded.

use crate::debian::{find as find_program, install};
use crate::process::{cargo, output};
use crate::summary::LeftOut;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Debian's packages of the Rust with which browsers are built. They are recent in stable releases too.
const DEBIAN_PACKAGES: [&str; 3] = ["rustc-web", "cargo-web", "rust-web-src"];

/// The emulator, which is also the name of Debian's package.
const EMULATOR: &str = "qemu-system-arm";

/// The system's compiler and cargo, by their paths, since `PATH` may contain proxies of rustup before them.
const SYSTEM_RUSTC: &str = "/usr/bin/rustc";
const SYSTEM_CARGO: &str = "/usr/bin/cargo";

/// Variables that `cargo run` and rustup set for the toolchain of this job. They would mislead the system's toolchain.
const OUTER_VARIABLES: [&str; 12] = [
    "RUSTUP_TOOLCHAIN",
    "RUSTUP_HOME",
    "RUST_RECURSION_COUNT",
    "LD_LIBRARY_PATH",
    "CARGO",
    "CARGO_TARGET_DIR",
    "CARGO_BUILD_TARGET",
    "CARGO_BUILD_RUSTC",
    "CARGO_ENCODED_RUSTFLAGS",
    "RUSTFLAGS",
    "RUSTC_WRAPPER",
    "RUSTC_WORKSPACE_WRAPPER",
];

/// A Rust that can build for the target.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Toolchain {
    /// The Rust that runs this job, which has the target's libraries.
    Installed,
    /// The system's Rust, which compiles `core` and `alloc` from its sources.
    System,
}

impl Toolchain {
    /// Name of the toolchain for the summary.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Installed => "the installed target",
            Self::System => "the system's Rust with its sources",
        }
    }

    /// The command cargo of this toolchain, for a build with or without `alloc`.
    pub(crate) fn cargo(self, has_alloc: bool) -> Command {
        match self {
            Self::Installed => cargo(),
            Self::System => {
                let mut command = system(SYSTEM_CARGO);
                // the build of the libraries from source is an unstable option, which this variable allows
                command.env("RUSTC", SYSTEM_RUSTC).env("RUSTC_BOOTSTRAP", "1");
                let libraries = if has_alloc { "core,alloc" } else { "core" };
                command.arg("-Z").arg(format!("build-std={libraries}"));
                command
            }
        }
    }
}

/// Finds a toolchain for the target. Missing packages of Debian are installed where that is possible.
///
/// # Errors
///
/// The missing part, and the remedy.
pub(crate) fn find(target: &str) -> Result<Toolchain, LeftOut> {
    if is_installed(target) {
        return Ok(Toolchain::Installed);
    }
    let Err(missing) = system_rust() else { return Ok(Toolchain::System) };
    let why = match install(&DEBIAN_PACKAGES) {
        Ok(()) => match system_rust() {
            Ok(()) => return Ok(Toolchain::System),
            Err(still) => format!("after installing packages, {still}"),
        },
        Err(refusal) => format!("{missing}; {refusal}"),
    };
    Err(LeftOut {
        why: format!("the libraries of {target} are not installed, and {why}"),
        remedy: format!(
            "Get it with `rustup target add {target}`, or on Debian, as root, with\n\
             `apt-get install --no-install-recommends {}`; then run `cargo xtask check-nostd`.",
            DEBIAN_PACKAGES.join(" ")
        ),
    })
}

/// Finds the tools that the firmware example needs besides a toolchain. The emulator is installed where that is possible. The system's Rust
/// also needs a linker: that of the Rust that runs this job, or one in the path. Returns the linker, if one is needed.
///
/// # Errors
///
/// The missing part, and the remedy.
pub(crate) fn for_images(toolchain: Toolchain) -> Result<Option<PathBuf>, LeftOut> {
    find_program(EMULATOR, EMULATOR)?;
    if toolchain == Toolchain::Installed {
        return Ok(None);
    }
    linker().map(Some)
}

/// Finds a linker for bare targets: that of the Rust that runs this job, or one in the path.
///
/// # Errors
///
/// The missing part, and the remedy.
pub(crate) fn linker() -> Result<PathBuf, LeftOut> {
    let own = output(Command::new("rustc").args(["--print", "target-libdir"]));
    let own = own.and_then(|lib| Some(Path::new(&lib).parent()?.join("bin/rust-lld")));
    let candidates = own.into_iter().chain(["rust-lld", "ld.lld"].map(PathBuf::from));
    let works = |linker: &PathBuf| {
        output(Command::new(linker).args(["-flavor", "gnu", "--version"])).is_some()
            || output(Command::new(linker).arg("--version")).is_some()
    };
    let mut candidates = candidates.filter(works);
    candidates.next().ok_or_else(|| LeftOut {
        why: "there is no rust-lld that works".to_owned(),
        remedy: "On Debian, as root: `apt-get install lld`.".to_owned(),
    })
}

/// True if the Rust that runs this job has the target's libraries.
fn is_installed(target: &str) -> bool {
    let args = ["--print", "target-libdir", "--target", target];
    output(Command::new("rustc").args(args)).is_some_and(|folder| Path::new(&folder).is_dir())
}

/// Checks that the system's Rust is recent enough and has its sources. Otherwise returns the missing part.
fn system_rust() -> Result<(), String> {
    let wanted = env!("CARGO_PKG_RUST_VERSION");
    if !Path::new(SYSTEM_CARGO).is_file() {
        return Err(format!("there is no {SYSTEM_CARGO}"));
    }
    // a proxy of rustup at this path reports a toolchain outside /usr
    if output(system(SYSTEM_RUSTC).args(["--print", "sysroot"])).as_deref() != Some("/usr") {
        return Err(format!("{SYSTEM_RUSTC} is not the system's own Rust"));
    }
    let version = output(system(SYSTEM_RUSTC).arg("--version")).unwrap_or_default();
    if release(&version) < release(wanted) {
        return Err(format!("{version} in {SYSTEM_RUSTC} is older than {wanted}"));
    }
    if !Path::new("/usr/lib/rustlib/src/rust/library/core").is_dir() {
        return Err("the sources of the system's Rust are not installed".to_owned());
    }
    Ok(())
}

/// A command without the variables of the outer toolchain.
fn system(program: &str) -> Command {
    let mut command = Command::new(program);
    for variable in OUTER_VARIABLES {
        command.env_remove(variable);
    }
    command
}

/// Major and minor number of a version such as `rustc 1.96.0 (ac68faa20 2026-05-25)` or `1.95`.
fn release(version: &str) -> Option<(u32, u32)> {
    let number = version.split_whitespace().find(|word| word.starts_with(char::is_numeric))?;
    let mut parts = number.split('.').map(|part| part.parse().ok());
    Some((parts.next()??, parts.next()??))
}

#[cfg(test)]
mod tests {
    use super::release;

    #[test]
    fn release_is_read_from_both_spellings() {
        assert_eq!(release("rustc 1.96.0 (ac68faa20 2026-05-25)"), Some((1, 96)));
        assert_eq!(release("1.95"), Some((1, 95)));
        assert_eq!(release("rustc unknown"), None);
        assert!(release("rustc 1.63.0") < release("1.95"));
        assert!(release("") < release("1.95"));
    }
}

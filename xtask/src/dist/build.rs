//! Settings with which cargo builds the files of a release.

use crate::process::{output, target_dir};
use std::env;
use std::path::PathBuf;
use std::process::Command;

/// Version of all crates.
pub(super) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Profile and target of a build.
#[derive(Debug)]
pub(super) struct Build<'a> {
    /// Cargo profile of the build.
    pub(super) profile: &'a str,
    /// Target, if it is not that of the compiler.
    pub(super) target: Option<&'a str>,
}

impl Build<'_> {
    /// Lets cargo remove names of functions from the linked program.
    pub(super) fn strip<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        let profile = self.profile.to_uppercase().replace('-', "_");
        command.env(format!("CARGO_PROFILE_{profile}_STRIP"), "symbols")
    }

    /// The folder of the built programs.
    pub(super) fn folder(&self) -> PathBuf {
        let name = if self.profile == "dev" { "debug" } else { self.profile };
        target_dir().join(self.target.unwrap_or_default()).join(name)
    }

    /// Name of the target.
    pub(super) fn target(&self) -> Result<String, String> {
        self.target.map_or_else(host, |target| Ok(target.to_owned()))
    }
}

/// The target of the compiler.
fn host() -> Result<String, String> {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = output(Command::new(rustc).arg("-vV")).ok_or("there is no rustc")?;
    let host = version.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "rustc does not name its host".to_owned())
}

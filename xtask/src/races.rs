//! The job `cargo xtask races`: runs the thread teams of mbs-parallel under ThreadSanitizer.

use crate::process::{self, cargo, output, run};
use crate::summary::{self, Outcome};
use std::process::{Command, ExitCode};

/// Size of a thread's stack in bytes: it is large, since instrumented functions need more.
const STACK: &str = "67108864";

/// Runs the tests of the thread team, which contains the lock-free code, and detects data races.
pub fn races() -> ExitCode {
    let remark = || Outcome::Passed("no data race in the tests of the crew".to_owned());
    summary::ended("races", watched().map(|()| remark()))
}

/// Runs the tests of the thread team under ThreadSanitizer. Sanitizers are an unstable option of the compiler, which `RUSTC_BOOTSTRAP`
/// enables in a stable one.
fn watched() -> Result<(), String> {
    let version = output(Command::new("rustc").arg("-vV")).ok_or("cannot ask `rustc -vV`")?;
    let host = host(&version).ok_or("`rustc -vV` names no host")?;
    let suppressions = process::root().join("mbs-parallel/tests/races.supp");
    let options = format!("suppressions={} halt_on_error=1", suppressions.display());
    let mut command = cargo();
    command.args(["test", "--package", "mbs-parallel", "--test", "team", "--target", host]);
    command
        .current_dir(process::root())
        .env("CARGO_TARGET_DIR", process::target_dir().join("races"))
        .env("RUSTC_BOOTSTRAP", "1")
        .env("RUSTFLAGS", "-Zsanitizer=thread -Cunsafe-allow-abi-mismatch=sanitizer")
        .env("MBS_SANITIZED", "1")
        .env("TSAN_OPTIONS", options)
        .env("RUST_MIN_STACK", STACK)
        .env("RUST_TEST_THREADS", "1");
    run(&mut command)
}

/// The host of `rustc -vV`.
fn host(version: &str) -> Option<&str> {
    version.lines().find_map(|line| line.strip_prefix("host: "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_host_is_found_in_the_compilers_version() {
        let text = "rustc 1.95.0\nbinary: rustc\nhost: x86_64-unknown-linux-gnu\nrelease: 1.95.0";
        assert_eq!(host(text), Some("x86_64-unknown-linux-gnu"));
        assert_eq!(host("rustc 1.95.0"), None);
    }
}

//! Check of the static library for C: its example is compiled and run, and compared with the same run on the host.

use super::board::{export, on_host};
use super::run_report::RunReport;
use crate::process::{self, cargo, output, run};
use std::path::Path;
use std::process::Command;

/// Builds the library and the example with the system's C compiler, and runs the example.
///
/// # Errors
///
/// The command that failed, or a difference in a bit.
pub(super) fn check(models: &Path) -> Result<String, String> {
    let here = process::root().join("mbs-nostd/ffi");
    // this folder is that of the run on the host, so that external crates are compiled only once
    let folder = process::target_dir().join("firmware/host");
    let mut library = cargo();
    library.args(["build", "--release", "--quiet", "--locked", "--target-dir"]).arg(&folder);
    run(library.current_dir(&here))?;
    let program = folder.join("example");
    let mut compile = Command::new("cc");
    compile.args(["-std=c11", "-Wall", "-Wextra", "-Werror", "-O1", "-I", "include", "example.c"]);
    compile.arg(folder.join("release/libmbs_nostd_ffi.a")).arg("-o").arg(&program);
    run(compile.current_dir(&here))?;
    let model = export("six-joint-arm", "f64", models)?;
    let mut example = Command::new(&program);
    let text = output(example.arg(model.with_extension("mbs")));
    let report = RunReport::read(&text.ok_or_else(|| format!("{} failed", program.display()))?)?;
    let host = RunReport::read(&on_host(&model, "")?)?;
    if report.lines == host.lines {
        Ok("a program in C gives the same bits".to_owned())
    } else {
        Err(format!("a program in C differs from the host's run by {}", report.apart(&host)?))
    }
}

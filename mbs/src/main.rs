//! The `mbs` command. Exit status: 0 done, 1 refused (scene or usage), 2 the run could not go on.

use std::process::ExitCode;

fn main() -> ExitCode {
    mbs::cli::main()
}

//! Check that the documentation builds without warnings, except for units in brackets.
//!
//! Comments write units as `[m]` and equations as `[P3 (10)]`. rustdoc reads a single word in brackets as a link that does not exist. It
//! prints a warning, and shows the text as written. So denied warnings would forbid this notation, and allowed ones would hide wrong links.
//! This check reads the warnings and ignores those about units.

use crate::process::{self, cargo};
use crate::summary::Outcome;
use std::process::Stdio;

/// Units of one word, for which rustdoc prints warnings. It ignores brackets such as `[N/m]`.
const UNITS: [&str; 15] =
    ["m", "m²", "m³", "m⁴", "m⁵", "s", "kg", "N", "J", "W", "Hz", "rad", "Pa", "KiB", "ns"];

/// Builds the documentation of the workspace.
///
/// # Errors
///
/// The warnings that are not about units, or cargo's message if it fails.
pub(crate) fn check() -> Result<Outcome, String> {
    let mut command = cargo();
    command.args(["doc", "--no-deps", "--workspace", "--quiet"]).env("CARGO_TERM_COLOR", "never");
    let out = command.current_dir(process::root()).stdin(Stdio::null()).output();
    let out = out.map_err(|e| format!("cannot start `{}`: {e}", process::line(&command)))?;
    let messages = String::from_utf8_lossy(&out.stderr);
    if !out.status.success() {
        return Err(format!("`{}`: {}\n{messages}", process::line(&command), out.status));
    }
    let faults = faults(&messages);
    if faults.is_empty() {
        return Ok(Outcome::Passed(String::new()));
    }
    Err(format!("{} warnings\n\n{}", faults.len(), faults.join("\n\n")))
}

/// The messages that are faults: blocks of lines separated by empty lines, without those about units and without cargo's counts.
fn faults(messages: &str) -> Vec<&str> {
    let blocks = messages.split("\n\n").map(str::trim).filter(|block| !block.is_empty());
    blocks.filter(|block| !is_harmless(block.lines().next().unwrap_or_default())).collect()
}

/// True if a message's first line is about a unit, or is a count of the messages of a crate.
fn is_harmless(line: &str) -> bool {
    let link = line.strip_prefix("warning: unresolved link to `");
    let word = link.and_then(|rest| rest.strip_suffix('`'));
    let is_count =
        line.starts_with("warning: `") && line.contains("` (") && line.contains(" generated ");
    is_count || word.is_some_and(|word| UNITS.contains(&word))
}

#[cfg(test)]
mod tests {
    use super::faults;

    #[test]
    fn units_are_no_faults_and_broken_links_are() {
        let messages = "warning: unresolved link to `m`\n --> a.rs:1:2\n\n\
                        warning: unresolved link to `Scene`\n --> a.rs:3:4\n\n\
                        warning: `mbs-core` (lib doc) generated 2 warnings\n";
        assert_eq!(faults(messages), ["warning: unresolved link to `Scene`\n --> a.rs:3:4"]);
    }
}

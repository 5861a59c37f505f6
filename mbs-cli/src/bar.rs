//! Progress bars on a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, stderr};

/// A progress bar with `ticks` steps. It is hidden if standard error is no terminal, or if the command is quiet.
pub(crate) fn bar(ticks: u64, is_quiet: bool, template: &str) -> ProgressBar {
    let target = if is_quiet || !stderr().is_terminal() {
        ProgressDrawTarget::hidden()
    } else {
        ProgressDrawTarget::stderr()
    };
    let bar = ProgressBar::with_draw_target(Some(ticks), target);
    let style = ProgressStyle::with_template(template);
    style.map_or(bar.clone(), |style| bar.with_style(style))
}

/// Converts a fraction from 0 to 1 to a number of ticks.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "a share between 0 and a small number"
)]
pub(crate) fn ticks(share: f64, whole: u64) -> u64 {
    (whole as f64 * share.clamp(0.0, 1.0)) as u64
}

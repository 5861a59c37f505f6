//! Exit statuses of the commands; 0 is that of what was done.

/// Exit status of a build that lacks the precision asked for.
pub(crate) const UNBUILT: u8 = 3;

/// Exit status of a refusal.
pub(crate) const REFUSED: u8 = 1;

/// Exit status of a run that stopped.
pub(crate) const STOPPED: u8 = 2;

//! Exit statuses of the commands; the status of success is 0.

/// Exit status of a build that lacks the requested precision.
pub(crate) const UNBUILT: u8 = 3;

/// Exit status of a refusal.
pub(crate) const REFUSED: u8 = 1;

/// Exit status of a run that stopped.
pub(crate) const STOPPED: u8 = 2;

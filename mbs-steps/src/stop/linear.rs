//! Messages of linearisations that failed.

use mbs_linear::LinearError;
use mbs_scene::format::few;

pub(super) fn write_linear(
    error: &LinearError,
    f: &mut core::fmt::Formatter<'_>,
) -> core::fmt::Result {
    match error {
        LinearError::NotClosed { violation } => write!(
            f,
            "next to this position the joints stay open by {} m (or rad)",
            few(*violation)
        ),
        LinearError::Singular { .. } => write!(
            f,
            "the mechanism stands in a singular position: its branches have no common linearisation"
        ),
        LinearError::NoInertia { .. } => write!(
            f,
            "a force meets no inertia: a coordinate is neither determined by joints nor has mass"
        ),
        LinearError::NotSettled { left } => {
            write!(f, "accelerations next to this position miss the joints by {} m/s^2", few(*left))
        }
        LinearError::Rolls => {
            write!(f, "bodies that roll are in motion, where more places are free than velocities")
        }
        LinearError::NotFinite => write!(f, "a force became infinite or not a number"),
        other => write!(f, "{other}"),
    }
}

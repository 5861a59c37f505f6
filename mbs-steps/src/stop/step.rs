//! Messages and hints of steps that failed.

use mbs_core::model::Owner;
use mbs_core::step::StepError;
use mbs_scene::format::few;

/// Part of the scene that a failed step concerns. `unknown` and `row` return the owner of an unknown and of a constraint row.
pub(super) fn step_owner(
    error: &StepError,
    unknown: impl Fn(usize) -> Owner,
    row: impl Fn(usize) -> Owner,
) -> Option<Owner> {
    Some(match *error {
        StepError::NotConverged { unknown: u, .. } | StepError::NotFinite { unknown: u } => {
            unknown(u as usize)
        }
        StepError::Singular(e) => unknown(e.unknown as usize),
        StepError::Violated { row: r, .. }
        | StepError::OppositeBranch { row: r }
        | StepError::RankLost { row: r, .. } => row(r as usize),
        StepError::TurnTooLarge { joint, .. } => Owner::Joint(joint as usize),
        StepError::Overturned { effect }
        | StepError::TwistOpen { effect }
        | StepError::LineCollapsed { effect, .. } => Owner::Effect(effect as usize),
        StepError::RopeCollapsed { coupling, .. } => Owner::Coupling(coupling as usize),
        StepError::RollingFlat { rolling } => Owner::Rolling(rolling as usize),
        _ => return None,
    })
}

/// Message for a user-defined law or relation that failed.
const NO_NUMBER: &str = "gave a number that is infinite or not a number";

/// Writes the message of a failed step; the hint is separate.
pub(super) fn write_step(error: &StepError, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
    match error {
        StepError::NotConverged { iterations, correction, .. } => write!(
            f,
            "the step did not converge in {iterations} iterations; the last correction was {} of the scene's length",
            few(*correction)
        ),
        StepError::Singular(_) => write!(
            f,
            "the tangent matrix is not positive definite: a force meets no inertia, or nothing determines a coordinate"
        ),
        StepError::NotFinite { .. } => write!(f, "a number became infinite or not a number"),
        StepError::RankLost { pivot, .. } => {
            write!(f, "the constraints depend on each other (relative pivot {})", few(*pivot))
        }
        StepError::StepTooSmall { step } => {
            write!(f, "the control of the step asked for a step of {} s", few(*step))
        }
        StepError::Violated { level, violation, .. } => {
            let (name, unit) = [
                ("positions", "m (or rad)"),
                ("velocities", "m/s (or rad/s)"),
                ("accelerations", "m/s^2 (or rad/s^2)"),
            ][usize::from(*level).min(2)];
            write!(
                f,
                "the constraints on {name} could not be met: {} {unit} is left",
                few(*violation)
            )
        }
        StepError::TurnTooLarge { turn, .. } => write!(
            f,
            "the joint turns by {} rad in one step, more than its position determines",
            few(*turn)
        ),
        StepError::Overturned { .. } => {
            write!(f, "the effect is turned by more than a whole turn, where its law ends")
        }
        StepError::RopeCollapsed { .. } | StepError::LineCollapsed { .. } => {
            write!(f, "the rope has no length left, so that its direction is not known")
        }
        StepError::RollingFlat { .. } => {
            write!(f, "what rolls lies flat on its plane, where it has no lowest point")
        }
        StepError::VelocityRows => {
            write!(
                f,
                "bodies that roll restrict velocities, not places; this formulation has no rows for that"
            )
        }
        StepError::TwistOpen { .. } => {
            write!(f, "the ball has swung by half a turn, where its twist is open")
        }
        StepError::OppositeBranch { .. } => {
            write!(f, "the guided angle jumped half a turn away from its guide")
        }
        StepError::Law { .. } => write!(f, "its law {NO_NUMBER}"),
        StepError::Relation { .. } => write!(f, "its relation {NO_NUMBER}"),
        other => write!(f, "{other}"),
    }
}

/// Hint for the user after a failed step: what to try.
pub(super) fn step_hint(error: &StepError) -> &'static str {
    match error {
        StepError::Singular(_) => {
            "try a smaller step; give every body that can move mass and inertia"
        }
        StepError::Violated { .. } | StepError::NotConverged { .. } => {
            "try a smaller step or another formulation; if it always stops here, the mechanism locks or cannot follow its guides: end the run or the guide before"
        }
        StepError::RankLost { .. } => {
            "joints repeat each other, or the mechanism stands in a singular position: index-3 and index-1 pass both"
        }
        StepError::StepTooSmall { .. } => {
            "try a looser tolerance, or steps of fixed length by the trapezoidal rule: the motion may be stiff or not smooth here"
        }
        StepError::TurnTooLarge { .. } => {
            "make the step so short that the joint turns by a third of a radian in it, or try the formulation recursive"
        }
        StepError::Overturned { .. } => {
            "a bushing in space ends at a whole turn: hold the turning by a joint, with a torsion spring about its axis"
        }
        StepError::RopeCollapsed { .. } | StepError::LineCollapsed { .. } => {
            "end its motion before the points meet, by a `limit` of a joint or a `bumper` between the points, or end the run"
        }
        StepError::RollingFlat { .. } => {
            "end its motion before it lies down, by a `limit` of a joint, or end the run"
        }
        StepError::VelocityRows => "take `recursive`, `index-3`, `index-1` or `classical`",
        StepError::TwistOpen { .. } => {
            "hold its swing below half a turn, by a `limit` with `coordinate = \"swing\"`, or choose another axis"
        }
        StepError::Law { .. } => {
            "give a finite force, tangent and energy wherever the law is asked; if the motion should not lead there, try a smaller step"
        }
        StepError::Relation { .. } => {
            "give a finite value, gradient and curvature wherever the relation is asked; if the motion should not lead there, try a smaller step"
        }
        _ => "try a smaller step, or another formulation",
    }
}

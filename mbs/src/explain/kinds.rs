//! The kinds of effect as scene files call them, and what they may do.

use mbs_core::Real;
use mbs_core::scene::{EffectKind, Signal};

/// The name in scene files; `own` for a law in code.
pub(crate) fn name<T>(kind: &EffectKind<T>) -> &'static str {
    match kind {
        EffectKind::SpringDamper { .. } => "spring-damper",
        EffectKind::TorsionSpring { .. } => "torsion-spring",
        EffectKind::Force { .. } => "force",
        EffectKind::BodyTorque { .. } | EffectKind::JointTorque { .. } => "torque",
        EffectKind::Actuator { .. } => "actuator",
        EffectKind::Polynomial { of_rate: false, .. } => "polynomial-spring",
        EffectKind::Polynomial { of_rate: true, .. } => "polynomial-damper",
        EffectKind::Bumper { .. } => "bumper",
        EffectKind::Bushing { .. } => "bushing",
        EffectKind::Limit { .. } => "limit",
        EffectKind::Friction { .. } => "friction",
        EffectKind::AeroDrag { .. } => "aero-drag",
        EffectKind::SpeedHold { .. } => "speed-hold",
        EffectKind::Tire { .. } => "tire",
        EffectKind::Own { .. } => "own",
    }
}

/// Can it store energy?
pub(super) fn springs<T: Real>(kind: &EffectKind<T>) -> bool {
    match kind {
        EffectKind::SpringDamper { stiffness, .. }
        | EffectKind::TorsionSpring { stiffness, .. }
        | EffectKind::Tire { stiffness, .. }
        | EffectKind::Bumper { stiffness, .. }
        | EffectKind::Limit { stiffness, .. } => !stiffness.is_zero(),
        EffectKind::Bushing { stiffness, .. } => stiffness.iter().any(|k| !k.is_zero()),
        EffectKind::Polynomial { of_rate, .. } => !of_rate,
        EffectKind::Own { .. } => true,
        _ => false,
    }
}

/// Can it take energy out by a rate?
pub(crate) fn damps<T: Real>(kind: &EffectKind<T>) -> bool {
    match kind {
        EffectKind::SpringDamper { damping, .. }
        | EffectKind::TorsionSpring { damping, .. }
        | EffectKind::Tire { damping, .. }
        | EffectKind::Bumper { damping, .. }
        | EffectKind::Limit { damping, .. } => !damping.is_zero(),
        EffectKind::Bushing { damping, .. } => damping.iter().any(|c| !c.is_zero()),
        EffectKind::Polynomial { of_rate, .. } => *of_rate,
        EffectKind::Friction { .. } | EffectKind::AeroDrag { .. } | EffectKind::Own { .. } => true,
        _ => false,
    }
}

/// Does it follow time or an input?
pub(super) fn follows_time<T>(kind: &EffectKind<T>) -> bool {
    let course = match kind {
        EffectKind::Force { course, .. }
        | EffectKind::BodyTorque { course, .. }
        | EffectKind::JointTorque { course, .. }
        | EffectKind::Actuator { course, .. }
        | EffectKind::Own { course, .. } => course,
        _ => return false,
    };
    !matches!(course, Signal::Constant(_))
}

//! Springs and dampers of joints.

use super::model::{Model, Motion, Moves};
use super::springs;
use super::strength::Strength;
use crate::robot::What;

/// Adds the spring and the damper of a joint.
pub(super) fn add(motion: &Motion, strengths: [Strength; 2], model: &mut Model<'_, '_, '_>) {
    if motion.is_single() {
        let free = motion.in_scene(motion.spring);
        let [spring, damper] = strengths;
        let strengths = [spring.against(motion.sign), damper];
        springs::add(&motion.name, &motion.target(), strengths, [free; 2], model);
    } else {
        several(motion, strengths, model);
    }
}

/// Spring and damper of a ball or a free joint.
fn several(motion: &Motion, strengths: [Strength; 2], model: &mut Model<'_, '_, '_>) {
    let label = format!("joint[{}]", motion.name);
    let [stiffness, damping] = [("stiffness", strengths[0]), ("damping", strengths[1])].map(
        |(word, strength)| {
            strength.linear().filter(|x| *x >= 0.0).unwrap_or_else(|| {
                let says = format!(
                    "{word} of a joint with several coordinates that is not in proportion does not act here"
                );
                model.context.findings.ignored(motion.at, label.as_str(), says);
                0.0
            })
        },
    );
    if stiffness == 0.0 && damping == 0.0 {
        return;
    }
    let is_free = motion.moves == Moves::Free;
    // along x, y, z, then about them
    let six = |x: f64| {
        let slide = if is_free { x } else { 0.0 };
        [slide, slide, slide, x, x, x]
    };
    if damping > 0.0 {
        let says = "damping of a ball acts as that of a bushing";
        model.context.findings.approximated(motion.at, label.as_str(), says);
    }
    let joint = &model.robot.joints[motion.joint];
    let what = What::Bushing {
        links: [joint.parent, joint.child],
        place: joint.place,
        stiffness: six(stiffness),
        damping: six(damping),
    };
    model.law(&format!("{} spring", motion.name), what);
}

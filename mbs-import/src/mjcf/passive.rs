//! Springs and dampers of joints.

use super::model::{Model, Motion, Moves};
use super::springs;
use super::strength::Strength;
use crate::laws;
use crate::robot::What;

/// Adds the spring and the damper of a joint of the file.
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

/// Adds the spring and the damper of a ball or a free joint.
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
    let is_free = motion.moves == Moves::Free;
    let joint = &model.robot.joints[motion.joint];
    let (links, place) = ([joint.parent, joint.child], joint.place);
    if stiffness > 0.0 {
        let slide = if is_free { stiffness } else { 0.0 };
        let six = [slide, slide, slide, stiffness, stiffness, stiffness];
        let what = What::Bushing { links, place, stiffness: six, damping: [0.0; 6] };
        model.law(&format!("{} spring", motion.name), what);
    }
    if damping > 0.0 {
        for (number, what) in laws::dampers((links, place), damping, is_free).enumerate() {
            model.law(&format!("{} damping {}", motion.name, number + 1), what);
        }
    }
}

//! Lines between points on bodies: springs, dampers, bumpers, forces, bars of constant length, and ropes.

use super::drawing::Drawing;
use crate::record::{DrawnLine, LineStyle, RecordedMotion};
use mbs_core::Real;
use mbs_core::effects::{EffectPicture, LineLook};
use mbs_core::scene::{BodyId, CouplingMeasure};

impl<T: Real> Drawing<'_, T> {
    /// Adds the lines of effects, of links and of couplings.
    pub(super) fn add_lines(&self, motion: &mut RecordedMotion) {
        for effect in self.scene.effects.iter().filter(|effect| effect.enabled) {
            if let EffectPicture::Line(look) = effect.kind.drawn_as() {
                let places = effect.kind.places().into_iter().map(|(_, body, at)| (body, at));
                self.add_line((&effect.name, style(look)), places, motion);
            }
        }
        for joint in self.scene.joints.iter().filter(|joint| joint.kind.is_link()) {
            let places = joint.bodies.into_iter().zip(joint.points);
            self.add_line((&joint.name, LineStyle::Link), places, motion);
        }
        for coupling in &self.scene.couplings {
            for term in &coupling.terms {
                if let CouplingMeasure::Length { points } = &term.of {
                    let places = points.iter().copied();
                    self.add_line((&coupling.name, LineStyle::Rope), places, motion);
                }
            }
        }
    }

    fn add_line(
        &self,
        (name, style): (&str, LineStyle),
        places: impl Iterator<Item = (BodyId, [T; 3])>,
        motion: &mut RecordedMotion,
    ) {
        let places: Vec<_> = places.map(|(body, at)| self.place(body, at)).collect();
        let style = if places.len() > 2 { LineStyle::Rope } else { style };
        if places.len() > 1 {
            motion.lines.push(DrawnLine { name: name.to_owned(), style, places });
        }
    }
}

/// Returns the style of a line.
const fn style(look: LineLook) -> LineStyle {
    match look {
        LineLook::Coil => LineStyle::Coil,
        LineLook::Damper => LineStyle::Damper,
        LineLook::CoilDamper => LineStyle::CoilDamper,
        LineLook::Bumper => LineStyle::Bumper,
        LineLook::Actuator => LineStyle::Actuator,
    }
}

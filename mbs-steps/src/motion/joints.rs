//! Shapes of joints, by the kind of joint: pins, sockets, rails with blocks, and symbols of the ground. Planes on which bodies roll are
//! drawn here too.

use super::drawing::Drawing;
use super::pose::unit_of;
use crate::record::{DrawnPoint, DrawnShape, RecordedMotion, ShapeForm};
use mbs_core::Real;
use mbs_core::effects::EffectPicture;
use mbs_core::scene::{Axis, BodyId, Dimension, Joint, Rotation, Translation};

impl<T: Real> Drawing<'_, T> {
    /// Adds the shapes of every joint, and the rings of bushings.
    pub(super) fn add_joints(&self, motion: &mut RecordedMotion) {
        for joint in self.scene.joints.iter().filter(|joint| !joint.kind.is_free()) {
            let place = self.place(joint.bodies[1], joint.points[1]);
            motion.joints.push(DrawnPoint { name: joint.name.clone(), place });
            self.add_joint(joint, &mut motion.shapes);
        }
        for effect in self.scene.effects.iter().filter(|effect| effect.enabled) {
            if let EffectPicture::Ring(body, at) = effect.kind.drawn_as() {
                let place = self.place(body, at);
                let form = ShapeForm::Ring { at: place.at };
                motion.shapes.push(DrawnShape::new(place.body, form));
            }
        }
        for rolling in &self.scene.rollings {
            let slider = self.place(rolling.body, rolling.at);
            let up = if self.is_planar() { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
            let (at, axis) = rolling.plane.as_ref().map_or(([T::ZERO; 3], up), |plane| {
                (plane.point, unit_of(plane.normal.map(Real::to_f64)))
            });
            let at = self.place(rolling.on, at).at;
            let form = ShapeForm::Plane { at, axis, slider };
            motion.shapes.push(DrawnShape::new(rolling.on.index(), form));
        }
    }

    fn add_joint(&self, joint: &Joint<T>, shapes: &mut Vec<DrawnShape>) {
        let mut add = |body: BodyId, form| shapes.push(DrawnShape::new(body.index(), form));
        let ends = [0, 1].map(|side| self.place(joint.bodies[side], joint.points[side]));
        for side in 0..2 {
            if joint.bodies[side] == BodyId::Ground {
                add(BodyId::Ground, ShapeForm::Support { at: ends[side].at });
            }
        }
        if joint.kind.is_link() {
            return;
        }
        let direction = |axis: Axis| {
            let direction: [T; 3] = joint.direction(axis).into();
            unit_of(direction.map(Real::to_f64))
        };
        let [_, second] = joint.bodies;
        match joint.kind.translation(self.scene.dimension) {
            Translation::Along(axis) => {
                let axis = direction(axis);
                // If one of the two bodies is the ground, the rail is on the ground.
                let on = usize::from(second == BodyId::Ground);
                let slider = ends[1 - on];
                add(joint.bodies[on], ShapeForm::Rail { at: ends[on].at, axis, slider });
                add(joint.bodies[1 - on], ShapeForm::Block { at: slider.at, axis });
                return;
            }
            Translation::Across(_) | Translation::Free => return,
            Translation::Fixed => {}
        }
        let at = ends[1].at;
        match joint.kind.rotation(self.scene.dimension) {
            Rotation::Fixed => {}
            Rotation::About(axis) => add(second, ShapeForm::Pin { at, axis: direction(axis) }),
            Rotation::Free if self.scene.dimension == Dimension::Planar => {
                add(second, ShapeForm::Pin { at, axis: [0.0, 0.0, 1.0] });
            }
            Rotation::Universal(_) | Rotation::Free => add(second, ShapeForm::Socket { at }),
        }
    }
}

//! Equations of cut joints, and effects, from the scene.
//!
//! | joint | rows (p: from the first body's point to the second's; v, w across the axis in the first body) |
//! |---|---|
//! | revolute | p = 0; space: v·n, w·n |
//! | spherical | p = 0 |
//! | universal | p = 0, a·b |
//! | prismatic | p·v, p·w, v·n, w·n, v·w; plane: p·v, x·y |
//! | cylindrical | p·v, p·w, v·n, w·n |
//! | planar | p·n, v·n, w·n |
//! | distance | (p·p − L²)/(2L); hinged: p·a |

use crate::loads::Load;
use crate::loops::index;
use crate::rows::{Loop, Row};
use crate::space::{Numbers, Space};
use crate::tree::TreeModel;
use mbs_core::Real;
use mbs_core::algebra::{Vector, norm};
use mbs_core::inputs::CourseInput;
use mbs_core::laws::scalar::Law;
use mbs_core::natural::{joint_axes, transverse};
use mbs_core::scene::{AxisFrame, BodyRef, Course, EffectKind, Joint, JointKind, Scene};

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Adds a cut joint's rows.
    pub(crate) fn add_loop(&mut self, scene: &Scene<T>, index_of_joint: usize) {
        let joint = &scene.joints[index_of_joint];
        let [first, second] = [0, 1].map(|i| self.seat_point(joint.bodies[i], joint.points[i]));
        let start = self.rows.len();
        self.add_rows(scene, joint);
        self.loops.push(Loop {
            links: [first.0, second.0],
            points: [first.1, second.1],
            first: index(start),
            n: index(self.rows.len() - start),
            ancestor: 0,
            block: 0,
            joint: index(index_of_joint),
        });
    }

    fn add_rows(&mut self, scene: &Scene<T>, joint: &Joint<T>) {
        let [n, b] = joint_axes(joint, scene.dimension).map(Vector::<T, 3>::from);
        let rows = &mut self.rows;
        let gap = |d: &Vector<T, 3>, constant| Row::Gap { direction: S::point_from(d), constant };
        let dot = |x: &Vector<T, 3>, y: &Vector<T, 3>| Row::Dot {
            x: S::point_from(x),
            y: S::point_from(y),
            constant: x.dot(y),
        };
        let point = (0..S::Point::N).map(|axis| Row::Coincidence { axis: index(axis) });
        let is_spatial = S::DIMENSION == 3;
        let [v, w] = transverse(&n, scene.dimension);
        match joint.kind {
            JointKind::Revolute | JointKind::Spherical => rows.extend(point),
            JointKind::Universal => {
                rows.extend(point);
                rows.push(dot(&n, &b));
            }
            JointKind::Prismatic if is_spatial => {
                rows.extend([gap(&v, T::ZERO), gap(&w, T::ZERO), dot(&v, &n), dot(&w, &n)]);
                rows.push(dot(&v, &w));
            }
            JointKind::Prismatic => {
                let across = Vector::<T, 3>::new(-n[1], n[0], T::ZERO);
                rows.extend([gap(&across, T::ZERO), dot(&n, &across)]);
            }
            JointKind::Cylindrical => {
                rows.extend([gap(&v, T::ZERO), gap(&w, T::ZERO), dot(&v, &n), dot(&w, &n)]);
            }
            JointKind::Planar => rows.extend([gap(&n, T::ZERO), dot(&v, &n), dot(&w, &n)]),
            JointKind::Distance => {
                let d = Vector::<T, 3>::from(joint.points[1]) - Vector::from(joint.points[0]);
                rows.push(Row::Length { length: norm(&d) });
                if joint.axes[0].is_some() {
                    rows.push(gap(&n, n.dot(&d)));
                }
                return;
            }
            JointKind::Free | JointKind::Weld => return,
        }
        if joint.kind == JointKind::Revolute && is_spatial {
            rows.extend([dot(&v, &n), dot(&w, &n)]);
        }
    }

    /// Adds the enabled effects; what acts between bodies that never move against each other is nothing.
    pub(crate) fn add_loads(&mut self, scene: &Scene<T>) {
        for effect in scene.effects.iter().filter(|effect| effect.enabled) {
            match &effect.kind {
                EffectKind::SpringDamper { bodies, points, stiffness, damping, free_length } => {
                    let ends = [0, 1].map(|i| self.seat_point(bodies[i], points[i]));
                    let law = Law::SpringDamper {
                        stiffness: *stiffness,
                        damping: *damping,
                        free: *free_length,
                    };
                    let (links, points) = (ends.map(|e| e.0), ends.map(|e| e.1));
                    self.loads.push(Load::Length { links, points, law });
                }
                EffectKind::TorsionSpring { joint, stiffness, damping, free_value } => {
                    let law = Law::SpringDamper {
                        stiffness: *stiffness,
                        damping: *damping,
                        free: *free_value,
                    };
                    self.add_angle(*joint, law);
                }
                EffectKind::JointTorque { joint, course } => {
                    let law = Law::Torque { course: self.course(course) };
                    self.add_angle(*joint, law);
                }
                EffectKind::Force { body, at, course, frame } => {
                    let (link, point) = self.seat_point(BodyRef::Body(*body), *at);
                    if link == 0 {
                        continue;
                    }
                    let load = match (course, frame) {
                        (Course::Constant(f), AxisFrame::Global) => {
                            let force = S::point_from(&Vector::from(*f));
                            Load::Constant { link, point, force }
                        }
                        _ => {
                            let turns = *frame == AxisFrame::Body;
                            Load::Force { link, point, course: self.course(course), turns }
                        }
                    };
                    self.loads.push(load);
                }
                EffectKind::BodyTorque { body, course } => {
                    let link = self.link_of_body[*body];
                    if link > 0 {
                        let course = self.course(course);
                        self.loads.push(Load::Torque { link, course });
                    }
                }
            }
        }
    }

    fn course(&mut self, course: &Course<T>) -> u32 {
        self.courses.push(CourseInput::new(course));
        index(self.courses.len() - 1)
    }

    fn add_angle(&mut self, joint: usize, law: Law<T>) {
        if let Some(seat) = self.seats.iter().find(|seat| seat.branch.joint == Some(joint)) {
            self.loads.push(Load::Angle { link: seat.link, law });
        }
    }
}

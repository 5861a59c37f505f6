//! Equations of cut joints, and effects, made from the scene.
//!
//! | freedoms | rows (p: from the first body's point to the second's; u, n, v, w in the first body, v, w across n) |
//! |---|---|
//! | no slide; slides | p = 0; p·u for each u across the slides |
//! | no turn | v·n, w·n, v·w; plane: x·y |
//! | one turn | v·n, w·n; plane: none |
//! | two turns | a·b |
//! | ball | none |
//! | link | (p·p − L²)/(2L); hinged: p·a |

use crate::build::error::TreeError;
use crate::build::tree::TreeModel;
use crate::link::LinkRotor;
use crate::loads::{BodyLoad, Load, Measure, SumLoad};
use crate::loops::index;
use crate::rows::Row;
use crate::rows::closed_loop::ClosedLoop;
use crate::space::{Numbers, Space};
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::actions::{self, Action};
use mbs_core::algebra::{Vector, norm};
use mbs_core::laws::scalar::Law;
use mbs_core::measure::{RollingInput, RotorInput};
use mbs_core::scene::{Axis, BodyId, Dimension, Joint, Scene, Translation, transverse};

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Adds the rows of a cut joint.
    pub(crate) fn add_loop(&mut self, scene: &Scene<T>, index_of_joint: usize) {
        let joint = &scene.joints[index_of_joint];
        let [first, second] = [0, 1].map(|i| self.seat_point(joint.bodies[i], joint.points[i]));
        let start = self.rows.len();
        self.add_rows(scene, joint);
        self.close([first, second], start, index_of_joint);
    }

    /// Adds a loop that connects two points. Its rows begin at index `start`. `owner` is the index of the joint or rolling.
    fn close(&mut self, [first, second]: [(u32, S::Point); 2], start: usize, owner: usize) {
        self.loops.push(ClosedLoop {
            links: [first.0, second.0],
            points: [first.1, second.1],
            first: index(start),
            n: index(self.rows.len() - start),
            ancestor: 0,
            block: 0,
            joint: index(owner),
        });
    }

    fn add_rows(&mut self, scene: &Scene<T>, joint: &Joint<T>) {
        let (kind, dimension) = (joint.kind, scene.dimension);
        let rows = &mut self.rows;
        let gap = |d: &Vector<T, 3>, constant| Row::Gap { direction: S::point_from(d), constant };
        let dot = |[x, y]: [Vector<T, 3>; 2]| Row::Dot {
            x: S::point_from(&x),
            y: S::point_from(&y),
            constant: x.dot(&y),
        };
        if kind.translation(dimension) == Translation::Fixed {
            rows.extend((0..S::Point::N).map(|axis| Row::Coincidence { axis: index(axis) }));
        }
        rows.extend(joint.across_slides(dimension).map(|u| gap(&u, T::ZERO)));
        if let Some(n) = joint.common_axis(dimension) {
            let [v, w] = transverse(&n, dimension);
            match dimension {
                Dimension::Planar => {
                    rows.push(dot([n, Vector::<T, 3>::new(-n[1], n[0], T::ZERO)]));
                }
                Dimension::Spatial => rows.extend([dot([v, n]), dot([w, n])]),
            }
        }
        rows.extend(joint.kept_angle(dimension).map(dot));
        if kind.is_link() {
            let d = Vector::<T, 3>::from(joint.points[1]) - Vector::from(joint.points[0]);
            rows.push(Row::Length { length: norm(&d) });
            if joint.is_hinged_link() {
                let hinge = joint.direction(Axis::First);
                rows.push(gap(&hinge, hinge.dot(&d)));
            }
        }
    }

    /// Adds the rows of rolling bodies.
    pub(crate) fn add_rollings(&mut self, scene: &Scene<T>) {
        for (i, rolling) in scene.rollings.iter().enumerate() {
            let input = RollingInput::new(rolling, scene.dimension);
            let places = [input.center, input.base];
            let [first, second] =
                [0, 1].map(|side| self.seat_point(input.bodies[side], places[side].into()));
            if first.0 == second.0 {
                continue;
            }
            let start = self.rows.len();
            let [normal, along @ ..] = input.plane.each_ref().map(S::point_from);
            let axis = S::point_from(&input.axis);
            if input.is_blade {
                self.rows.push(Row::Blade { direction: axis, normal });
            } else {
                self.rows.push(Row::Height { radius: input.radius, axis, normal });
                let slips = along.into_iter().take(S::DIMENSION - 1);
                self.rows.extend(slips.map(|direction| Row::NoSlip { direction }));
            }
            self.close([first, second], start, i);
        }
    }

    /// Adds the effects of a scene. Effects that act on the ground alone are skipped.
    ///
    /// # Errors
    /// [`TreeError::EffectCut`]: an effect about the axis of a cut joint, whose angle is not a coordinate of the tree.
    pub(crate) fn add_loads(
        &mut self,
        scene: &Scene<T>,
        list: &[(usize, Action<T>)],
    ) -> Result<(), TreeError> {
        let coordinates = self.coordinate_links(scene);
        for (effect, action) in list {
            let cut = |joint| TreeError::EffectCut { effect: *effect, joint };
            if let Some(load) = self.load((scene, &coordinates), action).map_err(cut)?
                && !load.is_idle()
            {
                self.loads.push(load);
            }
            // An effect has at most one load here.
            self.effects.resize(self.loads.len(), *effect);
        }
        Ok(())
    }

    /// Adds the rotors of a scene. Rotors of the same link are added into one. Joints between parts of one rigid body do not turn and are
    /// skipped.
    ///
    /// # Errors
    /// [`TreeError::EffectCut`]: a rotor on a cut joint, which has no coordinate in the tree.
    pub(crate) fn add_rotors(&mut self, scene: &Scene<T>) -> Result<(), TreeError> {
        let links = self.coordinate_links(scene);
        for RotorInput { effect, joint, number, inertia } in RotorInput::all(scene) {
            let [first, second] = scene.joints[joint].bodies.map(|body| self.link(body));
            let Some(link) = links[joint].get(number).copied().flatten() else {
                if first == second {
                    continue;
                }
                return Err(TreeError::EffectCut { effect, joint });
            };
            match self.rotors.iter_mut().find(|rotor| rotor.link == link) {
                Some(rotor) => rotor.inertia += inertia,
                None => self.rotors.push(LinkRotor { link, inertia }),
            }
        }
        Ok(())
    }

    /// Makes the load of a law about the axis of a joint. The load acts on the coordinate of the link that turns about the axis. A free
    /// joint in the plane has no such link: the law then depends on the difference of the angles of its two bodies. A joint between parts
    /// of one rigid body does not turn and has no load.
    ///
    /// # Errors
    /// Index of the joint, if its angle is no coordinate of the tree.
    fn about_axis(
        &self,
        scene: &Scene<T>,
        (index, link): (usize, Option<u32>),
        law: Law<T>,
    ) -> Result<Option<Load<T, S>>, usize> {
        let joint = &scene.joints[index];
        let is_planar_free = joint.kind.is_free() && S::DIMENSION == 2;
        if let Some(link) = link.filter(|_| !is_planar_free) {
            return Ok(Some(Load::Angle { link, law }));
        }
        let links = joint.bodies.map(|body| self.link(body));
        if links[0] == links[1] {
            return Ok(None);
        }
        let load = is_planar_free.then_some(Load::Between { links, gauge: Measure::Turn, law });
        load.map(Some).ok_or(index)
    }

    /// Makes the load of an action. `coordinates` contains the link of each joint coordinate.
    ///
    /// # Errors
    /// Index of a joint whose angle the action needs, although the angle is no coordinate of the tree.
    fn load(
        &mut self,
        (scene, coordinates): (&Scene<T>, &[Vec<Option<u32>>]),
        action: &Action<T>,
    ) -> Result<Option<Load<T, S>>, usize> {
        let link_of = |joint: usize, number: usize| coordinates[joint][number];
        Ok(Some(match action {
            Action::Angle { joint, number, law } => {
                return self.about_axis(scene, (*joint, link_of(*joint, *number)), *law);
            }
            Action::Length { ends, law } => {
                let (links, points) = self.ends(ends);
                Load::Between { links, gauge: Measure::Length { points }, law: *law }
            }
            Action::Along { ends, direction, offset, of, law } => {
                // Each slide of a joint with several coordinates is the coordinate of one link.
                if let Some(link) = of.and_then(|(joint, number)| link_of(joint, number)) {
                    return Ok(Some(Load::Angle { link, law: *law }));
                }
                let (links, points) = self.ends(ends);
                let direction = S::point_from(&Vector::from(*direction));
                let gauge = Measure::Along { points, direction, offset: *offset };
                Load::Between { links, gauge, law: *law }
            }
            Action::Sum { terms, law } => {
                let (terms, starts) = self.add_terms((terms, T::ONE), (scene, coordinates))?;
                Load::Sum(SumLoad { terms, starts, law: *law })
            }
            Action::Turn { bodies, law } => {
                let links = bodies.map(|body| self.link(body));
                Load::Between { links, gauge: Measure::Turn, law: *law }
            }
            Action::Rotation { bodies, number, law } => {
                let links = bodies.map(|body| self.link(body));
                Load::Between { links, gauge: Measure::Rotation { number: *number }, law: *law }
            }
            Action::Constant { at, force } => {
                let (link, point) = self.seat_point(BodyId::Body(at.0), at.1);
                Load::Constant { link, point, force: S::point_from(&Vector::from(*force)) }
            }
            Action::Force { at, course, turns } => {
                let (link, point) = self.seat_point(BodyId::Body(at.0), at.1);
                Load::Force { link, point, course: *course, turns: *turns }
            }
            Action::Torque { body, course } => {
                Load::Torque { link: self.link_of_body[*body], course: *course }
            }
            Action::BodyLoad { at, axis, law } => {
                let (link, point) = self.seat_point(BodyId::Body(at.0), at.1);
                Load::BodyLoad(BodyLoad { link, point, axis: *axis, law: *law })
            }
        }))
    }

    /// Returns the links of two attachment points, and the points on these links.
    fn ends(&self, ends: &[actions::Attachment<T>; 2]) -> ([u32; 2], [S::Point; 2]) {
        let [first, second] = ends.map(|(body, at)| self.seat_point(body, at));
        ([first.0, second.0], [first.1, second.1])
    }
}

impl<T: Real, S: Space<T>> Load<T, S> {
    /// True if the load acts on the ground alone.
    pub(crate) fn is_idle(&self) -> bool {
        match self {
            Self::Between { .. } | Self::Sum(_) => false,
            Self::Angle { link, .. }
            | Self::Constant { link, .. }
            | Self::Force { link, .. }
            | Self::Torque { link, .. }
            | Self::BodyLoad(BodyLoad { link, .. }) => *link == 0,
        }
    }
}

//! Shapes of the bodies, for example rods, boxes and capsules of their inertia, wheels, bars to joints, and planar polygons.

use super::drawing::Drawing;
use super::pose::{cross, dot, unit_of};
use super::principal::principal;

use crate::record::{DrawnShape, RecordedMotion, ShapeForm};
use mbs_core::Real;
use mbs_core::effects::{EffectPicture, RoadWheel};
use mbs_core::scene::{Axis, BodyId, Dimension, Inertia, JointId, RollingKind, ShapeKind};

/// Radius of a rod, relative to the scene's length [-].
const ROD: f64 = 0.012;
/// Radius of a point mass, relative to the scene's length [-].
const POINT: f64 = 0.02;
/// Smallest half length of a box, relative to the scene's length [-], so that the box is visible.
const MIN_HALF: f64 = 0.004;
/// Half length above which a box is not drawn, relative to the scene's length [-], because it would hide everything else.
const MAX_HALF: f64 = 3.0;
/// Largest ratio of the two shorter half lengths for which a solid is drawn as a capsule [-].
const ALIKE: f64 = 1.15;
/// Smallest ratio of length to width for which a solid is drawn as a capsule [-].
const LONG: f64 = 1.5;
/// Width of a tire, relative to its radius [-].
const TIRE_WIDTH: f64 = 0.35;
/// Width of rolling discs and of gears, relative to their radius [-].
const DISC_WIDTH: f64 = 0.12;

/// Box or capsule with the inertia of a body: its half lengths and axes.
struct Solid {
    half: [f64; 3],
    axes: [[f64; 3]; 3],
}

impl Solid {
    fn contains(&self, at: [f64; 3]) -> bool {
        (0..3).all(|i| dot(self.axes[i], at).abs() < self.half[i])
    }
}

impl<T: Real> Drawing<'_, T> {
    /// Adds the shapes of every body.
    pub(super) fn add_bodies(&self, motion: &mut RecordedMotion) {
        let wheels = self.add_wheels(motion);
        motion.shapes.extend(self.scene.shapes.iter().map(|shape| self.shape(shape)));
        for body in 0..self.scene.bodies.len() {
            let mut own = self.scene.shapes.iter().filter(|s| s.body == BodyId::Body(body));
            let has_any = own.clone().next().is_some();
            // A body that has only mesh files also gets the shapes of its inertia. They are drawn if the files are missing.
            if own.all(|shape| matches!(shape.form, ShapeKind::Mesh { .. })) {
                let first = motion.shapes.len();
                self.add_body(body, wheels.contains(&body), motion);
                motion.shapes[first..].iter_mut().for_each(|shape| shape.stands_in = has_any);
            }
        }
    }

    fn add_body(&self, body: usize, is_wheel: bool, motion: &mut RecordedMotion) {
        let mut add = |form| motion.shapes.push(DrawnShape::new(Some(body), form));
        let used = self.used(body);
        match self.scene.bodies[body].inertia {
            Inertia::Point => {
                add(ShapeForm::Ball { at: [0.0; 3], radius: POINT * self.length, turns: false });
            }
            Inertia::Rod { from, to } => {
                let [from, to] = [from, to].map(|x| self.place(BodyId::Body(body), x).at);
                add(ShapeForm::Rod { from, to, radius: ROD * self.length });
                let off = |at: &[f64; 3]| distance_to_line(*at, from, to) > ROD * self.length;
                let strokes = used.into_iter().filter(off);
                strokes.for_each(|to| add(ShapeForm::Stroke { from: [0.0; 3], to }));
            }
            Inertia::Planar(_) if used.len() >= 3 => {
                add(ShapeForm::Polygon { points: around(used) });
            }
            Inertia::Planar(moment) if used.iter().all(|at| dot(*at, *at) == 0.0) && !is_wheel => {
                // Disc with the same inertia, m r^2 / 2.
                let mass = self.scene.bodies[body].mass.to_f64();
                let radius = (2.0 * moment.to_f64() / mass).sqrt();
                let radius = if radius > 0.0 && mass > 0.0 { radius } else { POINT * self.length };
                add(disc([0.0; 3], [0.0, 0.0, 1.0], radius));
            }
            Inertia::Planar(_) => self.add_strokes(used, None, &mut add),
            Inertia::Spatial(inertia) => {
                let solid = if is_wheel { None } else { self.solid(body, inertia) };
                if let Some(solid) = &solid {
                    let is_clear = used.iter().any(|at| solid.contains(*at));
                    add(form_of(solid, is_clear));
                }
                self.add_strokes(used, solid.as_ref(), &mut add);
            }
        }
    }

    /// Adds bars from the centre of mass to the points that the body's box does not contain.
    fn add_strokes(
        &self,
        used: Vec<[f64; 3]>,
        solid: Option<&Solid>,
        add: &mut impl FnMut(ShapeForm),
    ) {
        let is_bare = used.is_empty() && solid.is_none();
        let outside = used.into_iter().filter(|at| solid.is_none_or(|solid| !solid.contains(*at)));
        let far = outside.filter(|at| dot(*at, *at).sqrt() > MIN_HALF * self.length);
        far.for_each(|to| add(ShapeForm::Stroke { from: [0.0; 3], to }));
        if is_bare {
            add(ShapeForm::Ball { at: [0.0; 3], radius: POINT * self.length, turns: false });
        }
    }

    /// Box with the inertia of a body, from its principal moments I_i, their sum tr I, and its mass m. Its half lengths are sqrt(3 (tr I /
    /// 2 - I_i) / m), because tr I / 2 - I_i is the integral of x_i^2 dm.
    fn solid(&self, body: usize, inertia: [T; 6]) -> Option<Solid> {
        let mass = self.scene.bodies[body].mass.to_f64();
        let (moments, axes) = principal(inertia.map(Real::to_f64));
        let trace: f64 = moments.iter().sum();
        let half = moments.map(|moment| (3.0 * (trace / 2.0 - moment) / mass).max(0.0).sqrt());
        let is_drawn = mass > 0.0
            && trace > 0.0
            && half.iter().all(|a| a.is_finite() && *a <= MAX_HALF * self.length);
        let half = half.map(|a| a.max(MIN_HALF * self.length));
        is_drawn.then_some(Solid { half, axes })
    }

    /// Points of joints, line effects and outputs on a body; each point is listed once. A box must not hide these points.
    fn used(&self, body: usize) -> Vec<[f64; 3]> {
        let scene = self.scene;
        let of_joints = scene.joints.iter().filter(|j| !j.kind.is_free());
        let of_joints = of_joints.flat_map(|j| j.bodies.into_iter().zip(j.points));
        let lines = scene.effects.iter().filter(|e| e.enabled).flat_map(|e| e.kind.places());
        let lines = lines.filter(|(key, ..)| *key == "points").map(|(_, b, at)| (b, at));
        let outputs = scene.outputs.iter().filter_map(|output| output.quantity.traced());
        let mut places: Vec<[f64; 3]> = Vec::new();
        for (of, at) in of_joints.chain(lines).chain(outputs) {
            let at = self.place(of, at).at;
            if of == BodyId::Body(body) && !places.contains(&at) {
                places.push(at);
            }
        }
        places
    }

    /// Adds the wheels of tires, of rolling bodies and of gears. Returns the bodies that are wheels or carry wheels.
    fn add_wheels(&self, motion: &mut RecordedMotion) -> Vec<usize> {
        let mut bodies = Vec::new();
        let mut add = |body: BodyId, form| {
            motion.shapes.push(DrawnShape::new(body.index(), form));
            bodies.extend(body.index());
        };
        for effect in self.scene.effects.iter().filter(|effect| effect.enabled) {
            if let EffectPicture::Wheel(wheel) = effect.kind.drawn_as() {
                let (body, axis) = self.wheel_of(&wheel);
                let (at, radius) = (self.place(body, wheel.center).at, wheel.radius.to_f64());
                let width = TIRE_WIDTH * radius;
                let turns = wheel.spin.is_some() || self.is_planar();
                add(body, ShapeForm::Wheel { at, axis, radius, width, turns });
                let to = self.place(wheel.body, wheel.center).at;
                add(wheel.body, ShapeForm::Stroke { from: [0.0; 3], to });
            }
        }
        for rolling in &self.scene.rollings {
            let at = self.place(rolling.body, rolling.at).at;
            match &rolling.kind {
                RollingKind::Wheel { axis, radius } => {
                    let axis = if self.is_planar() {
                        [0.0, 0.0, 1.0]
                    } else {
                        unit_of(axis.map(Real::to_f64))
                    };
                    add(rolling.body, disc(at, axis, radius.to_f64()));
                }
                RollingKind::Ball { radius } => {
                    let radius = radius.to_f64();
                    add(rolling.body, ShapeForm::Ball { at, radius, turns: true });
                }
                RollingKind::Blade { .. } => {}
            }
        }
        for (joint, pitch) in self.teeth() {
            if let Some((body, form)) = self.gear(joint, pitch) {
                add(body, form);
            }
        }
        bodies
    }

    /// Body that rotates with a wheel, and the axis of this rotation.
    fn wheel_of(&self, wheel: &RoadWheel<T>) -> (BodyId, [f64; 3]) {
        let joint = wheel.spin.map(|joint| &self.scene.joints[joint]);
        let others = joint.map(|joint| joint.bodies.into_iter().find(|body| *body != wheel.body));
        let body = others.flatten().filter(|body| body.index().is_some()).unwrap_or(wheel.body);
        let of_joint = || joint.map(|joint| joint.direction(Axis::First).into());
        let axis = wheel.axis.or_else(of_joint).map(|axis: [T; 3]| unit_of(axis.map(Real::to_f64)));
        // If no axis is known, the axis is horizontal and perpendicular to the direction of travel x.
        let across = if self.is_planar() { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
        (body, axis.filter(|_| !self.is_planar()).unwrap_or(across))
    }

    /// Joints of gear wheels. Each joint is listed with the pitch point of its mesh.
    fn teeth(&self) -> Vec<(JointId, [T; 3])> {
        let mut found = Vec::new();
        for coupling in &self.scene.couplings {
            if let mbs_core::scene::CouplingKind::Mesh(mesh) = &coupling.kind {
                let joints = coupling.terms.iter().filter_map(|term| term.of.joint());
                found.extend(joints.map(|joint| (joint, mesh.at)));
            }
        }
        found
    }

    /// Disc of a gear wheel: it goes through the pitch point, and its axis is the axis of the joint.
    fn gear(&self, joint: JointId, pitch: [T; 3]) -> Option<(BodyId, ShapeForm)> {
        let joint = &self.scene.joints[joint];
        let body = joint.bodies[1];
        let planar = self.scene.dimension == Dimension::Planar;
        let axis = if planar {
            [0.0, 0.0, 1.0]
        } else {
            let axis: [T; 3] = joint.direction(Axis::First).into();
            unit_of(axis.map(Real::to_f64))
        };
        let center = self.place(body, joint.points[1]).at;
        let pitch = self.place(body, pitch).at;
        let across = cross([0, 1, 2].map(|i| pitch[i] - center[i]), axis);
        let radius = dot(across, across).sqrt();
        let along = dot([0, 1, 2].map(|i| pitch[i] - center[i]), axis);
        let at = [0, 1, 2].map(|i| center[i] + along * axis[i]);
        (radius > 0.0).then(|| (body, disc(at, axis, radius)))
    }
}

/// Disc with marks that show its rotation.
fn disc(at: [f64; 3], axis: [f64; 3], radius: f64) -> ShapeForm {
    ShapeForm::Wheel { at, axis, radius, width: DISC_WIDTH * radius, turns: true }
}

/// Sorts the corners of a polygon by angle around their mean, so that its sides do not cross.
fn around(mut points: Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    #[allow(clippy::cast_precision_loss, reason = "numbers of joints are far below 2^53")]
    let n = points.len() as f64;
    let middle = [0, 1].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / n);
    let angle = |p: &[f64; 3]| (p[1] - middle[1]).atan2(p[0] - middle[0]);
    points.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    points
}

/// Form of a solid: a capsule if two half lengths are similar and the third is longer, else a box.
fn form_of(solid: &Solid, is_clear: bool) -> ShapeForm {
    let Solid { half, axes } = solid;
    let long = (0..3).fold(0, |a, b| if half[b] > half[a] { b } else { a });
    let [a, b] = [half[(long + 1) % 3], half[(long + 2) % 3]];
    let (thin, wide) = (a.min(b), a.max(b));
    if wide <= ALIKE * thin && half[long] >= LONG * wide {
        let reach = half[long] - wide;
        let end = |sign: f64| axes[long].map(|x| sign * reach * x);
        return ShapeForm::Capsule { from: end(-1.0), to: end(1.0), radius: wide, is_clear };
    }
    ShapeForm::Box { at: [0.0; 3], half: *half, axes: *axes, is_clear }
}

/// Distance of a point from the straight line through two other points.
fn distance_to_line(at: [f64; 3], from: [f64; 3], to: [f64; 3]) -> f64 {
    let along = unit_of([0, 1, 2].map(|i| to[i] - from[i]));
    let across = cross([0, 1, 2].map(|i| at[i] - from[i]), along);
    dot(across, across).sqrt()
}

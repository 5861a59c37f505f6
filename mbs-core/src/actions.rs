//! Effects told in laws, once for all models: what acts, between which places of which bodies, by which law.
//!
//! A scene has many kinds of effect; models, outputs and other formulations know only the few kinds of [`Action`]. Effects that
//! are switched off are not among them.

use crate::Real;
use crate::inputs::CourseInput;
use crate::laws::body::BodyLaw;
use crate::laws::friction::Friction;
use crate::laws::limit::Limit;
use crate::laws::polynomial::{self, Piece};
use crate::laws::road::Feature;
use crate::laws::scalar::Law;
use crate::laws::speed_hold::SpeedHold;
use crate::laws::tire::Tire;
use crate::laws::{Part, Supplies, guide};
use crate::natural::joint_axes;
use crate::scene::{
    AxisFrame, BodyRef, Course, Dimension, EffectKind, JointKind, PolynomialPiece, RoadFeature,
    Scene,
};
use alloc::vec;
use alloc::vec::Vec;

/// A place on a body, reference configuration [m].
pub type Seat<T> = (BodyRef, [T; 3]);

/// What one effect, or a part of one, does.
#[derive(Debug, Clone, PartialEq)]
pub enum Action<T> {
    /// A law along the line of two places.
    Length {
        /// The places.
        ends: [Seat<T>; 2],
        /// The law.
        law: Law<T>,
    },
    /// A law of the distance of two places along a direction fixed in the first body (a unit vector): a slide.
    Along {
        /// The places.
        ends: [Seat<T>; 2],
        /// The direction, reference configuration.
        direction: [T; 3],
        /// What the distance is counted from [m].
        offset: T,
        /// The law.
        law: Law<T>,
    },
    /// A law of the angle of a joint with one rotation.
    Angle {
        /// Index of the joint.
        joint: usize,
        /// The law.
        law: Law<T>,
    },
    /// A law of the small rotation of the second body in the first about a x b: (b1.a2 - a1.b2) / 2, where 1 and 2 are the
    /// bodies in which the unit vectors a and b turn.
    Twist {
        /// The bodies.
        bodies: [BodyRef; 2],
        /// a and b, reference configuration.
        sides: [[T; 3]; 2],
        /// The law.
        law: Law<T>,
    },
    /// A force that keeps its value and its direction: it has a potential.
    Constant {
        /// Where it acts.
        at: (usize, [T; 3]),
        /// The force [N].
        force: [T; 3],
    },
    /// A force that follows a course.
    Force {
        /// Where it acts.
        at: (usize, [T; 3]),
        /// Number of the course.
        course: u32,
        /// Does it turn with the body?
        turns: bool,
    },
    /// A torque on a body that follows a course: global axes; in the plane the first component.
    Torque {
        /// The body.
        body: usize,
        /// Number of the course.
        course: u32,
    },
    /// A law on one body.
    OnBody {
        /// Where it acts.
        at: (usize, [T; 3]),
        /// Its direction, a unit vector fixed in the body.
        axis: [T; 3],
        /// The law.
        law: BodyLaw<T>,
    },
}

/// The actions of a scene with everything they refer to.
#[derive(Debug, Clone, PartialEq)]
pub struct Actions<T> {
    /// Index of the effect, and the action. An effect may have several, one after the other.
    pub list: Vec<(usize, Action<T>)>,
    /// Prescribed functions of time.
    pub courses: Vec<CourseInput<T>>,
    /// Tables of the laws.
    pub tables: Tables<T>,
}

/// Tables that laws refer to by number; constant from then on.
#[derive(Debug, Clone, PartialEq)]
pub struct Tables<T> {
    pieces: Vec<Piece<T>>,
    features: Vec<Feature<T>>,
    knots: Vec<[T; 2]>,
    curvatures: Vec<T>,
}

impl<T: Real> Tables<T> {
    /// No tables.
    #[must_use]
    pub fn empty() -> Self {
        Self { pieces: vec![], features: vec![], knots: vec![], curvatures: vec![] }
    }

    /// What laws ask for, with the courses of this instant.
    #[inline(always)]
    pub fn supplies<'a>(&'a self, courses: &'a [[T; 3]]) -> Supplies<'a, T> {
        Supplies {
            courses,
            pieces: &self.pieces,
            features: &self.features,
            knots: (&self.knots, &self.curvatures),
        }
    }
}

impl<T: Real> Actions<T> {
    /// The actions of the enabled effects of a checked scene.
    #[must_use]
    pub fn new(scene: &Scene<T>) -> Self {
        let mut compiler = Compiler {
            scene,
            effect: 0,
            roads: None,
            actions: Self { list: Vec::new(), courses: Vec::new(), tables: Tables::empty() },
        };
        for (index, effect) in scene.effects.iter().enumerate().filter(|(_, e)| e.enabled) {
            compiler.effect = index;
            compiler.add(&effect.kind);
        }
        compiler.actions
    }
}

struct Compiler<'a, T> {
    scene: &'a Scene<T>,
    effect: usize,
    /// Features of the left and the right track, and the course of a moving road, once a tire asks.
    roads: Option<([Part; 2], Option<u32>)>,
    actions: Actions<T>,
}

impl<T: Real> Compiler<'_, T> {
    fn push(&mut self, action: Action<T>) {
        self.actions.list.push((self.effect, action));
    }

    fn course(&mut self, course: CourseInput<T>) -> u32 {
        self.actions.courses.push(course);
        number(self.actions.courses.len() - 1)
    }

    fn add(&mut self, kind: &EffectKind<T>) {
        match kind {
            EffectKind::SpringDamper { .. }
            | EffectKind::Actuator { .. }
            | EffectKind::Polynomial { .. }
            | EffectKind::Bumper { .. } => self.add_between_points(kind),
            EffectKind::TorsionSpring { .. }
            | EffectKind::JointTorque { .. }
            | EffectKind::Limit { .. }
            | EffectKind::Friction { .. } => self.add_on_joint(kind),
            EffectKind::Bushing { bodies, at, stiffness, damping } => {
                self.bushing(*bodies, *at, (stiffness, damping));
            }
            EffectKind::Force { body, at, course, frame } => {
                let at = (*body, *at);
                let action = match (course, frame) {
                    (Course::Constant(force), AxisFrame::Global) => {
                        Action::Constant { at, force: *force }
                    }
                    _ => {
                        let course = self.course(CourseInput::new(course));
                        Action::Force { at, course, turns: *frame == AxisFrame::Body }
                    }
                };
                self.push(action);
            }
            EffectKind::BodyTorque { body, course } => {
                let course = self.course(CourseInput::new(course));
                self.push(Action::Torque { body: *body, course });
            }
            EffectKind::AeroDrag { .. }
            | EffectKind::SpeedHold { .. }
            | EffectKind::Tire { .. } => {
                self.add_on_body(kind);
            }
        }
    }

    fn add_between_points(&mut self, kind: &EffectKind<T>) {
        let ends = |bodies: &[BodyRef; 2], points: &[[T; 3]; 2]| {
            [(bodies[0], points[0]), (bodies[1], points[1])]
        };
        match kind {
            EffectKind::SpringDamper { bodies, points, stiffness, damping, free_length } => {
                let (stiffness, damping, free) = (*stiffness, *damping, *free_length);
                let law = Law::SpringDamper { stiffness, damping, free };
                self.push(Action::Length { ends: ends(bodies, points), law });
            }
            EffectKind::Actuator { bodies, points, course } => {
                let law = Law::Torque { course: self.course(CourseInput::new(course)) };
                self.push(Action::Length { ends: ends(bodies, points), law });
            }
            EffectKind::Polynomial { bodies, points, direction, of_rate, pieces } => {
                let law = Law::Polynomial { pieces: self.pieces(pieces), of_rate: *of_rate };
                let ends = ends(bodies, points);
                self.push(match direction {
                    None => Action::Length { ends, law },
                    Some(d) => Action::Along { ends, direction: unit(*d), offset: T::ZERO, law },
                });
            }
            EffectKind::Bumper { bodies, points, stiffness, damping, clearance } => {
                let law = [*stiffness, *damping];
                let touch = distance(points) - *clearance;
                let law = Law::Bumper { law, touch };
                self.push(Action::Length { ends: ends(bodies, points), law });
            }
            _ => {}
        }
    }

    fn add_on_joint(&mut self, kind: &EffectKind<T>) {
        match kind {
            EffectKind::TorsionSpring { joint, stiffness, damping, free_value } => {
                let (stiffness, damping, free) = (*stiffness, *damping, *free_value);
                let law = Law::SpringDamper { stiffness, damping, free };
                self.push(Action::Angle { joint: *joint, law });
            }
            EffectKind::JointTorque { joint, course } => {
                let law = Law::Torque { course: self.course(CourseInput::new(course)) };
                self.push(Action::Angle { joint: *joint, law });
            }
            EffectKind::Limit { joint, lower, upper, stiffness, damping } => {
                let (lower, upper) = (*lower, *upper);
                let limit = Limit { lower, upper, stiffness: *stiffness, damping: *damping };
                self.on_joint(*joint, Law::Limit(limit));
            }
            EffectKind::Friction {
                joint,
                coulomb,
                r#static,
                stribeck,
                viscous,
                regularisation,
            } => {
                let law = Friction {
                    coulomb: *coulomb,
                    r#static: *r#static,
                    stribeck: *stribeck,
                    viscous: *viscous,
                    regularisation: *regularisation,
                };
                self.on_joint(*joint, Law::Friction(law));
            }
            _ => {}
        }
    }

    fn add_on_body(&mut self, kind: &EffectKind<T>) {
        match kind {
            EffectKind::AeroDrag { body, at, area_coefficient, density } => {
                let (area_coefficient, density) = (*area_coefficient, *density);
                let law = BodyLaw::Drag { area_coefficient, density };
                self.push(Action::OnBody { at: (*body, *at), axis: axis(0), law });
            }
            EffectKind::SpeedHold { body, direction, speed, gain, limit } => {
                let (speed, gain, limit) = (*speed, *gain, *limit);
                let law = BodyLaw::SpeedHold(SpeedHold { speed, gain, limit });
                let at = (*body, center(self.scene, *body));
                self.push(Action::OnBody { at, axis: unit(*direction), law });
            }
            EffectKind::Tire {
                body,
                center,
                axis: given,
                radius,
                stiffness,
                damping,
                rolling_resistance,
                side,
            } => {
                let (roads, travel) = self.roads();
                let law = BodyLaw::Tire(Tire {
                    radius: *radius,
                    radial: [*stiffness, *damping],
                    rolling: *rolling_resistance,
                    side: *side,
                    road: roads[usize::from(center[1] < T::ZERO && !self.is_planar())],
                    travel,
                    up: self.scene.dimension.count() - 1,
                });
                let axis = given.map_or_else(|| axis(2), unit);
                self.push(Action::OnBody { at: (*body, *center), axis, law });
            }
            _ => {}
        }
    }

    fn is_planar(&self) -> bool {
        self.scene.dimension == Dimension::Planar
    }

    /// A law of a joint's one coordinate.
    fn on_joint(&mut self, index: usize, law: Law<T>) {
        let joint = &self.scene.joints[index];
        self.push(match joint.kind {
            JointKind::Prismatic => {
                let direction = unit(joint_axes(joint, self.scene.dimension)[0]);
                let ends = [0, 1].map(|i| (joint.bodies[i], joint.points[i]));
                Action::Along { ends, direction, offset: T::ZERO, law }
            }
            _ => Action::Angle { joint: index, law },
        });
    }

    fn bushing(&mut self, bodies: [BodyRef; 2], at: [T; 3], (k, c): (&[T; 6], &[T; 6])) {
        let law = |i: usize| {
            let acts = !(k[i].is_zero() && c[i].is_zero());
            acts.then(|| Law::SpringDamper { stiffness: k[i], damping: c[i], free: T::ZERO })
        };
        let ends = bodies.map(|body| (body, at));
        for i in 0..self.scene.dimension.count() {
            if let Some(law) = law(i) {
                self.push(Action::Along { ends, direction: axis(i), offset: T::ZERO, law });
            }
        }
        let is_planar = self.is_planar();
        for i in (0..3).filter(|&i| i == 2 || !is_planar) {
            if let Some(law) = law(3 + i) {
                let sides = [axis((i + 1) % 3), axis((i + 2) % 3)];
                self.push(Action::Twist { bodies, sides, law });
            }
        }
    }

    fn pieces(&mut self, pieces: &[PolynomialPiece<T>]) -> Part {
        let all = &mut self.actions.tables.pieces;
        let first = all.len();
        all.extend(pieces.iter().filter_map(|p| Piece::new([p.lower, p.upper], &p.coefficients)));
        polynomial::link(&mut all[first..]);
        part(first, all.len())
    }

    fn roads(&mut self) -> ([Part; 2], Option<u32>) {
        if let Some(roads) = self.roads {
            return roads;
        }
        let road = &self.scene.road;
        let left = self.features(&road.left);
        let right = if road.left == road.right { left } else { self.features(&road.right) };
        let travel = (!road.speed.is_zero()).then(|| self.course(CourseInput::travel(road.speed)));
        *self.roads.insert(([left, right], travel))
    }

    fn features(&mut self, features: &[RoadFeature<T>]) -> Part {
        let first = self.actions.tables.features.len();
        for feature in features {
            let feature = match feature {
                RoadFeature::Flat { height } => Feature::Flat(*height),
                RoadFeature::Rise { start, length, height, rounding } => Feature::Rise {
                    start: *start,
                    length: *length,
                    height: *height,
                    rounding: *rounding,
                },
                RoadFeature::Bump { start, length, amplitude } => {
                    Feature::Bump { start: *start, length: *length, amplitude: *amplitude }
                }
                RoadFeature::Table(points) => self.spline(points),
            };
            self.actions.tables.features.push(feature);
        }
        part(first, self.actions.tables.features.len())
    }

    fn spline(&mut self, points: &[[T; 2]]) -> Feature<T> {
        let tables = &mut self.actions.tables;
        let first = tables.knots.len();
        tables.knots.extend_from_slice(points);
        tables.curvatures.resize(tables.knots.len(), T::ZERO);
        let scratch = &mut vec![T::ZERO; points.len()];
        guide::spline_curvatures(points, &mut tables.curvatures[first..], scratch);
        Feature::Spline(part(first, tables.knots.len()))
    }
}

fn number(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}

fn part(first: usize, end: usize) -> Part {
    Part { first: number(first), n: number(end - first) }
}

fn axis<T: Real>(i: usize) -> [T; 3] {
    let mut e = [T::ZERO; 3];
    e[i] = T::ONE;
    e
}

fn unit<T: Real>(d: [T; 3]) -> [T; 3] {
    let size = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
    d.map(|x| x / size)
}

fn distance<T: Real>([p, q]: &[[T; 3]; 2]) -> T {
    let d = [0, 1, 2].map(|i| q[i] - p[i]);
    (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt()
}

fn center<T: Real>(scene: &Scene<T>, body: usize) -> [T; 3] {
    match scene.bodies[body].inertia {
        crate::scene::Inertia::Rod { from, to } => [0, 1, 2].map(|i| (from[i] + to[i]) * T::HALF),
        _ => scene.bodies[body].center,
    }
}

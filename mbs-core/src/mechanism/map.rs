//! Conversion of a scene and its parts to other numbers: a function converts each number.

use crate::mechanism::{Effect, Output, Scene};
use crate::scene::{
    Body, BodyFrame, BodyShape, CalspanCoefficients, Coupling, CouplingKind, CouplingMeasure,
    CouplingTerm, Curve, Entry, Guide, Inertia, InitialCondition, InitialTarget, Joint,
    JointLimits, Mesh, Motion, NamedSignal, Number, Road, RoadFeature, Rolling, RollingKind,
    RollingPlane, SceneError, SceneFault, ShapeKind,
};
use alloc::vec::Vec;

/// Applies the function to each number of an array.
fn all<T, U, const N: usize>(x: &[T; N], f: &mut impl FnMut(&T) -> U) -> [U; N] {
    core::array::from_fn(|i| f(&x[i]))
}

fn pair<T, U>([a, b]: &[[T; 3]; 2], f: &mut impl FnMut(&T) -> U) -> [[U; 3]; 2] {
    [all(a, f), all(b, f)]
}

fn rows<T, U, const N: usize>(x: &[[T; N]], f: &mut impl FnMut(&T) -> U) -> Vec<[U; N]> {
    x.iter().map(|row| all(row, f)).collect()
}

impl<T: Clone> Scene<T> {
    /// Scene with converted numbers. It fails if an effect is a user-defined law in code.
    pub(crate) fn map<U: Default>(
        &self,
        f: &mut impl FnMut(&T) -> U,
    ) -> Result<Scene<U>, SceneError> {
        let effect = |(i, effect): (usize, &Effect<T>), f: &mut dyn FnMut(&T) -> U| {
            let refused =
                SceneError { entry: Entry::Effect(i), field: "kind", fault: SceneFault::InCode };
            let kind = effect.kind.clone().map(&mut |x: T| f(&x)).ok_or(refused)?;
            Ok(Effect { name: effect.name.clone(), enabled: effect.enabled, kind })
        };
        Ok(Scene {
            name: self.name.clone(),
            dimension: self.dimension,
            gravity: self.gravity.as_ref().map(|gravity| all(gravity, f)),
            duration: f(&self.duration),
            bodies: self.bodies.iter().map(|body| body.map(f)).collect(),
            joints: self.joints.iter().map(|joint| joint.map(f)).collect(),
            initials: self.initials.iter().map(|initial| initial.map(f)).collect(),
            guides: self
                .guides
                .iter()
                .map(|guide| Guide {
                    joint: guide.joint,
                    number: guide.number,
                    law: guide.law.map(f),
                })
                .collect(),
            couplings: self.couplings.iter().map(|coupling| coupling.map(f)).collect(),
            rollings: self.rollings.iter().map(|rolling| rolling.map(f)).collect(),
            signals: self
                .signals
                .iter()
                .map(|signal| NamedSignal { name: signal.name.clone(), kind: signal.kind.map(f) })
                .collect(),
            road: self.road.map(f),
            start: self.start,
            frames: self.frames.iter().map(|frame| frame.map(f)).collect(),
            shapes: self.shapes.iter().map(|shape| shape.map(f)).collect(),
            effects: self
                .effects
                .iter()
                .enumerate()
                .map(|entry| effect(entry, f))
                .collect::<Result<_, _>>()?,
            outputs: self.outputs.iter().map(|output| output.map(f)).collect(),
            solver: self.solver.map(f),
        })
    }
}

impl<T> BodyFrame<T> {
    fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> BodyFrame<U> {
        let axes = self.axes.as_ref().map(|[first, second]| [all(first, f), all(second, f)]);
        BodyFrame { name: self.name.clone(), body: self.body, at: all(&self.at, f), axes }
    }
}

impl<T> BodyShape<T> {
    fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> BodyShape<U> {
        let form = match &self.form {
            ShapeKind::Box { center, size, axes } => ShapeKind::Box {
                center: all(center, f),
                size: all(size, f),
                axes: axes.as_ref().map(|axes| pair(axes, f)),
            },
            ShapeKind::Sphere { center, radius } => {
                ShapeKind::Sphere { center: all(center, f), radius: f(radius) }
            }
            ShapeKind::Capsule { from, to, radius } => {
                ShapeKind::Capsule { from: all(from, f), to: all(to, f), radius: f(radius) }
            }
            ShapeKind::Cylinder { from, to, radius } => {
                ShapeKind::Cylinder { from: all(from, f), to: all(to, f), radius: f(radius) }
            }
            ShapeKind::Disc { center, radius } => {
                ShapeKind::Disc { center: all(center, f), radius: f(radius) }
            }
            ShapeKind::Polygon { points } => ShapeKind::Polygon { points: rows(points, f) },
            ShapeKind::Mesh { file, at, axes, scale } => ShapeKind::Mesh {
                file: file.clone(),
                at: all(at, f),
                axes: axes.as_ref().map(|axes| pair(axes, f)),
                scale: all(scale, f),
            },
        };
        let (name, body, colour, is_visual) =
            (self.name.clone(), self.body, self.colour, self.is_visual);
        BodyShape { name, body, form, colour, opacity: f(&self.opacity), is_visual }
    }
}

impl<T> Body<T> {
    fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> Body<U> {
        let inertia = match &self.inertia {
            Inertia::Rod { from, to } => Inertia::Rod { from: all(from, f), to: all(to, f) },
            Inertia::Planar(moment) => Inertia::Planar(f(moment)),
            Inertia::Spatial(moments) => Inertia::Spatial(all(moments, f)),
            Inertia::Point => Inertia::Point,
        };
        let (mass, center) = (f(&self.mass), all(&self.center, f));
        let gravity_scale = self.gravity_scale.as_ref().map(f);
        Body { name: self.name.clone(), mass, center, inertia, gravity_scale }
    }
}

impl<T> Rolling<T> {
    fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> Rolling<U> {
        let kind = match &self.kind {
            RollingKind::Wheel { axis, radius } => {
                RollingKind::Wheel { axis: all(axis, f), radius: f(radius) }
            }
            RollingKind::Ball { radius } => RollingKind::Ball { radius: f(radius) },
            RollingKind::Blade { direction } => RollingKind::Blade { direction: all(direction, f) },
        };
        let plane = self.plane.as_ref().map(|plane| RollingPlane {
            point: all(&plane.point, f),
            normal: all(&plane.normal, f),
        });
        let (name, at) = (self.name.clone(), all(&self.at, f));
        Rolling { name, kind, body: self.body, at, on: self.on, plane }
    }
}

impl<T> Joint<T> {
    fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> Joint<U> {
        Joint {
            name: self.name.clone(),
            kind: self.kind,
            bodies: self.bodies,
            points: pair(&self.points, f),
            axes: self.axes.each_ref().map(|axis| axis.as_ref().map(|axis| all(axis, f))),
            limits: self.limits.map(f),
        }
    }
}

impl<T> JointLimits<T> {
    fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> JointLimits<U> {
        let range = self.range.as_ref().map(|range| all(range, f));
        let [effort, velocity] = [&self.effort, &self.velocity].map(|x| x.as_ref().map(&mut *f));
        JointLimits { range, effort, velocity }
    }
}

impl<T> InitialCondition<T> {
    fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> InitialCondition<U> {
        let target = match &self.target {
            InitialTarget::Joint { joint, value, rate } => InitialTarget::Joint {
                joint: *joint,
                value: value.as_ref().map(|list| list.iter().map(&mut *f).collect()),
                rate: rate.as_ref().map(|list| list.iter().map(&mut *f).collect()),
            },
            InitialTarget::Body { body, velocity, angular_velocity } => InitialTarget::Body {
                body: *body,
                velocity: velocity.as_ref().map(|(at, v)| (all(at, f), all(v, f))),
                angular_velocity: angular_velocity.as_ref().map(|w| all(w, f)),
            },
        };
        InitialCondition { target }
    }
}

impl<T> Motion<T> {
    pub(crate) fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> Motion<U> {
        match self {
            Self::Table { rows: table, ends } => {
                Motion::Table { rows: rows(table, f), ends: *ends }
            }
            Self::Monotone { rows: table, ends } => {
                Motion::Monotone { rows: rows(table, f), ends: *ends }
            }
            Self::Sine { amplitude, frequency, phase } => {
                Motion::Sine { amplitude: f(amplitude), frequency: f(frequency), phase: f(phase) }
            }
            Self::Input(motion) => Motion::Input(all(motion, f)),
            Self::Ramp { rate } => Motion::Ramp { rate: f(rate) },
            Self::Signal(signal) => Motion::Signal(*signal),
        }
    }
}

impl<T> Coupling<T> {
    fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> Coupling<U> {
        Coupling {
            name: self.name.clone(),
            terms: self.terms.iter().map(|term| term.map(f)).collect(),
            relation: self.relation.clone(),
            value: f(&self.value),
            drawn: self.drawn,
            motion: self.motion.as_ref().map(|motion| motion.map(f)),
            kind: match &self.kind {
                CouplingKind::General => CouplingKind::General,
                CouplingKind::Rope => CouplingKind::Rope,
                CouplingKind::Strands { pretension } => {
                    CouplingKind::Strands { pretension: f(pretension) }
                }
                CouplingKind::Cam => CouplingKind::Cam,
                CouplingKind::Mesh(Mesh { at, pressure_angle }) => {
                    CouplingKind::Mesh(Mesh { at: all(at, f), pressure_angle: f(pressure_angle) })
                }
            },
        }
    }
}

impl<T> Curve<T> {
    pub(crate) fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> Curve<U> {
        match self {
            Self::Table(table) => Curve::Table(rows(table, f)),
            Self::Periodic(table) => Curve::Periodic(rows(table, f)),
            Self::Polynomial(list) => Curve::Polynomial(list.iter().map(f).collect()),
            Self::Shaped { rows: table, shape, periodic } => {
                Curve::Shaped { rows: rows(table, f), shape: *shape, periodic: *periodic }
            }
        }
    }
}

impl<T> CouplingTerm<T> {
    pub(crate) fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> CouplingTerm<U> {
        let curve = self.curve.as_ref().map(|curve| curve.map(f));
        CouplingTerm { factor: f(&self.factor), of: self.of.map(f), curve }
    }
}

impl<T> CouplingMeasure<T> {
    pub(crate) fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> CouplingMeasure<U> {
        match self {
            &Self::Coordinate { joint, number } => CouplingMeasure::Coordinate { joint, number },
            Self::Ball { joint, angle, axis } => {
                CouplingMeasure::Ball { joint: *joint, angle: *angle, axis: all(axis, f) }
            }
            Self::Length { points } => CouplingMeasure::Length {
                points: points.iter().map(|(body, at)| (*body, all(at, f))).collect(),
            },
        }
    }
}

impl CalspanCoefficients<Number> {
    /// Tire of the Bombardier Iltis, as decimal numbers.
    #[must_use]
    pub fn of_iltis() -> Self {
        Self::iltis_by(Number::double)
    }
}

impl<T> Road<T> {
    fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> Road<U> {
        let mut track = |features: &[RoadFeature<T>]| -> Vec<RoadFeature<U>> {
            features.iter().map(|feature| feature.map(f)).collect()
        };
        let (left, right) = (track(&self.left), track(&self.right));
        Road { left, right, speed: f(&self.speed) }
    }
}

impl<T> RoadFeature<T> {
    pub(crate) fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> RoadFeature<U> {
        match self {
            Self::Flat { height } => RoadFeature::Flat { height: f(height) },
            Self::Rise { start, length, height, rounding } => RoadFeature::Rise {
                start: f(start),
                length: f(length),
                height: f(height),
                rounding: f(rounding),
            },
            Self::Stairs { start, tread, riser, height, count } => RoadFeature::Stairs {
                start: f(start),
                tread: f(tread),
                riser: f(riser),
                height: f(height),
                count: *count,
            },
            Self::Bump { start, length, amplitude } => {
                RoadFeature::Bump { start: f(start), length: f(length), amplitude: f(amplitude) }
            }
            Self::Table(points) => RoadFeature::Table(rows(points, f)),
            Self::Shaped { points, shape } => {
                RoadFeature::Shaped { points: rows(points, f), shape: *shape }
            }
        }
    }
}

impl<T> Output<T> {
    fn map<U>(&self, f: &mut impl FnMut(&T) -> U) -> Output<U> {
        let Self { frame, magnitude, is_in_degrees, .. } = *self;
        let (name, quantity) = (self.name.clone(), self.quantity.map(f));
        Output { name, quantity, frame, magnitude, is_in_degrees }
    }
}

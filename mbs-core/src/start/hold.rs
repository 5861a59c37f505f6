//! Prescribed start coordinates and rates: rows that exist only during the assembly.

use crate::Real;
use crate::algebra::{Matrix, Vector, cross, lowered, raised, rotation, unit};
use crate::joint::Dimension;
use crate::mechanism::Scene;
use crate::natural::{Affine, Coordinate, NaturalModel, Places, unwrap};
use crate::scene::{BodyId, Inertia, InitialTarget, Joint};
use alloc::boxed::Box;
use alloc::vec::Vec;

/// Quantity that a start row measures.
#[derive(Debug, Clone)]
enum Kind<T: Real, const D: usize> {
    /// Angle of y in the frame x1, x2.
    Angle { x1: Affine<T, D>, x2: Affine<T, D>, y: Affine<T, D> },
    /// Slide x.y: the vector x between two points, times the unit direction y.
    Slide { x: Affine<T, D>, y: Affine<T, D> },
    /// Orientation of two bodies: (R a)_i . b_j, with the prescribed relative rotation R and the frames a and b. It is zero if the rotation
    /// is R.
    Orientation { first: Box<[Affine<T, D>; 3]>, second: Affine<T, D>, vector: [T; 3], i: usize },
    /// Velocity component of a point.
    PointRate { x: Affine<T, D>, axis: usize },
    /// Component of the velocity x' of a rod's line x at the angular velocity w. The velocity is the vector product of w and x. The rod has
    /// no rotation about its line.
    Swing { x: Affine<T, D>, w: [T; 3], axis: usize },
    /// Component of the second body's angular velocity relative to the first.
    Spin {
        first: Option<Box<[Affine<T, D>; 3]>>,
        second: Option<Box<[Affine<T, D>; 3]>>,
        axis: usize,
    },
}

/// Start row that prescribes a value, a rate or both.
#[derive(Debug, Clone)]
pub(super) struct StartRow<T: Real, const D: usize> {
    kind: Kind<T, D>,
    /// Prescribed value, `None` if only the rate is prescribed; prescribed rate, `None` if only the value is.
    pub(super) value: Option<T>,
    pub(super) rate: Option<T>,
    /// Index of the `[[initial]]` entry.
    pub(super) initial: usize,
    /// Joint or body to which the row belongs.
    pub(super) owner: crate::model::Owner,
}

impl<T: Real, const D: usize> StartRow<T, D> {
    /// All rows of a scene's initial conditions.
    pub(super) fn all(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Vec<Self> {
        let mut holds = Vec::new();
        for (initial, entry) in scene.initials.iter().enumerate() {
            match &entry.target {
                InitialTarget::Joint { joint, value, rate } => {
                    let source =
                        Source { model, joint: &scene.joints[*joint], dimension: scene.dimension };
                    let owner = crate::model::Owner::Joint(joint.index());
                    let rows = source.rows(value.as_deref(), rate.as_deref());
                    holds.extend(rows.into_iter().map(|(kind, value, rate)| Self {
                        kind,
                        value,
                        rate,
                        initial,
                        owner,
                    }));
                }
                InitialTarget::Body { body, velocity, angular_velocity } => {
                    let (me, Some(body)) = (*body, body.index()) else { continue };
                    let owner = crate::model::Owner::Body(body);
                    let mut push = |kind, rate| {
                        holds.push(Self { kind, value: None, rate: Some(rate), initial, owner });
                    };
                    if let Some((at, v)) = velocity {
                        for axis in 0..D {
                            push(Kind::PointRate { x: model.point(me, *at), axis }, v[axis]);
                        }
                    }
                    if let (Some(w), Inertia::Rod { from, to }) =
                        (angular_velocity, scene.bodies[body].inertia)
                        && D == 3
                        && !model.has_full_rotation(me)
                    {
                        let x = model.point(me, to).minus(&model.point(me, from));
                        for axis in 0..D {
                            push(Kind::Swing { x: x.clone(), w: *w, axis }, T::ZERO);
                        }
                    } else if let Some(w) = angular_velocity {
                        for (kind, rate) in spins(model, BodyId::Ground, me, *w) {
                            push(kind, rate);
                        }
                    }
                }
            }
        }
        holds
    }

    /// Sets the prescribed rate of a rod's line from its present direction.
    pub(super) fn place_rate(&mut self, q: &[T]) {
        if let Kind::Swing { x, w, axis } = &self.kind {
            self.rate = Some(cross(&Vector::from(*w), &raised(&x.value(q)))[*axis]);
        }
    }

    /// Prescribed value [rad or m]; for a rotation its angle.
    pub(super) fn target(&self) -> T {
        match &self.kind {
            Kind::Orientation { vector, .. } => {
                crate::algebra::norm(&Vector::<T, 3>::from(*vector))
            }
            _ => self.value.unwrap_or(T::ZERO),
        }
    }

    /// Size of the prescribed value in radians or scene lengths: the distance that continuation must cover.
    pub(super) fn distance(&self, length: T) -> T {
        let target = self.target().abs();
        if matches!(self.kind, Kind::Slide { .. }) { target / length } else { target }
    }

    /// Residual of the value at continuation parameter `tau`: 0 in the reference configuration, 1 at the prescribed value. Adds the
    /// gradient of the row over all coordinates to `gradient`, which must be zero before. The rate of the row has the same gradient by the
    /// velocities.
    pub(super) fn evaluate(&self, q: &[T], tau: T, gradient: &mut [T]) -> T {
        let target = self.value.map(|v| v * tau);
        match &self.kind {
            Kind::Angle { x1, x2, y } => {
                let (p1, p2, py) = (x1.value(q), x2.value(q), y.value(q));
                let (c, s) = (p1.dot(&py), p2.dot(&py));
                let inverse = T::ONE / (c * c + s * s);
                let (cn, sn) = (c * inverse, s * inverse);
                x2.add_gradient(&(py * cn), gradient);
                x1.add_gradient(&(py * -sn), gradient);
                y.add_gradient(&(p2 * cn - p1 * sn), gradient);
                target.map_or(T::ZERO, |target| unwrap(s.atan2(c), target) - target)
            }
            Kind::Slide { x, y } => {
                let (px, py) = (x.value(q), y.value(q));
                x.add_gradient(&py, gradient);
                y.add_gradient(&px, gradient);
                target.map_or(T::ZERO, |target| px.dot(&py) - target)
            }
            Kind::Orientation { first, second, vector, i } => {
                let r: Matrix<T, 3> = rotation(&(Vector::<T, 3>::from(*vector) * tau));
                let b = second.value(q);
                let mut a = Vector::<T, D>::zeros();
                for (l, direction) in first.iter().enumerate() {
                    a += direction.value(q) * r[(l, *i)];
                    direction.add_gradient(&(b * r[(l, *i)]), gradient);
                }
                second.add_gradient(&a, gradient);
                a.dot(&b)
            }
            Kind::PointRate { x, axis } | Kind::Swing { x, axis, .. } => {
                x.add_gradient(&lowered(&unit(*axis)), gradient);
                T::ZERO
            }
            Kind::Spin { first, second, axis } => {
                for (frame, sign) in [(second, T::HALF), (first, -T::HALF)] {
                    for u in frame.iter().flat_map(|f| f.iter()) {
                        u.add_gradient(&(spin_arm(&u.value(q), *axis) * sign), gradient);
                    }
                }
                T::ZERO
            }
        }
    }

    /// Adds `s` times the second derivatives of the value to a packed block over the clique's unknowns. These derivatives are valid for
    /// motions that keep directions at unit length.
    pub(super) fn add_curvature(&self, q: &[T], s: T, clique: &[u32], block: &mut [T]) {
        let mut add = |x: &Affine<T, D>, y: &Affine<T, D>, s: T| {
            x.add_product_curvature(y, s, clique, block);
        };
        match &self.kind {
            Kind::Angle { x1, x2, y } => {
                let (p1, p2, py) = (x1.value(q), x2.value(q), y.value(q));
                let (c, d) = (p1.dot(&py), p2.dot(&py));
                let inverse = T::ONE / (c * c + d * d);
                add(x2, y, s * c * inverse);
                add(x1, y, -s * d * inverse);
            }
            Kind::Slide { x, y } => add(x, y, s),
            Kind::Orientation { first, second, vector, i } => {
                let r: Matrix<T, 3> = rotation(&Vector::<T, 3>::from(*vector));
                for (l, direction) in first.iter().enumerate() {
                    add(direction, second, s * r[(l, *i)]);
                }
            }
            Kind::PointRate { .. } | Kind::Swing { .. } | Kind::Spin { .. } => {}
        }
    }

    /// Points and directions on which the row depends, each by the index of its first coordinate.
    pub(super) fn entities(&self) -> Vec<u32> {
        let mut all = Vec::new();
        let mut visit = |x: &Affine<T, D>| all.extend(x.entities());
        match &self.kind {
            Kind::Angle { x1, x2, y } => [x1, x2, y].into_iter().for_each(&mut visit),
            Kind::Slide { x, y } => [x, y].into_iter().for_each(&mut visit),
            Kind::Orientation { first, second, .. } => {
                first.iter().chain(core::iter::once(second)).for_each(&mut visit);
            }
            Kind::PointRate { x, .. } | Kind::Swing { x, .. } => visit(x),
            Kind::Spin { first, second, .. } => {
                first.iter().chain(second).flat_map(|f| f.iter()).for_each(&mut visit);
            }
        }
        all.sort_unstable();
        all.dedup();
        all
    }
}

/// Vector product of the unit vector along the axis number `axis` and the vector u.
fn spin_arm<T: Real, const D: usize>(u: &Vector<T, D>, axis: usize) -> Vector<T, D> {
    lowered(&cross(&unit(axis), &raised(u)))
}

/// Rows that prescribe an angular velocity: three in space, the rate of the angle in the plane.
fn spins<T: Real, const D: usize>(
    model: &NaturalModel<T, D>,
    first: BodyId,
    second: BodyId,
    w: [T; 3],
) -> Vec<(Kind<T, D>, T)> {
    let unit = |i: usize| core::array::from_fn(|k| if k == i { T::ONE } else { T::ZERO });
    if D == 2 {
        let (x1, x2) = (model.direction(first, unit(0)), model.direction(first, unit(1)));
        return alloc::vec![(Kind::Angle { x1, x2, y: model.direction(second, unit(0)) }, w[2])];
    }
    let frame = |body: BodyId| match body {
        BodyId::Ground => None,
        BodyId::Body(_) => Some(Box::new([0, 1, 2].map(|i| model.direction(body, unit(i))))),
    };
    (0..3)
        .map(|axis| (Kind::Spin { first: frame(first), second: frame(second), axis }, w[axis]))
        .collect()
}

/// Joint with prescribed start coordinates.
struct Source<'a, T: Real, const D: usize> {
    model: &'a NaturalModel<T, D>,
    joint: &'a Joint<T>,
    dimension: Dimension,
}

type Row<T, const D: usize> = (Kind<T, D>, Option<T>, Option<T>);

impl<T: Real, const D: usize> Source<'_, T, D> {
    /// Rows of the joint's coordinates in their order, with the given values and rates.
    fn rows(&self, value: Option<&[T]>, rate: Option<&[T]>) -> Vec<Row<T, D>> {
        let mut rows = Vec::new();
        let mut model = self.model;
        for (number, freedom) in self.joint.kind.numbered(self.dimension) {
            let (kind, sign) = match model.coordinate(self.joint, self.dimension, freedom) {
                Coordinate::Angle { x1, x2, y, sign } => (Kind::Angle { x1, x2, y }, sign),
                Coordinate::Slide { x, y } => (Kind::Slide { x, y }, T::ONE),
                Coordinate::Rotation => {
                    rows.extend(self.turning(value, rate, number));
                    continue;
                }
            };
            let at = |x: Option<&[T]>| x.and_then(|x| x.get(number)).map(|x| *x * sign);
            rows.push((kind, at(value), at(rate)));
        }
        rows
    }

    /// Three rows for a relative rotation and three for a relative angular velocity. `from` is the index of the first component.
    fn turning(&self, value: Option<&[T]>, rate: Option<&[T]>, from: usize) -> Vec<Row<T, D>> {
        let [first, second] = self.joint.bodies;
        let three = |x: Option<&[T]>| -> Option<[T; 3]> {
            let x = x?.get(from..from + 3)?;
            Some([x[0], x[1], x[2]])
        };
        let unit = |i: usize| core::array::from_fn(|k| if k == i { T::ONE } else { T::ZERO });
        let mut rows = Vec::new();
        if let Some(vector) = three(value) {
            let frame = [0, 1, 2].map(|i| self.model.direction(first, unit(i)));
            for (i, j) in [(0, 1), (1, 2), (2, 0)] {
                let second = self.model.direction(second, unit(j));
                let kind = Kind::Orientation { first: Box::new(frame.clone()), second, vector, i };
                rows.push((kind, Some(T::ZERO), None));
            }
        }
        if let Some(w) = three(rate) {
            let spins = spins(self.model, first, second, w);
            rows.extend(spins.into_iter().map(|(kind, rate)| (kind, None, Some(rate))));
        }
        rows
    }
}

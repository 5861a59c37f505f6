//! Equivalent forms of a scene: rotated as a whole, or with its bodies in another order.

use mbs_core::effects::{Field, Form, SignalForm, Value};
use mbs_core::measure::RollingInput;
use mbs_core::scene::{
    Axis, BodyId, Coupling, CouplingMeasure, CouplingTerm, Dimension, Freedom, Inertia,
    InitialTarget, Joint, Rolling, RollingKind, RollingPlane, Scene,
};

type Vector = [f64; 3];

fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Rotates a vector about a fixed skew axis, by a unit quaternion.
#[must_use]
pub fn turned(x: Vector) -> Vector {
    let (w, u) = (0.3, [-0.5, 0.7, 0.412_310_562_561_766_1]);
    let uv = cross(u, x);
    let twice = |x: Vector, s: f64| x.map(|x| 2.0 * s * x);
    add(x, add(twice(uv, w), twice(cross(u, uv), 1.0)))
}

/// Rotates a vector about z by a fixed angle.
#[must_use]
pub fn turned_in_plane(x: Vector) -> Vector {
    let (c, s) = (0.6, 0.8);
    [c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]]
}

/// Returns a spatial scene that is rotated with all its contents.
#[must_use]
pub fn turn_scene(scene: &Scene<f64>) -> Scene<f64> {
    turn_by(scene, turned)
}

/// Returns the scene with all its contents rotated by `turn`, without outputs.
///
/// # Panics
///
/// If an effect cannot be rotated.
#[must_use]
pub fn turn_by(scene: &Scene<f64>, turn: impl Fn(Vector) -> Vector + Copy) -> Scene<f64> {
    let mut s = scene.clone();
    s.gravity = s.gravity.map(turn);
    for body in &mut s.bodies {
        body.center = turn(body.center);
        match &mut body.inertia {
            Inertia::Spatial([xx, yy, zz, xy, yz, zx]) => {
                let rows = [[*xx, *xy, *zx], [*xy, *yy, *yz], [*zx, *yz, *zz]];
                // R I R^T: rotate the columns, then the rows.
                let columns = rows.map(turn);
                let [a, b, c] =
                    [0, 1, 2].map(|i| turn([columns[0][i], columns[1][i], columns[2][i]]));
                (*xx, *yy, *zz, *xy, *yz, *zx) = (a[0], b[1], c[2], a[1], b[2], c[0]);
            }
            Inertia::Rod { from, to } => (*from, *to) = (turn(*from), turn(*to)),
            Inertia::Planar(_) | Inertia::Point => {}
        }
    }
    for joint in &mut s.joints {
        joint.points = joint.points.map(turn);
        joint.axes = joint.axes.map(|a| a.map(turn));
    }
    for (_, at) in s.couplings.iter_mut().flat_map(points) {
        *at = turn(*at);
    }
    s.rollings.iter_mut().for_each(|rolling| turn_rolling(rolling, scene.dimension, turn));
    for initial in &mut s.initials {
        turn_initial(&mut initial.target, (&scene.joints, scene.dimension), turn);
    }
    for effect in &mut s.effects {
        let row = effect.kind.row();
        assert!(!row.fields.is_empty(), "what a law of a user's own turns with is not known");
        assert!(!row.needs_road, "a road does not turn");
        let turned = |(field, value): (&Field, Value<f64>)| match value {
            Value::Point(x) => Value::Point(turn(x)),
            Value::Points(x) => Value::Points(x.map(turn)),
            Value::Line(points) => {
                Value::Line(points.into_iter().map(|(body, x)| (body, turn(x))).collect())
            }
            Value::Axis(x) => Value::Axis(turn(x)),
            Value::MaybeAxis(x) => Value::MaybeAxis(x.map(turn)),
            Value::Terms(mut terms) => {
                terms.iter_mut().for_each(|term| turn_term(term, &turn));
                Value::Terms(terms)
            }
            Value::Six(_) => panic!("the axes of a bushing are global: they do not turn"),
            Value::Signal(_) if field.form != Form::Signal(SignalForm::Scalar) => {
                panic!("signals are not turned here")
            }
            other => other,
        };
        let values: Vec<_> = row.fields.iter().zip(effect.kind.values()).map(turned).collect();
        effect.kind = effect.kind.with(values).expect("values of the same fields");
    }
    s.outputs.clear();
    s
}

fn turn_term(term: &mut CouplingTerm<f64>, turn: &impl Fn(Vector) -> Vector) {
    match &mut term.of {
        CouplingMeasure::Length { points } => points.iter_mut().for_each(|(_, at)| *at = turn(*at)),
        CouplingMeasure::Ball { axis, .. } => *axis = turn(*axis),
        CouplingMeasure::Coordinate { .. } => {}
    }
}

/// Returns the points from which the lengths of a coupling follow.
fn points(coupling: &mut Coupling<f64>) -> impl Iterator<Item = &mut (BodyId, Vector)> {
    coupling.terms.iter_mut().flat_map(points_of)
}

fn points_of(term: &mut CouplingTerm<f64>) -> &mut [(BodyId, Vector)] {
    match &mut term.of {
        CouplingMeasure::Length { points } => points.as_mut_slice(),
        CouplingMeasure::Coordinate { .. } | CouplingMeasure::Ball { .. } => &mut [],
    }
}

fn turn_rolling(rolling: &mut Rolling<f64>, dimension: Dimension, turn: impl Fn(Vector) -> Vector) {
    // a plane without a normal in the scene is horizontal
    let RollingInput { base, plane: [normal, ..], .. } = RollingInput::new(rolling, dimension);
    let level = || RollingPlane { point: base.into(), normal: normal.into() };
    let plane = rolling.plane.get_or_insert_with(level);
    (plane.point, plane.normal) = (turn(plane.point), turn(plane.normal));
    rolling.at = turn(rolling.at);
    match &mut rolling.kind {
        RollingKind::Wheel { axis: x, .. } | RollingKind::Blade { direction: x } => {
            *x = turn(*x);
        }
        RollingKind::Ball { .. } => {}
    }
}

fn turn_initial(
    target: &mut InitialTarget<f64>,
    (joints, dimension): (&[Joint<f64>], Dimension),
    turn: impl Fn(Vector) -> Vector,
) {
    match target {
        InitialTarget::Joint { joint, value, rate } => {
            // Rotation vectors and angular velocities are given in global axes.
            for (number, freedom) in joints[joint.index()].kind.numbered(dimension) {
                // these guides drive slides along the global axes, or a rotation vector
                if [Freedom::Slide(Axis::X), Freedom::Ball].contains(&freedom) {
                    for x in [value.as_mut(), rate.as_mut()].into_iter().flatten() {
                        let three = &mut x[number..number + 3];
                        three.copy_from_slice(&turn([three[0], three[1], three[2]]));
                    }
                }
            }
        }
        InitialTarget::Body { velocity, angular_velocity, .. } => {
            *velocity = velocity.map(|(at, v)| (turn(at), turn(v)));
            *angular_velocity = angular_velocity.as_ref().copied().map(turn);
        }
    }
}

/// Returns the scene with its bodies in reverse order, without outputs.
///
/// # Panics
///
/// If an effect is a user-defined law.
#[must_use]
pub fn reorder(scene: &Scene<f64>) -> Scene<f64> {
    let n = scene.bodies.len();
    let mut s = scene.clone();
    s.bodies.reverse();
    let renumber = |b: &mut BodyId| {
        if let BodyId::Body(i) = b {
            *i = n - 1 - *i;
        }
    };
    s.joints.iter_mut().flat_map(|j| &mut j.bodies).for_each(renumber);
    s.couplings.iter_mut().flat_map(points).for_each(|(body, _)| renumber(body));
    s.rollings.iter_mut().flat_map(|r| [&mut r.body, &mut r.on]).for_each(renumber);
    for initial in &mut s.initials {
        if let InitialTarget::Body { body, .. } = &mut initial.target {
            renumber(body);
        }
    }
    for effect in &mut s.effects {
        let values = effect.kind.values().into_iter().map(|mut value| {
            match &mut value {
                Value::Bodies(bodies) => bodies.iter_mut().for_each(renumber),
                Value::Body(body) => renumber(body),
                Value::Terms(terms) => {
                    terms.iter_mut().flat_map(points_of).for_each(|(body, _)| renumber(body));
                }
                Value::Line(points) => points.iter_mut().for_each(|(body, _)| renumber(body)),
                _ => {}
            }
            value
        });
        effect.kind = effect.kind.with(values).expect("not a law of a user's own");
    }
    s.outputs.clear();
    s
}

/// Converts a point to axes of scenes/spatial-four-bar.toml: two axes in the plane of the linkage, then its normal.
#[must_use]
pub fn in_plane(x: Vector) -> Vector {
    let axes = [[0.424, 0.768, 0.48], [-0.768, 0.024, 0.64], [0.48, -0.64, 0.6]];
    axes.map(|axis: Vector| axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2])
}

/// Returns scenes/spatial-four-bar.toml as a planar scene.
#[must_use]
pub fn flattened(scene: &Scene<f64>) -> Scene<f64> {
    let mut flat = turn_by(scene, in_plane);
    flat.dimension = Dimension::Planar;
    for body in &mut flat.bodies {
        if let Inertia::Spatial([_, _, zz, ..]) = body.inertia {
            body.inertia = Inertia::Planar(zz);
        }
    }
    for joint in &mut flat.joints {
        joint.axes = [None; 2];
        joint.points.iter_mut().for_each(|point| point[2] = 0.0);
    }
    for body in &mut flat.bodies {
        body.center[2] = 0.0;
    }
    flat
}

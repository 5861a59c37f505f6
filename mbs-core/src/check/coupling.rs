//! Checks of couplings: their terms, and whether start values contradict them.

use super::motion::{agreement, check_law};
use crate::Real;
use crate::algebra::{Vector, norm};
use crate::inputs::{CouplingInput, SignalGraph};
use crate::joint::Freedom;
use crate::laws::relation::{self, MAX_ARGUMENTS, Relation, RelationFault};
use crate::measure::TermInput;
use crate::mechanism::{MeshedWheels, Scene, Strands, given_values};
use crate::scene::place::Place;
use crate::scene::{
    BodyId, CouplingKind, CouplingMeasure, CouplingTerm, Curve, Entry, JointId, Mesh, SceneError,
    SceneFault,
};
use alloc::vec::Vec;

pub(super) fn check<T: Real>(scene: &Scene<T>) -> Result<(), SceneError> {
    for (i, coupling) in scene.couplings.iter().enumerate() {
        let place = scene.place(Entry::Coupling(i));
        check_terms(scene, &coupling.terms, place)?;
        let curves = || coupling.terms.iter().filter_map(|term| term.curve.as_ref());
        if curves().any(Curve::has_corners) {
            // a cam has the keys of its curve in its table; other couplings have them in a term
            let is_cam = coupling.kind == CouplingKind::Cam;
            let field = if is_cam { "interpolation" } else { "terms" };
            return place.fault(field, SceneFault::LinearTable);
        }
        let is_ball = |term: &CouplingTerm<T>| matches!(term.of, CouplingMeasure::Ball { .. });
        if coupling.terms.iter().any(is_ball) {
            return place.fault("terms", SceneFault::BallHeld);
        }
        if let Some(relation) = &coupling.relation {
            check_relation(&**relation, &coupling.terms, place)?;
        }
        place.finite("value", coupling.value)?;
        if let Some(motion) = &coupling.motion {
            check_law(motion, place)?;
        }
        if let CouplingKind::Mesh(mesh) = &coupling.kind {
            if coupling.relation.is_some() {
                return place.fault("at", SceneFault::NoMesh);
            }
            check_mesh(scene, &coupling.terms, mesh, place)?;
        }
        if let CouplingKind::Strands { pretension } = coupling.kind {
            place.not_negative("pretension", pretension)?;
            if let Err(fault) = Strands::new(scene, coupling) {
                return place.fault("pretension", SceneFault::NotStrands(fault));
            }
        }
    }
    Ok(())
}

/// Checks a relation: it has at most `MAX_ARGUMENTS` terms, no curves, and correct derivatives in the reference configuration.
fn check_relation<T: Real>(
    relation: &dyn Relation,
    terms: &[CouplingTerm<T>],
    place: Place,
) -> Result<(), SceneError> {
    if terms.len() > MAX_ARGUMENTS {
        let fault = RelationFault::TooMany { found: terms.len() };
        return place.fault("terms", SceneFault::Relation(fault));
    }
    if let Some(term) = terms.iter().position(|term| term.curve.is_some()) {
        return place.fault("terms", SceneFault::Relation(RelationFault::Curve { term }));
    }
    if terms.iter().any(|term| term.factor.is_zero()) {
        return place.fault("terms", SceneFault::NoTerm);
    }
    if T::EPSILON.to_f64() < f64::EPSILON {
        return place.fault("relation", SceneFault::Relation(RelationFault::Doubles));
    }
    let zeros = [0.0; MAX_ARGUMENTS];
    check_derivatives(relation, &zeros[..terms.len()], place)
}

fn check_derivatives(relation: &dyn Relation, at: &[f64], place: Place) -> Result<(), SceneError> {
    match relation::check(relation, at) {
        Ok(()) => Ok(()),
        Err(fault) => place.fault("relation", SceneFault::Relation(fault)),
    }
}

/// Checks that each term measures something that exists, and that at least one factor is not zero.
pub(super) fn check_terms<T: Real>(
    scene: &Scene<T>,
    terms: &[CouplingTerm<T>],
    place: Place,
) -> Result<(), SceneError> {
    for CouplingTerm { factor, of, curve } in terms {
        place.finite("factor", *factor)?;
        check_measure(scene, of, place)?;
        if let Some(curve) = curve {
            check_curve(curve, place)?;
        }
    }
    if terms.iter().all(|term| term.factor.is_zero()) {
        return place.fault("terms", SceneFault::NoTerm);
    }
    Ok(())
}

/// Checks that the scene has the measured coordinate, length or angle.
pub(super) fn check_measure<T: Real>(
    scene: &Scene<T>,
    of: &CouplingMeasure<T>,
    place: Place,
) -> Result<(), SceneError> {
    match of {
        CouplingMeasure::Coordinate { joint, number } => {
            check_measured(scene, (*joint, *number), place)
        }
        CouplingMeasure::Length { points } => check_points(scene, points, place),
        CouplingMeasure::Ball { joint, axis, .. } => {
            let Some(joint) = scene.joints.get(joint.index()) else {
                return place.fault("joint", SceneFault::UnknownReference);
            };
            if !joint.freedoms(scene.dimension).contains(&Freedom::Ball) {
                return place.fault("coordinate", SceneFault::NoBall);
            }
            place.axis("axis", *axis)
        }
    }
}

/// Checks that the pitch point lies where the teeth of both wheels give the torques of the factors.
fn check_mesh<T: Real>(
    scene: &Scene<T>,
    terms: &[CouplingTerm<T>],
    mesh: &Mesh<T>,
    place: Place,
) -> Result<(), SceneError> {
    /// Distance of a pitch point from its correct place, relative to the distance of the axes [-]. Chosen, not tuned: numbers in files are rounded.
    const OFF: f64 = 1e-6;
    place.vector("at", mesh.at)?;
    let angle = mesh.pressure_angle.to_f64();
    if !(0.0..core::f64::consts::FRAC_PI_2).contains(&angle) {
        return place.fault("pressure_angle", SceneFault::PressureAngle(angle));
    }
    let Some(wheels) = MeshedWheels::new(scene, terms) else {
        return place.fault("at", SceneFault::NoMesh);
    };
    let pitch = wheels.pitch_point(&Vector::from(mesh.at));
    let off = norm(&(pitch - Vector::from(mesh.at)));
    if !off.is_finite() {
        return place.fault("at", SceneFault::NoMesh);
    }
    if off > wheels.distance() * T::from_f64(OFF) {
        let pitch: [T; 3] = pitch.into();
        return place.fault("at", SceneFault::OffPitch(pitch.map(T::to_f64)));
    }
    Ok(())
}

fn check_points<T: Real>(
    scene: &Scene<T>,
    points: &[(BodyId, [T; 3])],
    place: Place,
) -> Result<(), SceneError> {
    if points.len() < 2 {
        return place.fault("points", SceneFault::WrongCount { needed: 2, found: points.len() });
    }
    for (body, at) in points {
        if body.index().is_some_and(|body| body >= scene.bodies.len()) {
            return place.fault("points", SceneFault::UnknownReference);
        }
        place.vector("points", *at)?;
    }
    if points.windows(2).any(|pair| pair[0].1 == pair[1].1) {
        return place.fault("points", SceneFault::CoincidentPoints);
    }
    Ok(())
}

/// Checks a line over points of at least two bodies.
pub(super) fn check_line<T: Real>(
    scene: &Scene<T>,
    points: &[(BodyId, [T; 3])],
    place: Place,
) -> Result<(), SceneError> {
    check_points(scene, points, place)?;
    if points.windows(2).all(|pair| pair[0].0 == pair[1].0) {
        return place.fault("points", SceneFault::SameBody);
    }
    Ok(())
}

pub(super) fn check_curve<T: Real>(curve: &Curve<T>, place: Place) -> Result<(), SceneError> {
    let rows = match curve {
        Curve::Polynomial(coefficients) => {
            if coefficients.is_empty() {
                return place.fault("coefficients", SceneFault::Missing);
            }
            return coefficients.iter().try_for_each(|x| place.finite("coefficients", *x));
        }
        Curve::Table(rows) | Curve::Periodic(rows) | Curve::Shaped { rows, .. } => rows,
    };
    let is_periodic = matches!(curve, Curve::Periodic(_) | Curve::Shaped { periodic: true, .. });
    let needed = if is_periodic { 3 } else { 2 };
    if rows.len() < needed {
        return place.fault("table", SceneFault::WrongCount { needed, found: rows.len() });
    }
    rows.iter().flatten().try_for_each(|x| place.finite("table", *x))?;
    if let Some(i) = rows.windows(2).position(|pair| pair[1][0] <= pair[0][0]) {
        return place.fault("table", SceneFault::PointOrder(i + 1));
    }
    if let (true, [first, .., last]) = (is_periodic, &rows[..])
        && first[1] != last[1]
    {
        let ends = [first[1], last[1]].map(T::to_f64);
        return place.fault("table", SceneFault::PeriodicEnds(ends));
    }
    Ok(())
}

/// Checks a measured coordinate, which must be a single number, by its joint and its number.
pub(super) fn check_measured<T>(
    scene: &Scene<T>,
    (joint, number): (JointId, usize),
    place: Place,
) -> Result<(), SceneError> {
    let Some(joint) = scene.joints.get(joint.index()) else {
        return place.fault("joint", SceneFault::UnknownReference);
    };
    let n = joint.kind.n_coordinates(scene.dimension);
    if n == 0 {
        return place.fault("joint", SceneFault::NoCoordinate);
    }
    if number >= n {
        return place.fault("coordinate", SceneFault::UnknownCoordinate(n));
    }
    if joint.kind.freedom(scene.dimension, number).is_none() {
        return place.fault("coordinate", SceneFault::BallCoordinate);
    }
    Ok(())
}

/// Checks the sum at the start of each coupling whose coordinates all have start values.
pub(super) fn check_starts<T: Real>(scene: &Scene<T>) -> Result<(), SceneError> {
    if scene.couplings.is_empty() {
        return Ok(());
    }
    let given = given_values(scene);
    let signals = SignalGraph::new(&scene.signals).values(T::ZERO);
    for (i, coupling) in scene.couplings.iter().enumerate() {
        let input = CouplingInput::new(coupling);
        let value = |term: &TermInput<T>| {
            let (joint, number) = term.coordinate?;
            given[joint].get(number).copied().flatten()
        };
        let Some(values) = input.terms.iter().map(value).collect::<Option<Vec<_>>>() else {
            continue;
        };
        let place = scene.place(Entry::Coupling(i));
        if let Some(relation) = &coupling.relation {
            let at = |(term, &value): (&TermInput<T>, &T)| (term.factor * value).to_f64();
            let at: Vec<f64> = input.terms.iter().zip(&values).map(at).collect();
            check_derivatives(&**relation, &at, place)?;
        }
        let [sum, size] = input.value_at(&values);
        let needed = input.sum_at(T::ZERO, &signals);
        if !((sum - needed).abs() <= agreement::<T>() * size.max(T::ONE)) {
            let numbers = [sum, needed].map(T::to_f64);
            return place.fault("value", SceneFault::SumAtStart(numbers));
        }
    }
    Ok(())
}

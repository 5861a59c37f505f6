//! The sum of a coupling at a state, and the wrenches of the coupling on bodies.
//!
//! ```text
//! sum    = sum_k c_k f_k(m_k),   its rate sum_k c_k f_k' m_k'
//! effort = lambda:  a term acts with w = c_k f_k' lambda;  the term of a relation phi(c_1 m_1, ...) acts with w = c_k phi_k lambda
//! angle    moment w g on the second body, -w g on the first:  g.a = 1 with the angle's axis a, g.b = 0 with a second axis b
//! slide    force w d at the joint's point on the second body, -w d on the first body at this point;  d the slide's direction
//! ball     moment w g on the second body, -w g on the first:  g of a swing or a twist
//! length   force w n on the second point, -w n on the first:  n the unit vector from the first to the second
//! ```
//!
//! c_k are factors, f_k curves, m_k measures. lambda is the effort. phi_k is the derivative of the relation by its argument k. For wheels
//! with a pitch point the force of the teeth replaces the moments. For a belt with a pretension the forces of its strands replace the
//! moments.

use super::coordinate::Coordinate;
use super::drawn_force::DrawnForce;
use super::strand_force::StrandForce;
use super::tooth_force::ToothForce;
use super::wrench::{Applied, Wrench};
use crate::Real;
use crate::algebra::{Vector, along as unit_along, cross, norm, raised};
use crate::elements::{ball, ball_directions};
use crate::inputs::CouplingInput;
use crate::joint::Dimension;
use crate::laws::code::Code;
use crate::laws::relation::Relation;
use crate::measure::{Arguments, PreparedCurve, TermInput};
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::{Affine, NaturalModel, unwrap};
use crate::scene::{BallAngle, BodyId, CouplingMeasure, transverse};
use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;

/// The sum of a coupling, or the sum of an effect.
#[derive(Debug, Clone)]
pub(super) struct CoupledSum<T: Real, const D: usize> {
    terms: Vec<SumTerm<T, D>>,
    /// Relation of the terms; `None`: the coupling is their sum.
    relation: Option<Code<dyn Relation>>,
    /// Moving bodies on which the coupling acts, in ascending order.
    bodies: Vec<usize>,
    /// Largest force that a term without a curve exerts for an effort of one. A moment is divided by the scene's length.
    scale: T,
    /// Force of the teeth, which replaces the moments of the terms if the wheels have a pitch point.
    teeth: Option<Box<ToothForce<T, D>>>,
    /// Forces of the strands, which replace the moments of the terms if the belt has a pretension.
    strands: Option<Box<StrandForce<T, D>>>,
    /// Force of a thread or drum. It replaces the forces of the terms if it acts at another point.
    drawn: Option<Box<DrawnForce<T, D>>>,
}

/// Term of a sum: a factor, a curve, and the measures whose sum is the argument of the curve.
#[derive(Debug, Clone)]
struct SumTerm<T: Real, const D: usize> {
    factor: T,
    curve: PreparedCurve<T>,
    parts: Vec<Part<T, D>>,
}

/// Measure between two bodies: a coordinate, a length, or an angle of a ball.
#[derive(Debug, Clone)]
pub(super) struct Part<T: Real, const D: usize> {
    bodies: [BodyId; 2],
    of: PartKind<T, D>,
}

#[derive(Debug, Clone)]
enum PartKind<T: Real, const D: usize> {
    /// Coordinate of a joint, with the joint's point on the second body. `memory` is for an angle that the state remembers: its index in
    /// the memory of the state, and its sign there.
    Coordinate { of: Coordinate<T, D>, at: Affine<T, D>, memory: Option<(usize, T)> },
    /// Distance of two points minus their distance in the reference configuration.
    Length { points: [Affine<T, D>; 2], reference: T },
    /// Swing of a ball: the angle between a direction of the first body and one of the second.
    Swing { axes: [Affine<T, D>; 2] },
    /// Twist of a ball: two directions perpendicular to its axis in each body, and the index of the angle in the memory of the state.
    Twist { across: Box<[[Affine<T, D>; 2]; 2]>, memory: Option<usize> },
}

impl<T: Real, const D: usize> CoupledSum<T, D> {
    /// Sum of `scene.couplings[index]` in a checked scene.
    pub(super) fn new(scene: &Scene<T>, model: &NaturalModel<T, D>, index: usize) -> Self {
        let coupling = &scene.couplings[index];
        let input = CouplingInput::new(coupling);
        let mut sum = Self::of_terms((scene, model), &input.terms, None);
        if input.relation.is_some() {
            let slopes = (0..input.terms.len()).map(|k| input.reference_slope(k));
            let forces = sum.terms.iter().zip(slopes).map(|(term, slope)| term.force(slope, model));
            sum.scale = forces.fold(T::ZERO, T::max);
            sum.relation = input.relation;
        }
        sum.teeth = ToothForce::new(scene, model, coupling).map(Box::new);
        sum.strands = StrandForce::new(scene, model, coupling).map(Box::new);
        sum.drawn = DrawnForce::new(scene, model, coupling).map(Box::new);
        sum
    }

    /// Sum of these terms. `remembered` is the index of their first angle in the memory of the state.
    pub(super) fn of_terms(
        (scene, model): (&Scene<T>, &NaturalModel<T, D>),
        terms: &[TermInput<T>],
        mut remembered: Option<usize>,
    ) -> Self {
        let (mut bodies, mut scale) = (Vec::new(), T::ZERO);
        let terms = terms.iter().map(|term| {
            let parts = Part::of_term((scene, model), term, remembered);
            let angles = parts.iter().filter(|part| part.is_remembered()).count();
            remembered = remembered.map(|first| first + angles);
            bodies.extend(parts.iter().flat_map(|part| part.bodies).filter_map(BodyId::index));
            let of = SumTerm { factor: term.factor, curve: term.curve.clone(), parts };
            scale = scale.max(of.force(term.factor, model));
            of
        });
        let terms = terms.collect();
        bodies.sort_unstable();
        bodies.dedup();
        Self { terms, relation: None, bodies, scale, teeth: None, strands: None, drawn: None }
    }

    /// True if the sum is an angle: no term is a slide or a length.
    pub(super) fn is_angle(&self) -> bool {
        self.terms.iter().flat_map(|term| &term.parts).all(Part::is_angle)
    }

    /// Passes to `take` the wrenches that load bearings, but do not change the motion. They are the forces that push teeth apart at this
    /// `effort`, and the pretension of strands.
    pub(super) fn load_bearings(
        &self,
        effort: T,
        state: &State<T>,
        take: &mut dyn FnMut(Applied<T>),
    ) {
        if let Some(teeth) = &self.teeth {
            teeth.drive_apart(effort, state, take);
        } else if let Some(strands) = &self.strands {
            strands.draw_together(state, take);
        }
    }

    /// Moving bodies on which the coupling acts, in ascending order.
    pub(super) fn bodies(&self) -> &[usize] {
        &self.bodies
    }

    /// Factor from an effort to a typical force.
    pub(super) fn scale(&self) -> T {
        self.scale
    }

    /// The sum and its rate. Angles continue from the values that the state remembers.
    pub(super) fn measure(&self, state: &State<T>) -> [T; 2] {
        if self.relation.is_some() {
            let (value, arguments) = self.related(state);
            let terms = self.terms.iter().enumerate();
            let rates =
                terms.map(|(k, term)| arguments.slope(k) * term.factor * term.evaluate(state).1);
            return [value, rates.fold(T::ZERO, |sum, rate| sum + rate)];
        }
        self.terms.iter().fold([T::ZERO; 2], |[sum, rate], term| {
            let ([value, slope], m_t) = term.evaluate(state);
            [sum + term.factor * value, rate + term.factor * slope * m_t]
        })
    }

    /// Total length of all lines of the coupling [m].
    pub(super) fn length(&self, state: &State<T>) -> T {
        let lines =
            self.terms.iter().flat_map(|term| &term.parts).filter_map(|part| match &part.of {
                PartKind::Length { points, .. } => Some(along(points, state).1),
                _ => None,
            });
        lines.fold(T::ZERO, |sum, length| sum + length)
    }

    /// Passes to `take` the wrenches on bodies at an effort.
    pub(super) fn apply(&self, effort: T, state: &State<T>, take: &mut dyn FnMut(Applied<T>)) {
        if let Some(teeth) = &self.teeth {
            return teeth.apply(effort, state, take);
        }
        if let Some(strands) = &self.strands {
            return strands.apply(effort, state, take);
        }
        if let Some(drawn) = &self.drawn {
            let (mut end, mut about) = (0, T::ZERO);
            if let Some(weight) = drawn.on_line(effort) {
                let line = &self.terms[0].parts;
                for part in line {
                    part.apply(weight, state, &mut |applied| {
                        let ends = (end, 2 * line.len());
                        take(drawn.moved(ends, applied, (state, &mut about)));
                        end += 1;
                    });
                }
            }
            return drawn.apply((effort, about), state, take);
        }
        let related = self.relation.is_some().then(|| self.related(state).1);
        for (k, term) in self.terms.iter().enumerate() {
            let slope = match &related {
                Some(arguments) => arguments.slope(k),
                None => term.evaluate(state).0[1],
            };
            let weight = term.factor * slope * effort;
            term.parts.iter().for_each(|part| part.apply(weight, state, take));
        }
    }

    /// Value of the relation, zero without a relation, and its derivatives.
    fn related(&self, state: &State<T>) -> (T, Arguments<T>) {
        let mut arguments = Arguments::default();
        for term in &self.terms {
            arguments.push([term.factor * term.evaluate(state).0[0], T::ZERO], T::ZERO);
        }
        let value = self.relation.as_ref().map(|relation| arguments.evaluate(&**relation));
        (value.unwrap_or(T::ZERO), arguments)
    }
}

impl<T: Real, const D: usize> SumTerm<T, D> {
    /// Force of the term for an effort of one; a moment is divided by the scene's length. `slope` is the derivative of the sum by the
    /// measure.
    fn force(&self, slope: T, model: &NaturalModel<T, D>) -> T {
        let is_angle = self.parts.iter().any(Part::is_angle);
        slope.abs() / if is_angle { model.length() } else { T::ONE }
    }

    /// Value f(m), slope f'(m) and the rate of the measure m.
    fn evaluate(&self, state: &State<T>) -> ([T; 2], T) {
        let (mut m, mut m_t) = (T::ZERO, T::ZERO);
        for part in &self.parts {
            let [value, rate] = part.measure(state);
            (m, m_t) = (m + value, m_t + rate);
        }
        let [value, slope, _] = self.curve.at(m);
        ([value, slope], m_t)
    }
}

impl<T: Real, const D: usize> Part<T, D> {
    fn of_term(
        (scene, model): (&Scene<T>, &NaturalModel<T, D>),
        term: &TermInput<T>,
        memory: Option<usize>,
    ) -> Vec<Self> {
        match (&term.of, term.coordinate) {
            (CouplingMeasure::Length { points }, _) => {
                let parts = points.windows(2).map(|pair| {
                    let reference = term.reference_of(&[pair[0].1, pair[1].1]);
                    let points = [0, 1].map(|k| model.point(pair[k].0, pair[k].1));
                    let of = PartKind::Length { points, reference };
                    Self { bodies: [pair[0].0, pair[1].0], of }
                });
                parts.collect()
            }
            (CouplingMeasure::Coordinate { .. }, Some(of)) => {
                Self::of_coordinate(scene, model, of).into_iter().collect()
            }
            (CouplingMeasure::Ball { joint, angle, axis }, _) => {
                let bodies = scene.joints[joint.index()].bodies;
                let axis = unit_along(&Vector::from(*axis));
                let direction = |body, d: Vector<T, 3>| model.direction(body, d.into());
                let of = match angle {
                    BallAngle::Swing => {
                        PartKind::Swing { axes: bodies.map(|body| direction(body, axis)) }
                    }
                    BallAngle::Twist => {
                        let across = transverse(&axis, Dimension::Spatial);
                        let across = bodies.map(|body| across.map(|d| direction(body, d)));
                        PartKind::Twist { across: Box::new(across), memory }
                    }
                };
                vec![Self { bodies, of }]
            }
            (CouplingMeasure::Coordinate { .. }, None) => Vec::new(),
        }
    }

    /// Measure of a joint's coordinate by its number; `None` for a component of a rotation vector.
    pub(super) fn of_coordinate(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
        of: (usize, usize),
    ) -> Option<Self> {
        let joint = &scene.joints[of.0];
        let freedom = joint.kind.freedom(scene.dimension, of.1)?;
        let memory = model.coupled_angles().find(|angle| angle.0 == of);
        let of = PartKind::Coordinate {
            of: Coordinate::of_freedom(scene, model, (joint, freedom)),
            at: model.point(joint.bodies[1], joint.points[1]),
            memory: memory.map(|(_, sign, place)| (place, sign)),
        };
        Some(Self { bodies: joint.bodies, of })
    }

    fn is_angle(&self) -> bool {
        match &self.of {
            PartKind::Coordinate { of, .. } => of.is_angle(),
            PartKind::Length { .. } => false,
            PartKind::Swing { .. } | PartKind::Twist { .. } => true,
        }
    }

    /// True if the state remembers the measure.
    fn is_remembered(&self) -> bool {
        self.is_angle() && !matches!(self.of, PartKind::Swing { .. })
    }

    /// Value and rate of the measure at a state.
    pub(super) fn measure(&self, state: &State<T>) -> [T; 2] {
        match &self.of {
            PartKind::Coordinate { of, memory, .. } => {
                let last = memory.map_or(T::ZERO, |(place, sign)| sign * state.memory[place]);
                let (mut value, mut rate) = ([T::ZERO], [T::ZERO]);
                of.track(&state.q, &[last], &mut value);
                of.rates(&state.q, &state.v, &mut rate);
                [value[0], rate[0]]
            }
            PartKind::Length { points, reference } => {
                let (line, length, _) = along(points, state);
                let [from, to] = [0, 1].map(|i| points[i].rate(&state.v));
                [length - *reference, line.dot(&raised(&(to - from)))]
            }
            PartKind::Swing { axes: [a, b] } => {
                let pair = [a.value(&state.q), b.value(&state.q)];
                let rates = [a.rate(&state.v), b.rate(&state.v)];
                [ball::swing(&pair), ball::swing_rates(&pair, &rates)[0]]
            }
            PartKind::Twist { across, memory } => {
                let at = |k: usize| [0, 1].map(|i| across[k][i].value(&state.q));
                let moving = |k: usize| [0, 1].map(|i| across[k][i].rate(&state.v));
                let (first, second) = (at(0), at(1));
                let [c, s] = ball::twist_parts(&first, &second);
                let last = memory.map_or(T::ZERO, |place| state.memory[place]);
                let rates = ball::twist_rates((&first, &second), (&moving(0), &moving(1)));
                [unwrap(s.atan2(c), last), rates[0]]
            }
        }
    }

    /// Passes to `take` the two wrenches whose power is `weight` times the rate of the measure.
    pub(super) fn apply(&self, weight: T, state: &State<T>, take: &mut dyn FnMut(Applied<T>)) {
        let [first, second] = self.bodies;
        let turning =
            |g: Vector<T, 3>| (Wrench { force: Vector::zeros(), moment: g * weight }, [None; 2]);
        let (wrench, places) = match &self.of {
            PartKind::Coordinate { of, at, .. } => {
                (of.direction(&state.q).scaled(weight), [Some(raised(&at.value(&state.q))); 2])
            }
            PartKind::Length { points, .. } => {
                let (line, _, places) = along(points, state);
                (Wrench { force: line * weight, moment: Vector::zeros() }, places.map(Some))
            }
            PartKind::Swing { axes } => {
                let [a, b] = [0, 1].map(|i| raised(&axes[i].value(&state.q)));
                turning(ball_directions(&a, &b)[0])
            }
            PartKind::Twist { across, .. } => {
                let axis = |k: usize| {
                    let [x, y] = [0, 1].map(|i| raised(&across[k][i].value(&state.q)));
                    cross(&x, &y)
                };
                turning(ball_directions(&axis(0), &axis(1))[1])
            }
        };
        take((first, places[0], wrench.scaled(-T::ONE)));
        take((second, places[1], wrench));
    }
}

/// Unit vector from the first point to the second, their distance and their positions. The vector is zero if the points coincide.
fn along<T: Real, const D: usize>(
    points: &[Affine<T, D>; 2],
    state: &State<T>,
) -> (Vector<T, 3>, T, [Vector<T, 3>; 2]) {
    let [from, to] = [0, 1].map(|i| raised(&points[i].value(&state.q)));
    let length = norm(&(to - from));
    let inverse = if length > T::ZERO { T::ONE / length } else { T::ZERO };
    ((to - from) * inverse, length, [from, to])
}

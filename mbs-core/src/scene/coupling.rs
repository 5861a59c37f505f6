//! Couplings: constraints between joint coordinates and lengths, such as gears, racks, screws, belts, cams and ropes.
//!
//! ```text
//! sum_k c_k m_k(q) = value + f(t)          m_k: a joint coordinate, unwrapped, or a length; or a curve of either
//! ```
//!
//! Every kind of coupling is such a sum, and the constructors below write it. A [relation](Coupling::relation) in code constrains
//! any other function of the measured numbers. Coordinates and lengths are relative to the reference configuration.

use crate::Real;
use crate::laws::code::Code;
use crate::laws::relation::Relation;
use crate::scene::{
    BodyId, CouplingMeasure, CouplingTerm, Curve, Drawn, DrawnKind, JointId, Motion, Number,
    Vector3,
};
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

/// Value of 2 pi, with more digits than any precision has.
const TWO_PI: &str = "6.28318530717958647692528676655900576839433879875021";

/// Constraint between joint coordinates and lengths.
#[derive(Debug, Clone, PartialEq)]
pub struct Coupling<T> {
    /// Unique name among the couplings.
    pub name: String,
    /// Terms of the sum, at least one.
    pub terms: Vec<CouplingTerm<T>>,
    /// User-defined function of the terms, which is constrained in place of their sum; only in scenes built in code.
    pub relation: Option<Code<dyn Relation>>,
    /// Required value of the sum. The sum is zero in the reference configuration [unit of a factor times its coordinate].
    pub value: T,
    /// Function of time that is added to the value.
    pub motion: Option<Motion<T>>,
    /// Kind of machine element that enforces the sum.
    pub kind: CouplingKind<T>,
    /// Drawn coupling, whose sum follows from places and axes when the scene is [resolved](crate::scene::Scene::resolve). `None`:
    /// the sum is used as it is written.
    pub drawn: Option<Drawn>,
}

/// Kind of machine element that enforces the sum of a coupling. The motion does not depend on the kind. Reactions and the notes of
/// a run depend on it.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum CouplingKind<T> {
    /// Any element, which acts along the coordinates and lengths of the coupling.
    #[default]
    General,
    /// Gear teeth in mesh. The bearings of both wheels carry the tooth force.
    Mesh(Mesh<T>),
    /// Rope, which cannot push. A run notes the times at which the constraint would need a push.
    Rope,
    /// Belt with two strands. The bearings of both wheels carry the forces of the strands.
    Strands {
        /// Force of each strand where the belt transmits no torque [N].
        pretension: T,
    },
    /// Cam, which cannot pull its follower. A run notes the times at which the constraint would need a pull. The terms are the
    /// follower and the curve of the shaft.
    Cam,
}

/// Mesh of two wheels with straight teeth.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh<T> {
    /// Pitch point, fixed in the body that carries both wheels, in the reference configuration [m].
    pub at: [T; 3],
    /// Angle between the tooth force and the common tangent of the wheels, at least 0 and below pi/2 [rad].
    pub pressure_angle: T,
}

impl<T> Coupling<T> {
    /// Coupling of any terms, whose sum is `value`; without a name.
    #[must_use]
    pub const fn sum(terms: Vec<CouplingTerm<T>>, value: T) -> Self {
        Self {
            name: String::new(),
            terms,
            relation: None,
            value,
            motion: None,
            kind: CouplingKind::General,
            drawn: None,
        }
    }

    /// First term that is a length; `None` if there is none.
    #[must_use]
    pub fn line(&self) -> Option<&CouplingTerm<T>> {
        self.terms.iter().find(|term| matches!(term.of, CouplingMeasure::Length { .. }))
    }

    /// True if the sum of the coupling changes with time.
    #[must_use]
    pub const fn is_driven(&self) -> bool {
        self.motion.is_some()
    }

    /// Ratio of the named effort to the generalised force on the sum; one if no effort is named. The effort of a gear or
    /// differential is the torque on the first wheel [N m]. The effort of a belt is the difference of its strands [N]. For a rack
    /// or screw it is the force along the slide [N], for a rope its tension [N].
    #[must_use]
    pub fn effort_factor(&self) -> T
    where
        T: Real,
    {
        let of = |k: usize| self.terms.get(k).map_or(T::ONE, |term| term.factor);
        if self.kind == CouplingKind::Rope {
            return -self.line().map_or(T::ONE, |line| line.factor);
        }
        match self.drawn.map(|drawn| drawn.kind) {
            Some(DrawnKind::Gear { .. } | DrawnKind::Differential | DrawnKind::Screw) => of(0),
            Some(DrawnKind::Ratio) => of(1),
            Some(DrawnKind::Belt { .. } | DrawnKind::Rack) | None => T::ONE,
        }
    }

    /// Index of the term whose coordinate the named effort acts on; `None`: the effort acts on the whole sum.
    #[must_use]
    pub fn named_term(&self) -> Option<usize> {
        let drawn = self.drawn.filter(|_| !self.is_driven())?;
        Some(usize::from(drawn.kind == DrawnKind::Ratio))
    }

    /// True if the sum is not always zero. It then has a place after the [guides](crate::inputs::Prescribed::guides).
    #[must_use]
    pub fn has_sum(&self) -> bool
    where
        T: Real,
    {
        self.is_driven() || !self.value.is_zero()
    }
}

impl Coupling<Number> {
    /// Coupling of joint coordinates: the sum of `factor` times the first coordinate of each joint is zero.
    #[must_use]
    pub fn linear(terms: impl IntoIterator<Item = (JointId, f64)>) -> Self {
        let term = |(joint, factor)| CouplingTerm::of_joint(joint, 0, factor);
        Self::of(terms.into_iter().map(term).collect())
    }

    /// Coupling of any terms, whose sum is zero.
    #[must_use]
    pub const fn of(terms: Vec<CouplingTerm<Number>>) -> Self {
        Self::sum(terms, Number::ZERO)
    }

    /// User-defined relation of measured numbers, whose value is zero. A joint means its first coordinate.
    ///
    /// Measured numbers are relative to the reference configuration. The value can be [constant](Self::holding) or a [function of
    /// time](Self::driven). A relation is code, which scene files cannot contain.
    #[must_use]
    pub fn relation<M: Into<CouplingMeasure<Number>>>(
        measures: impl IntoIterator<Item = M>,
        relation: impl Relation + 'static,
    ) -> Self {
        let term = |of: M| CouplingTerm { factor: 1.into(), of: of.into(), curve: None };
        let relation = Some(relation.into());
        Self { relation, ..Self::of(measures.into_iter().map(term).collect()) }
    }

    /// Two wheels in external mesh about parallel axes: `teeth[0]` times the first angle plus `teeth[1]` times the second is zero.
    #[must_use]
    pub fn gear(joints: [JointId; 2], teeth: [u32; 2]) -> Self {
        let [first, second] = teeth.map(f64::from);
        Self::linear([(joints[0], first), (joints[1], second)])
            .drawn(DrawnKind::Gear { is_internal: false, has_radii: false })
    }

    /// Wheel inside a ring gear, about axes of the same sense. Both turn in the same sense, with `teeth[0]` turns of the second for
    /// `teeth[1]` turns of the first.
    #[must_use]
    pub fn internal_gear(joints: [JointId; 2], teeth: [u32; 2]) -> Self {
        let [first, second] = teeth.map(f64::from);
        Self::linear([(joints[0], first), (joints[1], -second)])
            .drawn(DrawnKind::Gear { is_internal: true, has_radii: false })
    }

    /// Belt over two wheels of these radii [m], about axes of the same sense. Both wheels turn in the same sense.
    #[must_use]
    pub fn belt(joints: [JointId; 2], radii: [f64; 2]) -> Self {
        Self::linear([(joints[0], radii[0]), (joints[1], -radii[1])])
            .drawn(DrawnKind::Belt { is_crossed: false })
    }

    /// Crossed belt over two wheels of these radii [m]. The wheels turn in opposite senses.
    #[must_use]
    pub fn crossed_belt(joints: [JointId; 2], radii: [f64; 2]) -> Self {
        Self::linear([(joints[0], radii[0]), (joints[1], radii[1])])
            .drawn(DrawnKind::Belt { is_crossed: true })
    }

    /// Screw in a cylindrical joint. It slides by `lead` in one turn [m].
    #[must_use]
    pub fn screw(joint: JointId, lead: f64) -> Self {
        Self::screw_of((joint, 1), (joint, 0), lead)
    }

    /// Screw that turns in the first joint and moves the slide of the second joint by `lead` in one turn [m].
    #[must_use]
    pub fn screw_between([turn, slide]: [JointId; 2], lead: f64) -> Self {
        Self::screw_of((turn, 0), (slide, 0), lead)
    }

    /// Screw between a turn a and a slide s, given by joint and coordinate number: 2 pi s - lead a = 0.
    fn screw_of(turn: (JointId, usize), slide: (JointId, usize), lead: f64) -> Self {
        let per_turn = Number::from_decimal(TWO_PI).unwrap_or(Number::ZERO);
        Self::of(vec![
            CouplingTerm::of_joint(slide.0, slide.1, per_turn),
            CouplingTerm::of_joint(turn.0, turn.1, -lead),
        ])
        .drawn(DrawnKind::Screw)
    }

    /// Coupling in which the first joint's coordinate is `factor` times the second's.
    #[must_use]
    pub fn mimic([joint, of]: [JointId; 2], factor: f64) -> Self {
        Self::linear([(joint, 1.0), (of, -factor)])
    }

    /// Differential with two wheels, angles a and b, and the carrier of the planet wheels, angle c: Na (a - c) + Nb (b - c) = 0.
    #[must_use]
    pub fn differential([a, b, cage]: [JointId; 3], teeth: [u32; 2]) -> Self {
        let [of_a, of_b] = teeth.map(f64::from);
        Self::linear([(a, of_a), (b, of_b), (cage, -(of_a + of_b))]).drawn(DrawnKind::Differential)
    }

    /// Line of constant length through points of bodies [m], without friction. The constraint can pull and push.
    #[must_use]
    pub fn rope<P: Into<Vector3>>(points: impl IntoIterator<Item = (BodyId, P)>) -> Self {
        let of = CouplingMeasure::line(points);
        let terms = vec![CouplingTerm { factor: 1.into(), of, curve: None }];
        Self { kind: CouplingKind::Rope, ..Self::of(terms) }
    }

    /// Adds to a rope a drum of this radius [m], which winds up the rope as its joint turns.
    #[must_use]
    pub fn with_drum(mut self, joint: JointId, radius: f64) -> Self {
        self.terms.push(CouplingTerm::of_joint(joint, 0, radius));
        self
    }

    /// Rack and pinion: the slide of the second joint is `radius` [m] times the angle of the first.
    #[must_use]
    pub fn rack([pinion, rack]: [JointId; 2], radius: f64) -> Self {
        Self::linear([(rack, 1.0), (pinion, -radius)]).drawn(DrawnKind::Rack)
    }

    /// Cam: the second joint's coordinate is a curve of the first joint's coordinate.
    #[must_use]
    pub fn cam([shaft, follower]: [JointId; 2], curve: Curve<Number>) -> Self {
        let of_shaft =
            CouplingTerm { curve: Some(curve), ..CouplingTerm::of_joint(shaft, 0, -1.0) };
        let terms = vec![CouplingTerm::of_joint(follower, 0, 1.0), of_shaft];
        Self { kind: CouplingKind::Cam, ..Self::of(terms) }
    }

    /// Makes two wheels mesh at a pitch point [m] with a pressure angle [rad]. Their bearings then carry the tooth force.
    #[must_use]
    pub fn meshing_at(mut self, at: impl Into<Vector3>, pressure_angle: impl Into<Number>) -> Self {
        let pressure_angle = pressure_angle.into();
        self.kind = CouplingKind::Mesh(Mesh { at: at.into().0, pressure_angle });
        self
    }

    /// Gives a belt strands with this pretension [N]. The bearings of its wheels then carry the forces of the strands.
    #[must_use]
    pub fn tightened(mut self, pretension: impl Into<Number>) -> Self {
        self.kind = CouplingKind::Strands { pretension: pretension.into() };
        self
    }

    fn drawn(mut self, kind: DrawnKind) -> Self {
        self.drawn = Some(kind.drawn());
        self
    }

    /// Declares that the sum is intended as drawn, so that no run notes a difference from version 0.1.
    #[must_use]
    pub fn as_drawn(mut self) -> Self {
        if let Some(drawn) = &mut self.drawn {
            drawn.is_stated = true;
        }
        self
    }

    /// Sets the sum of the coupling to a constant `value`, relative to the reference configuration.
    #[must_use]
    pub fn holding(mut self, value: impl Into<Number>) -> Self {
        self.value = value.into();
        self
    }

    /// Lets the sum of the coupling follow a function of time, `motion`.
    #[must_use]
    pub fn driven(mut self, motion: impl Into<Motion<Number>>) -> Self {
        self.motion = Some(motion.into());
        self
    }
}

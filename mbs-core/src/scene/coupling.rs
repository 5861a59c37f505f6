//! Couplings: relations of joint coordinates and lengths that hold, such as gears, racks, screws, belts, cams and ropes.
//!
//! ```text
//! sum_k c_k m_k(q) = value + f(t)          m_k: a joint coordinate, unwrapped, or a length; or a curve of one
//! ```
//!
//! Every kind of coupling is such a sum; the constructors below write them. A [relation](Coupling::relation) in code holds any
//! other function of the measures. Coordinates and lengths count from the reference configuration.

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

/// 2 pi to more digits than any precision has.
const TWO_PI: &str = "6.28318530717958647692528676655900576839433879875021";

/// A relation of joint coordinates and lengths that holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Coupling<T> {
    /// Unique name among the couplings.
    pub name: String,
    /// The terms of the sum, at least one.
    pub terms: Vec<CouplingTerm<T>>,
    /// A user-defined function of the terms that is held in place of their sum; in code only.
    pub relation: Option<Code<dyn Relation>>,
    /// Value of the sum, from the reference configuration [unit of a factor times its coordinate].
    pub value: T,
    /// Function of time that is added to the value.
    pub motion: Option<Motion<T>>,
    /// Kind of part that holds the sum.
    pub kind: CouplingKind<T>,
    /// Drawn coupling from which the sum follows when the scene is [resolved](crate::scene::Scene::resolve); `None`: the sum is meant as it is
    /// written.
    pub drawn: Option<Drawn>,
}

/// Kind of part that holds the sum of a coupling. The motion is the same with all; reactions and notes are not.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum CouplingKind<T> {
    /// Any part, which acts along the coordinates and lengths of the coupling.
    #[default]
    General,
    /// Teeth in mesh: the bearings of both wheels carry their force.
    Mesh(Mesh<T>),
    /// A rope, which cannot push: a run notes where this one would have to.
    Rope,
    /// The strands of a belt: the bearings of both wheels carry their pull.
    Strands {
        /// Pull of each strand where the belt passes nothing on [N].
        pretension: T,
    },
    /// A cam, which cannot pull its follower: a run notes where this one would have to. The terms are the follower and the shaft's curve.
    Cam,
}

/// Contact of two wheels with straight teeth.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh<T> {
    /// The pitch point, fixed in the body that carries both wheels, reference configuration [m].
    pub at: [T; 3],
    /// Angle of the force against the common tangent of the wheels; from 0 to below pi/2 [rad].
    pub pressure_angle: T,
}

impl<T> Coupling<T> {
    /// Any terms, whose sum is `value`; without a name.
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

    /// The first of its terms that is a length.
    #[must_use]
    pub fn line(&self) -> Option<&CouplingTerm<T>> {
        self.terms.iter().find(|term| matches!(term.of, CouplingMeasure::Length { .. }))
    }

    /// Does its sum change with time?
    #[must_use]
    pub const fn is_driven(&self) -> bool {
        self.motion.is_some()
    }

    /// Effort of the coupling over the force that its sum takes to change; one where no other effort is named. The effort of a gear and a
    /// differential is the torque on the first wheel [N m]. That of a belt is the difference of its strands [N]. Of a rack and a screw it is
    /// the force along the slide [N], of a rope its tension [N].
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

    /// The place of the term whose rate its effort is named for; `None`: that of the whole sum.
    #[must_use]
    pub fn named_term(&self) -> Option<usize> {
        let drawn = self.drawn.filter(|_| !self.is_driven())?;
        Some(usize::from(drawn.kind == DrawnKind::Ratio))
    }

    /// Is its sum not always zero? It then has a place behind the [guides](crate::inputs::Prescribed::guides).
    #[must_use]
    pub fn has_sum(&self) -> bool
    where
        T: Real,
    {
        self.is_driven() || !self.value.is_zero()
    }
}

impl Coupling<Number> {
    /// The sum of `factor` times a joint's first coordinate is zero.
    #[must_use]
    pub fn linear(terms: impl IntoIterator<Item = (JointId, f64)>) -> Self {
        let term = |(joint, factor)| CouplingTerm::of_joint(joint, 0, factor);
        Self::of(terms.into_iter().map(term).collect())
    }

    /// Any terms, whose sum is zero.
    #[must_use]
    pub const fn of(terms: Vec<CouplingTerm<Number>>) -> Self {
        Self::sum(terms, Number::ZERO)
    }

    /// A user-defined relation of measures, whose value is zero: a joint stands for its first coordinate.
    ///
    /// Measures count from the reference configuration. Another value is [held](Self::holding) or [follows time](Self::driven). It is
    /// code, which no file has.
    #[must_use]
    pub fn relation<M: Into<CouplingMeasure<Number>>>(
        measures: impl IntoIterator<Item = M>,
        relation: impl Relation + 'static,
    ) -> Self {
        let term = |of: M| CouplingTerm { factor: 1.into(), of: of.into(), curve: None };
        let relation = Some(relation.into());
        Self { relation, ..Self::of(measures.into_iter().map(term).collect()) }
    }

    /// Two wheels in external mesh about parallel axes: `teeth[0]` of the first turn against `teeth[1]` of the second.
    #[must_use]
    pub fn gear(joints: [JointId; 2], teeth: [u32; 2]) -> Self {
        let [first, second] = teeth.map(f64::from);
        Self::linear([(joints[0], first), (joints[1], second)])
            .drawn(DrawnKind::Gear { is_internal: false, has_radii: false })
    }

    /// A wheel inside a ring of teeth, about axes of the same sense: both turn alike, `teeth[0]` of the first for `teeth[1]` of the second.
    #[must_use]
    pub fn internal_gear(joints: [JointId; 2], teeth: [u32; 2]) -> Self {
        let [first, second] = teeth.map(f64::from);
        Self::linear([(joints[0], first), (joints[1], -second)])
            .drawn(DrawnKind::Gear { is_internal: true, has_radii: false })
    }

    /// A belt over two wheels of these radii [m] about axes of the same sense, which turn alike.
    #[must_use]
    pub fn belt(joints: [JointId; 2], radii: [f64; 2]) -> Self {
        Self::linear([(joints[0], radii[0]), (joints[1], -radii[1])])
            .drawn(DrawnKind::Belt { is_crossed: false })
    }

    /// A crossed belt: its wheels turn against each other.
    #[must_use]
    pub fn crossed_belt(joints: [JointId; 2], radii: [f64; 2]) -> Self {
        Self::linear([(joints[0], radii[0]), (joints[1], radii[1])])
            .drawn(DrawnKind::Belt { is_crossed: true })
    }

    /// A screw in a cylindrical joint: it slides by `lead` [m] in a turn.
    #[must_use]
    pub fn screw(joint: JointId, lead: f64) -> Self {
        Self::screw_of((joint, 1), (joint, 0), lead)
    }

    /// A screw that turns in its first joint and moves the slide of the second by `lead` [m] in a turn.
    #[must_use]
    pub fn screw_between([turn, slide]: [JointId; 2], lead: f64) -> Self {
        Self::screw_of((turn, 0), (slide, 0), lead)
    }

    /// 2 pi s - lead a = 0, of joint coordinates by number.
    fn screw_of(turn: (JointId, usize), slide: (JointId, usize), lead: f64) -> Self {
        let per_turn = Number::from_decimal(TWO_PI).unwrap_or(Number::ZERO);
        Self::of(vec![
            CouplingTerm::of_joint(slide.0, slide.1, per_turn),
            CouplingTerm::of_joint(turn.0, turn.1, -lead),
        ])
        .drawn(DrawnKind::Screw)
    }

    /// The first joint's coordinate is `factor` times the second's.
    #[must_use]
    pub fn mimic([joint, of]: [JointId; 2], factor: f64) -> Self {
        Self::linear([(joint, 1.0), (of, -factor)])
    }

    /// Two wheels with these teeth, and the carrier of what runs between them: Na (a - c) + Nb (b - c) = 0.
    #[must_use]
    pub fn differential([a, b, cage]: [JointId; 3], teeth: [u32; 2]) -> Self {
        let [of_a, of_b] = teeth.map(f64::from);
        Self::linear([(a, of_a), (b, of_b), (cage, -(of_a + of_b))]).drawn(DrawnKind::Differential)
    }

    /// A line of constant length over points of bodies [m], without friction: it pulls and pushes.
    #[must_use]
    pub fn rope<P: Into<Vector3>>(points: impl IntoIterator<Item = (BodyId, P)>) -> Self {
        let of = CouplingMeasure::line(points);
        let terms = vec![CouplingTerm { factor: 1.into(), of, curve: None }];
        Self { kind: CouplingKind::Rope, ..Self::of(terms) }
    }

    /// Adds to a rope a drum of this radius [m], which takes in as much as its joint turns.
    #[must_use]
    pub fn with_drum(mut self, joint: JointId, radius: f64) -> Self {
        self.terms.push(CouplingTerm::of_joint(joint, 0, radius));
        self
    }

    /// A rack: the slide of the second joint is `radius` [m] times the angle of the first.
    #[must_use]
    pub fn rack([pinion, rack]: [JointId; 2], radius: f64) -> Self {
        Self::linear([(rack, 1.0), (pinion, -radius)]).drawn(DrawnKind::Rack)
    }

    /// The second joint's coordinate is a curve of the first's.
    #[must_use]
    pub fn cam([shaft, follower]: [JointId; 2], curve: Curve<Number>) -> Self {
        let of_shaft =
            CouplingTerm { curve: Some(curve), ..CouplingTerm::of_joint(shaft, 0, -1.0) };
        let terms = vec![CouplingTerm::of_joint(follower, 0, 1.0), of_shaft];
        Self { kind: CouplingKind::Cam, ..Self::of(terms) }
    }

    /// Lets two wheels touch at a pitch point [m] under a pressure angle [rad]: their bearings carry the force of the teeth.
    #[must_use]
    pub fn meshing_at(mut self, at: impl Into<Vector3>, pressure_angle: impl Into<Number>) -> Self {
        let pressure_angle = pressure_angle.into();
        self.kind = CouplingKind::Mesh(Mesh { at: at.into().0, pressure_angle });
        self
    }

    /// Gives a belt strands that pull by this force [N] where it passes nothing on: the bearings of its wheels carry their pull.
    #[must_use]
    pub fn tightened(mut self, pretension: impl Into<Number>) -> Self {
        self.kind = CouplingKind::Strands { pretension: pretension.into() };
        self
    }

    fn drawn(mut self, kind: DrawnKind) -> Self {
        self.drawn = Some(kind.drawn());
        self
    }

    /// Marks the coupling as one that is meant as drawn: no run notes that its sum is another one than in version 0.1.
    #[must_use]
    pub fn as_drawn(mut self) -> Self {
        if let Some(drawn) = &mut self.drawn {
            drawn.is_stated = true;
        }
        self
    }

    /// Sets the sum of the coupling to `value`, from the reference configuration.
    #[must_use]
    pub fn holding(mut self, value: impl Into<Number>) -> Self {
        self.value = value.into();
        self
    }

    /// Lets the sum of the coupling follow a function of time.
    #[must_use]
    pub fn driven(mut self, motion: impl Into<Motion<Number>>) -> Self {
        self.motion = Some(motion.into());
        self
    }
}

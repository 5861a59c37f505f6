//! Helpers that build planar and spatial mechanisms in code from bodies and joints.

use mbs_core::scene::{Body, BodyId, Dimension, Inertia, Joint, JointKind, JointLimits, Scene};
use mbs_study::redundancy::{Diagnosis, Linkage, Nature, diagnose, reference};
use mbs_testkit::scenes::empty;

pub(crate) type Point = [f64; 3];
pub(crate) const GROUND: BodyId = BodyId::Ground;

/// Scene to which parts are added.
pub(crate) struct Build(pub(crate) Scene<f64>);

impl Build {
    pub(crate) fn new(dimension: Dimension) -> Self {
        Self(empty("mechanism", dimension, None))
    }

    pub(crate) fn planar() -> Self {
        Self::new(Dimension::Planar)
    }

    pub(crate) fn spatial() -> Self {
        Self::new(Dimension::Spatial)
    }

    /// Adds a body of 1 kg between two points.
    pub(crate) fn bar(&mut self, from: Point, to: Point) -> BodyId {
        let center = [0, 1, 2].map(|i| 0.5 * (from[i] + to[i]));
        let inertia = match self.0.dimension {
            Dimension::Planar => Inertia::Planar(0.01),
            Dimension::Spatial => Inertia::Spatial([0.01, 0.01, 0.01, 0.0, 0.0, 0.0]),
        };
        let name = format!("body-{}", self.0.bodies.len());
        self.0.bodies.push(Body { name, mass: 1.0, center, inertia, gravity_scale: None });
        BodyId::Body(self.0.bodies.len() - 1)
    }

    pub(crate) fn joint(
        &mut self,
        kind: JointKind,
        bodies: [BodyId; 2],
        at: Point,
        axis: Option<Point>,
    ) -> usize {
        self.link(kind, bodies, [at; 2], [axis, None])
    }

    pub(crate) fn link(
        &mut self,
        kind: JointKind,
        bodies: [BodyId; 2],
        points: [Point; 2],
        axes: [Option<Point>; 2],
    ) -> usize {
        let name = format!("joint-{}", self.0.joints.len());
        self.0.joints.push(Joint { name, kind, bodies, points, axes, limits: JointLimits::NONE });
        self.0.joints.len() - 1
    }

    pub(crate) fn pin(&mut self, a: BodyId, b: BodyId, at: Point) -> usize {
        let axis = (self.0.dimension == Dimension::Spatial).then_some([0.0, 0.0, 1.0]);
        self.joint(JointKind::Revolute, [a, b], at, axis)
    }
}

/// Diagnosis of a scene in the reference configuration.
pub(crate) fn diagnosis(scene: &Scene<f64>) -> Diagnosis {
    scene.check().expect("a scene that can be meant");
    diagnose(&Linkage::new(scene), &reference(scene))
}

/// Returns joints, number of redundancies and nature of each set.
pub(crate) fn sets(d: &Diagnosis) -> Vec<(Vec<usize>, usize, Nature)> {
    let joints = |s: &mbs_study::redundancy::Set| s.members.iter().map(|m| m.joint).collect();
    d.sets.iter().map(|s| (joints(s), s.redundant, s.nature)).collect()
}

/// Number of degrees of freedom of a diagnosis.
pub(crate) fn dof(d: &Diagnosis) -> usize {
    d.sizes[1] - d.sizes[2]
}

/// Adds a four-bar linkage: crank, coupler, rocker and four pins, with the first pin at `x` [m].
pub(crate) fn four_bar(b: &mut Build, x: f64) -> [usize; 4] {
    let [o, a, c, d] =
        [[x, 0.0, 0.0], [x + 0.1, 0.3, 0.0], [x + 0.8, 0.6, 0.0], [x + 0.7, 0.0, 0.0]];
    let [crank, coupler, rocker] = [b.bar(o, a), b.bar(a, c), b.bar(c, d)];
    [
        b.pin(GROUND, crank, o),
        b.pin(crank, coupler, a),
        b.pin(coupler, rocker, c),
        b.pin(rocker, GROUND, d),
    ]
}

//! Places where the force of a coupling acts on the drawn machine, by the geometry of the reference configuration.

use crate::Real;
use crate::algebra::{Vector, along, cross, norm};
use crate::joint::Freedom;
use crate::mechanism::Scene;
use crate::scene::{
    BodyId, Coupling, CouplingId, CouplingKind, CouplingMeasure, CouplingTerm, DrawnKind, Joint,
    JointId,
};

/// Largest distance of what should be at one place, over the size of what it belongs to [-]. Chosen, not tuned: digits of a file.
const OFF: f64 = 1e-6;

/// A force that acts elsewhere than along the coordinates of a coupling.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Acting {
    /// Between a screw and its nut, along the screw's axis and about it. The terms are the nut's slide and the screw's turn.
    Thread {
        /// The body that carries both.
        carrier: BodyId,
    },
    /// At the rim of a drum, where a line begins or ends that the drum's carrier has there. The terms are the line and the drum's turn.
    Drum {
        /// Is it the end of the line? Otherwise its beginning.
        is_end: bool,
        /// The body that carries the drum.
        carrier: BodyId,
    },
}

impl Acting {
    /// Finds where the force of a coupling acts; `None`: along its coordinates, or the geometry does not say where.
    pub(crate) fn of<T: Real>(scene: &Scene<T>, coupling: &Coupling<T>) -> Option<Self> {
        if coupling.relation.is_some() {
            return None;
        }
        match coupling.drawn.map(|drawn| drawn.kind) {
            Some(DrawnKind::Screw) => Self::thread(scene, &coupling.terms),
            _ if coupling.kind == CouplingKind::Rope => Self::drum(scene, &coupling.terms),
            _ => None,
        }
    }

    fn thread<T: Real>(scene: &Scene<T>, terms: &[CouplingTerm<T>]) -> Option<Self> {
        let [slide, turn] = terms else { return None };
        let (slide, way) = joint_of(scene, slide)?;
        let (turn, about) = joint_of(scene, turn)?;
        let is_plain = matches!((about, way), (Freedom::Turn(_), Freedom::Slide(_)));
        let carrier = turn.shared_body(slide)?;
        is_plain.then_some(Self::Thread { carrier })
    }

    fn drum<T: Real>(scene: &Scene<T>, terms: &[CouplingTerm<T>]) -> Option<Self> {
        let [line, drum] = terms else { return None };
        let CouplingMeasure::Length { points } = &line.of else { return None };
        let (joint, Freedom::Turn(axis)) = joint_of(scene, drum)? else { return None };
        if line.curve.is_some() || drum.curve.is_some() {
            return None;
        }
        let axis = along(&joint.direction(axis));
        let (center, radius) = (Vector::from(joint.points[0]), drum.factor.abs());
        let last = points.len() - 1;
        [(0, 1, false), (last, last - 1, true)].into_iter().find_map(|(end, next, is_end)| {
            let (carrier, from) = (points[end].0, Vector::from(points[end].1));
            let side = joint.bodies.iter().position(|body| *body == carrier)?;
            let arm = cross(&(from - center), &along(&(Vector::from(points[next].1) - from)));
            let way = from - center;
            let way = way - axis * axis.dot(&way);
            // on the rim, where the line is a tangent in the sense in which the drum takes it in
            let turns = if side == 0 { drum.factor } else { -drum.factor } / line.factor;
            let least = radius * T::from_f64(OFF);
            let is_rim = (norm(&way) - radius / line.factor.abs()).abs() <= least;
            let is_tangent = (axis.dot(&arm) + turns).abs() <= least;
            (is_rim && is_tangent).then_some(Self::Drum { is_end, carrier })
        })
    }
}

impl<T: Real> Scene<T> {
    /// The joints whose reactions lack the force of a coupling: teeth without a pitch point, strands, and ropes that do not leave their drum at
    /// its rim act as moments alone.
    pub fn lacking_forces(&self) -> impl Iterator<Item = (JointId, CouplingId)> {
        let lacking = self.couplings.iter().enumerate().filter(|(_, coupling)| {
            let is_rope = coupling.kind == CouplingKind::Rope;
            let has_place =
                matches!(coupling.kind, CouplingKind::Mesh(_) | CouplingKind::Strands { .. });
            (coupling.drawn.is_some() || is_rope)
                && !has_place
                && Acting::of(self, coupling).is_none()
        });
        lacking.flat_map(|(i, coupling)| {
            let joints = coupling.terms.iter().filter_map(|term| term.of.coordinate());
            joints.map(move |(joint, _)| (joint, CouplingId::new(i)))
        })
    }
}

/// The joint whose only coordinate a term is, and what that is.
fn joint_of<'a, T>(scene: &'a Scene<T>, term: &CouplingTerm<T>) -> Option<(&'a Joint<T>, Freedom)> {
    let joint = scene.joints.get(term.of.coordinate()?.0.index())?;
    match joint.kind.freedoms(scene.dimension) {
        [only] => Some((joint, *only)),
        _ => None,
    }
}

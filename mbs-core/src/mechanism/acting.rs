//! Points at which the force of a coupling acts, by the geometry of the reference configuration.

use crate::Real;
use crate::algebra::{Vector, along, cross, norm};
use crate::joint::Freedom;
use crate::mechanism::Scene;
use crate::scene::{
    BodyId, Coupling, CouplingId, CouplingKind, CouplingMeasure, CouplingTerm, DrawnKind, Joint,
    JointId,
};

/// Largest distance of points that should coincide, relative to the size of their part [-]. Chosen, not tuned: numbers in files are rounded.
const OFF: f64 = 1e-6;

/// Force of a coupling that acts at a point, and not only along the coordinates.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Acting {
    /// Force between a screw and its nut, along the screw's axis, with the moment about it. The terms are the slide of the nut and the turn
    /// of the screw.
    Thread {
        /// Body that carries the screw and the nut.
        carrier: BodyId,
    },
    /// Force at the rim of a drum, where the line of a rope begins or ends on the carrier of the drum. The terms are the line and the turn
    /// of the drum.
    Drum {
        /// True if the line ends at the drum; false if it begins there.
        is_end: bool,
        /// Body that carries the drum.
        carrier: BodyId,
    },
}

impl Acting {
    /// Finds the point at which the force of a coupling acts. `None`: the force acts along the coordinates only, or the geometry does not
    /// determine the point.
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
            // the point is on the rim, and the line is a tangent in the sense in which the drum winds it up
            let turns = if side == 0 { drum.factor } else { -drum.factor } / line.factor;
            let least = radius * T::from_f64(OFF);
            let is_rim = (norm(&way) - radius / line.factor.abs()).abs() <= least;
            let is_tangent = (axis.dot(&arm) + turns).abs() <= least;
            (is_rim && is_tangent).then_some(Self::Drum { is_end, carrier })
        })
    }
}

impl<T: Real> Scene<T> {
    /// Joints whose reactions lack the force of a coupling. Teeth without a pitch point, belts without strands, and ropes that do not leave
    /// their drum at its rim act as moments alone.
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

/// Joint whose only coordinate is this term, and the freedom of that coordinate.
fn joint_of<'a, T>(scene: &'a Scene<T>, term: &CouplingTerm<T>) -> Option<(&'a Joint<T>, Freedom)> {
    let joint = scene.joints.get(term.of.coordinate()?.0.index())?;
    match joint.kind.freedoms(scene.dimension) {
        [only] => Some((joint, *only)),
        _ => None,
    }
}

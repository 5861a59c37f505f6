//! Joints as constraint rows on the twists of rigid bodies. Bodies share no points or axes here, so every redundancy becomes visible.
//!
//! ```text
//! row of direction (f, m) at the joint's place p:   f·(v₂(p) − v₁(p)) + m·(ω₂ − ω₁) = 0
//! on a body with centre c, unknowns (v, ℓ ω):       ± [f;  (m + (p − c) × f) / ℓ]
//! ```
//!
//! ℓ is the length of the part that the joint belongs to. Moments are expressed as unit forces at the lever ℓ. So all rows and columns are
//! of order one for every unit of length. The equations contain no masses: the rank depends on geometry alone, and bodies may have no mass.

use super::Vector;
use super::link::{Link, Poses};
use super::parts::{Part, parts};
use mbs_core::algebra::cross;
use mbs_core::cluster::mass_properties;
use mbs_core::outputs::Wrench;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::align::aligned;
use mbs_core::scene::{BodyId, Dimension, JointKind, Scene};
use mbs_linear::Matrix;
use std::ops::Range;

/// The bodies of a scene in its reference configuration, at rest.
#[must_use]
pub fn reference(scene: &Scene<f64>) -> Vec<RigidMotion<f64>> {
    (0..scene.bodies.len()).map(|b| RigidMotion::at_rest(mass_properties(scene, b).1)).collect()
}

/// A scene as bodies with six freedoms each (three in a plane), and joints that constrain some of these freedoms.
#[derive(Debug, Clone)]
pub struct Linkage {
    pub(crate) dimension: Dimension,
    pub(crate) n_bodies: usize,
    /// Number of rotational freedoms of point masses. No joint has a row for them.
    n_idle: usize,
    pub(crate) links: Vec<Link>,
    /// Parts of the mechanism. Only joints of the same part can depend on each other, see [`Part`].
    pub parts: Vec<Part>,
}

/// Rows of a part on the twists of its bodies.
#[derive(Debug, Clone)]
pub struct Jacobian {
    /// Matrix with one row per direction, and six columns per body (three in a plane).
    pub matrix: Matrix,
    /// Rows of each joint, in the order of [`Part::joints`].
    pub rows: Vec<Range<usize>>,
    /// The direction of each row.
    pub wrenches: Vec<Wrench<f64>>,
}

impl Linkage {
    /// Creates the linkage of a scene that passed its check. Cost: proportional to the number of bodies and joints.
    #[must_use]
    pub fn new(scene: &Scene<f64>) -> Self {
        let scene = &*aligned(scene);
        let is_guided = |j| scene.guides.iter().any(|guide| guide.joint.index() == j);
        let joints = scene.joints.iter().enumerate();
        let links = joints.map(|(j, x)| Link::new(x, scene.dimension, is_guided(j))).collect();
        let mut linkage = Self {
            dimension: scene.dimension,
            n_bodies: scene.bodies.len(),
            n_idle: 0,
            links,
            parts: Vec::new(),
        };
        let n_points = scene.bodies.iter().filter(|body| body.is_point()).count();
        linkage.n_idle = n_points * linkage.turns().count();
        linkage.parts = parts(linkage.n_bodies, &linkage.links, &reference(scene));
        linkage
    }

    /// Number of freedoms of a body without joints.
    #[must_use]
    pub fn freedoms(&self) -> usize {
        match self.dimension {
            Dimension::Planar => 3,
            Dimension::Spatial => 6,
        }
    }

    /// Returns the range of the rotational freedoms among a body's freedoms.
    pub(crate) fn turns(&self) -> Range<usize> {
        match self.dimension {
            Dimension::Planar => 2..3,
            Dimension::Spatial => 3..6,
        }
    }

    /// Returns two numbers: the rows of all joints, and the freedoms of all bodies. Point masses have no rotational freedoms.
    #[must_use]
    pub fn sizes(&self) -> [usize; 2] {
        let rows = self.links.iter().map(Link::n_rows).sum();
        [rows, self.n_bodies * self.freedoms() - self.n_idle]
    }

    /// Returns the number of equations of a joint, including those of its guide.
    ///
    /// # Panics
    /// If there is no such joint.
    #[must_use]
    pub fn n_rows(&self, joint: usize) -> usize {
        self.links[joint].n_rows()
    }

    /// Returns the kind of a joint.
    ///
    /// # Panics
    /// If there is no such joint.
    #[must_use]
    pub fn kind(&self, joint: usize) -> JointKind {
        self.links[joint].joint.kind
    }

    /// Returns the rows of a part at a pose.
    #[must_use]
    pub fn jacobian(&self, part: &Part, at: &Poses) -> Jacobian {
        self.jacobian_of(part, &part.joints.iter().map(|&j| &self.links[j]).collect::<Vec<_>>(), at)
    }

    /// Returns the rows of a part at a pose, with the given links in place of those of the part.
    pub(crate) fn jacobian_of(&self, part: &Part, links: &[&Link], at: &Poses) -> Jacobian {
        let f = self.freedoms();
        let (mut rows, mut wrenches) = (Vec::new(), Vec::new());
        for link in links {
            let first = wrenches.len();
            wrenches.extend(link.wrenches(at, part.length));
            rows.push(first..wrenches.len());
        }
        let mut matrix = Matrix::zeros(wrenches.len(), part.bodies.len() * f);
        for (link, range) in links.iter().zip(&rows) {
            let place = link.place(at, 1);
            for (body, sign) in link.joint.bodies.into_iter().zip([-1.0, 1.0]) {
                let BodyId::Body(b) = body else { continue };
                let Ok(column) = part.bodies.binary_search(&b) else { continue };
                for row in range.clone() {
                    let w = &wrenches[row];
                    let moment = w.moment + cross(&(place - at[b].position), &w.force);
                    let entries = self.components(&w.force, &(moment / part.length));
                    for (i, x) in entries.into_iter().take(f).enumerate() {
                        matrix[(row, column * f + i)] = sign * x;
                    }
                }
            }
        }
        Jacobian { matrix, rows, wrenches }
    }

    /// Returns the components of a force and a moment that exist in the scene's dimension: [Fx, Fy, Mz] in a plane, otherwise all six.
    pub(crate) fn components(&self, force: &Vector, moment: &Vector) -> [f64; 6] {
        match self.dimension {
            Dimension::Planar => [force[0], force[1], moment[2], 0.0, 0.0, 0.0],
            Dimension::Spatial => [force[0], force[1], force[2], moment[0], moment[1], moment[2]],
        }
    }

    /// Moves the bodies of a part by small twists (v, ℓ ω).
    pub(crate) fn moved(&self, part: &Part, at: &mut Poses, twists: &[f64]) {
        for (&b, x) in part.bodies.iter().zip(twists.chunks_exact(self.freedoms())) {
            let (v, turn) = match self.dimension {
                Dimension::Planar => (Vector::new(x[0], x[1], 0.0), Vector::new(0.0, 0.0, x[2])),
                Dimension::Spatial => {
                    (Vector::new(x[0], x[1], x[2]), Vector::new(x[3], x[4], x[5]))
                }
            };
            let body = &mut at[b];
            body.position += v;
            body.rotation = mbs_core::algebra::rotation(&(turn / part.length)) * body.rotation;
        }
    }
}

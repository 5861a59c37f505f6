//! Strands of a belt: the two common tangents of its wheels.
//!
//! ```text
//! e, p      e: unit vector from the first axis to the second, perpendicular to both;  p = n x e, n: first axis;  D: distance of the axes
//! m         = c e +- sqrt(1 - c^2) p,   c = (r1 - r2)/D, for a crossed belt (r1 + r2)/D;   r1, r2: radii
//! P1, P2    = O1 + r1 m, O2 + r2 m, for a crossed belt O2 - r2 m:   end points of a strand;  O1, O2: points on the axes
//! ```

use super::MeshedWheels;
use crate::Real;
use crate::algebra::{Vector, cross, norm};
use crate::joint::Freedom;
use crate::mechanism::Scene;
use crate::scene::{Coupling, DrawnKind, NotStrands};

/// A belt whose strands are determined.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Strands<T: Real> {
    /// Wheels of the belt, on the body that carries both.
    pub(crate) wheels: MeshedWheels<T>,
    /// Radii of the wheels [m]. The second one is negative for a crossed belt.
    radii: [T; 2],
}

/// A strand of a belt: its end points, its direction, and the sense in which it turns the first wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Strand<T: Real> {
    /// End points on the first and the second wheel [m].
    pub(crate) ends: [Vector<T, 3>; 2],
    /// Unit vector from the first end point to the second.
    pub(crate) along: Vector<T, 3>,
    /// True if the tension of the strand turns the first wheel in the positive sense about the first axis.
    pub(crate) is_about: bool,
}

impl<T: Real> Strands<T> {
    /// Computes the strands of a coupling.
    ///
    /// # Errors
    /// The reason why the geometry does not determine the strands.
    pub(crate) fn new(scene: &Scene<T>, coupling: &Coupling<T>) -> Result<Self, NotStrands> {
        /// Largest distance of the wheels' planes, relative to the distance of the axes [-]. Chosen, not tuned: numbers in files are rounded.
        const APART: f64 = 1e-6;
        let Some(DrawnKind::Belt { is_crossed }) = coupling.drawn.map(|drawn| drawn.kind) else {
            return Err(NotStrands::Wheels);
        };
        let wheels = MeshedWheels::new(scene, &coupling.terms).ok_or(NotStrands::Wheels)?;
        let joints = coupling.terms.iter().filter_map(|term| term.of.joint());
        for joint in joints.filter_map(|joint| scene.joints.get(joint.index())) {
            let across = joint.freedoms(scene.dimension).iter().any(|freedom| match freedom {
                Freedom::Turn(_) => false,
                Freedom::Slide(axis) => {
                    let way = joint.direction(*axis);
                    norm(&cross(&way, &wheels.axes[0])) > norm(&way) * T::from_f64(APART)
                }
                Freedom::Ball => true,
            });
            if across {
                return Err(NotStrands::Wheels);
            }
        }
        let distance = wheels.distance();
        let apart = wheels.axes[0].dot(&(wheels.points[1] - wheels.points[0])).abs();
        if apart > distance * T::from_f64(APART) {
            return Err(NotStrands::Planes(apart.to_f64()));
        }
        let [first, second] = wheels.moments.map(T::abs);
        let radii = [first, if is_crossed { -second } else { second }];
        if !((radii[0] - radii[1]).abs() < distance) {
            return Err(NotStrands::Inside(distance.to_f64()));
        }
        Ok(Self { wheels, radii })
    }

    /// Strands of the belt if the first axis has direction `n` and the axes go through these points.
    pub(crate) fn at(&self, n: &Vector<T, 3>, [from, to]: [Vector<T, 3>; 2]) -> [Strand<T>; 2] {
        let [r1, r2] = self.radii;
        let way = to - from;
        let way = way - *n * n.dot(&way);
        let distance = norm(&way);
        let e = way * (T::ONE / distance);
        let c = (r1 - r2) / distance;
        let across = cross(n, &e) * (T::ONE - c * c).max(T::ZERO).sqrt();
        [T::ONE, -T::ONE].map(|side| {
            let m = e * c + across * side;
            let ends = [from + m * r1, from + way + m * r2];
            let along = ends[1] - ends[0];
            let along = along * (T::ONE / norm(&along));
            Strand { ends, along, is_about: n.dot(&cross(&m, &along)) > T::ZERO }
        })
    }
}

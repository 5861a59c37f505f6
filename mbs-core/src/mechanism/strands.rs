//! The two strands of a belt: the common tangents of its wheels.
//!
//! ```text
//! e, p      from the first axis to the second, across them; p = n x e, n the first axis;  D: their distance
//! m         = c e +- sqrt(1 - c^2) p,   c = (r1 - r2)/D, of a crossed belt (r1 + r2)/D
//! P1, P2    = O1 + r1 m, O2 + r2 m, of a crossed belt O2 - r2 m:   a strand leads from the one to the other
//! ```

use super::MeshedWheels;
use crate::Real;
use crate::algebra::{Vector, cross, norm};
use crate::joint::Freedom;
use crate::mechanism::Scene;
use crate::scene::{Coupling, DrawnKind, NotStrands};

/// A belt whose strands are known.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Strands<T: Real> {
    /// The wheels on the body that carries both.
    pub(crate) wheels: MeshedWheels<T>,
    /// Radii of the wheels [m], of the second one negative where the belt is crossed.
    radii: [T; 2],
}

/// A strand: where it leaves the wheels, and the sense in which it turns the first one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Strand<T: Real> {
    /// On the first wheel, on the second [m].
    pub(crate) ends: [Vector<T, 3>; 2],
    /// From the first to the second, of length one.
    pub(crate) along: Vector<T, 3>,
    /// Does its pull turn the first wheel about the first axis? Otherwise against it.
    pub(crate) is_about: bool,
}

impl<T: Real> Strands<T> {
    /// Finds the strands of a coupling.
    ///
    /// # Errors
    /// Why places and axes do not say where its strands are.
    pub(crate) fn new(scene: &Scene<T>, coupling: &Coupling<T>) -> Result<Self, NotStrands> {
        /// Distance of the wheels' planes, over that of the axes, that is none [-]. Chosen, not tuned: digits of a file.
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

    /// Two strands of the belt, where the first axis is `n` and the axes stand at these places.
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

//! Rows of couplings, with the forces of their multipliers on bodies.

use crate::loads::Now;
use crate::rows::{Row, add_part, six};
use crate::scene::{Coupling, Measure, Seat};
use crate::vector::{Vector, ZERO, add, cross, dot, norm, scale, sub, unit};

/// A part for each body: force and torque about its centre of mass.
type Parts = Vec<(Option<usize>, [f64; 6])>;

/// A strand of a belt: its two wheels, the points where it touches them, its direction, and the sense in which it turns the first wheel
/// about the axis.
struct Strand {
    bodies: [Option<usize>; 2],
    ends: [Vector; 2],
    along: Vector,
    turns: f64,
}

impl Now<'_> {
    /// The row of a coupling: its sum less the given value.
    pub(crate) fn coupling(&self, coupling: &Coupling) -> Row {
        let mut row = self.sum(&coupling.terms);
        row.value -= coupling.value;
        if let Some(law) = &coupling.law {
            let [value, rate, acceleration] = law.at(self.t);
            row.value -= value;
            row.given = [rate, acceleration];
        }
        row.acts = self.seated(coupling, &row, 1.0);
        row
    }

    /// Returns the forces of a unit multiplier on bodies, where the scene gives the attachment points of the coupling. `sign` is the sign
    /// of the effort. In all motions that joints allow, these forces have the same power as the row.
    pub(crate) fn seated(&self, coupling: &Coupling, row: &Row, sign: f64) -> Option<Parts> {
        match &coupling.seat {
            Seat::Nowhere => None,
            Seat::Teeth([carrier, one, two], axis, places, at, tangent, is_first) => {
                let n = self.places.direction(*carrier, *axis);
                let p = self.places.seat(*carrier, *at).p;
                let [r1, r2] = places.map(|q| {
                    let off = sub(p, self.places.seat(*carrier, q).p);
                    sub(off, scale(dot(off, n), n))
                });
                let f = scale(coupling.terms.first()?.factor / dot(r1, r1), cross(n, r1));
                // the force that pushes teeth apart acts on the smaller wheel towards its axis
                let inward = if *is_first { scale(-1.0, unit(r1)) } else { unit(r2) };
                let f = add(f, scale(sign * tangent * norm(f), inward));
                let mut parts = Parts::new();
                self.wrench(&mut parts, *one, p, f, ZERO);
                self.wrench(&mut parts, *two, p, scale(-1.0, f), ZERO);
                Some(parts)
            }
            Seat::Strands(..) => {
                let mut parts = Parts::new();
                for strand in self.strands(coupling) {
                    // each strand has half of the effort, positive where the strand turns the first wheel as the sum does
                    let half = 0.5 * strand.turns;
                    self.pull(&mut parts, &strand, half);
                }
                Some(parts)
            }
            Seat::Thread([carrier, screw, nut], point, axis) => {
                let e = self.places.direction(*carrier, *axis);
                let p = self.places.seat(*carrier, *point).p;
                let lead = coupling.terms.get(1)?.factor;
                let mut parts = Parts::new();
                self.wrench(&mut parts, *nut, p, e, scale(-lead, e));
                self.wrench(&mut parts, *screw, p, scale(-1.0, e), scale(lead, e));
                Some(parts)
            }
            Seat::Drum([carrier, drum], center, axis, is_last) => {
                let Measure::Length(points) = &coupling.terms.first()?.measure else { return None };
                let n = points.len();
                let (end, next) = if *is_last { (n - 1, n - 2) } else { (0, 1) };
                let [p, q] = [points[end], points[next]].map(|(b, at)| self.places.seat(b, at).p);
                // the force of the rope on its end, without the part that turns the drum
                let off = sub(p, q);
                let force = scale(1.0 / dot(off, off).sqrt(), off);
                let hub = self.places.seat(*carrier, *center).p;
                let a = self.places.direction(*carrier, *axis);
                let moment = cross(sub(p, hub), force);
                let across = sub(moment, scale(dot(moment, a), a));
                let mut parts = row.parts.clone();
                self.wrench(&mut parts, *drum, hub, force, across);
                self.wrench(&mut parts, *carrier, hub, scale(-1.0, force), scale(-1.0, across));
                Some(parts)
            }
        }
    }

    /// The strands of a belt with a pretension: common tangents of the two wheels.
    fn strands(&self, coupling: &Coupling) -> Vec<Strand> {
        let Seat::Strands([carrier, one, two], axis, places, [r1, r2], _) = &coupling.seat else {
            return Vec::new();
        };
        let n = self.places.direction(*carrier, *axis);
        let [c1, c2] = places.map(|q| self.places.seat(*carrier, q).p);
        let off = sub(c2, c1);
        let e = unit(off);
        // a tangent touches at c₁ + r₁ u and c₂ - r₂ u, where r₂ < 0 for an open belt: u·(c₂ - c₁) = r₁ + r₂
        let cosine = (r1 + r2) / norm(off);
        let side = |s: f64| {
            let u = add(scale(cosine, e), scale(s * (1.0 - cosine * cosine).sqrt(), cross(n, e)));
            let ends = [add(c1, scale(*r1, u)), sub(c2, scale(*r2, u))];
            let along = unit(sub(ends[1], ends[0]));
            Strand { bodies: [*one, *two], ends, along, turns: dot(cross(u, along), n).signum() }
        };
        vec![side(1.0), side(-1.0)]
    }

    /// Adds the force of a strand, which pulls both of its ends.
    fn pull(&self, parts: &mut Parts, strand: &Strand, force: f64) {
        let [one, two] = strand.bodies;
        self.wrench(parts, one, strand.ends[0], scale(force, strand.along), ZERO);
        self.wrench(parts, two, strand.ends[1], scale(-force, strand.along), ZERO);
    }

    /// Returns the forces of couplings that do not depend on their efforts: pretensions of belts.
    pub(crate) fn pretensions(&self) -> Parts {
        let mut parts = Parts::new();
        for coupling in &self.scene.couplings {
            if let Seat::Strands(.., pretension) = coupling.seat {
                for strand in self.strands(coupling) {
                    self.pull(&mut parts, &strand, pretension);
                }
            }
        }
        parts
    }

    /// Adds a force at a place and a moment about this place.
    fn wrench(&self, parts: &mut Parts, body: Option<usize>, at: Vector, force: Vector, m: Vector) {
        let arm = body.map_or(ZERO, |_| sub(at, self.places.of(body).r));
        add_part(parts, body, &six(force, add(m, cross(arm, force))));
    }
}

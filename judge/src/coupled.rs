//! Rows of couplings, with what their multipliers do to bodies.

use crate::loads::Now;
use crate::rows::{Row, add_part, six};
use crate::scene::{Coupling, Measure, Seat};
use crate::vector::{Vector, ZERO, add, cross, dot, scale, sub};

/// A part for each body: force and torque about its centre of mass.
type Parts = Vec<(Option<usize>, [f64; 6])>;

impl Now<'_> {
    /// The row of a coupling: its sum, less what that is at a fraction of the given value.
    pub(crate) fn coupling(&self, coupling: &Coupling) -> Row {
        let mut row = self.sum(&coupling.terms);
        row.value -= coupling.value;
        if let Some(law) = &coupling.law {
            let [value, rate, acceleration] = law.at(self.t);
            row.value -= value;
            row.given = [rate, acceleration];
        }
        row.acts = self.seated(coupling, &row);
        row
    }

    /// What a multiplier does to bodies where the machine says where it acts; the same power in all motions that joints allow.
    fn seated(&self, coupling: &Coupling, row: &Row) -> Option<Parts> {
        match &coupling.seat {
            Seat::Nowhere => None,
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
                // the force of a longer line on its end, without what turns the drum
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

    /// Adds a force at a place and a moment about it.
    fn wrench(&self, parts: &mut Parts, body: Option<usize>, at: Vector, force: Vector, m: Vector) {
        let arm = body.map_or(ZERO, |_| sub(at, self.places.of(body).r));
        add_part(parts, body, &six(force, add(m, cross(arm, force))));
    }
}

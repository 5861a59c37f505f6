//! Reads couplings of a scene. Each becomes a sum, with the coordinate on which its effort is measured.

use crate::drawn::{self, sense};
use crate::names::Names;
use crate::node::{Node, Read, Table, fault};
use crate::parts::reference_length;
use crate::read_curve::{curve, law, only, terms};
use crate::scene::{Coupling, Joint, Kind, Measure, Seat, Signal, Term, Wheel};
use crate::vector::{Vector, dot, norm, scale, sub};
use core::f64::consts::PI;

/// Largest distance of a rope's end from the rim of its drum, relative to the radius [-]. Chosen, not tuned.
const AT_RIM: f64 = 1e-6;

/// Largest cosine between a screw's axis and the slide of its nut at which the two count as perpendicular [-]. Chosen, not tuned.
const ACROSS: f64 = 1e-9;

/// Reader of couplings, with the parts of the scene to which couplings refer.
pub(crate) struct Reader<'a> {
    pub(crate) names: &'a Names,
    pub(crate) joints: &'a [Joint],
    pub(crate) signals: &'a [Signal],
    pub(crate) wheels: &'a mut Vec<Wheel>,
    pub(crate) planar: bool,
}

/// A sum, its value, the ratio of the effort to the multiplier, the coordinate on which the effort is measured, and the attachment.
struct Sum {
    terms: Vec<Term>,
    value: f64,
    gain: f64,
    passed: Option<(usize, usize, f64)>,
    seat: Seat,
}

impl Sum {
    fn plain(terms: Vec<Term>, value: f64) -> Self {
        Self { terms, value, gain: 1.0, passed: None, seat: Seat::Nowhere }
    }
}

impl Reader<'_> {
    /// Reads a coupling.
    pub(crate) fn coupling(&mut self, mut table: Table, number: usize) -> Read<Coupling> {
        let name = match table.take("name") {
            Some(Node::Text(name)) => name,
            _ => format!("coupling-{}", number + 1),
        };
        table.take("sense");
        let kind = table.text("kind")?;
        let t = &mut table;
        let sum = match kind.as_str() {
            "gear" if t.has("ratio") => self.ratio(t)?,
            "gear" => self.gear(t)?,
            "belt" => self.belt(t)?,
            "rack" => self.rack(t)?,
            "screw" => self.screw(t)?,
            "differential" => self.differential(t)?,
            "mimic" => self.mimic(t)?,
            "cam" => self.cam(t)?,
            "rope" => self.rope(t)?,
            "linear" => Sum::plain(terms(t, self.names, self.joints)?, t.number_or("value", 0.0)?),
            other => return fault(format!("no coupling `{other}`")),
        };
        let law = law(&mut table, self.signals)?;
        table.done(&name)?;
        let Sum { terms, value, gain, passed, seat } = sum;
        if terms.iter().any(|term| matches!(term.measure, Measure::Ball(..))) {
            return fault("couplings take no angles of balls");
        }
        Ok(Coupling { name, kind, terms, value, law, gain, passed, seat })
    }

    fn joints_of<const N: usize>(&self, table: &mut Table) -> Read<[usize; N]> {
        let node = table.need("joints")?;
        let one = |name: &Node| match name {
            Node::Text(name) => self.names.joint(name),
            other => fault(format!("not a joint: {other:?}")),
        };
        let list: Vec<usize> = node.list()?.iter().map(one).collect::<Read<_>>()?;
        <[usize; N]>::try_from(list).map_or_else(|_| fault(format!("{N} joints")), Ok)
    }

    /// The term of a rotation of one body against another, which is added to the measured rotations of the scene.
    fn wheel(&mut self, bodies: [Option<usize>; 2], axis: Vector, factor: f64) -> Term {
        self.wheels.push(Wheel { bodies, axis });
        Term { measure: Measure::Wheel(self.wheels.len() - 1), factor, curve: None }
    }

    /// Two wheels on one carrier: the terms are factors times their rotations about the first axis.
    fn mesh(
        &mut self,
        [one, two]: [usize; 2],
        factors: [f64; 2],
    ) -> Read<(Sum, [Option<usize>; 3])> {
        let axis = drawn::axis(&self.joints[one], self.planar);
        let other = drawn::axis(&self.joints[two], self.planar);
        if dot(axis, other).abs() < 1.0 - 1e-9 {
            return fault("axes that are not parallel");
        }
        let Some((carrier, [a, b])) = drawn::carrier(self.joints, [one, two], self.planar) else {
            return fault("no body carries both axes");
        };
        let terms = vec![
            self.wheel([carrier, a], axis, factors[0]),
            self.wheel([carrier, b], axis, factors[1]),
        ];
        let gain = factors[0] * sense(&self.joints[one], a, axis, self.planar);
        let number = only(&self.joints[one], self.planar)?;
        let passed = Some((one, number, 1.0));
        let sum = Sum { terms, value: 0.0, gain, passed, seat: Seat::Nowhere };
        Ok((sum, [carrier, a, b]))
    }

    fn gear(&mut self, t: &mut Table) -> Read<Sum> {
        let [a, b]: [f64; 2] =
            if t.has("teeth") { t.exactly("teeth")? } else { t.exactly("radii")? };
        let inner = t.has("mesh") && t.text("mesh")? == "internal";
        let joints = self.joints_of(t)?;
        let (mut sum, bodies) = self.mesh(joints, [a, if inner { -b } else { b }])?;
        let angle = t.number_or("pressure_angle", PI / 9.0)?;
        if let Some(at) = t.vector_or_none("at")? {
            let axis = drawn::axis(&self.joints[joints[0]], self.planar);
            let places = joints.map(|j| self.joints[j].points[0]);
            sum.seat = Seat::Teeth(bodies, axis, places, at, angle.tan(), a.abs() < b.abs());
        }
        Ok(sum)
    }

    fn ratio(&self, t: &mut Table) -> Read<Sum> {
        let [one, two] = self.joints_of(t)?;
        let ratio = t.number("ratio")?;
        let [i, k] = [only(&self.joints[one], self.planar)?, only(&self.joints[two], self.planar)?];
        let terms = vec![Term::of(two, k, 1.0), Term::of(one, i, -ratio)];
        Ok(Sum { gain: -ratio, passed: Some((one, i, 1.0)), ..Sum::plain(terms, 0.0) })
    }

    fn belt(&mut self, t: &mut Table) -> Read<Sum> {
        let [a, b]: [f64; 2] = t.exactly("radii")?;
        let crossed = matches!(t.take("crossed"), Some(Node::Flag(true)));
        let joints = self.joints_of(t)?;
        let radii = [a, if crossed { b } else { -b }];
        let (mut sum, bodies) = self.mesh(joints, radii)?;
        // the effort is the force at the rim: the torque on the first wheel over its radius; the rate is the speed of the rim
        sum.gain /= a;
        sum.passed = sum.passed.map(|(joint, number, _)| (joint, number, a));
        if let Some(pull) = t.take("pretension") {
            let axis = drawn::axis(&self.joints[joints[0]], self.planar);
            let places = joints.map(|j| self.joints[j].points[0]);
            if norm(sub(places[1], places[0])) <= (radii[0] + radii[1]).abs() {
                return fault("a belt on wheels that are too near");
            }
            sum.seat = Seat::Strands(bodies, axis, places, radii, pull.number()?);
        }
        Ok(sum)
    }

    fn rack(&mut self, t: &mut Table) -> Read<Sum> {
        let pair @ [_, rack] = self.joints_of(t)?;
        let radius = t.number("radius")?;
        let [turns, slides] = pair.map(|j| &self.joints[j]);
        let Some(sign) = drawn::rack_sense(turns, slides, self.planar) else {
            return fault("a rack on the axis of its pinion");
        };
        let Some((carrier, [a, b])) = drawn::carrier(self.joints, pair, self.planar) else {
            return fault("no body carries the pinion and the rack");
        };
        let (axis, along) = (drawn::axis(turns, self.planar), slides.axes[0]);
        let way = Measure::Way([carrier, b], slides.points[0], along);
        let gain = sense(slides, b, along, self.planar);
        let terms = vec![
            Term { measure: way, factor: 1.0, curve: None },
            self.wheel([carrier, a], axis, -radius * sign),
        ];
        Ok(Sum { gain, passed: Some((rack, 0, 1.0)), ..Sum::plain(terms, 0.0) })
    }

    fn screw(&mut self, t: &mut Table) -> Read<Sum> {
        let lead = t.number("lead")? / (2.0 * PI);
        if t.has("joint") {
            let joint = self.names.joint(&t.text("joint")?)?;
            if self.joints[joint].kind != Kind::Cylindrical {
                return fault("a screw needs a cylindrical joint");
            }
            let terms = vec![Term::of(joint, 0, 1.0), Term::of(joint, 1, -lead)];
            return Ok(Sum { passed: Some((joint, 0, 1.0)), ..Sum::plain(terms, 0.0) });
        }
        let pair @ [turn, slide] = self.joints_of(t)?;
        let [turns, slides] = pair.map(|j| &self.joints[j]);
        let axis = drawn::axis(turns, self.planar);
        if dot(axis, slides.axes[0]).abs() < ACROSS {
            // a nut that slides across the screw's axis has no geometry of a thread: the coordinates are used as they are
            let number = only(turns, self.planar)?;
            let terms = vec![Term::of(slide, 0, 1.0), Term::of(turn, number, -lead)];
            return Ok(Sum { passed: Some((slide, 0, 1.0)), ..Sum::plain(terms, 0.0) });
        }
        let Some((carrier, [screw, nut])) = drawn::carrier(self.joints, pair, self.planar) else {
            return fault("no body carries the screw and the nut");
        };
        let gain = sense(slides, nut, axis, self.planar);
        let is_held = turns.kind == Kind::Revolute
            && slides.kind == Kind::Prismatic
            && turns.bodies.contains(&carrier)
            && slides.bodies.contains(&carrier);
        let seat = if is_held {
            Seat::Thread([carrier, screw, nut], turns.points[0], axis)
        } else {
            Seat::Nowhere
        };
        let way = Measure::Way([carrier, nut], slides.points[0], axis);
        let terms = vec![
            Term { measure: way, factor: 1.0, curve: None },
            self.wheel([carrier, screw], axis, -lead),
        ];
        Ok(Sum { gain, passed: Some((slide, 0, 1.0)), seat, ..Sum::plain(terms, 0.0) })
    }

    /// Reads a differential: a gear of two wheels, whose rotations are measured against the cage.
    fn differential(&mut self, t: &mut Table) -> Read<Sum> {
        let [a, b, cage] = self.joints_of(t)?;
        let teeth: [f64; 2] = if t.has("teeth") { t.exactly("teeth")? } else { [1.0, 1.0] };
        let axis = drawn::axis(&self.joints[cage], self.planar);
        let body = drawn::farther(self.joints, cage);
        let housing = self.joints[cage].bodies.into_iter().find(|b| *b != body).flatten();
        let (mut terms, mut gain) = (Vec::new(), 0.0);
        for (number, (joint, teeth)) in [(a, teeth[0]), (b, teeth[1])].into_iter().enumerate() {
            let data = &self.joints[joint];
            let held = [body, housing].into_iter().find(|b| data.bodies.contains(b));
            let moved = match held {
                Some(held) => data.bodies.into_iter().find(|b| *b != held).flatten(),
                None => drawn::farther(self.joints, joint),
            };
            let sign = sense(data, moved, axis, self.planar);
            if number == 0 {
                gain = teeth * sign;
            }
            if held.is_some() || self.turns_beside(joint, moved, axis) {
                terms.push(self.wheel([body, moved], axis, teeth));
            } else {
                // a shaft that leads to a steering knuckle: its rotation in the knuckle, and that of the knuckle's body against the housing
                terms.push(Term::of(joint, only(data, self.planar)?, teeth * sign));
                terms.push(self.wheel([housing, body], axis, -teeth));
            }
        }
        let passed = Some((a, only(&self.joints[a], self.planar)?, 1.0));
        Ok(Sum { gain, passed, ..Sum::plain(terms, 0.0) })
    }

    /// True if the body that carries a wheel rotates about the axis by another joint. A steering knuckle does not.
    fn turns_beside(&self, wheel: usize, moved: Option<usize>, axis: Vector) -> bool {
        let stand = self.joints[wheel].bodies.into_iter().find(|b| *b != moved).flatten();
        let turns = |(j, joint): (usize, &Joint)| {
            j != wheel
                && joint.bodies.contains(&stand)
                && matches!(joint.kind, Kind::Revolute | Kind::Cylindrical)
                && dot(drawn::axis(joint, self.planar), axis).abs() > 1.0 - 1e-9
        };
        stand.is_some() && self.joints.iter().enumerate().any(turns)
    }

    fn mimic(&self, t: &mut Table) -> Read<Sum> {
        let [x, y] = [self.names.joint(&t.text("joint")?)?, self.names.joint(&t.text("of")?)?];
        let factor = t.number_or("factor", 1.0)?;
        let [i, k] = [only(&self.joints[x], self.planar)?, only(&self.joints[y], self.planar)?];
        let terms = vec![Term::of(x, i, 1.0), Term::of(y, k, -factor)];
        Ok(Sum::plain(terms, t.number_or("offset", 0.0)?))
    }

    fn cam(&self, t: &mut Table) -> Read<Sum> {
        let [shaft, follower] = self.joints_of(t)?;
        let Some(lift) = curve(t)? else { return fault("a cam without a curve") };
        let [i, k] =
            [only(&self.joints[shaft], self.planar)?, only(&self.joints[follower], self.planar)?];
        let mut terms = vec![Term::of(follower, k, 1.0), Term::of(shaft, i, -1.0)];
        terms[1].curve = Some(lift);
        Ok(Sum::plain(terms, 0.0))
    }

    fn rope(&self, t: &mut Table) -> Read<Sum> {
        let value = t.number_or("value", 0.0)?;
        if t.has("terms") {
            let terms = terms(t, self.names, self.joints)?;
            return Ok(Sum { gain: -1.0, ..Sum::plain(terms, value) });
        }
        let Measure::Length(points) = crate::read_curve::measure(t, self.names, self.joints)?
        else {
            return fault("a rope needs points");
        };
        let length = match t.take("length") {
            Some(Node::Number(length)) => length - reference_length(&points),
            _ => 0.0,
        };
        let mut seat = Seat::Nowhere;
        let mut of_drum = None;
        if let Some(mut drum) = t.table("drum")? {
            let (joint, radius) = (self.names.joint(&drum.text("joint")?)?, drum.number("radius")?);
            let data = &self.joints[joint];
            let (center, axis) = (data.points[0], drawn::axis(data, self.planar));
            for (is_last, (body, at)) in [(false, points[0]), (true, points[points.len() - 1])] {
                let off = sub(at, center);
                let arm = norm(sub(off, scale(dot(off, axis), axis)));
                let is_rim = (arm - radius.abs()).abs() < AT_RIM * radius.abs();
                if data.bodies.contains(&body) && is_rim {
                    let drum = data.bodies.into_iter().find(|b| *b != body).flatten();
                    seat = Seat::Drum([body, drum], center, axis, is_last);
                }
            }
            of_drum = Some(Term::of(joint, only(data, self.planar)?, radius));
        }
        let line = Term { measure: Measure::Length(points), factor: 1.0, curve: None };
        let terms = [Some(line), of_drum].into_iter().flatten().collect();
        Ok(Sum { gain: -1.0, seat, ..Sum::plain(terms, value + length) })
    }
}

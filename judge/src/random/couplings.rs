//! Couplings of a random scene: gear trains, racks and screws with bodies of their own, and sums of coordinates of existing bodies.

use super::dice::Dice;
use super::draft::Draft;
use super::write::{name, starts, vector};
use crate::scene::{Carrier, Kind};
use crate::vector::{Vector, across, add, cross, dot, norm, scale, sub, unit};

/// Couplings that get bodies of their own. Those of three wheels are last.
const TRAINS: [&str; 6] = ["gear", "belt", "gear on an arm", "rack", "differential", "screw"];
/// Couplings of existing coordinates, each with the probability that a trial draws it. A cam or a screw fits few joints.
const SUMS: [(&str, f64); 6] = [
    ("ratio", 0.12),
    ("mimic", 0.15),
    ("linear", 0.15),
    ("cam", 0.25),
    ("rope", 0.13),
    ("cylindrical screw", 0.2),
];
/// Number of trials of a coupling before it is left out.
const TRIALS: usize = 6;

impl Draft {
    /// Adds a gear train with a probability of 0.3: bodies on one carrier with a coupling.
    pub(crate) fn train(&mut self, dice: &mut Dice) {
        if !dice.chance(0.3) {
            return;
        }
        let kinds = TRAINS.len() - usize::from(self.planar);
        let kind = TRAINS[dice.below(kinds)];
        let base = Some(dice.below(self.bodies.len())).filter(|_| dice.chance(0.6));
        let before = (self.bodies.len(), self.links.len());
        let axis = if self.planar { [0.0, 0.0, 1.0] } else { dice.direction(false) };
        let center = self.point(dice, base);
        let text = match kind {
            "rack" => self.rack(dice, base, axis, center),
            "screw" => self.screw(dice, base, axis, center),
            "differential" => self.differential(dice, base, axis, center),
            _ => self.wheels(dice, base, axis, center, kind),
        };
        let word = kind.split(' ').next().unwrap_or(kind).to_owned();
        self.couplings.push((word, text));
        self.links[before.1..].iter_mut().for_each(|link| link.coupled = true);
        if !self.moves() {
            self.couplings.pop();
            self.bodies.truncate(before.0);
            self.links.truncate(before.1);
        }
    }

    /// Adds a body that rotates about an axis or its opposite.
    pub(super) fn turning(
        &mut self,
        dice: &mut Dice,
        base: Carrier,
        axis: Vector,
        at: Vector,
    ) -> usize {
        self.hang(dice, base, Kind::Revolute, false);
        self.along(dice, axis, at)
    }

    /// Sets the axis of the last joint, with either sign, and its place.
    fn along(&mut self, dice: &mut Dice, axis: Vector, at: Vector) -> usize {
        let size = if dice.chance(0.5) { 1.0 } else { -1.0 } * dice.between(0.5, 2.0);
        let last = self.links.len() - 1;
        let link = &mut self.links[last];
        (link.axes[0], link.points) = (scale(size, axis), [at, at]);
        last
    }

    /// A random place next to another, displaced perpendicular to an axis.
    fn beside(&self, dice: &mut Dice, axis: Vector, at: Vector) -> Vector {
        let [x, y] = across(axis);
        let (sine, cosine) = dice.between(-3.0, 3.0).sin_cos();
        let off =
            scale(self.length * dice.between(0.3, 0.8), add(scale(cosine, x), scale(sine, y)));
        let off = if self.planar { [off[0], off[1], 0.0] } else { off };
        add(at, off)
    }

    fn wheels(
        &mut self,
        dice: &mut Dice,
        base: Carrier,
        axis: Vector,
        at: Vector,
        kind: &str,
    ) -> String {
        let one = self.turning(dice, base, axis, at);
        let mut carrier = base;
        if kind == "gear on an arm" {
            self.turning(dice, base, axis, at);
            carrier = Some(self.bodies.len() - 1);
        }
        let beside = self.beside(dice, axis, at);
        let two = self.turning(dice, carrier, axis, beside);
        let mut pair = [one, two];
        if dice.chance(0.5) {
            pair.reverse();
        }
        let joints = format!("joints = [\"j{}\", \"j{}\"]", pair[0], pair[1]);
        let radii = [0, 1].map(|_| self.length * dice.between(0.1, 0.4));
        if kind == "belt" {
            return format!(
                "kind = \"belt\"\n{joints}\nradii = {radii:?}\ncrossed = {}{}",
                dice.chance(0.3),
                self.pretension(dice, pair, radii)
            );
        }
        let teeth = [15 + dice.below(30), 15 + dice.below(30)];
        let size = if dice.chance(0.5) {
            format!("teeth = {teeth:?}")
        } else {
            format!("radii = {radii:?}")
        };
        let mesh = if dice.chance(0.3) { "internal" } else { "external" };
        let mut text = format!("kind = \"gear\"\n{joints}\n{size}\nmesh = \"{mesh}\"");
        if kind == "gear" && size.starts_with("teeth") && teeth[0] != teeth[1] {
            // the pitch point divides the distance between the axes in the ratio of the teeth
            let [c1, c2] = pair.map(|j| self.links[j].points[0]);
            let [a, b] = teeth.map(|n| n as f64);
            let part = a / if mesh == "internal" { a - b } else { a + b };
            let at = vector(add(c1, scale(part, sub(c2, c1))), self.planar);
            text += &format!("\nat = {at}\npressure_angle = {:?}", dice.between(0.0, 0.5));
        }
        text
    }

    /// Text of a random pretension; empty where the wheels are too close, and for some draws.
    fn pretension(&self, dice: &mut Dice, pair: [usize; 2], radii: [f64; 2]) -> String {
        let unit = self.mass * self.length / (self.time * self.time);
        let [c1, c2] = pair.map(|j| self.links[j].points[0]);
        let is_near = radii[0] + radii[1] > 0.9 * norm(sub(c2, c1));
        if is_near || dice.chance(0.3) {
            return String::new();
        }
        format!("\npretension = {:?}", unit * dice.between(0.1, 2.0))
    }

    fn rack(&mut self, dice: &mut Dice, base: Carrier, axis: Vector, at: Vector) -> String {
        let pinion = self.turning(dice, base, axis, at);
        let place = self.beside(dice, axis, at);
        let off = [0, 1, 2].map(|i| place[i] - at[i]);
        // the rack's line does not meet the axis, and is not quite perpendicular to the line from the axis
        let along = unit(add(unit(cross(axis, off)), scale(0.5 / self.length, off)));
        self.hang(dice, base, Kind::Prismatic, false);
        let rack = self.along(dice, along, place);
        let radius = self.length * dice.between(0.1, 0.4);
        let radius = if dice.chance(0.3) { -radius } else { radius };
        format!("kind = \"rack\"\njoints = [\"j{pinion}\", \"j{rack}\"]\nradius = {radius:?}")
    }

    fn screw(&mut self, dice: &mut Dice, base: Carrier, axis: Vector, at: Vector) -> String {
        let turn = self.turning(dice, base, axis, at);
        let place = self.beside(dice, axis, at);
        self.hang(dice, base, Kind::Prismatic, false);
        let slide = self.along(dice, axis, place);
        let lead = self.length * dice.between(0.2, 1.0);
        format!("kind = \"screw\"\njoints = [\"j{turn}\", \"j{slide}\"]\nlead = {lead:?}")
    }

    /// Adds two wheels and a cage. The carrier of the second wheel is the cage or another body.
    fn differential(&mut self, dice: &mut Dice, base: Carrier, axis: Vector, at: Vector) -> String {
        let cage = self.turning(dice, base, axis, at);
        let body = Some(self.bodies.len() - 1);
        let one = self.turning(dice, base, axis, at);
        let carrier = if dice.chance(0.5) { body } else { base };
        let two = self.turning(dice, carrier, axis, at);
        let mut pair = [one, two];
        if dice.chance(0.5) {
            pair.reverse();
        }
        let teeth = [10 + dice.below(30), 10 + dice.below(30)];
        format!(
            "kind = \"differential\"\njoints = [\"j{}\", \"j{}\", \"j{cage}\"]\nteeth = {teeth:?}",
            pair[0], pair[1]
        )
    }

    /// Adds a coupling of coordinates or points with a probability of 0.35.
    pub(crate) fn couple(&mut self, dice: &mut Dice) {
        if !dice.chance(0.35) {
            return;
        }
        for _ in 0..TRIALS {
            let kind = dice.weighted(&SUMS);
            let Some((joints, text)) = self.sum(dice, kind) else { continue };
            let word = match kind {
                "ratio" => "gear",
                "cylindrical screw" => "screw",
                other => other,
            };
            self.couplings.push((word.to_owned(), text));
            // a coupling with a lift or an offset may have no start near the reference configuration
            let begins = !matches!(kind, "cam" | "mimic" | "linear") || starts(self);
            if begins && self.moves() {
                joints.into_iter().for_each(|j| self.links[j].coupled = true);
                return;
            }
            self.couplings.pop();
        }
    }

    /// Coordinates that a coupling may use: joint, number, and unit, which is one radian or the mechanism's length.
    pub(super) fn coordinates(&self, kinds: &[Kind]) -> Vec<(usize, usize, f64)> {
        let mut list = Vec::new();
        for (j, link) in self.links.iter().enumerate() {
            let [slides, turns] = link.kind.coordinates(self.planar);
            let spins = turns == 3;
            // a closed loop needs a joint that can be cut
            if link.looped || (!kinds.is_empty() && !kinds.contains(&link.kind)) {
                continue;
            }
            list.extend((0..slides).map(|i| (j, i, self.length)));
            list.extend((slides..slides + turns).filter(|_| !spins).map(|i| (j, i, 1.0)));
        }
        list
    }

    /// Draws two coordinates of different joints.
    fn two(&self, dice: &mut Dice, kinds: &[Kind]) -> Option<[(usize, usize, f64); 2]> {
        let list = self.coordinates(kinds);
        if list.is_empty() {
            return None;
        }
        let pair = [0, 1].map(|_| list[dice.below(list.len())]);
        (pair[0].0 != pair[1].0).then_some(pair)
    }

    /// Draws a coupling, with the joints that it constrains.
    fn sum(&mut self, dice: &mut Dice, kind: &str) -> Option<(Vec<usize>, String)> {
        let sign = if dice.chance(0.5) { 1.0 } else { -1.0 };
        let factor = sign * dice.between(0.4, 2.0);
        let single = [Kind::Revolute, Kind::Prismatic];
        match kind {
            "ratio" => {
                let [(a, ..), (b, ..)] = self.two(dice, &[Kind::Revolute])?;
                let text =
                    format!("kind = \"gear\"\njoints = [\"j{a}\", \"j{b}\"]\nratio = {factor:?}");
                Some((vec![a, b], text))
            }
            "mimic" => {
                let [(a, _, u), (b, _, v)] = self.two(dice, &single)?;
                let (factor, offset) = (factor * u / v, u * dice.between(-0.3, 0.3));
                let offset = if dice.chance(0.5) { offset } else { 0.0 };
                let text = format!(
                    "kind = \"mimic\"\njoint = \"j{a}\"\nof = \"j{b}\"\nfactor = {factor:?}\noffset = {offset:?}"
                );
                Some((vec![a, b], text))
            }
            "linear" => {
                let [(a, i, u), (b, k, v)] = self.two(dice, &[])?;
                let law = if dice.chance(0.3) {
                    let amplitude = 0.3 * dice.between(0.1, 1.0);
                    let frequency = dice.between(0.05, 0.3) / self.time;
                    format!("\nsine = {{ amplitude = {amplitude:?}, frequency = {frequency:?} }}")
                } else if dice.chance(0.3) {
                    format!("\nsignal = \"{}\"", self.smooth(dice, 0.3))
                } else {
                    String::new()
                };
                let text = format!(
                    "kind = \"linear\"\nterms = [{{ joint = \"j{a}\", coordinate = {i}, factor = {:?} }}, {{ joint = \"j{b}\", coordinate = {k}, factor = {:?} }}]{law}",
                    1.0 / u,
                    factor / v
                );
                Some((vec![a, b], text))
            }
            "cam" => {
                let [(a, ..), (b, _, u)] = self.two(dice, &single)?;
                if self.links[a].kind != Kind::Revolute {
                    return None;
                }
                let curve = self.lift(dice, u);
                let text = format!("kind = \"cam\"\njoints = [\"j{a}\", \"j{b}\"]\n{curve}");
                Some((vec![a, b], text))
            }
            "rope" => Some((Vec::new(), self.rope(dice)?)),
            _ => {
                let (joint, ..) = *self.coordinates(&[Kind::Cylindrical]).first()?;
                let lead = self.length * factor;
                let text = format!("kind = \"screw\"\njoint = \"j{joint}\"\nlead = {lead:?}");
                Some((vec![joint], text))
            }
        }
    }

    /// Text of a cam's lift in units of the follower: a polynomial, or a periodic table.
    fn lift(&self, dice: &mut Dice, unit: f64) -> String {
        let mut size = |most: f64| unit * dice.between(-most, most);
        if size(1.0) > 0.0 {
            let numbers = [0.0, size(0.6), size(0.3), size(0.1)];
            return format!("coefficients = {numbers:?}");
        }
        let turn = 2.0 * core::f64::consts::PI;
        // the table begins a third of a turn before the reference configuration, at which the lift is zero
        let first = size(0.2);
        let mut row = |i: i32| {
            let x = turn * (f64::from(i) / 6.0 - 1.0 / 3.0);
            match i {
                0 | 6 => [x, first],
                2 => [0.0, 0.0],
                _ => [x, size(0.3)],
            }
        };
        let rows: Vec<[f64; 2]> = (0..7).map(&mut row).collect();
        let how = if dice.chance(0.4) { "monotone" } else { "spline" };
        format!("table = {rows:?}\ninterpolation = \"{how}\"\nperiodic = true")
    }

    /// Text of a rope over two or three points on different bodies, for some draws with a drum.
    fn rope(&mut self, dice: &mut Dice) -> Option<String> {
        let mut points: Vec<(Carrier, Vector)> = Vec::new();
        for _ in 0..2 + dice.below(2) {
            let body = Some(dice.below(self.bodies.len())).filter(|_| dice.chance(0.7));
            // a thin rod has no inertia about its own line: a rope's point off that line would rotate it
            let is_rod = body.is_some_and(|b| self.bodies[b].rod.is_some());
            if is_rod || points.last().is_some_and(|(last, _)| *last == body) {
                return None;
            }
            let point = self.point(dice, body);
            let is_near =
                |(_, last): &(Carrier, Vector)| norm(sub(point, *last)) < 0.4 * self.length;
            if points.last().is_some_and(is_near) {
                return None;
            }
            points.push((body, point));
        }
        let bodies: Vec<Carrier> = points.iter().map(|point| point.0).collect();
        for pair in bodies.windows(2) {
            let one = pair[0].or(pair[1])?;
            self.mark_loop(one, if pair[0].is_some() { pair[1] } else { None });
        }
        let winch = if dice.chance(0.4) { self.winch(dice, &mut points) } else { None };
        let one = |(body, at): &(Carrier, Vector)| {
            format!("{{ body = \"{}\", at = {} }}", name(*body), vector(*at, self.planar))
        };
        let list: Vec<String> = points.iter().map(one).collect();
        let mut text = format!("kind = \"rope\"\npoints = [{}]", list.join(", "));
        let drums = self.coordinates(&[Kind::Revolute]);
        if let Some((joint, radius)) = winch {
            text += &format!("\ndrum = {{ joint = \"j{joint}\", radius = {radius:?} }}");
        } else if dice.chance(0.4) && !drums.is_empty() {
            let joint = drums[dice.below(drums.len())].0;
            let radius = self.length * dice.between(-0.3, 0.3);
            text += &format!("\ndrum = {{ joint = \"j{joint}\", radius = {radius:?} }}");
        }
        Some(text)
    }

    /// Moves the first point of a line to the rim of a drum, where the line is a tangent. Returns the drum's joint and its signed radius.
    fn winch(&self, dice: &mut Dice, points: &mut [(Carrier, Vector)]) -> Option<(usize, f64)> {
        let drums = self.coordinates(&[Kind::Revolute]);
        let joint = drums.get(dice.below(drums.len().max(1)))?.0;
        let link = &self.links[joint];
        let side = dice.below(2);
        let (carrier, next) = (link.bodies[side], points[1]);
        let drum = link.bodies[1 - side]?;
        if next.0 == carrier || next.0 == Some(drum) {
            return None;
        }
        let axis = if self.planar { [0.0, 0.0, 1.0] } else { unit(link.axes[0]) };
        let center = link.points[0];
        let off = sub(next.1, center);
        let across = sub(off, scale(dot(off, axis), axis));
        let radius = self.length * dice.between(0.05, 0.25);
        let cosine = radius / norm(across);
        if cosine > 0.6 {
            return None;
        }
        let e = unit(across);
        let sine = (1.0 - cosine * cosine).sqrt() * if dice.chance(0.5) { 1.0 } else { -1.0 };
        let arm = scale(radius, add(scale(cosine, e), scale(sine, cross(axis, e))));
        points[0] = (carrier, add(center, arm));
        // the sign of the radius: winding shortens the rope against the torque of its pull
        let pull = unit(sub(next.1, points[0].1));
        let turn = dot(cross(arm, pull), axis);
        let order = if side == 0 { 1.0 } else { -1.0 };
        Some((joint, -order * turn.signum() * radius))
    }
}

//! Random bodies, joints, closed loops, guides and initial conditions.

use super::dice::Dice;
use super::draft::{Draft, GRAVITY, Link, Part};
use super::write::{mechanism_of, starts};
use crate::scene::{Carrier, Kind};
use crate::vector::{
    Matrix, Vector, ZERO, across, add, cross, dot, exponential, product, rotation, scale, sub,
    transpose, unit,
};

/// Least pivot of the scaled saddle matrix in the reference configuration [-]. With a smaller pivot the mechanism is nearly locked. Chosen,
/// not tuned.
const NEAR_LOCKED: f64 = 3e-3;

pub(crate) const PLANE: [(Kind, f64); 6] = [
    (Kind::Revolute, 0.42),
    (Kind::Prismatic, 0.18),
    (Kind::PinInSlot, 0.08),
    (Kind::Weld, 0.08),
    (Kind::Free, 0.12),
    (Kind::Distance, 0.12),
];
pub(crate) const SPACE: [(Kind, f64); 10] = [
    (Kind::Revolute, 0.16),
    (Kind::PinInSlot, 0.06),
    (Kind::Prismatic, 0.12),
    (Kind::Cylindrical, 0.12),
    (Kind::Universal, 0.12),
    (Kind::Spherical, 0.12),
    (Kind::Planar, 0.1),
    (Kind::Weld, 0.08),
    (Kind::Free, 0.08),
    (Kind::Distance, 0.08),
];
const PLANE_LOOPS: [(Kind, f64); 4] = [
    (Kind::Revolute, 0.45),
    (Kind::Prismatic, 0.2),
    (Kind::PinInSlot, 0.1),
    (Kind::Distance, 0.25),
];
const SPACE_LOOPS: [(Kind, f64); 8] = [
    (Kind::Revolute, 0.15),
    (Kind::PinInSlot, 0.05),
    (Kind::Prismatic, 0.1),
    (Kind::Cylindrical, 0.1),
    (Kind::Universal, 0.15),
    (Kind::Spherical, 0.2),
    (Kind::Planar, 0.1),
    (Kind::Distance, 0.15),
];

impl Draft {
    /// Draws a tree of bodies.
    pub(crate) fn tree(dice: &mut Dice) -> Self {
        let planar = dice.chance(0.4);
        let length = dice.logarithmic(1e-3, 100.0);
        let gravity = dice.chance(0.75).then(|| scale(GRAVITY, dice.direction(planar)));
        let mass = 1000.0 * length.powi(3) * dice.logarithmic(0.1, 10.0);
        let time = (length / GRAVITY).sqrt();
        let mut draft =
            Self { planar, length, time, mass, gravity, stiffest: 1.0, ..Self::default() };
        let n = 1 + dice.below(if planar { 6 } else { 5 });
        for i in 0..n {
            let parent = if i == 0 || dice.chance(0.15) {
                None
            } else if dice.chance(0.6) {
                Some(i - 1)
            } else {
                Some(dice.below(i))
            };
            draft.add_body(dice, parent);
        }
        draft
    }

    fn away(&self, dice: &mut Dice, low: f64, high: f64) -> Vector {
        scale(self.length * dice.between(low, high), dice.direction(self.planar))
    }

    /// A random point near a body, or near the ground.
    pub(crate) fn point(&self, dice: &mut Dice, body: Carrier) -> Vector {
        add(body.map_or(ZERO, |b| self.bodies[b].center), self.away(dice, 0.1, 0.6))
    }

    fn add_body(&mut self, dice: &mut Dice, parent: Carrier) {
        let kind = dice.weighted(if self.planar { &PLANE[..] } else { &SPACE[..] });
        let thin =
            dice.chance(0.15) && matches!(kind, Kind::Revolute | Kind::Spherical | Kind::Free);
        self.hang(dice, parent, kind, thin);
    }

    /// Adds a body with a joint to its parent.
    pub(crate) fn hang(&mut self, dice: &mut Dice, parent: Carrier, kind: Kind, thin: bool) {
        let at = self.point(dice, parent);
        let center = add(at, self.away(dice, 0.2, 0.6));
        let mass = self.mass * dice.logarithmic(0.1, 3.0);
        let i = self.bodies.len();
        let rod = thin.then(|| [at, add(at, self.away(dice, 0.5, 1.0))]);
        let center = rod.map_or(center, |[a, b]| scale(0.5, add(a, b)));
        let inertia = self.inertia(dice, mass);
        // the output point of a thin rod is on the rod's line, since rotation about this line is undetermined
        let off = self.away(dice, 0.1, 0.3);
        let mark = add(center, rod.map_or(off, |[a, b]| scale(0.2, sub(b, a))));
        self.bodies.push(Part { mass, center, inertia, rod, mark, parent });
        let link = self.link(dice, kind, [parent, Some(i)], at);
        self.links.push(link);
    }

    fn inertia(&self, dice: &mut Dice, mass: f64) -> [f64; 6] {
        let radii = [0, 1, 2].map(|_| self.length * dice.logarithmic(0.05, 0.4));
        if self.planar {
            return [mass * radii[0] * radii[0], 0.0, 0.0, 0.0, 0.0, 0.0];
        }
        let turn = rotation(exponential(scale(3.0, dice.direction(false))));
        let mut s: Matrix = [ZERO; 3];
        (0..3).for_each(|i| s[i][i] = mass * radii[i] * radii[i]);
        let s = product(&product(&turn, &s), &transpose(&turn));
        let all = s[0][0] + s[1][1] + s[2][2];
        [all - s[0][0], all - s[1][1], all - s[2][2], -s[0][1], -s[1][2], -s[2][0]]
    }

    /// A joint between two bodies at a place. The order of its bodies is random.
    fn link(&self, dice: &mut Dice, kind: Kind, bodies: [Carrier; 2], at: Vector) -> Link {
        let axis = dice.direction(self.planar);
        let second = if self.planar { axis } else { scale(1.0, across(axis)[0]) };
        let mut points = [at, at];
        if kind == Kind::Distance {
            points = [at, add(at, self.away(dice, 0.3, 0.8))];
        }
        let hinged = kind == Kind::Distance && !self.planar && dice.chance(0.5);
        let mut bodies = bodies;
        let mut axes = [scale(dice.between(0.5, 2.0), axis), second];
        if hinged {
            // the hinge's axis is nearly perpendicular to the link
            let d = unit(sub(points[1], points[0]));
            axes[0] = unit(add(cross(d, axis), scale(0.2 * dot(axis, d), axis)));
        }
        if dice.chance(0.5) {
            bodies.reverse();
            points.reverse();
        }
        Link {
            kind,
            bodies,
            points,
            axes,
            hinged,
            guide: None,
            value: None,
            rate: None,
            looped: false,
            coupled: false,
        }
    }

    /// Adds up to two closed loops. A loop is left out if it would lock or nearly lock the mechanism.
    pub(crate) fn close(&mut self, dice: &mut Dice) {
        let n = dice.weighted(&[(0, 0.5), (1, 0.3), (2, 0.2)]);
        // a closed loop with a rolling contact is likely to lock
        let n = if self.rollings.is_empty() { n } else { 0 };
        for _ in 0..n {
            for _ in 0..8 {
                let a = dice.below(self.bodies.len());
                let b = if dice.chance(0.5) { None } else { Some(dice.below(self.bodies.len())) };
                let kind =
                    dice.weighted(if self.planar { &PLANE_LOOPS[..] } else { &SPACE_LOOPS[..] });
                let at = self.point(dice, Some(a));
                if b == Some(a) {
                    continue;
                }
                let mut link = self.link(dice, kind, [b, Some(a)], at);
                link.looped = true;
                self.links.push(link);
                if self.moves() {
                    self.mark_loop(a, b);
                    break;
                }
                self.links.pop();
            }
        }
    }

    /// True if the mechanism has a freedom and its reference configuration is not nearly locked.
    pub(crate) fn moves(&self) -> bool {
        let Some(mechanism) = mechanism_of(self) else { return false };
        let reference = mechanism.reference();
        let freedoms = mechanism.freedoms(&reference);
        mechanism.evaluate(&reference).least_pivot > NEAR_LOCKED && freedoms >= 1
    }

    /// Number of freedoms of the mechanism in its reference configuration.
    fn freedoms(&self) -> usize {
        mechanism_of(self).map_or(0, |mechanism| mechanism.freedoms(&mechanism.reference()))
    }

    pub(crate) fn mark_loop(&mut self, a: usize, b: Carrier) {
        let path = |mut body: Carrier| {
            let mut list = Vec::new();
            while let Some(i) = body {
                list.push(i);
                body = self.bodies[i].parent;
            }
            list
        };
        let (one, other) = (path(Some(a)), path(b));
        // in the tree, link i is the joint of body i
        for i in 0..self.bodies.len() {
            if one.contains(&i) != other.contains(&i) {
                self.links[i].looped = true;
            }
        }
    }

    /// Draws guides of joints. A guided joint has a guide for each of its coordinates. Joints that closed loops or couplings constrain are
    /// guided more rarely, and only if the mechanism can then move.
    pub(crate) fn guide(&mut self, dice: &mut Dice) {
        for i in 0..self.links.len() {
            let slide = 0.5 * self.length;
            let sizes: &[f64] = match self.links[i].kind {
                Kind::Revolute => &[1.0],
                Kind::Prismatic => &[slide],
                Kind::Cylindrical => &[slide, 1.0],
                Kind::Universal => &[1.0, 1.0],
                _ => continue,
            };
            let held = self.links[i].looped || self.links[i].coupled;
            if !dice.chance(if held { 0.04 } else { 0.15 }) {
                continue;
            }
            let mut laws = sizes.iter().enumerate().map(|(k, size)| {
                let law = self.law(dice, *size, i % 2 == 0);
                format!("coordinate = {k}\n{law}")
            });
            // the first law belongs to the guide's header, which is already written
            let first = laws.next().unwrap_or_default();
            let rest = laws.map(|law| format!("\n\n[[guide]]\njoint = \"j{i}\"\n{law}"));
            let guide = first + &rest.collect::<String>();
            let before = self.freedoms();
            self.links[i].guide = Some(guide);
            // a coordinate that a closed loop locks cannot be guided
            let takes = self.freedoms() + sizes.len() == before;
            if held && !(takes && self.moves() && starts(self)) {
                self.links[i].guide = None;
            }
        }
    }

    /// Text of a random motion of a guide.
    fn law(&mut self, dice: &mut Dice, size: f64, is_level: bool) -> String {
        match dice.below(4) {
            0 => {
                let (amplitude, frequency) =
                    (size * dice.between(0.1, 0.6), dice.between(0.05, 0.3) / self.time);
                let phase = dice.between(-1.5, 1.5);
                format!(
                    "sine = {{ amplitude = {amplitude:?}, frequency = {frequency:?}, phase = {phase:?} }}"
                )
            }
            1 => format!("ramp = {{ rate = {:?} }}", size * dice.between(-0.5, 0.5) / self.time),
            2 => format!("signal = \"{}\"", self.smooth(dice, size)),
            _ => {
                let row = |k: i32, dice: &mut Dice| {
                    let t = 3.0 * self.time * f64::from(k);
                    format!("[{t:?}, {:?}]", size * dice.between(-0.3, 0.3))
                };
                let rows: Vec<String> = (-1..6).map(|k| row(k, dice)).collect();
                let ends = if is_level { "\nends = \"level\"" } else { "" };
                let how = if dice.chance(0.3) { "monotone" } else { "spline" };
                format!("table = [{}]\ninterpolation = \"{how}\"{ends}", rows.join(", "))
            }
        }
    }

    /// Draws one number for each coordinate of the kind: angles, and displacements in lengths of the mechanism.
    pub(crate) fn numbers(&self, dice: &mut Dice, kind: Kind, turn: f64, slide: f64) -> Vec<f64> {
        let [slides, turns] = kind.coordinates(self.planar);
        let slide = slide * self.length;
        let mut some = |n: usize, most: f64| -> Vec<f64> {
            (0..n).map(|_| dice.between(-most, most)).collect()
        };
        [some(slides, slide), some(turns, turn)].concat()
    }

    /// Draws initial values and rates of some joints. Some draws also give velocities of a body. Contradictory conditions are left out.
    pub(crate) fn start(&mut self, dice: &mut Dice) {
        for i in 0..self.links.len() {
            let (planar, kind) = (self.planar, self.links[i].kind);
            let looped = self.links[i].looped || self.links[i].coupled;
            if self.links[i].guide.is_some() {
                continue;
            }
            // with couplings, large values give several local minima of the change from the reference configuration, so values are small
            let apart = self.couplings.is_empty() && self.rollings.is_empty();
            let size = if looped {
                0.2
            } else if apart {
                1.0
            } else {
                0.4
            };
            let (value, rate) = (
                self.numbers(dice, kind, size * 1.4, size * 0.4),
                self.numbers(dice, kind, size * 1.5 / self.time, size * 0.7 / self.time),
            );
            let spins = kind.coordinates(planar)[1] == 3;
            let rods = self.links[i].bodies.iter().flatten().any(|&b| self.bodies[b].rod.is_some());
            if value.is_empty() || (spins && rods) {
                continue;
            }
            let share = if looped { 0.25 } else { 0.6 };
            self.links[i].value = dice.chance(share).then_some(value);
            if looped && self.links[i].value.is_some() && !starts(self) {
                self.links[i].value = None;
            }
            self.links[i].rate = dice.chance(share).then_some(rate);
            if looped && self.links[i].rate.is_some() && !starts(self) {
                self.links[i].rate = None;
            }
        }
        self.throw(dice);
        if !starts(self) {
            for link in &mut self.links {
                (link.value, link.rate) = (None, None);
            }
        }
    }

    /// Draws initial velocities of a body, with a probability of 0.15.
    fn throw(&mut self, dice: &mut Dice) {
        if dice.chance(0.15) {
            let b = dice.below(self.bodies.len());
            let speed = self.length / self.time;
            let v = scale(speed * dice.between(0.1, 1.0), dice.direction(self.planar));
            let block = if dice.chance(0.5) {
                let at = super::write::vector(self.bodies[b].mark, self.planar);
                format!(
                    "[[initial]]\nbody = \"b{b}\"\nat = {at}\nvelocity = {}",
                    super::write::vector(v, self.planar)
                )
            } else {
                let w = scale(1.0 / self.length, v);
                let w = if self.planar {
                    format!("{:?}", w[0])
                } else {
                    super::write::vector(w, false)
                };
                format!("[[initial]]\nbody = \"b{b}\"\nangular_velocity = {w}")
            };
            self.blocks.push(block);
            if !starts(self) {
                self.blocks.pop();
            }
        }
    }
}

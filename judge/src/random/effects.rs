//! Random effects as text, in units of the mechanism's mass, length and time.

use super::dice::Dice;
use super::draft::{Draft, GRAVITY};
use super::write::{name, pair, vector};
use crate::scene::{Carrier, Kind};
use crate::vector::{norm, scale, sub};

/// The kinds of effect.
pub(crate) const KINDS: [&str; 22] = [
    "spring-damper",
    "polynomial-spring",
    "polynomial-damper",
    "bumper",
    "actuator",
    "bushing",
    "torsion-spring",
    "torque-joint",
    "torque-body",
    "limit",
    "friction",
    "force",
    "force-body",
    "aero-drag",
    "speed-hold",
    "tire",
    "tire-side",
    "actuator-table",
    "spring-points",
    "polynomial-points",
    "actuator-points",
    "tire-slip",
];

/// Draws up to five effects, each on bodies or joints on which it can act.
pub(crate) fn draw(dice: &mut Dice, draft: &mut Draft) {
    let n = dice.below(6);
    let mut wheels = 0;
    for i in 0..n {
        let kind = KINDS[dice.below(KINDS.len())];
        wheels += usize::from(kind.starts_with("tire"));
        let made = Effects { dice, draft, focus: None }.one(kind);
        if let Some(text) = made {
            draft.blocks.push(format!("[[effect]]\nname = \"e{i}\"\n{text}"));
        }
    }
    if wheels > 0 && dice.chance(0.6) {
        let text = road(dice, draft);
        draft.blocks.push(text);
    }
}

fn road(dice: &mut Dice, draft: &Draft) -> String {
    let l = draft.length;
    let start = l * dice.between(-2.0, 1.0);
    let speed = if dice.chance(0.3) { l / draft.time * dice.between(0.0, 1.0) } else { 0.0 };
    let feature = match dice.below(3) {
        0 => format!(
            "kind = \"ramp\", start = {start:?}, length = {:?}, height = {:?}, rounding = {:?}",
            4.0 * l,
            0.3 * l,
            1.5 * l
        ),
        1 => format!(
            "kind = \"bump\", start = {start:?}, length = {:?}, amplitude = {:?}",
            5.0 * l,
            0.1 * l
        ),
        _ => format!("kind = \"flat\", height = {:?}", l * dice.between(-0.1, 0.1)),
    };
    format!("[road]\nspeed = {speed:?}\nfeatures = [{{ {feature} }}]")
}

/// Source of random effects for a draft. `focus` may name the body and the joint on which they act.
pub(crate) struct Effects<'a> {
    pub(crate) dice: &'a mut Dice,
    pub(crate) draft: &'a mut Draft,
    pub(crate) focus: Option<(usize, usize)>,
}

impl Effects<'_> {
    fn body(&mut self) -> usize {
        match self.focus {
            Some((body, _)) => body,
            None => self.dice.below(self.draft.bodies.len()),
        }
    }

    /// Picks a body other than `a`, or the ground.
    fn other(&mut self, a: usize) -> Carrier {
        Some(self.dice.below(self.draft.bodies.len())).filter(|b| *b != a)
    }

    /// Draws two bodies with a point on each; one may be the ground. Returns their keys as text, and the distance of the points.
    fn line(&mut self) -> (String, f64) {
        let a = self.body();
        let b = self.other(a);
        let mut ends =
            [(Some(a), self.draft.point(self.dice, Some(a))), (b, self.draft.point(self.dice, b))];
        if self.dice.chance(0.5) {
            ends.reverse();
        }
        let length = norm(sub(ends[1].1, ends[0].1));
        let [p, q] = ends.map(|e| vector(e.1, self.draft.planar));
        (format!("bodies = {}\npoints = [{p}, {q}]\n", pair(ends.map(|e| e.0))), length)
    }

    /// Draws a line over three points of two bodies. Returns its keys as text, and its length; `None` for thin rods, which the line's force
    /// would rotate about their own lines.
    fn points(&mut self) -> Option<(String, f64)> {
        let a = self.body();
        let b = self.other(a);
        if [Some(a), b].into_iter().flatten().any(|body| self.draft.bodies[body].rod.is_some()) {
            return None;
        }
        let places = [Some(a), b, Some(a)].map(|body| (body, self.draft.point(self.dice, body)));
        let parts = places.windows(2).map(|pair| norm(sub(pair[1].1, pair[0].1)));
        let length = parts.sum();
        let points = places.map(|(body, at)| {
            let at = vector(at, self.draft.planar);
            format!("{{ body = \"{}\", at = {at} }}", name(body))
        });
        Some((format!("points = [{}]\n", points.join(", ")), length))
    }

    /// A rope that pulls when it is longer than roughly its length in the reference configuration.
    fn elastic_rope(&mut self) -> Option<String> {
        let (points, length) = self.points()?;
        let [k, c] = self.spring();
        let free = length * self.dice.between(0.6, 1.05);
        Some(format!(
            "kind = \"spring-damper\"\n{points}stiffness = {k:?}\ndamping = {c:?}\nfree_length = {free:?}\npulls_only = true"
        ))
    }

    /// Draws a stiffness, from a random frequency, and a damping, from a random damping ratio.
    fn spring(&mut self) -> [f64; 2] {
        let frequency = self.dice.logarithmic(0.5, 8.0);
        self.draft.stiffest = self.draft.stiffest.max(frequency);
        let w = frequency / self.draft.time;
        [self.draft.mass * w * w, 2.0 * self.dice.between(0.0, 0.3) * self.draft.mass * w]
    }

    /// A force of the order of the mechanism's weight.
    fn force(&mut self, low: f64) -> f64 {
        let unit = self.draft.mass * self.draft.length / (self.draft.time * self.draft.time);
        unit * self.dice.between(low, 1.0)
    }

    fn joint(&mut self, kinds: &[Kind]) -> Option<usize> {
        let fits = |i: &usize| {
            let link = &self.draft.links[*i];
            kinds.contains(&link.kind)
                || (link.kind == Kind::Free
                    && self.draft.planar
                    && kinds.contains(&Kind::Cylindrical))
        };
        let list: Vec<usize> = (0..self.draft.links.len()).filter(fits).collect();
        if let Some((_, joint)) = self.focus {
            return list.contains(&joint).then_some(joint);
        }
        if list.is_empty() { None } else { Some(list[self.dice.below(list.len())]) }
    }

    /// A constant value, or a table over the run's time.
    fn signal(&mut self, mut one: impl FnMut(&mut Self) -> String) -> String {
        if self.dice.chance(0.6) {
            let value = one(self);
            return format!("value = {value}");
        }
        let rows: Vec<String> = (0..4)
            .map(|k| {
                let value = one(self);
                format!("[{:?}, {value}]", f64::from(k) * 0.7 * self.draft.time)
            })
            .collect();
        format!("table = [{}]", rows.join(", "))
    }

    #[allow(clippy::too_many_lines, reason = "one arm for each kind")]
    pub(crate) fn one(&mut self, kind: &str) -> Option<String> {
        match kind {
            "spring-damper" => Some(self.spring_damper()),
            "polynomial-spring" => Some(self.polynomial_spring()),
            "polynomial-damper" => Some(self.polynomial_damper()),
            "bumper" => Some(self.bumper()),
            "actuator" => {
                let (line, _) = self.line();
                let value = self.force(-1.0);
                Some(format!("kind = \"actuator\"\n{line}value = {value:?}"))
            }
            "actuator-table" => {
                let (line, _) = self.line();
                let signal = self.signal(|e| format!("{:?}", e.force(-1.0)));
                Some(format!("kind = \"actuator\"\n{line}{signal}"))
            }
            "bushing" => Some(self.bushing()),
            "torsion-spring" => self.torsion_spring(),
            "torque-joint" => {
                let j = self.joint(&[Kind::Revolute, Kind::Cylindrical, Kind::Planar])?;
                let length = 0.3 * self.draft.length;
                let signal = self.signal(|e| format!("{:?}", e.force(-1.0) * length));
                Some(format!("kind = \"torque\"\njoint = \"j{j}\"\n{signal}"))
            }
            "torque-body" => {
                let (b, length) = (self.body(), 0.3 * self.draft.length);
                let signal = self.signal(|e| {
                    let size = e.force(-1.0) * length;
                    let v = scale(size, e.dice.direction(e.draft.planar));
                    if e.draft.planar { format!("{size:?}") } else { vector(v, false) }
                });
                Some(format!("kind = \"torque\"\nbody = \"b{b}\"\n{signal}"))
            }
            "rotor" => self.rotor(),
            "limit" => self.limit(),
            "friction" => self.friction(),
            "force" | "force-body" => {
                let b = self.body();
                let at = vector(self.draft.point(self.dice, Some(b)), self.draft.planar);
                let signal = self.signal(|e| {
                    let size = e.force(-1.0);
                    vector(scale(size, e.dice.direction(e.draft.planar)), e.draft.planar)
                });
                let frame = if kind == "force" { "" } else { "frame = \"body\"\n" };
                Some(format!("kind = \"force\"\nbody = \"b{b}\"\nat = {at}\n{frame}{signal}"))
            }
            "aero-drag" => {
                let b = self.body();
                let at = vector(self.draft.point(self.dice, Some(b)), self.draft.planar);
                let area =
                    self.draft.mass / (1.2 * self.draft.length) * self.dice.between(0.1, 1.0);
                Some(format!(
                    "kind = \"aero-drag\"\nbody = \"b{b}\"\nat = {at}\narea_coefficient = {area:?}"
                ))
            }
            "speed-hold" => {
                let b = self.body();
                let direction = vector(self.dice.direction(self.draft.planar), self.draft.planar);
                let speed = self.draft.length / self.draft.time * self.dice.between(-1.0, 1.0);
                let gain = self.draft.mass / self.draft.time * self.dice.between(0.1, 1.0);
                let limit = self.force(0.2);
                Some(format!(
                    "kind = \"speed-hold\"\nbody = \"b{b}\"\ndirection = {direction}\nspeed = {speed:?}\ngain = {gain:?}\nlimit = {limit:?}"
                ))
            }
            "spring-points" => self.elastic_rope(),
            "polynomial-points" => {
                let (points, l) = self.points()?;
                let ([k1, _], [k2, _]) = (self.spring(), self.spring());
                let end = 3.0 * l;
                Some(format!(
                    "kind = \"polynomial-spring\"\n{points}coefficients = [[0.0, {l:?}, {:?}, {k1:?}], [{l:?}, {end:?}, {:?}, {k2:?}]]",
                    -k1 * l,
                    -k2 * l
                ))
            }
            "actuator-points" => {
                let (points, _) = self.points()?;
                let value = self.force(-1.0);
                Some(format!("kind = \"actuator\"\n{points}value = {value:?}"))
            }
            _ => Some(self.tire(kind)),
        }
    }

    /// Returns a rotor whose inertia at the joint is of the order of a body's, on joints with one rotation or translation.
    fn rotor(&mut self) -> Option<String> {
        let j = self.joint(&[Kind::Revolute, Kind::Prismatic])?;
        let ratio = self.dice.logarithmic(5.0, 200.0);
        let mut inertia = self.draft.mass * self.dice.between(0.1, 1.0);
        if self.draft.links[j].kind == Kind::Revolute {
            inertia *= 0.1 * self.draft.length * self.draft.length;
        }
        let inertia = inertia / (ratio * ratio);
        Some(format!(
            "kind = \"rotor\"\njoint = \"j{j}\"\ninertia = {inertia:?}\nratio = {ratio:?}"
        ))
    }

    fn spring_damper(&mut self) -> String {
        let (line, length) = self.line();
        let [k, c] = self.spring();
        let free = length * self.dice.between(0.5, 1.2);
        format!(
            "kind = \"spring-damper\"\n{line}stiffness = {k:?}\ndamping = {c:?}\nfree_length = {free:?}"
        )
    }

    fn polynomial_spring(&mut self) -> String {
        let (line, l) = self.line();
        let ([k1, _], [k2, _]) = (self.spring(), self.spring());
        let k3 = 0.3 * k2 / self.draft.length;
        let direction = self.along();
        let end = 3.0 * l;
        let (a, b, c) = (k3 * l * l - k2 * l, k2 - 2.0 * k3 * l, k3);
        format!(
            "kind = \"polynomial-spring\"\n{line}{direction}coefficients = [[0.0, {l:?}, {:?}, {k1:?}], [{l:?}, {end:?}, {a:?}, {b:?}, {c:?}]]",
            -k1 * l
        )
    }

    fn polynomial_damper(&mut self) -> String {
        let (line, _) = self.line();
        let direction = self.along();
        let v = self.draft.length / self.draft.time;
        let c = 0.3 * self.draft.mass / self.draft.time;
        let (one, other) = (c * self.dice.between(0.1, 1.0), c * self.dice.between(0.1, 1.0));
        let low = -v;
        format!(
            "kind = \"polynomial-damper\"\n{line}{direction}coefficients = [[{low:?}, 0.0, 0.0, {one:?}], [0.0, {v:?}, 0.0, {other:?}]]"
        )
    }

    fn along(&mut self) -> String {
        if self.dice.chance(0.6) {
            return String::new();
        }
        format!(
            "direction = {}\n",
            vector(self.dice.direction(self.draft.planar), self.draft.planar)
        )
    }

    fn bumper(&mut self) -> String {
        let (line, length) = self.line();
        let [k, c] = self.spring();
        let c = if self.dice.chance(0.5) { c } else { 0.0 };
        let clearance = length * self.dice.between(-0.1, 0.2);
        format!(
            "kind = \"bumper\"\n{line}stiffness = {k:?}\ndamping = {c:?}\nclearance = {clearance:?}"
        )
    }

    fn bushing(&mut self) -> String {
        let a = self.body();
        let mut bodies = [Some(a), self.other(a)];
        if self.dice.chance(0.5) {
            bodies.reverse();
        }
        let at = vector(self.draft.point(self.dice, Some(a)), self.draft.planar);
        let l2 = 0.1 * self.draft.length * self.draft.length;
        let mut k = Vec::new();
        let mut c = Vec::new();
        for i in 0..if self.draft.planar { 3 } else { 6 } {
            let turns = i >= if self.draft.planar { 2 } else { 3 };
            let [stiffness, damping] = self.spring();
            k.push(stiffness * if turns { l2 } else { 1.0 });
            c.push(damping * if turns { l2 } else { 1.0 });
        }
        let damping =
            if self.dice.chance(0.6) { format!("\ndamping = {c:?}") } else { String::new() };
        format!(
            "kind = \"bushing\"\nbodies = {}\nat = {at}\nstiffness = {k:?}{damping}",
            pair(bodies)
        )
    }

    fn torsion_spring(&mut self) -> Option<String> {
        let j = self.joint(&[Kind::Revolute, Kind::Cylindrical, Kind::Planar])?;
        let [k, c] = self.spring();
        let l2 = 0.1 * self.draft.length * self.draft.length;
        let (k, c, free) = (k * l2, c * l2, self.dice.between(-1.0, 1.0));
        Some(format!(
            "kind = \"torsion-spring\"\njoint = \"j{j}\"\nstiffness = {k:?}\ndamping = {c:?}\nfree_value = {free:?}"
        ))
    }

    fn limit(&mut self) -> Option<String> {
        let j = self.joint(&[Kind::Revolute, Kind::Prismatic])?;
        let [k, c] = self.spring();
        let turns = self.draft.links[j].kind == Kind::Revolute;
        let (unit, inertia) = if turns {
            (1.0, 0.1 * self.draft.length * self.draft.length)
        } else {
            (0.4 * self.draft.length, 1.0)
        };
        let (lower, upper) =
            (unit * self.dice.between(-1.2, -0.1), unit * self.dice.between(0.1, 1.2));
        let (k, c) = (k * inertia, c * inertia * f64::from(u8::from(self.dice.chance(0.5))));
        Some(format!(
            "kind = \"limit\"\njoint = \"j{j}\"\nlower = {lower:?}\nupper = {upper:?}\nstiffness = {k:?}\ndamping = {c:?}"
        ))
    }

    fn friction(&mut self) -> Option<String> {
        let j = self.joint(&[Kind::Revolute, Kind::Prismatic])?;
        let turns = self.draft.links[j].kind == Kind::Revolute;
        let unit = if turns { 0.3 * self.draft.length } else { 1.0 };
        let rate = if turns { 1.0 } else { self.draft.length } / self.draft.time;
        let coulomb = 0.3 * unit * self.force(0.1);
        let e = rate * self.dice.between(0.1, 0.3);
        let mut text = format!(
            "kind = \"friction\"\njoint = \"j{j}\"\ncoulomb = {coulomb:?}\nregularisation = {e:?}"
        );
        if self.dice.chance(0.5) {
            text += &format!("\nstatic = {:?}", coulomb * self.dice.between(1.0, 1.5));
            text += &format!("\nviscous = {:?}", coulomb / rate * self.dice.between(0.0, 0.5));
        }
        Some(text)
    }

    /// A wheel on the level road, with a depth of a tenth of its radius, or near the road.
    fn tire(&mut self, kind: &str) -> String {
        let slips = kind == "tire-slip";
        let side = kind == "tire-side" || (slips && self.dice.chance(0.5));
        let (b, p) = (self.body(), self.draft.planar);
        let l = self.draft.length;
        let radius = 0.4 * l;
        let mut center = self.draft.point(self.dice, Some(b));
        center[if p { 1 } else { 2 }] = radius * self.dice.between(0.7, 1.1);
        let [k, c] = self.spring();
        let mut text = format!(
            "kind = \"tire\"\nbody = \"{}\"\ncenter = {}\nradius = {radius:?}\nstiffness = {k:?}\ndamping = {c:?}",
            name(Some(b)),
            vector(center, p)
        );
        if slips {
            let stiffness = self.draft.mass * GRAVITY * self.dice.between(1.0, 10.0);
            let friction = self.dice.between(0.3, 1.0);
            text += &format!(
                "\nlongitudinal = {{ stiffness = {stiffness:?}, friction = {friction:?} }}"
            );
        }
        if p {
            return text;
        }
        if side || slips || self.dice.chance(0.5) {
            let axis = self.dice.direction(true);
            let axis = [axis[0], axis[1], self.dice.between(-0.3, 0.3)];
            text += &format!(
                "\naxis = {}\nrolling_resistance = {:?}",
                vector(axis, false),
                self.dice.between(0.0, 0.1)
            );
        }
        if side {
            // coefficients of the Iltis, scaled from loads of 5 kN to those of this wheel
            let s = self.draft.mass * 9.81 / 5000.0;
            text += &format!(
                "\nside = \"calspan\"\ncoefficients = {{ a = [{:?}, 14.47, {:?}, 2.29, {:?}], omega = 1.0, b = [{:?}, 1.216, {:?}], skid = 1.0274, trail = [{:?}, {:?}] }}",
                2625.0 * s,
                12930.0 * s,
                18175.0 * s,
                -0.464e-4 / s,
                2.18e-11 / (s * s),
                -0.171e-4 * l / s,
                0.171e-4 * l / s
            );
        }
        text
    }
}

//! Random rolling contacts: a disc or a ball on a plane, an axle with two wheels, a blade.

use super::dice::Dice;
use super::draft::Draft;
use super::write::{name, vector};
use crate::scene::{Carrier, Kind};
use crate::vector::{Vector, across, add, dot, scale, sub, unit};

/// Kinds of contacts that are drawn. Those that need space are last.
const KINDS: [&str; 4] = ["wheel", "blade", "ball", "axle"];
/// Direction of the height of a level plane in space.
const UP: Vector = [0.0, 0.0, 1.0];

impl Draft {
    /// Adds a free body with its contact, with a probability of 0.25.
    pub(crate) fn roll(&mut self, dice: &mut Dice) {
        if !dice.chance(0.25) {
            return;
        }
        let kind = KINDS[dice.below(if self.planar { 2 } else { 4 })];
        let before = (self.bodies.len(), self.links.len());
        let on = Some(dice.below(self.bodies.len())).filter(|_| dice.chance(0.2));
        self.hang(dice, None, Kind::Free, false);
        match kind {
            "blade" => self.blade(dice),
            "axle" => self.axle(dice),
            _ => self.round(dice, kind == "ball", on),
        }
        self.links[before.1..].iter_mut().for_each(|link| link.coupled = true);
        if !self.moves() {
            self.rollings.clear();
            self.bodies.truncate(before.0);
            self.links.truncate(before.1);
        }
    }

    /// The last body, with a point near its centre of mass.
    fn last(&self, dice: &mut Dice) -> (usize, Vector) {
        let body = self.bodies.len() - 1;
        let off = scale(0.1 * self.length, dice.direction(self.planar));
        (body, add(self.bodies[body].center, off))
    }

    /// Adds a blade on the ground. The plane is fixed, since a blade on a rotating plane might become normal to it.
    fn blade(&mut self, dice: &mut Dice) {
        let (body, at) = self.last(dice);
        let p = self.planar;
        let direction = dice.direction(true);
        let tilt = if p { 0.0 } else { dice.between(-0.5, 0.5) };
        let text = format!(
            "kind = \"blade\"\nbody = \"b{body}\"\nat = {}\ndirection = {}",
            vector(at, p),
            vector([direction[0], direction[1], tilt], p)
        );
        self.rollings.push(text);
    }

    /// Adds a disc or a ball, on a level plane or on a random one.
    fn round(&mut self, dice: &mut Dice, is_ball: bool, on: Carrier) {
        let (body, center) = self.last(dice);
        let p = self.planar;
        let radius = self.length * dice.between(0.15, 0.5);
        let level = dice.chance(0.5);
        let up = if p { [0.0, 1.0, 0.0] } else { UP };
        let normal = if level { up } else { dice.direction(p) };
        // the axis of a disc is inclined a little
        let [x, _] = across(normal);
        let lean = dice.between(-0.4, 0.4);
        let axis = if p { UP } else { unit(add(x, scale(lean, normal))) };
        let down = if is_ball { normal } else { sub(normal, scale(dot(normal, axis), axis)) };
        let point = sub(center, scale(radius, unit(down)));
        let mut text = format!(
            "kind = \"{}\"\nbody = \"b{body}\"\non = \"{}\"\ncenter = {}\nradius = {radius:?}",
            if is_ball { "ball" } else { "wheel" },
            name(on),
            vector(center, p)
        );
        if !is_ball && !p {
            let size = dice.between(0.5, 2.0);
            text += &format!("\naxis = {}", vector(scale(size, axis), false));
        }
        if !level {
            let (point, normal) =
                (vector(point, p), vector(scale(dice.between(0.5, 2.0), normal), p));
            text += &format!("\nplane = {{ point = {point}, normal = {normal} }}");
        }
        self.rollings.push(text);
    }

    /// Adds two wheels to the last body. Their rows depend on each other.
    fn axle(&mut self, dice: &mut Dice) {
        let (body, center) = self.last(dice);
        let axis = dice.direction(true);
        let radius = self.length * dice.between(0.15, 0.4);
        let half = self.length * dice.between(0.2, 0.5);
        for side in [half, -half] {
            let place = add(center, scale(side, axis));
            let wheel = self.turning(dice, Some(body), axis, place);
            // in the tree, a body and its joint have the same number
            let text = format!(
                "kind = \"wheel\"\nbody = \"b{wheel}\"\ncenter = {}\naxis = {}\nradius = {radius:?}",
                vector(place, false),
                vector(axis, false)
            );
            self.rollings.push(text);
        }
    }
}

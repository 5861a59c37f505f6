//! Reads effects of a scene.

use crate::names::Names;
use crate::node::{Node, Read, Table, fault};
use crate::read_curve::{effect_sum, points};
use crate::read_signal::given;
use crate::scene::{Calspan, Effect, Given, Joint, Line, Measure, Path, Scene, Term, Tire};
use crate::vector::unit;

/// Reader of the effects of a scene.
pub(crate) struct Reader<'a> {
    pub(crate) names: &'a Names,
    pub(crate) scene: &'a mut Scene,
}

impl Reader<'_> {
    /// Reads an effect, and adds it to the scene if it is enabled.
    pub(crate) fn effect(&mut self, mut table: Table, number: usize) -> Read<()> {
        let name = match table.take("name") {
            Some(Node::Text(name)) => name,
            _ => format!("effect-{}", number + 1),
        };
        let enabled = !matches!(table.take("enabled"), Some(Node::Flag(false)));
        let kind = table.text("kind")?;
        let t = &mut table;
        let open = [!t.has("stiffness"), !t.has("stiffness") && !t.has("damping")];
        let effect = match self.on_path(&kind, t)? {
            Some(effect) => effect,
            None => self.on_bodies(&kind, t)?,
        };
        table.done(&kind)?;
        if enabled {
            if matches!(effect, Effect::Limit(..)) && open[0] {
                self.scene.open_limits.push((self.scene.effects.len(), open));
            }
            self.scene.effects.push(effect);
            self.scene.effect_names.push(name);
        }
        Ok(())
    }

    fn sum(&self, t: &mut Table) -> Read<Vec<Term>> {
        effect_sum(t, self.names, &self.scene.joints)
    }

    /// The path of an effect: a sum, a line over points, or the distance of two points.
    fn path(&self, t: &mut Table) -> Read<Path> {
        if t.has("terms") || t.has("joint") {
            return Ok(Path::Sum(self.sum(t)?));
        }
        if t.has("bodies") {
            return Ok(Path::Ends(line(t, self.names)?));
        }
        Ok(Path::Points(points(t, self.names)?))
    }

    /// Reads an effect that measures one number and whose force acts along the gradient of that number.
    fn on_path(&self, kind: &str, t: &mut Table) -> Read<Option<Effect>> {
        Ok(Some(match kind {
            "spring-damper" | "torsion-spring" => {
                let path = self.path(t)?;
                let pulls = matches!(t.take("pulls_only"), Some(Node::Flag(true)));
                let free = match (&path, t.take("free_length")) {
                    (Path::Sum(_), None) => t.number_or("free_value", 0.0)?,
                    (_, Some(Node::Number(free))) => free,
                    (Path::Ends(_), None) if !pulls => 0.0,
                    _ => path.reference(),
                };
                let (k, c) = (t.number_or("stiffness", 0.0)?, t.number_or("damping", 0.0)?);
                Effect::Spring(path, [k, c, free], pulls)
            }
            "polynomial-spring" | "polynomial-damper" => {
                let list = t.need("coefficients")?;
                let pieces: Vec<Vec<f64>> =
                    list.list()?.iter().map(Node::numbers).collect::<Read<_>>()?;
                if pieces.iter().any(|p| p.len() < 3) {
                    return fault("a piece has [lower, upper, c0, ...]");
                }
                Effect::Polynomial(self.path(t)?, pieces, kind == "polynomial-damper")
            }
            "bumper" => {
                let line = line(t, self.names)?;
                let c = t.number_or("damping", 0.0)?;
                Effect::Bumper(line, [t.number("stiffness")?, c, t.number("clearance")?])
            }
            "actuator" => Effect::Push(self.path(t)?, given(t, &self.scene.signals, false)?),
            "torque" if !t.has("body") => {
                Effect::Push(Path::Sum(self.sum(t)?), given(t, &self.scene.signals, false)?)
            }
            "limit" => self.limit(t)?,
            "friction" => {
                let coulomb = t.number("coulomb")?;
                let sticking = t.number_or("static", coulomb)?;
                let regularisation = t.number_or("regularisation", 1e-3)?;
                let stribeck = t.number_or("stribeck", 10.0 * regularisation)?;
                let viscous = t.number_or("viscous", 0.0)?;
                let numbers = [coulomb, sticking, stribeck, viscous, regularisation];
                let has_factor = ["value", "table", "signal"].iter().any(|key| t.has(key));
                let factor = if has_factor {
                    given(t, &self.scene.signals, false)?
                } else {
                    Given::Constant([1.0, 0.0, 0.0])
                };
                Effect::Friction(self.sum(t)?, numbers, factor)
            }
            "rotor" => {
                let (inertia, ratio) = (t.number("inertia")?, t.number("ratio")?);
                match self.sum(t)?.as_slice() {
                    [Term { measure: Measure::Coordinate(joint, number), .. }] => {
                        Effect::Rotor(*joint, *number, inertia * ratio * ratio)
                    }
                    _ => return fault("a rotor turns with a coordinate of a joint"),
                }
            }
            _ => return Ok(None),
        }))
    }

    /// Reads stops of a sum, or of a joint's coordinate. With `range = true` the stops are at the ends of the joint's range.
    fn limit(&self, t: &mut Table) -> Read<Effect> {
        let sum = self.sum(t)?;
        let is_range = matches!(t.take("range"), Some(Node::Flag(true)));
        let [lower, upper] = match sum.first().map(|term| &term.measure) {
            Some(Measure::Coordinate(joint, _)) if is_range => {
                match self.scene.joints[*joint].range {
                    Some(range) => range,
                    None => return fault("a joint without a range"),
                }
            }
            // a swing is positive and needs no lower end
            Some(Measure::Ball(_, _, false)) => {
                [t.number_or("lower", f64::MIN)?, t.number("upper")?]
            }
            _ => [t.number("lower")?, t.number("upper")?],
        };
        let (k, c) = (t.number_or("stiffness", 0.0)?, t.number_or("damping", 0.0)?);
        Ok(Effect::Limit(sum, [lower, upper, k, c]))
    }

    /// Reads an effect that acts on bodies by forces and moments.
    fn on_bodies(&self, kind: &str, t: &mut Table) -> Read<Effect> {
        let (names, scene) = (self.names, &*self.scene);
        Ok(match kind {
            "bushing" => {
                let stiffness = six(t, "stiffness")?;
                let damping = if t.has("damping") { six(t, "damping")? } else { [0.0; 6] };
                Effect::Bushing(names.pair(t)?, t.vector("at")?, [stiffness, damping])
            }
            "torque" => {
                let body = names.body(&t.text("body")?)?;
                let planar = t.planar;
                let mut torque = given(t, &scene.signals, !planar)?;
                match &mut torque {
                    _ if !planar => {}
                    Given::Constant(v) => *v = [0.0, 0.0, v[0]],
                    Given::Rows(rows) => {
                        rows.iter_mut().for_each(|(_, v)| *v = [0.0, 0.0, v[0]]);
                    }
                    Given::Named(sources) => sources.swap(0, 2),
                }
                Effect::BodyTorque(body, torque)
            }
            "force" => {
                let turns = matches!(t.take("frame"), Some(Node::Text(frame)) if frame == "body");
                let (body, at) = (names.body(&t.text("body")?)?, t.vector("at")?);
                Effect::Force(body, at, given(t, &scene.signals, true)?, turns)
            }
            "aero-drag" => {
                let numbers = [t.number("area_coefficient")?, t.number_or("density", 1.2)?];
                Effect::Drag(names.body(&t.text("body")?)?, t.vector("at")?, numbers)
            }
            "speed-hold" => {
                let numbers = [t.number("speed")?, t.number("gain")?, t.number("limit")?];
                let body = names.body(&t.text("body")?)?;
                Effect::SpeedHold(body, unit(t.vector("direction")?), numbers)
            }
            "tire" => Effect::Tire(tire(t, names, &scene.joints)?),
            other => return fault(format!("no effect `{other}`")),
        })
    }
}

fn line(t: &mut Table, names: &Names) -> Read<Line> {
    let direction = t.vector_or_none("direction")?.map(unit);
    Ok(Line { bodies: names.pair(t)?, points: t.two_vectors("points")?, direction })
}

/// Reads six numbers of a key. In the plane reads three: along x, along y, about z.
fn six(t: &mut Table, key: &str) -> Read<[f64; 6]> {
    if t.planar {
        let [x, y, about] = t.exactly(key)?;
        return Ok([x, y, 0.0, 0.0, 0.0, about]);
    }
    t.exactly(key)
}

fn tire(t: &mut Table, names: &Names, joints: &[Joint]) -> Read<Tire> {
    let numbers = [
        t.number("radius")?,
        t.number("stiffness")?,
        t.number_or("damping", 0.0)?,
        t.number_or("rolling_resistance", 0.0)?,
    ];
    let calspan = matches!(t.take("side"), Some(Node::Text(side)) if side == "calspan");
    let mut side = Calspan {
        a: [2625.0, 14.47, 12930.0, 2.29, 18175.0],
        omega: 1.0,
        b: [-0.464e-4, 1.216, 2.18e-11],
        skid: 1.0274,
        trail: [-0.171e-4, 0.171e-4],
    };
    if let Some(mut c) = t.table("coefficients")? {
        side = Calspan {
            a: c.exactly("a")?,
            omega: c.number("omega")?,
            b: c.exactly("b")?,
            skid: c.number("skid")?,
            trail: c.exactly("trail")?,
        };
        c.done("coefficients")?;
    }
    let mut axis = t.vector_or_none("axis")?.map(unit);
    let (mut body, center) = (names.body(&t.text("body")?)?, t.vector("center")?);
    if t.has("spin") {
        // the tire acts on the wheel: the other body of the joint `spin`
        let joint = &joints[names.joint(&t.text("spin")?)?];
        let wheel = joint.bodies.into_iter().flatten().find(|b| *b != body);
        body = wheel.map_or_else(|| fault("no wheel on the carrier"), Ok)?;
        if axis.is_none() && !t.planar {
            axis = Some(joint.axes[0]);
        }
    }
    let mut slip = None;
    if let Some(mut along) = t.table("longitudinal")? {
        slip = Some([along.number("stiffness")?, along.number("friction")?]);
        along.done("longitudinal")?;
    }
    Ok(Tire { body, center, axis, numbers, side: calspan.then_some(side), slip })
}

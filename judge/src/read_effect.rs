//! Reads effects of a scene.

use crate::names::Names;
use crate::node::{Node, Read, Table, fault};
use crate::read_curve::effect_sum;
use crate::read_signal::given;
use crate::scene::{Calspan, Effect, Given, Line, Scene, Tire};
use crate::vector::unit;

/// An effect that is enabled.
#[allow(clippy::too_many_lines, reason = "one arm for each kind")]
pub(crate) fn effect(mut table: Table, names: &Names, scene: &Scene) -> Read<Option<Effect>> {
    table.take("name");
    let enabled = !matches!(table.take("enabled"), Some(Node::Flag(false)));
    let kind = table.text("kind")?;
    let t = &mut table;
    let effect = match kind.as_str() {
        "spring-damper" => {
            let stiffness = t.number_or("stiffness", 0.0)?;
            let line = line(t, names)?;
            Effect::SpringDamper(
                line,
                [stiffness, t.number_or("damping", 0.0)?, t.number_or("free_length", 0.0)?],
            )
        }
        "polynomial-spring" | "polynomial-damper" => {
            let pieces: Vec<Vec<f64>> =
                t.need("coefficients")?.list()?.iter().map(Node::numbers).collect::<Read<_>>()?;
            if pieces.iter().any(|p| p.len() < 3) {
                return fault("a piece has [lower, upper, c0, ...]");
            }
            Effect::Polynomial(line(t, names)?, pieces, kind == "polynomial-damper")
        }
        "bumper" => {
            let line = line(t, names)?;
            Effect::Bumper(
                line,
                [t.number("stiffness")?, t.number_or("damping", 0.0)?, t.number("clearance")?],
            )
        }
        "actuator" => Effect::Actuator(line(t, names)?, given(t, &scene.signals, false)?),
        "bushing" => {
            let stiffness = six(t, "stiffness")?;
            let damping = if t.has("damping") { six(t, "damping")? } else { [0.0; 6] };
            Effect::Bushing(names.pair(t)?, t.vector("at")?, [stiffness, damping])
        }
        "torsion-spring" => {
            let numbers = [
                t.number_or("stiffness", 0.0)?,
                t.number_or("damping", 0.0)?,
                t.number_or("free_value", 0.0)?,
            ];
            Effect::TorsionSpring(effect_sum(t, names, &scene.joints)?, numbers)
        }
        "torque" => match t.take("body") {
            Some(Node::Text(body)) => {
                let planar = t.planar;
                let mut torque = given(t, &scene.signals, !planar)?;
                match &mut torque {
                    _ if !planar => {}
                    Given::Rows(rows) => {
                        rows.iter_mut().for_each(|(_, v)| *v = [0.0, 0.0, v[0]]);
                    }
                    Given::Named(sources) => sources.swap(0, 2),
                }
                Effect::BodyTorque(names.body(&body)?, torque)
            }
            _ => {
                let sum = effect_sum(t, names, &scene.joints)?;
                Effect::JointTorque(sum, given(t, &scene.signals, false)?)
            }
        },
        "limit" => {
            let numbers = [
                t.number("lower")?,
                t.number("upper")?,
                t.number("stiffness")?,
                t.number_or("damping", 0.0)?,
            ];
            Effect::Limit(effect_sum(t, names, &scene.joints)?, numbers)
        }
        "friction" => {
            let coulomb = t.number("coulomb")?;
            let sticking = t.number_or("static", coulomb)?;
            let regularisation = t.number_or("regularisation", 1e-3)?;
            let stribeck = t.number_or("stribeck", 10.0 * regularisation)?;
            let numbers =
                [coulomb, sticking, stribeck, t.number_or("viscous", 0.0)?, regularisation];
            Effect::Friction(effect_sum(t, names, &scene.joints)?, numbers)
        }
        "force" => {
            let turns = matches!(t.take("frame"), Some(Node::Text(frame)) if frame == "body");
            Effect::Force(
                names.body(&t.text("body")?)?,
                t.vector("at")?,
                given(t, &scene.signals, true)?,
                turns,
            )
        }
        "aero-drag" => {
            let numbers = [t.number("area_coefficient")?, t.number_or("density", 1.2)?];
            Effect::Drag(names.body(&t.text("body")?)?, t.vector("at")?, numbers)
        }
        "speed-hold" => {
            let numbers = [t.number("speed")?, t.number("gain")?, t.number("limit")?];
            Effect::SpeedHold(names.body(&t.text("body")?)?, unit(t.vector("direction")?), numbers)
        }
        "rotor" => {
            let (inertia, ratio) = (t.number("inertia")?, t.number("ratio")?);
            Effect::Rotor(names.joint(&t.text("joint")?)?, inertia * ratio * ratio)
        }
        "tire" => Effect::Tire(tire(t, names)?),
        other => return fault(format!("no effect `{other}`")),
    };
    table.done(&kind)?;
    Ok(enabled.then_some(effect))
}

fn line(t: &mut Table, names: &Names) -> Read<Line> {
    let direction = t.vector_or_none("direction")?.map(unit);
    Ok(Line { bodies: names.pair(t)?, points: t.two_vectors("points")?, direction })
}

/// Reads six numbers; in the plane three: along x, along y, about z.
fn six(t: &mut Table, key: &str) -> Read<[f64; 6]> {
    if t.planar {
        let [x, y, about] = t.exactly(key)?;
        return Ok([x, y, 0.0, 0.0, 0.0, about]);
    }
    t.exactly(key)
}

fn tire(t: &mut Table, names: &Names) -> Read<Tire> {
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
    let axis = t.vector_or_none("axis")?.map(unit);
    let (body, center) = (names.body(&t.text("body")?)?, t.vector("center")?);
    Ok(Tire { body, center, axis, numbers, side: calspan.then_some(side) })
}

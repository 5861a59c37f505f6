//! Reads the text of a scene file.

use crate::names::Names;
use crate::node::{Node, Read, Table, fault, parse};
use crate::read_coupling::Reader;
use crate::read_curve::{rows, word};
use crate::read_effect;
use crate::read_guide;
use crate::read_output::output;
use crate::read_rolling::rolling;
use crate::read_signal;
use crate::scene::{Body, Feature, InitialCondition, Joint, Kind, Output, Quantity, Scene, Spline};
use crate::vector::{ZERO, across, add, dot, norm, scale, sub, unit};

/// Reads the text of a scene.
///
/// # Errors
/// A fault with the key or value that is not valid.
pub fn read(text: &str) -> Read<Scene> {
    let mut root = parse(text)?;
    let mut head = root.table("scene")?.unwrap_or_default();
    let planar = match head.number("dimension")? {
        x if (x - 2.0).abs() < 0.5 => true,
        x if (x - 3.0).abs() < 0.5 => false,
        x => return fault(format!("dimension {x}")),
    };
    head.planar = planar;
    root.planar = planar;
    let mut scene = Scene {
        planar,
        name: head.take("name").map_or_else(String::new, |n| match n {
            Node::Text(name) => name,
            _ => String::new(),
        }),
        gravity: head.vector_or_none("gravity")?.unwrap_or(ZERO),
        duration: head.number("duration")?,
        ..Scene::default()
    };
    head.done("scene")?;
    scene.bodies = root.tables("body")?.into_iter().map(body).collect::<Read<_>>()?;
    let bodies: Vec<String> = scene.bodies.iter().map(|b| b.name.clone()).collect();
    let mut joints = root.tables("joint")?;
    let mut names = Names { bodies, joints: Vec::new() };
    for table in &mut joints {
        names.joints.push(table.text("name")?);
    }
    for (table, name) in joints.into_iter().zip(names.joints.clone()) {
        scene.joints.push(joint(table, name, &names, &scene.bodies)?);
    }
    let initials = root.tables("initial")?;
    scene.initials = initials.into_iter().map(|t| initial(t, &names)).collect::<Read<_>>()?;
    let signals = root.tables("signal")?;
    scene.signals = read_signal::Reader::new(signals, &names, &scene.joints)?.all()?;
    for table in root.tables("guide")? {
        read_guide::guide(table, &mut names, &mut scene)?;
    }
    couplings(root.tables("coupling")?, &names, &mut scene)?;
    let rollings = root.tables("rolling")?.into_iter().enumerate();
    scene.rollings = rollings.map(|(i, t)| rolling(t, &names, i)).collect::<Read<_>>()?;
    let mut effects = read_effect::Reader { names: &names, scene: &mut scene };
    for (number, table) in root.tables("effect")?.into_iter().enumerate() {
        effects.effect(table, number)?;
    }
    if let Some(table) = root.table("road")? {
        road(table, &mut scene)?;
    }
    if let Some(mut table) = root.table("solver")? {
        scene.step = table.take("step").map(|n| n.number()).transpose()?;
    }
    scene.outputs = channels(root.tables("output")?, &names, &scene)?;
    root.done("the scene")?;
    Ok(scene)
}

/// The channels of a scene. A scene without channels gets those of all joint coordinates.
fn channels(tables: Vec<Table>, names: &Names, scene: &Scene) -> Read<Vec<Output>> {
    if !tables.is_empty() {
        return tables.into_iter().map(|t| output(t, names, scene)).collect();
    }
    let is_shown = |j: &usize| scene.joints[*j].kind.coordinates(scene.planar) != [0, 0];
    let channel = |j: usize| Output {
        name: scene.joints[j].name.clone(),
        quantity: Quantity::Value(j),
        degrees: false,
    };
    Ok((0..scene.joints.len()).filter(is_shown).map(channel).collect())
}

fn body(mut table: Table) -> Read<Body> {
    let name = table.text("name")?;
    let mass = table.number("mass")?;
    let gravity_scale = table.number_or("gravity_scale", 1.0)?;
    let body = if let Some(mut rod) = table.table("rod")? {
        // a uniform slender rod: m/12 (L² E - l lᵀ)
        let (from, to) = (rod.vector("from")?, rod.vector("to")?);
        rod.done("rod")?;
        let l = sub(to, from);
        let mut inertia = [0, 1, 2].map(|i| [0, 1, 2].map(|j| -mass / 12.0 * l[i] * l[j]));
        (0..3).for_each(|i| inertia[i][i] += mass / 12.0 * dot(l, l));
        Body { name, mass, center: scale(0.5, add(from, to)), inertia, gravity_scale }
    } else if let Some(center) = table.vector_or_none("point")? {
        Body { name, mass, center, inertia: [ZERO; 3], gravity_scale }
    } else {
        let center = table.vector("center")?;
        let inertia = if table.planar {
            [ZERO, ZERO, [0.0, 0.0, table.number("inertia")?]]
        } else {
            let [xx, yy, zz, xy, yz, zx] = table.exactly("inertia")?;
            [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]
        };
        Body { name, mass, center, inertia, gravity_scale }
    };
    table.done("body")?;
    Ok(body)
}

fn joint(mut table: Table, name: String, names: &Names, all: &[Body]) -> Read<Joint> {
    let word = table.text("kind")?;
    let Some((kind, _)) = Kind::NAMES.into_iter().find(|(_, name)| *name == word) else {
        return fault(format!("no kind of joint `{word}`"));
    };
    let bodies = names.pair(&mut table)?;
    let is_point = |b: usize| all[b].inertia == [ZERO; 3];
    let of_point = kind == Kind::Free && bodies.into_iter().flatten().any(is_point);
    let kind = if of_point { Kind::FreePoint } else { kind };
    let points = match kind {
        Kind::Distance => table.two_vectors("points")?,
        Kind::Free | Kind::FreePoint => {
            let default = bodies[1].or(bodies[0]).map_or(ZERO, |b| all[b].center);
            [table.vector_or_none("at")?.unwrap_or(default); 2]
        }
        _ => [table.vector("at")?; 2],
    };
    let hinge = table.vector_or_none("axis")?;
    let mut axes =
        [hinge.unwrap_or([0.0, 0.0, 1.0]), table.vector_or_none("direction")?.unwrap_or(ZERO)];
    if kind == Kind::Universal {
        axes = table.two_vectors("axes")?;
    }
    // limits of effort and velocity are for programs that read the scene; they do not act on the motion
    let range = if table.has("range") { Some(table.exactly("range")?) } else { None };
    for key in ["effort_limit", "velocity_limit"] {
        let _ = table.take(key);
    }
    table.done(&name)?;
    axes[0] = unit(axes[0]);
    axes[1] = match kind {
        Kind::Universal => unit(axes[1]),
        _ if norm(axes[1]) > 0.0 => unit(sub(axes[1], scale(dot(axes[1], axes[0]), axes[0]))),
        _ => across(axes[0])[0],
    };
    Ok(Joint { name, kind, bodies, points, axes, hinged: hinge.is_some(), range })
}

/// Reads the couplings of a scene.
fn couplings(tables: Vec<Table>, names: &Names, scene: &mut Scene) -> Read<()> {
    let (mut wheels, planar) = (Vec::new(), scene.planar);
    let Scene { joints, signals, .. } = &*scene;
    let mut reader = Reader { names, joints, signals, wheels: &mut wheels, planar };
    let numbered = tables.into_iter().enumerate();
    let couplings = numbered.map(|(i, table)| reader.coupling(table, i)).collect::<Read<_>>()?;
    scene.couplings = couplings;
    scene.wheels = wheels;
    Ok(())
}

fn initial(mut table: Table, names: &Names) -> Read<InitialCondition> {
    let initial = if let Some(Node::Text(name)) = table.take("body") {
        let velocity = match table.vector_or_none("at")? {
            Some(at) => Some([at, table.vector("velocity")?]),
            None => None,
        };
        let angular = match table.take("angular_velocity") {
            Some(node) if table.planar => Some([0.0, 0.0, node.number()?]),
            Some(node) => Some(node.vector(false)?),
            None => None,
        };
        InitialCondition::Body { body: names.body(&name)?, velocity, angular }
    } else {
        let joint = names.joint(&table.text("joint")?)?;
        let mut numbers = |key: &str| table.take(key).map(|n| n.numbers()).transpose();
        InitialCondition::Joint { joint, value: numbers("value")?, rate: numbers("rate")? }
    };
    table.done("initial")?;
    Ok(initial)
}

fn road(mut table: Table, scene: &mut Scene) -> Read<()> {
    scene.road_speed = table.number_or("speed", 0.0)?;
    if let Some(kind) = table.take("kind") {
        let mut one = table;
        one.take("speed");
        let Node::Text(kind) = kind else { return fault("kind") };
        let features = feature(&kind, one)?;
        scene.road = [features.clone(), features];
        return Ok(());
    }
    let mut track = |key: &str| -> Read<Vec<Feature>> {
        let mut all = Vec::new();
        for mut one in table.tables(key)? {
            let kind = one.text("kind")?;
            all.extend(feature(&kind, one)?);
        }
        Ok(all)
    };
    let both = track("features")?;
    scene.road = [track("left")?, track("right")?].map(|side| [both.clone(), side].concat());
    table.done("road")
}

fn feature(kind: &str, mut table: Table) -> Read<Vec<Feature>> {
    let features = match kind {
        "flat" => vec![Feature::Flat(table.number_or("height", 0.0)?)],
        "ramp" => {
            let length = table.number("length")?;
            let (start, height) = (table.number("start")?, table.number("height")?);
            vec![Feature::Ramp([start, length, height, table.number_or("rounding", 0.1 * length)?])]
        }
        "stairs" => {
            let (start, tread) = (table.number("start")?, table.number("tread")?);
            let (riser, height) = (table.number("riser")?, table.number("height")?);
            let mut stairs = Vec::new();
            let (mut at, mut left) = (start, table.number("count")?);
            while left > 0.5 {
                stairs.push(Feature::Ramp([at, riser, height, 0.5 * riser]));
                (at, left) = (at + tread + riser, left - 1.0);
            }
            stairs
        }
        "bump" => {
            table.take("shape");
            let (start, length) = (table.number("start")?, table.number("length")?);
            let amplitude = match table.take("amplitude") {
                Some(node) => node.number()?,
                None => 0.5 * table.number("height")?,
            };
            vec![Feature::Bump([start, length, amplitude])]
        }
        "table" => {
            let spline = Spline::natural(&rows(&table.need("points")?)?);
            vec![Feature::Table(match word(&mut table, "interpolation", "spline")?.as_str() {
                "monotone" => Spline::monotone(&spline, false),
                "spline" => spline,
                other => return fault(format!("interpolation {other}")),
            })]
        }
        other => return fault(format!("no feature `{other}`")),
    };
    table.done("feature")?;
    Ok(features)
}

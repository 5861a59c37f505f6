//! Reads guides of a coordinate, of all coordinates of a joint, and of a body against the ground.

use crate::names::Names;
use crate::node::{Node, Read, Table, fault};
use crate::read_curve::{by_name, coordinate, law};
use crate::scene::{Guide, GuidedTurn, Joint, Kind, Law, Scene};
use crate::vector::ZERO;

/// Reads a guide of a scene. A guided body gets a free joint to the ground with the body's name.
pub(crate) fn guide(mut table: Table, names: &mut Names, scene: &mut Scene) -> Read<()> {
    let joint = match table.take("body") {
        Some(Node::Text(body)) => {
            let b = names.body(&body)?;
            let at = table.vector_or_none("at")?.unwrap_or(scene.bodies[b].center);
            let is_point = scene.bodies[b].inertia == [ZERO; 3];
            scene.joints.push(Joint {
                name: body.clone(),
                kind: if is_point { Kind::FreePoint } else { Kind::Free },
                bodies: [None, Some(b)],
                points: [at; 2],
                axes: [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
                hinged: false,
                range: None,
            });
            names.joints.push(body);
            scene.joints.len() - 1
        }
        _ => names.joint(&table.text("joint")?)?,
    };
    if let Some(list) = table.take("signals") {
        let law = |node: &Node| Ok(Law::Signal(Box::new(by_name(node, &scene.signals)?)));
        let laws: Vec<Law> = list.list()?.iter().map(law).collect::<Read<_>>()?;
        table.done("guide")?;
        return whole(joint, laws, scene);
    }
    let coordinate = coordinate(&mut table, scene.joints[joint].kind)?.unwrap_or(0);
    let Some(law) = law(&mut table, &scene.signals)? else {
        return fault("a guide without a motion");
    };
    table.done("guide")?;
    scene.guides.push(Guide { joint, coordinate, law });
    Ok(())
}

/// Adds guides of all coordinates of a joint.
fn whole(joint: usize, laws: Vec<Law>, scene: &mut Scene) -> Read<()> {
    let [slides, turns] = scene.joints[joint].kind.coordinates(scene.planar);
    if laws.len() != slides + turns {
        return fault("a signal for each coordinate");
    }
    let mut laws = laws.into_iter();
    let single = if turns == 3 { slides } else { slides + turns };
    let some = laws.by_ref().take(single).enumerate();
    scene.guides.extend(some.map(|(coordinate, law)| Guide { joint, coordinate, law }));
    if let (Some(x), Some(y), Some(z)) = (laws.next(), laws.next(), laws.next()) {
        scene.guided_turns.push(GuidedTurn { joint, laws: [x, y, z] });
    }
    Ok(())
}

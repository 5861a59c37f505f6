//! Copies of a vehicle behind each other on one road.

use super::GenerateError;
use super::text::{Text, number};
use crate::read::SceneFile;
use crate::read::tree::{Item, Member, Node};
use crate::write::toml::{quoted, value};
use mbs_core::scene::Scene;

const COMMENT: &str = "\
Convoy: one vehicle many times over, behind each other on one road and driving in x.

Names of the vehicle with the number k begin with `vk-`; the first drives ahead as the scene it is taken from says, each
other one stands that distance further back and meets the road that much later. They know nothing of each other. Outputs
are those of the first and of the last vehicle.";

/// Keys whose values are places: they move with the vehicle.
const PLACES: [&str; 6] = ["center", "at", "points", "from", "to", "rod"];
/// Keys whose values are names.
const NAMES: [&str; 4] = ["name", "body", "joint", "bodies"];
/// Tables that each vehicle has.
const LISTS: [&str; 5] = ["body", "joint", "guide", "initial", "effect"];

pub(super) fn text(
    vehicle: &SceneFile,
    (count, spacing): (usize, f64),
    command: &str,
) -> Result<String, GenerateError> {
    if !(spacing > 0.0 && spacing.is_finite()) {
        return Err(GenerateError::Spacing(spacing));
    }
    let scene = vehicle.scene::<f64>().map_err(|_| GenerateError::NoScene)?;
    if !scene.effects.iter().any(|effect| effect.kind.row().needs_road) {
        return Err(GenerateError::NoTires);
    }
    let mut text = Text::new(COMMENT, command);
    header(&mut text, vehicle, &format!("{}: convoy of {count}", scene.name));
    for list in LISTS {
        for k in 0..count {
            Copy::new(k, spacing).entries(&mut text, vehicle, list);
        }
    }
    let ends = if count > 1 { vec![0, count - 1] } else { vec![0] };
    for k in ends {
        let copy = Copy::new(k, spacing);
        if scene.outputs.is_empty() {
            copy.center(&mut text, &scene);
        }
        copy.entries(&mut text, vehicle, "output");
    }
    Ok(text.0)
}

/// What the vehicles share: the scene's own keys, the road, the solver.
fn header(text: &mut Text, vehicle: &SceneFile, name: &str) {
    for table in ["scene", "road", "solver"] {
        let Some(Item { node: Node::Table(members), .. }) = vehicle.top(table) else { continue };
        text.table(&format!("[{table}]"));
        if table == "scene" {
            text.key("name", &quoted(name));
        }
        for member in members.iter().filter(|m| table != "scene" || m.key != "name") {
            text.key(&member.key, &value(&member.item));
        }
    }
}

/// One of the vehicles.
struct Copy {
    prefix: String,
    shift: f64,
}

impl Copy {
    fn new(k: usize, spacing: f64) -> Self {
        Self { prefix: format!("v{}-", k + 1), shift: -spacing * k as f64 }
    }

    fn entries(&self, text: &mut Text, vehicle: &SceneFile, list: &str) {
        let Some(Item { node: Node::List(entries), .. }) = vehicle.top(list) else { return };
        for entry in entries {
            let Node::Table(members) = &entry.node else { continue };
            text.table(&format!("[[{list}]]"));
            for Member { key, item, .. } in members {
                let value = match key.as_str() {
                    key if NAMES.contains(&key) => self.named(item),
                    key if PLACES.contains(&key) => self.moved(item),
                    _ => value(item),
                };
                text.key(key, &value);
            }
        }
    }

    /// The centre of the first body, where the vehicle's scene has no outputs.
    fn center(&self, text: &mut Text, scene: &Scene<f64>) {
        let Some(body) = scene.bodies.first() else { return };
        let name = format!("{}{}", self.prefix, body.name);
        let [x, y, z] = body.center;
        text.position(&name, &name, &[x + self.shift, y, z][..scene.dimension.count()]);
    }

    /// A name, or a list of names, of this vehicle; the ground has no number.
    fn named(&self, item: &Item) -> String {
        match &item.node {
            Node::Text(name) if name == "ground" => quoted(name),
            Node::Text(name) => quoted(&format!("{}{name}", self.prefix)),
            Node::List(items) => list(items, |item| self.named(item)),
            _ => value(item),
        }
    }

    /// A place, a list of places, or a table of places, moved along x; a place not moved keeps its text.
    fn moved(&self, item: &Item) -> String {
        match &item.node {
            Node::List(items) => match items.as_slice() {
                [Item { node: Node::Number(x), .. }, rest @ ..] => {
                    let x = match x.parse::<f64>() {
                        Ok(place) if self.shift < 0.0 => number(place + self.shift),
                        _ => x.clone(),
                    };
                    let rest = rest.iter().map(value);
                    format!("[{}]", core::iter::once(x).chain(rest).collect::<Vec<_>>().join(", "))
                }
                _ => list(items, |item| self.moved(item)),
            },
            Node::Table(members) => table(members, |item| self.moved(item)),
            _ => value(item),
        }
    }
}

fn list(items: &[Item], of: impl Fn(&Item) -> String) -> String {
    format!("[{}]", items.iter().map(of).collect::<Vec<_>>().join(", "))
}

fn table(members: &[Member], of: impl Fn(&Item) -> String) -> String {
    let members = members.iter().map(|m| format!("{} = {}", m.key, of(&m.item)));
    format!("{{ {} }}", members.collect::<Vec<_>>().join(", "))
}

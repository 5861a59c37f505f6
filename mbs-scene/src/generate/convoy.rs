//! Copies of a vehicle, one behind the other, on one road.

use super::GenerateError;
use super::text::{headed, number};
use crate::read::SceneFile;
use crate::read::tree::{Item, Member, Node};
use crate::write::toml;
use mbs_core::scene::Scene;

const COMMENT: &str = "\
Convoy: one vehicle many times over, behind each other on one road and driving in x.

Names of the vehicle with the number k begin with `vk-`; the first drives ahead as the scene it is taken from says, each
other one stands that distance further back and meets the road that much later. They know nothing of each other. Outputs
are those of the first and of the last vehicle.";

/// Keys whose values are places in the scene. Each copy shifts these places along x.
const PLACES: [&str; 6] = ["center", "at", "points", "from", "to", "rod"];
/// Keys whose values are names. Each copy puts its prefix before these names.
const NAMES: [&str; 4] = ["name", "body", "joint", "bodies"];
/// Tables that are copied for each vehicle.
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
    let name = format!("{}: convoy of {count}", scene.name);
    let mut out = String::new();
    header(&mut out, vehicle, &name);
    for list in LISTS {
        for k in 0..count {
            Copy::new(k, spacing).entries(&mut out, vehicle, list);
        }
    }
    let ends = if count > 1 { vec![0, count - 1] } else { vec![0] };
    for k in ends {
        let copy = Copy::new(k, spacing);
        if scene.outputs.is_empty() {
            copy.center(&mut out, &scene);
        }
        copy.entries(&mut out, vehicle, "output");
    }
    Ok(headed(COMMENT, command, &out))
}

/// Writes the parts that all vehicles have in common: the keys of `[scene]`, the road and the solver.
fn header(out: &mut String, vehicle: &SceneFile, name: &str) {
    for table in ["scene", "road", "solver"] {
        let Some(Item { node: Node::Table(members), .. }) = vehicle.top(table) else { continue };
        let mut members = members.clone();
        if table == "scene" {
            members.retain(|member| member.key != "name");
            members.insert(0, member("name", Node::Text(name.to_owned())));
        }
        toml::table(out, &format!("[{table}]"), &members);
    }
}

fn member(key: &str, node: Node) -> Member {
    Member { key: key.to_owned(), key_span: 0..0, item: item(node) }
}

fn item(node: Node) -> Item {
    Item { span: 0..0, node }
}

/// One copy of the vehicle, with its prefix of names and its shift along x [m].
struct Copy {
    prefix: String,
    shift: f64,
}

impl Copy {
    fn new(k: usize, spacing: f64) -> Self {
        Self { prefix: format!("v{}-", k + 1), shift: -spacing * k as f64 }
    }

    fn entries(&self, out: &mut String, vehicle: &SceneFile, list: &str) {
        let Some(Item { node: Node::List(entries), .. }) = vehicle.top(list) else { return };
        for entry in entries {
            let Node::Table(members) = &entry.node else { continue };
            let copy = |Member { key, item, .. }: &Member| match key.as_str() {
                key if NAMES.contains(&key) => member(key, self.named(&item.node)),
                key if PLACES.contains(&key) => member(key, self.moved(&item.node)),
                key => member(key, item.node.clone()),
            };
            let members: Vec<Member> = members.iter().map(copy).collect();
            toml::table(out, &format!("[[{list}]]"), &members);
        }
    }

    /// Writes an output of the centre of the first body, for a vehicle whose scene has no outputs.
    fn center(&self, out: &mut String, scene: &Scene<f64>) {
        let Some(body) = scene.bodies.first() else { return };
        let name = Node::Text(format!("{}{}", self.prefix, body.name));
        let [x, y, z] = body.center;
        let at = [x + self.shift, y, z].into_iter().take(scene.dimension.count());
        let at = at.map(|x| item(Node::Number(number(x).text())));
        let members = [("name", name.clone()), ("body", name), ("at", Node::List(at.collect()))];
        toml::table(out, "[[output]]", &members.map(|(key, node)| member(key, node)));
    }

    /// Adds the prefix of this vehicle to a name or a list of names; `ground` gets no prefix.
    fn named(&self, node: &Node) -> Node {
        match node {
            Node::Text(name) if name != "ground" => Node::Text(format!("{}{name}", self.prefix)),
            Node::List(items) => {
                Node::List(items.iter().map(|x| item(self.named(&x.node))).collect())
            }
            other => other.clone(),
        }
    }

    /// Moves a place, a list of places or a table of places along x. A place with a shift of zero keeps its text.
    fn moved(&self, node: &Node) -> Node {
        match node {
            Node::List(items) => match items.as_slice() {
                [Item { node: Node::Number(x), .. }, rest @ ..] => {
                    let x = match x.parse::<f64>() {
                        Ok(place) if self.shift < 0.0 => number(place + self.shift).text(),
                        _ => x.clone(),
                    };
                    let first = item(Node::Number(x));
                    Node::List(core::iter::once(first).chain(rest.iter().cloned()).collect())
                }
                _ => Node::List(items.iter().map(|x| item(self.moved(&x.node))).collect()),
            },
            Node::Table(members) => {
                let moved = |m: &Member| member(&m.key, self.moved(&m.item.node));
                Node::Table(members.iter().map(moved).collect())
            }
            other => other.clone(),
        }
    }
}

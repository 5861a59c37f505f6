//! Text of a random scene, and the mechanism of that text.

use super::draft::{Draft, Link};
use crate::scene::{Kind, Quantity};
use crate::vector::Vector;
use crate::{Mechanism, read};
use std::fmt::Write;

/// Number of bodies among which one has a quarter of its weight.
const LIGHTENED: usize = 3;

/// Text of a vector of the plane or of space.
pub(crate) fn vector(v: Vector, planar: bool) -> String {
    if planar {
        format!("[{:?}, {:?}]", v[0], v[1])
    } else {
        format!("[{:?}, {:?}, {:?}]", v[0], v[1], v[2])
    }
}

/// Text of one number, or of a list.
pub(crate) fn numbers(list: &[f64]) -> String {
    match list {
        [one] => format!("{one:?}"),
        many => format!("{many:?}"),
    }
}

pub(crate) fn name(body: Option<usize>) -> String {
    body.map_or_else(|| "ground".to_owned(), |b| format!("b{b}"))
}

pub(crate) fn pair(bodies: [Option<usize>; 2]) -> String {
    format!("[\"{}\", \"{}\"]", name(bodies[0]), name(bodies[1]))
}

fn kind(kind: Kind) -> &'static str {
    Kind::NAMES.into_iter().find(|(known, _)| *known == kind).map_or("free", |(_, name)| name)
}

impl Draft {
    /// Returns the text of the scene file.
    pub(crate) fn text(&self) -> String {
        let mut out = String::new();
        let p = self.planar;
        // writing to a string cannot fail
        let _ = writeln!(
            out,
            "[scene]\nname = \"drawn\"\ndimension = {}\nduration = {:?}",
            if p { 2 } else { 3 },
            self.duration
        );
        if let Some(gravity) = self.gravity {
            let _ = writeln!(out, "gravity = {}", vector(gravity, p));
        }
        for (i, body) in self.bodies.iter().enumerate() {
            let _ = writeln!(out, "\n[[body]]\nname = \"b{i}\"\nmass = {:?}", body.mass);
            let _ = match body.rod {
                Some([from, to]) => {
                    writeln!(out, "rod = {{ from = {}, to = {} }}", vector(from, p), vector(to, p))
                }
                None if p => writeln!(
                    out,
                    "center = {}\ninertia = {:?}",
                    vector(body.center, p),
                    body.inertia[0]
                ),
                None => writeln!(
                    out,
                    "center = {}\ninertia = {:?}",
                    vector(body.center, p),
                    body.inertia
                ),
            };
            if i % LIGHTENED == LIGHTENED - 1 {
                out += "gravity_scale = 0.25\n";
            }
        }
        for (i, link) in self.links.iter().enumerate() {
            let _ = writeln!(
                out,
                "\n[[joint]]\nname = \"j{i}\"\nkind = \"{}\"\nbodies = {}",
                kind(link.kind),
                pair(link.bodies)
            );
            self.geometry(&mut out, link);
        }
        for (i, link) in self.links.iter().enumerate() {
            if let Some(guide) = &link.guide {
                let _ = writeln!(out, "\n[[guide]]\njoint = \"j{i}\"\n{guide}");
            }
            if link.value.is_some() || link.rate.is_some() {
                let _ = writeln!(out, "\n[[initial]]\njoint = \"j{i}\"");
                for (key, list) in [("value", &link.value), ("rate", &link.rate)] {
                    if let Some(list) = list {
                        let _ = writeln!(out, "{key} = {}", numbers(list));
                    }
                }
            }
        }
        self.relations(&mut out);
        self.outputs(&mut out);
        out
    }

    /// Writes signals and couplings, then effects and all other parts that are text.
    fn relations(&self, out: &mut String) {
        for (i, (signal, _)) in self.signals.iter().enumerate() {
            let _ = writeln!(out, "\n[[signal]]\nname = \"s{i}\"\n{signal}");
        }
        for (i, (_, coupling)) in self.couplings.iter().enumerate() {
            let _ = writeln!(out, "\n[[coupling]]\nname = \"c{i}\"\n{coupling}");
        }
        for (i, rolling) in self.rollings.iter().enumerate() {
            let _ = writeln!(out, "\n[[rolling]]\nname = \"r{i}\"\n{rolling}");
        }
        for block in &self.blocks {
            let _ = writeln!(out, "\n{block}");
        }
    }

    fn geometry(&self, out: &mut String, link: &Link) {
        let p = self.planar;
        let [at, other] = link.points.map(|v| vector(v, p));
        let [axis, second] = link.axes.map(|v| vector(v, p));
        let _ = match link.kind {
            Kind::Distance if link.hinged => {
                writeln!(out, "points = [{at}, {other}]\naxis = {axis}")
            }
            Kind::Distance => writeln!(out, "points = [{at}, {other}]"),
            Kind::Universal => writeln!(out, "at = {at}\naxes = [{axis}, {second}]"),
            Kind::Planar => writeln!(out, "at = {at}\naxis = {axis}\ndirection = {second}"),
            Kind::Revolute if p => writeln!(out, "at = {at}"),
            Kind::Revolute | Kind::Prismatic | Kind::Cylindrical | Kind::PinInSlot => {
                writeln!(out, "at = {at}\naxis = {axis}")
            }
            Kind::Spherical | Kind::Weld | Kind::Free | Kind::FreePoint => {
                writeln!(out, "at = {at}")
            }
        };
    }

    fn outputs(&self, out: &mut String) {
        let mut output = |of: &str, name: &str, quantity: &str| {
            let _ = writeln!(
                out,
                "\n[[output]]\nname = \"{name}-{quantity}\"\n{of}\nquantity = \"{quantity}\""
            );
        };
        for (i, body) in self.bodies.iter().enumerate() {
            let (name, at) = (format!("b{i}"), vector(body.mark, self.planar));
            let of = format!("body = \"{name}\"");
            let of_point = format!("{of}\nat = {at}");
            Quantity::OF_POINTS.iter().for_each(|quantity| output(&of_point, &name, quantity));
            Quantity::OF_BODIES.iter().for_each(|quantity| output(&of, &name, quantity));
        }
        for (i, (kind, _)) in self.couplings.iter().enumerate() {
            for quantity in Quantity::OF_COUPLINGS {
                if *quantity != "length" || kind == "rope" {
                    output(&format!("coupling = \"c{i}\""), &format!("c{i}"), quantity);
                }
            }
        }
        for (i, (_, has_rate)) in self.signals.iter().enumerate() {
            for quantity in &Quantity::OF_SIGNALS[..1 + usize::from(*has_rate)] {
                output(&format!("signal = \"s{i}\""), &format!("s{i}"), quantity);
            }
        }
        // all quantities but the error of the energy balance, which is an error of each run
        let of_scenes = Quantity::OF_SCENES.iter().filter(|name| **name != "invariant-error");
        of_scenes.for_each(|quantity| output("", "scene", quantity));
        for block in &self.blocks {
            let named = block.strip_prefix("[[effect]]\nname = \"");
            let Some((name, _)) = named.and_then(|rest| rest.split_once('"')) else { continue };
            for quantity in ["force", "energy", "power"] {
                output(&format!("effect = \"{name}\""), name, quantity);
            }
        }
        for i in 0..self.rollings.len() {
            output(&format!("rolling = \"r{i}\""), &format!("r{i}"), "force");
        }
        for (i, link) in self.links.iter().enumerate() {
            let name = format!("j{i}");
            for quantity in Quantity::OF_JOINTS {
                let is_shown = match *quantity {
                    "reaction" => link.kind != Kind::Free,
                    _ => !matches!(link.kind, Kind::Weld | Kind::Distance),
                };
                if is_shown {
                    output(&format!("joint = \"{name}\""), &name, quantity);
                }
            }
        }
    }
}

/// True if the judge finds a start for the draft.
pub(crate) fn starts(draft: &Draft) -> bool {
    mechanism_of(draft).is_some_and(|m| m.start().is_ok())
}

pub(crate) fn mechanism_of(draft: &Draft) -> Option<Mechanism> {
    read(&draft.text()).ok().map(Mechanism::new)
}

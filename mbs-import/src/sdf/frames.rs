//! The graph of frames: frames of links, joints and models, and named frames, each placed relative to another.

use crate::pose::Pose;
use crate::robot::GROUND;
use crate::source::{Fault, Origin, Read};
use mbs_scene::nearest_name;
use std::cell::RefCell;
use std::collections::{HashMap, HashSet};

/// Name of the frame of the world.
pub(super) const WORLD: &str = "world";
/// Name of the frame of a model, within its scope.
pub(super) const MODEL: &str = "__model__";

/// A frame of the file, with its pose.
#[derive(Debug, Clone)]
pub(super) struct Node {
    pub(super) at: Origin,
    /// Full name of the frame to which its pose refers.
    pub(super) relative_to: String,
    pub(super) pose: Pose,
    /// Full name of the frame to which it is attached. `None` for links and joints, whose motion is defined elsewhere.
    pub(super) attached_to: Option<String>,
    /// Index of the link, if the frame is that of a link.
    pub(super) link: Option<usize>,
}

/// All frames by their full names, `outer::inner`.
#[derive(Debug, Default)]
pub(super) struct Frames {
    nodes: HashMap<String, Node>,
    places: RefCell<HashMap<String, Pose>>,
    /// Joints by their full names, with the full name of the joint's frame and the joint's name in the scene.
    joints: HashMap<String, [String; 2]>,
    /// Indices of links of static models.
    still: HashSet<usize>,
    /// Prefix that names in the scene leave out: the name of the only model with `::`, or an empty text.
    hidden: String,
}

impl Frames {
    pub(super) fn new(hidden: String) -> Self {
        Self { hidden, ..Self::default() }
    }

    pub(super) fn add(&mut self, name: String, node: Node) {
        self.nodes.insert(name, node);
    }

    /// Adds a joint with its name in the scene. Before version 1.7, a joint may have the name of a link, and that name then means the link.
    pub(super) fn add_joint(&mut self, name: String, shown: String, node: Node) {
        let is_taken = self.nodes.contains_key(&name);
        let own = if is_taken { format!("{name}_joint") } else { name.clone() };
        self.add(own.clone(), node);
        self.joints.insert(name, [own, shown]);
    }

    /// The full name of a joint's frame, and the joint's name in the scene, by the joint's full name.
    pub(super) fn joint(&self, name: &str) -> Option<[&str; 2]> {
        self.joints.get(name).map(|[own, shown]| [own.as_str(), shown.as_str()])
    }

    /// A full name, or its beginning, without the prefix that names in the scene leave out.
    pub(super) fn plain<'a>(&self, name: &'a str) -> &'a str {
        name.strip_prefix(self.hidden.as_str()).unwrap_or(name)
    }

    pub(super) fn add_still(&mut self, link: usize) {
        self.still.insert(link);
    }

    /// True if a link is the ground, or a link of a static model.
    pub(super) fn is_still(&self, link: usize) -> bool {
        link == GROUND || self.still.contains(&link)
    }

    /// The full name of a name in a scope, whose prefix is empty or ends with `::`.
    pub(super) fn full(&self, prefix: &str, name: &str, at: Origin) -> Read<String> {
        if name == WORLD {
            return Ok(name.to_owned());
        }
        let full = format!("{prefix}{name}");
        let nested = format!("{full}::{MODEL}");
        if self.nodes.contains_key(&full) {
            return Ok(full);
        }
        // The name of a nested model means its frame.
        if self.nodes.contains_key(&nested) {
            return Ok(nested);
        }
        let mut known: Vec<&str> =
            self.nodes.keys().filter_map(|known| known.strip_prefix(prefix)).collect();
        known.sort_unstable();
        let hint = nearest_name(name, &known, "frames");
        Err(Fault::new(at, format!("unknown link, joint, frame or model `{name}`"), hint))
    }

    /// Pose of a frame relative to its model. For this computation, the model is placed in the world temporarily.
    pub(super) fn alone(&self, name: &str, model: &str, at: Origin) -> Read<Pose> {
        if !self.nodes.contains_key(name) {
            return Err(Fault::new(
                at,
                format!("unknown frame `{}`", self.plain(name)),
                "name a frame of this model",
            ));
        }
        let places = [self.place(model)?, self.place(name)?];
        // These poses hold only until the model gets its own place.
        self.places.borrow_mut().clear();
        Ok(places[0].inverse().then(&places[1]))
    }

    /// Pose of a frame in the world.
    pub(super) fn place(&self, name: &str) -> Read<Pose> {
        let mut chain: Vec<&str> = Vec::new();
        let mut at = name;
        let mut pose = loop {
            if at == WORLD {
                break Pose::identity();
            }
            if let Some(known) = self.places.borrow().get(at) {
                break *known;
            }
            let node = self.node(at, &chain)?;
            if chain.contains(&at) {
                return Err(self.circle(&chain, at));
            }
            chain.push(at);
            at = &node.relative_to;
        };
        for name in chain.into_iter().rev() {
            pose = pose.then(&self.node(name, &[])?.pose);
            self.places.borrow_mut().insert(name.to_owned(), pose);
        }
        Ok(pose)
    }

    /// The link to which a frame is attached; `None` for the world.
    pub(super) fn link(&self, name: &str) -> Read<Option<usize>> {
        let mut chain: Vec<&str> = Vec::new();
        let mut at = name;
        loop {
            if at == WORLD {
                return Ok(None);
            }
            let node = self.node(at, &chain)?;
            if let Some(link) = node.link {
                return Ok(Some(link));
            }
            if chain.contains(&at) {
                return Err(self.circle(&chain, at));
            }
            chain.push(at);
            at = node.attached_to.as_deref().unwrap_or(&node.relative_to);
        }
    }

    /// A frame by its full name, or the frame of the model of that name. `chain` has the frames that led to this name; an error is reported
    /// at its last frame.
    fn node(&self, name: &str, chain: &[&str]) -> Read<&Node> {
        let found = self.nodes.get(name).or_else(|| self.nodes.get(&format!("{name}::{MODEL}")));
        found.ok_or_else(|| {
            let by = chain.last().and_then(|by| self.nodes.get(*by));
            let at = by.map_or(Origin::start_of(0), |node| node.at);
            let mut known: Vec<&str> = self.nodes.keys().map(|known| self.plain(known)).collect();
            known.sort_unstable();
            let name = self.plain(name);
            let hint = nearest_name(name, &known, "frames");
            Fault::new(at, format!("unknown link, joint, frame or model `{name}`"), hint)
        })
    }

    fn circle(&self, chain: &[&str], at: &str) -> Fault {
        let start = chain.iter().position(|name| *name == at).unwrap_or(0);
        let ring: Vec<_> = chain[start..]
            .iter()
            .chain([&at])
            .map(|name| format!("`{}`", self.plain(name)))
            .collect();
        let place = self.nodes.get(at).map_or(Origin::start_of(0), |node| node.at);
        Fault::new(
            place,
            format!("frames are placed in each other in a circle: {}", ring.join(" -> ")),
            "place one of them in the model, or in the world",
        )
    }
}

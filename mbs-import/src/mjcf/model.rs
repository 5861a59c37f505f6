//! Model that the parts of the MJCF reader fill together.

use super::compiler::Compiler;
use super::defaults::Classes;
use super::size::Size;
use super::strength::Strength;
use crate::context::{Context, Named};
use crate::coordinates::{FileCoordinate, FileMotion};
use crate::element::{Attribute, Element};
use crate::inertia::Mass;
use crate::pose::{Pose, V3};
use crate::robot::{Coordinate, GROUND, Law, Robot, Signal, Target, Term, What};
use crate::source::{Origin, Read};
use std::collections::{HashMap, HashSet};

/// Kind of a joint of the file, by its freedoms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Moves {
    Hinge,
    Slide,
    Ball,
    Free,
}

impl Moves {
    /// Number of position values of the joint in a keyframe.
    pub(super) const fn places(self) -> usize {
        match self {
            Self::Hinge | Self::Slide => 1,
            Self::Ball => 4,
            Self::Free => 7,
        }
    }
}

/// Kind of named things. Names of one kind are unique.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Sort {
    Link,
    Joint,
    Law,
}

/// A joint of the file, with its coordinates in the scene.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    pub(super) name: String,
    pub(super) at: Origin,
    pub(super) moves: Moves,
    /// Index of the joint of the scene.
    pub(super) joint: usize,
    /// Index of the coordinate, if the joint of the scene has several.
    pub(super) number: Option<usize>,
    /// Sign of the scene's coordinate relative to the file's, 1 or −1.
    pub(super) sign: f64,
    /// Coordinate of the file in the reference configuration of the scene.
    pub(super) zero: f64,
    /// Coordinate of the file in the configuration in which the model is drawn.
    pub(super) drawn: f64,
    /// Coordinate of the file at which its spring has no force.
    pub(super) spring: f64,
    /// Limits of the file's coordinate.
    pub(super) range: Option<[f64; 2]>,
    /// Limits of the effort of all actuators together [N m or N].
    pub(super) effort: Option<[f64; 2]>,
    pub(super) armature: f64,
    /// Axis in the reference configuration, global: of a translation, or of a rotation about the joint's place.
    pub(super) axis: V3,
    /// Time constant [s] and damping ratio of its stops, if it has stops.
    pub(super) stops: Option<[f64; 2]>,
    /// Time constant [s] and damping ratio that define its spring, if the file gives them.
    pub(super) timed: Option<[f64; 2]>,
    /// Size factors of the frames that contain the joint.
    pub(super) size: Size,
    /// Stiffness and damping of the joint, if they are not switched off.
    pub(super) strengths: [Strength; 2],
}

impl Motion {
    /// True if the joint has a single coordinate.
    pub(super) const fn is_single(&self) -> bool {
        matches!(self.moves, Moves::Hinge | Moves::Slide)
    }

    /// The coordinate of the scene to which this joint belongs.
    pub(super) const fn coordinate(&self) -> Coordinate {
        Coordinate { joint: self.joint, number: self.number }
    }

    pub(super) const fn target(&self) -> Target {
        Target::Coordinate(self.coordinate())
    }

    /// The term of the file's coordinate in a sum, and the constant that it adds to the sum.
    pub(super) fn term(&self, factor: f64) -> (Term, f64) {
        let term = Term::new(self.coordinate(), factor * self.sign);
        (term, factor * self.zero)
    }

    /// The joint as a coordinate of the file, with its place in the scene.
    pub(super) fn of_file(&self, robot: &Robot) -> FileCoordinate {
        let joint = &robot.joints[self.joint];
        let Pose { turn, at } = robot.links[joint.child].pose;
        let motion = match self.moves {
            Moves::Hinge | Moves::Slide => FileMotion::Single,
            Moves::Ball => FileMotion::Ball,
            Moves::Free => FileMotion::Free,
        };
        let row = |i: usize| [turn[(i, 0)], turn[(i, 1)], turn[(i, 2)]];
        FileCoordinate {
            motion,
            joint: joint.name.clone(),
            number: self.number.unwrap_or_default(),
            sign: self.sign,
            zero: self.zero,
            at: at.into(),
            turn: [row(0), row(1), row(2)],
        }
    }

    /// Converts a value of the file's coordinate to the scene's coordinate.
    pub(super) fn in_scene(&self, value: f64) -> f64 {
        self.sign * (value - self.zero)
    }

    /// Converts limits of the file's coordinate to the scene's coordinate.
    pub(super) fn ends(&self, [lower, upper]: [f64; 2]) -> [f64; 2] {
        let [a, b] = [self.in_scene(lower), self.in_scene(upper)];
        [a.min(b), a.max(b)]
    }
}

/// A named place of the file, an MJCF site.
#[derive(Debug, Clone)]
pub(super) struct Site {
    pub(super) name: String,
    pub(super) link: usize,
    pub(super) pose: Pose,
    /// Size factors of the frames that contain the site.
    pub(super) size: Size,
}

impl Site {
    /// True if the site is in a frame with a scale.
    pub(super) fn is_grown(&self) -> bool {
        self.size != Size::ONE
    }
}

/// A tendon of the file. A tendon without terms has no counterpart in the scene.
#[derive(Debug, Clone, Default)]
pub(super) struct Tendon {
    pub(super) name: String,
    pub(super) terms: Vec<Term>,
    /// Length of the tendon in the reference configuration.
    pub(super) drawn: f64,
    /// Limits of the length of the tendon.
    pub(super) range: Option<[f64; 2]>,
    /// Limits of the force of all its actuators together.
    pub(super) effort: Option<[f64; 2]>,
    /// True if a part of the tendon is in a frame with a scale.
    pub(super) is_grown: bool,
}

/// Control of an actuator, which a keyframe sets.
#[derive(Debug, Clone)]
pub(super) struct Control {
    /// Index of the law that is the input of the actuator.
    pub(super) law: Option<usize>,
    /// Index of the law that is the activation of the actuator.
    pub(super) activation: Option<usize>,
    /// Factor that converts control and activation from the file to the scene.
    pub(super) factor: f64,
    /// Number of activation values of the actuator in the file, if it is known.
    pub(super) activations: Option<usize>,
}

/// The model while its parts are read.
pub(super) struct Model<'a, 'b, 'c> {
    /// Meshes by their names.
    pub(super) meshes: HashMap<String, &'a Element>,
    pub(super) compiler: Compiler,
    pub(super) classes: &'a Classes<'a>,
    pub(super) context: &'b mut Context<'c>,
    pub(super) robot: Robot,
    pub(super) bodies: Named,
    /// Links of the bodies. Massless links between joints are in the list of links too, so that indices of bodies and links differ.
    pub(super) body_links: Vec<usize>,
    /// Size factors of links in frames with a scale.
    pub(super) sizes: HashMap<usize, Size>,
    pub(super) joints: Named,
    pub(super) motions: Vec<Motion>,
    pub(super) site_names: Named,
    pub(super) sites: Vec<Site>,
    pub(super) tendon_names: Named,
    pub(super) tendons: Vec<Tendon>,
    /// Link, inertia and fraction of compensated weight for each body of the file. Settings of the whole model limit and scale the inertias
    /// later.
    pub(super) masses: Vec<(usize, Mass, f64)>,
    /// Endings that `replicate` adds to a name, by the name without an ending.
    pub(super) copies: HashMap<String, Vec<String>>,
    /// Controls of the actuators, by actuator index.
    pub(super) inputs: Vec<Control>,
    /// Coordinates of the keyframe that gives the reference configuration. `None` if the bodies are as drawn.
    pub(super) posed: Option<Vec<f64>>,
    /// Poses of links in the configuration in which the model is drawn.
    pub(super) drawn: HashMap<usize, Pose>,
    /// True if a loop is open in the reference configuration.
    pub(super) is_open: bool,
    /// Number of geoms that could be in contact.
    pub(super) touching: usize,
    names: HashSet<(Sort, String)>,
}

impl<'a, 'b, 'c> Model<'a, 'b, 'c> {
    pub(super) fn new(
        compiler: Compiler,
        classes: &'a Classes<'a>,
        robot: Robot,
        context: &'b mut Context<'c>,
    ) -> Self {
        Self {
            compiler,
            classes,
            context,
            robot,
            bodies: Named::new("body", 0),
            body_links: Vec::new(),
            sizes: HashMap::new(),
            joints: Named::new("joint", 0),
            motions: Vec::new(),
            site_names: Named::new("site", 0),
            sites: Vec::new(),
            tendon_names: Named::new("tendon", 0),
            tendons: Vec::new(),
            masses: Vec::new(),
            copies: HashMap::new(),
            inputs: Vec::new(),
            touching: 0,
            posed: None,
            drawn: HashMap::new(),
            is_open: false,
            meshes: HashMap::new(),
            names: HashSet::new(),
        }
    }

    /// A name that is unique among its kind: the given name, with an ending if needed.
    pub(super) fn free_name(&mut self, sort: Sort, wanted: &str) -> String {
        let mut name = wanted.to_owned();
        let mut number = 1;
        while !self.names.insert((sort, name.clone())) {
            number += 1;
            name = format!("{wanted}~{number}");
        }
        name
    }

    /// Adds an effect or a signal, and returns its name.
    pub(super) fn law(&mut self, wanted: &str, what: What) -> String {
        let name = self.free_name(Sort::Law, wanted);
        self.robot.laws.push(Law { name: name.clone(), what });
        name
    }

    /// Position, in the drawn configuration, of the point of a link that is at `place` in the reference configuration.
    pub(super) fn as_drawn(&self, link: usize, place: &V3) -> V3 {
        let drawn = self.drawn.get(&link);
        drawn.map_or(*place, |drawn| {
            drawn.point(&self.robot.links[link].pose.inverse().point(place))
        })
    }

    /// Adds a signal and returns its name.
    pub(super) fn signal(&mut self, wanted: &str, signal: Signal) -> String {
        self.law(wanted, What::Signal(signal))
    }

    /// Stores a name together with the ending that `replicate` adds to it.
    pub(super) fn copied(&mut self, name: &str, ending: &str) -> String {
        if !ending.is_empty() {
            let endings = self.copies.entry(name.to_owned()).or_default();
            if !endings.iter().any(|known| known == ending) {
                endings.push(ending.to_owned());
            }
        }
        format!("{name}{ending}")
    }

    /// The link of a body, by the body's name.
    pub(super) fn body(&self, name: &Attribute, ending: &str) -> Read<usize> {
        let word = name.value.trim();
        if word == "world" {
            return Ok(GROUND);
        }
        let number = self.bodies.find_copy(word, ending, name.at)?;
        Ok(self.body_links[number])
    }

    /// A site of the file, by its name.
    pub(super) fn site(&self, name: &Attribute, ending: &str) -> Read<&Site> {
        let number = self.site_names.find_copy(name.value.trim(), ending, name.at)?;
        Ok(&self.sites[number])
    }

    /// A joint of the file, by its name.
    pub(super) fn motion(&self, name: &Attribute, ending: &str) -> Read<&Motion> {
        let number = self.joints.find_copy(name.value.trim(), ending, name.at)?;
        Ok(&self.motions[number])
    }

    /// A tendon by its name, with its index.
    pub(super) fn tendon(&self, name: &Attribute, ending: &str) -> Read<(usize, &Tendon)> {
        let number = self.tendon_names.find_copy(name.value.trim(), ending, name.at)?;
        Ok((number, &self.tendons[number]))
    }

    /// Endings of the copies of an element. When an element refers to a copied part by the name without ending, the element is copied for
    /// each ending. Otherwise the list has a single, empty ending.
    pub(super) fn endings(&self, element: &Element) -> Vec<String> {
        let mut names = element
            .attributes
            .iter()
            .chain(element.children.iter().flat_map(|child| &child.attributes));
        let found = names.find_map(|word| {
            let is_name = word.name != "name" && word.name != "class";
            self.copies.get(word.value.trim()).filter(|_| is_name)
        });
        found.cloned().unwrap_or_else(|| vec![String::new()])
    }

    /// A joint with one coordinate, by its name.
    pub(super) fn single(&self, name: &Attribute, ending: &str) -> Read<&Motion> {
        let motion = self.motion(name, ending)?;
        if motion.is_single() {
            return Ok(motion);
        }
        let message = format!("joint `{}` has several coordinates", motion.name);
        Err(name.fault(message, "name a hinge or a slide"))
    }
}

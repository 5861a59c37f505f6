//! Model that the parts of the reader fill in together.

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

/// Kind of a joint of the file, by what it lets move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Moves {
    Hinge,
    Slide,
    Ball,
    Free,
}

impl Moves {
    /// Numbers of its place in a keyframe.
    pub(super) const fn places(self) -> usize {
        match self {
            Self::Hinge | Self::Slide => 1,
            Self::Ball => 4,
            Self::Free => 7,
        }
    }
}

/// Sort of what names are of: names of one sort differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Sort {
    Link,
    Joint,
    Law,
}

/// A joint of the file, and where its coordinates are in the scene.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    pub(super) name: String,
    pub(super) at: Origin,
    pub(super) moves: Moves,
    /// The joint of the scene.
    pub(super) joint: usize,
    /// Number of the coordinate, where the joint has several.
    pub(super) number: Option<usize>,
    /// The scene's coordinate grows against the file's where this is −1.
    pub(super) sign: f64,
    /// The file's coordinate in the reference configuration.
    pub(super) zero: f64,
    /// Coordinate of the file as the model is drawn.
    pub(super) drawn: f64,
    /// Coordinate of the file without tension in its spring.
    pub(super) spring: f64,
    /// Ends of the file's coordinate.
    pub(super) range: Option<[f64; 2]>,
    /// Ends of the effort of all actuators.
    pub(super) effort: Option<[f64; 2]>,
    pub(super) armature: f64,
    /// Direction of the motion in the reference configuration, global: of a turn about the place of its joint.
    pub(super) axis: V3,
    /// Time and damping ratio of its stops, where it has any.
    pub(super) stops: Option<[f64; 2]>,
    /// Time and damping ratio from which its spring follows.
    pub(super) timed: Option<[f64; 2]>,
    /// Size of the frames in which the joint stands.
    pub(super) size: Size,
    /// Spring and damper of the joint, where they act.
    pub(super) strengths: [Strength; 2],
}

impl Motion {
    /// Is it one coordinate?
    pub(super) const fn is_single(&self) -> bool {
        matches!(self.moves, Moves::Hinge | Moves::Slide)
    }

    /// The coordinate of the scene.
    pub(super) const fn coordinate(&self) -> Coordinate {
        Coordinate { joint: self.joint, number: self.number }
    }

    pub(super) const fn target(&self) -> Target {
        Target::Coordinate(self.coordinate())
    }

    /// A term of a sum of the file's coordinates, and what it adds to the sum in the reference configuration.
    pub(super) fn term(&self, factor: f64) -> (Term, f64) {
        let term = Term::new(self.coordinate(), factor * self.sign);
        (term, factor * self.zero)
    }

    /// Joint of the file with the place of its numbers in the scene.
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

    /// A value of the file as one of the scene.
    pub(super) fn in_scene(&self, value: f64) -> f64 {
        self.sign * (value - self.zero)
    }

    /// Ends of the file's coordinate as ends of the scene's.
    pub(super) fn ends(&self, [lower, upper]: [f64; 2]) -> [f64; 2] {
        let [a, b] = [self.in_scene(lower), self.in_scene(upper)];
        [a.min(b), a.max(b)]
    }
}

/// A named place of the file.
#[derive(Debug, Clone)]
pub(super) struct Site {
    pub(super) name: String,
    pub(super) link: usize,
    pub(super) pose: Pose,
    /// Size of the frames in which the site stands.
    pub(super) size: Size,
}

impl Site {
    /// Does it stand in a frame with a scale?
    pub(super) fn is_grown(&self) -> bool {
        self.size != Size::ONE
    }
}

/// A tendon; without terms it is nothing that the scene can pull.
#[derive(Debug, Clone, Default)]
pub(super) struct Tendon {
    pub(super) name: String,
    pub(super) terms: Vec<Term>,
    /// Length of the tendon in the reference configuration.
    pub(super) drawn: f64,
    /// Ends of its length.
    pub(super) range: Option<[f64; 2]>,
    /// Ends of the force of all its actuators.
    pub(super) effort: Option<[f64; 2]>,
    /// Is any part of it in a frame with a scale?
    pub(super) is_grown: bool,
}

/// Control of an actuator, which a keyframe sets.
#[derive(Debug, Clone)]
pub(super) struct Control {
    /// The law of its input.
    pub(super) law: Option<usize>,
    /// The law of its activation.
    pub(super) activation: Option<usize>,
    /// Factor of its control and its activation in the file.
    pub(super) factor: f64,
    /// Count of the numbers that the activation has in the file, if that is known.
    pub(super) activations: Option<usize>,
}

/// The model while it is read.
pub(super) struct Model<'a, 'b, 'c> {
    /// Meshes by their names.
    pub(super) meshes: HashMap<String, &'a Element>,
    pub(super) compiler: Compiler,
    pub(super) classes: &'a Classes<'a>,
    pub(super) context: &'b mut Context<'c>,
    pub(super) robot: Robot,
    pub(super) bodies: Named,
    /// The links of the bodies: massless ones between joints have numbers too.
    pub(super) body_links: Vec<usize>,
    /// Sizes of links that stand in frames with a scale.
    pub(super) sizes: HashMap<usize, Size>,
    pub(super) joints: Named,
    pub(super) motions: Vec<Motion>,
    pub(super) site_names: Named,
    pub(super) sites: Vec<Site>,
    pub(super) tendon_names: Named,
    pub(super) tendons: Vec<Tendon>,
    /// Link, inertia and share of its weight that is lifted, of each body of the file: settings of the whole model bound and scale them.
    pub(super) masses: Vec<(usize, Mass, f64)>,
    /// Endings of names that `replicate` gives, by the name without one.
    pub(super) copies: HashMap<String, Vec<String>>,
    /// Controls by the number of the actuator.
    pub(super) inputs: Vec<Control>,
    /// Coordinates of the keyframe at which bodies stand in the reference configuration; `None`: as they are drawn.
    pub(super) posed: Option<Vec<f64>>,
    /// Poses of links as they are drawn.
    pub(super) drawn: HashMap<usize, Pose>,
    /// Is a loop open in the reference configuration?
    pub(super) is_open: bool,
    /// Geoms that could touch others.
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

    /// A name that nothing of its sort has yet: this one, or with an ending.
    pub(super) fn free_name(&mut self, sort: Sort, wanted: &str) -> String {
        let mut name = wanted.to_owned();
        let mut number = 1;
        while !self.names.insert((sort, name.clone())) {
            number += 1;
            name = format!("{wanted}~{number}");
        }
        name
    }

    /// Adds a law or a signal; its name.
    pub(super) fn law(&mut self, wanted: &str, what: What) -> String {
        let name = self.free_name(Sort::Law, wanted);
        self.robot.laws.push(Law { name: name.clone(), what });
        name
    }

    /// A place of a link in the reference configuration, where it is drawn.
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

    /// Keeps a name with the ending that `replicate` gives it.
    pub(super) fn copied(&mut self, name: &str, ending: &str) -> String {
        if !ending.is_empty() {
            let endings = self.copies.entry(name.to_owned()).or_default();
            if !endings.iter().any(|known| known == ending) {
                endings.push(ending.to_owned());
            }
        }
        format!("{name}{ending}")
    }

    /// The link of a body by its name.
    pub(super) fn body(&self, name: &Attribute, ending: &str) -> Read<usize> {
        let word = name.value.trim();
        if word == "world" {
            return Ok(GROUND);
        }
        let number = self.bodies.find_copy(word, ending, name.at)?;
        Ok(self.body_links[number])
    }

    /// A place by its name.
    pub(super) fn site(&self, name: &Attribute, ending: &str) -> Read<&Site> {
        let number = self.site_names.find_copy(name.value.trim(), ending, name.at)?;
        Ok(&self.sites[number])
    }

    /// A joint by its name.
    pub(super) fn motion(&self, name: &Attribute, ending: &str) -> Read<&Motion> {
        let number = self.joints.find_copy(name.value.trim(), ending, name.at)?;
        Ok(&self.motions[number])
    }

    /// A tendon by its name, with its number.
    pub(super) fn tendon(&self, name: &Attribute, ending: &str) -> Read<(usize, &Tendon)> {
        let number = self.tendon_names.find_copy(name.value.trim(), ending, name.at)?;
        Ok((number, &self.tendons[number]))
    }

    /// The endings of the copies that an element names, or none: what names a copied thing by its plain name is copied with it.
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

    /// A joint of one coordinate by its name.
    pub(super) fn single(&self, name: &Attribute, ending: &str) -> Read<&Motion> {
        let motion = self.motion(name, ending)?;
        if motion.is_single() {
            return Ok(motion);
        }
        let message = format!("joint `{}` has several coordinates", motion.name);
        Err(name.fault(message, "name a hinge or a slide"))
    }
}

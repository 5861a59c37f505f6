//! Model that the readers of all formats fill in: links and joints in global axes of the reference configuration.

use crate::coordinates::FileCoordinate;
use crate::inertia::Mass;
use crate::pose::{Pose, V3};
use crate::source::Origin;
use std::collections::HashSet;

/// The link that is the ground.
pub(crate) const GROUND: usize = 0;

/// A model of links and joints.
#[derive(Debug, Clone, Default)]
pub(crate) struct Robot {
    pub(crate) name: String,
    /// Links, the ground first.
    pub(crate) links: Vec<Link>,
    pub(crate) joints: Vec<Joint>,
    pub(crate) couplings: Vec<Coupling>,
    /// Laws and signals, in the order in which they are written.
    pub(crate) laws: Vec<Law>,
    pub(crate) shapes: Vec<Form>,
    pub(crate) frames: Vec<Frame>,
    pub(crate) gravity: [f64; 3],
    /// Values and rates at the start.
    pub(crate) start: Vec<Start>,
    /// The coordinates of the file in its order, where the file gives them one.
    pub(crate) coordinates: Vec<FileCoordinate>,
    /// Sentences for the head of the scene.
    pub(crate) notes: Vec<String>,
}

/// A rigid part of a model.
#[derive(Debug, Clone)]
pub(crate) struct Link {
    pub(crate) name: String,
    pub(crate) at: Origin,
    /// Pose of the link in the reference configuration.
    pub(crate) pose: Pose,
    /// Inertia of the link in global axes; `None` where the file writes no inertia.
    pub(crate) mass: Option<Mass>,
    /// Factor of gravity on it.
    pub(crate) gravity_scale: f64,
}

/// The kinds of joints that formats have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    /// Fixed joint: both links are welded to one body.
    Fixed,
    /// Welded, and written as a joint of the scene: its reaction is wanted, or it closes a loop.
    Weld,
    Revolute,
    Prismatic,
    Cylindrical,
    Universal,
    Spherical,
    Planar,
    Free,
    /// Two points keep their distance; `place` and this point.
    Distance(V3),
}

/// A joint between two links.
#[derive(Debug, Clone)]
pub(crate) struct Joint {
    pub(crate) name: String,
    pub(crate) at: Origin,
    pub(crate) kind: Kind,
    pub(crate) parent: usize,
    pub(crate) child: usize,
    /// Place of the joint, global.
    pub(crate) place: V3,
    /// Global axes of unit length: one, two of a cross, normal and first slide of a plane.
    pub(crate) axes: Vec<V3>,
    /// Coordinate of the file where that of the scene is zero.
    pub(crate) zero: f64,
    /// Ends of the scene's coordinate.
    pub(crate) range: Option<[f64; 2]>,
    /// Largest effort and rate of its drive.
    pub(crate) effort: Option<f64>,
    pub(crate) rate: Option<f64>,
    /// Does it close a loop that the file writes as an equation?
    pub(crate) closes: bool,
}

/// A coordinate of a joint.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Coordinate {
    /// The number of the joint.
    pub(crate) joint: usize,
    /// Number of the coordinate, where the joint has several.
    pub(crate) number: Option<usize>,
}

/// A term of a sum.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Term {
    pub(crate) of: Coordinate,
    pub(crate) factor: f64,
    /// A polynomial of the coordinate in its place, where there are any.
    pub(crate) coefficients: Vec<f64>,
    /// The length of a line over places of links in place of the coordinate, where there are any.
    pub(crate) line: Vec<(usize, V3)>,
}

impl Term {
    /// A coordinate with its factor.
    pub(crate) const fn new(of: Coordinate, factor: f64) -> Self {
        Self { of, factor, coefficients: Vec::new(), line: Vec::new() }
    }
}

/// A sum of coordinates that holds.
#[derive(Debug, Clone)]
pub(crate) struct Coupling {
    pub(crate) name: String,
    pub(crate) terms: Vec<Term>,
    pub(crate) value: f64,
}

/// A polynomial of degree three between two values, by increasing power.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Piece {
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    pub(crate) coefficients: [f64; 4],
}

/// Target of a law: what it acts on.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Target {
    Coordinate(Coordinate),
    Sum(Vec<Term>),
}

/// An effect or a signal of the scene.
#[derive(Debug, Clone)]
pub(crate) struct Law {
    pub(crate) name: String,
    pub(crate) what: What,
}

/// Effects and signals that formats have.
#[derive(Debug, Clone)]
pub(crate) enum What {
    Spring {
        on: Target,
        stiffness: f64,
        damping: f64,
        free: f64,
    },
    /// A spring or a damper by pieces of a polynomial of a sum, or of its rate.
    Polynomial {
        terms: Vec<Term>,
        pieces: Vec<Piece>,
        of_rate: bool,
    },
    /// A spring that is slack below its free value.
    Pull {
        on: Target,
        stiffness: f64,
        free: f64,
    },
    Friction {
        on: Target,
        coulomb: f64,
    },
    Rotor {
        on: Target,
        inertia: f64,
    },
    Limit {
        on: Target,
        lower: f64,
        upper: f64,
        stiffness: f64,
        damping: f64,
    },
    /// Stops at the ends of the joint's own range.
    RangeLimit {
        on: Target,
        stiffness: Option<[f64; 2]>,
    },
    /// A moment or force that is set from outside.
    Input {
        on: Target,
        value: f64,
    },
    /// A moment or force that follows a signal, by its name.
    Driven {
        on: Target,
        signal: String,
    },
    /// A force at a place, or without one a moment, whose components follow signals: along global axes, or those of the reference
    /// configuration that turn with the link.
    Push {
        link: usize,
        at: Option<V3>,
        turns: bool,
        signals: [String; 3],
    },
    Bushing {
        links: [usize; 2],
        place: V3,
        stiffness: [f64; 6],
        damping: [f64; 6],
    },
    Signal(Signal),
}

/// Signals that formats have.
#[derive(Debug, Clone)]
pub(crate) enum Signal {
    /// Input that is set from outside, with its unit where that is known.
    Set {
        value: f64,
        unit: &'static str,
    },
    Measure {
        of: Coordinate,
        is_rate: bool,
    },
    MeasureLine {
        line: Vec<(usize, V3)>,
        is_rate: bool,
    },
    Constant {
        value: f64,
    },
    /// Sum of signals with factors.
    Sum {
        of: Vec<(String, f64)>,
    },
    Clamp {
        of: String,
        lower: f64,
        upper: f64,
    },
    Lag {
        of: String,
        time: f64,
        /// Value at the start of the run.
        value: f64,
    },
    Product {
        of: Vec<String>,
    },
    /// A signal within limits by that signal.
    LimitRatio {
        of: String,
        lower: f64,
        upper: f64,
    },
    /// The integral of a signal, which stops at the ends of its range.
    Integral {
        of: String,
        range: Option<[f64; 2]>,
        /// Value at the start of the run.
        value: f64,
    },
}

/// Form that is drawn, in the frame of `pose` in global axes.
#[derive(Debug, Clone)]
pub(crate) struct Form {
    pub(crate) link: usize,
    pub(crate) pose: Pose,
    pub(crate) kind: FormKind,
    /// Red, green, blue and opacity, each to 1.
    pub(crate) colour: Option<[f64; 4]>,
}

/// Forms along the z axis of their frame.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum FormKind {
    /// Lengths of a box along its three axes.
    Box([f64; 3]),
    Sphere {
        radius: f64,
    },
    /// Radius, and length without the round ends.
    Capsule {
        radius: f64,
        length: f64,
    },
    Cylinder {
        radius: f64,
        length: f64,
    },
    /// The file as the scene names it, and factors of its numbers.
    Mesh {
        file: String,
        scale: [f64; 3],
    },
}

/// A named place on a link.
#[derive(Debug, Clone)]
pub(crate) struct Frame {
    pub(crate) name: String,
    pub(crate) link: usize,
    pub(crate) pose: Pose,
}

/// Coordinates of a joint at the start.
#[derive(Debug, Clone)]
pub(crate) struct Start {
    pub(crate) joint: usize,
    pub(crate) value: Vec<f64>,
    pub(crate) rate: Vec<f64>,
}

/// The name that a link or a frame has in the scene, which calls by `ground` what does not move.
pub(crate) fn scene_name(name: &str, what: &str) -> String {
    if name == "ground" { format!("{name}-{what}") } else { name.to_owned() }
}

/// Are the factors along all axes the same?
pub(crate) fn is_even(scale: [f64; 3]) -> bool {
    scale.map(f64::to_bits) == [scale[0].to_bits(); 3]
}

impl FormKind {
    /// The form, if all its sizes are above zero.
    pub(crate) fn of_size(self) -> Option<Self> {
        let is_there = match &self {
            Self::Box(size) => size.iter().all(|x| *x > 0.0),
            Self::Sphere { radius } => *radius > 0.0,
            Self::Capsule { radius, length } | Self::Cylinder { radius, length } => {
                *radius > 0.0 && *length > 0.0
            }
            Self::Mesh { scale, .. } => scale.iter().all(|x| *x != 0.0),
        };
        is_there.then_some(self)
    }
}

/// Red, green, blue and opacity of three or four numbers; some files write other counts, and a colour is for the eye alone.
pub(crate) fn colour(numbers: &[f64]) -> Option<[f64; 4]> {
    match *numbers {
        [r, g, b] => Some([r, g, b, 1.0]),
        [r, g, b, a] => Some([r, g, b, a]),
        _ => None,
    }
}

impl Coupling {
    /// x − factor y = offset of the coordinates x and y.
    pub(crate) fn follows(name: &str, [x, y]: [Coordinate; 2], factor: f64, offset: f64) -> Self {
        let terms = vec![Term::new(x, 1.0), Term::new(y, -factor)];
        Self { name: format!("{name} mimic"), terms, value: offset }
    }
}

impl Link {
    /// A link at the origin, without mass.
    pub(crate) fn new(name: &str, at: Origin) -> Self {
        Self {
            name: scene_name(name, "link"),
            at,
            pose: Pose::identity(),
            mass: None,
            gravity_scale: 1.0,
        }
    }
}

impl Joint {
    /// A joint of a kind between two links, with nothing else.
    pub(crate) fn new(
        name: &str,
        at: Origin,
        kind: Kind,
        [parent, child]: [usize; 2],
        place: V3,
    ) -> Self {
        Self {
            name: name.to_owned(),
            at,
            kind,
            parent,
            child,
            place,
            axes: Vec::new(),
            zero: 0.0,
            range: None,
            effort: None,
            rate: None,
            closes: false,
        }
    }
}

impl Robot {
    /// A model with the ground alone.
    pub(crate) fn new(name: &str, source: u16) -> Self {
        let at = Origin::start_of(source);
        let ground = Link { name: "ground".into(), ..Link::new("", at) };
        Self { name: name.to_owned(), links: vec![ground], ..Self::default() }
    }

    /// Gives links and frames that have the same name other ones: the scene names both of one kind.
    pub(crate) fn rename_alike(&mut self) {
        let mut taken = HashSet::new();
        let links = self.links.iter_mut().map(|link| &mut link.name);
        for name in links.chain(self.frames.iter_mut().map(|frame| &mut frame.name)) {
            while !taken.insert(name.clone()) {
                name.push('~');
            }
        }
    }

    /// The link that carries each, over some of the joints, from child to parent. The ground carries all that is joined to it.
    pub(crate) fn carriers(&self, is_counted: impl Fn(&Joint) -> bool) -> Vec<usize> {
        fn root(parent: &mut [usize], mut link: usize) -> usize {
            while parent[link] != link {
                parent[link] = parent[parent[link]];
                link = parent[link];
            }
            link
        }
        let mut parent: Vec<usize> = (0..self.links.len()).collect();
        for joint in self.joints.iter().filter(|joint| is_counted(joint)) {
            let (a, b) = (root(&mut parent, joint.parent), root(&mut parent, joint.child));
            if b == GROUND { parent[a] = b } else { parent[b] = a }
        }
        (0..self.links.len()).map(|link| root(&mut parent, link)).collect()
    }
}

//! Model that the readers of all formats fill: links and joints, in global axes of the reference configuration.

use crate::coordinates::FileCoordinate;
use crate::inertia::Mass;
use crate::pose::{Pose, V3};
use crate::source::Origin;
use std::collections::HashSet;

/// Index of the link that is the ground.
pub(crate) const GROUND: usize = 0;

/// A model of links and joints.
#[derive(Debug, Clone, Default)]
pub(crate) struct Robot {
    pub(crate) name: String,
    /// Links, the ground first.
    pub(crate) links: Vec<Link>,
    pub(crate) joints: Vec<Joint>,
    pub(crate) couplings: Vec<Coupling>,
    /// Effects and signals, in the order in which they are written.
    pub(crate) laws: Vec<Law>,
    pub(crate) shapes: Vec<Form>,
    pub(crate) frames: Vec<Frame>,
    pub(crate) gravity: [f64; 3],
    /// Initial values and rates of joint coordinates.
    pub(crate) start: Vec<Start>,
    /// Coordinates in the order of the file, if the format numbers them.
    pub(crate) coordinates: Vec<FileCoordinate>,
    /// Sentences of the comment at the head of the scene.
    pub(crate) notes: Vec<String>,
}

/// A rigid part of a model; links that are welded become one body.
#[derive(Debug, Clone)]
pub(crate) struct Link {
    pub(crate) name: String,
    pub(crate) at: Origin,
    /// Pose of the link in the reference configuration.
    pub(crate) pose: Pose,
    /// Inertia of the link in global axes; `None` when the file has none.
    pub(crate) mass: Option<Mass>,
    /// Factor of gravity for this link [-].
    pub(crate) gravity_scale: f64,
}

/// Kinds of joints in the formats of models.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    /// Fixed joint: both links are welded to one body.
    Fixed,
    /// Weld that is written as a joint of the scene, because its reaction is requested or because it closes a loop.
    Weld,
    Revolute,
    Prismatic,
    Cylindrical,
    Universal,
    Spherical,
    Planar,
    Free,
    /// Joint that holds the distance between two points constant: `place`, and the point given here.
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
    /// Place of the joint in global axes [m].
    pub(crate) place: V3,
    /// Global axes of unit length: one axis, the two axes of a universal joint, or the normal and the first translation of a planar joint.
    pub(crate) axes: Vec<V3>,
    /// Coordinate of the file at which the scene's coordinate is zero.
    pub(crate) zero: f64,
    /// Limits of the scene's coordinate [rad or m].
    pub(crate) range: Option<[f64; 2]>,
    /// Limits of the effort of the drive [N m or N] and of the rate [rad/s or m/s].
    pub(crate) effort: Option<f64>,
    pub(crate) rate: Option<f64>,
    /// True if the joint closes a loop that the file gives as a constraint equation.
    pub(crate) closes: bool,
}

/// A coordinate of a joint.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Coordinate {
    /// Index of the joint.
    pub(crate) joint: usize,
    /// Index of the coordinate, if the joint has several.
    pub(crate) number: Option<usize>,
}

/// A term of a sum of coordinates and lengths.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Term {
    pub(crate) of: Coordinate,
    pub(crate) factor: f64,
    /// Coefficients of a polynomial of the coordinate, which replaces the coordinate unless the list is empty.
    pub(crate) coefficients: Vec<f64>,
    /// Points of a line on links, whose length replaces the coordinate unless the list is empty.
    pub(crate) line: Vec<(usize, V3)>,
}

impl Term {
    /// The term of a coordinate with its factor.
    pub(crate) const fn new(of: Coordinate, factor: f64) -> Self {
        Self { of, factor, coefficients: Vec::new(), line: Vec::new() }
    }
}

/// A constraint on a sum of coordinates: the sum equals the value.
#[derive(Debug, Clone)]
pub(crate) struct Coupling {
    pub(crate) name: String,
    pub(crate) terms: Vec<Term>,
    pub(crate) value: f64,
}

/// A cubic polynomial between two values, with coefficients of increasing power.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Piece {
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    pub(crate) coefficients: [f64; 4],
}

/// Coordinate or sum on which a law acts.
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

/// Kinds of effects and signals in the formats of models.
#[derive(Debug, Clone)]
pub(crate) enum What {
    Spring {
        on: Target,
        stiffness: f64,
        damping: f64,
        free: f64,
    },
    /// A spring or damper whose force is a piecewise polynomial of a sum, or of its rate.
    Polynomial {
        terms: Vec<Term>,
        pieces: Vec<Piece>,
        of_rate: bool,
    },
    /// A spring that has no force below its free value.
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
    /// Stops at the limits of the joint.
    RangeLimit {
        on: Target,
        stiffness: Option<[f64; 2]>,
    },
    /// A moment or force that is an input of the scene.
    Input {
        on: Target,
        value: f64,
    },
    /// A moment or force that equals a signal, given by its name.
    Driven {
        on: Target,
        signal: String,
    },
    /// A force at a point of a link. Without a point it is a moment on the link. The components are signals, along global axes. When `turns`
    /// is true, the axes turn with the link from the reference configuration on.
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

/// Kinds of signals in the formats of models.
#[derive(Debug, Clone)]
pub(crate) enum Signal {
    /// Input of the scene, with its unit if it is known.
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
    /// Sum of signals, each multiplied by a factor.
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
    /// Ratio of the limited signal to the signal itself [-].
    LimitRatio {
        of: String,
        lower: f64,
        upper: f64,
    },
    /// The integral of a signal, limited to its range.
    Integral {
        of: String,
        range: Option<[f64; 2]>,
        /// Value at the start of the run.
        value: f64,
    },
}

/// A shape for pictures; `pose` is its frame in global axes.
#[derive(Debug, Clone)]
pub(crate) struct Form {
    pub(crate) link: usize,
    pub(crate) pose: Pose,
    pub(crate) kind: FormKind,
    /// Red, green, blue and opacity, each from 0 to 1.
    pub(crate) colour: Option<[f64; 4]>,
}

/// Kinds of shapes; cylinders and capsules are along the z axis of their frame.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum FormKind {
    /// Edge lengths of a box along its three axes [m].
    Box([f64; 3]),
    Sphere {
        radius: f64,
    },
    /// Radius, and length without the round ends [m].
    Capsule {
        radius: f64,
        length: f64,
    },
    Cylinder {
        radius: f64,
        length: f64,
    },
    /// Mesh file, by its name in the scene, and scale factors of its coordinates.
    Mesh {
        file: String,
        scale: [f64; 3],
    },
}

/// A named frame on a link.
#[derive(Debug, Clone)]
pub(crate) struct Frame {
    pub(crate) name: String,
    pub(crate) link: usize,
    pub(crate) pose: Pose,
}

/// Initial coordinates and rates of a joint.
#[derive(Debug, Clone)]
pub(crate) struct Start {
    pub(crate) joint: usize,
    pub(crate) value: Vec<f64>,
    pub(crate) rate: Vec<f64>,
}

/// Name of a link or a frame in the scene. The name `ground` gets an ending, because the scene uses it for the ground.
pub(crate) fn scene_name(name: &str, what: &str) -> String {
    if name == "ground" { format!("{name}-{what}") } else { name.to_owned() }
}

/// True if the factors along all axes are equal.
pub(crate) fn is_even(scale: [f64; 3]) -> bool {
    scale.map(f64::to_bits) == [scale[0].to_bits(); 3]
}

impl FormKind {
    /// The shape, if all its sizes are above zero.
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

/// Red, green, blue and opacity from three or four numbers. Other counts give `None`, not an error, since a colour does not affect the
/// motion.
pub(crate) fn colour(numbers: &[f64]) -> Option<[f64; 4]> {
    match *numbers {
        [r, g, b] => Some([r, g, b, 1.0]),
        [r, g, b, a] => Some([r, g, b, a]),
        _ => None,
    }
}

impl Coupling {
    /// The coupling x − factor y = offset of the coordinates x and y.
    pub(crate) fn follows(name: &str, [x, y]: [Coordinate; 2], factor: f64, offset: f64) -> Self {
        let terms = vec![Term::new(x, 1.0), Term::new(y, -factor)];
        Self { name: format!("{name} mimic"), terms, value: offset }
    }
}

impl Link {
    /// A link at the origin of the global axes, without mass.
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
    /// A joint between two links, without axes, limits or other data.
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
    /// A model that has only the ground.
    pub(crate) fn new(name: &str, source: u16) -> Self {
        let at = Origin::start_of(source);
        let ground = Link { name: "ground".into(), ..Link::new("", at) };
        Self { name: name.to_owned(), links: vec![ground], ..Self::default() }
    }

    /// Makes the names of links and frames unique, since the scene has both in one list of names.
    pub(crate) fn rename_alike(&mut self) {
        let mut taken = HashSet::new();
        let links = self.links.iter_mut().map(|link| &mut link.name);
        for name in links.chain(self.frames.iter_mut().map(|frame| &mut frame.name)) {
            while !taken.insert(name.clone()) {
                name.push('~');
            }
        }
    }

    /// For each link, the root that is reached along the joints that `is_counted` selects, from child to parent. Links that are joined to the
    /// ground have the ground as root.
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

//! Conversion of a scene to the syntax tree of a scene file.
//!
//! Every number is written, zeros too, so that each has a path. A key is left out when its value equals a default that the reader computes
//! from other keys.

mod coupling;
mod effect;
mod frame;
mod output;
mod road;
mod rolling;
mod shape;
mod signal;
mod solver;

use super::toml;
use crate::read::SceneFile;
use crate::read::tree::{Item, Member, Node};
use core::fmt::{self, Display, Formatter};
use mbs_core::scene::{
    Body, BodyId, CouplingMeasure, CouplingTerm, Curve, Dimension, Guide, Inertia,
    InitialCondition, InitialTarget, Joint, JointId, JointLimits, Number, Scene, Start,
};

/// Error when a scene cannot be written as text.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum WriteError {
    /// A part of the scene that is code, with its kind and name.
    InCode(String),
    /// A reference to a body or joint that is not in the scene, with the key of the entry. Scenes built in code can have such references.
    UnknownReference(&'static str),
    /// A file or key that cannot be written, with the reason.
    NotWritten(String),
}

impl Display for WriteError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::InCode(part) => write!(f, "{part} is code, which has no text"),
            Self::NotWritten(problem) => write!(f, "the file cannot be written: {problem}"),
            Self::UnknownReference(key) => {
                write!(f, "`{key}` points to something that is not in the scene")
            }
        }
    }
}

impl core::error::Error for WriteError {}

/// The text of a scene file. Numbers keep all their digits, so reading the text gives an equal scene.
///
/// # Errors
/// [`WriteError`] for a part in code, or a reference to a part that is not in the scene.
///
/// # Examples
/// ```
/// # let text = "[scene]\ndimension = 2\nduration = 0.1000000000000000000001\n";
/// let scene = mbs_scene::SceneFile::parse(text, "empty.toml")?.numbers()?;
/// let again = mbs_scene::to_toml(&scene).expect("no code in it");
/// assert!(again.contains("duration = 0.1000000000000000000001"));
/// assert_eq!(mbs_scene::SceneFile::parse(&again, "empty.toml")?.numbers()?, scene);
/// # Ok::<(), mbs_scene::ReadError>(())
/// ```
pub fn to_toml(scene: &Scene<Number>) -> Result<String, WriteError> {
    let mut out = String::new();
    tables(scene, &mut |table, is_list, keys| {
        let header = if is_list { format!("[[{table}]]") } else { format!("[{table}]") };
        toml::table(&mut out, &header, &keys.0);
    })?;
    Ok(out)
}

impl SceneFile {
    /// A scene as a scene file without comments.
    ///
    /// # Errors
    /// The errors of [`to_toml`].
    pub fn of(scene: &Scene<Number>) -> Result<Self, WriteError> {
        // The writer produces valid TOML, so parsing does not fail.
        Ok(Self::parse(&to_toml(scene)?, &scene.name).unwrap_or_default())
    }

    /// The file of a scene that was read from this file and then changed. Changed values and new parts are written, and the other text
    /// remains, with its comments. When the scene has changes of another kind, the result is a file without comments.
    ///
    /// # Errors
    /// The errors of [`to_toml`].
    pub fn updated(&self, scene: &Scene<Number>) -> Result<Self, WriteError> {
        let new = tree(scene)?;
        let old = self.numbers().ok().map(|scene| tree(&scene)).transpose()?;
        let edited = old.and_then(|old| self.edited(&old, &new));
        let file = edited.and_then(|text| Self::parse(&text, self.file()).ok());
        match file {
            Some(file) if file.numbers().is_ok_and(|written| written == *scene) => Ok(file),
            _ => Self::of(scene),
        }
    }
}

/// The tables of a scene, in the order of the format.
fn tree(scene: &Scene<Number>) -> Result<Vec<Member>, WriteError> {
    let mut root = Keys::default();
    tables(scene, &mut |table, is_list, keys| {
        let Some(last) = root.0.last_mut().filter(|last| is_list && last.key == table) else {
            let node = Node::from(keys);
            return root.push(table, if is_list { list([node]) } else { node });
        };
        if let Node::List(entries) = &mut last.item.node {
            entries.push(item(keys.into()));
        }
    })?;
    Ok(root.0)
}

/// Calls a function for each table of a scene in turn, so that a large scene is never in memory as a tree. The flag is `true` for entries of
/// a list.
fn tables(
    scene: &Scene<Number>,
    visit: &mut dyn FnMut(&str, bool, Keys),
) -> Result<(), WriteError> {
    let w = Writer { scene };
    visit("scene", false, w.header());
    scene.bodies.iter().for_each(|body| visit("body", true, w.body(body)));
    scene.joints.iter().try_for_each(|x| w.joint(x).map(|keys| visit("joint", true, keys)))?;
    scene
        .initials
        .iter()
        .try_for_each(|x| w.initial(x).map(|keys| visit("initial", true, keys)))?;
    scene.guides.iter().try_for_each(|x| w.guide(x).map(|keys| visit("guide", true, keys)))?;
    scene
        .couplings
        .iter()
        .try_for_each(|x| w.coupling(x).map(|keys| visit("coupling", true, keys)))?;
    scene
        .rollings
        .iter()
        .try_for_each(|x| w.rolling(x).map(|keys| visit("rolling", true, keys)))?;
    scene.signals.iter().try_for_each(|x| w.signal(x).map(|keys| visit("signal", true, keys)))?;
    scene.frames.iter().try_for_each(|x| w.frame(x).map(|keys| visit("frame", true, keys)))?;
    scene.shapes.iter().try_for_each(|x| w.shape(x).map(|keys| visit("shape", true, keys)))?;
    scene.effects.iter().try_for_each(|x| w.effect(x).map(|keys| visit("effect", true, keys)))?;
    if let Some(road) = w.road() {
        visit("road", false, road);
    }
    scene.outputs.iter().try_for_each(|x| w.output(x).map(|keys| visit("output", true, keys)))?;
    let solver = Keys::of_solver(&scene.solver);
    if !solver.0.is_empty() {
        visit("solver", false, solver);
    }
    Ok(())
}

/// Keys of one table, with their values.
#[derive(Debug, Default)]
struct Keys(Vec<Member>);

impl Keys {
    fn push(&mut self, key: &str, node: impl Into<Node>) {
        let item = item(node.into());
        self.0.push(Member { key: key.to_owned(), key_span: 0..0, item });
    }

    /// Adds a key if it has a value.
    fn push_some(&mut self, key: &str, node: Option<impl Into<Node>>) {
        if let Some(node) = node {
            self.push(key, node);
        }
    }
}

impl From<Keys> for Node {
    fn from(keys: Keys) -> Self {
        Self::Table(keys.0)
    }
}

impl From<&str> for Node {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<&Number> for Node {
    fn from(number: &Number) -> Self {
        Self::Number(number.text())
    }
}

impl<const N: usize> From<&[Number; N]> for Node {
    fn from(numbers: &[Number; N]) -> Self {
        list(numbers.iter().map(Self::from))
    }
}

fn item(node: Node) -> Item {
    Item { span: 0..0, node }
}

fn list(nodes: impl IntoIterator<Item = Node>) -> Node {
    Node::List(nodes.into_iter().map(item).collect())
}

/// Adds the keys of a function of a number.
fn curve(keys: &mut Keys, curve: &Curve<Number>) {
    let rows = |rows: &[[Number; 2]]| list(rows.iter().map(Node::from));
    match curve {
        Curve::Table(table) => keys.push("table", rows(table)),
        Curve::Periodic(table) => {
            keys.push("table", rows(table));
            keys.push("periodic", Node::Bool(true));
        }
        Curve::Polynomial(coefficients) => {
            keys.push("coefficients", list(coefficients.iter().map(Node::from)));
        }
        Curve::Shaped { rows: table, shape, periodic } => {
            keys.push("table", rows(table));
            keys.push("interpolation", shape.name());
            if *periodic {
                keys.push("periodic", Node::Bool(true));
            }
        }
    }
}

/// Writer of entries, with the scene that they refer to.
#[derive(Clone, Copy)]
struct Writer<'a> {
    scene: &'a Scene<Number>,
}

impl Writer<'_> {
    fn is_planar(self) -> bool {
        self.scene.dimension == Dimension::Planar
    }

    /// A vector with as many numbers as the scene has dimensions. A third number that is not zero is written in a planar scene too, so that
    /// the check reports it.
    fn vector(self, [x, y, z]: &[Number; 3]) -> Node {
        let n = if z.is_absent() || (self.is_planar() && z.is_zero()) { 2 } else { 3 };
        list([x, y, z].into_iter().take(n).map(Node::from))
    }

    fn two(self, [first, second]: &[[Number; 3]; 2]) -> Node {
        list([self.vector(first), self.vector(second)])
    }

    fn body_name(self, id: BodyId) -> Result<Node, WriteError> {
        let Some(index) = id.index() else { return Ok("ground".into()) };
        let body = self.scene.bodies.get(index).ok_or(WriteError::UnknownReference("body"))?;
        Ok(body.name.as_str().into())
    }

    fn pair(self, bodies: [BodyId; 2]) -> Result<Node, WriteError> {
        Ok(list([self.body_name(bodies[0])?, self.body_name(bodies[1])?]))
    }

    fn joint_name(self, id: JointId) -> Result<Node, WriteError> {
        let joint = self.scene.joints.get(id.index());
        Ok(joint.ok_or(WriteError::UnknownReference("joint"))?.name.as_str().into())
    }

    fn header(self) -> Keys {
        let (scene, mut keys) = (self.scene, Keys::default());
        keys.push("name", scene.name.as_str());
        keys.push("dimension", Node::Number(scene.dimension.count().to_string()));
        keys.push_some("gravity", scene.gravity.as_ref().map(|g| self.vector(g)));
        keys.push("duration", &scene.duration);
        match scene.start {
            Start::Initial => {}
            Start::Equilibrium => keys.push("start", "equilibrium"),
            Start::EquilibriumNear => keys.push("start", "equilibrium-near"),
        }
        keys
    }

    fn body(self, body: &Body<Number>) -> Keys {
        let mut keys = Keys::default();
        keys.push("name", body.name.as_str());
        keys.push("mass", &body.mass);
        match &body.inertia {
            Inertia::Rod { from, to } => {
                let mut ends = Keys::default();
                ends.push("from", self.vector(from));
                ends.push("to", self.vector(to));
                keys.push("rod", ends);
            }
            Inertia::Planar(moment) => {
                keys.push("center", self.vector(&body.center));
                keys.push("inertia", moment);
            }
            Inertia::Spatial(moments) => {
                keys.push("center", self.vector(&body.center));
                keys.push("inertia", moments);
            }
            Inertia::Point => keys.push("point", self.vector(&body.center)),
        }
        keys.push_some("gravity_scale", body.gravity_scale.as_ref());
        keys
    }

    fn joint(self, joint: &Joint<Number>) -> Result<Keys, WriteError> {
        let mut keys = Keys::default();
        keys.push("name", joint.name.as_str());
        keys.push("kind", joint.kind.name());
        keys.push("bodies", self.pair(joint.bodies)?);
        if joint.kind.is_link() {
            keys.push("points", self.two(&joint.points));
        } else if !self.is_in_the_centre(joint) {
            keys.push("at", self.vector(&joint.points[0]));
        }
        match &joint.axes {
            [Some(first), Some(second)]
                if joint.kind.axis_keys(Dimension::Spatial) == ["axes"; 2] =>
            {
                keys.push("axes", list([self.vector(first), self.vector(second)]));
            }
            [axis, direction] => {
                keys.push_some("axis", axis.as_ref().map(|axis| self.vector(axis)));
                keys.push_some("direction", direction.as_ref().map(|d| self.vector(d)));
            }
        }
        let JointLimits { range, effort, velocity } = &joint.limits;
        keys.push_some("range", range.as_ref());
        keys.push_some("effort_limit", effort.as_ref());
        keys.push_some("velocity_limit", velocity.as_ref());
        Ok(keys)
    }

    /// True if a free joint is at the place that the reader assumes when no place is written.
    fn is_in_the_centre(self, joint: &Joint<Number>) -> bool {
        let body = match joint.bodies {
            [_, BodyId::Body(i)] | [BodyId::Body(i), BodyId::Ground] => self.scene.bodies.get(i),
            _ => None,
        };
        let is_same = |(a, b): (&Number, &Number)| a == b && a.is_computed() == b.is_computed();
        joint.kind.is_free()
            && body.is_some_and(|body| joint.points[0].iter().zip(&body.center).all(is_same))
    }

    fn initial(self, initial: &InitialCondition<Number>) -> Result<Keys, WriteError> {
        let mut keys = Keys::default();
        match &initial.target {
            InitialTarget::Joint { joint, value, rate } => {
                keys.push("joint", self.joint_name(*joint)?);
                let numbers = |x: &Vec<Number>| list(x.iter().map(Node::from));
                keys.push_some("value", value.as_ref().map(numbers));
                keys.push_some("rate", rate.as_ref().map(numbers));
            }
            InitialTarget::Body { body, velocity, angular_velocity } => {
                keys.push("body", self.body_name(*body)?);
                if let Some((at, velocity)) = velocity {
                    keys.push("at", self.vector(at));
                    keys.push("velocity", self.vector(velocity));
                }
                match angular_velocity {
                    Some([_, _, z]) if self.is_planar() => keys.push("angular_velocity", z),
                    spin => keys.push_some("angular_velocity", spin.as_ref()),
                }
            }
        }
        Ok(keys)
    }

    fn guide(self, guide: &Guide<Number>) -> Result<Keys, WriteError> {
        let mut keys = Keys::default();
        keys.push("joint", self.joint_name(guide.joint)?);
        let joint = self.scene.joints.get(guide.joint.index());
        if joint.is_some_and(|joint| joint.kind.n_coordinates(self.scene.dimension) > 1) {
            keys.push("coordinate", Node::Number(guide.number.to_string()));
        }
        self.motion(&mut keys, &guide.law)?;
        Ok(keys)
    }

    /// The list of the terms of a sum.
    fn terms(self, terms: &[CouplingTerm<Number>]) -> Result<Node, WriteError> {
        let terms: Result<Vec<_>, _> = terms.iter().map(|term| self.term(term)).collect();
        Ok(list(terms?))
    }

    fn term(self, term: &CouplingTerm<Number>) -> Result<Node, WriteError> {
        let mut keys = Keys::default();
        self.measure(&term.of, &mut keys)?;
        keys.push("factor", &term.factor);
        if let Some(of) = &term.curve {
            curve(&mut keys, of);
        }
        Ok(keys.into())
    }

    /// Adds the keys of a measure: a joint coordinate, a length or an angle.
    fn measure(self, of: &CouplingMeasure<Number>, keys: &mut Keys) -> Result<(), WriteError> {
        match of {
            CouplingMeasure::Coordinate { joint, number } => {
                keys.push("joint", self.joint_name(*joint)?);
                keys.push("coordinate", Node::Number(number.to_string()));
            }
            CouplingMeasure::Ball { joint, angle, axis } => {
                keys.push("joint", self.joint_name(*joint)?);
                keys.push("coordinate", angle.name());
                keys.push("axis", self.vector(axis));
            }
            CouplingMeasure::Length { points } => {
                keys.push("points", self.line(points)?);
            }
        }
        Ok(())
    }

    /// The list of the points of a line, with their bodies.
    fn line(self, points: &[(BodyId, [Number; 3])]) -> Result<Node, WriteError> {
        let point = |(body, at): &(BodyId, [Number; 3])| {
            let mut keys = Keys::default();
            keys.push("body", self.body_name(*body)?);
            keys.push("at", self.vector(at));
            Ok(Node::from(keys))
        };
        let points: Result<Vec<_>, WriteError> = points.iter().map(point).collect();
        Ok(list(points?))
    }
}

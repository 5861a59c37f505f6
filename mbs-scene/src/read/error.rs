//! Faults of a scene file, with their messages and hints.

use crate::read::coupling::{joint_to_add, no_carrier};
use crate::read::nearest::{listing, nearest_name};
use crate::read::{Place, SweepFault, units};
use core::fmt::{self, Display, Formatter};
use mbs_core::scene::{Entry, SceneError, SceneFault, SignalBreak};

/// Result of a reader: the value that was read, or the error.
pub(crate) type Read<T> = Result<T, ReadError>;

/// Error of a scene file that cannot be read or is not valid: the fault, its place, and a hint.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadError(Box<Parts>);

#[derive(Debug, Clone, PartialEq)]
struct Parts {
    file: String,
    place: Place,
    fault: ReadFault,
    /// One line for each file that includes this one, with the place of the `include`.
    included: Vec<String>,
}

/// Fault of an expression, an included file or a model, as a message and a hint.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExpressionFault {
    /// Message that says what is wrong, as a clause.
    pub message: String,
    /// Hint that says what to do about the fault.
    pub hint: String,
}

/// All faults that a scene file can have.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum ReadFault {
    /// The file cannot be read.
    Unreadable {
        /// Error message of the operating system.
        problem: String,
    },
    /// The file is not UTF-8 text.
    NotUtf8,
    /// The file is not TOML, or not JSON.
    Syntax {
        /// Format of the file: `TOML` or `JSON`.
        format: &'static str,
        /// Message of the parser.
        message: String,
        /// Line to which the message refers.
        line: String,
    },
    /// A key or table that the format does not have.
    UnknownKey {
        /// The key as written.
        key: String,
        /// Keys that are allowed at this place.
        known: Vec<&'static str>,
    },
    /// A key of the format that this kind or dimension does not use.
    UnusedKey {
        /// The key as written.
        key: String,
        /// Keys that are allowed at this place.
        known: Vec<&'static str>,
    },
    /// A word that is not in the fixed list of its key, such as a kind, quantity, frame or dimension.
    UnknownWord {
        /// Key with the unknown word.
        key: &'static str,
        /// The word as written.
        found: String,
        /// Words that the key allows.
        known: Vec<&'static str>,
    },
    /// A name of a body that the file does not have.
    UnknownBody {
        /// The name as written.
        name: String,
        /// Names of the bodies in the file.
        known: Vec<String>,
    },
    /// A name of a joint that the file does not have.
    UnknownJoint {
        /// The name as written.
        name: String,
        /// Names of the joints in the file.
        known: Vec<String>,
    },
    /// A name of a coupling, a rolling, an effect or a point that the file does not have.
    UnknownPart {
        /// Kind of the part: `couplings`, `rollings`, `effects` or `points`.
        list: &'static str,
        /// The name as written.
        name: String,
        /// Names of the parts of this kind in the file.
        known: Vec<String>,
    },
    /// A name of a signal that the file does not have.
    UnknownSignal {
        /// The name as written.
        name: String,
        /// Names of the signals in the file.
        known: Vec<String>,
    },
    /// A cycle of signals: each is computed from the next one.
    SignalCircle {
        /// Names of the signals in the cycle. Each depends on the next, and the last depends on the first.
        names: Vec<String>,
    },
    /// A signal that is not smooth, in a guide or a coupling, where a smooth one is required.
    SignalNotSmooth {
        /// Name of the signal.
        name: String,
        /// Discontinuity of the signal or of its derivative.
        broken: SignalBreak,
        /// Advice on how to make the signal smooth.
        remedy: &'static str,
    },
    /// An orientation of a point mass, or a place on a point mass other than its centre.
    OfPoint {
        /// Name of the point mass.
        name: String,
        /// Fault of the scene: [`SceneFault::PointTurns`] or [`SceneFault::OffPoint`].
        fault: SceneFault,
    },
    /// A coupling drawn between two parts (gears, for example) that no common body carries.
    NoCarrier {
        /// Bodies that carry the two parts.
        bodies: [String; 2],
        /// Joint whose axis the missing joint between the two carriers would have.
        joint: String,
    },
    /// The ground where the key requires a moving body.
    GroundDoesNotMove,
    /// The value `frame = "body"` in an output that belongs to no body.
    NoOwnBody,
    /// A value whose type the key does not allow.
    WrongType {
        /// Description of the type that the key requires.
        expected: &'static str,
        /// Description of the value in the file.
        found: &'static str,
    },
    /// An expression that cannot be evaluated.
    Expression(ExpressionFault),
    /// A file that cannot be included, or that does not have the table of the `include`.
    Include(ExpressionFault),
    /// A model of another format that cannot be converted to a scene.
    Model(ExpressionFault),
    /// A number with a unit whose dimensions differ from those of the key.
    OtherUnit {
        /// Key with the number.
        key: &'static str,
        /// Unit of the key; empty for a number without dimension.
        unit: &'static str,
        /// The text as written.
        text: String,
        /// Description of the quantity in the file.
        found: String,
    },
    /// A place that has neither two nor three numbers.
    NoPlace {
        /// Number of coordinates in the file.
        found: usize,
    },
    /// A guide whose `body` is the name of a joint.
    GuidedJoint {
        /// Name of the joint.
        name: String,
    },
    /// A list with the wrong number of values or entries.
    WrongCount {
        /// Number of values that the key requires.
        needed: usize,
        /// Number of values in the file.
        found: usize,
    },
    /// A number that is infinite, NaN, or outside the range of the scalar of the run.
    NotFinite {
        /// The number as written.
        text: String,
    },
    /// A number that must be larger than zero.
    NotPositive {
        /// Number that is not larger than zero.
        number: f64,
    },
    /// A point with the name of an earlier point.
    SamePoint {
        /// Name that both points have.
        name: String,
        /// Index of the first point of that name, from 0.
        first: usize,
    },
    /// A screw coupling with a lead of zero.
    NoLead,
    /// Wheels in mesh whose axes are not parallel in the reference configuration.
    AxesNotParallel,
    /// A joint that does not have exactly one coordinate of the kind that a coupling uses.
    NotOneOf {
        /// Description of the coordinate that the coupling needs.
        needed: &'static str,
        /// Names of the coordinates of the joint.
        known: Vec<&'static str>,
    },
    /// A number that is not a valid count.
    NotACount {
        /// The number as written.
        text: String,
        /// Largest count that the key allows.
        most: u32,
    },
    /// A required key or table that is missing.
    Missing {
        /// Key that is missing.
        key: &'static str,
    },
    /// Two keys of which only one is allowed.
    Both {
        /// The two keys that exclude each other.
        keys: [&'static str; 2],
    },
    /// A scene that can be read, but is not valid.
    Scene(SceneError),
    /// A sweep that does not fit its scene, or is not valid.
    Sweep(SweepFault),
}

impl ReadError {
    pub(crate) fn new(file: &str, place: Place, fault: ReadFault) -> Self {
        Self(Box::new(Parts { file: file.to_owned(), place, fault, included: Vec::new() }))
    }

    /// Adds the lines that name the files that include this one.
    pub(crate) fn included(mut self, by: Vec<String>) -> Self {
        self.0.included = by;
        self
    }

    /// The error of a model of another format, which another crate reads. The arguments are the file, the place, the message with its hint,
    /// and a line for each file that includes this one.
    #[must_use]
    pub fn of_model(
        file: &str,
        place: Place,
        message: String,
        hint: String,
        included: Vec<String>,
    ) -> Self {
        let fault = ReadFault::Model(ExpressionFault { message, hint });
        Self::new(file, place, fault).included(included)
    }

    /// Name of the file, as the caller gave it.
    #[must_use]
    pub fn file(&self) -> &str {
        &self.0.file
    }

    /// Line and column of the fault, with the text of the line.
    #[must_use]
    pub fn place(&self) -> &Place {
        &self.0.place
    }

    /// Fault in the file.
    #[must_use]
    pub fn fault(&self) -> &ReadFault {
        &self.0.fault
    }

    /// Hint that says what to do about the fault, and which files include this one, if any.
    #[must_use]
    pub fn hint(&self) -> String {
        let included = self.0.included.iter().map(String::as_str);
        let hint = self.0.fault.hint();
        let lines: Vec<_> = core::iter::once(hint.as_str()).chain(included).collect();
        lines.join("\n")
    }

    /// Formats the error as `file:line:column: message`, the line with a caret, and `hint: ...`. The text ends with a line feed.
    #[must_use]
    pub fn render(&self) -> String {
        self.0.place.render(&self.0.file, &self.0.fault.to_string(), &self.hint())
    }
}

impl Display for ReadError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Parts { file, place, fault, .. } = &*self.0;
        write!(f, "{file}:{}:{}: {fault}", place.line, place.column)
    }
}

impl core::error::Error for ReadError {}

impl Display for ReadFault {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable { problem } => write!(f, "the file cannot be read: {problem}"),
            Self::NotUtf8 => write!(f, "the file is not UTF-8 text"),
            Self::Syntax { format, message, .. } => write!(f, "not {format}: {message}"),
            Self::UnknownKey { key, .. } => write!(f, "unknown key `{key}`"),
            Self::UnusedKey { key, .. } => write!(f, "`{key}` has no meaning here"),
            Self::UnknownWord { key, found, .. } => write!(f, "unknown {key} `{found}`"),
            Self::UnknownBody { name, .. } => write!(f, "unknown body `{name}`"),
            Self::UnknownJoint { name, .. } => write!(f, "unknown joint `{name}`"),
            Self::UnknownPart { list, name, .. } => {
                write!(f, "unknown {} `{name}`", list.trim_end_matches('s'))
            }
            Self::UnknownSignal { name, .. } => write!(f, "unknown signal `{name}`"),
            Self::SignalCircle { names } => {
                let first = names.first().map_or("", |name| name);
                names.iter().try_for_each(|name| write!(f, "`{name}` needs "))?;
                write!(f, "`{first}`")
            }
            Self::SignalNotSmooth { name, broken, .. } => write!(f, "`{name}` {broken}"),
            Self::OfPoint { name, fault: SceneFault::OffPoint { by, .. } } => {
                write!(f, "`{name}` is a point: this place is {by:.6e} m off it")
            }
            Self::OfPoint { name, .. } => write!(f, "`{name}` is a point: it has no orientation"),
            Self::NoCarrier { bodies, joint } => f.write_str(&no_carrier(bodies, joint)),
            Self::GroundDoesNotMove => write!(f, "the ground does not move"),
            Self::NoOwnBody => write!(f, "this output is of no body, whose axes `body` would be"),
            Self::WrongType { expected, found } => write!(f, "expected {expected}, found {found}"),
            Self::Expression(fault) | Self::Include(fault) | Self::Model(fault) => {
                f.write_str(&fault.message)
            }
            Self::OtherUnit { key, unit, text, found } => {
                let unit =
                    if unit.is_empty() { "has no unit".into() } else { format!("is in {unit}") };
                write!(f, "`{text}` is {found}, `{key}` {unit}")
            }
            Self::NoPlace { found } => {
                write!(f, "expected the two or three numbers of a place, found {found}")
            }
            Self::WrongCount { needed, found } => {
                write!(f, "expected {needed} entries, found {found}")
            }
            Self::NotFinite { text } => write!(f, "`{text}` is not a finite number"),
            Self::NotPositive { number } => write!(f, "must be larger than zero, but is {number}"),
            Self::GuidedJoint { name } => write!(f, "`{name}` is a joint, no body"),
            Self::SamePoint { name, first } => {
                write!(f, "`{name}` is already the name of point {}", first + 1)
            }
            Self::NoLead => write!(f, "a screw without lead does not move its slide"),
            Self::AxesNotParallel => f.write_str(NOT_PARALLEL),
            Self::NotOneOf { needed, known } => {
                write!(f, "one {needed} is needed; the joint has: {}", known.join(", "))
            }
            Self::NotACount { text, .. } => write!(f, "`{text}` does not count anything"),
            Self::Missing { key } => write!(f, "`{key}` is missing"),
            Self::Both { keys: [one, other] } => write!(f, "both `{one}` and `{other}` are given"),
            Self::Scene(error) => of_scene(error, f),
            Self::Sweep(fault) => write!(f, "{fault}"),
        }
    }
}

/// Writes the fault of a scene that can be read but is not valid.
fn of_scene(error: &SceneError, f: &mut Formatter<'_>) -> fmt::Result {
    let SceneError { entry, field, fault } = error;
    match fault {
        SceneFault::DuplicateName(first) => {
            write!(f, "this name is already that of {}", numbered(*entry, *first))
        }
        SceneFault::GivenTwice(first) => {
            write!(f, "`{field}` is already prescribed by {}", numbered(*entry, *first))
        }
        fault => write!(f, "`{field}` {fault:#}"),
    }
}

/// Keys that name the owner of an output, as listed in the message about a missing owner.
pub(crate) const OWNER: &str = "joint, body, coupling, rolling, effect or signal";
/// Part of a message: a joint with several coordinates needs the name of the coordinate that a term or a measure uses.
pub(crate) const NAMED: &str = "coordinate, by its name,";
const OF_WHOM: &str = "add `joint = \"...\"` for its value, rate or reaction, `body = \"...\"` with `at = [...]` for the position, velocity or \
                       acceleration of a point, or the `coupling`, `rolling`, `effect` or `signal`; the energy, momentum and center-of-mass are of the scene";
const INERTIA: &str = "add `inertia`, about the centre of mass [kg m^2]: one number in the plane, six in space; a point mass that is welded \
                       to a body has zeros; instead of `center` and `inertia`, a point mass has `point = [...]`, and a slender rod \
                       `rod = { from = [...], to = [...] }`";

/// Hint for a line that is not TOML.
fn hint_of_toml(message: &str, line: &str) -> String {
    let is_header = message.contains("duplicate key") && line.trim_start().starts_with('[');
    match units::of_line(line) {
        Some(hint) => hint,
        None if is_header && line.trim_start().starts_with("[[") => {
            "write every such header in double brackets; an earlier one has single ones".to_owned()
        }
        None if is_header => {
            "of several such tables each has a header in double brackets: [[body]]".to_owned()
        }
        None => "see https://toml.io for the syntax of the file".to_owned(),
    }
}

fn hint_of_json(line: &str) -> String {
    let usual = || "see https://www.json.org for the syntax of the file".to_owned();
    units::of_json(line).unwrap_or_else(usual)
}

/// Message about two joints whose axes are not parallel.
const NOT_PARALLEL: &str =
    "the axes of the two joints are not parallel in the reference configuration";

impl ReadFault {
    fn hint(&self) -> String {
        match self {
            Self::Unreadable { .. } => "name a file that exists and that may be read".to_owned(),
            Self::NotUtf8 => "save the file as UTF-8".to_owned(),
            Self::Syntax { format: "JSON", line, .. } => hint_of_json(line),
            Self::Syntax { message, line, .. } => hint_of_toml(message, line),
            Self::Expression(fault) | Self::Include(fault) | Self::Model(fault) => fault.hint.clone(),
            Self::OtherUnit { unit: "", .. } => "write a plain number".to_owned(),
            Self::OtherUnit { unit, .. } => format!("write a number in {unit}, or with such a unit"),
            Self::UnknownKey { key, known } => nearest_name(key, known, "keys"),
            Self::UnusedKey { known, .. } => format!("remove it; {}", listing(known, "keys")),
            Self::UnknownWord { found, known, .. } => nearest_name(found, known, "choices"),
            Self::UnknownBody { name, known } => nearest_name(name, known, "bodies"),
            Self::UnknownJoint { name, known } => nearest_name(name, known, "joints"),
            Self::UnknownPart { list, name, known } => nearest_name(name, known, list),
            Self::UnknownSignal { name, known } => nearest_name(name, known, "signals"),
            Self::SignalCircle { .. } => SceneFault::SignalCircle.advice().to_owned(),
            Self::SignalNotSmooth { remedy, .. } => (*remedy).to_owned(),
            Self::OfPoint { fault, .. } => fault.advice().to_owned(),
            Self::NoCarrier { bodies, joint } => joint_to_add(bodies, joint),
            Self::GuidedJoint { name } => format!("a guide moves a joint: write `joint = \"{name}\"`"),
            Self::GroundDoesNotMove => "name a body".to_owned(),
            Self::NoOwnBody => "write the name of the body whose axes are meant, or `global`".to_owned(),
            Self::WrongType { expected, .. } => format!("write {expected}"),
            Self::NoPlace { .. } => "write two numbers in the plane, three in space".to_owned(),
            Self::WrongCount { needed, .. } => {
                format!("write {needed}, in the order of the format")
            }
            Self::NotFinite { .. } => "write a finite decimal number".to_owned(),
            Self::NotPositive { .. } => "write a number larger than zero".to_owned(),
            Self::SamePoint { .. } => "give it a name of its own".to_owned(),
            Self::NoLead => "write how far the slide moves in one turn [m]".to_owned(),
            Self::AxesNotParallel => {
                "give `ratio`, the second angle per first, with its sign".to_owned()
            }
            Self::NotOneOf { needed: NAMED, .. } => {
                "add `coordinate`, with one of these names".to_owned()
            }
            Self::NotOneOf { .. } => {
                "name another joint, or write the sum as kind `linear`, with `coordinate` in its terms"
                    .to_owned()
            }
            Self::NotACount { most, .. } => format!("write a whole number from 1 to {most}"),
            Self::Missing { key: "inertia" } => INERTIA.to_owned(),
            Self::Missing { key: OWNER } => OF_WHOM.to_owned(),
            Self::Missing { key: "[scene]" } => {
                "add a table [scene] with `dimension` and `duration`".to_owned()
            }
            Self::Missing { key: "dimension" } => {
                "add `dimension = 2` (planar) or `dimension = 3` (spatial)".to_owned()
            }
            Self::Missing { key: "duration" } => "add `duration`, in seconds".to_owned(),
            Self::Missing { key: key @ ("left" | "right") } => {
                format!("add `{key}`; `{key} = []` is level ground")
            }
            Self::Missing { key } if key.contains(" or ") => format!("add one of them: {key}"),
            Self::Missing { key } => format!("add `{key}`"),
            Self::Both { .. } => "keep one of the two".to_owned(),
            Self::Scene(error) => error.fault.advice().to_owned(),
            Self::Sweep(fault) => fault.hint(),
        }
    }
}

/// Entry with this `index` (from 0) in the table of `entry`.
fn numbered(entry: Entry, index: usize) -> Entry {
    match entry {
        Entry::Body(_) => Entry::Body(index),
        Entry::Joint(_) => Entry::Joint(index),
        Entry::Initial(_) => Entry::Initial(index),
        Entry::Guide(_) => Entry::Guide(index),
        Entry::Coupling(_) => Entry::Coupling(index),
        Entry::Rolling(_) => Entry::Rolling(index),
        Entry::Signal(_) => Entry::Signal(index),
        Entry::Frame(_) => Entry::Frame(index),
        Entry::Shape(_) => Entry::Shape(index),
        Entry::Effect(_) => Entry::Effect(index),
        Entry::Output(_) => Entry::Output(index),
        Entry::Scene | Entry::Solver | Entry::Road | Entry::RoadLeft(_) | Entry::RoadRight(_) => {
            entry
        }
    }
}

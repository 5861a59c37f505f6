//! Forms of the values at keys.

/// The header of a table whose rows stand in a file.
pub(crate) const TABLE_FILE: &str = "table file";

/// Form of the value at a key.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum KeyValue {
    /// The name of the entry.
    Name,
    /// A text.
    Text,
    /// Texts, one or more.
    Texts,
    /// A number.
    Number,
    /// A number, or one of these words.
    NumberOr(Vec<&'static str>),
    /// A whole number from 1.
    Count,
    /// Whole numbers from 1, a fixed count of them.
    Counts(usize),
    /// True or false.
    Flag,
    /// One of these words.
    Word(Vec<&'static str>),
    /// A coordinate of a joint: its name, or its number from 0.
    Coordinate,
    /// A direction, or another vector that is no place: numbers for the scene's dimension.
    Vector,
    /// Vectors, a fixed count of them.
    Vectors(usize),
    /// One number, or a vector.
    NumberOrVector,
    /// A place in the reference configuration.
    Place,
    /// Places, a fixed count of them.
    Places(usize),
    /// Places, as many as there are.
    SomePlaces,
    /// Numbers, a fixed count of them.
    Numbers(usize),
    /// Numbers, one or more; one alone may stand without brackets.
    SomeNumbers,
    /// Rows of numbers.
    Rows,
    /// Rows of numbers, or columns of a file.
    RowsOrFile,
    /// The name of a part of the scene.
    Of(Referent),
    /// The name of a part of the scene, or one of these words.
    OfOr(Referent, Vec<&'static str>),
    /// The names of parts of the scene, a fixed count of them.
    Several(Referent, usize),
    /// The names of one or more parts of the scene.
    Some(Referent),
    /// One name of a part of the scene, or a list of names.
    OneOrSome(Referent),
    /// A table of that header.
    Table(&'static str),
    /// A list of tables of that header.
    Tables(&'static str),
    /// A table of that header, or a list of such tables.
    TableOrTables(&'static str),
    /// Two places, or a list of tables of that header.
    PlacesOrTables(&'static str),
    /// A table of names with a number each.
    Parameters,
    /// A path to a number of a scene.
    Path,
    /// A path to a number of a scene, or a list of paths.
    PathOrPaths,
}

/// Part of a scene to which a name refers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Referent {
    /// A body, or `"ground"`.
    Body,
    /// A body that moves.
    MovingBody,
    /// A joint.
    Joint,
    /// A coupling.
    Coupling,
    /// An entry `[[rolling]]`.
    Rolling,
    /// A signal.
    Signal,
    /// An effect.
    Effect,
    /// A point.
    Point,
}

impl Referent {
    /// Name of the part in sentences.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Body | Self::MovingBody => "body",
            Self::Joint => "joint",
            Self::Coupling => "coupling",
            Self::Rolling => "rolling",
            Self::Signal => "signal",
            Self::Effect => "effect",
            Self::Point => "point",
        }
    }
}

impl KeyValue {
    /// Form of the value to write, in a few words.
    #[must_use]
    pub fn form(&self) -> String {
        let words = |words: &[&str]| {
            let words: Vec<_> = words.iter().map(|word| format!("`\"{word}\"`")).collect();
            words.join(", ")
        };
        let several = |n: usize, of: &str| match n {
            2 => format!("two {of}"),
            3 => format!("three {of}"),
            n => format!("{n} {of}"),
        };
        match self {
            Self::Name | Self::Text => "text".to_owned(),
            Self::Texts => "list of texts".to_owned(),
            Self::Number => "number".to_owned(),
            Self::NumberOr(of) => format!("number, or {}", words(of)),
            Self::Count => "whole number from 1".to_owned(),
            Self::Counts(n) => several(*n, "whole numbers from 1"),
            Self::Flag => "`true` or `false`".to_owned(),
            Self::Word(of) if of.iter().all(|word| word.parse::<u32>().is_ok()) => of.join(" or "),
            Self::Word(of) => words(of),
            Self::Coordinate => "name or number of a coordinate".to_owned(),
            Self::Vector => "vector".to_owned(),
            Self::Vectors(n) => several(*n, "vectors"),
            Self::NumberOrVector => "number in the plane, vector in space".to_owned(),
            Self::Place => "place".to_owned(),
            Self::Places(n) => several(*n, "places"),
            Self::SomePlaces => "list of places".to_owned(),
            Self::Numbers(n) => several(*n, "numbers"),
            Self::SomeNumbers => "number, or list of numbers".to_owned(),
            Self::Rows => "list of rows".to_owned(),
            Self::RowsOrFile => format!("list of rows, or table: {TABLE_FILE}"),
            Self::Of(Referent::Body) => "body, or `\"ground\"`".to_owned(),
            Self::Of(part) => part.name().to_owned(),
            Self::OfOr(part, of) => format!("{}, or {}", part.name(), words(of)),
            Self::Several(Referent::Body, n) => several(*n, "bodies, or `\"ground\"`"),
            Self::Several(part, n) => several(*n, &format!("{}s", part.name())),
            Self::Some(part) => format!("list of {}s", part.name()),
            Self::OneOrSome(part) => format!("{}, or list of them", part.name()),
            Self::Table(header) => format!("table: {header}"),
            Self::Tables(header) => format!("list of tables: {header}"),
            Self::TableOrTables(header) => format!("table, or list of tables: {header}"),
            Self::PlacesOrTables(header) => format!("two places, or list of tables: {header}"),
            Self::Parameters => "table of names, each with a number".to_owned(),
            Self::Path => "path".to_owned(),
            Self::PathOrPaths => "path, or list of paths".to_owned(),
        }
    }
}

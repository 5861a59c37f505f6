//! What can be wrong with a scene, with the place as entry, index and field.

/// An entry of the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Entry {
    /// `[scene]`.
    Scene,
    /// `[[body]]` number i (from 0).
    Body(usize),
    /// `[[joint]]` number i.
    Joint(usize),
    /// `[[initial]]` number i.
    Initial(usize),
    /// `[[guide]]` number i.
    Guide(usize),
    /// `[[effect]]` number i.
    Effect(usize),
    /// `[[output]]` number i.
    Output(usize),
    /// `[solver]`.
    Solver,
}

/// A scene that cannot be meant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneError {
    /// Where.
    pub entry: Entry,
    /// The key in the entry, as in scene files.
    pub field: &'static str,
    /// What is wrong.
    pub fault: SceneFault,
}

/// The faults. Each speaks in one sentence and says what to do.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum SceneFault {
    /// A number is infinite or NaN.
    NotFinite,
    /// A number must be positive.
    NotPositive,
    /// A number must not be negative.
    Negative,
    /// An axis has no direction.
    ZeroAxis,
    /// The two axes of a joint are parallel.
    ParallelAxes,
    /// A rod's ends, or the points of a distance joint or spring, coincide.
    CoincidentPoints,
    /// A name is used twice; the index of the first use.
    DuplicateName(usize),
    /// A name is empty or is `ground`.
    ReservedName,
    /// An index points to nothing (scenes built in code).
    UnknownReference,
    /// Both bodies are the same.
    SameBody,
    /// A moment of inertia is larger than the sum of the other two; the two sides.
    TriangleInequality([f64; 2]),
    /// The inertia matrix has a negative principal moment.
    NegativeInertia(f64),
    /// An inertia without mass.
    InertiaWithoutMass,
    /// The joint kind or effect needs a spatial scene.
    NeedsSpatial,
    /// The inertia's form does not fit the dimension.
    WrongDimension,
    /// This many numbers are needed.
    WrongCount(usize),
    /// The joint has no single coordinate to guide, spring or drive.
    NoSingleCoordinate,
    /// The same joint is guided twice, or an initial entry contradicts a guide.
    Contradiction,
    /// Times in a table do not increase.
    TableOrder,
    /// A key that this kind needs is missing.
    Missing,
}

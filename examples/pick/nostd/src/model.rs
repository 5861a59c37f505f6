// The scene "double pendulum", as constant tables for mbs-nostd; written by `mbs export`, not by hand.
// Features of mbs-core that its effects need: none.

use mbs_nostd::table::*;

/// Precision of the tables.
pub type Scalar = f64;
/// Plane or space.
pub type Axes = Planar;
/// A solver of just the size of [`MODEL`]: 3 links with the ground, 2 coordinates, 2 freedoms, 0 rows of loops.
pub type ModelSolver = Solver<Scalar, Axes, 3, 2, 2, 0, 0, 0, 0, 0>;

static LINKS: [Link<Scalar, Axes>; 3] = [
    Link {
        parent: 0,
        kind: LinkKind::GuidedRevolute,
        z: 0,
        v: 0,
        axis: vector([0.0]),
        direction: vector([0.0, 0.0]),
        offset: vector([0.0, 0.0]),
        mass: 0.0,
        center: vector([0.0, 0.0]),
        tensor: 0.0,
    },
    Link {
        parent: 0,
        kind: LinkKind::Revolute,
        z: 0,
        v: 0,
        axis: vector([1.0]),
        direction: vector([0.0, 0.0]),
        offset: vector([0.0, 0.0]),
        mass: 1.0,
        center: vector([0.5, 0.0]),
        tensor: 0.3333333333333333,
    },
    Link {
        parent: 1,
        kind: LinkKind::Revolute,
        z: 1,
        v: 1,
        axis: vector([1.0]),
        direction: vector([0.0, 0.0]),
        offset: vector([1.0, 0.0]),
        mass: 1.0,
        center: vector([0.5, 0.0]),
        tensor: 0.3333333333333333,
    },
];
static LOOPS: [ClosedLoop<Scalar, Axes>; 0] = [];
static ROWS: [Row<Scalar, Axes>; 0] = [];
static TERMS: [SumTerm<Scalar>; 0] = [];
static STATIONS: [Station; 3] = [
    Station {
        passes: Span { first: 0, end: 0 },
        pairs: Span { first: 0, end: 0 },
        ends: Span { first: 0, end: 0 },
    },
    Station {
        passes: Span { first: 0, end: 0 },
        pairs: Span { first: 0, end: 0 },
        ends: Span { first: 0, end: 0 },
    },
    Station {
        passes: Span { first: 0, end: 0 },
        pairs: Span { first: 0, end: 0 },
        ends: Span { first: 0, end: 0 },
    },
];
static PASSES: [Pass; 0] = [];
static PAIRS: [Pair; 0] = [];
static ENDS: [End; 0] = [];
static COUPLINGS: [LoopCoupling; 0] = [];
static UPDATES: [Update; 0] = [];
static LOADS: [Load<Scalar, Axes>; 0] = [];
static ROTORS: [LinkRotor<Scalar>; 0] = [];
static GUIDES: [Motion<Scalar>; 0] = [];
static COURSES: [SignalLaw<Scalar>; 0] = [];
static KNOTS: [[Scalar; 2]; 0] = [];
static CURVATURES: [Scalar; 0] = [];
static COURSE_ROWS: [[Scalar; 4]; 0] = [];
static RUNGS: [u32; 0] = [];
static Z: [Scalar; 2] = [0.0, 0.0];
static V: [Scalar; 2] = [0.0, 0.0];
static A: [Scalar; 2] = [-12.612857142857143, 16.817142857142855];
/// The model.
pub static MODEL: Model<'static, Scalar, Axes> = Model {
    mechanism: TreeSlices {
        links: &LINKS,
        loops: Loops {
            loops: &LOOPS,
            rows: &ROWS,
            plan: Plan {
                stations: &STATIONS,
                passes: &PASSES,
                pairs: &PAIRS,
                ends: &ENDS,
                couplings: &COUPLINGS,
                updates: &UPDATES,
            },
            floor: [0.5, 0.125],
            couplings: Couplings { n_cut: 4294967295, terms: &TERMS, ..Couplings::none() },
        },
        loads: &LOADS,
        rotors: &ROTORS,
        tables: LawInputs::courses(&[]),
        feedback: FeedbackSlices::none(),
        gravity: vector([0.0, -9.81]),
        base: vector([0.0, 0.0]),
        length: 2.0,
        n_coordinates: 2,
        n_freedoms: 2,
    },
    prescriptions: Prescriptions {
        guides: &GUIDES,
        courses: &COURSES,
        knots: (&KNOTS, &CURVATURES),
        rows: &COURSE_ROWS,
    },
    start: StartState { t: 0.0, z: &Z, v: &V, a: &A, signals: &[] },
    rungs: &RUNGS,
};

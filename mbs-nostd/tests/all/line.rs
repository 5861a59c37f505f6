// The scene of a drive line, as constant tables for mbs-nostd; written by `mbs export`, not by hand.
// Features of mbs-core that its effects need: friction.
// Features of mbs-nostd that its machine elements need: signals.

use mbs_nostd::table::*;

/// Precision of the tables.
pub type Scalar = f64;
/// Plane or space.
pub type Axes = Planar;
/// A solver of just the size of [`MODEL`]: 2 links with the ground, 1 coordinates, 1 freedoms, 0 rows of loops.
pub type ModelSolver = Solver<Scalar, Axes, 2, 1, 1, 0, 0, 0, 0, 17, 2, 17>;

static LINKS: [Link<Scalar, Axes>; 2] = [
    Link { parent: 0, kind: LinkKind::GuidedRevolute, z: 0, v: 0, axis: vector([0.0]), direction: vector([0.0, 0.0]), offset: vector([0.0, 0.0]), mass: 0.0, center: vector([0.0, 0.0]), tensor: 0.0 },
    Link { parent: 0, kind: LinkKind::Revolute, z: 0, v: 0, axis: vector([1.0]), direction: vector([0.0, 0.0]), offset: vector([0.0, 0.0]), mass: 1.0, center: vector([0.0, 0.0]), tensor: 2.0 },
];
static LOOPS: [ClosedLoop<Scalar, Axes>; 0] = [];
static ROWS: [Row<Scalar, Axes>; 0] = [];
static TERMS: [SumTerm<Scalar>; 0] = [];
static STATIONS: [Station; 2] = [
    Station { passes: Span { first: 0, end: 0 }, pairs: Span { first: 0, end: 0 }, ends: Span { first: 0, end: 0 } },
    Station { passes: Span { first: 0, end: 0 }, pairs: Span { first: 0, end: 0 }, ends: Span { first: 0, end: 0 } },
];
static PASSES: [Pass; 0] = [];
static PAIRS: [Pair; 0] = [];
static ENDS: [End; 0] = [];
static COUPLINGS: [LoopCoupling; 0] = [];
static UPDATES: [Update; 0] = [];
static LOADS: [Load<Scalar, Axes>; 4] = [
    Load::Angle { link: 1, law: Law::Torque(TorqueLaw { course: 2147483661 }) },
    Load::Angle { link: 1, law: Law::Torque(TorqueLaw { course: 2147483662 }) },
    Load::Angle { link: 1, law: Law::Torque(TorqueLaw { course: 15 }) },
    Load::Angle { link: 1, law: Law::Friction(FrictionLaw { coulomb: 20.0, r#static: 20.0, stribeck: 0.01, viscous: 0.0, regularisation: 0.001, course: Some(16) }) },
];
static ROTORS: [LinkRotor<Scalar>; 0] = [];
static GUIDES: [Motion<Scalar>; 0] = [];
static COURSES: [SignalLaw<Scalar>; 17] = [
    SignalLaw::Input([0.5, 0.0, 0.0]),
    SignalLaw::Constant([0.0, 0.0, 0.0]),
    SignalLaw::Constant([0.0, 0.0, 0.0]),
    SignalLaw::Constant([0.0, 0.0, 0.0]),
    SignalLaw::Constant([0.0, 0.0, 0.0]),
    SignalLaw::Constant([0.0, 0.0, 0.0]),
    SignalLaw::Constant([0.0, 0.0, 0.0]),
    SignalLaw::Constant([0.0, 0.0, 0.0]),
    SignalLaw::Spline(Part { first: 0, n: 3 }),
    SignalLaw::Input([0.0, 0.0, 0.0]),
    SignalLaw::Constant([0.0, 0.0, 0.0]),
    SignalLaw::Step(Rise { from: 1.0, to: -2.0, at: 0.1, rise: 0.05 }),
    SignalLaw::Constant([0.0, 0.0, 0.0]),
    SignalLaw::Constant([0.0, 0.0, 0.0]),
    SignalLaw::Constant([0.0, 0.0, 0.0]),
    SignalLaw::Constant([0.0, 0.0, 0.0]),
    SignalLaw::Constant([0.0, 0.0, 0.0]),
];
static KNOTS: [[Scalar; 2]; 3] = [
    [0.0, 0.0],
    [0.1, -2.0],
    [0.3, 4.0],
];
static CURVATURES: [Scalar; 3] = [
    0.0,
    0.0,
    0.0,
];
static COURSE_ROWS: [[Scalar; 4]; 0] = [];
static RUNGS: [u32; 0] = [];
static Z: [Scalar; 1] = [
    0.0,
];
static V: [Scalar; 1] = [
    3.0,
];
static A: [Scalar; 1] = [
    1.0,
];
static OPERATIONS: [FeedbackStep<Scalar>; 19] = [
    FeedbackStep { to: 2, operation: FeedbackOperation::Rate { number: 0 } },
    FeedbackStep { to: 1, operation: FeedbackOperation::Curve { from: 0, curve: 2 } },
    FeedbackStep { to: 3, operation: FeedbackOperation::Curve { from: 2, curve: 0 } },
    FeedbackStep { to: 4, operation: FeedbackOperation::Curve { from: 2, curve: 1 } },
    FeedbackStep { to: 7, operation: FeedbackOperation::Integral { from: 2, state: 0, limits: [-Scalar::INFINITY, 0.5] } },
    FeedbackStep { to: 10, operation: FeedbackOperation::Clamp { from: 9, limits: [0.0, 1.0] } },
    FeedbackStep { to: 5, operation: FeedbackOperation::Constant(1.0) },
    FeedbackStep { to: 5, operation: FeedbackOperation::Multiply { from: 3 } },
    FeedbackStep { to: 5, operation: FeedbackOperation::Multiply { from: 1 } },
    FeedbackStep { to: 5, operation: FeedbackOperation::Multiply { from: 4 } },
    FeedbackStep { to: 12, operation: FeedbackOperation::Constant(0.0) },
    FeedbackStep { to: 12, operation: FeedbackOperation::Add { from: 8, factor: 1.5 } },
    FeedbackStep { to: 12, operation: FeedbackOperation::Add { from: 7, factor: -3.0 } },
    FeedbackStep { to: 12, operation: FeedbackOperation::Add { from: 11, factor: 2.0 } },
    FeedbackStep { to: 6, operation: FeedbackOperation::Lag { from: 5, state: 1, time: 0.05 } },
    FeedbackStep { to: 13, operation: FeedbackOperation::Force { from: 6, on: 0 } },
    FeedbackStep { to: 14, operation: FeedbackOperation::Force { from: 12, on: 0 } },
    FeedbackStep { to: 15, operation: FeedbackOperation::Component { from: 8, component: 0 } },
    FeedbackStep { to: 16, operation: FeedbackOperation::Component { from: 10, component: 0 } },
];
static MEASURED: [u32; 1] = [
    1,
];
static STATES: [[Scalar; 2]; 2] = [
    [0.0, 3.0],
    [0.0, 725.0491836734693],
];
static CURVES: [CurveTable<Scalar>; 3] = [
    CurveTable::Polynomial { coefficients: Span { first: 0, end: 3 } },
    CurveTable::Spline { knots: Span { first: 0, end: 3 }, first: 3, period: 0.0 },
    CurveTable::Spline { knots: Span { first: 3, end: 6 }, first: 6, period: 0.0 },
];
static CURVE_KNOTS: [[Scalar; 2]; 6] = [
    [-1.0, 1.0],
    [2.0, 1.2],
    [9.0, 0.1],
    [0.0, 0.0],
    [0.5, 0.3],
    [1.0, 1.0],
];
static CURVE_NUMBERS: [Scalar; 9] = [
    120.0,
    -4.0,
    -0.5,
    0.0,
    -0.06714285714285713,
    0.0,
    0.0,
    2.4,
    0.0,
];
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
            floor: [1.0, 1.0],
            couplings: Couplings { n_cut: 4294967295, terms: &TERMS, curves: &CURVES, knots: &CURVE_KNOTS, numbers: &CURVE_NUMBERS, ..Couplings::none() },
        },
        loads: &LOADS,
        rotors: &ROTORS,
        tables: LawInputs::courses(&[]),
        feedback: FeedbackSlices { steps: &OPERATIONS, links: &MEASURED, n_states: STATES.len(), signals: &[], ..FeedbackSlices::none() },
        gravity: vector([0.0, 0.0]),
        base: vector([0.0, 0.0]),
        length: 1.0,
        n_coordinates: 1,
        n_freedoms: 1,
    },
    prescriptions: Prescriptions {
        guides: &GUIDES,
        courses: &COURSES,
        knots: (&KNOTS, &CURVATURES),
        rows: &COURSE_ROWS,
    },
    start: StartState { t: 0.0, z: &Z, v: &V, a: &A, signals: &STATES },
    rungs: &RUNGS,
};

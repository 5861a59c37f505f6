// The scene of a hoist, as constant tables for mbs-nostd; written by `mbs export`, not by hand.
// Features of mbs-core that its effects need: none.
// Features of mbs-nostd that its machine elements need: couplings, curves, lines.

use mbs_nostd::table::*;

/// Precision of the tables.
pub type Scalar = f64;
/// Plane or space.
pub type Axes = Planar;
/// A solver of just the size of [`MODEL`]: 5 links with the ground, 6 coordinates, 6 freedoms, 2 rows of loops.
pub type ModelSolver = Solver<Scalar, Axes, 5, 6, 6, 2, 3, 7, 0, 0, 0, 0, 4, 2>;

static LINKS: [Link<Scalar, Axes>; 5] = [
    Link { parent: 0, kind: LinkKind::GuidedRevolute, z: 0, v: 0, axis: vector([0.0]), direction: vector([0.0, 0.0]), offset: vector([0.0, 0.0]), mass: 0.0, center: vector([0.0, 0.0]), tensor: 0.0 },
    Link { parent: 0, kind: LinkKind::Revolute, z: 0, v: 0, axis: vector([1.0]), direction: vector([0.0, 0.0]), offset: vector([0.0, 0.0]), mass: 2.0, center: vector([0.01, 0.0]), tensor: 0.0202 },
    Link { parent: 0, kind: LinkKind::Prismatic, z: 1, v: 1, axis: vector([0.0]), direction: vector([0.2873478855663454, 0.9578262852211513]), offset: vector([0.1, 0.4]), mass: 0.5, center: vector([0.0, 0.0]), tensor: 0.001 },
    Link { parent: 0, kind: LinkKind::Revolute, z: 2, v: 2, axis: vector([1.0]), direction: vector([0.0, 0.0]), offset: vector([-0.5, 1.0]), mass: 3.0, center: vector([0.0, 0.0]), tensor: 0.05 },
    Link { parent: 0, kind: LinkKind::Free, z: 3, v: 3, axis: vector([0.0]), direction: vector([0.0, 0.0]), offset: vector([0.6, -0.4]), mass: 1.5, center: vector([0.0, 0.0]), tensor: 0.02 },
];
static LOOPS: [ClosedLoop<Scalar, Axes>; 2] = [
    ClosedLoop { links: [0, 0], points: [vector([0.0, 0.0]), vector([0.0, 0.0])], first: 0, n: 1, ancestor: 0, block: 0, joint: 0 },
    ClosedLoop { links: [0, 0], points: [vector([0.0, 0.0]), vector([0.0, 0.0])], first: 1, n: 1, ancestor: 0, block: 2, joint: 1 },
];
static ROWS: [Row<Scalar, Axes>; 2] = [
    Row::Coupled(CoupledRow { terms: Span { first: 0, end: 2 }, starts: Span { first: 0, end: 0 }, guide: 4294967295, value: 0.0, inverse: 1.0, is_angle: false }),
    Row::Coupled(CoupledRow { terms: Span { first: 2, end: 4 }, starts: Span { first: 0, end: 3 }, guide: 4294967295, value: 0.0, inverse: 1.0, is_angle: false }),
];
static TERMS: [SumTerm<Scalar>; 4] = [
    SumTerm { factor: 1.0, curve: 4294967295, of: SumMeasure::Joint { link: 2, side: 0 } },
    SumTerm { factor: -1.0, curve: 0, of: SumMeasure::Joint { link: 1, side: 1 } },
    SumTerm { factor: 1.0, curve: 4294967295, of: SumMeasure::Line { points: Span { first: 0, end: 5 }, reference: 3.186910873204146 } },
    SumTerm { factor: 0.1, curve: 4294967295, of: SumMeasure::Joint { link: 3, side: 1 } },
];
static STATIONS: [Station; 5] = [
    Station { passes: Span { first: 0, end: 0 }, pairs: Span { first: 0, end: 0 }, ends: Span { first: 0, end: 2 } },
    Station { passes: Span { first: 0, end: 1 }, pairs: Span { first: 0, end: 1 }, ends: Span { first: 0, end: 0 } },
    Station { passes: Span { first: 1, end: 3 }, pairs: Span { first: 1, end: 4 }, ends: Span { first: 0, end: 0 } },
    Station { passes: Span { first: 3, end: 4 }, pairs: Span { first: 4, end: 5 }, ends: Span { first: 0, end: 0 } },
    Station { passes: Span { first: 4, end: 5 }, pairs: Span { first: 5, end: 6 }, ends: Span { first: 0, end: 0 } },
];
static PASSES: [Pass; 5] = [
    Pass { lap: 0, side: 1, gain: 0 },
    Pass { lap: 0, side: 0, gain: 1 },
    Pass { lap: 1, side: 2, gain: 2 },
    Pass { lap: 1, side: 1, gain: 3 },
    Pass { lap: 1, side: 0, gain: 4 },
];
static PAIRS: [Pair; 6] = [
    Pair { row: 0, column: 0, block: 0 },
    Pair { row: 1, column: 1, block: 0 },
    Pair { row: 2, column: 1, block: 1 },
    Pair { row: 2, column: 2, block: 2 },
    Pair { row: 3, column: 3, block: 2 },
    Pair { row: 4, column: 4, block: 2 },
];
static ENDS: [End; 2] = [
    End { lap: 0, couplings: Span { first: 0, end: 1 }, updates: Span { first: 0, end: 1 } },
    End { lap: 1, couplings: Span { first: 1, end: 1 }, updates: Span { first: 1, end: 1 } },
];
static COUPLINGS: [LoopCoupling; 1] = [
    LoopCoupling { lap: 1, side: 0, block: 1 },
];
static UPDATES: [Update; 1] = [
    Update { row: 0, column: 0, block: 2 },
];
static LOADS: [Load<Scalar, Axes>; 0] = [];
static ROTORS: [LinkRotor<Scalar>; 0] = [];
static GUIDES: [Motion<Scalar>; 0] = [];
static COURSES: [SignalLaw<Scalar>; 0] = [];
static KNOTS: [[Scalar; 2]; 0] = [];
static CURVATURES: [Scalar; 0] = [];
static COURSE_ROWS: [[Scalar; 4]; 0] = [];
static RUNGS: [u32; 0] = [];
static Z: [Scalar; 6] = [
    0.3,
    2.1558871980719136e-5,
    -6.920977644796425e-6,
    4.0592422648022395e-7,
    0.6000001120094027,
    -0.39999574671275484,
];
static V: [Scalar; 6] = [
    14.999999999999998,
    0.07588650792159964,
    -0.024362531574419394,
    0.0014288937621349197,
    0.00039428426910374114,
    0.014971995305483855,
];
static A: [Scalar; 6] = [
    -12.114971686547198,
    6.94878732124141,
    -16.718463559717108,
    0.9805593568955437,
    0.5705723403598162,
    0.5743328281126222,
];
static CURVES: [CurveTable<Scalar>; 1] = [
    CurveTable::Spline { knots: Span { first: 0, end: 7 }, first: 0, period: 6.283185307179586 },
];
static CURVE_KNOTS: [[Scalar; 2]; 7] = [
    [0.0, 0.0],
    [1.0, 0.01],
    [2.0, 0.035],
    [3.0, 0.05],
    [4.0, 0.045],
    [5.2, 0.02],
    [6.283185307179586, 0.0],
];
static CURVE_NUMBERS: [Scalar; 7] = [
    0.03743294637764959,
    0.01650946853954088,
    -0.013470820535813105,
    -0.022626186396288463,
    -0.016024433879033066,
    -0.0015552537799716553,
    0.03743294637764959,
];
static POINTS: [LinePoint<Scalar, Axes>; 5] = [
    LinePoint { start: 0, point: vector([-0.4, 1.1]) },
    LinePoint { start: 1, point: vector([0.1, 0.19999999999999996]) },
    LinePoint { start: 2, point: vector([-0.04999999999999993, 0.10000000000000003]) },
    LinePoint { start: 2, point: vector([0.050000000000000044, 0.08000000000000002]) },
    LinePoint { start: 0, point: vector([1.2, 0.9]) },
];
static STARTS: [LinkStart; 3] = [
    LinkStart { link: 0, side: 3 },
    LinkStart { link: 2, side: 2 },
    LinkStart { link: 4, side: 0 },
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
            floor: [0.14285714285714285, 0.11428571428571425],
            couplings: Couplings { n_cut: 0, terms: &TERMS, curves: &CURVES, knots: &CURVE_KNOTS, numbers: &CURVE_NUMBERS, points: &POINTS, starts: &STARTS, ..Couplings::none() },
        },
        loads: &LOADS,
        rotors: &ROTORS,
        tables: LawInputs::courses(&[]),
        feedback: FeedbackSlices::none(),
        gravity: vector([0.3, -9.7]),
        base: vector([0.0, 0.0]),
        length: 1.118033988749895,
        n_coordinates: 6,
        n_freedoms: 6,
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

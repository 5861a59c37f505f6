//! Tables on the Iltis: its front suspension, and the whole vehicle.

use super::table::Printed::{NoConvergence, Wrong};
use super::table::{CLASSICAL, History, Method, Printed, Table, method, n};

/// Makes a method with its own steps. The report prints a time for the first of them.
const fn timed(
    formulation: &'static str,
    printed_name: &'static str,
    dt: &'static [f64],
    printed: &'static [Printed],
) -> Method {
    Method { dt, ..method(formulation, printed_name, printed) }
}

/// Makes an index-3 method with a fixed penalty and its own steps.
const fn penalised(
    name: &'static str,
    arguments: &'static [&'static str],
    printed: &'static [Printed],
) -> Method {
    Method { name, arguments, ..timed("index-3", LAGRANGIAN, STIFF, printed) }
}

/// Sizes of P3's models of the vehicle; both Lagrangian methods have the model in natural coordinates.
const VEHICLE_SIZES: &[(&str, &str)] = &[
    ("index-3", NATURAL),
    ("classical", NATURAL),
    ("recursive", "43 variables of which 42 are integrated, 36 constraints of rank 32"),
];
/// Size of the model in natural coordinates, from P3, Modeling.
const NATURAL: &str = "168 variables, 157 constraints and 1 guide, 11 freedoms with the guided one";
/// Sizes of P1's fourth example, by the formulation.
const SUSPENSION_SIZES: &[(&str, &str)] =
    &[("index-1", SUSPENSION), ("index-3", SUSPENSION), ("state-space", SUSPENSION)];
/// Size of the model in P1, fourth example, for all methods but the recursive one.
const SUSPENSION: &str = "23 variables, 22 constraints, 1 freedom";
/// Vertical acceleration at the centre of mass, which publication 3 draws in Figures 4 to 6.
const ACCELERATION: History = History {
    column: "acceleration.z",
    label: "vertical acceleration of the chassis [g]",
    scale: 1.0 / 9.81,
};
/// Name of the report's row of the augmented Lagrangian.
const LAGRANGIAN: &str = "Augmented Lagr.";
/// Steps for the vehicle with rubber stops [s].
const STIFF: &[f64] = &[5e-3, 1e-3];
/// Note of every table of the vehicle.
const VEHICLE: &str = "The dimensions of the report's roads are lost: those of the scenes are chosen anew. The first step of a \
    method is the largest that the report found workable; it gives no errors.";

/// Common fields of the tables of the vehicle.
const ON_A_ROAD: Table = Table {
    name: "",
    title: "",
    source: "",
    scene: "",
    duration: 10.0,
    dt: &[],
    methods: &[],
    reference: None,
    history: Some(ACCELERATION),
    sizes: VEHICLE_SIZES,
    note: VEHICLE,
};

/// Publication 1, Table IV.
pub(super) const T4: Table = Table {
    name: "T4",
    title: "Front suspension of the Iltis",
    source: "publication 1, Table IV",
    scene: "iltis-suspension",
    duration: 6.0,
    dt: &[1e-2, 1e-3, 1e-4, 1e-5],
    methods: &[
        method(
            "index-1",
            "Index-1",
            &[NoConvergence, n(1.2e-3, 101.2), n(6.0e-5, 464.9), n(3.0e-7, 4791.0)],
        ),
        method("index-3", "Index-3", &[n(1.6e-1, 6.0), n(2.1e-3, 38.3), n(7.5e-2, 377.2), Wrong]),
        CLASSICAL,
        method(
            "state-space",
            "State-space",
            &[n(1.6e-1, 16.7), n(7.0e-4, 137.0), n(4.0e-5, 1091.0), n(4.0e-7, 10435.0)],
        ),
        method(
            "recursive",
            "Fully-rec",
            &[n(6.6e-2, 6.6), n(4.2e-4, 38.6), n(6.0e-6, 392.0), n(2.0e-7, 4079.0)],
        ),
    ],
    reference: None,
    history: None,
    sizes: SUSPENSION_SIZES,
    note: "The report does not state the norm of these errors, and raises the penalty of index-3 to 1e11 and 1e13 at \
        the two smaller steps.",
};

/// Publication 3, Table I, SIMUL1.
pub(super) const T5_1: Table = Table {
    name: "T5.1",
    title: "Iltis up a ramp and down a series of stairs",
    source: "publication 3, Table I, SIMUL1",
    scene: "iltis-stairs",
    methods: &[
        timed("index-3", LAGRANGIAN, &[1.75e-2, 1e-3], &[Printed::Time(34.0)]),
        timed("classical", "Classical Lagr.", &[1e-2, 1e-3], &[Printed::Time(139.0)]),
        timed("recursive", "Fully-rec", &[7.5e-3, 1e-3], &[Printed::Time(20.0)]),
    ],
    ..ON_A_ROAD
};

/// Publication 3, Table I, SIMUL2.
pub(super) const T5_2: Table = Table {
    name: "T5.2",
    title: "Iltis off a ramp and onto the ground",
    source: "publication 3, Table I, SIMUL2",
    scene: "iltis-jump",
    methods: &[
        timed("index-3", LAGRANGIAN, &[3e-2, 1e-3], &[Printed::Time(18.0)]),
        timed("classical", "Classical Lagr.", &[2.5e-2, 1e-3], &[Printed::Time(58.0)]),
        timed("recursive", "Fully-rec", &[7.5e-3, 1e-3], &[Printed::Time(14.0)]),
    ],
    ..ON_A_ROAD
};

/// Publication 3, Table I, SIMUL3.
pub(super) const T5_3: Table = Table {
    name: "T5.3",
    title: "Iltis in a slalom",
    source: "publication 3, Table I, SIMUL3",
    scene: "iltis-slalom",
    methods: &[
        timed("index-3", LAGRANGIAN, &[2.5e-2, 1e-3], &[Printed::Time(27.0)]),
        timed("classical", "Classical Lagr.", &[1e-2, 1e-3], &[Printed::Time(99.0)]),
        timed("recursive", "Fully-rec", &[7.5e-3, 1e-3], &[Printed::Time(9.0)]),
    ],
    ..ON_A_ROAD
};

/// Publication 3, Table III, SIMUL1S.
pub(super) const T8: Table = Table {
    name: "T8",
    title: "Iltis with rubber stops of 1e7 N/m, up a ramp and down a series of stairs",
    source: "publication 3, Table III, SIMUL1S",
    scene: "iltis-stairs-stiff",
    methods: &[
        timed("index-3", LAGRANGIAN, STIFF, &[Printed::Time(78.0)]),
        penalised("index-3, alpha = 1e9", &["--penalty", "1e9"], &[]),
        penalised("index-3, alpha = 1e10", &["--penalty", "1e10"], &[Printed::Time(78.0)]),
        timed("classical", "Classical Lagr.", &[2.5e-3, 1e-3], &[Printed::Time(435.0)]),
        timed("recursive", "Fully-rec", &[2.5e-3, 1e-3], &[Printed::Time(34.0)]),
    ],
    note: "The report needs a penalty of 1e10 here, and finds the system ill-conditioned at smaller steps. The dimensions \
        of its road are lost: those of the scene are chosen anew.",
    ..ON_A_ROAD
};

//! The report's tables: publication 1, Tables I to IV, publication 2, Table 1, and publication 3, Tables I and III, as printed.
//!
//! The times are CPU seconds on the machines of the authors, which these tables do not name. The norm of the errors is joules in
//! the first example; the others do not state it.

/// What the report prints for one method and one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Printed {
    /// Error, and CPU time [s] where there is one.
    Numbers(f64, Option<f64>),
    /// CPU time [s] alone.
    Time(f64),
    /// "No convergent."
    NoConvergence,
    /// "Wrong results".
    Wrong,
    /// "Does not work".
    DoesNotWork,
    /// The table has no such entry.
    Nothing,
}

/// A method of a table: how we run it, and the report's row for it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Method {
    /// Its name in our tables.
    pub(crate) name: &'static str,
    /// `--formulation` of `mbs run`.
    pub(crate) formulation: &'static str,
    /// Further arguments of `mbs run`.
    pub(crate) arguments: &'static [&'static str],
    /// Name of the report's row, or empty.
    pub(crate) printed_name: &'static str,
    /// Step sizes [s] where they are not those of the table; else empty.
    pub(crate) dt: &'static [f64],
    /// The report's entries, one for each of its steps; further steps are ours alone.
    pub(crate) printed: &'static [Printed],
}

/// A channel whose value at the end is known from elsewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reference {
    /// The channel.
    pub(crate) channel: &'static str,
    /// What its distance from the reference is called, with its unit.
    pub(crate) label: &'static str,
    /// Its components at the end.
    pub(crate) value: &'static [f64],
}

/// A channel whose history is drawn: of each method at its first step, and of the first method at its last one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct History {
    /// Its column in the CSV of a run.
    pub(crate) column: &'static str,
    /// What it is, with its unit.
    pub(crate) label: &'static str,
    /// What a number of the column is multiplied by.
    pub(crate) scale: f64,
}

/// One table.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Table {
    /// Short name.
    pub(crate) name: &'static str,
    /// What it is about.
    pub(crate) title: &'static str,
    /// Where it is printed.
    pub(crate) source: &'static str,
    /// The scene, by its file.
    pub(crate) scene: &'static str,
    /// Simulated time [s].
    pub(crate) duration: f64,
    /// Step sizes [s].
    pub(crate) dt: &'static [f64],
    /// The methods.
    pub(crate) methods: &'static [Method],
    /// A known end.
    pub(crate) reference: Option<Reference>,
    /// A history to be drawn.
    pub(crate) history: Option<History>,
    /// What a reader must know.
    pub(crate) note: &'static str,
}

impl Table {
    /// All entries: methods, and their steps.
    pub(crate) fn entries(&self) -> impl Iterator<Item = (&'static Method, f64)> {
        let dt = self.dt;
        self.methods.iter().flat_map(move |method| {
            let dt = if method.dt.is_empty() { dt } else { method.dt };
            dt.iter().map(move |&step| (method, step))
        })
    }

    /// Number of steps of a run.
    pub(crate) fn steps(&self, step: f64) -> f64 {
        (self.duration / step).ceil()
    }

    /// What the report prints for a method and a step of this table.
    pub(crate) fn printed(&self, method: &Method, step: f64) -> Printed {
        let dt = if method.dt.is_empty() { self.dt } else { method.dt };
        let place = dt.iter().position(|dt| dt.to_bits() == step.to_bits());
        place.and_then(|i| method.printed.get(i)).copied().unwrap_or(Printed::Nothing)
    }
}

/// Error and time as the tables print them.
const fn n(error: f64, seconds: f64) -> Printed {
    Printed::Numbers(error, Some(seconds))
}

use Printed::{DoesNotWork, NoConvergence, Wrong};

/// Our methods without a printed row.
const CLASSICAL: Method = Method {
    name: "classical",
    formulation: "classical",
    arguments: &[],
    printed_name: "",
    dt: &[],
    printed: &[],
};

/// A method by our name of the formulation.
const fn method(
    formulation: &'static str,
    printed_name: &'static str,
    printed: &'static [Printed],
) -> Method {
    Method { name: formulation, formulation, arguments: &[], printed_name, dt: &[], printed }
}

/// A method with steps of its own, of which the report prints the time of the first.
const fn timed(
    formulation: &'static str,
    printed_name: &'static str,
    dt: &'static [f64],
    printed: &'static [Printed],
) -> Method {
    Method { name: formulation, formulation, arguments: &[], printed_name, dt, printed }
}

/// Index-3 with a fixed penalty, at steps of its own.
const fn penalised(
    name: &'static str,
    arguments: &'static [&'static str],
    printed: &'static [Printed],
) -> Method {
    Method { name, formulation: "index-3", arguments, printed_name: LAGRANGIAN, dt: STIFF, printed }
}

/// Vertical acceleration at the centre of mass, as publication 3 draws it in Figures 4 to 6.
const ACCELERATION: History = History {
    column: "acceleration.z",
    label: "vertical acceleration of the chassis [g]",
    scale: 1.0 / 9.81,
};
/// The report's row of the augmented Lagrangian.
const LAGRANGIAN: &str = "Augmented Lagr.";
/// Steps of the vehicle with rubber stops.
const STIFF: &[f64] = &[5e-3, 1e-3];
/// What every table of the vehicle must say.
const VEHICLE: &str = "The dimensions of the report's roads are lost: those of the scenes are chosen anew. The first step of a \
    method is the largest that the report found workable; it gives no errors.";

/// Index-3 with the report's fixed penalty.
const fn fixed(printed_name: &'static str, printed: &'static [Printed]) -> Method {
    Method {
        name: "index-3, alpha = 1e7",
        formulation: "index-3",
        arguments: &["--penalty", "1e7"],
        printed_name,
        dt: &[],
        printed,
    }
}

/// P1, Table I, index-3: the two smaller steps needed alpha = 1e9 and 1e11.
const T1_INDEX3: &[Printed] = &[n(2.1e-1, 0.4), n(4.6e-3, 1.9), n(2.0e-5, 17.2), Wrong];
/// P1, Table II, index-3.
const T2_INDEX3: &[Printed] = &[n(7.6e-2, 0.3), n(5.0e-3, 0.6), n(7.7e-2, 4.0), Wrong];
/// P1, Table III, index-3.
const T3_INDEX3: &[Printed] = &[Wrong, NoConvergence, NoConvergence];
/// P1, Table II, state-space and fully recursive.
const T2_FAILS: &[Printed] = &[DoesNotWork, DoesNotWork, DoesNotWork, DoesNotWork];

/// Where the double pendulum's tip is after 10 s.
const TIP: Reference = Reference {
    channel: "tip",
    label: "tip off by [m]",
    value: &[-1.655_867_424_180_030_7, -0.528_445_481_024_952_3],
};

/// The tables.
#[allow(clippy::approx_constant, reason = "a time of 3.14 s is printed")]
pub(crate) const TABLES: [Table; 9] = [
    Table {
        name: "T1",
        title: "Double pendulum",
        source: "publication 1, Table I",
        scene: "double-pendulum",
        duration: 10.0,
        dt: &[1e-2, 1e-3, 1e-4, 1e-5],
        methods: &[
            method(
                "index-1",
                "Index-1",
                &[NoConvergence, n(1.1e-3, 2.8), n(1.1e-5, 21.4), n(2.5e-7, 214.0)],
            ),
            method("index-3", "Index-3", T1_INDEX3),
            fixed("Index-3", T1_INDEX3),
            CLASSICAL,
            method(
                "state-space",
                "State-space",
                &[n(2.9e-1, 1.8), n(4.8e-3, 10.5), n(4.3e-5, 96.6), n(7.6e-7, 862.0)],
            ),
            method(
                "recursive",
                "Fully-rec",
                &[n(2.7e-1, 2.0), n(2.6e-3, 11.3), n(3.4e-5, 100.3), n(3.4e-7, 1003.0)],
            ),
        ],
        reference: Some(TIP),
        history: None,
        note: "The report raises the penalty of index-3 to 1e9 at 1e-4 s and to 1e11 at 1e-5 s, since with 1e7 it does \
               not converge there. The motion is sensitive: at 1e-2 s its end is not resolved by any method.",
    },
    Table {
        name: "T1p",
        title: "Double pendulum, with and without pivoting",
        source: "publication 2, Table 1",
        scene: "double-pendulum",
        duration: 10.0,
        dt: &[1e-2, 1e-3, 1e-4, 1e-5, 1e-6],
        methods: &[
            method(
                "index-1",
                "Index-1",
                &[
                    n(3.8e-1, 0.4),
                    n(4.68e-3, 3.14),
                    n(4.3e-5, 26.6),
                    n(1.25e-7, 254.6),
                    n(1.0e-8, 2550.0),
                ],
            ),
            method(
                "index-3",
                "Index-3 with pivoting",
                &[
                    n(2.2e-1, 0.4),
                    n(4.8e-3, 1.67),
                    n(4.4e-5, 15.9),
                    n(3.6e-7, 92.5),
                    n(1.1e-4, 922.9),
                ],
            ),
            fixed(
                "Index-3 without pivoting",
                &[n(2.1e-1, 0.4), n(4.6e-3, 1.6), n(2.0e-5, 15.2), Wrong, Wrong],
            ),
        ],
        reference: Some(TIP),
        history: None,
        note: "Publications 1 and 2 differ for index-1 at the two larger steps. What pivoting does for the report, a \
               penalty in proportion to the mass does here.",
    },
    Table {
        name: "T2",
        title: "Two four-bar linkages, ten passages through a singular position",
        source: "publication 1, Table II",
        scene: "two-four-bars",
        duration: 10.0,
        dt: &[5e-2, 1e-2, 1e-3, 1e-4],
        methods: &[
            method(
                "index-1",
                "Index-1",
                &[NoConvergence, n(5.6e-3, 1.0), n(3.0e-4, 7.2), n(2.8e-7, 63.6)],
            ),
            method("index-3", "Index-3", T2_INDEX3),
            fixed("Index-3", T2_INDEX3),
            CLASSICAL,
            method("state-space", "State-space", T2_FAILS),
            method("recursive", "Fully-rec", T2_FAILS),
        ],
        reference: Some(Reference {
            channel: "crank-end",
            label: "crank end off by [m]",
            value: &[0.328_458_111_540_815_4, 0.944_518_538_178_600_9],
        }),
        history: None,
        note: "The report does not state the norm of these errors. The total energy is 35.835 J over the base, and about \
               twice that is turned over.",
    },
    Table {
        name: "T3",
        title: "Andrews' squeezing mechanism",
        source: "publication 1, Table III",
        scene: "andrews",
        duration: 0.03,
        dt: &[1e-4, 1e-5, 1e-6],
        methods: &[
            method("index-1", "Index-1", &[n(1.4e-2, 0.6), n(2.5e-2, 5.2), n(2.0e-4, 54.0)]),
            method("index-3", "Index-3", T3_INDEX3),
            fixed("Index-3", T3_INDEX3),
            CLASSICAL,
            method(
                "state-space",
                "State-space",
                &[n(4.3e-3, 1.3), n(9.3e-5, 10.2), n(6.2e-5, 101.9)],
            ),
            method("recursive", "Fully-rec", &[n(3.0e-3, 2.8), n(9.3e-5, 16.2), n(3.2e-5, 145.6)]),
        ],
        reference: Some(Reference {
            channel: "beta",
            label: "beta off by [rad]",
            value: &[15.872_485_085_167_984],
        }),
        history: None,
        note: "The report does not state the norm of these errors. At 1e-4 s state-space and recursive are above its numbers: \
            they have the trapezoidal rule's own error there, which falls a hundredfold with each tenth of the step. Beta is \
            compared with an extrapolation of 30 digits.",
    },
    Table {
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
            method(
                "index-3",
                "Index-3",
                &[n(1.6e-1, 6.0), n(2.1e-3, 38.3), n(7.5e-2, 377.2), Wrong],
            ),
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
        note: "The report does not state the norm of these errors, and raises the penalty of index-3 to 1e11 and 1e13 at \
            the two smaller steps.",
    },
    Table {
        name: "T5.1",
        title: "Iltis up a ramp and down a series of stairs",
        source: "publication 3, Table I, SIMUL1",
        scene: "iltis-stairs",
        duration: 10.0,
        dt: &[],
        methods: &[
            timed("index-3", LAGRANGIAN, &[1.75e-2, 1e-3], &[Printed::Time(34.0)]),
            timed("classical", "Classical Lagr.", &[1e-2, 1e-3], &[Printed::Time(139.0)]),
            timed("recursive", "Fully-rec", &[7.5e-3, 1e-3], &[Printed::Time(20.0)]),
        ],
        reference: None,
        history: Some(ACCELERATION),
        note: VEHICLE,
    },
    Table {
        name: "T5.2",
        title: "Iltis off a ramp and onto the ground",
        source: "publication 3, Table I, SIMUL2",
        scene: "iltis-jump",
        duration: 10.0,
        dt: &[],
        methods: &[
            timed("index-3", LAGRANGIAN, &[3e-2, 1e-3], &[Printed::Time(18.0)]),
            timed("classical", "Classical Lagr.", &[2.5e-2, 1e-3], &[Printed::Time(58.0)]),
            timed("recursive", "Fully-rec", &[7.5e-3, 1e-3], &[Printed::Time(14.0)]),
        ],
        reference: None,
        history: Some(ACCELERATION),
        note: VEHICLE,
    },
    Table {
        name: "T5.3",
        title: "Iltis in a slalom",
        source: "publication 3, Table I, SIMUL3",
        scene: "iltis-slalom",
        duration: 10.0,
        dt: &[],
        methods: &[
            timed("index-3", LAGRANGIAN, &[2.5e-2, 1e-3], &[Printed::Time(27.0)]),
            timed("classical", "Classical Lagr.", &[1e-2, 1e-3], &[Printed::Time(99.0)]),
            timed("recursive", "Fully-rec", &[7.5e-3, 1e-3], &[Printed::Time(9.0)]),
        ],
        reference: None,
        history: Some(ACCELERATION),
        note: VEHICLE,
    },
    Table {
        name: "T8",
        title: "Iltis with rubber stops of 1e7 N/m, up a ramp and down a series of stairs",
        source: "publication 3, Table III, SIMUL1S",
        scene: "iltis-stairs-stiff",
        duration: 10.0,
        dt: &[],
        methods: &[
            timed("index-3", LAGRANGIAN, STIFF, &[Printed::Time(78.0)]),
            penalised("index-3, alpha = 1e9", &["--penalty", "1e9"], &[]),
            penalised("index-3, alpha = 1e10", &["--penalty", "1e10"], &[Printed::Time(78.0)]),
            timed("classical", "Classical Lagr.", &[2.5e-3, 1e-3], &[Printed::Time(435.0)]),
            timed("recursive", "Fully-rec", &[2.5e-3, 1e-3], &[Printed::Time(34.0)]),
        ],
        reference: None,
        history: Some(ACCELERATION),
        note: "The report needs a penalty of 1e10 here, and finds the system ill-conditioned at smaller steps. The dimensions \
            of its road are lost: those of the scene are chosen anew.",
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_of_the_report_has_an_entry_for_each_of_its_steps() {
        for table in &TABLES {
            for method in table.methods {
                let at_most = if method.dt.is_empty() { table.dt } else { method.dt }.len();
                let is_full = method.printed.len() == table.dt.len() || !method.dt.is_empty();
                assert!(method.printed.len() <= at_most, "{} {}", table.name, method.name);
                assert!(
                    is_full || method.printed_name.is_empty(),
                    "{} {}",
                    table.name,
                    method.name
                );
            }
        }
    }

    #[test]
    fn steps_fall() {
        for table in &TABLES {
            for dt in table.methods.iter().map(|method| method.dt).chain([table.dt]) {
                assert!(dt.is_sorted_by(|a, b| a > b), "{}", table.name);
            }
        }
    }

    #[test]
    fn errors_of_completed_entries_are_smaller_than_one_and_times_grow() {
        for table in &TABLES {
            for method in table.methods {
                let mut last = 0.0;
                for printed in method.printed {
                    if let Printed::Numbers(error, Some(seconds)) = *printed {
                        assert!(error > 0.0 && error < 1.0, "{} {}", table.name, method.name);
                        assert!(seconds > last, "{} {}", table.name, method.name);
                        last = seconds;
                    }
                }
            }
        }
    }

    #[test]
    fn entries_are_found_by_their_step() {
        let [t1, .., t8] = TABLES;
        assert_eq!(t1.printed(&t1.methods[0], 1e-2), NoConvergence);
        assert_eq!(t1.printed(&t1.methods[1], 1e-4), n(2.0e-5, 17.2));
        assert_eq!(t1.printed(&CLASSICAL, 1e-4), Printed::Nothing);
        assert_eq!(t1.printed(&t1.methods[0], 1e-7), Printed::Nothing);
        assert_eq!(t8.printed(&t8.methods[3], 2.5e-3), Printed::Time(435.0));
        assert_eq!(t8.printed(&t8.methods[3], 1e-3), Printed::Nothing);
    }
}

//! The report's tables: publication 1, Tables I to IV, publication 2, Table 1, and publication 3, Tables I and III, as printed.
//!
//! The times are CPU seconds on the machines of the authors, which these tables do not name. The norm of the errors is joules in
//! the first example; the others do not state it.

mod mechanisms;
mod vehicle;

use mechanisms::{T1, T1P, T2, T3};
use vehicle::{T4, T5_1, T5_2, T5_3, T8};

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

impl Method {
    /// The arguments of `mbs run`, without scene and step.
    pub(crate) fn options(&self) -> Vec<&'static str> {
        let formulation = ["--formulation", self.formulation];
        formulation.iter().chain(self.arguments).copied().collect()
    }
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
    /// Sizes of the report's models, by the formulation.
    pub(crate) sizes: &'static [(&'static str, &'static str)],
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

    /// Is this the first method at its smallest step?
    pub(crate) fn is_finest(&self, method: &Method, step: f64) -> bool {
        let last = self.entries().take_while(|(m, _)| m.name == self.methods[0].name).last();
        last.is_some_and(|(m, dt)| m.name == method.name && dt.to_bits() == step.to_bits())
    }

    /// Is the history of this entry drawn? The finest one is, and every method of the report at its first step.
    pub(crate) fn draws(&self, method: &Method, step: f64) -> bool {
        let is_first = method.dt.first().is_some_and(|dt| dt.to_bits() == step.to_bits());
        let is_printed = !method.printed.is_empty() && method.arguments.is_empty();
        (is_first && is_printed) || self.is_finest(method, step)
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

/// The tables.
pub(crate) const TABLES: [Table; 9] = [T1, T1P, T2, T3, T4, T5_1, T5_2, T5_3, T8];

#[cfg(test)]
mod tests {
    use super::Printed::NoConvergence;
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
    fn each_method_of_the_report_is_drawn_once_and_the_finest_run_too() {
        let [.., t8] = &TABLES;
        let drawn: Vec<_> = t8.entries().filter(|(m, step)| t8.draws(m, *step)).collect();
        let names: Vec<_> = drawn.iter().map(|(m, step)| (m.name, *step)).collect();
        let wanted =
            [("index-3", 5e-3), ("index-3", 1e-3), ("classical", 2.5e-3), ("recursive", 2.5e-3)];
        assert_eq!(names, wanted);
        assert_eq!(drawn.iter().filter(|(m, step)| t8.is_finest(m, *step)).count(), 1);
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

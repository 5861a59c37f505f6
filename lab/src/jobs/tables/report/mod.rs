//! The report's tables as published: publication 1, Tables I to IV; publication 2, Table 1; publication 3, Tables I and III.
//!
//! The times are CPU seconds on the authors' machines, which these tables do not name. The norm of the errors is in joules in the first
//! example. For the others its unit is not stated.

mod mechanisms;
mod table;
mod vehicle;

use mechanisms::{T1, T1P, T2, T3};
pub(crate) use table::{History, Method, Printed, Table};
use vehicle::{T4, T5_1, T5_2, T5_3, T8};

/// Tables of the report, as printed.
pub(crate) const TABLES: [Table; 9] = [T1, T1P, T2, T3, T4, T5_1, T5_2, T5_3, T8];

#[cfg(test)]
mod tests {
    use super::Printed::NoConvergence;
    use super::table::{CLASSICAL, n};
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

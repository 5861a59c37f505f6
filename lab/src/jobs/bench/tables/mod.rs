//! The tables and drawings, for a terminal and for a page. Each has a sentence on its result.

mod compared;
mod costs;
mod gains;
mod numbers;

use super::measured::Measured;
use crate::lab::section::Section;

/// Returns the remark that holds for all sections.
pub(crate) fn remark(measured: &Measured) -> String {
    format!(
        "{} Times are medians of repeated measurements, interleaved in one process, with their quartiles; steps continue from the \
         scene's start at its own step. Nothing here is a test.",
        measured.machine.sentence()
    )
}

/// Returns all sections of the page.
pub(crate) fn sections(measured: &Measured) -> Vec<Section> {
    vec![
        costs::steps(measured),
        costs::counts(measured),
        costs::phases(measured),
        compared::faer(measured),
        gains::threads(measured),
        gains::forks(measured),
        compared::orders(measured),
        compared::report(measured),
    ]
}

/// Section with the report's tables on processors only.
pub(crate) fn processors(measured: &Measured) -> Section {
    compared::report(measured)
}

#[cfg(test)]
mod tests {
    use super::super::measured::tests::sample;
    use super::numbers::{count, percent, span, time};
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(
            [1.5e-9, 2.347e-7, 1.5e-6, 2.34e-5, 0.0123, 0.456, 12.34].map(time),
            ["1.50 ns", "235 ns", "1.50 µs", "23.4 µs", "12.3 ms", "456 ms", "12.3 s"]
        );
        assert_eq!([Some(1.0), Some(1234567.0), None].map(count), ["1", "1,234,567", ""]);
        assert_eq!([0.254, -0.004].map(percent), ["25 %", "0 %"]);
        assert_eq!(span([3.0, 1.0, 2.0].into_iter()), Some([1.0, 3.0]));
        assert_eq!(span([].into_iter()), None);
    }

    #[test]
    fn every_table_has_its_sentence() {
        let sections = sections(&sample());
        let text: String = sections.iter().map(Section::text).collect();
        let html: String = sections.iter().map(Section::html).collect();
        for word in [
            "iltis-stairs",
            "400 µs",
            "not measured further",
            "1.60",
            "0.50",
            "22.7",
            "times as fast at best",
            "Table IV",
            "Table V",
        ] {
            assert!(text.contains(word), "{word}: {text}");
        }
        assert!(!text.contains("NaN") && !html.contains("{{"));
        assert!(!html.contains("No drawing"), "every drawing has its points");
        assert!(html.matches("<table>").count() >= sections.len());
    }

    #[test]
    fn a_vehicle_that_gains_nothing_is_reported() {
        let mut measured = sample();
        for lane in measured.scenes[0].lanes.iter_mut().filter(|lane| lane.threads > 1) {
            lane.seconds = Some(6e-4);
        }
        let text: String = sections(&measured).iter().map(Section::text).collect();
        let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains("The whole vehicle gains nothing from threads"), "{text}");
    }

    #[test]
    fn a_run_without_teams_has_no_gains_and_says_so() {
        let mut measured = sample();
        measured.threads = vec![1];
        measured.scenes[0].lanes.retain(|lane| lane.threads == 1);
        measured.forks.truncate(1);
        let text: String = sections(&measured).iter().map(Section::text).collect();
        assert!(text.contains("No teams were measured"), "{text}");
    }
}

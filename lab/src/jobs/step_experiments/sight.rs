//! Evaluation of rules of step control: how the true error follows the tolerance, and the true error at equal CPU time.

use super::fit::{between, continued, median, rises, slope};
use crate::format::ratio;
use crate::lab::case::size;
use crate::lab::section::Section;

/// Least ratio of an error to that of the estimate, at equal CPU time, for which a rule is reported as blind to the error [-].
const BLIND: f64 = 10.0;
/// Least exponent p in error = c · tolerance^p for which a rule counts as sensitive to the error [-].
const FLAT: f64 = 0.15;
/// Least error that is evaluated, relative to the uncertainty of the reference [-].
const ABOVE_DOUBT: f64 = 10.0;

/// Relation of a rule's tolerance to the true error in a scene.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sight {
    scene: &'static str,
    rule: &'static str,
    /// Exponent of error over tolerance; `None` if too few runs were completed.
    power: Option<f64>,
    /// Tolerances at which the error is more than twice that at the next larger tolerance.
    rises: Vec<f64>,
    /// Ratio of the error to that of the estimate at equal time.
    excess: Option<f64>,
}

impl Sight {
    /// Evaluates points (tolerance, error), which begin with the largest tolerance, with the uncertainty of the reference.
    pub(crate) fn new(
        scene: &'static str,
        rule: &'static str,
        points: &[[f64; 2]],
        doubt: f64,
    ) -> Self {
        let rises = rises(points, ABOVE_DOUBT * doubt);
        Self { scene, rule, power: slope(points), rises, excess: None }
    }

    /// Compares the error with that of the estimate, by points (time, error) of both. If their times do not overlap, the estimate's line is
    /// extrapolated.
    pub(crate) fn beside(self, points: &[[f64; 2]], estimate: &[[f64; 2]]) -> Self {
        type Line = fn(&[[f64; 2]], f64) -> Option<f64>;
        let excess = |line: Line| {
            median(points.iter().filter_map(|[s, e]| Some(e / line(estimate, *s)?)).collect())
        };
        Self { excess: excess(between).or_else(|| excess(continued)), ..self }
    }

    /// Sentence on the dependence of the error on the tolerance.
    pub(crate) fn behaviour(&self) -> String {
        let Some(power) = self.power else {
            return format!("With {} too few runs came to their end.", self.named());
        };
        let rises = if self.rises.is_empty() {
            "each error is at most twice that of the next looser tolerance".to_owned()
        } else {
            format!(
                "the error is more than twice that of the next looser tolerance at {}",
                self.risen()
            )
        };
        format!("With {} it follows the tolerance to the power {power:.2}; {rises}.", self.named())
    }

    /// Sentence on the error at equal time; empty if it is unknown.
    pub(crate) fn at_equal_time(&self) -> String {
        self.excess.map_or(String::new(), |excess| {
            let named = self.named();
            format!(
                "With {named} it is {} times that with the estimate at equal time.",
                ratio(excess)
            )
        })
    }

    /// Reason why the rule does not detect the error; `None` if it does.
    fn blindness(&self) -> Option<String> {
        let Some(power) = self.power else { return Some("too few runs came to their end".into()) };
        if power < FLAT {
            return Some(format!("the error follows the tolerance to the power {power:.2} only"));
        }
        let excess = self.excess.filter(|excess| *excess > BLIND)?;
        Some(format!("the error is {} times that with the estimate at equal time", ratio(excess)))
    }

    fn named(&self) -> String {
        if self.rule == "both" { "both".into() } else { format!("the {}", self.rule) }
    }

    fn risen(&self) -> String {
        self.rises.iter().copied().map(size).collect::<Vec<_>>().join(", ")
    }
}

/// Table of all scenes and rules, whether errors decrease, and the scenes in which the energy rule does not detect the error.
pub(crate) fn report(sights: &[Sight], section: &mut Section) {
    section.heading("All scenes");
    let row = |sight: &Sight| {
        vec![
            format!("{}, {}", sight.scene, sight.rule),
            sight.power.map_or("none".into(), |power| format!("{power:.2}")),
            if sight.rises.is_empty() { "nowhere".into() } else { sight.risen() },
            sight.excess.map_or(String::new(), ratio),
        ]
    };
    let head = [
        "scene and rule",
        "power of the tolerance",
        "error rises at",
        "error / that of the estimate",
    ];
    section.table(&head, sights.iter().map(row).collect());
    for rule in ["estimate", "both"] {
        let of_rule: Vec<_> = sights.iter().filter(|sight| sight.rule == rule).collect();
        let rising =
            of_rule.iter().filter(|sight| !sight.rises.is_empty() || sight.power.is_none());
        let named: Vec<_> =
            rising.map(|sight| format!("{} at {}", sight.scene, sight.risen())).collect();
        let what = format!(
            "tolerances on {}: each error is at most twice that of the next looser tolerance",
            called(rule)
        );
        let measured = match named.len() {
            0 => format!("in all {} scenes", of_rule.len()),
            _ => format!("not in {}", named.join("; ")),
        };
        section.claim(what, measured, (!of_rule.is_empty()).then_some(named.is_empty()));
    }
    let energy = sights.iter().filter(|sight| sight.rule == "energy");
    let unseen =
        energy.filter_map(|sight| Some(format!("{}: {}.", sight.scene, sight.blindness()?)));
    let unseen: Vec<_> = unseen.collect();
    section.words(if unseen.is_empty() {
        "The change of the energy sees the error in every scene.".to_owned()
    } else {
        format!("Where the change of the energy does not see the error: {}", unseen.join(" "))
    });
}

fn called(rule: &str) -> &str {
    if rule == "both" { "estimate and energy" } else { "the estimate" }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points (tolerance, error) with errors of ten times the tolerance [-].
    const FALLING: [[f64; 2]; 3] = [[1e-3, 1e-2], [1e-4, 1e-3], [1e-5, 1e-4]];

    #[test]
    fn behaviour_names_where_an_error_rises() {
        let sentence = Sight::new("andrews", "estimate", &FALLING, 1e-12).behaviour();
        assert!(
            sentence.contains("power 1.00") && sentence.contains("at most twice"),
            "{sentence}"
        );
        let rising = [[1e-3, 1e-2], [1e-4, 3e-2], [1e-5, 1e-4]];
        let sentence = Sight::new("andrews", "both", &rising, 1e-12).behaviour();
        assert!(
            sentence.starts_with("With both it") && sentence.contains("tolerance at 1e-4"),
            "{sentence}"
        );
        assert!(Sight::new("andrews", "both", &[], 1e-12).behaviour().contains("too few"));
    }

    #[test]
    fn a_scene_that_the_energy_does_not_see_is_named() {
        let sight = |points: &[[f64; 2]]| Sight::new("andrews", "energy", points, 1e-12);
        let estimate = [[0.1, 1e-2], [1.0, 1e-4]];
        let slow = sight(&FALLING).beside(&[[1.0, 5e-3]], &estimate);
        assert!(slow.blindness().unwrap().contains("50.0 times"));
        assert_eq!(sight(&FALLING).beside(&[[1.0, 2e-4]], &estimate).blindness(), None);
        let apart = sight(&FALLING).beside(&[[10.0, 2e-4]], &estimate);
        assert!(apart.blindness().unwrap().contains("200 times"), "the line is continued");
        let flat = sight(&[[1e-3, 1e-2], [1e-5, 1e-2]]);
        assert!(flat.blindness().unwrap().contains("power 0.00"));
        let mut section = Section::new("B", "title");
        report(&[flat], &mut section);
        assert!(section.text().contains("does not see the error: andrews"));
    }

    #[test]
    fn a_rising_error_fails_its_claim() {
        let rising = [[1e-3, 1e-2], [1e-4, 3e-2]];
        let sights =
            [FALLING.as_slice(), &rising].map(|p| Sight::new("andrews", "estimate", p, 1e-12));
        let mut section = Section::new("B", "title");
        report(&sights, &mut section);
        let holds: Vec<_> = section.claims().map(|claim| claim.holds).collect();
        assert_eq!(holds, [Some(false), None]);
    }
}

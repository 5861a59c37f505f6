//! Claims on the counts, each with the comparisons that contradict it.

use super::callgrind::Case;

/// Largest excess of instructions in a build with all effects, relative to a build without any, in a scene without effects [-].
const MAX_OVERHEAD: f64 = 0.01;

/// Largest ratio of the instructions of five wheels with four gears to those of the wheels without gears [-]. It is slightly above the
/// counted 3.2; the aim is 2.
const MAX_GEARS: f64 = 3.4;

/// Largest ratio of the instructions of a train of 40 wheels to those of 20 wheels [-]: two, and an allowance for the depth of the chain.
const MAX_GROWTH: f64 = 2.3;

/// Module of the tables that laws read. A step passes them on even if it has no law.
const TABLES: &str = "mbs_core::effects::action::tables";

/// A claim, with the number of its comparisons and those that contradict it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Claim {
    /// Sentence that states the claim.
    pub(crate) text: &'static str,
    /// Number of comparisons.
    pub(crate) n_checked: usize,
    /// Each comparison that contradicts the claim, in words.
    pub(crate) against: Vec<String>,
}

impl Claim {
    fn new(text: &'static str) -> Self {
        Self { text, n_checked: 0, against: Vec::new() }
    }

    fn check(&mut self, holds: bool, otherwise: impl FnOnce() -> String) {
        self.n_checked += 1;
        if !holds {
            self.against.push(otherwise());
        }
    }

    /// True if there was at least one comparison, and every comparison agreed.
    pub(crate) fn holds(&self) -> bool {
        self.n_checked > 0 && self.against.is_empty()
    }
}

/// Runs on which the claims are checked: all effects compiled, none compiled, trains of gears, and all effects compiled without inlining.
#[derive(Debug)]
pub(crate) struct Runs {
    pub(crate) full: Vec<Case>,
    /// Build without effects; `None` in the short form.
    pub(crate) lean: Option<Lean>,
    pub(crate) trains: Vec<Case>,
    pub(crate) plain: Vec<Case>,
}

/// Runs of the build without effects.
#[derive(Debug)]
pub(crate) struct Lean {
    pub(crate) cases: Vec<Case>,
    /// Refusals of effects: effect, feature, message.
    pub(crate) refusals: Vec<[String; 3]>,
}

/// The words in a case's name: formulation, dimension, effect, switch.
pub(crate) fn words(case: &Case) -> [&str; 4] {
    let mut words = case.name.split(' ');
    [0; 4].map(|_| words.next().unwrap_or(""))
}

/// Finds the case that differs only in the switch.
pub(crate) fn other<'a>(cases: &'a [Case], case: &Case, switch: &str) -> Option<&'a Case> {
    let [formulation, dimension, effect, _] = words(case);
    cases.iter().find(|other| words(other) == [formulation, dimension, effect, switch])
}

/// Returns all claims with their comparisons. Those on the build without effects come first, if that build is counted.
pub(crate) fn all(runs: &Runs) -> Vec<Claim> {
    let of_lean =
        runs.lean.iter().flat_map(|lean| [left_out(&runs.full, &lean.cases), refused(lean)]);
    let others =
        [switched_off(runs), planar(runs), absent(runs), present(runs), gears(runs), growth(runs)];
    of_lean.chain(others).collect()
}

/// Instructions of a train with its gears `on` or `out`.
pub(crate) fn train(trains: &[Case], name: &str, switch: &str) -> Option<u64> {
    let is_it = |case: &&Case| words(case)[2..] == [name, switch];
    trains.iter().find(is_it).map(|case| case.instructions)
}

#[allow(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
fn ratio(of: Option<u64>, by: Option<u64>) -> f64 {
    of.zip(by).map_or(f64::NAN, |(of, by)| of as f64 / by as f64)
}

fn gears(runs: &Runs) -> Claim {
    let mut claim =
        Claim::new("five wheels with four gears cost a step at most 3.4 times the five without");
    let of = |switch| train(&runs.trains, "train-5", switch);
    let ratio = ratio(of("on"), of("out"));
    claim.check(ratio <= MAX_GEARS, || format!("{ratio:.3} times the wheels without gears"));
    claim
}

fn growth(runs: &Runs) -> Claim {
    let mut claim = Claim::new("the cost of a train of gears grows with the number of its wheels");
    let of = |name| train(&runs.trains, name, "on");
    let ratio = ratio(of("train-40"), of("train-20"));
    claim.check(ratio <= MAX_GROWTH, || format!("40 wheels: {ratio:.3} times 20"));
    claim
}

fn switched_off(runs: &Runs) -> Claim {
    let mut claim =
        Claim::new("a step costs the same without an effect and with the effect switched off");
    for case in runs.full.iter().filter(|case| words(case)[3] == "off") {
        let without = other(&runs.full, case, "out").map(|case| case.instructions);
        claim.check(without == Some(case.instructions), || {
            format!("{}: {} instead of {without:?}", case.name, case.instructions)
        });
    }
    claim
}

#[allow(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
fn left_out(all: &[Case], lean: &[Case]) -> Claim {
    let mut claim = Claim::new(
        "a scene without effects costs at most 1 % more where all effects are compiled than where none is",
    );
    for lean in lean.iter().filter(|case| words(case)[3] == "out") {
        let full = other(all, lean, "out").map_or(f64::INFINITY, |case| case.instructions as f64);
        let share = full / lean.instructions as f64 - 1.0;
        claim.check(share.abs() <= MAX_OVERHEAD, || format!("{}: {share:+.4}", lean.name));
    }
    claim
}

fn refused(lean: &Lean) -> Claim {
    let mut claim =
        Claim::new("an effect that is not compiled is refused, with the feature's name");
    for [effect, feature, message] in &lean.refusals {
        claim.check(message.contains(&format!("`{feature}`")), || format!("{effect}: {message:?}"));
    }
    claim
}

fn planar(runs: &Runs) -> Claim {
    let mut claim = Claim::new(
        "a planar scene without laws on one body executes no three-dimensional function",
    );
    for case in runs.plain.iter().filter(|case| words(case)[1] == "planar") {
        let found = case.functions.iter().find(|name| is_spatial(words(case)[0], name));
        claim.check(found.is_none(), || format!("{}: {}", case.name, found.map_or("", |f| f)));
    }
    claim
}

fn absent(runs: &Runs) -> Claim {
    let mut claim = Claim::new(
        "without effects no law, force or tangent of one is evaluated, without guides no phi_t",
    );
    for case in &runs.plain {
        let [_, _, effect, switch] = words(case);
        let kinds: &[Kind] = match (effect, switch) {
            ("guide", "on") => &[Kind::Effect],
            (_, "on") => &[Kind::Guide],
            _ => &[Kind::Effect, Kind::Guide],
        };
        for kind in kinds {
            let found = case.functions.iter().find(|name| kind.has(name));
            claim.check(found.is_none(), || format!("{}: {}", case.name, found.map_or("", |f| f)));
        }
    }
    claim
}

/// Claim that spatial functions, and those of effects and guides, are found in cases that use them. Otherwise the two claims before would
/// hold merely because names are not found.
fn present(runs: &Runs) -> Claim {
    let mut claim = Claim::new("where they are asked for, those functions are seen");
    for case in &runs.plain {
        let [formulation, dimension, effect, switch] = words(case);
        let mut see = |seen: &dyn Fn(&str) -> bool, what: &str| {
            let is_seen = case.functions.iter().any(|name| seen(name));
            claim.check(is_seen, || format!("{}: no {what}", case.name));
        };
        if dimension == "spatial" {
            see(&|name| is_spatial(formulation, name), "three-dimensional function");
        }
        match (effect, switch) {
            ("guide", "on") => see(&|name| Kind::Guide.has(name), "function of a guide"),
            (_, "on") => see(&|name| Kind::Effect.has(name), "function of an effect"),
            _ => {}
        }
    }
    claim
}

/// Functions by their purpose.
#[derive(Debug, Clone, Copy)]
enum Kind {
    Effect,
    Guide,
}

impl Kind {
    /// True if the function belongs to this kind. `<mbs_core::effects::...>::f` belongs to effects, `<Vec<mbs_core::effects::...>>::len`
    /// does not.
    fn has(self, function: &str) -> bool {
        let (places, names): (&[&str], &[&str]) = match self {
            Self::Effect => (
                &[
                    "mbs_core::effects",
                    "mbs_core::laws::tire",
                    "mbs_core::natural::forces",
                    "mbs_core::natural::on_body",
                    "mbs_recursive::loads",
                    "mbs_recursive::passes::overturned",
                ],
                &["::evaluate_forces", "::add_transverse", "::remember"],
            ),
            Self::Guide => (
                &["mbs_core::elements::guided", "mbs_core::laws::guide"],
                &["::evaluate_phi_t", "::opposite_guide"],
            ),
        };
        let path = function.trim_start_matches('<');
        !path.starts_with(TABLES) && places.iter().any(|place| path.starts_with(place))
            || names.iter().any(|name| function.ends_with(name))
    }
}

/// True if the function of a formulation is compiled for three dimensions. Planar motions of the recursive formulation have three
/// components, spatial ones six.
fn is_spatial(formulation: &str, function: &str) -> bool {
    let marks: &[&str] = match formulation {
        "recursive" => &["spatial::Spatial", "Const<6>"],
        _ => &["NaturalModel<f64, 3>", "Const<3>", "::<f64, 3>"],
    };
    marks.iter().any(|mark| function.contains(mark))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(name: &str, instructions: u64, functions: &[&str]) -> Case {
        let functions = functions.iter().map(|&f| f.to_owned()).collect();
        Case { name: name.to_owned(), instructions, functions }
    }

    #[test]
    fn one_instruction_more_contradicts() {
        let full = vec![
            case("index-3 planar bumper out", 100, &[]),
            case("index-3 planar bumper off", 100, &[]),
            case("index-3 planar tire out", 100, &[]),
            case("index-3 planar tire off", 101, &[]),
        ];
        let lean = vec![case("index-3 planar bumper out", 98, &[])];
        let runs = Runs { full, lean: None, trains: vec![], plain: vec![] };
        assert_eq!(switched_off(&runs).n_checked, 2);
        assert_eq!(switched_off(&runs).against.len(), 1);
        assert_eq!(left_out(&runs.full, &lean).against.len(), 1);
        assert!(!planar(&runs).holds(), "what was not looked at does not hold");
    }

    #[test]
    fn functions_are_distinguished_by_their_paths() {
        assert!(Kind::Effect.has("<mbs_core::effects::Law<f64>>::evaluate"));
        assert!(!Kind::Effect.has("<alloc::vec::Vec<mbs_core::effects::Law<f64>>>::len"));
        assert!(!Kind::Effect.has("<mbs_core::effects::action::tables::Tables<f64>>::codes"));
        assert!(Kind::Guide.has("<NaturalModel<f64, 2> as Model<f64>>::evaluate_phi_t"));
        assert!(is_spatial("index-3", "mbs_core::natural::forces::product::<f64, 3>"));
        assert!(!is_spatial("index-3", "<alloc::vec::Vec<[f64; 3]>>::len"));
    }
}

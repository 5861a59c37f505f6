//! What is claimed of the counts, each with what would contradict it.

use super::callgrind::Case;

/// Most that a build with all effects may take beyond one without any, in a scene without effects [-].
const SHARE: f64 = 0.01;

/// A claim, and how often it was looked at and contradicted.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Claim {
    /// One sentence.
    pub(crate) text: &'static str,
    /// Number of comparisons.
    pub(crate) n_checked: usize,
    /// Each comparison that fails, in words.
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

    /// Did every comparison hold, and was there one?
    pub(crate) fn holds(&self) -> bool {
        self.n_checked > 0 && self.against.is_empty()
    }
}

/// The three runs: all effects compiled, none compiled, and all without inlining.
#[derive(Debug)]
pub(crate) struct Runs {
    pub(crate) full: Vec<Case>,
    pub(crate) lean: Vec<Case>,
    pub(crate) plain: Vec<Case>,
}

/// Cases by the words of their names: formulation, dimension, effect, switch.
pub(crate) fn words(case: &Case) -> [&str; 4] {
    let mut words = case.name.split(' ');
    [0; 4].map(|_| words.next().unwrap_or(""))
}

/// The case without an effect that a case is compared with.
pub(crate) fn base<'a>(cases: &'a [Case], case: &Case) -> Option<&'a Case> {
    let [formulation, dimension, ..] = words(case);
    cases.iter().find(|other| words(other) == [formulation, dimension, "none", ""])
}

/// All claims.
pub(crate) fn all(runs: &Runs) -> Vec<Claim> {
    vec![switched_off(runs), left_out(runs), planar(runs), absent(runs), present(runs)]
}

fn switched_off(runs: &Runs) -> Claim {
    let mut claim =
        Claim::new("a step costs the same without an effect and with the effect switched off");
    for case in runs.full.iter().filter(|case| words(case)[3] == "off") {
        let base = base(&runs.full, case).map(|base| (base.instructions, base.copies));
        claim.check(base == Some((case.instructions, case.copies)), || {
            format!("{}: {} instead of {base:?}", case.name, case.instructions)
        });
    }
    claim
}

#[allow(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
fn left_out(runs: &Runs) -> Claim {
    let mut claim = Claim::new(
        "a scene without effects costs at most 1 % more where all effects are compiled than where none is",
    );
    for lean in runs.lean.iter().filter(|case| words(case)[2] == "none") {
        let full = runs.full.iter().find(|case| case.name == lean.name);
        let full = full.map_or(f64::INFINITY, |case| case.instructions as f64);
        let share = full / lean.instructions as f64 - 1.0;
        claim.check(share.abs() <= SHARE, || format!("{}: {share:+.4}", lean.name));
    }
    claim
}

fn planar(runs: &Runs) -> Claim {
    let mut claim = Claim::new("a planar scene executes no three-dimensional function");
    for case in runs.plain.iter().filter(|case| words(case)[1] == "planar") {
        let found = case.functions.iter().find(|name| is_spatial(name));
        claim.check(found.is_none(), || format!("{}: {}", case.name, found.map_or("", |f| f)));
    }
    claim
}

fn absent(runs: &Runs) -> Claim {
    let mut claim = Claim::new(
        "without effects no law, force or tangent of one is evaluated, without guides no phi_t",
    );
    for case in &runs.plain {
        let [_, _, effect, _] = words(case);
        let kinds: &[Kind] = match effect {
            "none" => &[Kind::Effect, Kind::Guide],
            "guide" => &[Kind::Effect],
            _ => &[Kind::Guide],
        };
        for kind in kinds {
            let found = case.functions.iter().find(|name| kind.has(name));
            claim.check(found.is_none(), || format!("{}: {}", case.name, found.map_or("", |f| f)));
        }
    }
    claim
}

/// Without this the two before it could hold because names are not seen.
fn present(runs: &Runs) -> Claim {
    let mut claim = Claim::new("where they are asked for, those functions are seen");
    for case in &runs.plain {
        let [_, dimension, effect, _] = words(case);
        let mut see = |seen: &dyn Fn(&str) -> bool, what: &str| {
            let is_seen = case.functions.iter().any(|name| seen(name));
            claim.check(is_seen, || format!("{}: no {what}", case.name));
        };
        if dimension == "spatial" {
            see(&is_spatial, "three-dimensional function");
        }
        match effect {
            "none" => {}
            "guide" => see(&|name| Kind::Guide.has(name), "function of a guide"),
            _ => see(&|name| Kind::Effect.has(name), "function of an effect"),
        }
    }
    claim
}

/// Functions by what they serve.
#[derive(Debug, Clone, Copy)]
enum Kind {
    Effect,
    Guide,
}

impl Kind {
    /// Is the function one of this kind? `<mbs_core::laws::...>::f` belongs to laws, `<Vec<mbs_core::laws::...>>::len` does not.
    fn has(self, function: &str) -> bool {
        let (places, names): (&[&str], &[&str]) = match self {
            Self::Effect => (
                &[
                    "mbs_core::laws::scalar",
                    "mbs_core::laws::body",
                    "mbs_core::natural::forces",
                    "mbs_core::natural::on_body",
                ],
                &["::evaluate_forces", "::add_transverse", "::remember"],
            ),
            Self::Guide => (
                &["mbs_core::elements::guided", "mbs_core::laws::guide"],
                &["::evaluate_phi_t", "::opposite_guide"],
            ),
        };
        let path = function.trim_start_matches('<');
        places.iter().any(|place| path.starts_with(place))
            || names.iter().any(|name| function.ends_with(name))
    }
}

/// Is the function an instance for three dimensions?
fn is_spatial(function: &str) -> bool {
    ["NaturalModel<f64, 3>", "Const<3>", "::<f64, 3>", "::Spatial"]
        .iter()
        .any(|mark| function.contains(mark))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn case(name: &str, instructions: u64, functions: &[&str]) -> Case {
        let functions = functions.iter().map(|&f| f.to_owned()).collect();
        Case { name: name.to_owned(), instructions, copies: 0, functions }
    }

    #[test]
    fn one_instruction_more_contradicts() {
        let full = vec![
            case("index-3 planar none", 100, &[]),
            case("index-3 planar bumper off", 100, &[]),
            case("index-3 planar tire off", 101, &[]),
        ];
        let lean = vec![case("index-3 planar none", 98, &[])];
        let runs = Runs { full, lean, plain: vec![] };
        assert_eq!(switched_off(&runs).n_checked, 2);
        assert_eq!(switched_off(&runs).against.len(), 1);
        assert_eq!(left_out(&runs).against.len(), 1);
        assert!(!planar(&runs).holds(), "what was not looked at does not hold");
    }

    #[test]
    fn functions_are_told_apart_by_their_paths() {
        assert!(Kind::Effect.has("<mbs_core::laws::scalar::Law<f64>>::evaluate"));
        assert!(!Kind::Effect.has("<alloc::vec::Vec<mbs_core::laws::scalar::Law<f64>>>::len"));
        assert!(Kind::Guide.has("<NaturalModel<f64, 2> as Model<f64>>::evaluate_phi_t"));
        assert!(is_spatial("mbs_core::natural::forces::product::<f64, 3>"));
        assert!(!is_spatial("<alloc::vec::Vec<[f64; 3]>>::len"));
    }
}

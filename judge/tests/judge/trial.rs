//! The crates compared with the judge: enumerated cases, and the first hundred random scenes.

use judge::random;
use judge::scene::Quantity;
use judge::trial::{oracle, seeds};
use mbs::core::outputs::{QUANTITIES, TargetKind};
use std::collections::BTreeMap;

/// The only allowed reason to leave a combination out: the settings are refused for every scene.
const NO_SUCH_RULE: &str = "formulation .. has no ..";

#[test]
fn the_judge_knows_every_quantity_of_the_table() {
    let of = |target| {
        let rows = QUANTITIES.iter().filter(move |row| row.target == target);
        rows.map(|row| row.name).collect::<Vec<_>>()
    };
    assert_eq!(of(TargetKind::Point), Quantity::OF_POINTS);
    assert_eq!(of(TargetKind::RelativePoint), Quantity::OF_SEEN_POINTS);
    assert_eq!(of(TargetKind::RelativeBody), Quantity::OF_SEEN_BODIES);
    assert_eq!(of(TargetKind::WheelCarrier), Quantity::OF_CARRIERS);
    assert_eq!(of(TargetKind::Body), Quantity::OF_BODIES);
    assert_eq!(of(TargetKind::Joint), Quantity::OF_JOINTS);
    assert_eq!(of(TargetKind::Coupling), Quantity::OF_COUPLINGS);
    assert_eq!(of(TargetKind::Rolling), Quantity::OF_ROLLINGS);
    assert_eq!(of(TargetKind::Effect), Quantity::OF_EFFECTS);
    assert_eq!(of(TargetKind::Signal), Quantity::OF_SIGNALS);
    assert_eq!(of(TargetKind::Scene), Quantity::OF_SCENES);
}

#[test]
fn every_joint_with_every_effect_moves_as_the_judge_says_in_every_formulation() {
    let cases = random::cases();
    let tally = oracle::all(&cases);
    let left_out: usize = tally.left_out.values().sum();
    let (n, agree) = (cases.len(), tally.agree);
    crate::say(&format!("{n} cases, {agree} combinations agree, {left_out} are left out"));
    assert!(tally.wrong.is_empty(), "{}", tally.wrong.join("\n"));
    assert_eq!(tally.left_out.keys().collect::<Vec<_>>(), [NO_SUCH_RULE]);
    // at least half of all pairs of a formulation and an integrator exist
    assert!(tally.agree >= left_out);
}

/// Refusals among the first hundred seeds: formulation, code, seeds.
const REFUSED: &[(&str, &str, &[u64])] = &[];

#[test]
fn the_first_hundred_random_scenes_move_as_the_judge_says_or_are_refused_as_listed() {
    let mut tally = seeds::Tally::default();
    let said: String = (1..=100).map(|seed| tally.add(seed, None)).collect();
    let agree: usize = tally.verdicts.iter().filter(|((_, v), _)| v == "agrees").map(|x| x.1).sum();
    crate::say(&format!("{} random scenes, {agree} runs agree with the judge", tally.scenes));
    assert_eq!((tally.differences, tally.unjudged), (0, 0), "{said}{}", tally.text());
    let mut refused: BTreeMap<(&str, &str), Vec<u64>> = BTreeMap::new();
    for ((formulation, code), seeds) in &tally.refused {
        refused.insert((formulation, code), seeds.clone());
    }
    let listed = REFUSED.iter().map(|(f, code, seeds)| ((*f, *code), seeds.to_vec()));
    assert_eq!(refused, listed.collect());
}

#[test]
fn every_kind_is_in_a_twentieth_or_a_hundredth_of_the_random_scenes_at_least() {
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for seed in 1..=400 {
        for kind in random::kinds(&random::scene(seed).text) {
            *counts.entry(kind).or_default() += 1;
        }
    }
    crate::say(&format!("scenes of 400 by kind: {counts:?}"));
    // half of the scenes have couplings and signals, of ten and thirteen kinds; so each kind occurs more rarely
    let least = |kind: &str| match kind.split(' ').next() {
        Some("coupling" | "signal" | "rolling") => 4,
        _ => 20,
    };
    let rare: Vec<_> = counts.iter().filter(|(kind, n)| **n < least(kind)).collect();
    assert!(rare.is_empty(), "{rare:?}");
    // ten kinds of joints and nineteen of effects, plane and space, three numbers of loops, guides, starts
    assert!(counts.len() >= 59, "{}", counts.len());
}

#[test]
fn nothing_but_what_runs_the_crates_names_them() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut folders = vec![folder];
    let mut seen = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() && path.file_name().is_some_and(|name| name != "trial") {
                folders.push(path);
            } else if path.is_file() {
                let text = std::fs::read_to_string(&path).expect("a source");
                assert!(!text.contains("mbs::") && !text.contains("use mbs"), "{}", path.display());
                seen += 1;
            }
        }
    }
    assert!(seen > 20);
}

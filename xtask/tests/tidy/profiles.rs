//! Rules for the levels of optimisation. Published and measured builds are at level 3, and so is every crate whose code runs in a step. In
//! tests, no crate that steps depend on is at level 0.

use super::{read, report};
use std::collections::{BTreeMap, BTreeSet};
use toml::{Table, Value};
use xtask::process::{cargo, output, root};

/// Crates whose code runs in a step, or is called once for each of many numbers. A release build has them at level 3.
const STEPS: [&str; 15] = [
    "amd",
    "libm",
    "mbs-augmented",
    "mbs-classical",
    "mbs-core",
    "mbs-linear",
    "mbs-math",
    "mbs-mesh",
    "mbs-nostd",
    "mbs-parallel",
    "mbs-recursive",
    "mbs-redundancy",
    "mbs-sparse",
    "mbs-statespace",
    "mbs-steps",
];

/// The levels of optimisation that a profile sets for packages, and the profile that it inherits from.
fn profile(manifest: &Table, name: &str) -> (BTreeMap<String, Value>, Option<String>) {
    let profile = &manifest["profile"][name];
    let packages = profile.get("package").and_then(Value::as_table).cloned().unwrap_or_default();
    let level = |(name, value): (String, Value)| Some((name, value.get("opt-level")?.clone()));
    let inherits = profile.get("inherits").and_then(Value::as_str).map(str::to_owned);
    (packages.into_iter().filter_map(level).collect(), inherits)
}

#[test]
fn what_release_lowers_dist_and_bench_raise_again() {
    let manifest: Table = read("Cargo.toml").parse().expect("the manifest is TOML");
    let [(release, _), (dist, of_dist), (bench, of_bench)] =
        ["release", "dist", "bench"].map(|name| profile(&manifest, name));
    assert!(!release.is_empty(), "the profile `release` lowers something");
    assert_eq!([of_dist.as_deref(), of_bench.as_deref()], [Some("release"), Some("dist")]);
    assert!(bench.is_empty(), "`bench` has the levels of `dist`");
    let is_raised = |name: &String| dist.get(name).and_then(Value::as_integer) == Some(3);
    let findings: Vec<_> = release.keys().filter(|name| !is_raised(name)).cloned().collect();
    report("Each package that `release` lowers has level 3 in `dist`", &findings);
    let findings: Vec<_> =
        dist.keys().filter(|name| !release.contains_key(*name)).cloned().collect();
    report("`dist` names no other package", &findings);
}

#[test]
fn no_crate_of_a_step_is_below_level_3_in_release() {
    let manifest: Table = read("Cargo.toml").parse().expect("the manifest is TOML");
    let (release, _) = profile(&manifest, "release");
    let lowered = STEPS.iter().filter(|name| release.contains_key(**name));
    let findings: Vec<_> = lowered.map(|name| (*name).to_owned()).collect();
    report("No crate of a step is lowered", &findings);
    assert!(manifest["profile"]["release"].get("opt-level").is_none(), "release is at level 3");
}

#[test]
fn what_dev_raises_of_ours_plain_lowers_again() {
    let manifest: Table = read("Cargo.toml").parse().expect("the manifest is TOML");
    let [(dev, _), (plain, of_plain)] = ["dev", "plain"].map(|name| profile(&manifest, name));
    assert_eq!(of_plain.as_deref(), Some("dev"));
    let is_low = |level: Option<&Value>| level.and_then(Value::as_integer) == Some(0);
    let ours = dev.keys().filter(|name| root().join(name).is_dir());
    let raised = ours.filter(|name| !is_low(dev.get(*name)) && !is_low(plain.get(*name)));
    report("`plain` has level 0 for each crate of ours", &raised.cloned().collect::<Vec<_>>());
}

#[test]
fn other_peoples_crates_that_steps_stand_on_are_at_level_3_in_tests() {
    let manifest: Table = read("Cargo.toml").parse().expect("the manifest is TOML");
    let (dev, _) = profile(&manifest, "dev");
    let mut tree = cargo();
    tree.args(["tree", "--locked", "--package", "mbs-steps", "--prefix", "none"]);
    tree.args(["--edges", "normal,no-proc-macro"]).current_dir(root());
    let tree = output(&mut tree).expect("cargo knows its packages");
    let names = tree.lines().filter_map(|line| line.split_whitespace().next());
    let others: BTreeSet<_> = names.filter(|name| !name.starts_with("mbs-")).collect();
    assert!(others.contains("nalgebra"), "{others:?}");
    let low =
        others.into_iter().filter(|name| dev.get(*name).and_then(Value::as_integer) != Some(3));
    let findings: Vec<_> = low.map(str::to_owned).collect();
    report("`dev` names each crate below mbs-steps, at level 3", &findings);
}

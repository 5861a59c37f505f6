//! Builds that are cross-compiled: crates, feature sets, targets.

use super::form::Form;

/// One build: a crate with a feature set.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Build {
    /// Name of the crate.
    pub(crate) package: &'static str,
    /// Features of the build; the default features are always off.
    pub(crate) features: &'static [&'static str],
    /// True if the build may use `alloc`.
    pub(crate) is_alloc: bool,
}

/// List of all builds. Builds of one crate follow each other, from the fewest features to the most.
const BUILDS: &[Build] = &[
    Build { package: "mbs-math", features: &[], is_alloc: false },
    Build { package: "mbs-math", features: &["alloc"], is_alloc: true },
    Build { package: "mbs-core", features: &[], is_alloc: false },
    Build { package: "mbs-core", features: &["effects"], is_alloc: false },
    Build { package: "mbs-core", features: &["alloc"], is_alloc: true },
    Build { package: "mbs-core", features: &["alloc", "limit", "tire"], is_alloc: true },
    Build { package: "mbs-core", features: &["alloc", "effects"], is_alloc: true },
    Build { package: "mbs-statespace", features: &[], is_alloc: true },
    Build { package: "mbs-classical", features: &[], is_alloc: true },
    Build { package: "mbs-recursive", features: &[], is_alloc: false },
    Build { package: "mbs-recursive", features: &["elements"], is_alloc: false },
    Build { package: "mbs-recursive", features: &["alloc"], is_alloc: true },
    Build { package: "mbs-linear", features: &[], is_alloc: true },
    Build { package: "mbs-nostd", features: &[], is_alloc: false },
    Build {
        package: "mbs-nostd",
        features: &["mbs-core/polynomial", "mbs-core/speed-hold", "mbs-core/tire"],
        is_alloc: false,
    },
    Build { package: "mbs-nostd", features: &["signals"], is_alloc: false },
    Build { package: "mbs-nostd", features: &["elements", "mbs-core/effects"], is_alloc: false },
];

/// The targets: Cortex-M4F and Cortex-M7 with hardware floating point; Cortex-M0 and RISC-V without it.
pub(crate) const TARGETS: &[&str] =
    &["thumbv7em-none-eabihf", "thumbv6m-none-eabi", "riscv32imac-unknown-none-elf"];

/// The targets of a form. RISC-V lacks no types or names that the two other targets have, so only the long form builds for it.
pub(super) fn targets(form: Form) -> &'static [&'static str] {
    if form == Form::Whole { TARGETS } else { &TARGETS[..2] }
}

/// The builds for a target. The first target has every feature set; the others have the first and the last set of each crate. A set between
/// these has no code that such a target might lack.
pub(crate) fn of(target: &str) -> impl Iterator<Item = &'static Build> {
    let is_first = target == TARGETS[0];
    let package = |at: Option<usize>| at.and_then(|at| BUILDS.get(at)).map(|build| build.package);
    let is_end = move |at: usize| {
        let own = package(Some(at));
        package(at.checked_sub(1)) != own || package(Some(at + 1)) != own
    };
    BUILDS.iter().enumerate().filter(move |(at, _)| is_first || is_end(*at)).map(|(_, build)| build)
}

/// True for the last build: the solver of controllers with all features.
pub(crate) fn is_whole(build: &Build) -> bool {
    BUILDS.last() == Some(build)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_target_has_every_set_and_the_others_the_ends_of_each_crate() {
        assert_eq!(of(TARGETS[0]).count(), BUILDS.len());
        let ends: Vec<_> = of(TARGETS[1]).map(|b| (b.package, b.features)).collect();
        assert_eq!(ends[..2], [("mbs-math", &[][..]), ("mbs-math", &["alloc"][..])]);
        assert_eq!(ends[2..4], [("mbs-core", &[][..]), ("mbs-core", &["alloc", "effects"][..])]);
        assert!(ends.contains(&("mbs-linear", &[])));
        assert_eq!(ends.last(), Some(&("mbs-nostd", &["elements", "mbs-core/effects"][..])));
    }
}

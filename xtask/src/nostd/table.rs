//! What is cross-compiled: crates, feature sets, targets.

/// One build: a crate with a feature set.
#[derive(Debug)]
pub(crate) struct Build {
    /// Name of the crate.
    pub(crate) package: &'static str,
    /// Its features; the default ones are always off.
    pub(crate) features: &'static [&'static str],
    /// Whether the build may use `alloc`.
    pub(crate) is_alloc: bool,
}

/// The builds, each made for every target.
pub(crate) const BUILDS: &[Build] = &[
    Build { package: "mbs-core", features: &[], is_alloc: false },
    Build { package: "mbs-core", features: &["effects"], is_alloc: false },
    Build { package: "mbs-core", features: &["alloc"], is_alloc: true },
    Build { package: "mbs-core", features: &["alloc", "limit", "tire"], is_alloc: true },
    Build { package: "mbs-core", features: &["alloc", "effects"], is_alloc: true },
    Build { package: "mbs-statespace", features: &[], is_alloc: true },
    Build { package: "mbs-classical", features: &[], is_alloc: true },
    Build { package: "mbs-recursive", features: &[], is_alloc: false },
    Build { package: "mbs-recursive", features: &["alloc"], is_alloc: true },
    Build { package: "mbs-linear", features: &[], is_alloc: true },
    Build { package: "mbs-nostd", features: &[], is_alloc: false },
    Build {
        package: "mbs-nostd",
        features: &["polynomial", "speed-hold", "tire"],
        is_alloc: false,
    },
    Build { package: "mbs-nostd", features: &["effects"], is_alloc: false },
];

/// The targets: Cortex-M4F and Cortex-M7 with hardware floating point; Cortex-M0 without; RISC-V without.
pub(crate) const TARGETS: &[&str] =
    &["thumbv7em-none-eabihf", "thumbv6m-none-eabi", "riscv32imac-unknown-none-elf"];

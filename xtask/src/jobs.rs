//! What the jobs of `lab` do, in a line each: the help of `cargo xtask`, and that of `lab`, which reads their arguments.

/// `cargo xtask tables`.
pub const TABLES: &str =
    "Run the report's tables anew, beside its numbers: text, CSV and HTML under target/tables";
/// `cargo xtask report`.
pub const REPORT: &str = "Make every page of measurements with an index under target/report; a run that stops unlisted fails the job";
/// `cargo xtask steps`.
pub const STEPS: &str = "Run the experiments on variable steps beside fixed ones: text, CSV and HTML under target/steps";
/// `cargo xtask bench`.
pub const BENCH: &str = "Time a step in each formulation and scene, its phases, faer beside it, and what threads gain: text, JSON and HTML under target/bench";
/// `cargo xtask choice`.
pub const CHOICE: &str = "Hold the choice by measurement against the best of all methods, on every scene at three errors: text and CSV under target/choice";
/// `cargo xtask estimate`.
pub const ESTIMATE: &str = "Compare the errors that a run states with those that it has, on every scene: text under target/estimate";
/// `cargo xtask peers`.
pub const PEERS: &str = "Time mbs and its peers on the same problems by turns (docs/PEERS.md): text, Markdown, CSV and HTML under target/peers";
/// `cargo xtask profile`.
pub const PROFILE: &str = "Profile steps of index-3: instructions by parts under callgrind, operations, and the time beside the floor that the machine's own rates give (docs/PROFILES.md): text and Markdown under target/profile";
/// `cargo xtask gauntlet`.
pub const GAUNTLET: &str = "Run hard cases by seed in every formulation; the table of methods by properties under target/gauntlet";

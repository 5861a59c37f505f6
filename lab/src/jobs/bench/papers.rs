//! Numbers of the report on processors, for comparison with ours.
//!
//! Table IV of the report is Table II of publication 3. Table V is in the report only.

/// A formulation of the report with its name in mbs.
pub(crate) struct Method {
    /// Name of the formulation in the report.
    pub(crate) printed: &'static str,
    /// Name of our formulation.
    pub(crate) ours: &'static str,
    /// Reduction of CPU time with 1 to 4 processors [%].
    pub(crate) reductions: [f64; 4],
}

/// Results for the vehicle over ramp and stairs (Simul1) on a SUN SPARCstation 20 with four HyperSPARC processors of 100 MHz [P3 II].
pub(crate) const REDUCTIONS: [Method; 3] = [
    Method {
        printed: "Augmented Lagrangian",
        ours: "index-3",
        reductions: [0.0, 22.7, 29.6, 29.6],
    },
    Method { printed: "Classical Lagrangian", ours: "classical", reductions: [0.0, 6.5, 9.0, 9.0] },
    Method { printed: "Fully-Recursive", ours: "recursive", reductions: [0.0; 4] },
];

/// CPU time of ten seconds of motion with the augmented Lagrangian on an ALPHA AXP 4000 with two processors of 466 MHz [R V]. Each row has
/// the report's name, our scene, and seconds.
pub(crate) const TIMES: [(&str, &str, f64); 2] =
    [("SIMUL1", "iltis-stairs", 12.0), ("SIMUL2", "iltis-jump", 9.0)];

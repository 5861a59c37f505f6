//! The problems, the programs that solve them, and the required ratios of our time to that of the fastest peer.

use super::programs::Who;

/// Kind of a problem, which determines how its values are checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// One evaluation: all values are exact up to rounding.
    Evaluation,
    /// One step or a complete run with a fixed step: our error may not exceed that of the compared peer.
    Run,
    /// Runs with large to small tolerances: times are compared at equal numbers of digits.
    Digits,
}

/// A problem in one size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Problem {
    /// Name of the problem, as the programs know it.
    pub(super) name: &'static str,
    /// Title of the problem.
    pub(super) title: &'static str,
    /// Size of the problem.
    pub(super) n: usize,
    /// Kind of the problem, for the check of its values.
    pub(super) kind: Kind,
    /// Step of a complete run [s]; evaluations have a measuring time instead.
    pub(super) step: Option<f64>,
    /// Largest allowed ratio of our time to that of the fastest peer, and the ratio that is the aim.
    pub(super) limit: [f64; 2],
    /// The peers that solve the problem.
    pub(super) peers: &'static [Who],
}

impl Problem {
    /// Returns the name of the problem with its size.
    pub(super) fn label(&self) -> String {
        match self.kind {
            Kind::Digits => self.name.to_owned(),
            _ => format!("{} {}", self.name, self.n),
        }
    }
}

/// Numbers of correct digits at which times are compared.
pub(super) const DIGITS: std::ops::RangeInclusive<u8> = 3..=9;

/// Solvers of differential-algebraic equations, for which a smaller ratio is required.
pub(super) const ALGEBRAIC: [&str; 2] = ["RADAU5", "IDA"];
/// Largest ratio of our time to that of these solvers [-]: half.
pub(super) const LIMIT_ALGEBRAIC: f64 = 0.5;

/// Largest ratio at a number of digits. It is smaller from six digits on, where methods of high order are faster.
pub(super) fn limit_at(digits: u8) -> f64 {
    if digits < 6 { 1.3 } else { 1.0 }
}

/// The requested problems, or all of them. `robot` selects every `robot-...`.
///
/// # Errors
///
/// A name that no problem has, with the list of names.
pub(super) fn selected(names: &[String]) -> Result<Vec<Problem>, String> {
    let is_asked = |name: &String, p: &Problem| {
        p.name
            .strip_prefix(name.as_str())
            .is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
    };
    let problems = all();
    if let Some(name) = names.iter().find(|name| !problems.iter().any(|p| is_asked(name, p))) {
        let mut known: Vec<_> = problems.iter().map(|p| p.name).collect();
        known.dedup();
        return Err(format!("no problem is named {name}; there are {}", known.join(", ")));
    }
    let is_wanted = |p: &Problem| names.is_empty() || names.iter().any(|name| is_asked(name, p));
    Ok(problems.into_iter().filter(is_wanted).collect())
}

const CHAINS: &[Who] =
    &[Who::PinocchioOpen, Who::MuJoCo, Who::RustChains, Who::Simbody, Who::Drake];
/// Freedoms of the robots of lab/peers/robots.py: UR5, Panda, Solo12, Baxter, G1, Talos. Solo12, G1 and Talos have a free base.
const ROBOTS: [usize; 6] = [6, 9, 18, 19, 35, 50];
const TREES: &[Who] = &[Who::PinocchioOpen, Who::MuJoCo, Who::Simbody, Who::Drake];

/// Returns all problems.
fn all() -> Vec<Problem> {
    let evaluation = |name, title, n, limit, peers| Problem {
        name,
        title,
        n,
        kind: Kind::Evaluation,
        step: None,
        limit,
        peers,
    };
    let run = |name, title, n, limit| {
        let (kind, step) = (Kind::Run, Some(1e-3));
        Problem { name, title, n, kind, step, limit, peers: &[Who::Exudyn] }
    };
    let mut all = Vec::new();
    for n in [6, 10, 30, 100, 300] {
        let title = "accelerations of a chain";
        all.push(evaluation("chain", title, n, [0.6, 0.45], CHAINS));
    }
    all.push(evaluation("tree", "accelerations of a binary tree", 127, [0.75, 0.55], TREES));
    for n in [6, 10, 30, 100, 300] {
        let title = "efforts of a chain for given accelerations";
        all.push(evaluation("inverse", title, n, [0.6, 0.6], &[Who::PinocchioOpen]));
    }
    for n in [1, 10, 40, 100] {
        let (title, peers) = (
            "accelerations of four-bars in a row",
            &[Who::PinocchioLoop, Who::MuJoCo, Who::Simbody],
        );
        all.push(evaluation("four-bars", title, n, [0.7, 0.7], peers));
    }
    for (name, title, limit) in [
        ("robot-forward", "accelerations of a robot", [0.4, 0.4]),
        ("robot-inverse", "efforts of a robot for given accelerations", [0.5, 0.5]),
        ("robot-mass", "mass matrix of a robot", [0.7, 0.5]),
        ("robot-jacobian", "Jacobian of a robot's last body", [0.7, 0.7]),
        ("robot-derivatives", "derivatives of a robot's accelerations", [1.0, 0.8]),
    ] {
        let peers: &[Who] = match name {
            "robot-derivatives" => &[Who::PinocchioRobot],
            _ => &[Who::PinocchioRobot, Who::MuJoCoRobot],
        };
        all.extend(ROBOTS.map(|n| evaluation(name, title, n, limit, peers)));
    }
    let step = evaluation("step", "a step of a chain, order 4", 10, [0.7, 0.5], &[Who::MuJoCo]);
    all.push(Problem { kind: Kind::Run, ..step });
    all.push(run("double-pendulum", "10 s of a double pendulum", 2, [1.0 / 12.0, 1.0 / 25.0]));
    all.push(run("n-four-bars", "10 s of four-bars in a row", 2, [1.0 / 25.0, 1.0 / 50.0]));
    all.push(run("n-four-bars", "10 s of four-bars in a row", 40, [1.0 / 20.0, 1.0 / 20.0]));
    let title = "Andrews' squeezing mechanism to 0.03 s";
    let peers = &[Who::RustAndrews, Who::Radau, Who::Ida];
    let andrews = evaluation("andrews", title, 7, [1.0, 1.0], peers);
    all.push(Problem { kind: Kind::Digits, ..andrews });
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn problems_are_asked_for_by_name() {
        let sizes = |names: &[&str]| {
            let names: Vec<_> = names.iter().map(|&name| name.to_owned()).collect();
            Ok::<Vec<_>, String>(selected(&names)?.iter().map(|p| p.n).collect())
        };
        assert_eq!(sizes(&["chain", "step"]).unwrap(), [6, 10, 30, 100, 300, 10]);
        assert_eq!(sizes(&["robot"]).unwrap().len(), 30);
        let all = selected(&[]).unwrap();
        assert_eq!(all.len(), 50);
        assert!(all.iter().all(|p| p.limit[1] <= p.limit[0]));
        let why = sizes(&["chain", "robots"]).unwrap_err();
        assert!(why.contains("no problem is named robots; there are chain, tree,"), "{why}");
    }
}

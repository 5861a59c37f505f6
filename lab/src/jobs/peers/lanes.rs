//! Measurements of a problem. A lane is an algorithm of a program, with its time in every turn.

use super::problems::{Kind, Problem};
use super::programs::{Line, Who};

/// Largest error of our value, relative to an exact value [-].
const OURS: f64 = 1e-9;
/// Largest relative error of a peer's evaluation that counts [-]. Iterations that stop early and soft constraints have larger errors.
const PEERS: f64 = 1e-5;
/// Ratio and difference of two errors up to which they count as equal [-]: the tables show two digits.
const SAME_ERROR: [f64; 2] = [1.1, 1e-12];

/// An algorithm of a program on a problem.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Lane {
    pub(super) who: Who,
    pub(super) algorithm: String,
    /// CPU time in each turn [s].
    pub(super) seconds: Vec<f64>,
    /// Number of correct digits, if the algorithm reports it.
    pub(super) digits: Option<f64>,
    /// Error of the value, in its unit, and relative to the exact value if that is not zero.
    pub(super) error: Option<[f64; 2]>,
}

impl Lane {
    /// Label of the program and the algorithm.
    pub(super) fn label(&self) -> String {
        match self.who {
            Who::RustChains | Who::RustAndrews | Who::Radau | Who::Ida => self.algorithm.clone(),
            _ => format!("{} {}", self.who.name(), self.algorithm),
        }
    }

    /// The median of the lane's times [s].
    pub(super) fn time(&self) -> f64 {
        median(self.seconds.clone())
    }

    /// True if the lane is one of ours that treats the scene as spatial.
    pub(super) fn is_spatial(&self) -> bool {
        self.algorithm.starts_with("spatial")
    }

    fn error_of(&self, kind: Kind) -> f64 {
        self.error.map_or(f64::INFINITY, |[far, relative]| match kind {
            Kind::Evaluation => relative,
            _ => far,
        })
    }
}

/// The lanes of a problem.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Measured {
    pub(super) problem: Problem,
    pub(super) lanes: Vec<Lane>,
    /// Exact values by their names.
    exact: Vec<(String, f64)>,
    /// Programs that can run here and had no result, with the reason.
    pub(super) failed: Vec<(Who, String)>,
}

impl Measured {
    /// Makes the record of a problem that has no lanes yet.
    pub(super) fn new(problem: Problem) -> Self {
        Self { problem, lanes: Vec::new(), exact: Vec::new(), failed: Vec::new() }
    }

    /// Adds the lines that a program printed in a turn. Our program runs first, and prints the exact values.
    pub(super) fn take(&mut self, who: Who, lines: Vec<Line>) {
        for line in lines {
            if line.algorithm == "reference" {
                if !self.exact.iter().any(|(name, _)| *name == line.reference) {
                    self.exact.push((line.reference, line.value));
                }
                continue;
            }
            let is_same = |lane: &&mut Lane| lane.who == who && lane.algorithm == line.algorithm;
            if let Some(lane) = self.lanes.iter_mut().find(is_same) {
                lane.seconds.push(line.seconds);
                continue;
            }
            let far = match line.reference.as_str() {
                "zero" => Some((line.value.abs(), 1.0)),
                name => self
                    .exact
                    .iter()
                    .find(|(known, _)| known == name)
                    .map(|(_, exact)| ((line.value - exact).abs(), exact.abs())),
            };
            self.lanes.push(Lane {
                who,
                algorithm: line.algorithm,
                seconds: vec![line.seconds],
                digits: (line.reference == "digits").then_some(line.value),
                error: far.map(|(far, size)| [far, far / size]),
            });
        }
    }

    /// Our lanes, or those of the peers.
    pub(super) fn of(&self, is_ours: bool) -> impl Iterator<Item = &Lane> {
        self.lanes.iter().filter(move |lane| (lane.who == Who::Ours) == is_ours)
    }

    /// Our lanes with errors that are larger than rounding errors.
    pub(super) fn wrong(&self) -> Vec<&Lane> {
        let is_wrong = |lane: &&Lane| !(lane.error_of(Kind::Evaluation) <= OURS);
        match self.problem.kind {
            Kind::Evaluation => self.of(true).filter(is_wrong).collect(),
            _ => Vec::new(),
        }
    }

    /// The fastest peer whose value is exact enough.
    pub(super) fn peer(&self) -> Option<&Lane> {
        let counts = |lane: &&Lane| match self.problem.kind {
            Kind::Evaluation => lane.error_of(Kind::Evaluation) <= PEERS,
            _ => lane.error_of(Kind::Run).is_finite(),
        };
        fastest(self.of(false).filter(counts))
    }

    /// Our fastest lane, planar or spatial, whose error is no larger than that of the fastest peer, or than rounding errors.
    pub(super) fn ours(&self, is_spatial: bool) -> Option<&Lane> {
        let kind = self.problem.kind;
        let most = match (kind, self.peer()) {
            (Kind::Evaluation, _) => OURS,
            (_, Some(peer)) => (SAME_ERROR[0] * peer.error_of(kind)).max(SAME_ERROR[1]),
            (_, None) => f64::INFINITY,
        };
        let counts = |lane: &&Lane| lane.is_spatial() == is_spatial && lane.error_of(kind) <= most;
        fastest(self.of(true).filter(counts))
    }

    /// Median over the turns of the ratio of our fastest time to that of the fastest peer.
    pub(super) fn ratio(&self, is_spatial: bool) -> Option<f64> {
        Some(ratio(&self.ours(is_spatial)?.seconds, &self.peer()?.seconds))
    }
}

/// The median of the ratios of two lists of times, turn by turn.
pub(super) fn ratio(ours: &[f64], peer: &[f64]) -> f64 {
    median(ours.iter().zip(peer).map(|(ours, peer)| ours / peer).collect())
}

/// Median of numbers; NaN for an empty list.
pub(super) fn median(mut x: Vec<f64>) -> f64 {
    x.sort_by(f64::total_cmp);
    let n = x.len();
    match n {
        0 => f64::NAN,
        _ => 0.5 * (x[(n - 1) / 2] + x[n / 2]),
    }
}

fn fastest<'a>(lanes: impl Iterator<Item = &'a Lane>) -> Option<&'a Lane> {
    lanes.min_by(|a, b| a.time().total_cmp(&b.time()))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::peers::problems::selected;

    pub(crate) fn line(algorithm: &str, seconds: f64, value: f64) -> Line {
        Line { algorithm: algorithm.into(), seconds, value, reference: "exact".into() }
    }

    #[test]
    fn ratios_are_taken_turn_by_turn_against_the_fastest_peer_that_is_right() {
        let mut measured = Measured::new(selected(&["chain".to_owned()]).unwrap()[0]);
        for (ours, peer) in [(1.0, 2.0), (4.0, 5.0), (1.0, 4.0)] {
            let own =
                [line("reference", 0.0, 3.0), line("planar", ours, 3.0), line("spatial", 9.0, 3.1)];
            measured.take(Who::Ours, own.to_vec());
            let others = [line("aba", peer, 3.0 + 1e-9), line("soft", 0.1, 3.3)];
            measured.take(Who::MuJoCo, others.to_vec());
        }
        assert_eq!(measured.peer().map(Lane::label), Some("MuJoCo aba".to_owned()));
        assert_eq!([measured.ratio(false), measured.ratio(true)], [Some(0.5), None]);
        assert_eq!(measured.wrong().len(), 1, "3.1 is not 3");
    }

    #[test]
    fn a_run_may_err_as_much_as_the_peer_and_no_more() {
        let mut measured = Measured::new(selected(&["double-pendulum".to_owned()]).unwrap()[0]);
        let of = |algorithm, seconds, value| Line {
            reference: "zero".into(),
            ..line(algorithm, seconds, value)
        };
        measured.take(Who::Ours, vec![of("coarse", 0.1, 0.3), of("fine", 0.2, 0.01)]);
        measured.take(Who::Exudyn, vec![of("generalised-alpha", 2.0, -0.02)]);
        assert_eq!(measured.ours(false).map(|lane| lane.algorithm.as_str()), Some("fine"));
        assert_eq!(measured.ratio(false), Some(0.1));
    }
}

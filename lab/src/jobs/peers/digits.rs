//! Times at equal numbers of digits. The runs of a solver with large to small tolerances give a curve, which is read at whole numbers of
//! digits.

use super::lanes::{Lane, Measured, median, ratio};
use super::problems::DIGITS;

/// A solver, with its time at each number of digits in each turn; `None` beyond the digits of its runs.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Solver {
    pub(super) name: String,
    pub(super) is_ours: bool,
    pub(super) is_spatial: bool,
    at: Vec<Option<Vec<f64>>>,
}

impl Solver {
    /// Median time of the solver at this number of digits [s].
    pub(super) fn time(&self, digits: u8) -> Option<f64> {
        Some(median(self.turns(digits)?.to_vec()))
    }

    fn turns(&self, digits: u8) -> Option<&[f64]> {
        self.at[usize::from(digits - DIGITS.start())].as_deref()
    }
}

/// The solvers of a problem whose runs report digits. A solver's name is that of its algorithm without the last word, the tolerance.
pub(super) fn solvers(measured: &Measured) -> Vec<Solver> {
    let mut solvers: Vec<(String, Vec<&Lane>)> = Vec::new();
    for lane in &measured.lanes {
        let name = lane.label();
        let name = name.rsplit_once(' ').map_or(name.as_str(), |(name, _)| name).to_owned();
        match solvers.iter_mut().find(|(known, _)| *known == name) {
            Some((_, lanes)) => lanes.push(lane),
            None => solvers.push((name, vec![lane])),
        }
    }
    let solver = |(name, lanes): (String, Vec<&Lane>)| Solver {
        is_ours: lanes[0].who == super::programs::Who::Ours,
        is_spatial: lanes[0].is_spatial(),
        at: DIGITS.map(|digits| turns(&lanes, f64::from(digits))).collect(),
        name,
    };
    solvers.into_iter().map(solver).collect()
}

/// The times of one solver's runs at a number of digits, turn by turn.
fn turns(lanes: &[&Lane], digits: f64) -> Option<Vec<f64>> {
    let n = lanes.iter().map(|lane| lane.seconds.len()).min()?;
    let points = |turn: usize| lanes.iter().filter_map(move |l| Some([l.digits?, l.seconds[turn]]));
    (0..n).map(|turn| read(points(turn).collect(), digits)).collect()
}

/// The time at a number of digits, on the curve through the runs for which no other run is both faster and more exact. Between two of these
/// runs, digits are linear in the logarithm of time. `None` beyond the most exact run.
fn read(mut points: Vec<[f64; 2]>, digits: f64) -> Option<f64> {
    points.retain(|[digits, _]| digits.is_finite());
    points.sort_by(|a, b| a[1].total_cmp(&b[1]));
    let mut best: Option<[f64; 2]> = None;
    for point in points {
        if best.is_some_and(|best| point[0] <= best[0]) {
            continue;
        }
        if point[0] >= digits {
            let Some([d, t]) = best else { return Some(point[1]) };
            let share = (digits - d) / (point[0] - d);
            return Some(t * (point[1] / t).powf(share));
        }
        best = Some(point);
    }
    None
}

/// Our fastest solver, planar or spatial, and the fastest peer with `name` in its name, at a number of digits. The third value is the
/// median of the ratios of their times in each turn.
pub(super) fn against<'a>(
    solvers: &'a [Solver],
    digits: u8,
    is_spatial: bool,
    name: &str,
) -> Option<(&'a Solver, &'a Solver, f64)> {
    let fastest = |is_ours: bool| {
        let counts = |s: &&Solver| {
            let is_meant = if is_ours { s.is_spatial == is_spatial } else { s.name.contains(name) };
            s.is_ours == is_ours && is_meant
        };
        let of = solvers.iter().filter(counts).filter(|s| s.time(digits).is_some());
        of.min_by(|a, b| {
            a.time(digits).partial_cmp(&b.time(digits)).unwrap_or(std::cmp::Ordering::Equal)
        })
    };
    let (ours, peer) = (fastest(true)?, fastest(false)?);
    Some((ours, peer, ratio(ours.turns(digits)?, peer.turns(digits)?)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_read_between_its_best_runs() {
        let points = || vec![[2.0, 1.0], [4.0, 4.0], [3.0, 5.0], [6.0, 16.0]];
        assert_eq!(read(points(), 1.0), Some(1.0));
        assert!((read(points(), 3.0).unwrap() - 2.0).abs() < 1e-12, "halfway from 1 to 4");
        assert!(
            (read(points(), 5.0).unwrap() - 8.0).abs() < 1e-12,
            "the run at 3 digits is beaten"
        );
        assert_eq!(read(points(), 7.0), None);
    }
}

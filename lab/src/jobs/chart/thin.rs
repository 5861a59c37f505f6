//! Reduction of points to as many as can be distinguished in a drawing.

use super::scale::Scale;
use std::collections::BTreeSet;

/// Number of slices of a line. The least and the largest value of each slice are drawn.
const SLICES: usize = 700;
/// Numbers of cells of a drawing, horizontally and vertically. Each cell has one mark at most.
const CELLS: [f64; 2] = [320.0, 120.0];

/// The least and the largest value of each slice of points, in their order.
pub(crate) fn extremes(points: &[[f64; 2]]) -> Vec<(f64, f64)> {
    let every = points.len().div_ceil(2 * SLICES).max(1);
    if every == 1 {
        return points.iter().map(|&[x, y]| (x, y)).collect();
    }
    let mut kept = Vec::new();
    for slice in points.chunks(2 * every) {
        let by = |a: &(usize, &[f64; 2]), b: &(usize, &[f64; 2])| a.1[1].total_cmp(&b.1[1]);
        let numbered = || slice.iter().enumerate();
        let (Some((i, least)), Some((k, most))) = (numbered().min_by(by), numbered().max_by(by))
        else {
            continue;
        };
        let (first, second) = if i <= k { (least, most) } else { (most, least) };
        kept.extend([*first, *second].map(|[x, y]| (x, y)));
    }
    kept
}

/// The first point of each cell of the drawing.
pub(crate) fn cells(points: &[[f64; 2]], (x, y): (&Scale, &Scale)) -> Vec<(f64, f64)> {
    let mut taken = BTreeSet::new();
    let mut is_new = |p: &&[f64; 2]| {
        // the conversion is safe: there are only a few hundred cells
        #[allow(clippy::cast_possible_truncation, reason = "the number of a cell")]
        let cell = [x.share(p[0]) * CELLS[0], y.share(p[1]) * CELLS[1]].map(|c| c as i32);
        taken.insert(cell)
    };
    points.iter().filter(|p| is_new(p)).map(|&[x, y]| (x, y)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peaks_survive_the_thinning() {
        let mut points: Vec<_> = (0..100_000).map(|i| [f64::from(i), 0.0]).collect();
        (points[77_777][1], points[12_345][1]) = (9.0, -7.0);
        let kept = extremes(&points);
        assert!(kept.len() <= 2 * SLICES && kept.is_sorted_by(|a, b| a.0 <= b.0));
        assert!(kept.contains(&(77_777.0, 9.0)) && kept.contains(&(12_345.0, -7.0)));
    }

    #[test]
    fn few_points_are_all_kept() {
        let points: Vec<_> = (0..1000).map(|i| [f64::from(i), f64::from(i % 7)]).collect();
        assert_eq!(extremes(&points).len(), 1000);
    }
}

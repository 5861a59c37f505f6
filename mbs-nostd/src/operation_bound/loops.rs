//! Operation counts of closed loops. A loop has m rows (a coupled loop m'), a joint has f freedoms, and a motion has N components.
//!
//! ```text
//! passing a joint     m (pass + N·N + shift + 2 f),   pairs m m' f
//! at the ancestor     m³/6 for Λ, m²/2 rows of N + 1 numbers, m (N + 1) and a square of N numbers each, couplings m m' (m/2 + N + 1)
//! ```

use super::{Operations, count, couplings, joints};
use mbs_core::Real;
use mbs_recursive::passes::slices::TreeSlices;
use mbs_recursive::rows::Row;
use mbs_recursive::space::{Numbers, Space};

/// Number of table entries that are read for the values and the residual of a row [-]. Counted for a slider-crank on a Cortex-M7, rounded
/// up.
const ROW_ENTRIES: u64 = 4;

const fn ops(products: u64, sums: u64) -> Operations {
    Operations::new(products, sums)
}

/// Returns the number of components of a motion.
const fn motion<T: Real, S: Space<T>>() -> u64 {
    count(S::Motion::N)
}

/// Returns the sum 1 + 2 + ... + (n − 1).
const fn below(n: u64) -> u64 {
    n * n.saturating_sub(1) / 2
}

/// Operations to solve a triangular system with stored inverses of the diagonal.
const fn solve(rows: u64) -> Operations {
    ops(below(rows) + rows, below(rows))
}

/// Operations for J a + bias of all rows, with the scale of the terms.
pub(super) fn residual<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>) -> Operations {
    let n = motion::<T, S>();
    let terms = count(m.loops.couplings.terms.len());
    let mut sum =
        ops(4 * n, 2 * (n - 1) + 2 + 2 * n + 2) * count(m.loops.rows.len()) + ops(terms, 2 * terms);
    for row in m.loops.rows {
        sum += couplings::residual(row) + Operations::entries(ROW_ENTRIES);
    }
    sum
}

/// Operations for values, rates, gradients and biases of all rows.
pub(super) fn rows<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>) -> Operations {
    let is_spatial = S::DIMENSION == 3;
    let ends = if is_spatial { ops(54, 51) } else { ops(20, 18) };
    let mut sum = ends * count(m.loops.loops.len());
    for row in m.loops.rows {
        sum += Operations::entries(ROW_ENTRIES);
        sum += match (row, is_spatial) {
            (Row::Coincidence { .. }, true) => ops(24, 17),
            (Row::Coincidence { .. }, false) => ops(10, 7),
            (Row::Gap { .. }, true) => ops(64, 46),
            (Row::Gap { .. }, false) => ops(29, 18),
            (Row::Dot { .. }, true) => ops(85, 55),
            (Row::Dot { .. }, false) => ops(37, 17),
            (Row::Length { .. }, true) => ops(40, 25).and(1, 0, 0),
            (Row::Coupled(row), _) => couplings::row(&m.loops.couplings, row),
            (Row::Length { .. }, false) => ops(22, 12).and(1, 0, 0),
            // the first row computes the lowest point for all rows
            (Row::Height { .. } | Row::Blade { .. }, _) => ops(240, 200).and(1, 1, 0),
            (Row::NoSlip { .. }, _) => ops(60, 45),
        };
    }
    sum
}

/// Operations to carry all rows over the joints, to eliminate the loops at their ancestors, and to compute the multipliers.
pub(super) fn evaluation<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>) -> Operations {
    let n = motion::<T, S>();
    let gathered = if S::DIMENSION == 3 { ops(6, 6) } else { ops(2, 2) };
    let square = if S::DIMENSION == 3 { ops(27, 21) } else { ops(9, 6) };
    let lap_rows = |lap: u32| m.loops.loops.get(lap as usize).map_or(0, |lap| u64::from(lap.n));
    let slopes = |lap: u32| {
        let first = m.loops.loops.get(lap as usize).map(|lap| lap.first as usize);
        match first.and_then(|k| m.loops.rows.get(k)) {
            // K b over all components, and a search for g among the terms
            Some(Row::Coupled(row)) => {
                ops(n, n) + Operations::entries(count(row.terms.range().len()))
            }
            _ => Operations::NONE,
        }
    };
    let plan = &m.loops.plan;
    // The gradients K of all further sides are added to the gradient of the first side.
    let added = couplings::added(m);
    let mut sum = opening(m);
    for (station, link) in plan.stations.iter().zip(m.links) {
        let f = count(link.kind.n_freedoms::<T, S>());
        for pass in plan.passes.get(station.passes.range()).unwrap_or(&[]) {
            let row = joints::pass::<T, S>(link.kind) + ops(n, n + 1) + gathered;
            let row = row + ops(2 * f, 2 * f + 1) + Operations::entries(1);
            sum += (row + slopes(pass.lap)) * lap_rows(pass.lap);
        }
        for pair in plan.pairs.get(station.pairs.range()).unwrap_or(&[]) {
            let rows = |pass: u32| plan.passes.get(pass as usize).map_or(0, |p| lap_rows(p.lap));
            let entry = ops(f, f + 1) + Operations::entries(1);
            sum += entry * (rows(pair.row) * rows(pair.column));
        }
    }
    for (i, station) in plan.stations.iter().enumerate() {
        for end in plan.ends.get(station.ends.range()).unwrap_or(&[]) {
            let rows = lap_rows(end.lap);
            let pairs = below(rows);
            sum += ops(0, n) * (rows * added);
            // Λ = C Cᵀ: inner products, products with inverses, and pivots.
            let inner = rows * (rows + 1) * rows.saturating_sub(1) / 6;
            sum += ops(inner + pairs + rows, inner + rows).and(2 * rows, rows, 0);
            sum += solve(rows);
            sum += if i == 0 {
                ops(n, n) * rows
            } else {
                ops(n, n) * pairs + (ops(n, 0) + square + ops(n, n)) * rows
            };
            for coupling in plan.couplings.get(end.couplings.range()).unwrap_or(&[]) {
                let later = lap_rows(coupling.lap);
                let carried = if i == 0 { Operations::NONE } else { ops(n, n) };
                sum += (solve(rows) + ops(0, 1)) * later;
                let entry = ops(1, 1) + Operations::entries(1);
                sum += (carried + entry) * (later * rows);
            }
            for update in plan.updates.get(end.updates.range()).unwrap_or(&[]) {
                let of = |coupling: u32| {
                    plan.couplings.get(coupling as usize).map_or(0, |c| lap_rows(c.lap))
                };
                let entry = ops(rows, rows + 1) + Operations::entries(1);
                sum += entry * (of(update.row) * of(update.column));
            }
        }
    }
    sum
}

/// Operations to carry and eliminate the right-hand sides l only, and to compute the multipliers.
pub(super) fn response<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>) -> Operations {
    let n = motion::<T, S>();
    let lap_rows = |lap: u32| m.loops.loops.get(lap as usize).map_or(0, |lap| u64::from(lap.n));
    let plan = &m.loops.plan;
    let mut sum = opening(m);
    for (i, (station, link)) in plan.stations.iter().zip(m.links).enumerate() {
        let f = count(link.kind.n_freedoms::<T, S>());
        for pass in plan.passes.get(station.passes.range()).unwrap_or(&[]) {
            sum += (ops(f, f + 1) + Operations::entries(1)) * lap_rows(pass.lap);
        }
        for end in plan.ends.get(station.ends.range()).unwrap_or(&[]) {
            let rows = lap_rows(end.lap);
            sum += solve(rows);
            if i > 0 {
                sum += ops(n, n) * rows;
            }
            for coupling in plan.couplings.get(end.couplings.range()).unwrap_or(&[]) {
                sum += (ops(rows, rows + 1) + Operations::entries(1)) * lap_rows(coupling.lap);
            }
        }
    }
    sum
}

/// Operations for λ of all loops, and for the responses of the joints to λ.
fn opening<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>) -> Operations {
    let n = motion::<T, S>();
    let lap_rows = |lap: u32| m.loops.loops.get(lap as usize).map_or(0, |lap| u64::from(lap.n));
    let plan = &m.loops.plan;
    let mut sum = Operations::NONE;
    for (i, (station, link)) in plan.stations.iter().zip(m.links).enumerate() {
        let f = count(link.kind.n_freedoms::<T, S>());
        for pass in plan.passes.get(station.passes.range()).unwrap_or(&[]) {
            sum += (ops(f, f) + Operations::entries(1)) * lap_rows(pass.lap);
        }
        for end in plan.ends.get(station.ends.range()).unwrap_or(&[]) {
            let rows = lap_rows(end.lap);
            if i > 0 {
                sum += ops(n, n) * rows;
            }
            sum += solve(rows);
            for coupling in plan.couplings.get(end.couplings.range()).unwrap_or(&[]) {
                sum += ops(1, 1) * (rows * lap_rows(coupling.lap));
            }
        }
    }
    sum
}

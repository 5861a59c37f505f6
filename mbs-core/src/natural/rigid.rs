//! Rigid-body rows of all bodies. A row that several bodies imply is written once.
//!
//! A body has rows for the constant lengths and angles of its basis, at most ½ nb (nb - 1) rows for nb basis entities. A row is
//! left out if another body has it for the same shared entities, such as the unit length of a common axis. A row is also left out
//! if another body implies it. Such a body has all entities of the row, and at least one of them depends on its basis. Bodies are
//! treated in file order, but after the bodies that imply one of their rows. If a direction depends on the bases of two bodies, its
//! unit length follows from both. The second body then leaves out the row of its basis with the largest weight in that length.

use super::basis::Basis;
use super::row_builder::RowDraft;
use super::sharing::{Entity, EntityKind};
use crate::Real;
use crate::algebra::{Coef, Vector, norm};
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec;
use alloc::vec::Vec;

/// Least weight of a row, in the unit length of a direction, for which it may be left out [-]: rounding errors grow tenfold.
/// Chosen, not tuned.
const WEIGHT: f64 = 0.1;

/// Key of a row, which is the product of two vectors. Each vector is given by two entities; the second one of a direction is
/// `zero`. A length has the entity `zero` twice in place of the second vector.
type Key = [usize; 4];

/// Row of a basis, with its key and the places of its two vectors in the basis.
#[derive(Debug)]
struct Own<T: Real> {
    key: Key,
    row: RowDraft<T>,
    places: [usize; 2],
}

/// Rigid-body rows of every cluster.
pub(super) fn rigid_rows<T: Real>(
    (bases, shared): (&[Basis<T>], &[Vec<usize>]),
    entities: &[Entity<T>],
    zero: usize,
) -> Vec<Vec<RowDraft<T>>> {
    let own: Vec<Vec<Own<T>>> = bases.iter().map(|basis| rows_of(basis, entities, zero)).collect();
    let implied = implied_by(bases, shared, &own, zero);
    let mut rows: Vec<Vec<RowDraft<T>>> = vec![Vec::new(); bases.len()];
    let (mut covered, mut is_done) = (BTreeSet::new(), vec![false; bases.len()]);
    for c in order(&own, &implied) {
        let is_open = |own: &&Own<T>| {
            let by = implied.get(&(c, own.key));
            !covered.contains(&own.key) && !by.is_some_and(|by| by.iter().any(|&b| is_done[b]))
        };
        let mut open: Vec<&Own<T>> = own[c].iter().filter(is_open).collect();
        let dependent = shared[c].iter().filter(|e| !bases[c].entities.contains(e));
        for &e in dependent.filter(|&&e| entities[e].kind == EntityKind::Direction) {
            if !covered.insert(length_of(e, zero)) {
                leave_out(&mut open, &bases[c], &entities[e].at, entities);
            }
        }
        covered.extend(open.iter().map(|own| own.key));
        rows[c] = open.into_iter().map(|own| own.row.clone()).collect();
        is_done[c] = true;
    }
    rows
}

/// Key of the unit length of a direction.
fn length_of(e: usize, zero: usize) -> Key {
    [e.min(zero), e.max(zero), zero, zero]
}

/// Leaves out the row with the largest weight in |u|^2 = sum c_i c_j v_i.v_j, if that weight exceeds `WEIGHT`.
fn leave_out<T: Real>(
    open: &mut Vec<&Own<T>>,
    basis: &Basis<T>,
    u: &Vector<T, 3>,
    entities: &[Entity<T>],
) {
    let combination = basis.direction(u);
    let share = |place: usize| {
        let e = basis.entities[place];
        let coef = combination.iter().find(|(other, _)| *other == e).map(|(_, coef)| *coef);
        let v = match entities[e].kind {
            EntityKind::Point => entities[e].at - entities[basis.entities[0]].at,
            EntityKind::Direction => entities[e].at,
        };
        coef.map_or(T::ZERO, |coef| coef.norm_squared().sqrt() * norm(&v))
    };
    let weight = |own: &Own<T>| share(own.places[0]) * share(own.places[1]);
    let mut heaviest: Option<(usize, T)> = None;
    for (i, own) in open.iter().enumerate() {
        let w = weight(own);
        if heaviest.is_none_or(|(_, most)| w > most) {
            heaviest = Some((i, w));
        }
    }
    if let Some((i, w)) = heaviest
        && w > T::from_f64(WEIGHT)
    {
        open.remove(i);
    }
}

/// Order of the clusters: file order, but each one after the clusters that imply a row of it. File order also breaks circles.
fn order<T: Real>(own: &[Vec<Own<T>>], implied: &BTreeMap<(usize, Key), Vec<usize>>) -> Vec<usize> {
    let n = own.len();
    let (mut waits, mut waiting) = (vec![0_usize; n], vec![Vec::new(); n]);
    for ((c, _), by) in implied {
        for &b in by {
            waits[*c] += 1;
            waiting[b].push(*c);
        }
    }
    let mut ready: BTreeSet<usize> = (0..n).filter(|&c| waits[c] == 0).collect();
    let mut rest: BTreeSet<usize> = (0..n).collect();
    let mut order = Vec::with_capacity(n);
    while let Some(&c) = ready.first().or_else(|| rest.first()) {
        ready.remove(&c);
        rest.remove(&c);
        order.push(c);
        for &w in &waiting[c] {
            waits[w] -= 1;
            if waits[w] == 0 && rest.contains(&w) {
                ready.insert(w);
            }
        }
    }
    order
}

/// Maps each row of a cluster to the other clusters that imply it. These clusters have all entities of the row, and at least one of
/// the entities depends on their basis.
fn implied_by<T: Real>(
    bases: &[Basis<T>],
    shared: &[Vec<usize>],
    own: &[Vec<Own<T>>],
    zero: usize,
) -> BTreeMap<(usize, Key), Vec<usize>> {
    let mut dependent_in: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (c, basis) in bases.iter().enumerate() {
        for &e in shared[c].iter().filter(|e| !basis.entities.contains(e)) {
            dependent_in.entry(e).or_default().push(c);
        }
    }
    let has =
        |c: usize, e: usize| e == zero || bases[c].entities.contains(&e) || shared[c].contains(&e);
    let mut implied: BTreeMap<(usize, Key), Vec<usize>> = BTreeMap::new();
    for (c, rows) in own.iter().enumerate() {
        for Own { key, .. } in rows {
            let others = key.iter().filter_map(|e| dependent_in.get(e)).flatten();
            let by: BTreeSet<usize> =
                others.copied().filter(|&b| b != c && key.iter().all(|&e| has(b, e))).collect();
            if !by.is_empty() {
                implied.insert((c, *key), by.into_iter().collect());
            }
        }
    }
    implied
}

/// Rows of the constant lengths and angles of a basis.
fn rows_of<T: Real>(basis: &Basis<T>, entities: &[Entity<T>], zero: usize) -> Vec<Own<T>> {
    let mut rows = Vec::new();
    let origin = basis.entities[0];
    let others = &basis.entities[1..];
    let vector = |e: usize| match entities[e].kind {
        EntityKind::Point => (origin, entities[e].at - entities[origin].at),
        EntityKind::Direction => (zero, entities[e].at),
    };
    for (i, &e) in others.iter().enumerate() {
        let (from, v) = vector(e);
        let key = [from.min(e), from.max(e), zero, zero];
        let row = RowDraft::Distance { ends: [from, e], length: norm(&v) };
        rows.push(Own { key, row, places: [i + 1; 2] });
        for (j, &other) in others[..i].iter().enumerate() {
            let (from_other, w) = vector(other);
            let (one, two) = ([e, from], [other, from_other]);
            let (one, two) = if one <= two { (one, two) } else { (two, one) };
            let scale = T::ONE / (norm(&v) * norm(&w));
            let as_combination = |e: usize, from: usize| {
                let mut x = vec![(e, Coef::one())];
                if from != zero {
                    x.push((from, Coef::one().scaled(-T::ONE)));
                }
                x
            };
            let row = RowDraft::Dot {
                x: as_combination(e, from),
                y: as_combination(other, from_other),
                scale,
                constant: v.dot(&w) * scale,
            };
            let key = [one[0], one[1], two[0], two[1]];
            rows.push(Own { key, row, places: [i + 1, j + 1] });
        }
    }
    rows
}

//! Merging of the bodies and joints of a small mechanism into one element. A dense block whose size the compiler knows takes less
//! time than separate blocks.

use super::element::DENSE;
use super::row_builder::GroupDraft;
use super::sharing::Entity;
use crate::Real;
use crate::algebra::Coef;
use alloc::vec;
use alloc::vec::Vec;

/// Merges the groups of bodies and joints of a small mechanism. Groups of effects stay separate.
pub(super) fn merged<T: Real>(
    groups: Vec<GroupDraft<T>>,
    entities: &[Entity<T>],
    dimension: usize,
) -> Vec<GroupDraft<T>> {
    let mut unknown = Vec::new();
    for e in groups.iter().flat_map(|group| group.slots(entities)) {
        if !entities[e].is_constant && !unknown.contains(&e) {
            unknown.push(e);
        }
        if unknown.len() * dimension > DENSE {
            return groups;
        }
    }
    let (parts, others): (Vec<_>, Vec<_>) =
        groups.into_iter().partition(|group| group.effects.is_empty());
    let mut all: Vec<GroupDraft<T>> = Vec::with_capacity(1 + others.len());
    all.extend(parts.into_iter().reduce(joined));
    all.extend(others);
    all
}

/// Merges two groups into one.
fn joined<T: Real>(mut one: GroupDraft<T>, other: GroupDraft<T>) -> GroupDraft<T> {
    one.row_owners.resize(one.rows.len(), one.owner);
    let mut owners = other.row_owners;
    owners.resize(other.rows.len(), other.owner);
    one.row_owners.extend(owners);
    one.rows.extend(other.rows);
    one.forces.extend(other.forces);
    one.mass = match (one.mass, other.mass) {
        (Some(a), Some(b)) => Some(sum(&a, &b)),
        (a, b) => a.or(b),
    };
    one
}

/// Sum of two mass matrices, each over its list of entities.
fn sum<T: Real>(
    a: &(Vec<usize>, Vec<Coef<T>>),
    b: &(Vec<usize>, Vec<Coef<T>>),
) -> (Vec<usize>, Vec<Coef<T>>) {
    let mut basis = a.0.clone();
    basis.extend(b.0.iter().filter(|e| !a.0.contains(e)));
    let n = basis.len();
    let mut g = vec![Coef::zero(); n * n];
    for (part, coefs) in [a, b] {
        let place = |e: usize| basis.iter().position(|&other| other == e);
        for (i, &ei) in part.iter().enumerate() {
            for (j, &ej) in part.iter().enumerate() {
                if let (Some(row), Some(column)) = (place(ei), place(ej)) {
                    let entry = &mut g[row * n + column];
                    *entry = entry.plus(coefs[i * part.len() + j]);
                }
            }
        }
    }
    (basis, g)
}

//! Search for the smallest set of joints whose change makes all equations independent without any effect on the motion.
//!
//! ```text
//! a joint of another kind transmits W' ⊂ W;   C: the directions of W that it gives up
//! what is left of the null space:   { y : C N y = 0 }
//! mended without new freedoms  ⇔  C N has independent rows (each takes a redundancy) and as many as columns
//! ```
//!
//! Combinations of one, two and three joints are tried in the order of the scene. If more joints are needed, they are changed one after
//! another. Each time the change is chosen that removes most redundancies. The result is checked with the changed joints: the rank must be
//! the same, and all rows must be independent.

use super::Vector;
use super::decompose::{Group, ZERO, dimension};
use super::link::{Link, Poses};
use super::linkage::{Jacobian, Linkage};
use super::parts::Part;
use super::rank::Rank;
use mbs_core::outputs::Wrench;
use mbs_core::scene::{Axis, BodyId, Dimension, Freedom, Joint, JointKind};
use mbs_linear::Matrix;

/// Change of a joint to another kind.
#[derive(Debug, Clone, PartialEq)]
pub struct JointChange {
    /// Index of the joint.
    pub joint: usize,
    /// New kind of the joint; `Free` removes the joint.
    pub kind: JointKind,
    /// The second axis that a universal joint needs, in the reference configuration.
    pub axis: Option<[f64; 3]>,
}

/// Changes that make all equations of a set independent without any effect on the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Remedy {
    /// Changes of joints, at most one for each joint.
    pub changes: Vec<JointChange>,
    /// A body to remove, together with the joints in `changes`.
    pub body: Option<usize>,
    /// True if it is certain that no smaller number of joints suffices.
    pub is_smallest: bool,
}

/// A change of a joint, with its effect on the null space: one row for each direction that the new joint no longer transmits.
struct Choice {
    change: JointChange,
    link: Link,
    place: usize,
    taken: Vec<Vec<f64>>,
}

/// Largest number of combinations of joints that are tried, which limits the computing time. Chosen, not tuned.
const MOST_TRIED: usize = 200_000;

/// Searches for a remedy of a group of dependent joints at a position.
pub(crate) fn remedy(
    linkage: &Linkage,
    (part, at): (&Part, &Poses),
    (jacobian, null): (&Jacobian, &Matrix),
    group: &Group,
) -> Option<Remedy> {
    let mut options = Vec::new();
    for &place in &group.places {
        options.extend(options_of(linkage, (part, at), (jacobian, null), place));
    }
    let k = group.redundant;
    let verified = |chosen: Vec<usize>, is_smallest| {
        let found: Vec<&Choice> = chosen.into_iter().map(|i| &options[i]).collect();
        holds(linkage, (part, at), group, &found).then(|| Remedy {
            changes: found.iter().map(|o| o.change.clone()).collect(),
            body: None,
            is_smallest,
        })
    };
    search(&options, k)
        .and_then(|chosen| verified(chosen, true))
        .or_else(|| without_a_body(linkage, (part, at), group))
        .or_else(|| verified(greedy(&options, k)?, false))
}

/// Returns a body that can be removed with all its joints, for example the third crank of a parallelogram.
fn without_a_body(linkage: &Linkage, (part, at): (&Part, &Poses), group: &Group) -> Option<Remedy> {
    let links: Vec<(usize, &Link)> =
        group.places.iter().map(|&i| (part.joints[i], &linkage.links[part.joints[i]])).collect();
    let sizes = |links: &[&Link], bodies: &[usize]| {
        let part = Part { bodies: bodies.to_vec(), ..part.clone() };
        Rank::of(&linkage.jacobian_of(&part, links, at).matrix).map(|rank| rank.sizes)
    };
    let mut bodies: Vec<usize> =
        links.iter().flat_map(|(_, l)| l.joint.bodies).filter_map(index).collect();
    bodies.sort_unstable();
    bodies.dedup();
    let all: Vec<&Link> = links.iter().map(|(_, l)| *l).collect();
    let [_, n, rank] = sizes(&all, &bodies)?;
    for &body in bodies.iter().rev() {
        let touches = |link: &Link| link.joint.bodies.contains(&BodyId::Body(body));
        let is_inside = (0..linkage.links.len())
            .filter(|&j| touches(&linkage.links[j]))
            .all(|j| links.iter().any(|(joint, _)| *joint == j));
        let left: Vec<&Link> = all.iter().copied().filter(|link| !touches(link)).collect();
        let others: Vec<usize> = bodies.iter().copied().filter(|&b| b != body).collect();
        if !is_inside || left.is_empty() {
            continue;
        }
        let Some([rows, columns, after]) = sizes(&left, &others) else { continue };
        if rows == after && columns - after == n - rank {
            let joints = links.iter().filter(|(_, link)| touches(link));
            let change = |(joint, _): &(usize, &Link)| JointChange {
                joint: *joint,
                kind: JointKind::Free,
                axis: None,
            };
            return Some(Remedy {
                changes: joints.map(change).collect(),
                body: Some(body),
                is_smallest: false,
            });
        }
    }
    None
}

fn index(body: BodyId) -> Option<usize> {
    if let BodyId::Body(b) = body { Some(b) } else { None }
}

/// Returns the joint kinds that may replace a joint, in ascending order of their freedoms. They allow the joint's motions and more, about
/// the same axes. If a new kind needs a second axis of rotation, the axis is found later.
fn gentler(joint: &Joint<f64>, dimension: Dimension) -> Vec<JointKind> {
    let own = joint.kind.freedoms(dimension);
    let fits = |kind: &JointKind| {
        let freedoms = kind.freedoms(dimension);
        let lets = |freedom: &Freedom| match freedom {
            Freedom::Turn(_) => freedoms.contains(freedom) || freedoms.contains(&Freedom::Ball),
            Freedom::Slide(_) | Freedom::Ball => freedoms.contains(freedom),
        };
        let needed = kind.needs_axes(dimension);
        let is_found = takes_second_axis(*kind, dimension);
        let is_placed = (!needed[0] || joint.axes[0].is_some()) && (!needed[1] || is_found);
        let is_allowed = dimension == Dimension::Spatial || !kind.is_spatial_only();
        let is_joint = !joint.kind.is_link() && !kind.is_link();
        // a new kind must keep the joint's translation or its rotation: otherwise it would not be a similar joint
        let is_near = kind.translation(dimension) == joint.kind.translation(dimension)
            || kind.rotation(dimension) == joint.kind.rotation(dimension);
        let is_gentler = is_joint
            && is_near
            && kind.n_coordinates(dimension) > joint.kind.n_coordinates(dimension)
            && own.iter().all(lets);
        kind.is_free() || is_allowed && is_placed && is_gentler
    };
    let mut kinds: Vec<JointKind> = JointKind::ALL.into_iter().rev().filter(fits).collect();
    kinds.sort_by_key(|kind| kind.n_coordinates(dimension));
    kinds
}

/// True if the joint kind rotates about a second axis.
fn takes_second_axis(kind: JointKind, dimension: Dimension) -> bool {
    kind.freedoms(dimension).contains(&Freedom::Turn(Axis::Second))
}

fn options_of(
    linkage: &Linkage,
    (part, at): (&Part, &Poses),
    (jacobian, null): (&Jacobian, &Matrix),
    place: usize,
) -> Vec<Choice> {
    let index = part.joints[place];
    let link = &linkage.links[index];
    let rows = jacobian.rows[place].clone();
    let own = &jacobian.wrenches[rows.clone()];
    let mut options = Vec::new();
    for kind in gentler(&link.joint, linkage.dimension) {
        let axis = if takes_second_axis(kind, linkage.dimension) {
            let Some(axis) = open_moment(link, at, (own, rows.start), null) else { continue };
            Some(axis)
        } else {
            None
        };
        let mut joint = Joint { kind, ..link.joint.clone() };
        if axis.is_some() {
            joint.axes[1] = axis;
        }
        // A guided joint is not changed, because its guide needs the joint's coordinates.
        if link.is_guided {
            continue;
        }
        let new = Link::new(&joint, linkage.dimension, false);
        let kept = new.wrenches(at, part.length);
        let taken = given_up(linkage, part.length, own, &kept);
        let rows = taken.iter().map(|weights| {
            let entry =
                |j| weights.iter().enumerate().map(|(i, w)| w * null[(rows.start + i, j)]).sum();
            (0..null.n_columns()).map(entry).collect::<Vec<f64>>()
        });
        let taken: Vec<_> = rows.collect();
        // If the new joint no longer transmits a direction whose reaction is determined, the mechanism gains a freedom.
        if !taken.is_empty() && independent(&taken) {
            options.push(Choice {
                change: JointChange { joint: index, kind, axis },
                link: new,
                place,
                taken,
            });
        }
    }
    options
}

/// Returns the direction in which the joint's reaction moment is least determined, in the reference configuration.
fn open_moment(
    link: &Link,
    at: &Poses,
    (own, first): (&[Wrench<f64>], usize),
    null: &Matrix,
) -> Option<[f64; 3]> {
    let moment = |j| {
        let rows = own.iter().enumerate();
        rows.fold(Vector::zeros(), |m, (i, w)| m + w.moment * null[(first + i, j)])
    };
    let moments = (0..null.n_columns()).map(moment);
    let largest = moments.max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    let size = largest.norm();
    let turned = super::link::pose(at, link.joint.bodies[1]).rotation;
    (size > ZERO).then(|| (turned.transpose() * largest / size).into())
}

/// Returns an orthonormal basis of the directions in the span of `own` that are orthogonal to `kept`, as weights of `own`.
fn given_up(
    linkage: &Linkage,
    length: f64,
    own: &[Wrench<f64>],
    kept: &[Wrench<f64>],
) -> Vec<Vec<f64>> {
    let entries = |w: &Wrench<f64>| linkage.components(&w.force, &(w.moment / length));
    let own: Vec<[f64; 6]> = own.iter().map(entries).collect();
    // The directions of a joint are orthonormal, so that scalar products are the weights.
    let weights = |w: &Wrench<f64>| {
        let x = entries(w);
        own.iter().map(|o| o.iter().zip(&x).map(|(a, b)| a * b).sum()).collect::<Vec<f64>>()
    };
    let n = own.len();
    let kept: Vec<Vec<f64>> = kept.iter().map(weights).collect();
    let kept = Matrix::from_fn(n, kept.len(), |i, j| kept[j][i]);
    let Some(rank) = Rank::of(&kept) else { return Vec::new() };
    let rest = &rank.null;
    (0..rest.n_columns()).map(|j| (0..n).map(|i| rest[(i, j)]).collect()).collect()
}

fn stacked(rows: &[&Vec<f64>]) -> Matrix {
    Matrix::from_fn(rows.len(), rows.first().map_or(0, |r| r.len()), |i, j| rows[i][j])
}

fn independent(rows: &[Vec<f64>]) -> bool {
    dimension(&stacked(&rows.iter().collect::<Vec<_>>())) == rows.len()
}

/// Returns the first combination of one, two or three changes that removes all k redundancies.
fn search(options: &[Choice], k: usize) -> Option<Vec<usize>> {
    let mut tried = 0;
    for size in 1..=3 {
        let mut chosen = Vec::new();
        if let Some(found) = extend(options, (k, size), 0, &mut chosen, &mut tried) {
            return Some(found);
        }
        if tried >= MOST_TRIED {
            break;
        }
    }
    None
}

fn extend(
    options: &[Choice],
    (k, size): (usize, usize),
    from: usize,
    chosen: &mut Vec<usize>,
    tried: &mut usize,
) -> Option<Vec<usize>> {
    let rows: usize = chosen.iter().map(|&i| options[i].taken.len()).sum();
    if chosen.len() == size {
        *tried += 1;
        return (rows == k && takes(options, chosen) == k).then(|| chosen.clone());
    }
    for i in from..options.len() {
        let is_taken = chosen.iter().any(|&c| options[c].place == options[i].place);
        if is_taken || rows + options[i].taken.len() > k || *tried >= MOST_TRIED {
            continue;
        }
        chosen.push(i);
        let found = extend(options, (k, size), i + 1, chosen, tried);
        chosen.pop();
        if found.is_some() {
            return found;
        }
    }
    None
}

/// Returns the number of redundancies that several changes remove together.
fn takes(options: &[Choice], chosen: &[usize]) -> usize {
    let rows: Vec<&Vec<f64>> = chosen.iter().flat_map(|&i| &options[i].taken).collect();
    dimension(&stacked(&rows))
}

/// Adds changes one after another, each time the one that removes most redundancies and adds no freedom.
fn greedy(options: &[Choice], k: usize) -> Option<Vec<usize>> {
    let mut chosen = Vec::new();
    let mut taken = 0;
    while taken < k {
        let step = |i: &usize| options[*i].taken.len();
        let fits = |i: &usize| {
            let is_new = chosen.iter().all(|&c: &usize| options[c].place != options[*i].place);
            let with: Vec<usize> = chosen.iter().copied().chain([*i]).collect();
            is_new && takes(options, &with) == taken + step(i)
        };
        let best = (0..options.len()).filter(fits).max_by_key(|i| (step(i), usize::MAX - i))?;
        taken += options[best].taken.len();
        chosen.push(best);
    }
    Some(chosen)
}

/// Checks the changes by the rank over the joints of the group: the rank must be the same, and all rows must be independent.
fn holds(linkage: &Linkage, (part, at): (&Part, &Poses), group: &Group, found: &[&Choice]) -> bool {
    let rank = |changed: bool| {
        let link = |&place: &usize| {
            let change = found.iter().find(|o| changed && o.place == place);
            change.map_or(&linkage.links[part.joints[place]], |o| &o.link)
        };
        let links: Vec<&Link> = group.places.iter().map(link).collect();
        Rank::of(&linkage.jacobian_of(part, &links, at).matrix).map(|rank| rank.sizes)
    };
    match (rank(false), rank(true)) {
        (Some([_, _, before]), Some([rows, _, after])) => before == after && rows == after,
        _ => false,
    }
}

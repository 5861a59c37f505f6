//! Laws that depend on the inertia that a coordinate moves in the reference configuration: stops, and springs with a given time constant.
//!
//! The mass matrix of the tree is computed by the composite-body method (Featherstone). Its factor M = Lᵀ L follows the branches of the
//! tree and has no fill.

use super::model::{Model, Moves};
use super::passive;
use crate::inertia::Mass;
use crate::options::Stops;
use crate::pose::{M3, V3, direction, unit};
use crate::robot::{GROUND, Term, What};
use mbs_core::algebra::cross;
use std::cell::OnceCell;
use std::collections::HashMap;

/// Largest number of entries of the mass matrix [-]. For larger models the scene estimates the stops itself.
const MAX_ENTRIES: usize = 4_000_000;

/// A coordinate of the tree: its link, with the angular velocity and the velocity of the origin at a rate of one.
struct Column {
    link: usize,
    turn: V3,
    slide: V3,
    armature: f64,
    /// Index of the joint of the file.
    motion: usize,
}

/// Mass, first and second moment about the origin, of a link with its whole subtree.
#[derive(Clone, Copy)]
struct Composite {
    mass: f64,
    first: V3,
    second: M3,
}

/// Adds stops, and springs that are given by a time constant and a damping ratio.
pub(super) fn add(factor: &Lazy, model: &mut Model<'_, '_, '_>) {
    let is_needed =
        model.motions.iter().any(|motion| motion.stops.is_some() || motion.timed.is_some());
    if !is_needed {
        return;
    }
    let factor = factor.get_or_init(|| Factor::new(model)).as_ref();
    let moved = factor.map(|factor| factor.moved(model.motions.len()));
    for number in 0..model.motions.len() {
        let motion = model.motions[number].clone();
        if let Some([time, ratio]) = motion.timed {
            let inertia = moved.as_ref().map_or(0.0, |moved| moved[number]);
            let stiffness = inertia / (time * ratio).powi(2);
            let damping = 2.0 * inertia / time;
            let place = if model.posed.is_some() { "at the keyframe" } else { "as drawn" };
            let says = format!(
                "springdamper: stiffness {stiffness:e} and damping {damping:e} by the inertia {place}"
            );
            model.context.findings.approximated(motion.at, format!("joint[{}]", motion.name), says);
            let [mut spring, mut damper] = motion.strengths;
            // Coefficients of higher powers remain as in the file.
            (spring.0[0], damper.0[0]) = (stiffness, damping);
            let acts = model.compiler.acts;
            let strengths = [spring.where_it(acts.spring), damper.where_it(acts.damper)];
            passive::add(&motion, strengths, model);
        }
        let (Some(solref), Some(range)) = (motion.stops, motion.range) else { continue };
        let by_file = moved.as_ref().map(|moved| stop(solref, moved[number]));
        let stiffness = match model.context.options.limits {
            Some(Stops::Given { stiffness, damping }) => Some([stiffness, damping]),
            Some(Stops::ByMass) => None,
            None => by_file.filter(|[stiffness, _]| *stiffness > 0.0 && stiffness.is_finite()),
        };
        let says = "a soft constraint there; here a stop with stiffness and damping by solreflimit and the moved inertia";
        model.context.findings.approximated(
            motion.at,
            format!("joint[{}]@range", motion.name),
            says,
        );
        let on = motion.target();
        let what = match (stiffness, motion.number) {
            (Some([stiffness, damping]), Some(_)) => {
                let [lower, upper] = motion.ends(range);
                What::Limit { on, lower, upper, stiffness, damping }
            }
            (None, Some(_)) => continue,
            (stiffness, None) => What::RangeLimit { on, stiffness },
        };
        model.law(&format!("{} stops", motion.name), what);
    }
}

/// Stiffness and damping of a stop. Positive parameters are a time constant and a damping ratio; negative ones are stiffness and damping
/// per unit of inertia.
pub(super) fn stop([first, second]: [f64; 2], inertia: f64) -> [f64; 2] {
    if first > 0.0 {
        [inertia / (first * second).powi(2), 2.0 * inertia / first]
    } else {
        [-first * inertia, -second * inertia]
    }
}

/// The columns of all coordinates of the file, in the order of its joints.
fn columns(model: &Model<'_, '_, '_>) -> Vec<Column> {
    let mut columns = Vec::new();
    for (number, motion) in model.motions.iter().enumerate() {
        let joint = &model.robot.joints[motion.joint];
        let turn = |axis: V3| (axis, cross(&joint.place, &axis));
        let slide = |axis: V3| (V3::zeros(), axis);
        let all = match motion.moves {
            Moves::Hinge => vec![turn(motion.axis)],
            Moves::Slide => vec![slide(motion.axis)],
            Moves::Ball => (0..3).map(|i| turn(unit(i))).collect(),
            Moves::Free => {
                (0..3).map(|i| slide(unit(i))).chain((0..3).map(|i| turn(unit(i)))).collect()
            }
        };
        columns.extend(all.into_iter().map(|(turn, slide)| Column {
            link: joint.child,
            turn,
            slide,
            armature: motion.armature,
            motion: number,
        }));
    }
    columns
}

/// A factor of the mass matrix that is computed at its first use.
pub(super) type Lazy = OnceCell<Option<Factor>>;

/// The factor of the mass matrix in the reference configuration.
pub(super) struct Factor {
    tree: Chains,
    /// Row i of L, with an entry for each of the coordinates `tree.chains[i]`.
    rows: Vec<Vec<f64>>,
    /// Column of each coordinate of the scene that is a hinge or a slide.
    of: HashMap<(usize, Option<usize>), usize>,
}

impl Factor {
    /// Computes the factor; `None` when a coordinate moves no mass or the model is too large.
    pub(super) fn new(model: &Model<'_, '_, '_>) -> Option<Self> {
        let (tree, rows) = matrix(model)?;
        let rows = factored(rows, &tree.chains)?;
        let of = tree.columns.iter().enumerate().map(|(number, column)| {
            let motion = &model.motions[column.motion];
            ((motion.joint, motion.number), number)
        });
        Some(Self { of: of.collect(), rows, tree })
    }

    /// Inertia that each joint of the file moves while the other coordinates are free. It is the reciprocal of the diagonal of M⁻¹, or of
    /// the mean of that diagonal when the joint has several coordinates.
    fn moved(&self, motions: usize) -> Vec<f64> {
        let mut found = vec![(0.0, 0.0); motions];
        for (number, column) in self.tree.columns.iter().enumerate() {
            let (count, softness) = &mut found[column.motion];
            *count += 1.0;
            *softness += self.softness(&[(number, 1.0)]);
        }
        found.into_iter().map(|(count, softness)| count / softness).collect()
    }

    /// Inertia that a sum of coordinates moves, 1 / (J M⁻¹ Jᵀ); `None` when it moves no mass.
    pub(super) fn moved_by(&self, terms: &[Term]) -> Option<f64> {
        let mut entries = Vec::new();
        for term in terms.iter().filter(|term| term.line.is_empty()) {
            entries.push((*self.of.get(&(term.of.joint, term.of.number))?, term.factor));
        }
        for term in terms {
            for ends in term.line.windows(2) {
                let [(first, from), (second, to)] = [ends[0], ends[1]];
                let Some(along) = direction(&(to - from)) else { continue };
                for (link, place, along) in [(first, from, -along), (second, to, along)] {
                    let chain = self.tree.end[link].map_or(&[][..], |end| &self.tree.chains[end]);
                    entries.extend(chain.iter().map(|number| {
                        let Column { turn, slide, .. } = &self.tree.columns[*number];
                        (*number, term.factor * along.dot(&(slide + cross(turn, &place))))
                    }));
                }
            }
        }
        Some(1.0 / self.softness(&entries)).filter(|moved| moved.is_finite())
    }

    /// Computes J M⁻¹ Jᵀ = ‖L⁻ᵀ Jᵀ‖² from the entries of the row J.
    fn softness(&self, entries: &[(usize, f64)]) -> f64 {
        let chains = &self.tree.chains;
        let mut order: Vec<usize> =
            entries.iter().flat_map(|(number, _)| chains[*number].iter().copied()).collect();
        order.sort_unstable();
        order.dedup();
        // The list has all ancestors of each coordinate in it.
        let place = |number: usize| order.binary_search(&number).unwrap_or_default();
        let mut y = vec![0.0; order.len()];
        for (number, factor) in entries {
            y[place(*number)] += factor;
        }
        for (i, number) in order.iter().enumerate().rev() {
            let row = &self.rows[*number];
            y[i] /= row[row.len() - 1];
            for (k, x) in chains[*number].iter().zip(&row[..row.len() - 1]) {
                y[place(*k)] -= x * y[i];
            }
        }
        y.iter().map(|y| y * y).sum()
    }
}

/// The coordinates of a tree, with the chains that lead to them.
struct Chains {
    columns: Vec<Column>,
    /// Coordinates on the way from the ground to each coordinate, which is the last of its chain.
    chains: Vec<Vec<usize>>,
    /// Last coordinate on the way from the ground to each link, if there is one.
    end: Vec<Option<usize>>,
}

/// The mass matrix of the tree. Row i has the entries of the coordinates in the chain of coordinate i, which is the last of them.
fn matrix(model: &Model<'_, '_, '_>) -> Option<(Chains, Vec<Vec<f64>>)> {
    let robot = &model.robot;
    let mut parent = vec![GROUND; robot.links.len()];
    // A link comes after its parent, since joints were added from the ground outwards. Later joints of the same child close loops.
    let mut is_joined = vec![false; robot.links.len()];
    is_joined[GROUND] = true;
    let mut order = Vec::new();
    for joint in &robot.joints {
        if !std::mem::replace(&mut is_joined[joint.child], true) {
            parent[joint.child] = joint.parent;
            order.push(joint.child);
        }
    }
    let mut composites: Vec<_> = robot.links.iter().map(|link| own(link.mass.as_ref())).collect();
    for link in order.iter().rev() {
        let own = composites[*link];
        let sum = &mut composites[parent[*link]];
        sum.mass += own.mass;
        sum.first += own.first;
        sum.second += own.second;
    }
    let columns = columns(model);
    let mut of_link = vec![Vec::new(); robot.links.len()];
    for (number, column) in columns.iter().enumerate() {
        of_link[column.link].push(number);
    }
    // Each chain has the coordinates from the ground to the link, with those of the link itself.
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(columns.len());
    let mut chains: Vec<Vec<usize>> = Vec::with_capacity(columns.len());
    let mut entries = 0;
    for (number, column) in columns.iter().enumerate() {
        let mut chain: Vec<usize> = Vec::new();
        let mut link = column.link;
        while link != GROUND {
            chain.extend(of_link[link].iter().rev().filter(|of| **of <= number));
            link = parent[link];
        }
        chain.reverse();
        entries += chain.len();
        if entries > MAX_ENTRIES {
            return None;
        }
        let body = composites[column.link];
        // Linear and angular momentum of all links that the coordinate moves.
        let p = column.slide * body.mass + cross(&column.turn, &body.first);
        let l = body.second * column.turn + cross(&body.first, &column.slide);
        let mut row: Vec<f64> = chain
            .iter()
            .map(|of: &usize| columns[*of].turn.dot(&l) + columns[*of].slide.dot(&p))
            .collect();
        *row.last_mut()? += column.armature;
        rows.push(row);
        chains.push(chain);
    }
    let mut end = vec![None; robot.links.len()];
    for link in order {
        end[link] = of_link[link].last().copied().or(end[parent[link]]);
    }
    Some((Chains { columns, chains, end }, rows))
}

fn own(mass: Option<&Mass>) -> Composite {
    let none = Mass::none();
    let mass = mass.unwrap_or(&none);
    let second = mass.about(&V3::zeros());
    Composite { mass: mass.mass, first: mass.center * mass.mass, second }
}

/// Factors M = Lᵀ L along the branches of the tree; returns the rows of L.
fn factored(mut rows: Vec<Vec<f64>>, chains: &[Vec<usize>]) -> Option<Vec<Vec<f64>>> {
    for k in (0..rows.len()).rev() {
        let row = std::mem::take(&mut rows[k]);
        let last = row.len() - 1;
        let pivot = row[last].sqrt();
        if !(pivot > 0.0 && pivot.is_finite()) {
            return None;
        }
        let mut scaled: Vec<_> = row[..last].iter().map(|x| x / pivot).collect();
        for (place, i) in chains[k][..last].iter().enumerate() {
            for (entry, x) in rows[*i].iter_mut().zip(&scaled) {
                *entry -= scaled[place] * x;
            }
        }
        scaled.push(pivot);
        rows[k] = scaled;
    }
    Some(rows)
}

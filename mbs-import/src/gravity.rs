//! Separates links with different factors of gravity. Such links cannot be parts of one body, so a weld joint of the scene connects them.

use crate::robot::{GROUND, Kind, Link, Robot};
use std::collections::HashSet;

/// Turns every fixed joint between moving links with different factors of gravity into a weld joint. Links without mass may have any
/// factor.
pub(crate) fn part(robot: &mut Robot) {
    let carriers = robot.carriers(|joint| joint.kind == Kind::Fixed);
    let mut factors: Vec<Option<f64>> = robot.links.iter().map(factor).collect();
    if factors.iter().flatten().all(|factor| is_same(*factor, 1.0)) {
        return;
    }
    let mut groups: Vec<usize> = (0..robot.links.len()).collect();
    let mut names: HashSet<String> = HashSet::new();
    for joint in &mut robot.joints {
        let is_held = carriers[joint.parent] == GROUND;
        if joint.kind != Kind::Fixed || is_held {
            names.insert(joint.name.clone());
            continue;
        }
        let [one, other] = [groups[joint.parent], groups[joint.child]];
        if let (Some(x), Some(y)) = (factors[one], factors[other])
            && !is_same(x, y)
        {
            joint.kind = Kind::Weld;
            while !names.insert(joint.name.clone()) {
                joint.name += " weld";
            }
            continue;
        }
        factors[one] = factors[one].or(factors[other]);
        groups.iter_mut().filter(|group| **group == other).for_each(|group| *group = one);
    }
}

/// The factor of gravity of a link; `None` for a link without mass.
fn factor(link: &Link) -> Option<f64> {
    link.mass.is_some_and(|mass| mass.mass > 0.0).then_some(link.gravity_scale)
}

/// True if the bits of two factors are equal.
pub(crate) fn is_same(x: f64, y: f64) -> bool {
    x.to_bits() == y.to_bits()
}

//! Links on which gravity acts by different factors are different bodies: those that are welded get a weld of the scene.

use crate::robot::{GROUND, Kind, Link, Robot};
use std::collections::HashSet;

/// Makes a weld of every fixed joint between moving links whose factors of gravity differ. Links without mass take any factor.
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

/// The factor of a link, where it has mass.
fn factor(link: &Link) -> Option<f64> {
    link.mass.is_some_and(|mass| mass.mass > 0.0).then_some(link.gravity_scale)
}

/// Are two factors the same number?
pub(crate) fn is_same(x: f64, y: f64) -> bool {
    x.to_bits() == y.to_bits()
}

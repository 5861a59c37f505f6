//! The order in which joints are solved: a body held by one unsolved joint gives that joint's wrench; the rest
//! is loops and coupled joints, solved group by group.

use crate::scene::BodyId;
use alloc::vec;
use alloc::vec::Vec;

/// Bodies whose balance gives the wrenches of some joints and the efforts of some couplings.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Block {
    pub(super) bodies: Vec<usize>,
    pub(super) joints: Vec<usize>,
    pub(super) couplings: Vec<usize>,
}

/// Orders the joints (pairs of bodies; those that carry nothing are `None`) and the couplings (the bodies that each acts on) into blocks.
/// No body gives the effort of a coupling alone: it may act on another one only.
///
/// Cost: proportional to bodies, joints and couplings.
pub(super) fn eliminate_leaves<'a>(
    n_bodies: usize,
    joints: &[Option<[BodyId; 2]>],
    couplings: impl IntoIterator<Item = &'a [usize]>,
) -> Vec<Block> {
    let mut ends: Vec<Vec<usize>> = joints.iter().map(|pair| moving(*pair).collect()).collect();
    ends.extend(couplings.into_iter().map(<[usize]>::to_vec));
    let mut at_body = vec![Vec::new(); n_bodies];
    for (i, ends) in ends.iter().enumerate() {
        for &body in ends {
            at_body[body].push(i);
        }
    }
    let is_empty = |i: usize| joints.get(i).is_some_and(Option::is_none);
    let mut is_solved: Vec<bool> = (0..ends.len()).map(is_empty).collect();
    let mut blocks = Vec::new();
    let mut degree: Vec<usize> = at_body.iter().map(Vec::len).collect();
    let mut leaves: Vec<usize> = (0..n_bodies).filter(|&b| degree[b] == 1).collect();
    while let Some(body) = leaves.pop() {
        let Some(&joint) = at_body[body].iter().find(|&&j| !is_solved[j]) else { continue };
        if joint >= joints.len() {
            continue;
        }
        is_solved[joint] = true;
        blocks.push(Block { bodies: vec![body], joints: vec![joint], couplings: Vec::new() });
        for &other in &ends[joint] {
            degree[other] -= 1;
            if degree[other] == 1 {
                leaves.push(other);
            }
        }
    }
    for seed in 0..ends.len() {
        if !is_solved[seed] {
            let mut block = loops(seed, &ends, &at_body, &mut is_solved);
            let first = block.joints.partition_point(|&i| i < joints.len());
            block.couplings = block.joints.split_off(first);
            block.couplings.iter_mut().for_each(|i| *i -= joints.len());
            blocks.push(block);
        }
    }
    blocks
}

/// Everything unsolved that hangs together with one joint or coupling through moving bodies; couplings are numbered after the joints.
fn loops(
    seed: usize,
    ends: &[Vec<usize>],
    at_body: &[Vec<usize>],
    is_solved: &mut [bool],
) -> Block {
    let mut block = Block { joints: vec![seed], ..Block::default() };
    is_solved[seed] = true;
    let mut next = 0;
    while let Some(&joint) = block.joints.get(next) {
        next += 1;
        for &body in &ends[joint] {
            block.bodies.push(body);
            for &j in &at_body[body] {
                if !is_solved[j] {
                    is_solved[j] = true;
                    block.joints.push(j);
                }
            }
        }
    }
    block.bodies.sort_unstable();
    block.bodies.dedup();
    block.joints.sort_unstable();
    block
}

/// The bodies of a pair that move.
fn moving(pair: Option<[BodyId; 2]>) -> impl Iterator<Item = usize> {
    pair.into_iter().flatten().filter_map(BodyId::index)
}

#[cfg(test)]
mod tests {
    use super::*;
    use BodyId::{Body, Ground};

    #[test]
    fn a_chain_is_peeled_from_its_end_and_a_loop_stays_together() {
        // 0 - 1 - 2 hang on the ground; 3, 4 close a loop through the ground, 5 hangs on 4
        let joints = [
            Some([Ground, Body(0)]),
            Some([Body(0), Body(1)]),
            Some([Body(2), Body(1)]),
            Some([Ground, Body(3)]),
            Some([Body(3), Body(4)]),
            Some([Body(4), Ground]),
            Some([Body(4), Body(5)]),
            None,
        ];
        let blocks = eliminate_leaves(6, &joints, []);
        let single =
            |body, joint| Block { bodies: vec![body], joints: vec![joint], couplings: Vec::new() };
        let expected = [
            single(5, 6),
            single(2, 2),
            single(1, 1),
            single(0, 0),
            Block { bodies: vec![3, 4], joints: vec![3, 4, 5], couplings: Vec::new() },
        ];
        assert_eq!(blocks, expected);
    }

    #[test]
    fn what_a_coupling_acts_on_is_solved_together_and_what_hangs_on_it_before() {
        // 0 and 1 hang on the ground and are coupled, 2 hangs on 1; 3 has a coupling alone, with the ground
        let joints =
            [Some([Ground, Body(0)]), Some([Ground, Body(1)]), Some([Body(1), Body(2)]), None];
        let couplings = [&[0, 1][..], &[3]];
        let blocks = eliminate_leaves(4, &joints, couplings);
        let expected = [
            Block { bodies: vec![2], joints: vec![2], couplings: Vec::new() },
            Block { bodies: vec![0, 1], joints: vec![0, 1], couplings: vec![0] },
            Block { bodies: vec![3], joints: Vec::new(), couplings: vec![1] },
        ];
        assert_eq!(blocks, expected);
    }
}

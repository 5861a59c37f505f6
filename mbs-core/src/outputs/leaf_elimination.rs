//! The order in which joints are solved: a body held by one unsolved joint gives that joint's wrench; the rest
//! is loops, solved group by group.

use crate::scene::BodyId;
use alloc::vec;
use alloc::vec::Vec;

/// Bodies whose balance gives the wrenches of some joints.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Block {
    pub(super) bodies: Vec<usize>,
    pub(super) joints: Vec<usize>,
}

/// Orders the joints (pairs of bodies; those that carry nothing are `None`) into blocks.
///
/// Cost: proportional to bodies and joints.
pub(super) fn eliminate_leaves(n_bodies: usize, joints: &[Option<[BodyId; 2]>]) -> Vec<Block> {
    let mut at_body = vec![Vec::new(); n_bodies];
    for (j, pair) in joints.iter().enumerate() {
        for body in ends(*pair) {
            at_body[body].push(j);
        }
    }
    let mut is_solved: Vec<bool> = joints.iter().map(Option::is_none).collect();
    let mut blocks = Vec::new();
    let mut degree: Vec<usize> = at_body.iter().map(Vec::len).collect();
    let mut leaves: Vec<usize> = (0..n_bodies).filter(|&b| degree[b] == 1).collect();
    while let Some(body) = leaves.pop() {
        let Some(&joint) = at_body[body].iter().find(|&&j| !is_solved[j]) else { continue };
        is_solved[joint] = true;
        blocks.push(Block { bodies: vec![body], joints: vec![joint] });
        for other in ends(joints[joint]) {
            degree[other] -= 1;
            if degree[other] == 1 {
                leaves.push(other);
            }
        }
    }
    for seed in 0..joints.len() {
        if !is_solved[seed] {
            blocks.push(loops(seed, joints, &at_body, &mut is_solved));
        }
    }
    blocks
}

/// Everything unsolved that hangs together with one joint through moving bodies.
fn loops(
    seed: usize,
    joints: &[Option<[BodyId; 2]>],
    at_body: &[Vec<usize>],
    is_solved: &mut [bool],
) -> Block {
    let mut block = Block { bodies: Vec::new(), joints: vec![seed] };
    is_solved[seed] = true;
    let mut next = 0;
    while let Some(&joint) = block.joints.get(next) {
        next += 1;
        for body in ends(joints[joint]) {
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
fn ends(pair: Option<[BodyId; 2]>) -> impl Iterator<Item = usize> {
    pair.into_iter().flatten().filter_map(|body| match body {
        BodyId::Ground => None,
        BodyId::Body(i) => Some(i),
    })
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
        let blocks = eliminate_leaves(6, &joints);
        let single = |body, joint| Block { bodies: vec![body], joints: vec![joint] };
        let expected = [
            single(5, 6),
            single(2, 2),
            single(1, 1),
            single(0, 0),
            Block { bodies: vec![3, 4], joints: vec![3, 4, 5] },
        ];
        assert_eq!(blocks, expected);
    }
}

//! Order in which the wrenches of joints are computed. The equilibrium of a body with one unknown joint gives the wrench of that joint. The
//! remaining loops and coupled joints are solved group by group.

use crate::scene::BodyId;
use alloc::vec;
use alloc::vec::Vec;

/// Block of bodies whose equilibrium gives the wrenches of some joints and the efforts of some couplings.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Block {
    /// Indices of the bodies of the block.
    pub bodies: Vec<usize>,
    /// Indices of the joints of the block.
    pub joints: Vec<usize>,
    /// Indices of the couplings of the block.
    pub couplings: Vec<usize>,
}

/// Orders joints and couplings into blocks. A joint is a pair of bodies, or `None` if it transmits nothing. A coupling is the list of
/// bodies on which it acts. A coupling is never solved from the equilibrium of a single body, since its effort may have no effect on that
/// body.
///
/// Cost: proportional to bodies, joints and couplings.
pub fn eliminate_leaves<'a>(
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

/// Block of all unsolved joints and couplings that are connected with `seed` through moving bodies. The indices of couplings follow the
/// indices of joints.
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

/// The moving bodies of a pair.
fn moving(pair: Option<[BodyId; 2]>) -> impl Iterator<Item = usize> {
    pair.into_iter().flatten().filter_map(BodyId::index)
}

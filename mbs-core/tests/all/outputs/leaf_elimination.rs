//! Order in which reactions are computed, by elimination of leaves.

use mbs_core::inside::outputs::{Block, eliminate_leaves};
use mbs_core::scene::BodyId::{Body, Ground};

#[test]
fn a_chain_is_peeled_from_its_end_and_a_loop_stays_together() {
    // bodies 0 - 1 - 2 form a chain on the ground; 3 and 4 form a loop with the ground; 5 is on 4
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
    // bodies 0 and 1 are on the ground and coupled, 2 is on 1; 3 has only a coupling with the ground
    let joints = [Some([Ground, Body(0)]), Some([Ground, Body(1)]), Some([Body(1), Body(2)]), None];
    let couplings = [&[0, 1][..], &[3]];
    let blocks = eliminate_leaves(4, &joints, couplings);
    let expected = [
        Block { bodies: vec![2], joints: vec![2], couplings: Vec::new() },
        Block { bodies: vec![0, 1], joints: vec![0, 1], couplings: vec![0] },
        Block { bodies: vec![3], joints: Vec::new(), couplings: vec![1] },
    ];
    assert_eq!(blocks, expected);
}

//! Displacement of the stack between timings.

use mbs_study::inside::compare::{LEVELS, moved};
use std::hint::black_box;

#[test]
fn each_turn_finds_the_stack_elsewhere() {
    let place = |turn| {
        moved(turn, || {
            let local = black_box(0_u8);
            std::ptr::from_ref(&local).addr()
        })
    };
    let places: std::collections::BTreeSet<usize> = (0..LEVELS).map(place).collect();
    assert_eq!(places.len(), LEVELS as usize);
}

//! Ranks that noise does not change: who is faster than whom by more than it can be.

use super::data::Rank;

/// Ratio up to which times share the rank of the fastest [-]. The place of a computation in memory, and other work, change the least of
/// many times by one or two per cent. Of the factors that distinguish methods this one leaves few at its edge.
pub const APART: f64 = 1.5;

/// Gives ranks to methods with their least times. A rank ends where a time is more than `APART` times that of its fastest, and more
/// than what lies between the two least times of the fastest.
///
/// Noise that makes each time longer by a share of at most e moves every quotient of two times by a factor of at most 1 + e. So the
/// ranks are those without noise wherever no quotient of a time to the fastest of the rank before lies so near the factor.
pub fn rank(mut methods: Vec<Rank>) -> Vec<Rank> {
    let order: Vec<String> = methods.iter().map(|m| m.name.clone()).collect();
    methods.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    // up to here reaches the rank
    let mut reach = 0.0_f64;
    let mut rank = 1;
    for i in 0..methods.len() {
        if methods[i].seconds > reach {
            rank = i + 1;
            reach = methods[i].seconds * APART.max(1.0 + methods[i].noise);
        }
        methods[i].rank = rank;
    }
    let place = |m: &Rank| (m.rank, order.iter().position(|name| *name == m.name));
    methods.sort_by_key(place);
    methods
}

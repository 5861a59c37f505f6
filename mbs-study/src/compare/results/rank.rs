//! Ranks of methods that the noise of the times does not change.

use super::data::Rank;

/// Ratio to the fastest time up to which methods have the same rank [-]. The placement in memory and other processes change the shortest of
/// many times by one or two per cent. With this factor, few methods are so close to the limit of a rank that noise decides.
pub const APART: f64 = 1.5;

/// Ranks methods by their shortest times. The fastest method of a rank sets its limit: `APART` times its shortest time, or its second
/// shortest time if that is longer. A method with a longer time begins the next rank.
///
/// Noise may make each time longer by a fraction of at most e. A quotient of two times then changes by a factor of at most 1 + e. The ranks
/// then are those without noise, unless a quotient is within this factor of `APART`.
pub fn rank(mut methods: Vec<Rank>) -> Vec<Rank> {
    let order: Vec<String> = methods.iter().map(|m| m.name.clone()).collect();
    methods.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    // largest time that has this rank
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

//! Ranks that noise does not change: who is faster than whom by more than it can be.

use super::data::Rank;

/// A method is faster than the next only if it takes less than 1/1.25 of its time.
pub(super) const APART: f64 = 1.25;

/// Gives ranks to methods with their least times; those between which no gap is found are equal. What stands between two groups
/// is a factor of at least [`APART`] between neighbours, and more than what lies between the two least times of the faster one.
///
/// If noise makes each time longer by a share of at most e, the ranks are those without noise wherever no two neighbours differ
/// by a factor between `APART` / (1 + e) and `APART` (1 + e): a gap of more than the second stays one, a gap of less than the
/// first does not become one. Times that exceed each other by less change places only within their rank.
pub(super) fn rank(mut methods: Vec<Rank>) -> Vec<Rank> {
    let order: Vec<String> = methods.iter().map(|m| m.name.clone()).collect();
    methods.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    // the slowest time that a method before may well have
    let mut reach = 0.0_f64;
    let mut rank = 1;
    for i in 0..methods.len() {
        let before = i.checked_sub(1).map(|j| methods[j].seconds);
        if before.is_some_and(|before| methods[i].seconds > (before * APART).max(reach)) {
            rank = i + 1;
        }
        methods[i].rank = rank;
        reach = reach.max(methods[i].seconds * (1.0 + methods[i].noise));
    }
    let place = |m: &Rank| (m.rank, order.iter().position(|name| *name == m.name));
    methods.sort_by_key(place);
    methods
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn of(times: &[f64], noise: f64) -> Vec<Rank> {
        let method = |(i, &seconds): (usize, &f64)| Rank {
            name: format!("m{i}"),
            seconds,
            noise,
            ..Rank::default()
        };
        rank(times.iter().enumerate().map(method).collect())
    }

    fn printed(ranks: &[Rank]) -> Vec<(usize, &str)> {
        ranks.iter().map(|r| (r.rank, r.name.as_str())).collect()
    }

    #[test]
    fn methods_within_the_noise_are_equal_and_keep_the_order_of_the_list() {
        let ranks = of(&[3.0, 1.1, 1.0, 1.2, 3.9], 0.01);
        assert_eq!(printed(&ranks), [(1, "m1"), (1, "m2"), (1, "m3"), (4, "m0"), (5, "m4")]);
    }

    #[test]
    fn a_gap_that_the_repeats_do_not_show_is_none() {
        assert_eq!(printed(&of(&[1.0, 2.0], 1.5)), [(1, "m0"), (1, "m1")]);
        assert_eq!(printed(&of(&[1.0, 2.0], 0.5)), [(1, "m0"), (2, "m1")]);
    }

    proptest! {
        #[test]
        fn two_measurements_with_other_noise_give_the_same_ranking(
            gaps in prop::collection::vec((0.0..1.0_f64, any::<bool>()), 1..12),
            noise in prop::collection::vec((0.0..0.08_f64, 0.0..0.08_f64), 12),
        ) {
            // neighbours differ by less than APART/1.08, or by more than APART*1.08
            let (low, high) = (f64::ln(APART / 1.08), f64::ln(APART * 1.08));
            let mut log = 0.0;
            let mut times = vec![1.0];
            for (share, is_wide) in gaps {
                log += if is_wide { high * 1.0001 + share } else { low * 0.9999 * share };
                times.push(f64::exp(log));
            }
            let measured = |pick: fn(&(f64, f64)) -> f64| -> Vec<f64> {
                times.iter().zip(&noise).map(|(t, n)| t * (1.0 + pick(n))).collect()
            };
            let (first, second) = (of(&measured(|n| n.0), 0.08), of(&measured(|n| n.1), 0.08));
            prop_assert_eq!(printed(&first), printed(&second));
            let exact = of(&times, 0.0);
            prop_assert_eq!(printed(&first), printed(&exact));
        }

        #[test]
        fn ranks_count_those_that_are_faster(times in prop::collection::vec(0.1..10.0_f64, 1..12)) {
            for r in of(&times, 0.02) {
                prop_assert!(r.rank >= 1 && r.rank <= times.len());
                let faster = times.iter().filter(|&&t| t * APART < r.seconds).count();
                prop_assert!(r.rank <= faster + 1, "{} of {:?}", r.name, times);
            }
        }
    }
}

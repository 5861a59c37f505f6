//! Ranks that noise does not change: who is faster than whom by more than it can be.

use super::data::Rank;

/// Between these factors lies the one by which neighbours must differ to have different ranks.
const APART: [f64; 2] = [1.3, 2.0];

/// The factor by which neighbours must differ: of those from 1.3 to 2 the one that is furthest from all that occur, so that noise
/// turns no gap into none.
pub(super) fn apart(times: impl Iterator<Item = f64>) -> f64 {
    let mut times: Vec<f64> = times.map(libm::log).collect();
    times.sort_by(f64::total_cmp);
    let [low, high] = APART.map(libm::log);
    let mut gaps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    gaps.retain(|gap| *gap > low && *gap < high);
    gaps.extend([low, high]);
    gaps.sort_by(f64::total_cmp);
    let widest = gaps.windows(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
    libm::exp(widest.map_or(low, |pair| 0.5 * (pair[0] + pair[1])))
}

/// Gives ranks to methods with their least times; those between which no gap is found are equal. A gap is a factor of more than
/// `apart` between neighbours, and more than what lies between the two least times of the faster one.
///
/// Noise that makes each time longer by a share of at most e moves the logarithm of every gap by log(1 + e) at most. So the ranks are
/// those without noise wherever, of the stretches between the gaps from 1.3 to 2, the widest is wider than the second by 4 log(1 + e),
/// and the noise is less than the factor itself: that stretch stays the widest, no gap crosses its middle, and times that exceed each other
/// by less change places only within their rank.
pub(super) fn rank(mut methods: Vec<Rank>, apart: f64) -> Vec<Rank> {
    let order: Vec<String> = methods.iter().map(|m| m.name.clone()).collect();
    methods.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    // the slowest time that a method before may well have
    let mut reach = 0.0_f64;
    let mut rank = 1;
    for i in 0..methods.len() {
        let before = i.checked_sub(1).map(|j| methods[j].seconds);
        if before.is_some_and(|before| methods[i].seconds > (before * apart).max(reach)) {
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
        rank(times.iter().enumerate().map(method).collect(), apart(times.iter().copied()))
    }

    fn printed(ranks: &[Rank]) -> Vec<(usize, &str)> {
        ranks.iter().map(|r| (r.rank, r.name.as_str())).collect()
    }

    #[test]
    fn methods_within_the_noise_are_equal_and_keep_the_order_of_the_list() {
        let ranks = of(&[3.0, 1.1, 1.0, 1.2, 7.0], 0.01);
        assert_eq!(printed(&ranks), [(1, "m1"), (1, "m2"), (1, "m3"), (4, "m0"), (5, "m4")]);
    }

    #[test]
    fn the_factor_lies_where_no_gap_is_near() {
        let factor = |times: &[f64]| apart(times.iter().copied());
        assert!((factor(&[1.0, 5.0]) - f64::sqrt(1.3 * 2.0)).abs() < 1e-12);
        assert!((factor(&[9.0, 1.0, 1.8]) - f64::sqrt(1.3 * 1.8)).abs() < 1e-12);
        assert!((factor(&[1.0, 1.4, 1.4 * 1.5]) - f64::sqrt(1.5 * 2.0)).abs() < 1e-12);
    }

    #[test]
    fn a_gap_that_the_repeats_do_not_show_is_none() {
        assert_eq!(printed(&of(&[1.0, 3.0], 2.5)), [(1, "m0"), (1, "m1")]);
        assert_eq!(printed(&of(&[1.0, 3.0], 0.5)), [(1, "m0"), (2, "m1")]);
    }

    /// Is the widest of the stretches between the gaps wider than the second by this, in logarithms?
    fn is_clear(times: &[f64], by: f64) -> bool {
        let [low, high] = APART.map(f64::ln);
        let mut gaps: Vec<f64> = times.windows(2).map(|t| f64::ln(t[1] / t[0])).collect();
        gaps.retain(|gap| (low..high).contains(gap));
        gaps.extend([low, high]);
        gaps.sort_by(f64::total_cmp);
        let mut widths: Vec<f64> = gaps.windows(2).map(|pair| pair[1] - pair[0]).collect();
        widths.sort_by(|a, b| b.total_cmp(a));
        widths[0] - widths.get(1).copied().unwrap_or(0.0) > by
    }

    proptest! {
        #[test]
        fn two_measurements_with_other_noise_give_the_same_ranking(
            gaps in prop::collection::vec(0.0..1.2_f64, 1..9),
            noise in prop::collection::vec((0.0..0.03_f64, 0.0..0.03_f64), 9),
        ) {
            let mut times = vec![1.0];
            for gap in gaps {
                times.push(times[times.len() - 1] * f64::exp(gap * gap));
            }
            prop_assume!(is_clear(&times, 4.0 * f64::ln(1.03)));
            let measured = |pick: fn(&(f64, f64)) -> f64| -> Vec<f64> {
                times.iter().zip(&noise).map(|(t, n)| t * (1.0 + pick(n))).collect()
            };
            let (first, second) = (of(&measured(|n| n.0), 0.03), of(&measured(|n| n.1), 0.03));
            prop_assert_eq!(printed(&first), printed(&second));
            let exact = of(&times, 0.0);
            prop_assert_eq!(printed(&first), printed(&exact));
        }

        #[test]
        fn ranks_count_those_that_are_faster(times in prop::collection::vec(0.1..10.0_f64, 1..12)) {
            for r in of(&times, 0.02) {
                prop_assert!(r.rank >= 1 && r.rank <= times.len());
                let faster = times.iter().filter(|&&t| t * APART[0] < r.seconds).count();
                prop_assert!(r.rank <= faster + 1, "{} of {:?}", r.name, times);
            }
        }
    }
}

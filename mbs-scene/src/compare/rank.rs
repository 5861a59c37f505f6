//! Ranks that noise does not change: who is faster than whom by more than it can be.

use super::data::Rank;

/// Between these factors lies the one within which times share a rank.
const APART: [f64; 2] = [1.2, 1.8];
/// So many factors are tried.
const TRIED: u32 = 240;

/// The factor within which a time shares the rank of the fastest of that rank: of those from 1.2 to 1.8 the one that is furthest, in
/// logarithms, from every quotient of two times that it decides on.
pub(super) fn apart(times: impl Iterator<Item = f64>) -> f64 {
    let mut times: Vec<f64> = times.map(libm::log).collect();
    times.sort_by(f64::total_cmp);
    let [low, high] = APART.map(libm::log);
    let tried = (0..=TRIED).map(|k| low + (high - low) * f64::from(k) / f64::from(TRIED));
    let clearer = |best: (f64, f64), factor| {
        let margin = margin(&times, factor);
        if margin > best.1 { (factor, margin) } else { best }
    };
    libm::exp(tried.fold((low, -1.0), clearer).0)
}

/// Distance from a factor to the nearest quotient that it decides on; all in logarithms, the times in order.
fn margin(times: &[f64], factor: f64) -> f64 {
    let Some(&(mut fastest)) = times.first() else { return 0.0 };
    let mut margin = f64::INFINITY;
    for &time in &times[1..] {
        margin = margin.min((time - fastest - factor).abs());
        if time - fastest > factor {
            fastest = time;
        }
    }
    margin
}

/// Gives ranks to methods with their least times. A rank ends where a time is more than `apart` times that of its fastest, and more
/// than what lies between the two least times of the fastest.
///
/// Noise that makes each time longer by a share of at most e moves the logarithm of every quotient, and with it the margin of every
/// way to cut the order into ranks, by log(1 + e) at most. So the ranks are those without noise wherever the way that is furthest from
/// all its quotients is further than the second by 2 log(1 + e), and further than log(1 + e).
pub(super) fn rank(mut methods: Vec<Rank>, apart: f64) -> Vec<Rank> {
    let order: Vec<String> = methods.iter().map(|m| m.name.clone()).collect();
    methods.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    // up to here reaches the rank
    let mut reach = 0.0_f64;
    let mut rank = 1;
    for i in 0..methods.len() {
        if methods[i].seconds > reach {
            rank = i + 1;
            reach = methods[i].seconds * apart.max(1.0 + methods[i].noise);
        }
        methods[i].rank = rank;
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
    fn methods_within_the_factor_are_equal_and_keep_the_order_of_the_list() {
        let ranks = of(&[3.0, 1.1, 1.0, 1.2, 7.0], 0.01);
        assert_eq!(printed(&ranks), [(1, "m1"), (1, "m2"), (1, "m3"), (4, "m0"), (5, "m4")]);
    }

    #[test]
    fn no_rank_spans_more_than_the_factor() {
        let times: Vec<f64> = (0..12).map(|k| 1.15_f64.powi(k)).collect();
        let factor = apart(times.iter().copied());
        let ranks = of(&times, 0.0);
        for pair in ranks.iter().flat_map(|a| ranks.iter().map(move |b| (a, b))) {
            let (a, b) = pair;
            assert!(a.rank != b.rank || b.seconds <= factor * a.seconds * (1.0 + 1e-12));
        }
    }

    #[test]
    fn the_factor_lies_where_no_quotient_is_near() {
        let factor = |times: &[f64]| apart(times.iter().copied()).ln();
        let close = |x: f64, y: f64| (x - y).abs() < 2e-3; // a step between two that are tried
        assert!(close(factor(&[1.0, 5.0]), 1.2_f64.ln()));
        assert!(close(factor(&[1.0, 1.3]), 1.8_f64.ln()));
        assert!(close(factor(&[1.0, 1.25, 1.7]), 0.5 * (1.25_f64.ln() + 1.7_f64.ln())));
    }

    #[test]
    fn a_quotient_that_the_repeats_do_not_show_is_none() {
        assert_eq!(printed(&of(&[1.0, 3.0], 2.5)), [(1, "m0"), (1, "m1")]);
        assert_eq!(printed(&of(&[1.0, 3.0], 0.5)), [(1, "m0"), (2, "m1")]);
    }

    /// Is the clearest way to cut clearer than every other by twice this, and clear by it?
    fn is_clear(times: &[f64], by: f64) -> bool {
        let logs: Vec<f64> = times.iter().map(|t| t.ln()).collect();
        let [low, high] = APART.map(f64::ln);
        let cut = |factor: f64| -> Vec<bool> {
            let mut fastest = logs[0];
            let mut is_first = |t: f64| {
                let first = t - fastest > factor;
                fastest = if first { t } else { fastest };
                first
            };
            logs.iter().map(|&t| is_first(t)).collect()
        };
        let mut ways: Vec<(Vec<bool>, f64)> = Vec::new();
        for k in 0..=4 * TRIED {
            let factor = low + (high - low) * f64::from(k) / f64::from(4 * TRIED);
            let (way, clear) = (cut(factor), margin(&logs, factor));
            match ways.iter_mut().find(|(w, _)| *w == way) {
                Some((_, best)) => *best = best.max(clear),
                None => ways.push((way, clear)),
            }
        }
        ways.sort_by(|a, b| b.1.total_cmp(&a.1));
        let between = ways[0].1 - ways.get(1).map_or(0.0, |way| way.1);
        // and what lies between two factors that are tried
        let grid = (high - low) / f64::from(TRIED);
        between > 2.0 * by + grid && ways[0].1 > by + grid
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
            prop_assume!(is_clear(&times, f64::ln(1.03)));
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
                let faster = times.iter().filter(|&&t| t < r.seconds).count();
                prop_assert!(r.rank <= faster + 1, "{} of {:?}", r.name, times);
                let much_faster = times.iter().filter(|&&t| t * APART[1] < r.seconds).count();
                prop_assert!(r.rank > much_faster, "{} of {:?}", r.name, times);
            }
        }
    }
}

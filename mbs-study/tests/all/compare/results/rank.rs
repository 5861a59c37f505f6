//! Ranks of times with noise.

use mbs_study::compare::results::Rank;
use mbs_study::inside::results::{APART, rank};
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
fn methods_within_the_factor_are_equal_and_keep_the_order_of_the_list() {
    let ranks = of(&[3.0, 1.1, 1.0, 1.2, 7.0], 0.01);
    assert_eq!(printed(&ranks), [(1, "m1"), (1, "m2"), (1, "m3"), (4, "m0"), (5, "m4")]);
}

#[test]
fn no_rank_spans_more_than_the_factor() {
    let ranks = of(&[1.0, 1.4, 1.96, 2.744, 3.8416], 0.0);
    assert_eq!(ranks.iter().map(|r| r.rank).collect::<Vec<_>>(), [1, 1, 3, 3, 5]);
}

#[test]
fn a_quotient_that_the_repeats_do_not_show_is_none() {
    assert_eq!(printed(&of(&[1.0, 3.0], 2.5)), [(1, "m0"), (1, "m1")]);
    assert_eq!(printed(&of(&[1.0, 3.0], 0.5)), [(1, "m0"), (2, "m1")]);
}

/// True if a quotient of times that decides a rank is within the relative distance `share` of the limit.
fn is_near(times: &[f64], share: f64) -> bool {
    let mut times = times.to_vec();
    times.sort_by(f64::total_cmp);
    let mut fastest = times[0];
    times.iter().any(|&t| {
        let is_near = (t / fastest / APART).ln().abs() < share;
        fastest = if t > fastest * APART { t } else { fastest };
        is_near
    })
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
        prop_assume!(!is_near(&times, 1.03_f64.ln()));
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
            let faster = times.iter().filter(|&&t| t < r.seconds).count();
            prop_assert!(r.rank >= 1 && r.rank <= faster + 1, "{} of {:?}", r.name, times);
            let much_faster = times.iter().filter(|&&t| t * APART < r.seconds).count();
            prop_assert!(r.rank > much_faster, "{} of {:?}", r.name, times);
        }
    }
}

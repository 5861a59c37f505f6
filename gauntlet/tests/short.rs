//! The first cases of every family: no formulation is wrong about any.

use gauntlet::judge::{Verdict, judge};
use gauntlet::run::keep_panics;
use gauntlet::schedule::cases;

/// Two rounds of the families, but for those of which a case takes minutes in all formulations.
const CASES: usize = 62;

#[test]
fn no_formulation_is_wrong_about_the_first_hard_cases() {
    keep_panics();
    let (mut wrong, mut right, mut stopped) = (Vec::new(), 0, 0);
    for (family, seed) in cases(CASES).filter(|(family, _)| family.every < 30) {
        for (method, verdict) in judge(&family.case(seed), &mut |_| {}) {
            match verdict {
                Verdict::Wrong(why) => {
                    wrong.push(format!("{}, {seed}, {method}: {why}", family.name))
                }
                Verdict::Stopped(..) => stopped += 1,
                _ => right += 1,
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(
        right > 6 * stopped,
        "{right} runs to their ends, {stopped} typed errors: hard, not hopeless"
    );
}

//! Short forms of jobs: texts that caused faults in the past, and the first difficult cases.

use runner::fuzz::trial::{self, trial};
use runner::gauntlet::judge::{Verdict, judge};
use runner::gauntlet::run::keep_panics;
use runner::gauntlet::schedule::cases;

/// Number of cases: two rounds of the families, without those whose cases take minutes in all formulations.
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

#[test]
fn what_once_broke_is_refused_or_stops_with_a_reason() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    let mut n = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read(&path).unwrap();
        for turn in 0..3 {
            if let trial::Verdict::Wrong(why) = trial(&text, turn) {
                panic!("{}: {why}", path.display());
            }
        }
        n += 1;
    }
    assert!(n > 0, "the corpus is there");
}

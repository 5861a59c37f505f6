//! Texts that once broke something stay mended.

use fuzz::{Verdict, trial};

#[test]
fn what_once_broke_is_refused_or_stops_with_a_reason() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    let mut n = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read(&path).unwrap();
        for turn in 0..3 {
            if let Verdict::Wrong(why) = trial(&text, turn) {
                panic!("{}: {why}", path.display());
            }
        }
        n += 1;
    }
    assert!(n > 0, "the corpus is there");
}

//! Results in a journal.

use core::sync::atomic::{AtomicBool, Ordering};
use mbs::Interrupt;
use mbs_study::compare::{Earlier, JournalError};
use mbs_study::inside::compare::ResultStore;
use mbs_study::inside::{Head, Kind};
use std::sync::Arc;

const KIND: Kind =
    Kind { file: "x.journal", title: "x", of: ["an x", "another x"], hashes: &["the text"] };

#[test]
fn a_result_is_kept_to_the_last_bit_and_made_once() {
    let out = std::env::temp_dir().join(format!("mbs-store-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&out);
    let head = Head::new(KIND, &["a"]);
    let numbers: [f64; 4] = [0.1 + 0.2, 1.0 / 3.0, 5e-324, -2.5e300];
    let open = |earlier| ResultStore::open(Some(&out), &head, earlier).unwrap();
    let mut store = open(Earlier::Refuse).unwrap();
    store.get("run 1", || numbers.to_vec()).unwrap();
    drop(store);
    assert!(open(Earlier::Refuse).is_none(), "finished runs are not lost by mistake");
    let mut store = open(Earlier::Resume).unwrap();
    assert_eq!(store.resumed, 1);
    let value: Vec<f64> = store.get("run 1", || panic!("it is there")).unwrap();
    assert_eq!(value, numbers);
    // an interrupted job has no result
    let flag = Arc::new(AtomicBool::new(false));
    store.interrupt = Interrupt::new(flag.clone());
    let cut = store.get("run 2", || {
        flag.store(true, Ordering::Relaxed);
        0
    });
    assert!(matches!(cut, Err(JournalError::Interrupted)));
    drop(store);
    store = open(Earlier::Resume).unwrap();
    assert_eq!(store.resumed, 1);
    drop(store);
    let other = Head::new(KIND, &["b"]);
    let refused = ResultStore::open(Some(&out), &other, Earlier::Resume).unwrap_err();
    assert!(matches!(refused, JournalError::Other(_)), "{refused}");
    assert_eq!(open(Earlier::Restart).unwrap().resumed, 0);
    std::fs::remove_dir_all(&out).unwrap();
}

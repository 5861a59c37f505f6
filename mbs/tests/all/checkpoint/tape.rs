//! Lists of a checkpoint.

use mbs::inside::tested::{Eye, Pen, Tape};

#[test]
fn a_list_is_never_longer_than_what_is_left() {
    let mut pen = Pen::default();
    pen.count(&mut (1 << 59)).expect("a count");
    pen.bytes(&mut [0; 64]).expect("memory");
    let mut list: Vec<f64> = Vec::new();
    let read = Eye(&pen.0).list(&mut list, 8, Tape::float);
    assert!(read.is_err() && list.capacity() == 0);
}

//! Log of overruns, as CSV.

use mbs::record::{Overrun, RealtimeSummary, write_overruns};

#[test]
fn each_overrun_is_a_line_under_the_head() {
    let overrun = Overrun {
        index: 7,
        time: 0.08,
        at: 0.0812,
        duration: 0.0112,
        late: 0.0012,
        action: "down",
        next_level: 1,
        ..Overrun::default()
    };
    let of = RealtimeSummary { log: vec![overrun], ..RealtimeSummary::default() };
    let mut text = Vec::new();
    write_overruns(&mut text, &of).unwrap();
    let expected = "index,t,at,duration,late,level,action,next_level,held_periods\n\
                    7,0.08,0.0812,0.0112,0.0012,0,down,1,0\n";
    assert_eq!(String::from_utf8(text).unwrap(), expected);
}

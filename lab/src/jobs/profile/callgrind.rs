//! Counts of callgrind by instruction, and the difference of two runs.

use std::collections::BTreeMap;

/// Place of instructions in a program or library.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Place {
    /// Path of the program or library.
    pub(crate) object: String,
    /// The function that is called. Other functions may be inlined in it.
    pub(crate) function: String,
    /// Address within the program or library.
    pub(crate) address: String,
}

/// Number of executed instructions at each place.
pub(crate) type Costs = BTreeMap<Place, u64>;

/// Reads a file of `--dump-instr=yes --compress-strings=no --compress-pos=no`. The cost of a callee is counted only there.
///
/// # Errors
///
/// A line of an unknown form, or a sum that differs from the total in the file.
pub(crate) fn costs(dump: &str) -> Result<Costs, String> {
    let (mut object, mut function, mut is_call) = ("", "", false);
    let (mut costs, mut total, mut all) = (Costs::new(), None, 0);
    for line in dump.lines() {
        if let Some(name) = line.strip_prefix("ob=") {
            object = name;
        } else if let Some(name) = line.strip_prefix("fn=") {
            function = name;
        } else if line.starts_with("calls=") {
            is_call = true;
        } else if let Some(count) = line.strip_prefix("totals: ") {
            total = count.trim().parse::<u64>().ok();
        } else if line.starts_with("0x") && !std::mem::take(&mut is_call) {
            let mut words = line.split(' ');
            let (address, count) = (words.next(), words.nth(1).and_then(|n| n.parse::<u64>().ok()));
            let (Some(address), Some(count)) = (address, count) else {
                return Err(format!("callgrind's line `{line}` is not read"));
            };
            let [object, function, address] = [object, function, address].map(str::to_owned);
            *costs.entry(Place { object, function, address }).or_default() += count;
            all += count;
        }
    }
    match total {
        Some(total) if total == all => Ok(costs),
        _ => Err(format!("callgrind counts {total:?} instructions, its lines {all}")),
    }
}

/// Instructions that the longer run executed beyond the shorter one. A place with fewer in the longer run counts as zero: the order of a
/// hash map may change the instructions before the steps.
pub(crate) fn more(longer: &Costs, shorter: &Costs) -> Costs {
    let more = longer.iter().map(|(place, &count)| {
        let before = shorter.get(place).copied().unwrap_or(0);
        (place.clone(), count.saturating_sub(before))
    });
    more.filter(|(_, count)| *count > 0).collect()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Dump of two functions of a program. The first calls the second, and a library.
    pub(crate) const SAMPLE: &str = "# callgrind format\npositions: instr line\nevents: Ir\nsummary: 62\n\n\
        ob=/p/bench\nfl=step.rs\nfn=index3::step\n0x10 5 3\nfi=arith.rs\n0x14 9 4\nfe=step.rs\n\
        cfi=kernel.rs\ncfn=kernel::eliminate\ncalls=3 0x80 \n0x18 7 30\n0x18 7 5\n\
        cob=/lib/libc.so.6\ncfn=memset\ncalls=1 0x900 \n0x1c 8 20\n\n\
        fl=kernel.rs\nfn=kernel::eliminate\n0x80 1 30\n\n\
        ob=/lib/libc.so.6\nfl=???\nfn=memset\n0x900 0 20\n\ntotals: 62\n";

    #[test]
    fn what_callees_take_is_counted_once_and_objects_are_distinguished() {
        let costs = costs(SAMPLE).unwrap();
        let at = |address: &str| {
            let (place, count) = costs.iter().find(|(place, _)| place.address == address).unwrap();
            (&place.object[..], &place.function[..], *count)
        };
        assert_eq!(at("0x18"), ("/p/bench", "index3::step", 5));
        assert_eq!(at("0x80"), ("/p/bench", "kernel::eliminate", 30));
        assert_eq!(at("0x900"), ("/lib/libc.so.6", "memset", 20));
        assert_eq!(costs.values().sum::<u64>(), 62);
    }

    #[test]
    fn sums_that_are_not_the_files_own_are_refused() {
        assert!(costs(&SAMPLE.replace("totals: 62", "totals: 61")).is_err());
        assert!(costs("fn=a\n0x10 5\ntotals: 0\n").is_err());
    }

    #[test]
    fn start_up_falls_out_of_a_difference() {
        let longer = costs(SAMPLE).unwrap();
        let shorter = longer.iter().map(|(place, &n)| (place.clone(), n.min(20))).collect();
        let more = more(&longer, &shorter);
        assert_eq!(more.values().copied().collect::<Vec<_>>(), [10]);
    }
}

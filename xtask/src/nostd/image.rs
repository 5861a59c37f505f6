//! What an image holds: its size in flash, and what its functions call.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Where RAM begins on both boards.
const RAM: u64 = 0x2000_0000;

/// The sizes of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Image {
    /// Bytes that are written to flash.
    pub(super) flash: u64,
    /// Bytes of static data in RAM.
    pub(super) ram: u64,
}

impl Image {
    /// Reads the program headers of an ELF file of 32 bits.
    ///
    /// # Errors
    ///
    /// The file, if it is none.
    pub(super) fn read(path: &Path) -> Result<Self, String> {
        let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
        let word = |at: usize| {
            let four = bytes.get(at..at + 4)?;
            Some(u32::from_le_bytes([four[0], four[1], four[2], four[3]]) as usize)
        };
        let half = |at: usize| Some(word(at)? & 0xffff);
        let sizes = || {
            let (first, size, n) = (word(28)?, half(42)?, half(44)?);
            let mut sizes = Self { flash: 0, ram: 0 };
            for header in (0..n).map(|i| first + i * size) {
                // What is loaded, as many bytes as the file has of it; what stands in RAM, zeros included.
                if word(header)? == 1 {
                    sizes.flash += word(header + 16)? as u64;
                    if word(header + 8)? as u64 >= RAM {
                        sizes.ram += word(header + 20)? as u64;
                    }
                }
            }
            Some(sizes)
        };
        let is_elf = bytes.starts_with(b"\x7fELF\x01");
        let sizes = is_elf.then(sizes).flatten();
        sizes.ok_or(format!("{} is no image", path.display()))
    }

    /// All readable text of the file, where the names of its functions are.
    pub(super) fn names(self, path: &Path) -> Result<String, String> {
        let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

/// The functions that can be reached from `start` in a disassembly: by calls, jumps and falling through. A call through a
/// register may go anywhere and is refused.
///
/// # Errors
///
/// No such function, or a call through a register.
pub(super) fn reachable(disassembly: &str, start: &str) -> Result<BTreeSet<String>, String> {
    let mut calls: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    let mut here = "";
    for line in disassembly.lines() {
        if let Some((_, name)) = line.strip_suffix(">:").and_then(|line| line.split_once(" <")) {
            here = name;
            calls.entry(here).or_default();
            continue;
        }
        let mut words = line.split_whitespace().skip(1);
        let (Some(operation), Some(operand)) = (words.next(), words.next()) else { continue };
        let is_branch = operation.starts_with('b')
            && !operation.starts_with("bf")
            && !operation.starts_with("bic")
            && !operation.starts_with("bkpt");
        if is_branch && operand.starts_with('r') {
            calls.entry(here).or_default().insert(ANYWHERE);
        }
        let target = line.rsplit_once('<').and_then(|(_, name)| name.split_once('>'));
        let jumps = is_branch || operation.starts_with("cb");
        if let (true, Some((target, _))) = (jumps, target) {
            let name = target.split_once('+').map_or(target, |(name, _)| name);
            calls.entry(here).or_default().insert(name);
        }
    }
    if !calls.contains_key(start) {
        return Err(format!("there is no function `{start}`"));
    }
    let (mut seen, mut todo) = (BTreeSet::new(), vec![start]);
    while let Some(name) = todo.pop() {
        if name == ANYWHERE {
            return Err("a step calls through a register: what it reaches is unknown".to_owned());
        }
        if seen.insert(name.to_owned()) {
            todo.extend(calls.get(name).into_iter().flatten());
        }
    }
    Ok(seen)
}

/// The target of a call through a register.
const ANYWHERE: &str = "*";

#[cfg(test)]
mod tests {
    use super::reachable;

    const TEXT: &str = "\
00000400 <start>:
     400: push {r4, lr}
     402: bl 0x500 <helper> @ imm = #0xfa
     406: bx lr

00000500 <helper>:
     500: bne 0x508 <helper+0x8> @ imm
     502: b.w 0x600 <_RNv4core9panicking5panic>

00000600 <_RNv4core9panicking5panic>:
     600: b 0x600 <_RNv4core9panicking5panic>

00000700 <other>:
     700: blx r3
";

    #[test]
    fn what_is_called_on_the_way_is_reached() {
        let reached = reachable(TEXT, "start").expect("no call through a register");
        assert!(reached.contains("_RNv4core9panicking5panic") && !reached.contains("other"));
        assert!(reachable(TEXT, "other").is_err(), "a call through a register");
        assert!(reachable(TEXT, "none").is_err());
    }
}

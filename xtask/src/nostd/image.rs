//! Contents of an image: its size in flash, and the functions that a function can reach.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Address at which RAM begins on both boards.
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
    /// The file, if it is no such image.
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
                // loaded segments: bytes of the file count as flash; bytes in memory, zeros included, count as RAM if the segment is there
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

    /// The bytes of the file as text. It contains the names of the functions.
    pub(super) fn names(self, path: &Path) -> Result<String, String> {
        let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

/// Returns the functions that can be reached from `start` in a disassembly: by calls, by jumps, and by running on into the next function. A
/// call through a register may lead to any function. An unknown instruction may be such a call. Both are refused.
///
/// # Errors
///
/// There is no such function, or a reached function has a call or an instruction that is refused.
pub(super) fn reachable(disassembly: &str, start: &str) -> Result<BTreeSet<String>, String> {
    let functions = functions(disassembly);
    let mut calls: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    let mut opaque: BTreeMap<&str, &'static str> = BTreeMap::new();
    for line in disassembly.lines() {
        let Some((address, code)) = line.split_once(':') else { continue };
        let Some(here) = number(address).and_then(|address| holder(&functions, address)) else {
            continue;
        };
        let mut words = code.split_whitespace();
        let (operation, operand) = (words.next().unwrap_or(""), words.next().unwrap_or(""));
        let is_branch = operation.starts_with('b')
            && !operation.starts_with("bf")
            && !operation.starts_with("bic")
            && !operation.starts_with("bkpt");
        if operation == "<unknown>" {
            opaque.insert(here, "has an instruction that the disassembler does not know");
        } else if (is_branch && operand.starts_with('r'))
            || (is_load(operation) && operand.starts_with("pc"))
        {
            opaque.insert(here, "calls through a register");
        } else if is_branch || operation.starts_with("cb") {
            let target =
                code.split_once('<').and_then(|(before, _)| before.split_whitespace().last());
            let target = target.and_then(number).and_then(|address| holder(&functions, address));
            calls.entry(here).or_default().extend(target);
        }
    }
    if !functions.values().any(|name| *name == start) {
        return Err(format!("there is no function `{start}`"));
    }
    let (mut seen, mut todo) = (BTreeSet::new(), vec![start]);
    while let Some(name) = todo.pop() {
        if let Some(why) = opaque.get(name) {
            return Err(format!("`{name}` {why}: what a step reaches is unknown"));
        }
        if seen.insert(name.to_owned()) {
            todo.extend(calls.get(name).into_iter().flatten());
        }
    }
    Ok(seen)
}

/// True for a load or a move. Such an instruction is a jump if its target is the program counter.
fn is_load(operation: &str) -> bool {
    operation.starts_with("ldr") || operation.starts_with("mov")
}

/// Functions by their addresses. The names `$t` and `$d` are left out: they mark code and data within a function.
fn functions(disassembly: &str) -> BTreeMap<u64, &str> {
    let headers = disassembly.lines().filter_map(|line| line.strip_suffix(">:")?.split_once(" <"));
    let functions = headers.filter(|(_, name)| !name.starts_with('$'));
    functions.filter_map(|(address, name)| Some((number(address)?, name))).collect()
}

/// The function that contains an address.
fn holder<'a>(functions: &BTreeMap<u64, &'a str>, address: u64) -> Option<&'a str> {
    functions.range(..=address).next_back().map(|(_, name)| *name)
}

/// An address in hexadecimal digits, with or without `0x`.
fn number(text: &str) -> Option<u64> {
    let text = text.trim();
    u64::from_str_radix(text.strip_prefix("0x").unwrap_or(text), 16).ok()
}

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
     502: cbz r0, 0x514 <$t> @ imm
     504: bx lr

00000508 <$d>:
     508: 00 00 00 20 .word 0x20000000

00000514 <$t>:
     514: b.w 0x600 <_RNv4core9panicking5panic>

00000600 <_RNv4core9panicking5panic>:
     600: b 0x600 <_RNv4core9panicking5panic>

00000700 <other>:
     700: blx r3

00000800 <another>:
     800: <unknown>

00000900 <third>:
     900: ldr pc, [r0, #4]
";

    #[test]
    fn what_is_called_on_the_way_is_reached() {
        let reached = reachable(TEXT, "start").expect("no call through a register");
        assert!(reached.contains("_RNv4core9panicking5panic") && !reached.contains("other"));
        assert!(reachable(TEXT, "other").is_err(), "a call through a register");
        assert!(reachable(TEXT, "third").is_err(), "a jump through memory");
        assert!(reachable(TEXT, "another").is_err(), "an instruction that is not known");
        assert!(reachable(TEXT, "none").is_err());
    }
}

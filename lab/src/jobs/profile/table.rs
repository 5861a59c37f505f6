//! The tables of a profile: time of a step beside its least time, instructions by parts, and the functions with most instructions.

use super::parts::{Part, Shares};
use crate::format;
use serde_json::Value;
use std::fmt::Write;

/// Profile of one scene.
#[derive(Debug)]
pub(crate) struct Profile {
    /// The line of `runner bench profile step`.
    pub(crate) line: Value,
    /// Instructions of all profiled steps, by parts and functions.
    pub(crate) shares: Shares,
}

impl Profile {
    pub(crate) fn name(&self) -> &str {
        self.line["scene"].as_str().unwrap_or_default()
    }

    /// A number of the line; NaN if it is missing.
    pub(crate) fn number(&self, key: &str) -> f64 {
        self.line[key].as_f64().unwrap_or(f64::NAN)
    }

    /// A count of work per step.
    pub(crate) fn work(&self, key: &str) -> f64 {
        self.line["work"][key].as_f64().unwrap_or(f64::NAN)
    }

    /// Number of profiled steps.
    fn steps(&self) -> f64 {
        self.number("to") - self.number("from")
    }

    /// Instructions of a part per step.
    pub(crate) fn instructions(&self, part: Part) -> f64 {
        self.each(self.shares.parts.get(&part).copied().unwrap_or(0))
    }

    /// Returns the average number of instructions per step.
    #[allow(clippy::cast_precision_loss, reason = "counts far below 2^53")]
    pub(crate) fn each(&self, instructions: u64) -> f64 {
        instructions as f64 / self.steps()
    }
}

/// Number of functions listed for each scene.
const FUNCTIONS: usize = 12;

/// Best rates of the machine.
struct Rates {
    /// Operations per second: with one operation per instruction, and in `packed` with two.
    scalar: f64,
    packed: f64,
    /// Bytes per second, for an array that fits into the second cache and for one that fits into no cache; sizes of the arrays.
    bytes: [f64; 2],
    sizes: [f64; 2],
    /// Size of the second cache, in bytes.
    cache: f64,
}

impl Rates {
    fn of(line: &Value) -> Self {
        let number = |key: &str| line[key].as_f64().unwrap_or(f64::NAN);
        Self {
            scalar: number("scalar"),
            packed: number("packed"),
            bytes: ["near", "far"].map(number),
            sizes: ["near_size", "far_size"].map(number),
            cache: number("second_cache"),
        }
    }

    fn sentence(&self) -> String {
        let [near, far] = self.sizes.map(|size| size / f64::from(1 << 20));
        format!(
            "Rates of this machine in the same run: {:.1} G products and sums in a second one at a time, {:.1} G two at a time (SSE2); \
             {:.0} GB/s read from {near:.1} MiB, which the second cache ({:.1} MiB) holds, {:.0} GB/s from {far:.0} MiB, which none holds.",
            self.scalar / 1e9,
            self.packed / 1e9,
            self.bytes[0] / 1e9,
            self.cache / f64::from(1 << 20),
            self.bytes[1] / 1e9,
        )
    }

    /// The least time of a step, by its operations and by its bytes [s].
    fn floors(&self, profile: &Profile) -> [f64; 2] {
        let bytes = if profile.number("set") <= self.cache { self.bytes[0] } else { self.bytes[1] };
        [operations(profile) / self.packed, profile.number("moved") / bytes]
    }
}

/// Number of operations of a step, each counted as one.
fn operations(profile: &Profile) -> f64 {
    ["products", "sums", "quotients", "roots", "turns"].map(|key| profile.number(key)).iter().sum()
}

/// Operations of a part per step; `None` if they are not counted separately.
fn operations_of(profile: &Profile, part: Part) -> Option<f64> {
    let of = |phase: &str| profile.line["operations"][phase].as_f64().unwrap_or(f64::NAN);
    let eliminated = profile.work("factorizations") * profile.number("factor_flops");
    Some(match part {
        Part::Kernels => eliminated,
        Part::Blocks => of("factorisation") - eliminated,
        Part::Residuals => of("residuals"),
        Part::Sweeps => of("solves"),
        Part::Evaluation => of("evaluation") + of("forces") + of("bias"),
        Part::Products => of("products"),
        Part::Projections | Part::Memory | Part::Rest => return None,
    })
}

/// Number of instructions of a step.
fn instructions(profile: &Profile) -> f64 {
    Part::ALL.iter().map(|&part| profile.instructions(part)).sum()
}

/// All tables, with the remark.
pub(crate) fn markdown(profiles: &[Profile], rates: &Value, remark: &str) -> String {
    let rates = Rates::of(rates);
    let mut text = format!("{remark} {}\n\n", rates.sentence());
    let heading = [
        "scene",
        "step [s]",
        "unknowns",
        "rows",
        "iterations",
        "factorisations",
        "solves",
        "instructions",
        "products",
        "sums",
        "quotients",
        "roots",
        "sines, angles",
    ];
    let rows = profiles.iter().map(counts);
    text.push_str(&grid(&heading, rows));
    let heading = [
        "scene",
        "CPU time [us]",
        "operations",
        "floor by operations [us]",
        "one operation at a time [us]",
        "set [KiB]",
        "moved [KiB]",
        "floor by bytes [us]",
        "floor [us]",
        "time over floor",
        "instructions an operation",
    ];
    text.push_str(&grid(&heading, profiles.iter().map(|profile| floor(profile, &rates))));
    let mut heading = vec!["share of instructions [%]"];
    heading.extend(Part::ALL.map(Part::name));
    let shares = |profile: &Profile| {
        let share = |part| 100.0 * profile.instructions(part) / instructions(profile);
        row(profile, Part::ALL.map(|part| format!("{:.1}", share(part))))
    };
    text.push_str(&grid(&heading, profiles.iter().map(shares)));
    let parts: Vec<Part> = Part::ALL[..6].to_vec();
    let mut heading = vec!["operations, and instructions for each"];
    heading.extend(parts.iter().map(|part| part.name()));
    let each = |profile: &Profile| {
        let cell = |&part: &Part| match operations_of(profile, part) {
            Some(n) => format!("{n:.0}, {:.2}", profile.instructions(part) / n),
            None => String::new(),
        };
        row(profile, parts.iter().map(cell))
    };
    text.push_str(&grid(&heading, profiles.iter().map(each)));
    for profile in profiles {
        let _ = writeln!(text, "```text\n{}```\n", functions(profile));
    }
    text
}

/// A row with a scene's name and cells.
fn row(profile: &Profile, cells: impl IntoIterator<Item = String>) -> Vec<String> {
    std::iter::once(format!("`{}`", profile.name())).chain(cells).collect()
}

fn grid(heading: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    format::markdown(heading, rows) + "\n"
}

fn counts(profile: &Profile) -> Vec<String> {
    let whole = |key: &str| format!("{:.0}", profile.number(key));
    let work =
        ["iterations", "factorizations", "solves"].map(|key| format!("{:.2}", profile.work(key)));
    let head = [profile.number("step").to_string(), whole("unknowns"), whole("rows")];
    let kinds = ["products", "sums", "quotients", "roots", "turns"].map(whole);
    let all = [format!("{:.0}", instructions(profile))];
    row(profile, head.into_iter().chain(work).chain(all).chain(kinds))
}

fn floor(profile: &Profile, rates: &Rates) -> Vec<String> {
    let micro = |seconds: f64| format!("{:.1}", 1e6 * seconds);
    let kibi = |key: &str| format!("{:.0}", profile.number(key) / 1024.0);
    let ([by_operations, by_bytes], n) = (rates.floors(profile), operations(profile));
    let (time, floor) = (profile.number("seconds"), by_operations.max(by_bytes));
    row(
        profile,
        [
            micro(time),
            format!("{n:.0}"),
            micro(by_operations),
            micro(n / rates.scalar),
            kibi("set"),
            kibi("moved"),
            micro(by_bytes),
            micro(floor),
            format!("{:.1}", time / floor),
            format!("{:.2}", instructions(profile) / n),
        ],
    )
}

/// The functions of a scene with most instructions, each with its part and the function into which it is inlined.
fn functions(profile: &Profile) -> String {
    let all = instructions(profile);
    let mut list: Vec<_> = profile.shares.functions.iter().collect();
    list.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    let mut text =
        format!("{}: instructions of a step, their share, part, function\n", profile.name());
    for ((part, function), &count) in list.into_iter().take(FUNCTIONS) {
        let count = profile.each(count);
        let share = 100.0 * count / all;
        let _ = writeln!(text, "{count:9.0} {share:5.1} %  {:13}  {}", part.name(), function);
    }
    text
}

/// The profile of one scene as text.
pub(crate) fn text(profile: &Profile, rates: &Value) -> String {
    let rates = Rates::of(rates);
    let mut text = format!("{}\n\n", rates.sentence());
    let [by_operations, by_bytes] = rates.floors(profile);
    let time = profile.number("seconds");
    let _ = writeln!(
        text,
        "{}: {:.2} us a step, floor {:.2} us by operations, {:.2} us by bytes; {:.2} iterations, {:.2} factorisations, {:.2} solves\n",
        profile.name(),
        1e6 * time,
        1e6 * by_operations,
        1e6 * by_bytes,
        profile.work("iterations"),
        profile.work("factorizations"),
        profile.work("solves"),
    );
    let _ = writeln!(
        text,
        "{:.0} unknowns, {:.0} rows; {:.0} fronts of {:.0} numbers, {:.0} operations a factorisation; elements by their unknowns: {}\n",
        profile.number("unknowns"),
        profile.number("rows"),
        profile.number("fronts"),
        profile.number("stored"),
        profile.number("factor_flops"),
        cliques(profile)
    );
    for part in Part::ALL {
        let n = profile.instructions(part);
        let share = 100.0 * n / instructions(profile);
        let operations = operations_of(profile, part).map_or("-".to_owned(), |n| format!("{n:.0}"));
        let _ = writeln!(
            text,
            "{:13} {n:9.0} instructions {share:5.1} %  {operations:>8} operations",
            part.name()
        );
    }
    let _ = writeln!(
        text,
        "{:13} {:9.0} instructions 100.0 %  {:8.0} operations\n",
        "all",
        instructions(profile),
        operations(profile)
    );
    text.push_str(&functions(profile));
    text
}

/// Sizes of elements as text, such as "3 of 6, 20 of 12".
fn cliques(profile: &Profile) -> String {
    let mut sizes: Vec<(u64, u64)> = Vec::new();
    for (size, n) in profile.line["cliques"].as_object().into_iter().flatten() {
        sizes.extend(size.parse().ok().zip(n.as_u64()));
    }
    sizes.sort_unstable();
    let cliques = sizes.iter().map(|(size, n)| format!("{n} of {size}"));
    cliques.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn sample() -> (Profile, Value) {
        let line = json!({
            "scene": "x", "from": 0, "to": 10, "step": 0.001, "seconds": 2e-6, "factor_flops": 100,
            "work": { "iterations": 2.0, "factorizations": 2.0, "solves": 3.0 },
            "products": 500.0, "sums": 400.0, "quotients": 90.0, "roots": 10.0, "turns": 0.0,
            "set": 1024, "moved": 2048.0, "operations": { "factorisation": 250.0, "solves": 300.0 },
        });
        let rates =
            json!({ "scalar": 1e9, "packed": 2e9, "near": 1e9, "far": 1e8, "second_cache": 4096 });
        let mut shares = Shares::default();
        shares.parts.extend([(Part::Kernels, 3000), (Part::Rest, 1000)]);
        shares.functions.insert((Part::Kernels, "factor".to_owned()), 3000);
        (Profile { line, shares }, rates)
    }

    #[test]
    fn the_floor_is_the_larger_of_operations_and_bytes() {
        let (profile, rates) = sample();
        let [operations, bytes] = Rates::of(&rates).floors(&profile);
        assert!((operations - 0.5e-6).abs() < 1e-12, "a thousand operations at 2e9");
        assert!((bytes - 2.048e-6).abs() < 1e-12, "2 KiB at 1e9, since the set fits the cache");
        assert_eq!(operations_of(&profile, Part::Blocks), Some(50.0));
    }

    #[test]
    fn tables_have_every_part_and_shares_make_up_all() {
        let (profile, rates) = sample();
        let tables = markdown(&[profile], &rates, "Here.");
        assert!(tables.starts_with("Here. Rates"), "{tables}");
        assert!(
            tables.contains("| `x` | 75.0 | 0.0 | 0.0 | 0.0 | 0.0 | 0.0 | 0.0 | 0.0 | 25.0 |"),
            "{tables}"
        );
        assert!(tables.contains("200, 1.50"), "instructions for each operation: {tables}");
        assert!(tables.contains("      300  75.0 %  factorisation  factor"), "{tables}");
    }
}

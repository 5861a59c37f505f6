//! The parts of a step, and the part to which an instruction belongs.
//!
//! A release build inlines most of a step, and the product of two numbers is a line of the standard library. So an instruction is
//! classified by the chain of functions that are inlined at it, from the innermost outwards. The first function that belongs to a part
//! decides.

use super::callgrind::{Costs, Place};
use std::collections::BTreeMap;

/// A part of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Part {
    Kernels,
    Blocks,
    Residuals,
    Sweeps,
    Evaluation,
    Products,
    Projections,
    Memory,
    Rest,
}

impl Part {
    pub(crate) const ALL: [Self; 9] = [
        Self::Kernels,
        Self::Blocks,
        Self::Residuals,
        Self::Sweeps,
        Self::Evaluation,
        Self::Products,
        Self::Projections,
        Self::Memory,
        Self::Rest,
    ];

    /// Returns the name of the part, the heading of its column.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Kernels => "factorisation",
            Self::Blocks => "blocks",
            Self::Residuals => "residuals",
            Self::Sweeps => "sweeps",
            Self::Evaluation => "evaluation",
            Self::Products => "J v",
            Self::Projections => "projections",
            Self::Memory => "memory",
            Self::Rest => "rest",
        }
    }
}

/// A function that is inlined at an instruction, or that contains it, with its file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Frame<'a> {
    pub(crate) function: &'a str,
    pub(crate) file: &'a str,
}

impl Frame<'_> {
    /// True if one of `names` is the name of the function. A closure has the name of the function that contains it.
    fn is(&self, names: &[&str]) -> bool {
        let words = self.function.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'));
        names.iter().any(|name| words.clone().any(|word| word == *name))
    }

    /// The part to which the function belongs; `None` if the surrounding function decides.
    fn part(&self) -> Option<Part> {
        let (_, path) = self.file.rsplit_once("mbs-")?;
        let is = |names: &[&str]| self.is(names);
        match path {
            "sparse/src/kernel.rs" | "sparse/src/pivoting.rs" => Some(Part::Kernels),
            "core/src/dense/panel.rs" if is(&["subtract_products"]) => Some(Part::Kernels),
            "sparse/src/part.rs" => Some(Part::Blocks),
            "sparse/src/sweep.rs" => Some(Part::Sweeps),
            "sparse/src/scatter.rs" => Some(Part::Residuals),
            "sparse/src/subtree.rs" if is(&["assemble"]) => Some(Part::Blocks),
            "sparse/src/subtree.rs" if is(&["factor", "factor_task", "eliminate"]) => {
                Some(Part::Kernels)
            }
            "sparse/src/subtree.rs" => is(&SWEEPS).then_some(Part::Sweeps),
            "sparse/src/multifrontal.rs" if is(&["factor"]) => Some(Part::Kernels),
            "sparse/src/multifrontal.rs" if is(&["assemble"]) => Some(Part::Residuals),
            "sparse/src/multifrontal.rs" => Some(Part::Sweeps),
            "augmented/src/projection.rs" | "augmented/src/index3/project.rs" => {
                Some(Part::Projections)
            }
            "augmented/src/multipliers.rs" if is(&["balance"]) => Some(Part::Projections),
            "augmented/src/index3.rs" | "augmented/src/penalty.rs" => Some(Part::Rest),
            "augmented/src/multipliers.rs" => Some(Part::Rest),
            _ if path.starts_with("augmented/src/newton/") => Some(Part::Rest),
            _ if path.starts_with("core/src/") => self.part_of_model(&path["core/src/".len()..]),
            _ => None,
        }
    }

    /// The part of a function in a file of mbs-core.
    fn part_of_model(&self, path: &str) -> Option<Part> {
        let is = |names: &[&str]| self.is(names);
        match path {
            "natural/incidence.rs" => Some(Part::Products),
            "natural/coordinate_sets.rs" => Some(Part::Blocks),
            // functions that loop over groups work for the surrounding function
            "natural/element_ranges.rs" => None,
            "model.rs" | "natural/evaluate.rs" | "natural/element.rs" | "natural/group.rs"
                if is(&BLOCKS) =>
            {
                Some(Part::Blocks)
            }
            "model.rs" | "natural/evaluate.rs" | "natural/element.rs" | "natural/group.rs"
                if is(&RESIDUALS) =>
            {
                Some(Part::Residuals)
            }
            _ if is(&["multiply_jacobian", "multiply_jacobian_on"]) => Some(Part::Products),
            "natural/group.rs" => None,
            "inputs.rs" => Some(Part::Evaluation),
            _ => {
                let folders = ["natural/", "elements/", "laws/", "effects/action/"];
                folders.iter().any(|f| path.starts_with(f)).then_some(Part::Evaluation)
            }
        }
    }
}

/// Functions that write blocks, in files that belong to several parts.
const BLOCKS: [&str; 11] = [
    "write_block",
    "write_sized_block",
    "write_effect_block",
    "write_square",
    "add_laws",
    "has_block",
    "add_transverse",
    "add_geometric",
    "add_pairs",
    "add_squares",
    "add_curvature",
];
const RESIDUALS: [&str; 9] = [
    "write_residual",
    "sum_residuals",
    "write_sized_residual",
    "add_sized_residual",
    "sized_residual",
    "write_whole_residual",
    "scatter",
    "add_mass_product",
    "add_multiples",
];
const SWEEPS: [&str; 6] = ["visit", "solve", "forward", "forward_all", "backward", "backward_all"];

/// The chains of functions at addresses, as `addr2line -a -f -i -C` prints them: innermost first.
pub(crate) fn chains(printed: &str) -> BTreeMap<u64, Vec<Frame<'_>>> {
    let mut chains: BTreeMap<u64, Vec<Frame<'_>>> = BTreeMap::new();
    let (mut at, mut lines) = (0, printed.lines());
    while let Some(line) = lines.next() {
        if let Some(address) = address(line) {
            at = address;
        } else {
            let place = lines.next().unwrap_or_default();
            let file = place.rsplit_once(':').map_or(place, |(file, _)| file);
            chains.entry(at).or_default().push(Frame { function: line, file });
        }
    }
    chains
}

/// Reads an address such as 0x4a4be0, with or without leading zeros.
pub(crate) fn address(text: &str) -> Option<u64> {
    u64::from_str_radix(text.strip_prefix("0x")?, 16).ok()
}

/// The part of a place, from the chain of functions there.
fn part(place: &Place, chain: &[Frame<'_>]) -> Part {
    let name = place.function.trim_start_matches('_');
    if ["memcpy", "memmove", "memset", "memcmp", "bcmp"].iter().any(|f| name.starts_with(f)) {
        return Part::Memory;
    }
    let found = chain.iter().find_map(Frame::part);
    // only effects and guides use sines and angles, and lengths use roots
    let is_libm = || name.starts_with("libm::") || chain.iter().any(|f| f.file.contains("/libm"));
    found.unwrap_or_else(|| match name {
        // the sweeps and the factorisation use this function; only the sweeps call it without inlining
        _ if name.contains("panel::subtract") => Part::Sweeps,
        _ if is_libm() => Part::Evaluation,
        _ => Part::Rest,
    })
}

/// The innermost function of this repository at a place, with the function in which it is inlined. If there is none, the called function.
fn name(place: &Place, chain: &[Frame<'_>]) -> String {
    let own = chain.iter().filter(|frame| frame.file.contains("/mbs-"));
    let mut names: Vec<_> = own.map(|frame| short(frame.function)).collect();
    names.dedup();
    match &names[..] {
        [] => short(&place.function).to_owned(),
        [name] => (*name).to_owned(),
        [name, around, ..] => format!("{name} in {around}"),
    }
}

/// The last name of a function's path; for a closure, the name of the function that contains it.
fn short(function: &str) -> &str {
    let words = function.rsplit("::").map(|word| word.trim_end_matches("'2"));
    let mut names = words.filter(|word| {
        word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') && !word.is_empty()
    });
    names.next().unwrap_or(function)
}

/// Number of instructions of each part, and of each function with its part.
#[derive(Debug, Default)]
pub(crate) struct Shares {
    pub(crate) parts: BTreeMap<Part, u64>,
    pub(crate) functions: BTreeMap<(Part, String), u64>,
}

/// Sums the costs by parts and functions.
pub(crate) fn shares(costs: &Costs, program: &str, printed: &str) -> Shares {
    let chains = chains(printed);
    let mut shares = Shares::default();
    for (place, &count) in costs {
        let own = (place.object == program).then(|| address(&place.address)).flatten();
        let chain = own.and_then(|address| chains.get(&address)).map_or(&[][..], |chain| chain);
        let part = part(place, chain);
        *shares.parts.entry(part).or_default() += count;
        *shares.functions.entry((part, name(place, chain))).or_default() += count;
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::super::callgrind::{costs, tests::SAMPLE};
    use super::*;

    const PRINTED: &str = "0x0000000000000010\nmbs_augmented::index3::step\n/r/mbs-augmented/src/index3.rs:50\n\
        0x0000000000000014\n<f64 as core::ops::arith::Mul>::mul\n/rustc/library/core/src/ops/arith.rs:350\n\
        mbs_core::natural::element::<impl mbs_core::natural::model::NaturalModel<T,_>>::write_sized_block\n\
        /r/mbs-core/src/natural/element.rs:48 (discriminator 2)\n\
        mbs_sparse::subtree::assemble\n/r/mbs-sparse/src/subtree.rs:120\n\
        0x0000000000000018\nmbs_core::team::norm_inf\n/r/mbs-core/src/team.rs:190\n\
        mbs_augmented::projection::Projector<T,M,S>::violation\n\
        /r/mbs-augmented/src/projection.rs:40\nmbs_augmented::index3::project::project\n/r/mbs-augmented/src/index3/project.rs:27\n\
        0x0000000000000080\n??\n??:0\n";

    fn part_of(function: &str, file: &str) -> Option<Part> {
        Frame { function, file }.part()
    }

    #[test]
    fn an_instruction_belongs_to_the_innermost_function_that_has_a_part() {
        let shares = shares(&costs(SAMPLE).unwrap(), "/p/bench", PRINTED);
        let of = |part| shares.parts.get(&part).copied();
        assert_eq!(of(Part::Blocks), Some(4), "a product belongs to the block that it is in");
        assert_eq!(of(Part::Projections), Some(5), "a norm belongs to the projection that asks");
        assert_eq!(of(Part::Memory), Some(20));
        assert_eq!(of(Part::Rest), Some(33), "the step itself, and what is not known");
        assert_eq!(shares.parts.values().sum::<u64>(), 62);
        assert_eq!(
            shares.functions[&(Part::Blocks, "write_sized_block in assemble".to_owned())],
            4
        );
    }

    #[test]
    fn functions_of_one_file_are_distinguished() {
        let share = |f| part_of(f, "/r/mbs-sparse/src/subtree.rs");
        assert_eq!(share("mbs_sparse::subtree::Numbers<T>::factor_task"), Some(Part::Kernels));
        assert_eq!(
            share("mbs_sparse::subtree::Vectors<W,F>::forward::{{closure}}"),
            Some(Part::Sweeps)
        );
        assert_eq!(share("mbs_sparse::subtree::Numbers<T>::split_at"), None);
        let core = |f, file| part_of(f, &format!("/r/mbs-core/src/{file}"));
        assert_eq!(core("x::subtract", "dense/panel.rs"), None);
        assert_eq!(core("x::subtract_products", "dense/panel.rs"), Some(Part::Kernels));
        assert_eq!(
            core("x::evaluate_bias_on::{{closure}}", "natural/threaded.rs"),
            Some(Part::Evaluation)
        );
        assert_eq!(core("x::multiply_jacobian_on", "natural/threaded.rs"), Some(Part::Products));
        assert_eq!(core("x::on_parts", "natural/element_ranges.rs"), None);
        assert_eq!(
            core("mbs_core::laws::tire::Tire<T>::evaluate", "laws/tire.rs"),
            Some(Part::Evaluation)
        );
    }

    #[test]
    fn functions_are_named_by_their_last_names() {
        assert_eq!(short("mbs_sparse::kernel::fixed"), "fixed");
        let closure = "mbs_core::natural::threaded::<impl a::B<T,_>>::advance_on::{{closure}}";
        assert_eq!(short(closure), "advance_on");
        assert_eq!(short("mbs_sparse::tasks::Tasks::each'2"), "each");
        assert_eq!(short("__memset_avx2_unaligned_erms"), "__memset_avx2_unaligned_erms");
    }
}

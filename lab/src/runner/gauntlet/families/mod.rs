//! The families of difficult cases. Each family makes a case from any seed.

mod bases;
mod common;
mod effects;
mod redundant;
mod scales;
mod singular;
mod steps;

use crate::gauntlet::case::Case;
use mbs::scene_file::Dice;

/// A family of cases with the same difficulty, and the generator of its cases.
#[derive(Debug, Clone, Copy)]
pub struct Family {
    /// Name of the family.
    pub name: &'static str,
    /// Difficulty of the family: a column of the table.
    pub property: &'static str,
    /// Number of rounds of all families in which this family has one case.
    pub every: u64,
    make: fn(&mut Dice) -> Case,
}

impl Family {
    const fn new(name: &'static str, property: &'static str, make: fn(&mut Dice) -> Case) -> Self {
        Self { name, property, every: 1, make }
    }

    /// The case of a seed.
    #[must_use]
    pub fn case(&self, seed: u64) -> Case {
        // cases of different families with the same seed must differ
        let name =
            self.name.bytes().fold(0, |sum: u64, b| sum.wrapping_mul(31).wrapping_add(b.into()));
        (self.make)(&mut Dice::new(name.wrapping_add(seed.wrapping_mul(1_000_003))))
    }
}

const SINGULAR: &str = "singular positions";
const REDUNDANT: &str = "redundant constraints";
const TOPOLOGY: &str = "changing topology";
const INEQUALITY: &str = "inequality constraints";
const STIFF: &str = "stiffness";
const FAST: &str = "high frequency";
const MASSES: &str = "mass ratios";
const MASSLESS: &str = "massless bodies";
const UNITS: &str = "units";
const ROTATED: &str = "rotated models";
const LONG: &str = "long runs";
const SMALL: &str = "small steps";
const LARGE: &str = "large steps";
const PENALTIES: &str = "ill-scaled penalties";
const LOOPS: &str = "many loops";
const SINGLE: &str = "single precision";

/// All families of difficult cases whose runs are short.
pub const FAMILIES: [Family; 29] = [
    Family::new("parallelogram chain through the horizontal", SINGULAR, singular::parallelograms),
    Family::new("four-bar with a change point", SINGULAR, singular::change_point),
    Family::new("slider-crank at its dead points", SINGULAR, singular::slider_crank),
    Family::new("chain near its full length", SINGULAR, singular::straight_chain),
    Family::new("gimbals near their lock", SINGULAR, singular::gimbals),
    Family::new("universal joint near a right angle", SINGULAR, singular::cardan),
    Family::new("planar linkage in space", REDUNDANT, redundant::planar_in_space),
    Family::new("parallelogram with more cranks", REDUNDANT, redundant::more_cranks),
    Family::new("joint given twice", REDUNDANT, redundant::doubled),
    Family::new("Bennett linkage", REDUNDANT, redundant::bennett),
    Family::new("Bricard linkage", REDUNDANT, redundant::bricard),
    Family::new("mass that bounces", TOPOLOGY, effects::bouncing),
    Family::new("wheel that lifts off", TOPOLOGY, effects::wheel),
    Family::new("latch that locks and releases", TOPOLOGY, effects::latch),
    Family::new("link that breaks", TOPOLOGY, effects::breaking),
    Family::new("joint with ends", INEQUALITY, effects::limits),
    Family::new("dry friction", INEQUALITY, effects::friction),
    Family::new("bodies that meet", INEQUALITY, effects::contact),
    Family::new("stiff hinge", STIFF, effects::stiff_hinge),
    Family::new("stiff springs between masses", STIFF, effects::stiff_chain),
    Family::new("Andrews' mechanism", FAST, scales::andrews),
    Family::new("light beside heavy", MASSES, scales::masses),
    Family::new("links without mass", MASSLESS, scales::massless),
    Family::new("other units", UNITS, scales::units),
    Family::new("other axes", ROTATED, scales::rotated),
    Family { every: 30, ..Family::new("a million steps", LONG, steps::long) },
    Family::new("steps of 1e-7 s", SMALL, steps::tiny),
    Family::new("few steps a swing", LARGE, steps::large),
    Family::new("penalties from 1e3 to 1e13", PENALTIES, steps::penalties),
];

/// Two families whose runs take longer.
pub const LONG_FAMILIES: [Family; 2] = [
    Family { every: 3, ..Family::new("walker with twelve legs", LOOPS, scales::walker) },
    Family::new("32 bits", SINGLE, steps::single),
];

//! The components of a quantity: how many there are, their labels and their units.

use crate::scene::{Dimension, Freedom};
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// A component of a channel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Component {
    /// What follows the dot in a column's name; empty when the channel is one number.
    pub label: String,
    /// Unit, such as `m` or `rad/s`.
    pub unit: String,
}

/// The form of a quantity's components.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ComponentForm {
    /// `x`, `y`, `z`, in the plane without `z`; with a unit.
    Vector(&'static str),
    /// About `x`, `y`, `z`, in the plane one number; with a unit.
    Axial(&'static str),
    /// `1`, `2`, ... for the coordinates of a joint, one number where there is one; with what follows the unit of each.
    Coordinates(&'static str),
    /// `Fx`, `Fy`, `Fz`, `Mx`, `My`, `Mz`; in the plane `Fx`, `Fy`, `Mz`.
    Wrench,
}

impl ComponentForm {
    /// Each component, of a joint with these freedoms.
    pub(super) fn of(self, dimension: Dimension, freedoms: &[Freedom]) -> Vec<Component> {
        let one = |label: &str, unit: &str| Component { label: label.into(), unit: unit.into() };
        let axes = &["x", "y", "z"][..dimension.count()];
        let about = if dimension == Dimension::Planar { &["z"] } else { axes };
        match self {
            Self::Axial(unit) if about.len() == 1 => [one("", unit)].into(),
            Self::Vector(unit) | Self::Axial(unit) => axes.iter().map(|x| one(x, unit)).collect(),
            Self::Coordinates(per) => {
                let units = |f: &Freedom| core::iter::repeat_n(f.unit(), f.n_coordinates());
                let units: Vec<_> = freedoms.iter().flat_map(units).collect();
                let label = |i| if units.len() == 1 { String::new() } else { format!("{}", i + 1) };
                let component = |(i, unit)| one(&label(i), &format!("{unit}{per}"));
                units.iter().enumerate().map(component).collect()
            }
            Self::Wrench => {
                let forces = axes.iter().map(|x| one(&format!("F{x}"), "N"));
                forces.chain(about.iter().map(|x| one(&format!("M{x}"), "N m"))).collect()
            }
        }
    }
}

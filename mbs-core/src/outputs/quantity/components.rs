//! The components of a quantity: how many there are, their labels and their units.

use crate::joint::{Dimension, Freedom};
use crate::scene::SceneFault;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::ops::Range;

/// A component of a channel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Component {
    /// What follows the dot in a column's name; empty when the channel is one number.
    pub label: String,
    /// Unit, such as `m` or `rad/s`.
    pub unit: String,
}

/// Components of a channel that are one vector.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Magnitude {
    /// What follows the dot in the name of a column with its magnitude: `abs`; of a wrench `F` and `M`.
    pub label: &'static str,
    /// Its unit.
    pub unit: String,
    /// The places of its components in the channel.
    pub places: Range<usize>,
}

/// The vectors among the components of a channel: `x`, `y`, `z`, forces and moments. Quaternions, matrices and coordinates of a joint are
/// none, and a vector of one component is a number.
///
/// ```
/// use mbs_core::outputs::{Component, magnitudes};
/// let wrench = ["Fx", "Fy", "Mz"].map(|label| Component { label: label.into(), unit: "N".into() });
/// let [force] = &magnitudes(&wrench)[..] else { panic!("one vector") };
/// assert_eq!((force.label, force.places.clone()), ("F", 0..2));
/// ```
#[must_use]
pub fn magnitudes(components: &[Component]) -> Vec<Magnitude> {
    let of = |(prefix, label): (&str, &'static str)| {
        let is_part = |component: &Component| {
            // a number without a unit is of a rotation
            component.unit != "-"
                && component.label.strip_prefix(prefix).is_some_and(|x| AXES.contains(&x))
        };
        let first = components.iter().position(is_part)?;
        let n = components[first..].iter().take_while(|component| is_part(component)).count();
        let unit = components[first].unit.clone();
        (n > 1).then_some(Magnitude { label, unit, places: first..first + n })
    };
    [("", "abs"), ("F", "F"), ("M", "M")].into_iter().filter_map(of).collect()
}

/// Units of angles, of their rates and accelerations; and the same in degrees.
const ANGLES: [[&str; 2]; 3] = [["rad", "deg"], ["rad/s", "deg/s"], ["rad/s^2", "deg/s^2"]];

/// The unit in degrees of what has a unit of rad, rad/s or rad/s^2; `None` of other units.
pub(super) fn in_degrees(unit: &str) -> Option<&'static str> {
    ANGLES.iter().find(|[radians, _]| *radians == unit).map(|[_, degrees]| *degrees)
}

/// The unit in radians of one in degrees, another one as it is; and how many of the given units are one of it [-].
///
/// Sizes of outputs in both units compare by it.
///
/// ```
/// use mbs_core::outputs::in_radians;
/// assert_eq!(in_radians("deg/s"), ("rad/s", 180.0 / core::f64::consts::PI));
/// assert_eq!(in_radians("m"), ("m", 1.0));
/// ```
#[must_use]
pub fn in_radians(unit: &str) -> (&str, f64) {
    let found = ANGLES.iter().find(|[_, degrees]| *degrees == unit);
    found.map_or((unit, 1.0), |[radians, _]| (*radians, 180.0 / core::f64::consts::PI))
}

/// Letters of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The form of a quantity's components.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ComponentForm {
    /// `x`, `y`, `z`, in the plane without `z`; with a unit.
    Vector(&'static str),
    /// About `x`, `y`, `z`, in the plane one number; with a unit.
    Axial(&'static str),
    /// `1`, `2`, ... for the coordinates of a joint, one number where there is one; with what follows the unit of each.
    Coordinates(&'static str),
    /// The same for the forces on the coordinates.
    Efforts,
    /// One number; with its unit.
    Number(&'static str),
    /// One number that a coupling or an effect measures, with what follows its unit; nothing of an effect that measures several.
    Measured(&'static str),
    /// One length of a coupling that has lines [m]; nothing of others.
    Length,
    /// One number of an effect that acts on one side only; nothing of others.
    Contact,
    /// One number of a tire, with its unit; nothing of other effects.
    Tire(&'static str),
    /// A place of a tire [m]; nothing of other effects.
    TirePoint,
    /// One number of an effect that has a free value or acts on one side only, with its unit; nothing of others.
    Deflection,
    /// `xx`, `xy` and so on, row by row.
    Matrix,
    /// The force on what is measured; of an effect that measures several numbers, its wrench.
    Force,
    /// `w`, `x`, `y`, `z` of a quaternion; in the plane an angle.
    Orientation,
    /// `Fx`, `Fy`, `Fz`, `Mx`, `My`, `Mz`; in the plane `Fx`, `Fy`, `Mz`.
    Wrench,
}

/// The unit of what is done work on by a force: `N` on a length, `N m` on an angle and on a number.
fn effort(unit: &str) -> &'static str {
    if unit == "m" { "N" } else { "N m" }
}

impl ComponentForm {
    /// Is it of tires alone?
    #[must_use]
    pub const fn is_of_tire(self) -> bool {
        matches!(self, Self::Tire(_) | Self::TirePoint)
    }

    /// Fault of a quantity of an effect that has no components of this form.
    pub(crate) const fn fault_of_effect(self) -> SceneFault {
        match self {
            Self::Contact => SceneFault::NoContact,
            Self::Deflection => SceneFault::NoDeflection,
            Self::Tire(_) | Self::TirePoint => SceneFault::NotATire,
            Self::Vector(_)
            | Self::Axial(_)
            | Self::Coordinates(_)
            | Self::Efforts
            | Self::Number(_)
            | Self::Measured(_)
            | Self::Length
            | Self::Matrix
            | Self::Force
            | Self::Orientation
            | Self::Wrench => SceneFault::NoMeasure,
        }
    }

    /// Each component; of a joint with these freedoms, of a coupling or an effect with the unit of what it measures.
    pub(super) fn of(
        self,
        dimension: Dimension,
        freedoms: &[Freedom],
        measured: Option<&str>,
    ) -> Vec<Component> {
        let one = |label: &str, unit: &str| Component { label: label.into(), unit: unit.into() };
        let axes = &AXES[..dimension.count()];
        let about = if dimension == Dimension::Planar { &["z"] } else { axes };
        let coordinates = |unit: &dyn Fn(&str) -> String| {
            let units = |f: &Freedom| core::iter::repeat_n(f.unit(), f.n_coordinates());
            let units: Vec<_> = freedoms.iter().flat_map(units).collect();
            let label = |i| if units.len() == 1 { String::new() } else { format!("{}", i + 1) };
            units.iter().enumerate().map(|(i, x)| one(&label(i), &unit(x))).collect()
        };
        match self {
            Self::Axial(unit) if about.len() == 1 => [one("", unit)].into(),
            Self::Vector(unit) | Self::Axial(unit) => axes.iter().map(|x| one(x, unit)).collect(),
            Self::TirePoint => axes.iter().map(|x| one(x, "m")).collect(),
            Self::Coordinates(per) => coordinates(&|unit| format!("{unit}{per}")),
            Self::Efforts => coordinates(&|unit| effort(unit).into()),
            Self::Number(unit) | Self::Tire(unit) => [one("", unit)].into(),
            Self::Contact => [one("", "-")].into(),
            Self::Length | Self::Deflection => {
                measured.map(|unit| one("", unit)).into_iter().collect()
            }
            Self::Matrix => {
                let row = |x| axes.iter().map(move |y| one(&format!("{x}{y}"), "-"));
                axes.iter().flat_map(row).collect()
            }
            Self::Measured(per) => {
                measured.map(|unit| one("", &format!("{unit}{per}"))).into_iter().collect()
            }
            Self::Orientation if about.len() == 1 => [one("", "rad")].into(),
            Self::Orientation => ["w", "x", "y", "z"].map(|label| one(label, "-")).into(),
            Self::Force | Self::Wrench => {
                if let (Self::Force, Some(unit)) = (self, measured) {
                    return [one("", effort(unit))].into();
                }
                let forces = axes.iter().map(|x| one(&format!("F{x}"), "N"));
                forces.chain(about.iter().map(|x| one(&format!("M{x}"), "N m"))).collect()
            }
        }
    }
}

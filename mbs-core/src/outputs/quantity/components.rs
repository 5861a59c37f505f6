//! Components of a quantity: their number, labels and units.

use crate::joint::{Dimension, Freedom};
use crate::scene::SceneFault;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::ops::Range;

/// A component of an output channel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Component {
    /// Label after the dot in a column's name; empty if the channel has one component.
    pub label: String,
    /// Unit, such as `m` or `rad/s`.
    pub unit: String,
}

/// Vector among the components of a channel, whose magnitude can be recorded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Magnitude {
    /// Label after the dot in the name of the magnitude's column: `abs`; for a wrench `F` and `M`.
    pub label: &'static str,
    /// Unit of the magnitude.
    pub unit: String,
    /// Range of the vector's components among the components of the channel.
    pub places: Range<usize>,
}

/// Vectors among the components of a channel: `x`, `y`, `z`, forces and moments. Quaternions, matrices and coordinates of a joint are no
/// vectors. A single component counts as a number.
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
            // a component without a unit belongs to a rotation matrix or a quaternion
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

/// Units of angles, angular rates and angular accelerations, each in radians and in degrees.
const ANGLES: [[&str; 2]; 3] = [["rad", "deg"], ["rad/s", "deg/s"], ["rad/s^2", "deg/s^2"]];

/// Unit in degrees for a unit of rad, rad/s or rad/s^2; `None` for other units.
pub(super) fn in_degrees(unit: &str) -> Option<&'static str> {
    ANGLES.iter().find(|[radians, _]| *radians == unit).map(|[_, degrees]| *degrees)
}

/// Unit in radians for a unit in degrees, and the factor from a value in radians to the value in the given unit [-]. Other units do not
/// change, and their factor is one.
///
/// Use the factor to compare outputs in degrees with outputs in radians.
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

/// Form of a quantity's components, with a unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ComponentForm {
    /// Components `x`, `y`, `z` with this unit; in a planar scene without `z`.
    Vector(&'static str),
    /// Components about `x`, `y`, `z` with this unit; in a planar scene one number.
    Axial(&'static str),
    /// Components `1`, `2`, ... for the coordinates of a joint, or one number for a single coordinate. The text, for example `/s`, is
    /// appended to the unit of each coordinate.
    Coordinates(&'static str),
    /// Components like `Coordinates`, for the forces on the coordinates.
    Efforts,
    /// One number with this unit.
    Number(&'static str),
    /// Number that a coupling or an effect measures; the text is appended to its unit. An effect that measures several numbers has no
    /// component.
    Measured(&'static str),
    /// Length of a coupling's lines [m]; other couplings have no component.
    Length,
    /// Contact flag of a one-sided effect; other effects have no component.
    Contact,
    /// Scalar quantity of a tire with this unit; other effects have no component.
    Tire(&'static str),
    /// Position of a tire's contact [m]; other effects have no component.
    TirePoint,
    /// Deflection of an effect with a free value or of a one-sided effect; other effects have no component.
    Deflection,
    /// Components `xx`, `xy` and so on of a matrix, row by row.
    Matrix,
    /// Force on the measured number; for an effect that measures several numbers, its wrench.
    Force,
    /// Components `w`, `x`, `y`, `z` of a quaternion; in a planar scene an angle.
    Orientation,
    /// Components `Fx`, `Fy`, `Fz`, `Mx`, `My`, `Mz`; in a planar scene `Fx`, `Fy`, `Mz`.
    Wrench,
}

/// Unit of the generalised force on a measure: `N` on a length, `N m` on an angle or a number.
fn effort(unit: &str) -> &'static str {
    if unit == "m" { "N" } else { "N m" }
}

impl ComponentForm {
    /// True if the form is for tires only.
    #[must_use]
    pub const fn is_of_tire(self) -> bool {
        matches!(self, Self::Tire(_) | Self::TirePoint)
    }

    /// Fault for an effect that has no components of this form.
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

    /// Components of this form. `freedoms` are the freedoms of a joint; `measured` is the unit of the number that a coupling or effect
    /// measures.
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

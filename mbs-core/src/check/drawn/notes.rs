//! Notes of a run on couplings whose meaning has changed since version 0.1.

use crate::Real;
use crate::mechanism::{MeshedWheels, Scene};
use crate::outputs::ComponentForm;
use crate::scene::{CouplingId, CouplingKind, DrawnKind, Sense, Target};
use alloc::format;
use alloc::string::String;

impl<T> Scene<T> {
    /// Notes on couplings of a resolved scene whose sums differ from version 0.1, or whose sense does not follow from the geometry.
    pub fn sense_notes(&self) -> impl Iterator<Item = (CouplingId, String)> {
        let noted = self.couplings.iter().enumerate();
        noted.filter_map(|(i, coupling)| {
            let drawn = coupling.drawn.filter(|drawn| !drawn.is_stated)?;
            let (kind, name) = (drawn.kind.name(), &coupling.name);
            let note = match drawn.sense {
                Sense::Same => return None,
                Sense::Changed => format!(
                    "the sense of {kind} `{name}` is that of places and axes, and not that of version 0.1, which took the joints as they are \
                     written: say `sense = \"drawn\"`, or write the sum as `linear`"
                ),
                Sense::Undecided => format!(
                    "places and axes do not say in which sense {kind} `{name}` works: its joints are taken as they are written; write the \
                     sum as `linear`"
                ),
            };
            Some((CouplingId::new(i), note))
        })
    }
}

impl<T: Real> Scene<T> {
    /// Notes on gears whose radii do not agree with the distance of their axes. The motion has the ratio of the radii, but the wheels do
    /// not touch.
    pub fn radii_notes(&self) -> impl Iterator<Item = (CouplingId, String)> {
        /// Largest allowed error of the radii, relative to the distance of the axes [-]. Chosen, not tuned: numbers in files are rounded.
        const OFF: f64 = 1e-4;
        let noted = self.couplings.iter().enumerate();
        noted.filter_map(|(i, coupling)| {
            let drawn = coupling.drawn.map(|drawn| drawn.kind);
            let Some(DrawnKind::Gear { is_internal, has_radii: true }) = drawn else { return None };
            let wheels = MeshedWheels::new(self, &coupling.terms)?;
            let [first, second] = wheels.moments.map(T::abs);
            let needed = if is_internal { (first - second).abs() } else { first + second };
            let (needed, distance) = (needed.to_f64(), wheels.distance().to_f64());
            let is_met = (needed - distance).abs() <= OFF * distance;
            let of = if is_internal { "difference" } else { "sum" };
            let note = || {
                format!(
                    "the axes of gear `{}` are {distance:.6} m apart, and the {of} of its `radii` is {needed:.6} m: the motion has their \
                     ratio, the wheels do not touch",
                    coupling.name
                )
            };
            (!is_met).then(|| (CouplingId::new(i), note()))
        })
    }

    /// Notes on outputs of reactions that lack the force of a coupling.
    pub fn reaction_notes(&self) -> impl Iterator<Item = String> {
        let reactions = self.outputs.iter().filter_map(|output| match output.quantity.target() {
            Target::Joint(joint) => {
                let is_one = output.quantity.row().components == ComponentForm::Wrench;
                is_one.then_some((output, joint))
            }
            _ => None,
        });
        reactions.flat_map(|(output, joint)| {
            let lacking = self.lacking_forces().filter(move |(of, _)| *of == joint);
            lacking.map(|(_, coupling)| {
                let of = &self.couplings[coupling.index()];
                let (kind, remedy) = match of.drawn.map(|drawn| drawn.kind) {
                    Some(kind @ DrawnKind::Gear { .. }) => (kind.name(), "give its pitch point `at`"),
                    Some(kind @ DrawnKind::Belt { .. }) => {
                        (kind.name(), "give the `pretension` of its strands")
                    }
                    Some(kind) => (kind.name(), "its `effort` has the size of that force"),
                    None => (
                        "rope",
                        "begin or end its line at the rim of the drum, on the body that carries it",
                    ),
                };
                format!(
                    "output `{}` lacks the force of {kind} `{}`, which acts as a moment alone: {remedy}",
                    output.name, of.name
                )
            })
        })
    }

    /// Notes on outputs of couplings whose values differ from version 0.1.
    pub fn effort_notes(&self) -> impl Iterator<Item = String> {
        self.outputs.iter().filter_map(|output| {
            let Target::Coupling(coupling) = output.quantity.target() else { return None };
            // Only names of version 0.1 are compared, since files of that version have no other names.
            let is_effort = match output.quantity.row().name {
                "effort" => true,
                "power" => false,
                _ => return None,
            };
            let of = self.couplings.get(coupling.index())?;
            let what = match (of.drawn.map(|drawn| drawn.kind), is_effort) {
                _ if is_effort && of.kind == CouplingKind::Rope => {
                    "the tension of the rope [N], and was minus that"
                }
                (
                    Some(DrawnKind::Gear { .. } | DrawnKind::Ratio | DrawnKind::Differential),
                    true,
                ) => {
                    "the torque on the first wheel [N m], and was that over the factor of the wheel"
                }
                (Some(DrawnKind::Screw), true) => {
                    "the force along the screw [N], and was that over 2 pi"
                }
                (Some(_), false) if of.named_term().is_some() => {
                    "what the coupling passes on, and was zero"
                }
                _ => return None,
            };
            Some(format!("output `{}` is {what} in version 0.1", output.name))
        })
    }
}

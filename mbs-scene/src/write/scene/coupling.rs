//! Writes the entries of the list `[[coupling]]`. A drawn coupling, whose signs follow from places and axes, is written with the keys of its
//! kind. Other couplings are written as a sum.

use super::{Keys, Node, WriteError, Writer, curve, list};
use mbs_core::scene::{
    Coupling, CouplingKind, CouplingTerm, Drawn, DrawnKind, Freedom, JointId, Number,
};

/// Coordinates of joints with their factors.
type Coordinates<'a> = [(JointId, usize, &'a Number)];

impl Writer<'_> {
    /// The keys of a coupling. A relation is code and cannot be written. Some couplings built in code do not fit the keys of their kind, such
    /// as driven gears. They are written as a sum.
    pub(super) fn coupling(self, coupling: &Coupling<Number>) -> Result<Keys, WriteError> {
        let in_code = || WriteError::InCode(format!("coupling `{}`", coupling.name));
        if coupling.relation.is_some() {
            return Err(in_code());
        }
        let mut keys = Keys::default();
        keys.push("name", coupling.name.as_str());
        let as_drawn = match coupling.drawn {
            Some(drawn) => self.drawn(coupling, drawn)?,
            None => None,
        };
        if let Some(written) = as_drawn.map_or_else(|| self.cam(coupling), |keys| Ok(Some(keys)))? {
            keys.0.extend(written.0);
        } else {
            let is_rope = coupling.kind == CouplingKind::Rope;
            keys.push("kind", if is_rope { "rope" } else { "linear" });
            let terms = match coupling.drawn {
                Some(_) => self.found(coupling).ok_or_else(in_code)?,
                None => coupling.terms.clone(),
            };
            keys.push("terms", self.terms(&terms)?);
            keys.push("value", &coupling.value);
        }
        if let CouplingKind::Mesh(mesh) = &coupling.kind {
            keys.push("at", self.vector(&mesh.at));
            keys.push("pressure_angle", &mesh.pressure_angle);
        }
        if let CouplingKind::Strands { pretension } = &coupling.kind {
            keys.push("pretension", pretension);
        }
        if let Some(law) = &coupling.motion {
            self.motion(&mut keys, law)?;
        }
        Ok(keys)
    }

    /// The keys of a drawn coupling, whose signs follow from places and axes. `None` when the keys of its kind cannot express it.
    fn drawn(self, coupling: &Coupling<Number>, drawn: Drawn) -> Result<Option<Keys>, WriteError> {
        let mut keys = Keys::default();
        let of =
            |term: &CouplingTerm<Number>| term.of.coordinate().is_some() && term.curve.is_none();
        if !coupling.value.is_zero() || coupling.is_driven() || !coupling.terms.iter().all(of) {
            return Ok(None);
        }
        let named = coupling.terms.iter().filter_map(|term| {
            let (joint, number) = term.of.coordinate()?;
            Some((joint, number, &term.factor))
        });
        let named: Vec<_> = named.collect();
        keys.push("kind", drawn.kind.name());
        let written = match (drawn.kind, &named[..]) {
            (DrawnKind::Gear { is_internal, has_radii }, wheels @ [one, other]) => {
                self.joints(wheels, &mut keys)?;
                let sizes = list([one.2, other.2].map(positive));
                keys.push(if has_radii { "radii" } else { "teeth" }, sizes);
                if is_internal {
                    keys.push("mesh", "internal");
                }
                self.takes(wheels, true)
            }
            (DrawnKind::Ratio, &[second, first]) => {
                self.joints(&[first, second], &mut keys)?;
                keys.push("ratio", other_sign(first.2));
                second.2.text() == "1.0" && self.takes(&[first, second], true)
            }
            (DrawnKind::Belt { is_crossed }, wheels @ [one, other]) => {
                self.joints(wheels, &mut keys)?;
                keys.push("radii", list([one.2, other.2].map(positive)));
                keys.push("crossed", Node::Bool(is_crossed));
                self.takes(wheels, true)
            }
            (DrawnKind::Rack, &[rack, pinion]) => {
                self.joints(&[pinion, rack], &mut keys)?;
                keys.push("radius", other_sign(pinion.2));
                self.takes(&[pinion], true) && self.takes(&[rack], false)
            }
            (DrawnKind::Screw, &[slide, turn]) => {
                if slide.0 == turn.0 {
                    keys.push("joint", self.joint_name(turn.0)?);
                } else {
                    self.joints(&[turn, slide], &mut keys)?;
                }
                keys.push("lead", other_sign(turn.2));
                self.takes(&[turn], true) && self.takes(&[slide], false)
            }
            (DrawnKind::Differential, all @ [a, b, _]) => {
                self.joints(all, &mut keys)?;
                keys.push("teeth", list([a.2, b.2].map(positive)));
                self.takes(all, true)
            }
            _ => false,
        };
        if drawn.is_stated {
            keys.push("sense", "drawn");
        }
        Ok(written.then_some(keys))
    }

    /// The keys of a cam. `None` when the coupling is not a cam, or when the keys of a cam cannot express it.
    fn cam(self, coupling: &Coupling<Number>) -> Result<Option<Keys>, WriteError> {
        let is_cam = coupling.kind == CouplingKind::Cam && coupling.value.is_zero();
        let [follower, shaft] = &coupling.terms[..] else { return Ok(None) };
        let joints = [shaft, follower].map(|term| term.of.coordinate().map(|(joint, _)| joint));
        let ([Some(turn), Some(lift)], Some(lifts)) = (joints, &shaft.curve) else {
            return Ok(None);
        };
        let is_plain = follower.curve.is_none()
            && [(follower, "1.0"), (shaft, "-1.0")]
                .iter()
                .all(|(term, x)| term.factor.text() == *x)
            && [turn, lift].iter().all(|joint| {
                let joint = self.scene.joints.get(joint.index());
                joint.is_some_and(|joint| joint.kind.n_coordinates(self.scene.dimension) == 1)
            });
        if !is_cam || !is_plain || coupling.is_driven() {
            return Ok(None);
        }
        let mut keys = Keys::default();
        keys.push("kind", "cam");
        keys.push("joints", list([self.joint_name(turn)?, self.joint_name(lift)?]));
        curve(&mut keys, lifts);
        Ok(Some(keys))
    }

    /// The terms of a drawn sum, computed in doubles; `None` when the scene is not valid.
    fn found(self, coupling: &Coupling<Number>) -> Option<Vec<CouplingTerm<Number>>> {
        let index = self.scene.couplings.iter().position(|other| core::ptr::eq(other, coupling))?;
        let resolved = self.scene.resolve::<f64>().ok()?;
        let term = |term: &CouplingTerm<f64>| {
            let (joint, number) = term.of.coordinate()?;
            Some(CouplingTerm::of_joint(joint, number, term.factor))
        };
        resolved.couplings[index].terms.iter().map(term).collect()
    }

    fn joints(self, named: &Coordinates<'_>, keys: &mut Keys) -> Result<(), WriteError> {
        let names: Result<Vec<_>, _> = named.iter().map(|named| self.joint_name(named.0)).collect();
        keys.push("joints", list(names?));
        Ok(())
    }

    /// True if each coordinate is the only rotation of its joint about an axis, or with `is_turn` false the only translation. The file then
    /// need not name the coordinates.
    fn takes(self, named: &Coordinates<'_>, is_turn: bool) -> bool {
        named.iter().all(|&(joint, number, _)| {
            let Some(joint) = self.scene.joints.get(joint.index()) else { return false };
            let meant = joint.kind.numbered(self.scene.dimension).filter(|(_, freedom)| {
                let turns = matches!(freedom, Freedom::Turn(_));
                *freedom != Freedom::Ball && turns == is_turn
            });
            meant.map(|(number, _)| number).eq([number])
        })
    }
}

/// The number without its sign; a whole number is written without a decimal point.
fn positive(number: &Number) -> Node {
    let text = number.text();
    let text = text.strip_prefix('-').unwrap_or(&text);
    Node::Number(text.strip_suffix(".0").unwrap_or(text).to_owned())
}

fn other_sign(number: &Number) -> Node {
    let text = number.text();
    Node::Number(text.strip_prefix('-').map_or_else(|| format!("-{text}"), str::to_owned))
}

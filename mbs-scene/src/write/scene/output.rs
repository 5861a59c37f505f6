//! Writes the table `[[output]]`.

use super::{Keys, Node, WriteError, Writer};
use crate::keys::{DEGREES, GLOBAL, OWN_BODY};
use mbs_core::outputs::{RelativePoint, Target, VehicleSide};
use mbs_core::scene::{BodyId, Number, Output};

impl Writer<'_> {
    pub(super) fn output(self, output: &Output<Number>) -> Result<Keys, WriteError> {
        let mut keys = Keys::default();
        keys.push("name", output.name.as_str());
        match output.quantity.target() {
            Target::Point(body, at) => {
                keys.push("body", self.body_name(body)?);
                keys.push("at", self.vector(&at));
            }
            Target::RelativePoint(RelativePoint { body, at, relative_to, origin }) => {
                keys.push("body", self.body_name(body)?);
                keys.push("at", self.vector(&at));
                keys.push("relative_to", self.body_name(relative_to)?);
                keys.push("origin", self.vector(&origin));
            }
            Target::Body(body) => keys.push("body", self.body_name(body)?),
            Target::RelativeBody(body, relative_to) => {
                keys.push("body", self.body_name(body)?);
                keys.push("relative_to", self.body_name(relative_to)?);
            }
            Target::WheelCarrier(of) => {
                keys.push("body", self.body_name(of.body)?);
                keys.push("relative_to", self.body_name(of.relative_to)?);
                let name = VehicleSide::ALL.into_iter().find(|(side, _)| *side == of.side);
                keys.push("side", name.map_or("left", |(_, name)| name));
                keys.push("up", self.vector(&of.up));
                keys.push("forward", self.vector(&of.forward));
                if let Some(axis) = &of.axis {
                    keys.push("axis", self.vector(axis));
                }
            }
            Target::Joint(joint) => keys.push("joint", self.joint_name(joint)?),
            Target::Coupling(coupling) => {
                let coupling = self.scene.couplings.get(coupling.index());
                let coupling = coupling.ok_or(WriteError::UnknownReference("coupling"))?;
                keys.push("coupling", coupling.name.as_str());
            }
            Target::Rolling(rolling) => {
                let rolling = self.scene.rollings.get(rolling.index());
                let rolling = rolling.ok_or(WriteError::UnknownReference("rolling"))?;
                keys.push("rolling", rolling.name.as_str());
            }
            Target::Effect(effect) => {
                let effect = self.scene.effects.get(effect.index()).map(|e| e.name.as_str());
                keys.push("effect", effect.ok_or(WriteError::UnknownReference("effect"))?);
            }
            Target::Signal(signal) => keys.push("signal", self.signal_name(signal)?),
            Target::Scene => {}
        }
        keys.push("quantity", output.quantity.row().name);
        if let Some(frame) = output.frame {
            keys.push("frame", self.axes(frame, output.quantity.target().own_body())?);
        }
        output.magnitude.then(|| keys.push("magnitude", Node::Bool(true)));
        output.is_in_degrees.then(|| keys.push("unit", DEGREES));
        Ok(keys)
    }

    /// The value of the key `frame`: the body to whose axes an output refers. A body whose name is also a word of this key cannot be written.
    fn axes(self, frame: BodyId, own: Option<BodyId>) -> Result<Node, WriteError> {
        if frame == BodyId::Ground {
            return Ok(GLOBAL.into());
        }
        if own == Some(frame) {
            return Ok(OWN_BODY.into());
        }
        let name = self.body_name(frame)?;
        match &name {
            Node::Text(word) if word == GLOBAL || own.is_some() && word == OWN_BODY => {
                let problem = format!("`frame` cannot name the body `{word}`: rename it");
                Err(WriteError::NotWritten(problem))
            }
            _ => Ok(name),
        }
    }
}

//! Writes the table `[[frame]]`.

use super::{Keys, Writer};
use crate::write::WriteError;
use mbs_core::scene::{BodyFrame, Number};

impl Writer<'_> {
    pub(super) fn frame(self, frame: &BodyFrame<Number>) -> Result<Keys, WriteError> {
        let mut keys = Keys::default();
        keys.push("name", frame.name.as_str());
        keys.push("body", self.body_name(frame.body)?);
        keys.push("at", self.vector(&frame.at));
        keys.push_some("axes", frame.axes.as_ref().map(|axes| self.two(axes)));
        Ok(keys)
    }
}

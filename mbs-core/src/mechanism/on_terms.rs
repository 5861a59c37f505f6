//! Effects on sums of coordinates and lengths, and elastic ropes, in code.

use crate::effects::{EFFECTS, EffectKind, Field, Form, LineSpring, Value};
use crate::mechanism::Effect;
use crate::scene::{BodyId, CouplingTerm, Number, Vector3};
use alloc::string::String;
use alloc::vec::Vec;

impl Effect<Number> {
    /// An elastic rope over points of bodies: stiffness [N/m], damping [N s/m]. It is slack below its length in the reference
    /// configuration.
    pub fn rope<P: Into<Vector3>>(
        points: impl IntoIterator<Item = (BodyId, P)>,
        stiffness: impl Into<Number>,
        damping: impl Into<Number>,
    ) -> Self {
        let points = points.into_iter().map(|(body, at)| (body, at.into().0)).collect();
        let (stiffness, damping) = (stiffness.into(), damping.into());
        let rope = LineSpring { points, stiffness, damping, free_length: None, pulls_only: true };
        Self { name: String::new(), enabled: true, kind: rope.into() }
    }

    /// Applies the law to a sum of terms instead of a joint or points. An effect without such a form does not change. A spring along a line
    /// does not change either, since its free length is not a value of a sum.
    #[must_use]
    pub fn on_terms(mut self, terms: Vec<CouplingTerm<Number>>) -> Self {
        let (fields, values) = (self.kind.row().fields, self.kind.values());
        let own = |field: &Field| {
            if field.form == Form::Terms {
                return Some(Value::Terms(terms.clone()));
            }
            if field.form == Form::Flag {
                return Some(Value::Flag(false));
            }
            let is_it = |of: &&Field| (of.key, of.form) == (field.key, field.form);
            let at = fields.iter().position(|of| is_it(&of))?;
            values.get(at).cloned()
        };
        let name = self.kind.row().names.first();
        let on_sum = EFFECTS.iter().position(|row| {
            let first = row.fields.first().map(|field| field.form);
            first == Some(Form::Terms) && name.is_some_and(|name| row.names.contains(name))
        });
        let kind = on_sum.and_then(|row| {
            let values: Option<Vec<_>> = EFFECTS.get(row)?.fields.iter().map(own).collect();
            EffectKind::of(row, values?)
        });
        self.kind = kind.unwrap_or(self.kind);
        self
    }
}

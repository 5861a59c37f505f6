//! Effects on sums in code: a law of one joint's coordinate, taken to a sum of several.

use crate::effects::{EFFECTS, Field, Form, Value};
use crate::scene::{CouplingTerm, Effect, EffectKind, Number};
use alloc::vec::Vec;

impl Effect<Number> {
    /// The same law on a sum of terms, in place of its joint or its points. What has no such form stays as it is; so does a
    /// spring along a line, whose free length is no value of a sum.
    #[must_use]
    pub fn on_terms(mut self, terms: Vec<CouplingTerm<Number>>) -> Self {
        let (fields, values) = (self.kind.row().fields, self.kind.values());
        let own = |field: &Field| {
            if field.form == Form::Terms {
                return Some(Value::Terms(terms.clone()));
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

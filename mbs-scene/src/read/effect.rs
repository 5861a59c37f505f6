//! `[[effect]]`: any kind, by the table of mbs-core.

mod value;

use crate::read::ReadFault;
use crate::read::error::OWNER;
use crate::read::fields::{Fields, Read};
use mbs_core::Real;
use mbs_core::effects::{Default, EFFECTS, Field, Form, Row, Value};
use mbs_core::scene::{AxisFrame, Effect, EffectKind};

const COMMON: [&str; 3] = ["name", "kind", "enabled"];

/// Reads an effect; without a name it is called `effect-N`, counted from 1.
pub(crate) fn read<T: Real>(index: usize, fields: &Fields<'_>) -> Read<Effect<T>> {
    let word = fields.word("kind")?;
    let named: Vec<usize> =
        (0..EFFECTS.len()).filter(|&row| EFFECTS[row].names.contains(&word.0)).collect();
    if named.is_empty() {
        let names: Vec<_> = EFFECTS.iter().flat_map(|row| row.names).copied().collect();
        return fields.unknown_word("kind", word, &names);
    }
    let keys = |row: &'static Row| row.fields.iter().flat_map(Field::keys);
    let mut known = COMMON.to_vec();
    for key in named.iter().flat_map(|&row| keys(&EFFECTS[row])) {
        if !known.contains(&key) {
            known.push(key);
        }
    }
    let elsewhere: Vec<&str> = EFFECTS.iter().flat_map(keys).collect();
    fields.allow(&known, &elsewhere)?;
    let name = match fields.get("name") {
        Some(_) => fields.name()?,
        None => format!("effect-{}", index + 1),
    };
    let enabled = fields.flag("enabled", true)?;
    let row = choose(fields, &named)?;
    let mut values: Vec<Value<T>> = Vec::new();
    for field in EFFECTS[row].fields {
        let value = match value::read(fields, field, word.0)? {
            Some(value) => value,
            None => default(fields, (EFFECTS[row].fields, field), &values)?,
        };
        values.push(value);
    }
    match EffectKind::of(row, values) {
        Some(kind) => Ok(Effect { name, enabled, kind }),
        None => fields.context.fault(fields.header, ReadFault::Missing { key: "kind" }),
    }
}

/// Kinds that share a name differ by their first key.
fn choose(fields: &Fields<'_>, named: &[usize]) -> Read<usize> {
    let first = |row: usize| EFFECTS[row].fields.first().map_or("", |field| field.key);
    match *named {
        [one, other] => {
            fields.exclusive(first(one), first(other))?;
            let is_there = |row: &usize| fields.get(first(*row)).is_some();
            match [one, other].into_iter().find(is_there) {
                Some(row) => Ok(row),
                None => fields.context.fault(fields.header, ReadFault::Missing { key: OWNER }),
            }
        }
        _ => Ok(named[0]),
    }
}

/// What holds where a key is left out; `values` are those of the fields before it.
fn default<T: Real>(
    fields: &Fields<'_>,
    (all, field): (&[Field], &'static Field),
    values: &[Value<T>],
) -> Read<Value<T>> {
    let earlier = |key: &str| {
        let at = all.iter().position(|field| field.key == key);
        match at.and_then(|at| values.get(at)) {
            Some(Value::Number(x)) => *x,
            _ => T::ZERO,
        }
    };
    let decimal = |text: &str| T::from_decimal(text).unwrap_or(T::ZERO);
    match (field.form, field.default) {
        (Form::Six, Default::Number(text)) => Ok(Value::Six([decimal(text); 6])),
        (_, Default::Number(text)) => Ok(Value::Number(decimal(text))),
        (_, Default::As(key)) => Ok(Value::Number(earlier(key))),
        (_, Default::Times(text, key)) => Ok(Value::Number(earlier(key) * decimal(text))),
        (_, Default::NeededWith(key)) if earlier(key).is_zero() => Ok(Value::Number(T::ZERO)),
        (Form::MaybeAxis, Default::Nothing) => Ok(Value::MaybeAxis(None)),
        (Form::Frame, Default::Nothing) => Ok(Value::Frame(AxisFrame::Global)),
        (Form::Side, Default::Nothing) => Ok(Value::Side(None)),
        _ => {
            let key = match field.form {
                Form::Signal(_) => "value or table",
                _ => field.key,
            };
            fields.context.fault(fields.header, ReadFault::Missing { key })
        }
    }
}

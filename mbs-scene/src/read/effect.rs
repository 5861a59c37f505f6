//! Reads `[[effect]]`: effects of any kind, by the table of mbs-core.

mod value;

use crate::read::ReadFault;
use crate::read::coupling::ball_angle;
use crate::read::fields::{Fields, Read};
use crate::read::tree::{Item, Node};
use mbs_core::effects::{Default, EFFECTS, Field, Form, Value};
use mbs_core::scene::{AxisFrame, BallAngle, Effect, EffectKind, Joint, Number, Signal};

/// Reads an effect of any kind. An effect without a name gets the name `effect-N`, where N is its number in the list, from 1.
pub(crate) fn read(
    index: usize,
    fields: &Fields<'_>,
    joints: &[Joint<Number>],
) -> Read<Effect<Number>> {
    let (word, fields) = &fields.kind()?;
    let named: Vec<usize> =
        (0..EFFECTS.len()).filter(|&row| EFFECTS[row].names.contains(word)).collect();
    let on_ball = on_ball(fields, &named, joints)?;
    let name = fields.name_or("effect", index)?;
    let enabled = fields.flag("enabled", true)?;
    let row = match on_ball {
        Some((row, _)) => {
            refuse_others(fields, (row, &named), "coordinate", &["joint", "coordinate"])?;
            row
        }
        None => choose(fields, &named)?,
    };
    let fields = &on_coordinate(fields, joints)?;
    let is_swing = on_ball.is_some_and(|(_, angle)| angle == BallAngle::Swing);
    let all = EFFECTS[row].fields;
    let written = all.iter().map(|field| value::read(fields, field, (word, joints)));
    let written: Vec<Option<Value<Number>>> = written.collect::<Read<_>>()?;
    let value = |i: usize| match &written[i] {
        Some(value) => {
            if let Default::NeededWithout(flag) = all[i].default
                && fields.flag(flag, false)?
            {
                fields.exclusive(flag, all[i].key)?;
            }
            Ok(value.clone())
        }
        // The swing angle is never below zero, so its lower limit is not needed.
        None if is_swing && all[i].key == "lower" => {
            Ok(Value::Number(Number::from(-core::f64::consts::PI)))
        }
        None => default(fields, (all, &written), i),
    };
    let values: Vec<_> = (0..all.len()).map(value).collect::<Read<_>>()?;
    match EffectKind::of(row, values) {
        Some(kind) => Ok(Effect { name, enabled, kind }),
        None => fields.context.fault(fields.header, ReadFault::Missing { key: "kind" }),
    }
}

/// Returns the fields with the units of the coordinate on which the effect acts. It is the coordinate that the file names, or the joint's
/// only one.
fn on_coordinate<'a>(fields: &Fields<'a>, joints: &[Joint<Number>]) -> Read<Fields<'a>> {
    let Some(joint) = fields.get("joint") else { return Ok(*fields) };
    let joint = &joints[fields.context.joint(joint)?.index()];
    let angles = BallAngle::ALL.map(BallAngle::name);
    Ok(match fields.get("coordinate") {
        Some(Item { node: Node::Text(word), .. }) if angles.contains(&word.as_str()) => *fields,
        Some(item) => fields.about(joint.kind, fields.coordinate(item, joint)?),
        None if joint.kind.n_coordinates(fields.context.dimension) == 1 => {
            fields.about(joint.kind, 0)
        }
        None => *fields,
    })
}

/// Finds the kind of effect for an angle of a ball joint, and the angle. `named` are the kinds with the same name. An effect on such an angle
/// is read as the kind on a sum instead of the kind on a joint. `None` when the effect acts on anything else.
fn on_ball(
    fields: &Fields<'_>,
    named: &[usize],
    joints: &[Joint<Number>],
) -> Read<Option<(usize, BallAngle)>> {
    let mut forms = named.iter().map(|&row| first_form(row));
    let on_sum = named.iter().copied().find(|&row| first_form(row) == Some(Form::Terms));
    let Some(row) = on_sum.filter(|_| forms.any(|form| matches!(form, Some(Form::Joint(_)))))
    else {
        return Ok(None);
    };
    let angle = if fields.get("terms").is_none() { ball_angle(fields, joints)? } else { None };
    if angle.is_none() {
        fields.unused(&["axis"])?;
    }
    Ok(angle.map(|angle| (row, angle)))
}

/// Chooses among the kinds `named` of the same name, by their first key. The keys of the other kinds are refused for a kind on a sum or on a
/// line.
fn choose(fields: &Fields<'_>, named: &[usize]) -> Read<usize> {
    let first = |row: usize| EFFECTS[row].fields.first().map_or("", |field| field.key);
    let is_line = |row: usize| first_form(row) == Some(Form::Line);
    let is_extra = |row: usize| is_line(row) || first_form(row) == Some(Form::Terms);
    if let Some(&row) = named.iter().find(|row| is_line(**row))
        && has_line(fields, row)
    {
        let but: &[_] = if has_tables(fields, "points") { &[] } else { &["bodies"] };
        return refuse_others(fields, (row, named), first(row), but).map(|()| row);
    }
    let usual = || named.iter().copied().filter(|&row| !is_line(row));
    for (i, one) in usual().enumerate() {
        usual().skip(i + 1).try_for_each(|other| fields.exclusive(first(one), first(other)))?;
    }
    if let Some(row) = usual().find(|row| fields.get(first(*row)).is_some()) {
        if is_extra(row) {
            refuse_others(fields, (row, named), first(row), &[])?;
        }
        return Ok(row);
    }
    // An effect without a sum or a line is of one of the other kinds.
    let mut others = usual().filter(|&row| !is_extra(row));
    match (others.next(), others.next()) {
        (Some(row), None) => Ok(row),
        _ => fields.context.fault(fields.header, ReadFault::Missing { key: "body or joint" }),
    }
}

/// True if the effect acts on a line. Either `points` has points with bodies, or an effect between two bodies has a flag of the kind on a
/// line.
fn has_line(fields: &Fields<'_>, row: usize) -> bool {
    let is_flagged = EFFECTS[row]
        .fields
        .iter()
        .any(|field| field.form == Form::Flag && fields.get(field.key).is_some());
    let is_between = fields.get("bodies").is_some() && fields.get("terms").is_none();
    has_tables(fields, "points") || (is_flagged && is_between)
}

/// True if the value at a key is a list of tables that are not places relative to points.
fn has_tables(fields: &Fields<'_>, key: &str) -> bool {
    match fields.get(key).map(|item| &item.node) {
        Some(Node::List(items)) => items
            .first()
            .is_some_and(|item| matches!(item.node, Node::Table(_)) && item.get("of").is_none()),
        _ => false,
    }
}

/// Refuses the keys that only other kinds of the same name have, except those in `but`. The error says that `key` excludes them.
fn refuse_others(
    fields: &Fields<'_>,
    (row, named): (usize, &[usize]),
    key: &'static str,
    but: &[&str],
) -> Read<()> {
    let keys = |row: usize| EFFECTS[row].fields.iter().flat_map(Field::keys);
    let others = named.iter().flat_map(|&other| keys(other));
    let mut foreign =
        others.filter(|other| !but.contains(other) && keys(row).all(|own| own != *other));
    foreign.try_for_each(|other| fields.exclusive(key, other))
}

/// The form of the first field of a kind.
fn first_form(row: usize) -> Option<Form> {
    EFFECTS[row].fields.first().map(|field| field.form)
}

/// Value of field `i` when its key is not written.
fn default(
    fields: &Fields<'_>,
    (all, written): (&'static [Field], &[Option<Value<Number>>]),
    i: usize,
) -> Read<Value<Number>> {
    let field = &all[i];
    let other = |key: &str| {
        let at = all.iter().position(|field| field.key == key).filter(|at| *at != i);
        let Some(at) = at else { return Ok(Number::ZERO) };
        let value = match written.get(at) {
            Some(Some(value)) => value.clone(),
            _ => default(fields, (all, written), at)?,
        };
        Ok(if let Value::Number(x) = value { x } else { Number::ZERO })
    };
    let decimal = |text: &str| Number::from_decimal(text).unwrap_or_default();
    let is_open = |key: &str| other(key).map(|x| x.is_open());
    let is_true = |key: &str| fields.flag(key, false);
    match (field.form, field.default) {
        (_, Default::NeededWithout(key)) if is_true(key)? => {
            return Ok(Value::Number(Number::open()));
        }
        (_, Default::Open) => return Ok(Value::Number(Number::open())),
        (_, Default::OpenWith(key)) => {
            let number = if is_open(key)? { Number::open() } else { Number::ZERO };
            return Ok(Value::Number(number));
        }
        (Form::Flag, Default::Nothing) => return Ok(Value::Flag(false)),
        (Form::Length, Default::Nothing) => return Ok(Value::Length(None)),
        (Form::Six, Default::Number(text)) => {
            return Ok(Value::Six(core::array::from_fn(|_| decimal(text))));
        }
        (Form::Signal(_), Default::Number(text)) => {
            return Ok(Value::Signal(Signal::Constant([
                decimal(text),
                Number::ZERO,
                Number::ZERO,
            ])));
        }
        (_, Default::Number(text)) => return Ok(Value::Number(decimal(text))),
        (_, Default::As(key)) => return other(key).map(Value::Number),
        (_, Default::Times(text, key)) => {
            return other(key).map(|x| Value::Number(x * decimal(text)));
        }
        (_, Default::NeededWith(key)) if other(key)?.is_zero() => {
            return Ok(Value::Number(Number::ZERO));
        }
        (Form::Coordinate, Default::Nothing) => return Ok(Value::Coordinate(None)),
        (Form::MaybeAxis, Default::Nothing) => return Ok(Value::MaybeAxis(None)),
        (Form::Frame, Default::Nothing) => return Ok(Value::Frame(AxisFrame::Global)),
        (Form::Side, Default::Nothing) => return Ok(Value::Side(None)),
        (Form::Spin, Default::Nothing) => return Ok(Value::Spin(None)),
        (Form::Slip, Default::Nothing) => return Ok(Value::Slip(None)),
        _ => {}
    }
    let key = match field.form {
        Form::Signal(_) => "value, table or signal",
        _ => field.key,
    };
    fields.context.fault(fields.header, ReadFault::Missing { key })
}

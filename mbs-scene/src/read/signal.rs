//! Reads `[[signal]]`, and references to signals by name.

use crate::read::coupling::{need_curve, one, read_measure};
use crate::read::fields::{Context, Fields, Read};
use crate::read::table;
use crate::read::tree::{Item, Node};
use mbs_core::scene::{Joint, NamedSignal, Number, SignalId, SignalKind};

/// Reads a signal of any kind.
pub(crate) fn read<'a>(
    fields: &Fields<'a>,
    joints: &'a [Joint<Number>],
) -> Read<NamedSignal<Number>> {
    let (word, fields) = &fields.kind()?;
    Ok(NamedSignal { name: fields.name()?, kind: kind(fields, word, joints)? })
}

fn kind<'a>(
    fields: &Fields<'a>,
    word: &str,
    joints: &'a [Joint<Number>],
) -> Read<SignalKind<Number>> {
    let (number, or_zero) = (|key| fields.number(key), |key| fields.number_or_zero(key));
    Ok(match word {
        "constant" => SignalKind::Constant(number("value")?),
        "table" => {
            let (rows, interpolation, periodic) = table::of_signal(fields)?;
            SignalKind::Table { rows, interpolation, periodic }
        }
        "sine" => SignalKind::Sine {
            amplitude: number("amplitude")?,
            frequency: number("frequency")?,
            phase: or_zero("phase")?,
            offset: or_zero("offset")?,
        },
        "chirp" => SignalKind::Chirp {
            amplitude: number("amplitude")?,
            frequency: number("frequency")?,
            to_frequency: number("to_frequency")?,
            duration: number("duration")?,
            phase: or_zero("phase")?,
            offset: or_zero("offset")?,
        },
        "ramp" => SignalKind::Ramp {
            rate: number("rate")?,
            start: or_zero("start")?,
            end: fields.optional("end")?,
            rounding: or_zero("rounding")?,
        },
        "step" => SignalKind::Step {
            from: or_zero("from")?,
            to: number("to")?,
            at: or_zero("at")?,
            rise: or_zero("rise")?,
        },
        "sum" => {
            let of = list(fields)?;
            let factors = match fields.get("factors") {
                Some(item) => fields.context.numbers(item)?,
                None => of.iter().map(|_| one()).collect(),
            };
            SignalKind::Sum { of, factors }
        }
        "product" => SignalKind::Product { of: list(fields)? },
        "curve" => SignalKind::Curve { of: single(fields)?, curve: need_curve(fields)? },
        "clamp" => SignalKind::Clamp {
            of: single(fields)?,
            lower: number("lower")?,
            upper: number("upper")?,
        },
        "limit-ratio" => SignalKind::LimitRatio {
            of: single(fields)?,
            lower: number("lower")?,
            upper: number("upper")?,
        },
        "measure" | "lag" | "integral" | "pid" => feedback(fields, word, joints)?,
        _ => {
            let unit = fields.get("unit").map_or(Ok(""), |item| fields.context.text(item))?;
            SignalKind::Input { value: or_zero("value")?, unit: unit.to_owned() }
        }
    })
}

/// Reads the kinds of signals that depend on the motion or have a state.
fn feedback<'a>(
    fields: &Fields<'a>,
    word: &str,
    joints: &'a [Joint<Number>],
) -> Read<SignalKind<Number>> {
    let or_zero = |key| fields.number_or_zero(key);
    Ok(match word {
        "measure" => measure(fields, joints)?,
        "lag" => SignalKind::Lag {
            of: single(fields)?,
            time: fields.number("time")?,
            value: or_zero("value")?,
        },
        "integral" => SignalKind::Integral {
            of: single(fields)?,
            lower: fields.optional("lower")?,
            upper: fields.optional("upper")?,
            value: or_zero("value")?,
        },
        _ => SignalKind::Pid {
            of: [named(fields, "target")?, named(fields, "measured")?],
            p: or_zero("p")?,
            i: or_zero("i")?,
            d: or_zero("d")?,
            limit: fields.optional("limit")?,
        },
    })
}

/// Reads a measure, or its rate: a coordinate of a joint, a length over points or an angle of a ball joint. A joint without the coordinate
/// is left for the check of the scene.
fn measure<'a>(fields: &Fields<'a>, joints: &'a [Joint<Number>]) -> Read<SignalKind<Number>> {
    let of = read_measure(fields, joints)?;
    let is_rate = match fields.get("quantity").map(|_| fields.word("quantity")).transpose()? {
        None | Some(("value", _)) => false,
        Some(("rate", _)) => true,
        Some(word) => return fields.unknown_word("quantity", word, &["value", "rate"]),
    };
    Ok(SignalKind::Measure { of, is_rate })
}

fn single(fields: &Fields<'_>) -> Read<SignalId> {
    named(fields, "of")
}

fn named(fields: &Fields<'_>, key: &'static str) -> Read<SignalId> {
    fields.context.signal(fields.need(key)?)
}

fn list(fields: &Fields<'_>) -> Read<Vec<SignalId>> {
    let items = fields.context.list(fields.need("of")?, "a list of names of signals")?;
    items.iter().map(|item| fields.context.signal(item)).collect()
}

/// Reads the components of a signal: one name, or a list of names.
pub(crate) fn components<'a>(context: &Context<'a>, item: &'a Item) -> Read<[Option<SignalId>; 3]> {
    let items = match &item.node {
        Node::List(items) if !items.is_empty() && items.len() <= 3 => &items[..],
        Node::List(_) => return context.exactly::<3>(item, NAMES).map(|_| [None; 3]),
        _ => core::slice::from_ref(item),
    };
    let mut signals = [None; 3];
    for (signal, item) in signals.iter_mut().zip(items) {
        *signal = Some(context.signal(item)?);
    }
    Ok(signals)
}

const NAMES: &str = "the name of a signal, or a list of names";

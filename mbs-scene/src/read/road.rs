//! Reads `[road]`: features for all wheels, or separate features for the left and the right wheels.

use crate::keys::{self, FEATURE};
use crate::read::fields::{Context, Fields, Read};
use crate::read::table;
use crate::read::tree::{Item, Node};
use mbs_core::scene::{Number, Road, RoadFeature};

/// Largest number of steps of a staircase [-]. A larger number is refused as a mistake. Chosen, not tuned.
const MOST_STEPS: u32 = 10_000;
/// Default length of the rounded corners of a ramp, as a fraction of the length of the ramp [-].
const ROUNDING: &str = "0.1";

/// Reads the road of a scene. A single feature may be written in `[road]` itself.
pub(crate) fn read(fields: &Fields<'_>) -> Read<Road<Number>> {
    let speed = fields.number_or_zero("speed")?;
    let both =
        |features: Vec<_>| Road { left: features.clone(), right: features, speed: speed.clone() };
    if fields.get("kind").is_some() {
        for key in ["features", "left", "right"] {
            fields.exclusive("kind", key)?;
        }
        return Ok(both(vec![feature(fields)?]));
    }
    let several = keys::together(fields.tables, |table| table.kind.is_none());
    let fields = &fields.checked_by(several)?;
    if let Some(item) = fields.get("features") {
        fields.exclusive("features", "left")?;
        fields.exclusive("features", "right")?;
        return Ok(both(features(&fields.context, item)?));
    }
    if fields.get("left").is_none() && fields.get("right").is_none() {
        return Ok(both(Vec::new()));
    }
    let track = |key| features(&fields.context, fields.need(key)?);
    Ok(Road { left: track("left")?, right: track("right")?, speed })
}

/// Reads a feature or a list of features.
fn features(context: &Context<'_>, item: &Item) -> Read<Vec<RoadFeature<Number>>> {
    let form = "a feature { kind = .. }, or a list of them";
    if let Node::Table(_) = item.node {
        return Ok(vec![feature(&context.table(item, form, FEATURE)?)?]);
    }
    context
        .list(item, form)?
        .iter()
        .map(|item| feature(&context.table(item, form, FEATURE)?))
        .collect()
}

/// Reads one feature of a road.
fn feature(fields: &Fields<'_>) -> Read<RoadFeature<Number>> {
    let (kind, fields) = &fields.kind()?;
    Ok(match *kind {
        "flat" => RoadFeature::Flat { height: fields.number_or_zero("height")? },
        "ramp" => ramp(fields)?,
        "stairs" => stairs(fields)?,
        "bump" => bump(fields)?,
        _ => table::of_road(fields)?,
    })
}

fn ramp(fields: &Fields<'_>) -> Read<RoadFeature<Number>> {
    let length: Number = fields.number("length")?;
    let rounding = match fields.optional("rounding")? {
        Some(rounding) => rounding,
        None => length.clone() * fields.number_or("rounding", ROUNDING)?,
    };
    let (start, height) = (fields.number("start")?, fields.number("height")?);
    Ok(RoadFeature::Rise { start, length, height, rounding })
}

fn stairs(fields: &Fields<'_>) -> Read<RoadFeature<Number>> {
    Ok(RoadFeature::Stairs {
        start: fields.number("start")?,
        height: fields.number("height")?,
        riser: fields.number("riser")?,
        tread: fields.number("tread")?,
        count: fields.count("count", MOST_STEPS)?,
    })
}

/// Reads a bump of a road. Its `amplitude` is half the height, and `1-cos` and `cosine` are two names of one shape.
fn bump(fields: &Fields<'_>) -> Read<RoadFeature<Number>> {
    if fields.get("shape").is_some() {
        match fields.word("shape")? {
            ("1-cos" | "cosine", _) => {}
            word => return fields.unknown_word("shape", word, &["1-cos", "cosine"]),
        }
    }
    fields.exclusive("amplitude", "height")?;
    let amplitude = match fields.optional("height")? {
        Some(height) => height * Number::HALF,
        None => fields.number("amplitude")?,
    };
    let (start, length) = (fields.number("start")?, fields.number("length")?);
    Ok(RoadFeature::Bump { start, length, amplitude })
}

/// The table of the file from which feature `index` of a track of the scene was read.
pub(crate) fn item_of<'a>(road: &'a Item, track: &str, index: usize) -> Option<&'a Item> {
    if !matches!(road.node, Node::Table(_)) {
        return None;
    }
    let item = road.get(track).or_else(|| road.get("features"));
    let items = match item {
        None => core::slice::from_ref(road),
        Some(Item { node: Node::List(items), .. }) => items,
        Some(item) => core::slice::from_ref(item),
    };
    items.get(index)
}

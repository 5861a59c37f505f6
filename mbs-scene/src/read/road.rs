//! `[road]`: features under all wheels, or different ones on the left and on the right.

use crate::read::ReadFault;
use crate::read::fields::{Context, Fields, Read};
use crate::read::tree::{Item, Member, Node};
use mbs_core::Real;
use mbs_core::scene::{Entry, Road, RoadFeature, SceneError, SceneFault};

/// A kind of feature and its keys.
const KINDS: [(&str, &[&str]); 5] = [
    ("flat", &["height"]),
    ("ramp", &["start", "length", "height", "rounding"]),
    ("stairs", &["start", "tread", "riser", "height", "count"]),
    ("bump", &["start", "length", "amplitude", "height", "shape"]),
    ("table", &["points"]),
];
const TRACKS: [&str; 4] = ["features", "left", "right", "speed"];
/// Steps of one staircase at most.
const MOST_STEPS: u32 = 10_000;
/// Rounded corners of a ramp as a share of its length, where none is written.
const ROUNDING: &str = "0.1";

/// Reads the road. One feature may stand in `[road]` itself.
pub(crate) fn read<T: Real>(fields: &Fields<'_>) -> Read<Road<T>> {
    let speed = fields.number_or_zero("speed")?;
    let both = |features: Vec<_>| Road { left: features.clone(), right: features, speed };
    if fields.get("kind").is_some() {
        for key in ["features", "left", "right"] {
            fields.exclusive("kind", key)?;
        }
        return Ok(both(feature(fields, &["speed"])?));
    }
    fields.allow(&TRACKS, &elsewhere())?;
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

fn elsewhere() -> Vec<&'static str> {
    KINDS.iter().flat_map(|(_, keys)| *keys).copied().collect()
}

/// A list of features, or one.
fn features<T: Real>(context: &Context<'_>, item: &Item) -> Read<Vec<RoadFeature<T>>> {
    let form = "a feature { kind = .. }, or a list of them";
    if let Node::Table(_) = item.node {
        return feature(&context.table(item, form)?, &[]);
    }
    let lists =
        context.list(item, form)?.iter().map(|item| feature(&context.table(item, form)?, &[]));
    Ok(lists.collect::<Read<Vec<_>>>()?.concat())
}

/// One feature of the file; stairs become several of the scene.
fn feature<T: Real>(fields: &Fields<'_>, beside: &[&'static str]) -> Read<Vec<RoadFeature<T>>> {
    let word = fields.word("kind")?;
    let Some((kind, keys)) = KINDS.iter().find(|(name, _)| *name == word.0) else {
        return fields.unknown_word("kind", word, &KINDS.map(|(name, _)| name));
    };
    fields.allow(&[&["kind"], beside, *keys].concat(), &elsewhere())?;
    Ok(match *kind {
        "flat" => vec![RoadFeature::Flat { height: fields.number_or_zero("height")? }],
        "ramp" => vec![ramp(fields)?],
        "stairs" => stairs(fields)?,
        "bump" => vec![bump(fields)?],
        _ => vec![RoadFeature::Table(points(fields)?)],
    })
}

fn ramp<T: Real>(fields: &Fields<'_>) -> Read<RoadFeature<T>> {
    let length: T = fields.number("length")?;
    let rounding = match fields.optional("rounding")? {
        Some(rounding) => rounding,
        None => length * fields.number_or::<T>("rounding", ROUNDING)?,
    };
    let (start, height) = (fields.number("start")?, fields.number("height")?);
    Ok(RoadFeature::Rise { start, length, height, rounding })
}

/// Risers, each with a tread behind it: rise i begins at start + i (tread + riser). A riser is all rounding, without a
/// straight part.
fn stairs<T: Real>(fields: &Fields<'_>) -> Read<Vec<RoadFeature<T>>> {
    let (start, height): (T, T) = (fields.number("start")?, fields.number("height")?);
    let (riser, tread): (T, T) = (fields.number("riser")?, fields.number("tread")?);
    if !(riser > T::ZERO) {
        return refuse(fields, "riser", SceneFault::NotPositive(riser.to_f64()));
    }
    if !(tread >= T::ZERO) {
        return refuse(fields, "tread", SceneFault::Negative(tread.to_f64()));
    }
    let rise = |i: u32| RoadFeature::Rise {
        start: start + T::from_f64(f64::from(i)) * (tread + riser),
        length: riser,
        height,
        rounding: riser * T::HALF,
    };
    Ok((0..fields.count("count", MOST_STEPS)?).map(rise).collect())
}

/// A fault that the scene's check would tell of another key.
fn refuse<R>(fields: &Fields<'_>, field: &'static str, fault: SceneFault) -> Read<R> {
    let error = SceneError { entry: Entry::Road, field, fault };
    fields.context.fault(&fields.need(field)?.span, ReadFault::Scene(error))
}

/// `amplitude` is half the height; `1-cos` and `cosine` are two names of one shape.
fn bump<T: Real>(fields: &Fields<'_>) -> Read<RoadFeature<T>> {
    if fields.get("shape").is_some() {
        match fields.word("shape")? {
            ("1-cos" | "cosine", _) => {}
            word => return fields.unknown_word("shape", word, &["1-cos", "cosine"]),
        }
    }
    fields.exclusive("amplitude", "height")?;
    let amplitude = match fields.optional::<T>("height")? {
        Some(height) => height * T::HALF,
        None => fields.number("amplitude")?,
    };
    let (start, length) = (fields.number("start")?, fields.number("length")?);
    Ok(RoadFeature::Bump { start, length, amplitude })
}

fn points<T: Real>(fields: &Fields<'_>) -> Read<Vec<[T; 2]>> {
    let context = fields.context;
    let items = context.list(fields.need("points")?, "a list of points [x, z]")?;
    items.iter().map(|item| context.numbers_of(item, "a point [x, z]")).collect()
}

/// The table of the file that gave feature `index` of a track of the scene.
pub(crate) fn item_of<'a>(road: &'a Item, track: &str, index: usize) -> Option<&'a Item> {
    let Node::Table(members) = &road.node else { return None };
    let find = |key: &str| members.iter().find(|m| m.key == key).map(|m| &m.item);
    let item = find(track).or_else(|| find("features"));
    let items = match item {
        None => core::slice::from_ref(road),
        Some(Item { node: Node::List(items), .. }) => items,
        Some(item) => core::slice::from_ref(item),
    };
    let mut end = 0;
    items.iter().find(|item| {
        end += n_features(item);
        index < end
    })
}

/// How many features of the scene one of the file becomes.
fn n_features(item: &Item) -> usize {
    let Node::Table(members) = &item.node else { return 1 };
    let count = |m: &Member| match &m.item.node {
        Node::Number(text) if m.key == "count" => text.parse().ok(),
        _ => None,
    };
    members.iter().find_map(count).unwrap_or(1)
}

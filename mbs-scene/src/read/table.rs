//! Reads rows of tables, and the interpolation between them.

use super::ReadFault;
use super::fields::{Context, Fields, Read};
use mbs_core::scene::{
    Curve, CurveShape, Entry, Interpolation, Motion, Number, RoadFeature, SceneError, SceneFault,
    TableEnds,
};

/// The words of the key `interpolation`; `hold` is allowed for signals alone.
const WORDS: [&str; 4] = ["spline", "monotone", "linear", "hold"];

/// The word at `interpolation`, among the first `n_words`. Default: `spline`.
fn word<'a>(fields: &Fields<'a>, n_words: usize) -> Read<&'a str> {
    if fields.get("interpolation").is_none() {
        return Ok(WORDS[0]);
    }
    let word = fields.word("interpolation")?;
    let known = &WORDS[..n_words];
    if known.contains(&word.0) {
        Ok(word.0)
    } else {
        fields.unknown_word("interpolation", word, known)
    }
}

/// Shape of the curve between the rows. `None` for a spline, which needs conditions at its ends.
fn shape(fields: &Fields<'_>) -> Read<Option<CurveShape>> {
    Ok(match word(fields, 3)? {
        "monotone" => Some(CurveShape::Monotone),
        "linear" => Some(CurveShape::Linear),
        _ => None,
    })
}

fn ends(fields: &Fields<'_>) -> Read<TableEnds> {
    if fields.get("ends").is_none() {
        return Ok(TableEnds::default());
    }
    match fields.word("ends")? {
        ("natural", _) => Ok(TableEnds::Natural),
        ("level", _) => Ok(TableEnds::Level),
        word => fields.unknown_word("ends", word, &["natural", "level"]),
    }
}

/// Reads pairs of numbers at a key.
fn rows<'a>(
    (context, fields): (Context<'a>, &Fields<'a>),
    key: &'static str,
    form: [&'static str; 2],
) -> Read<Vec<[Number; 2]>> {
    let items = context.list(fields.need(key)?, form[0])?;
    items.iter().map(|row| context.numbers_of(row, form[1])).collect()
}

fn over_time(fields: &Fields<'_>) -> Read<Vec<[Number; 2]>> {
    rows(
        (fields.at("table"), fields),
        "table",
        ["a list of rows [time, value]", "a row [time, value]"],
    )
}

/// The rows of a signal, their interpolation, and whether the table repeats.
pub(crate) fn of_signal(fields: &Fields<'_>) -> Read<(Vec<[Number; 2]>, Interpolation, bool)> {
    let periodic = fields.flag("periodic", false)?;
    let interpolation = match word(fields, 4)? {
        "linear" => Interpolation::Linear,
        "hold" => Interpolation::Hold,
        word => {
            if periodic {
                fields.exclusive("periodic", "ends")?;
            }
            let ends = ends(fields)?;
            if word == "monotone" {
                Interpolation::Monotone(ends)
            } else {
                Interpolation::Spline(ends)
            }
        }
    };
    if interpolation.ends().is_none() {
        fields.exclusive("interpolation", "ends")?;
    }
    Ok((over_time(fields)?, interpolation, periodic))
}

/// The table of a guide or a coupling over time. A linear table is refused: it has corners, where the acceleration is unbounded.
pub(crate) fn of_motion(fields: &Fields<'_>) -> Read<Motion<Number>> {
    let (rows, ends) = (over_time(fields)?, ends(fields)?);
    match word(fields, 3)? {
        "spline" => Ok(Motion::Table { rows, ends }),
        "monotone" => Ok(Motion::Monotone { rows, ends }),
        _ => {
            let (entry, field) = (Entry::Scene, "interpolation");
            let error = SceneError { entry, field, fault: SceneFault::LinearTable };
            fields.context.fault(&fields.need(field)?.span, ReadFault::Scene(error))
        }
    }
}

/// Reads a function of a number. `None` if the file has no function there.
pub(crate) fn of_curve(fields: &Fields<'_>) -> Read<Option<Curve<Number>>> {
    fields.exclusive("table", "coefficients")?;
    let context = fields.context;
    if let Some(item) = fields.get("coefficients") {
        fields.exclusive("coefficients", "interpolation")?;
        return Ok(Some(Curve::Polynomial(context.numbers(item)?)));
    }
    if fields.get("table").is_none() {
        fields.unused(&["interpolation"])?;
        return Ok(None);
    }
    // The numbers of a curve may have any unit.
    let form = ["a list of rows [x, f]", "a row [x, f]"];
    let rows = rows((context, fields), "table", form)?;
    let periodic = fields.flag("periodic", false)?;
    Ok(Some(match (shape(fields)?, periodic) {
        (Some(shape), periodic) => Curve::Shaped { rows, shape, periodic },
        (None, true) => Curve::Periodic(rows),
        (None, false) => Curve::Table(rows),
    }))
}

/// Reads a feature of a road whose heights are given by points.
pub(crate) fn of_road(fields: &Fields<'_>) -> Read<RoadFeature<Number>> {
    let form = ["a list of points [x, z]", "a point [x, z]"];
    let points = rows((fields.at("points"), fields), "points", form)?;
    Ok(match shape(fields)? {
        Some(shape) => RoadFeature::Shaped { points, shape },
        None => RoadFeature::Table(points),
    })
}

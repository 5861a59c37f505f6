//! Reads `[[coupling]]`: couplings of every kind become a sum of joint coordinates and lengths.
//!
//! ```text
//! gear          N1 a1 + N2 a2 = 0   external about axes of the same sense; internal: N1 a1 - N2 a2 = 0
//! belt          r1 a1 - r2 a2 = 0;  crossed: +
//! rack          s - r a = 0                 screw         s - lead/(2 pi) a = 0
//! differential  Na (a - c) + Nb (b - c) = 0  mimic         x - factor y = offset
//! cam           x - f(y) = 0                rope          length + radius a = value
//! ```
//!
//! The keys `at` and `pressure_angle` give the point of contact of two wheels and the direction of the contact force.

mod carrier;
mod named;

use self::named::{Named, Needed};
use crate::read::ReadFault;
use crate::read::fields::{Context, Fields, Read, counted};
use crate::read::motion::read_motion;
use crate::read::table;
use crate::read::tree::{Item, Node};
pub(crate) use carrier::{joint_to_add, no_carrier};
use mbs_core::scene::{
    Axis, BallAngle, Coupling, CouplingKind, CouplingMeasure, CouplingTerm, Curve, Drawn,
    DrawnKind, Freedom, Joint, JointId, Mesh, Motion, Number,
};

/// Largest number of teeth of a wheel [-]. A larger number is refused as a mistake. Chosen, not tuned.
const MAX_TEETH: u32 = 1_000_000;

/// Sum that a coupling becomes: its terms, its value, and the motion that drives it.
type Sum = (Vec<CouplingTerm<Number>>, Number, Option<Motion<Number>>);

/// Reads a coupling of any kind. A coupling without a name gets the name `coupling-N`, where N is its number in the list, from 1.
pub(crate) fn read<'a>(
    index: usize,
    fields: &Fields<'a>,
    joints: &'a [Joint<Number>],
) -> Read<Coupling<Number>> {
    let (kind, fields) = &fields.kind()?;
    let held = |terms| (terms, Number::ZERO, None);
    let (terms, value, motion) = match *kind {
        "gear" => held(gear(fields, joints)?),
        "rack" => {
            let [pinion, rack] = pair(fields, joints)?;
            let radius = minus(fields.number("radius")?);
            held(vec![rack.term(fields, Needed::Slide, one())?, pinion.turn(fields, radius)?])
        }
        "screw" => held(screw(fields, joints)?),
        "belt" => {
            let ([first, second], [r1, r2]) = (pair(fields, joints)?, radii(fields)?);
            let r2 = if fields.flag("crossed", false)? { r2 } else { minus(r2) };
            held(vec![first.turn(fields, r1)?, second.turn(fields, r2)?])
        }
        "mimic" => {
            let [joint, of] =
                ["joint", "of"].map(|key| Named::new(fields, fields.need(key)?, joints));
            let factor = minus(fields.number_or("factor", "1")?);
            let terms = vec![
                joint?.term(fields, Needed::Only, one())?,
                of?.term(fields, Needed::Only, factor)?,
            ];
            (terms, fields.number_or_zero("offset")?, None)
        }
        "differential" => held(differential(fields, joints)?),
        "cam" => {
            let [shaft, follower] = pair(fields, joints)?;
            let curve = Some(need_curve(fields)?);
            let of_shaft =
                CouplingTerm { curve, ..shaft.term(fields, Needed::Only, minus(one()))? };
            held(vec![follower.term(fields, Needed::Only, one())?, of_shaft])
        }
        "rope" => rope(fields, joints)?,
        _ => {
            let terms = read_terms(fields, fields.need("terms")?, joints)?;
            (terms, fields.number_or_zero("value")?, read_motion(fields)?)
        }
    };
    let name = fields.name_or("coupling", index)?;
    let drawn = read_drawn(kind, fields)?;
    let kind = match (*kind, read_mesh(fields)?) {
        ("rope", _) => CouplingKind::Rope,
        ("cam", _) => CouplingKind::Cam,
        (_, Some(mesh)) => CouplingKind::Mesh(mesh),
        ("belt", None) => match fields.optional("pretension")? {
            Some(pretension) => CouplingKind::Strands { pretension },
            None => CouplingKind::General,
        },
        _ => CouplingKind::General,
    };
    Ok(Coupling { name, terms, relation: None, value, motion, kind, drawn })
}

/// Reads the rule by which the signs of the sum follow from the places and axes of the joints. `None` for kinds whose terms are written with
/// their signs. `is_stated` is true if the file has `sense = "drawn"`.
fn read_drawn(kind: &str, fields: &Fields<'_>) -> Read<Option<Drawn>> {
    let kind = match kind {
        "gear" if fields.get("ratio").is_some() => {
            fields.exclusive("ratio", "sense")?;
            return Ok(Some(DrawnKind::Ratio.drawn()));
        }
        "gear" => DrawnKind::Gear {
            is_internal: is_internal(fields)?,
            has_radii: fields.get("radii").is_some(),
        },
        "belt" => DrawnKind::Belt { is_crossed: fields.flag("crossed", false)? },
        "rack" => DrawnKind::Rack,
        "screw" => DrawnKind::Screw,
        "differential" => DrawnKind::Differential,
        _ => return Ok(None),
    };
    let is_stated = match fields.get("sense").map(|_| fields.word("sense")).transpose()? {
        None => false,
        Some(("drawn", _)) => true,
        Some(word) => return fields.unknown_word("sense", word, &["drawn"]),
    };
    Ok(Some(Drawn { is_stated, ..kind.drawn() }))
}

/// True if one wheel is inside the other (`mesh = "internal"`).
fn is_internal(fields: &Fields<'_>) -> Read<bool> {
    match fields.get("mesh").map(|_| fields.word("mesh")).transpose()? {
        None | Some(("external", _)) => Ok(false),
        Some(("internal", _)) => Ok(true),
        Some(word) => fields.unknown_word("mesh", word, &["external", "internal"]),
    }
}

/// Default pressure angle of teeth [rad]: 20 degrees, that of standard teeth (ISO 53).
const PRESSURE_ANGLE: &str = "0.34906585039886591538473815369772254270";

/// Reads the point of contact and the pressure angle of teeth; `None` when neither is written.
fn read_mesh(fields: &Fields<'_>) -> Read<Option<Mesh<Number>>> {
    if fields.get("at").is_none() && fields.get("pressure_angle").is_none() {
        return Ok(None);
    }
    let (at, pressure_angle) =
        (fields.vector("at")?, fields.number_or("pressure_angle", PRESSURE_ANGLE)?);
    Ok(Some(Mesh { at, pressure_angle }))
}

const TERMS: &str = "a list of terms like { joint = \"j\", factor = 1.0 }";

pub(crate) fn one() -> Number {
    Number::from(1.0)
}

/// The number with the same digits and the opposite sign.
fn minus(x: Number) -> Number {
    let text = x.text();
    let text = text.strip_prefix('-').map_or_else(|| format!("-{text}"), str::to_owned);
    Number::from_decimal(&text).unwrap_or(x)
}

fn pair<'a>(fields: &Fields<'a>, joints: &'a [Joint<Number>]) -> Read<[Named<'a>; 2]> {
    let list = fields.need("joints")?;
    let [first, second] = fields.context.exactly(list, "a list of two joint names")?;
    Ok([Named::new(fields, first, joints)?, Named::new(fields, second, joints)?])
}

fn radii(fields: &Fields<'_>) -> Read<[Number; 2]> {
    let radii: [Number; 2] = fields.numbers_of("radii", "a list of two radii")?;
    positive(fields, fields.need("radii")?, &radii)?;
    Ok(radii)
}

fn positive(fields: &Fields<'_>, item: &Item, numbers: &[Number]) -> Read<()> {
    match numbers.iter().find(|x| !(x.to_f64() > 0.0)) {
        Some(x) => fields.context.fault(&item.span, ReadFault::NotPositive { number: x.to_f64() }),
        None => Ok(()),
    }
}

/// Reads the teeth of two wheels, whole numbers from 1.
fn teeth<'a>(context: &Context<'a>, item: &'a Item) -> Read<[Number; 2]> {
    let mut teeth = [const { Number::ZERO }; 2];
    for (to, item) in teeth.iter_mut().zip(context.exactly::<2>(item, "a list of two counts")?) {
        let count = match &item.node {
            Node::Number(text) => counted(text, MAX_TEETH),
            _ => None,
        };
        let Some(count) = count else {
            let text =
                if let Node::Number(text) = &item.node { text.clone() } else { "this".into() };
            return context.fault(&item.span, ReadFault::NotACount { text, most: MAX_TEETH });
        };
        *to = Number::from(f64::from(count));
    }
    Ok(teeth)
}

/// Terms of wheels in mesh: by their teeth or radii with the sense of the mesh, or by a ratio.
fn gear<'a>(fields: &Fields<'a>, joints: &'a [Joint<Number>]) -> Read<Vec<CouplingTerm<Number>>> {
    for [one, other] in
        [["teeth", "radii"], ["teeth", "ratio"], ["radii", "ratio"], ["mesh", "ratio"]]
    {
        fields.exclusive(one, other)?;
    }
    let [first, second] = pair(fields, joints)?;
    if let Some(ratio) = fields.optional("ratio")? {
        return Ok(vec![second.turn(fields, one())?, first.turn(fields, minus(ratio))?]);
    }
    let (item, sizes) = if let Some(item) = fields.get("teeth") {
        (item, teeth(&fields.context, item)?)
    } else if let Some(item) = fields.get("radii") {
        (item, radii(fields)?)
    } else {
        return fields
            .context
            .fault(fields.header, ReadFault::Missing { key: "teeth, radii or ratio" });
    };
    let is_internal = is_internal(fields)?;
    let Some(sense) = sense(fields, [first, second])? else {
        return fields.context.fault(&item.span, ReadFault::AxesNotParallel);
    };
    let [n1, n2] = sizes;
    let n2 = if is_internal == (sense > 0.0) { minus(n2) } else { n2 };
    Ok(vec![first.turn(fields, n1)?, second.turn(fields, n2)?])
}

/// Largest sine of the angle between two axes that count as parallel [-]. It allows for rounded digits in a file. Chosen, not tuned.
const PARALLEL: f64 = 1e-6;

/// The sign of the product of two parallel axes. For joints without an axis it is one, since the check of the scene refuses them.
fn sense(fields: &Fields<'_>, joints: [Named<'_>; 2]) -> Read<Option<f64>> {
    let dimension = fields.context.dimension;
    if fields.context.is_planar() {
        return Ok(Some(1.0));
    }
    let axis = |named: Named<'_>| {
        let number = named.number(fields, Needed::Turn)?;
        let turn = named.joint.kind.freedom(dimension, number);
        let axis = match turn {
            Some(Freedom::Turn(Axis::First)) => named.joint.axes[0].as_ref(),
            Some(Freedom::Turn(Axis::Second)) => named.joint.axes[1].as_ref(),
            _ => None,
        };
        Ok(axis.map(|axis| axis.each_ref().map(Number::to_f64)))
    };
    let [first, second] = joints;
    let (Some(a), Some(b)) = (axis(first)?, axis(second)?) else { return Ok(Some(1.0)) };
    let dot: f64 = a.iter().zip(&b).map(|(x, y)| x * y).sum();
    let cross: f64 = [(1, 2), (2, 0), (0, 1)]
        .into_iter()
        .map(|(i, j)| a[i] * b[j] - a[j] * b[i])
        .map(|x| x * x)
        .sum();
    Ok((cross.sqrt() <= PARALLEL * dot.abs()).then_some(dot.signum()))
}

/// The number 2 pi, with more digits than any scalar has.
const TWO_PI: &str = "6.28318530717958647692528676655900576839433879875021";

/// Terms of a screw: the coordinates of one cylindrical joint, or those of a revolute and a prismatic joint.
fn screw<'a>(fields: &Fields<'a>, joints: &'a [Joint<Number>]) -> Read<Vec<CouplingTerm<Number>>> {
    fields.exclusive("joint", "joints")?;
    let item = fields.need("lead")?;
    let lead = fields.at("lead").number(item)?;
    if lead.is_zero() {
        return fields.context.fault(&item.span, ReadFault::NoLead);
    }
    // The slide is lead / (2 pi) times the angle. The sum is multiplied by 2 pi, so that its coefficients need no division.
    let per_turn = Number::from_decimal(TWO_PI).unwrap_or(Number::ZERO);
    let (slide, turn) = match fields.get("joint") {
        Some(joint) => {
            let joint = Named::new(fields, joint, joints)?;
            (joint, joint)
        }
        None if fields.get("joints").is_some() => {
            let [turn, slide] = pair(fields, joints)?;
            (slide, turn)
        }
        None => {
            let missing = ReadFault::Missing { key: "joint or joints" };
            return fields.context.fault(fields.header, missing);
        }
    };
    Ok(vec![slide.term(fields, Needed::Slide, per_turn)?, turn.turn(fields, minus(lead))?])
}

/// Terms of a differential: two wheels, and the carrier of the gears between them.
fn differential<'a>(
    fields: &Fields<'a>,
    joints: &'a [Joint<Number>],
) -> Read<Vec<CouplingTerm<Number>>> {
    let context = fields.context;
    let [a, b, cage] = context
        .exactly(fields.need("joints")?, "a list of three joint names: two wheels, the cage")?;
    let turn = |item, factor| Named::new(fields, item, joints)?.turn(fields, factor);
    let [of_a, of_b] = match fields.get("teeth") {
        Some(item) => teeth(&context, item)?,
        None => [one(), one()],
    };
    let of_cage = minus(of_a.clone() + of_b.clone());
    Ok(vec![turn(a, of_a)?, turn(b, of_b)?, turn(cage, of_cage)?])
}

/// The sum of a rope: a line of constant length over points, or one that is wound on a drum.
fn rope<'a>(fields: &Fields<'a>, joints: &'a [Joint<Number>]) -> Read<Sum> {
    let context = fields.context;
    if let Some(item) = fields.get("terms") {
        ["points", "length", "drum"].iter().try_for_each(|key| fields.exclusive("terms", key))?;
        let terms = read_terms(fields, item, joints)?;
        return Ok((terms, fields.number_or_zero("value")?, read_motion(fields)?));
    }
    fields.exclusive("length", "value")?;
    let points = read_points(fields, fields.need("points")?)?;
    let value = match fields.get("length") {
        None => fields.number_or_zero("value")?,
        Some(Item { node: Node::Text(word), .. }) if word == "reference" => Number::ZERO,
        Some(item) => {
            let reference: f64 = points
                .windows(2)
                .map(|pair| {
                    let d = |i: usize| pair[1].1[i].to_f64() - pair[0].1[i].to_f64();
                    (d(0) * d(0) + d(1) * d(1) + d(2) * d(2)).sqrt()
                })
                .sum();
            fields.at("length").number(item)? + Number::from(-reference)
        }
    };
    let line = CouplingTerm { factor: one(), of: CouplingMeasure::Length { points }, curve: None };
    let mut terms = vec![line];
    if let Some(item) = fields.get("drum") {
        let drum = context.table(item, "a table: { joint = .., radius = .. }", "drum")?;
        let joint = Named::new(&drum, drum.need("joint")?, joints)?;
        terms.push(joint.turn(&drum, drum.number("radius")?)?);
    }
    Ok((terms, value, read_motion(fields)?))
}

pub(crate) fn read_points<'a>(
    fields: &Fields<'a>,
    item: &'a Item,
) -> Read<Vec<(mbs_core::scene::BodyId, [Number; 3])>> {
    let context = fields.context;
    let form = "a list of points like { body = \"b\", at = [0.0, 0.0] }";
    let point = |item| {
        let point = context.table(item, form, "line point")?;
        Ok((context.body(point.need("body")?)?, point.vector("at")?))
    };
    let points = context.list(item, form)?;
    if points.len() < 2 {
        let fault = ReadFault::WrongCount { needed: 2, found: points.len() };
        return context.fault(&item.span, fault);
    }
    points.iter().map(point).collect()
}

/// The angle of a ball joint that `coordinate` names. `None` if `coordinate` does not name such an angle.
pub(crate) fn ball_angle<'a>(
    fields: &Fields<'a>,
    joints: &'a [Joint<Number>],
) -> Read<Option<BallAngle>> {
    let (Some(joint), Some(Item { node: Node::Text(word), .. })) =
        (fields.get("joint"), fields.get("coordinate"))
    else {
        return Ok(None);
    };
    let joint = &joints[fields.context.joint(joint)?.index()];
    let has_ball = joint.kind.freedoms(fields.context.dimension).contains(&Freedom::Ball);
    Ok(BallAngle::ALL.into_iter().find(|angle| has_ball && angle.name() == word))
}

/// Term of an angle of a ball joint, with its axis. `None` if `coordinate` does not name such an angle.
pub(crate) fn ball_term<'a>(
    fields: &Fields<'a>,
    joints: &'a [Joint<Number>],
    factor: Number,
) -> Read<Option<CouplingTerm<Number>>> {
    let Some(angle) = ball_angle(fields, joints)? else { return Ok(None) };
    let joint = fields.context.joint(fields.need("joint")?)?;
    let of = CouplingMeasure::Ball { joint, angle, axis: fields.vector("axis")? };
    Ok(Some(CouplingTerm { factor, of, curve: None }))
}

/// Reads the list of the terms of a sum.
pub(crate) fn read_terms<'a>(
    fields: &Fields<'a>,
    item: &'a Item,
    joints: &'a [Joint<Number>],
) -> Read<Vec<CouplingTerm<Number>>> {
    let list = fields.context.list(item, TERMS)?;
    list.iter().map(|item| read_term(fields, item, joints)).collect()
}

/// Reads a term of a sum: a coordinate of a joint or the length over points, with an optional curve.
fn read_term<'a>(
    fields: &Fields<'a>,
    item: &'a Item,
    joints: &'a [Joint<Number>],
) -> Read<CouplingTerm<Number>> {
    let context = fields.context;
    let term = context.table(item, "a term like { joint = \"j\", factor = 1.0 }", "term")?;
    if ball_angle(&term, joints)?.is_none() {
        term.unused(&["axis"])?;
    }
    let of = read_measure(&term, joints)?;
    Ok(CouplingTerm { factor: term.number_or("factor", "1")?, of, curve: table::of_curve(&term)? })
}

/// Reads a measure: the length over `points`, or the `coordinate` of a `joint`.
pub(crate) fn read_measure<'a>(
    fields: &Fields<'a>,
    joints: &'a [Joint<Number>],
) -> Read<CouplingMeasure<Number>> {
    fields.exclusive("joint", "points")?;
    if let Some(ball) = ball_term(fields, joints, one())? {
        return Ok(ball.of);
    }
    if let Some(points) = fields.get("points") {
        return Ok(CouplingMeasure::Length { points: read_points(fields, points)? });
    }
    let (joint, number) = measured_coordinate(fields, joints)?;
    Ok(CouplingMeasure::Coordinate { joint, number })
}

/// A joint and one of its coordinates. If the joint has only one coordinate, the key `coordinate` may be left out.
fn measured_coordinate<'a>(
    fields: &Fields<'a>,
    joints: &'a [Joint<Number>],
) -> Read<(JointId, usize)> {
    let named = Named::new(fields, fields.need("joint")?, joints)?;
    let number = match fields.get("coordinate") {
        Some(item) => fields.coordinate(item, named.joint)?,
        None => named.number(fields, Needed::Named)?,
    };
    Ok((named.id, number))
}

pub(crate) fn need_curve(fields: &Fields<'_>) -> Read<Curve<Number>> {
    match table::of_curve(fields)? {
        Some(curve) => Ok(curve),
        None => {
            fields.context.fault(fields.header, ReadFault::Missing { key: "table or coefficients" })
        }
    }
}

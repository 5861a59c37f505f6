//! Reads the tables `[[output]]`.

use crate::keys::{DEGREES, FORMS, GLOBAL, ORIENTATION, OWN_BODY, of_target};
use crate::read::ReadFault;
use crate::read::error::OWNER;
use crate::read::fields::{Fields, Read};
use crate::read::names::Names;
use crate::read::tree::Item;
use mbs_core::outputs::{
    QUANTITIES, Quantity, QuantityRow, RelativePoint, Target, TargetKind, VehicleSide, WheelCarrier,
};
use mbs_core::scene::{BodyId, CouplingId, EffectId, Number, Output, RollingId};

/// Keys that name the owner of an output, such as a joint; an output has at most one of them.
const OWNERS: [&str; 6] = ["joint", "body", "coupling", "rolling", "effect", "signal"];

/// Reads an output of a scene. `names` has the names of the couplings, rollings and effects of the scene.
pub(crate) fn read(
    fields: &Fields<'_>,
    centers: &[[Number; 3]],
    names: [&Names; 3],
) -> Read<Output<Number>> {
    for (i, one) in OWNERS.iter().enumerate() {
        OWNERS[i + 1..].iter().try_for_each(|other| fields.exclusive(one, other))?;
    }
    let word = fields.get("quantity").map(|_| fields.word("quantity")).transpose()?;
    let has_owner = OWNERS.iter().any(|owner| fields.get(owner).is_some());
    let is_relative = fields.get("relative_to").is_some();
    let is_here = |row: &&QuantityRow| match row.target.keys().first() {
        Some(owner @ &"body") => {
            fields.get(owner).is_some() && row.target.is_relative() == is_relative
        }
        Some(owner) => fields.get(owner).is_some(),
        // Only quantities of the whole scene need no owner.
        None => !has_owner && word.is_some_and(|word| row.has_name(word.0)),
    };
    let rows: Vec<&QuantityRow> = QUANTITIES.iter().filter(is_here).collect();
    let Some(first) = rows.first() else {
        fields.checked()?;
        return fields.context.fault(fields.header, ReadFault::Missing { key: OWNER });
    };
    let mut word = word.unwrap_or((first.name, fields.header));
    let has_form = word.0 == ORIENTATION && fields.get("as").is_some();
    if has_form {
        let form = fields.word("as")?;
        let Some((_, meant)) = FORMS.iter().find(|(name, _)| *name == form.0) else {
            return fields.unknown_word("as", form, &FORMS.map(|(name, _)| name));
        };
        word.0 = meant;
    }
    let unknown = || {
        let is_seen = |row: &&QuantityRow| row.has_name(word.0) && row.target.is_relative();
        if fields.get("body").is_some() && !is_relative && QUANTITIES.iter().any(|x| is_seen(&x)) {
            return fields.context.fault(fields.header, ReadFault::Missing { key: "relative_to" });
        }
        let known: Vec<_> = rows.iter().map(|row| row.name).collect();
        fields.unknown_word("quantity", word, &known)
    };
    // The quantity is checked first, since another quantity may not have the keys of this one.
    let Some(kind) = rows.iter().find(|row| row.has_name(word.0)).map(|row| row.target) else {
        return unknown();
    };
    let fields = &fields.checked_by(of_target(kind))?;
    if !has_form {
        fields.unused(&["as"])?;
    }
    let target = target(fields, kind, (centers, names))?;
    let Some(quantity) = Quantity::of(word.0, target) else { return unknown() };
    let magnitude = fields.flag("magnitude", false)?;
    let frame = fields.get("frame").map(|item| frame(fields, item, &quantity)).transpose()?;
    let unit = fields.get("unit").map(|_| fields.word("unit")).transpose()?;
    if let Some(unit) = unit.filter(|unit| unit.0 != DEGREES) {
        return fields.unknown_word("unit", unit, &[DEGREES]);
    }
    let is_in_degrees = unit.is_some();
    Ok(Output { name: fields.name()?, quantity, frame, magnitude, is_in_degrees })
}

/// The body whose axes the components of an output refer to.
fn frame(fields: &Fields<'_>, item: &Item, quantity: &Quantity<Number>) -> Read<BodyId> {
    let context = fields.context;
    match (context.text(item)?, quantity.target().own_body()) {
        (GLOBAL, _) => Ok(BodyId::Ground),
        (OWN_BODY, Some(own)) => Ok(own),
        (OWN_BODY, None) if context.bodies.place(OWN_BODY).is_none() => {
            context.fault(&item.span, ReadFault::NoOwnBody)
        }
        _ => context.body(item),
    }
}

/// Target of an output: the owner and the points to which its quantity belongs.
fn target(
    fields: &Fields<'_>,
    kind: TargetKind,
    (centers, [couplings, rollings, effects]): (&[[Number; 3]], [&Names; 3]),
) -> Read<Target<Number>> {
    let owner = || fields.need(kind.keys().first().copied().unwrap_or_default());
    let body = || fields.context.moving_body(owner()?);
    let frame = || fields.context.body(fields.need("relative_to")?);
    // The default place is the centre of mass.
    let place_on = |body: BodyId, key| match fields.get(key).or_else(|| fields.of_frame(key)) {
        Some(item) => fields.at(key).place(item),
        None => Ok(body
            .index()
            .and_then(|i| centers.get(i).cloned())
            .unwrap_or([const { Number::ZERO }; 3])),
    };
    let place = |names: &Names, list: &'static str| {
        let item = owner()?;
        let name = fields.context.text(item)?;
        names.place(name).map_or_else(
            || {
                let (name, known) = (name.to_owned(), names.list().to_vec());
                fields.context.fault(&item.span, ReadFault::UnknownPart { list, name, known })
            },
            Ok,
        )
    };
    Ok(match kind {
        TargetKind::Point => {
            let body = body()?;
            Target::Point(body, place_on(body, "at")?)
        }
        TargetKind::RelativePoint => {
            let (body, relative_to) = (body()?, frame()?);
            let (at, origin) = (place_on(body, "at")?, place_on(relative_to, "origin")?);
            Target::RelativePoint(RelativePoint { body, at, relative_to, origin })
        }
        TargetKind::Body => Target::Body(body()?),
        TargetKind::WheelCarrier => Target::WheelCarrier(wheel(fields, [body()?, frame()?])?),
        TargetKind::RelativeBody => Target::RelativeBody(body()?, frame()?),
        TargetKind::Joint => Target::Joint(fields.context.joint(owner()?)?),
        TargetKind::Coupling => Target::Coupling(CouplingId::new(place(couplings, "couplings")?)),
        TargetKind::Rolling => Target::Rolling(RollingId::new(place(rollings, "rollings")?)),
        TargetKind::Effect => Target::Effect(EffectId::new(place(effects, "effects")?)),
        TargetKind::Signal => Target::Signal(fields.context.signal(owner()?)?),
        TargetKind::Scene => Target::Scene,
    })
}

/// The carrier of a wheel, with the vehicle body and the side.
fn wheel(fields: &Fields<'_>, [body, relative_to]: [BodyId; 2]) -> Read<WheelCarrier<Number>> {
    let word = fields.word("side")?;
    let Some((side, _)) = VehicleSide::ALL.into_iter().find(|(_, name)| *name == word.0) else {
        return fields.unknown_word("side", word, &VehicleSide::ALL.map(|(_, name)| name));
    };
    let or = |key, axis: [f64; 3]| {
        fields.optional_vector(key).map(|x| x.unwrap_or(axis.map(Number::from)))
    };
    let (up, forward) = (or("up", [0.0, 0.0, 1.0])?, or("forward", [1.0, 0.0, 0.0])?);
    Ok(WheelCarrier { body, relative_to, side, up, forward, axis: fields.optional_vector("axis")? })
}

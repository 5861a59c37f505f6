//! Checks of signals: names, numbers, operands, and smoothness where guides need it.

use super::coupling::{check_curve, check_measure};
use super::motion::check_slopes;
use crate::Real;
use crate::mechanism::Scene;
use crate::scene::place::{Place, check_times};
use crate::scene::{
    BallAngle, CouplingMeasure, Entry, Motion, SceneError, SceneFault, SignalId, SignalKind,
    first_of, signal_breaks, signal_order,
};
use alloc::vec;
use alloc::vec::Vec;

pub(super) fn check<T: Real>(scene: &Scene<T>) -> Result<(), SceneError> {
    for (i, signal) in scene.signals.iter().enumerate() {
        check_kind(scene, &signal.kind, scene.place(Entry::Signal(i)))?;
    }
    let order = match signal_order(&scene.signals) {
        Ok(order) => order,
        Err(circle) => {
            let entry = Entry::Signal(circle.first().copied().unwrap_or(0));
            return scene.place(entry).fault("of", SceneFault::SignalCircle);
        }
    };
    check_rates(scene, &order)?;
    let breaks = signal_breaks(&scene.signals, &order);
    for (entry, signal) in motions(scene) {
        let Some(broken) = breaks.get(signal.index()) else {
            return scene.place(entry).fault("signal", SceneFault::UnknownReference);
        };
        if let Some(broken) = *broken {
            let remedy = scene.signals[broken.signal].kind.remedy();
            let fault = SceneFault::SignalNotSmooth { broken, remedy };
            return scene.place(entry).fault("signal", fault);
        }
    }
    Ok(())
}

/// Checks that a controller with a gain of the rate has operands with known rates.
fn check_rates<T: Real>(scene: &Scene<T>, order: &[usize]) -> Result<(), SceneError> {
    let unknown = first_of(&scene.signals, order, |kind| !kind.has_rate());
    for (i, signal) in scene.signals.iter().enumerate() {
        let SignalKind::Pid { of, d, .. } = &signal.kind else { continue };
        if !d.is_zero() && of.iter().any(|of| unknown[of.index()].is_some()) {
            return scene.place(Entry::Signal(i)).fault("d", SceneFault::SignalNoRate);
        }
    }
    Ok(())
}

/// Entries of guides and couplings that follow a signal, each with its signal.
fn motions<T>(scene: &Scene<T>) -> impl Iterator<Item = (Entry, SignalId)> + '_ {
    let of = |motion: Option<&Motion<T>>| match motion {
        Some(Motion::Signal(signal)) => Some(*signal),
        _ => None,
    };
    let guides = scene.guides.iter().enumerate();
    let guides =
        guides.filter_map(move |(i, guide)| Some((Entry::Guide(i), of(Some(&guide.law))?)));
    let couplings = scene.couplings.iter().enumerate();
    let couplings = couplings
        .filter_map(move |(i, coupling)| Some((Entry::Coupling(i), of(coupling.motion.as_ref())?)));
    guides.chain(couplings)
}

fn check_kind<T: Real>(
    scene: &Scene<T>,
    kind: &SignalKind<T>,
    place: Place,
) -> Result<(), SceneError> {
    if kind.operands().iter().any(|of| of.index() >= scene.signals.len()) {
        return place.fault("of", SceneFault::UnknownReference);
    }
    let finite = |list: &[(&'static str, &T)]| {
        list.iter().try_for_each(|(field, x)| place.finite(field, **x))
    };
    match kind {
        SignalKind::Constant(value) | SignalKind::Input { value, .. } => {
            place.finite("value", *value)
        }
        SignalKind::Table { rows, periodic, .. } => check_table(rows, *periodic, place),
        SignalKind::Sine { amplitude, frequency, phase, offset } => finite(&[
            ("amplitude", amplitude),
            ("frequency", frequency),
            ("phase", phase),
            ("offset", offset),
        ]),
        SignalKind::Chirp { amplitude, frequency, to_frequency, duration, phase, offset } => {
            place.positive("duration", *duration)?;
            finite(&[
                ("amplitude", amplitude),
                ("frequency", frequency),
                ("to_frequency", to_frequency),
                ("phase", phase),
                ("offset", offset),
            ])
        }
        SignalKind::Ramp { rate, start, end, rounding } => {
            finite(&[("rate", rate), ("start", start)])?;
            place.not_negative("rounding", *rounding)?;
            let Some(end) = end else { return Ok(()) };
            place.finite("end", *end)?;
            ordered([*start, *end], "start", place)
        }
        SignalKind::Step { from, to, at, rise } => {
            finite(&[("from", from), ("to", to), ("at", at)])?;
            place.not_negative("rise", *rise)
        }
        SignalKind::Sum { of, factors } => {
            if of.len() != factors.len() {
                let (needed, found) = (of.len(), factors.len());
                return place.fault("factors", SceneFault::WrongCount { needed, found });
            }
            factors.iter().try_for_each(|x| place.finite("factors", *x))?;
            some(of, place)
        }
        SignalKind::Product { of } => some(of, place),
        SignalKind::Curve { curve, .. } => check_curve(curve, place),
        SignalKind::Clamp { lower, upper, .. } => {
            finite(&[("lower", lower), ("upper", upper)])?;
            ordered([*lower, *upper], "lower", place)
        }
        SignalKind::LimitRatio { lower, upper, .. } => {
            place.not_negative("upper", *upper)?;
            place.not_negative("lower", T::ZERO - *lower)?;
            ordered([*lower, *upper], "lower", place)
        }
        _ => check_feedback(scene, kind, place),
    }
}

/// Checks signals that depend on the motion or have a state.
fn check_feedback<T: Real>(
    scene: &Scene<T>,
    kind: &SignalKind<T>,
    place: Place,
) -> Result<(), SceneError> {
    match kind {
        SignalKind::Measure { of, .. } => {
            if let CouplingMeasure::Ball { angle: BallAngle::Twist, .. } = of {
                return place.fault("coordinate", SceneFault::TwistMeasured);
            }
            check_measure(scene, of, place)
        }
        SignalKind::Lag { time, value, .. } => {
            place.positive("time", *time)?;
            place.finite("value", *value)
        }
        SignalKind::Integral { lower, upper, value, .. } => {
            for (field, limit) in [("lower", lower), ("upper", upper)] {
                limit.map_or(Ok(()), |limit| place.finite(field, limit))?;
            }
            place.finite("value", *value)?;
            match (*lower, *upper) {
                (Some(lower), Some(upper)) => ordered([lower, upper], "lower", place),
                _ => Ok(()),
            }
        }
        SignalKind::Pid { p, i, d, limit, .. } => {
            for (field, x) in [("p", p), ("i", i), ("d", d)] {
                place.finite(field, *x)?;
            }
            limit.map_or(Ok(()), |limit| place.positive("limit", limit))
        }
        _ => Ok(()),
    }
}

fn ordered<T: Real>([a, b]: [T; 2], field: &'static str, place: Place) -> Result<(), SceneError> {
    let range = [a, b].map(T::to_f64);
    if a < b { Ok(()) } else { place.fault(field, SceneFault::RangeOrder(range)) }
}

fn some(of: &[SignalId], place: Place) -> Result<(), SceneError> {
    let fault = SceneFault::WrongCount { needed: 1, found: 0 };
    if of.is_empty() { place.fault("of", fault) } else { Ok(()) }
}

fn check_table<T: Real>(rows: &[[T; 2]], periodic: bool, place: Place) -> Result<(), SceneError> {
    rows.iter().flatten().try_for_each(|x| place.finite("table", *x))?;
    check_times(rows.iter().map(|row| row[0]), place)?;
    let [first, .., last] = rows else {
        let fault = SceneFault::WrongCount { needed: 2, found: rows.len() };
        return if periodic { place.fault("table", fault) } else { Ok(()) };
    };
    if periodic && first[1] != last[1] {
        let ends = [first[1], last[1]].map(T::to_f64);
        return place.fault("table", SceneFault::PeriodicEnds(ends));
    }
    Ok(())
}

/// Checks that splines followed by guides and couplings do not begin or end on a slope within the run.
pub(super) fn check_ends<T: Real>(scene: &Scene<T>, duration: T) -> Result<(), SceneError> {
    let mut seen = vec![false; scene.signals.len()];
    let mut open: Vec<SignalId> = motions(scene).map(|(_, signal)| signal).collect();
    while let Some(signal) = open.pop() {
        if core::mem::replace(&mut seen[signal.index()], true) {
            continue;
        }
        let kind = &scene.signals[signal].kind;
        open.extend_from_slice(kind.operands());
        if let SignalKind::Table { rows, interpolation, periodic: false } = kind {
            let place = scene.place(Entry::Signal(signal.index()));
            check_slopes((rows, *interpolation), duration, place)?;
        }
    }
    Ok(())
}

//! Checks of guides and initial conditions, and of their agreement.

use crate::Real;
use crate::cluster::Clusters;
use crate::effects::reference::known_body;
use crate::inputs::{GuideInput, SignalGraph};
use crate::laws::guide::{largest_rate, spline};
use crate::measure::knots;
use crate::mechanism::Scene;
use crate::scene::place::{Place, check_times, is_planar};
use crate::scene::{
    Entry, Guide, InitialCondition, InitialTarget, Interpolation, JointId, Motion, SceneError,
    SceneFault, TableEnds,
};
use alloc::vec;
use alloc::vec::Vec;

pub(super) fn check_guides<T: Real>(scene: &Scene<T>) -> Result<(), SceneError> {
    let mut guided = vec![None; scene.joints.len()];
    let mut at = 0;
    while let Some(guide) = scene.guides.get(at) {
        let place = scene.place(Entry::Guide(at));
        let Some(joint) = scene.joints.get(guide.joint.index()) else {
            return place.fault("joint", SceneFault::UnknownReference);
        };
        let needed = joint.kind.n_coordinates(scene.dimension);
        if needed == 0 {
            return place.fault("joint", SceneFault::NoSingleCoordinate(needed));
        }
        if let Some(first) = guided[guide.joint.index()].replace(at) {
            return place.fault("joint", SceneFault::GivenTwice(first));
        }
        let of_joint = scene.guides[at..].iter().enumerate();
        let found = of_joint.take_while(|(i, x)| x.joint == guide.joint && x.number == *i).count();
        if found != needed {
            let field = if found > 1 { "signals" } else { "joint" };
            return place.fault(field, SceneFault::GuideNotWhole { needed, found });
        }
        for (i, guide) in scene.guides[at..][..needed].iter().enumerate() {
            check_law(&guide.law, scene.place(Entry::Guide(at + i)))?;
        }
        at += needed;
    }
    check_movable(scene)
}

/// Checks that no guide acts between bodies that are welded together, directly or through the ground.
fn check_movable<T: Real>(scene: &Scene<T>) -> Result<(), SceneError> {
    if scene.guides.is_empty() {
        return Ok(());
    }
    let clusters = Clusters::new(scene);
    for (i, guide) in scene.guides.iter().enumerate() {
        let joint = &scene.joints[guide.joint];
        let [first, second] = joint.bodies.map(|body| clusters.of(body));
        // another check refuses guides that turn a point mass
        if first == second && !scene.turns_point(joint) {
            return scene.place(Entry::Guide(i)).fault("joint", SceneFault::GuideWelded);
        }
    }
    Ok(())
}

pub(super) fn check_law<T: Real>(law: &Motion<T>, place: Place) -> Result<(), SceneError> {
    match law {
        Motion::Table { rows, .. } | Motion::Monotone { rows, .. } => {
            for row in rows {
                place.finite("table", row[0])?;
                place.finite("table", row[1])?;
            }
            check_times(rows.iter().map(|row| row[0]), place)
        }
        Motion::Sine { amplitude, frequency, phase } => {
            for x in [*amplitude, *frequency, *phase] {
                place.finite("sine", x)?;
            }
            Ok(())
        }
        Motion::Ramp { rate } => place.finite("ramp", *rate),
        Motion::Input(motion) => motion.iter().try_for_each(|x| place.finite("input", *x)),
        // the check of signals covers these
        Motion::Signal(_) => Ok(()),
    }
}

/// Rate at the end of a table, relative to its largest rate, above which the end has a slope [-]. Rounded tables have less.
const SLOPE: f64 = 1e-6;

/// Checks that no table begins or ends on a slope within the run. The rate would jump there, which is an impact.
pub(super) fn check_ends<T: Real>(scene: &Scene<T>, duration: T) -> Result<(), SceneError> {
    for (i, guide) in scene.guides.iter().enumerate() {
        let (rows, way) = match &guide.law {
            Motion::Table { rows, ends } => (rows, Interpolation::Spline(*ends)),
            Motion::Monotone { rows, ends } => (rows, Interpolation::Monotone(*ends)),
            _ => continue,
        };
        check_slopes((rows, way), duration, scene.place(Entry::Guide(i)))?;
    }
    Ok(())
}

/// Checks that a table without level ends does not begin or end on a slope within the run.
pub(super) fn check_slopes<T: Real>(
    (rows, way): (&[[T; 2]], Interpolation),
    duration: T,
    place: Place,
) -> Result<(), SceneError> {
    let [Some(first), Some(last)] = [rows.first(), rows.last()] else { return Ok(()) };
    if way.ends() != Some(TableEnds::Natural) {
        return Ok(());
    }
    let (knots, curvature) = knots(rows, way, false);
    let rate = |t| spline(&knots, &curvature, t).rate;
    let least = T::from_f64(SLOPE) * largest_rate(&knots, &curvature);
    // a table that ends together with the run may end in motion; the last time is compared with a tolerance
    let is_within = |t: T| t < duration * (T::ONE - T::EPSILON.sqrt());
    let is_begun = first[0] > T::ZERO && first[0] <= duration;
    let is_ended = last[0] >= T::ZERO && is_within(last[0]);
    for (is_inside, is_end, row) in [(is_begun, false, 0), (is_ended, true, rows.len() - 1)] {
        let (time, rate) = (rows[row][0], rate(rows[row][0]));
        if is_inside && rate.abs() > least {
            let [time, rate] = [time, rate].map(T::to_f64);
            return place.fault("table", SceneFault::TableSlope { row, is_end, time, rate });
        }
    }
    Ok(())
}

pub(super) fn check_initials<T: Real>(scene: &Scene<T>) -> Result<(), SceneError> {
    let signals = SignalGraph::new(&scene.signals).values(T::ZERO);
    let start = |guide: &Guide<T>| GuideInput::new(&guide.law).at(T::ZERO, &signals);
    let mut seen = Seen {
        value: vec![None; scene.joints.len()],
        rate: vec![None; scene.joints.len()],
        spin: vec![None; scene.bodies.len()],
        guide: vec![Vec::new(); scene.joints.len()],
    };
    for guide in &scene.guides {
        if let Some(slot) = seen.guide.get_mut(guide.joint.index()) {
            slot.push(start(guide));
        }
    }
    for (i, initial) in scene.initials.iter().enumerate() {
        check_initial(scene, i, initial, &mut seen)?;
    }
    Ok(())
}

/// Indices of the initial conditions that prescribe values, rates and angular velocities, by joint or body.
struct Seen<T> {
    value: Vec<Option<usize>>,
    rate: Vec<Option<usize>>,
    spin: Vec<Option<usize>>,
    /// Value, rate and acceleration of each joint's guides at the start.
    guide: Vec<Vec<[T; 3]>>,
}

fn check_initial<T: Real>(
    scene: &Scene<T>,
    i: usize,
    initial: &InitialCondition<T>,
    seen: &mut Seen<T>,
) -> Result<(), SceneError> {
    let place = scene.place(Entry::Initial(i));
    match &initial.target {
        InitialTarget::Joint { joint, value, rate } => {
            if joint.index() >= scene.joints.len() {
                return place.fault("joint", SceneFault::UnknownReference);
            }
            let guides = seen.guide[joint.index()].as_slice();
            if value.is_none() && rate.is_none() {
                return place.fault("value", SceneFault::Missing);
            }
            if let Some(numbers) = value {
                once(&mut seen.value[joint.index()], i, "value", place)?;
                check_numbers(scene, *joint, ("value", numbers), place)?;
                agrees(guides.iter().map(|g| Some(g[0])), ("value", numbers), place)?;
            }
            if let Some(numbers) = rate {
                once(&mut seen.rate[joint.index()], i, "rate", place)?;
                check_numbers(scene, *joint, ("rate", numbers), place)?;
                // The rates of a rotation vector are given as the angular velocity. They are not compared here, but at the start of the
                // simulation.
                let kind = scene.joints[*joint].kind;
                let rate =
                    |(i, g): (usize, &[T; 3])| kind.freedom(scene.dimension, i).map(|_| g[1]);
                agrees(guides.iter().enumerate().map(rate), ("rate", numbers), place)?;
            }
            Ok(())
        }
        InitialTarget::Body { body, velocity, angular_velocity } => {
            let body = known_body(scene.surroundings(), *body, place)?;
            if velocity.is_none() && angular_velocity.is_none() {
                return place.fault("velocity", SceneFault::Missing);
            }
            if let Some((at, velocity)) = velocity {
                place.vector("at", *at)?;
                place.vector("velocity", *velocity)?;
            }
            if let Some(spin) = angular_velocity {
                once(&mut seen.spin[body], i, "angular_velocity", place)?;
                check_spin(*spin, place)?;
            }
            Ok(())
        }
    }
}

fn once(
    slot: &mut Option<usize>,
    i: usize,
    field: &'static str,
    place: Place,
) -> Result<(), SceneError> {
    match slot.replace(i) {
        Some(first) => place.fault(field, SceneFault::GivenTwice(first)),
        None => Ok(()),
    }
}

fn check_numbers<T: Real>(
    scene: &Scene<T>,
    joint: JointId,
    (field, numbers): (&'static str, &[T]),
    place: Place,
) -> Result<(), SceneError> {
    let needed = scene.joints[joint].kind.n_coordinates(scene.dimension);
    if needed == 0 {
        return place.fault("joint", SceneFault::NoCoordinate);
    }
    if numbers.len() != needed {
        return place.fault(field, SceneFault::WrongCount { needed, found: numbers.len() });
    }
    numbers.iter().try_for_each(|x| place.finite(field, *x))
}

/// Largest relative difference between start values and the values of guides and couplings [-]: 1e-9, or eight times machine precision if
/// that is larger.
pub(super) fn agreement<T: Real>() -> T {
    /// Relative difference of numbers that a file gives to ten digits [-]. Chosen, not tuned.
    const AGREEMENT: f64 = 1e-9;
    T::from_f64(AGREEMENT).max(T::from_f64(8.0) * T::EPSILON)
}

/// Checks that a guided joint starts with the values of its guides, within the relative difference `agreement`.
fn agrees<T: Real>(
    guides: impl Iterator<Item = Option<T>>,
    (field, numbers): (&'static str, &[T]),
    place: Place,
) -> Result<(), SceneError> {
    for (guide, given) in guides.zip(numbers) {
        let Some(guide) = guide else { continue };
        if !((*given - guide).abs() <= agreement::<T>() * guide.abs().max(T::ONE)) {
            let (given, guide) = (given.to_f64(), guide.to_f64());
            return place.fault(field, SceneFault::Contradiction { given, guide });
        }
    }
    Ok(())
}

/// Checks an angular velocity: planar bodies turn about z only.
fn check_spin<T: Real>(spin: [T; 3], place: Place) -> Result<(), SceneError> {
    for x in spin {
        place.finite("angular_velocity", x)?;
    }
    if is_planar(place.dimension) {
        for x in [spin[0], spin[1]] {
            if !x.is_zero() {
                return place.fault("angular_velocity", SceneFault::OutOfPlane(x.to_f64()));
            }
        }
    }
    Ok(())
}

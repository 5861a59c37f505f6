//! Unilateral elements that are modelled by bilateral constraints. Rolling contacts and cams could lift off; ropes and strands could go
//! slack. The run reports in its notes if such a constraint had to exert a force that the real element cannot exert.

use crate::checkpoint::tape::{Tape, Walked};
use crate::simulation::Simulation;
use mbs_core::Real;
use mbs_core::natural::NaturalModel;
use mbs_core::outputs::Reactions;
use mbs_core::scene::{Coupling, CouplingKind, Curve, Freedom, Scene};
use mbs_scene::format::{few, significant};

/// Smallest force in the inadmissible direction that is reported, relative to the largest force of the constraint so far [-]. It exceeds
/// the errors of steps.
const NOTED: f64 = 1e-6;
/// Acceleration that, multiplied by the total mass, gives the smallest force that counts [m/s^2]. It covers rounding errors in scenes
/// without gravity.
const AT_REST: f64 = 1e-9;

/// Bilateral constraint that models a unilateral element.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Row {
    /// The rolling contact with this index in `scene.rollings`.
    Contact(usize),
    /// The rope with this index in `scene.couplings`, and the factor of its length.
    Rope(usize, f64),
    /// The cam with this index in `scene.couplings`, and the factor of its follower. A negative factor means that the cam lifts in the
    /// opposite direction.
    Cam(usize, f64),
    /// The strands of the belt with this index in `scene.couplings`, and their pretension [N].
    Strands(usize, f64),
}

impl Row {
    /// The rolling contacts, ropes, cams and strands of a scene.
    fn all<T: Real>(scene: &Scene<T>) -> Vec<Self> {
        let rollings = scene.rollings.iter().enumerate();
        let contacts = rollings.filter(|(_, rolling)| rolling.kind.radius().is_some());
        let couplings = scene.couplings.iter().enumerate().filter_map(|(i, coupling)| {
            Some(match (&coupling.kind, &coupling.terms[..]) {
                (CouplingKind::Rope, _) => Self::Rope(i, coupling.line()?.factor.to_f64()),
                (CouplingKind::Cam, [follower, shaft]) => {
                    let is_below = shaft.curve.as_ref().is_some_and(Curve::is_below_zero);
                    let factor = follower.factor.to_f64();
                    Self::Cam(i, if is_below { -factor } else { factor })
                }
                (CouplingKind::Strands { pretension }, _) => Self::Strands(i, pretension.to_f64()),
                _ => return None,
            })
        });
        contacts.map(|(i, _)| Self::Contact(i)).chain(couplings).collect()
    }

    /// Force or moment in the inadmissible direction [N, N m]. It is the tension of a contact or a cam, or the compression of a rope or a
    /// strand.
    fn force<T: Real, const D: usize>(self, reactions: &Reactions<T, D>) -> f64 {
        match self {
            Self::Contact(rolling) => -reactions.rolling_push(rolling).to_f64(),
            Self::Rope(coupling, factor) => factor * reactions.effort(coupling).to_f64(),
            Self::Cam(coupling, factor) => -factor * reactions.effort(coupling).to_f64(),
            Self::Strands(coupling, pretension) => {
                0.5 * reactions.effort(coupling).to_f64().abs() - pretension
            }
        }
    }
}

/// Constraint row that a run monitors, with its largest forces.
#[derive(Debug, Clone)]
struct Held {
    row: Row,
    /// Time of the first force in the inadmissible direction [s].
    first: Option<f64>,
    /// Largest force in the inadmissible direction, and largest absolute force [N].
    most: f64,
    largest: f64,
}

/// Monitor of those constraints of a run that model unilateral elements.
#[derive(Debug, Clone)]
pub struct OneWayWatch<T: Real, const D: usize> {
    all: Vec<Held>,
    /// Reactions of the scene; `None` if the scene has no such constraint, or if it is too large for the computation of reactions.
    reactions: Option<Reactions<T, D>>,
    /// Force below which a constraint counts as unloaded [N].
    rest: f64,
}

impl<T: Real, const D: usize> OneWayWatch<T, D> {
    /// Prepares the constraints of a scene. If there is none, no reaction is computed.
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Self {
        let held = |row| Held { row, first: None, most: 0.0, largest: 0.0 };
        let all: Vec<_> = Row::all(scene).into_iter().map(held).collect();
        let reactions = if all.is_empty() { None } else { Reactions::new(scene, model).ok() };
        let mass: f64 = scene.bodies.iter().map(|body| body.mass.to_f64()).sum();
        Self { all, reactions, rest: mass * AT_REST }
    }

    /// Checks one state of the run: the state at the start, or the state at the end of a step.
    ///
    /// Cost: one comparison if the scene has no such constraint, else the computation of all reactions. No allocation.
    pub fn watch(&mut self, simulation: &Simulation<T, D>) {
        let Self { all, reactions: Some(reactions), rest } = self else { return };
        let state = simulation.state();
        reactions.update(state);
        for held in all {
            let force = held.row.force(reactions);
            held.largest = held.largest.max(force.abs());
            if force > (NOTED * held.largest).max(*rest) {
                held.first.get_or_insert(state.t.to_f64());
                held.most = held.most.max(force);
            }
        }
    }

    /// Writes the largest forces to a checkpoint, or reads them from one. A scene without such constraints writes nothing.
    pub fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        self.all.iter_mut().try_for_each(|held| {
            tape.option(&mut held.first, Tape::float)?;
            tape.float(&mut held.most)?;
            tape.float(&mut held.largest)
        })
    }

    /// Notes of a run: for each constraint, the time of the first force in the inadmissible direction, and the largest such force.
    pub fn notes(&self, scene: &Scene<T>) -> Vec<String> {
        let note = |held: &Held| {
            let (t, most) = (significant(held.first?), few(held.most));
            Some(match held.row {
                Row::Contact(i) => format!(
                    "`{}` pulls on its plane at t = {t} s, by up to {most} N: what may lift off is a `tire`",
                    scene.rollings[i].name
                ),
                Row::Rope(i, _) => format!(
                    "the rope `{}` pushes at t = {t} s, by up to {most} N: what may go slack is a `spring-damper` with `pulls_only = true`",
                    scene.couplings[i].name
                ),
                Row::Strands(i, pretension) => format!(
                    "a strand of the belt `{}` pushes at t = {t} s, by up to {most} N: its `pretension` of {} N is too small",
                    scene.couplings[i].name,
                    few(pretension)
                ),
                Row::Cam(i, _) => {
                    let (cam, unit) =
                        (&scene.couplings[i], follower_unit(scene, &scene.couplings[i]));
                    format!(
                        "the cam `{}` pulls at t = {t} s, by up to {most} {unit}: what may lift off is a `limit` with this sum as its `terms`",
                        cam.name
                    )
                }
            })
        };
        self.all.iter().filter_map(note).collect()
    }
}

/// Unit of the force on the follower of a cam: N for a translation, N m for a rotation.
fn follower_unit<T>(scene: &Scene<T>, cam: &Coupling<T>) -> &'static str {
    let follower = cam.terms.first().and_then(|term| term.of.coordinate());
    let freedom = follower
        .and_then(|(joint, number)| scene.joints[joint].kind.freedom(scene.dimension, number));
    if matches!(freedom, Some(Freedom::Turn(_))) { "N m" } else { "N" }
}

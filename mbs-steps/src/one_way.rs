//! Contacts that roll and cams that would lift off, ropes and strands that would go slack: their rows hold both ways, and a run notes where
//! they had to.

use crate::checkpoint::tape::{Tape, Walked};
use crate::simulation::Simulation;
use mbs_core::Real;
use mbs_core::natural::NaturalModel;
use mbs_core::outputs::Reactions;
use mbs_core::scene::{Coupling, CouplingKind, Curve, Freedom, Scene};
use mbs_scene::format::{few, significant};

/// Force the wrong way that is noted, relative to the largest of the row so far [-]: more than steps leave of a force.
const NOTED: f64 = 1e-6;
/// Acceleration of all masses below whose force a row is at rest [m/s^2]: rounding of a scene without gravity.
const AT_REST: f64 = 1e-9;

/// Row of constraints that holds both ways.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Row {
    /// The contact of `scene.rollings` with this number.
    Contact(usize),
    /// The rope of `scene.couplings` with this number, and the factor of its length.
    Rope(usize, f64),
    /// The cam of `scene.couplings` with this number, and the factor of its follower: negative where the cam lifts it the other way.
    Cam(usize, f64),
    /// The strands of the belt of `scene.couplings` with this number, and their pretension [N].
    Strands(usize, f64),
}

impl Row {
    /// The contacts that roll, the ropes, the cams and the strands of a scene.
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

    /// The force or moment with which it holds the wrong way [N, N m]: a contact's or a cam's pull, the push of a rope or of a strand.
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

/// A row that is watched.
#[derive(Debug, Clone)]
struct Held {
    row: Row,
    /// When it held the wrong way first [s].
    first: Option<f64>,
    /// Largest force the wrong way, and largest either way [N].
    most: f64,
    largest: f64,
}

/// Watches the rows of a run that stand for what holds one way.
#[derive(Debug, Clone)]
pub struct OneWayWatch<T: Real, const D: usize> {
    all: Vec<Held>,
    /// Reactions of the scene; `None`: there are no rows, or more forces than reactions are made for.
    reactions: Option<Reactions<T, D>>,
    /// Force below which a row is at rest [N].
    rest: f64,
}

impl<T: Real, const D: usize> OneWayWatch<T, D> {
    /// Prepares the rows of a scene; without any, nothing is ever measured.
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Self {
        let held = |row| Held { row, first: None, most: 0.0, largest: 0.0 };
        let all: Vec<_> = Row::all(scene).into_iter().map(held).collect();
        let reactions = if all.is_empty() { None } else { Reactions::new(scene, model).ok() };
        let mass: f64 = scene.bodies.iter().map(|body| body.mass.to_f64()).sum();
        Self { all, reactions, rest: mass * AT_REST }
    }

    /// Watches a state of the run: that of the start, and that at the end of each step.
    ///
    /// Cost: without such rows a comparison; with them all reactions. No allocation.
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

    /// Writes what is remembered, or reads it back; nothing where nothing rolls, and no rope or cam runs.
    pub fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        self.all.iter_mut().try_for_each(|held| {
            tape.option(&mut held.first, Tape::float)?;
            tape.float(&mut held.most)?;
            tape.float(&mut held.largest)
        })
    }

    /// Notes of a run: each row once, with the first time and its largest force the wrong way.
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

/// Unit of what the follower of a cam is pushed with: of a force on a slide, of a moment on a turn.
fn follower_unit<T>(scene: &Scene<T>, cam: &Coupling<T>) -> &'static str {
    let follower = cam.terms.first().and_then(|term| term.of.coordinate());
    let freedom = follower
        .and_then(|(joint, number)| scene.joints[joint].kind.freedom(scene.dimension, number));
    if matches!(freedom, Some(Freedom::Turn(_))) { "N m" } else { "N" }
}

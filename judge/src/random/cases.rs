//! Enumeration of scenes of one joint. It combines every kind of joint, both orders of its bodies, three kinds of first body, every effect
//! that can act on the joint or body, plane and space. The first body is the ground, a body welded to it, or a moving one. Guides are
//! enumerated likewise. Initial values of all coordinates are given, as random numbers.

use super::dice::Dice;
use super::draft::{Draft, GRAVITY};
use super::effects::{Effects, KINDS};
use super::mechanism::{PLANE, SPACE};
use super::time_scale;
use super::write::mechanism_of;
use crate::scene::{Effect, Kind, Measure, Quantity};
use crate::vector::{cross, dot, norm, scale, sub, unit};

/// A scene of the enumeration.
#[derive(Debug, Clone)]
pub struct Case {
    /// Name of the case: the combination in words.
    pub name: String,
    /// Text of the scene file.
    pub text: String,
    /// A step that resolves the motion [s].
    pub step: f64,
}

/// Number of steps of a case.
pub const STEPS: u32 = 10;
/// Longest step of a case [s]. Chosen, not tuned.
const LONGEST: f64 = 5e-4;
/// Longest step relative to the case's time scale [-]: the time in which a body rotates by a radian or moves by the mechanism's size.
/// Chosen, not tuned.
const TIME_FRACTION: f64 = 0.01;

/// Loads besides the drawn effects: none, laws of guides, and a rotor.
const OTHERS: [&str; 6] = ["nothing", "sine", "ramp", "table", "level-table", "rotor"];

/// Returns all cases of the enumeration.
#[must_use]
pub fn cases() -> Vec<Case> {
    let mut list = Vec::new();
    for planar in [true, false] {
        let kinds: Vec<Kind> =
            if planar { PLANE.map(|k| k.0).to_vec() } else { SPACE.map(|k| k.0).to_vec() };
        let hinged = [false, true];
        for (kind, hinged) in kinds.into_iter().flat_map(|k| hinged.map(|h| (k, h))) {
            if hinged && (planar || kind != Kind::Distance) {
                continue;
            }
            let places = Place::ALL.map(|place| [false, true].map(|reversed| (reversed, place)));
            for (reversed, place) in places.into_iter().flatten() {
                for what in KINDS.into_iter().chain(OTHERS) {
                    let name = format!(
                        "{} {}{kind:?}, {}, {}, {what}",
                        if planar { "plane:" } else { "space:" },
                        if hinged { "hinged " } else { "" },
                        if reversed { "named in reverse" } else { "in order" },
                        place.name(),
                    );
                    if let Some((text, step)) =
                        case(seed(&name), planar, (kind, hinged), (reversed, place), what)
                    {
                        list.push(Case { name, text, step });
                    }
                }
            }
        }
    }
    list
}

/// Kinds of a joint's first body: the ground, a body welded to the ground, or a moving body.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    Ground,
    Welded,
    Moving,
}

impl Place {
    const ALL: [Self; 3] = [Self::Ground, Self::Welded, Self::Moving];

    fn name(self) -> &'static str {
        match self {
            Self::Ground => "on the ground",
            Self::Welded => "on a body welded to the ground",
            Self::Moving => "on a moving body",
        }
    }

    /// The kind of the joint that carries the first body; `None` for the ground.
    fn carried_by(self, planar: bool) -> Option<Kind> {
        match self {
            Self::Ground => None,
            Self::Welded => Some(Kind::Weld),
            Self::Moving => Some(if planar { Kind::Revolute } else { Kind::Universal }),
        }
    }
}

fn case(
    seed: u64,
    planar: bool,
    (kind, hinged): (Kind, bool),
    (reversed, place): (bool, Place),
    what: &str,
) -> Option<(String, f64)> {
    let mut dice = Dice::new(seed);
    let time = (1.0 / GRAVITY).sqrt();
    let gravity = Some(scale(GRAVITY, dice.direction(planar)));
    let mut draft = Draft {
        planar,
        length: 1.0,
        time,
        mass: 10.0,
        duration: LONGEST * f64::from(STEPS),
        gravity,
        ..Draft::default()
    };
    if let Some(kind) = place.carried_by(planar) {
        draft.hang(&mut dice, None, kind, false);
    }
    let parent = (place != Place::Ground).then_some(0);
    draft.hang(&mut dice, parent, kind, false);
    let (body, joint) = (draft.bodies.len() - 1, draft.links.len() - 1);
    let link = &mut draft.links[joint];
    let is_reversed = link.bodies[0] == Some(body);
    if is_reversed != reversed {
        link.bodies.reverse();
        link.points.reverse();
    }
    link.hinged = hinged;
    if hinged {
        let d = unit(sub(link.points[1], link.points[0]));
        let axis = unit(link.axes[0]);
        link.axes[0] = unit(cross(d, if dot(d, axis).abs() < 0.9 { axis } else { link.axes[1] }));
    }
    for i in 0..draft.links.len() {
        let kind = draft.links[i].kind;
        let (value, rate) =
            (draft.numbers(&mut dice, kind, 1.0, 0.3), draft.numbers(&mut dice, kind, 2.0, 1.0));
        // a distance joint has no coordinates: its body and the body that carries it start in the reference configuration
        let given = !value.is_empty() && draft.links[joint].kind != Kind::Distance;
        draft.links[i].value = given.then_some(value);
        draft.links[i].rate = given.then_some(rate);
    }
    match what {
        "nothing" => {}
        "sine" | "ramp" | "table" | "level-table" => guide(&mut draft, joint, what)?,
        _ => {
            let mut effects =
                Effects { dice: &mut dice, draft: &mut draft, focus: Some((body, joint)) };
            let text = effects.one(what)?;
            draft.blocks.push(format!("[[effect]]\nname = \"e\"\n{text}"));
        }
    }
    let contacts = ["tire", "tire-side", "tire-slip", "bumper", "limit"];
    if contacts.contains(&what) {
        touch(&mut draft);
    }
    let step = LONGEST.min(TIME_FRACTION * time_scale(&draft));
    draft.duration = step * f64::from(STEPS);
    Some((draft.text(), step))
}

/// Seed of a case from its name (FNV-1a hash). So a new case leaves the numbers of all others unchanged.
fn seed(name: &str) -> u64 {
    let step = |sum: u64, byte| (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    name.bytes().fold(0xcbf2_9ce4_8422_2325, step)
}

fn guide(draft: &mut Draft, joint: usize, what: &str) -> Option<()> {
    let link = &mut draft.links[joint];
    if !matches!(link.kind, Kind::Revolute | Kind::Prismatic) {
        return None;
    }
    link.guide = Some(
        match what {
            "sine" => "sine = { amplitude = 0.4, frequency = 0.3, phase = 0.7 }",
            "ramp" => "ramp = { rate = -0.6 }",
            "level-table" => {
                "table = [[-1.0, 0.2], [0.5, -0.3], [1.0, 0.1], [4.0, 0.5]]\nends = \"level\""
            }
            _ => "table = [[-1.0, 0.2], [0.5, -0.3], [1.0, 0.1], [4.0, 0.5]]",
        }
        .to_owned(),
    );
    (link.value, link.rate) = (None, None);
    Some(())
}

/// Makes contacts touch at the start: raises the road to the wheel, and sets clearance and limits by the state at the start.
fn touch(draft: &mut Draft) {
    let Some(mechanism) = mechanism_of(draft) else { return };
    let Ok(start) = mechanism.start() else { return };
    let Some(block) = draft.blocks.pop() else { return };
    let swap = |key: &str, x: f64| {
        let line =
            |l: &str| if l.starts_with(key) { format!("{key} = {x:?}") } else { l.to_owned() };
        block.lines().map(line).collect::<Vec<_>>().join("\n")
    };
    let text = match &mechanism.scene.effects[0] {
        Effect::Tire(tire) => {
            let center = mechanism.show(&start, Quantity::Position(tire.body, tire.center));
            let height = center[if draft.planar { 1 } else { 2 }] - 0.85 * tire.numbers[0];
            format!("{block}\n[road]\nkind = \"flat\"\nheight = {height:?}")
        }
        Effect::Bumper(line, _) => {
            let ends = [0, 1].map(|i| match line.bodies[i] {
                Some(b) => mechanism.show(&start, Quantity::Position(b, line.points[i])),
                None => line.points[i].to_vec(),
            });
            let now: f64 =
                ends[0].iter().zip(&ends[1]).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
            let before = norm(sub(line.points[1], line.points[0]));
            swap("clearance", before - now - 0.1)
        }
        Effect::Limit(sum, _) => {
            let Measure::Coordinate(joint, _) = sum[0].measure else { return };
            let now = mechanism.show(&start, Quantity::Value(joint))[0];
            swap("lower", now + 0.05)
                .replace("upper = ", "upper = 1")
                .replace("upper = 1-", "upper = 1")
        }
        _ => block.clone(),
    };
    draft.blocks.push(text);
}

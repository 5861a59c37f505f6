//! Comparison of channels with those of the judge: parts of equal units, their sizes, and the part with the largest difference.

use super::product::{ERROR_FACTOR, Judged, ROUNDING, Rows, Verdict};
use crate::scene::{Coupled, Exerts, Quantity, Seen, Whole};

/// Least size of a channel, relative to the largest channel of its kind [-]. Chosen, not tuned.
const SMALLEST: f64 = 1e-2;

/// Number of a quantity's kind. Sizes are compared among channels of one kind.
fn kind(quantity: Quantity) -> usize {
    match quantity {
        Quantity::Position(..) | Quantity::Seen(_, Seen::Position | Seen::Distance) => 0,
        Quantity::Velocity(..) | Quantity::Seen(_, Seen::Velocity) => 1,
        Quantity::Acceleration(..)
        | Quantity::ProperAcceleration(..)
        | Quantity::AngularAcceleration(..)
        | Quantity::JointAcceleration(..)
        | Quantity::Seen(_, Seen::Acceleration) => 2,
        Quantity::Value(..)
        | Quantity::Orientation(..)
        | Quantity::RotationVector(..)
        | Quantity::RotationMatrix(..) => 3,
        Quantity::Rate(..)
        | Quantity::AngularVelocity(..)
        | Quantity::RelativeAngularVelocity(..) => 4,
        Quantity::Coupling(_, Coupled::Value | Coupled::Length) | Quantity::Signal(_, false) => 3,
        Quantity::Coupling(_, Coupled::Rate) | Quantity::Signal(_, true) => 4,
        Quantity::Contact(..)
        | Quantity::Reaction(..)
        | Quantity::Effort(..)
        | Quantity::Coupling(_, Coupled::Effort) => 5,
        Quantity::Leaning(_) => 3,
        Quantity::Effect(_, what) => match what {
            Exerts::Value | Exerts::Deflection | Exerts::Contact | Exerts::SlipAngle => 3,
            Exerts::ContactPoint => 0,
            Exerts::Rate => 4,
            Exerts::Energy => 6,
            Exerts::Power => 7,
            _ => 5,
        },
        Quantity::Whole(Whole::CenterOfMass) => 0,
        Quantity::Whole(Whole::Momentum | Whole::AngularMomentum) => 8,
        Quantity::KineticEnergy(..) | Quantity::Whole(_) => 6,
        Quantity::Power(..) | Quantity::Coupling(_, Coupled::Power) => 7,
    }
}

/// Part of a channel whose components have one unit.
#[derive(Debug)]
pub struct Part {
    /// Index of the output.
    pub output: usize,
    /// Range of the components in a row.
    pub components: std::ops::Range<usize>,
    kind: usize,
}

/// The channels of a scene that are unique.
#[must_use]
pub fn parts(judged: &Judged) -> Vec<Part> {
    let (mut at, mut list) = (0, Vec::new());
    let scene = &judged.mechanism.scene;
    for (output, &(n, unique)) in judged.channels.iter().enumerate() {
        let quantity = scene.outputs[output].quantity;
        // splits forces from moments, and translations from rotations
        let cut = match (quantity, n) {
            (Quantity::Reaction(_), n) | (Quantity::Effect(_, Exerts::Force), n @ (3 | 6)) => {
                if scene.planar {
                    2
                } else {
                    n / 2
                }
            }
            (
                Quantity::Value(j)
                | Quantity::Rate(j)
                | Quantity::JointAcceleration(j)
                | Quantity::Effort(j),
                n,
            ) => match (n, scene.joints[j].kind) {
                (3, crate::scene::Kind::FreePoint) => 3,
                (2, crate::scene::Kind::FreePoint) => 2,
                (4, _) => 1,
                (2 | 6, _) => n / 2,
                (3, crate::scene::Kind::Spherical) => 0,
                (3, _) => 2,
                (1, crate::scene::Kind::Prismatic) => 1,
                _ => 0,
            },
            (
                Quantity::AngularVelocity(_)
                | Quantity::RelativeAngularVelocity(..)
                | Quantity::AngularAcceleration(_)
                | Quantity::Orientation(_)
                | Quantity::RotationVector(_)
                | Quantity::RotationMatrix(_),
                _,
            ) => 0,
            _ => n,
        };
        let of = |second: bool| 2 * kind(quantity) + usize::from(second);
        if unique {
            for (range, second) in [(at..at + cut, false), (at + cut..at + n, true)] {
                if !range.is_empty() {
                    list.push(Part { output, components: range, kind: of(second) });
                }
            }
        }
        at += n;
    }
    list
}

fn largest(rows: &Rows, range: &std::ops::Range<usize>) -> f64 {
    rows.iter().flat_map(|row| &row[range.clone()]).fold(0.0, |a: f64, x| a.max(x.abs()))
}

fn difference(a: &Rows, b: &Rows, range: &std::ops::Range<usize>) -> f64 {
    let mut worst = 0.0_f64;
    for (x, y) in a.iter().zip(b) {
        for (x, y) in x[range.clone()].iter().zip(&y[range.clone()]) {
            if !((x - y).abs() <= worst) {
                worst = (x - y).abs();
            }
        }
    }
    worst
}

/// The least size of channels of each kind, from the mechanism's length and weight and the time scale of its motion.
fn least_sizes(judged: &Judged) -> [f64; 18] {
    let mechanism = &judged.mechanism;
    let (l, t) = (mechanism.length(), judged.time);
    let m = mechanism.scene.bodies.iter().map(|b| b.mass).fold(0.0, f64::max);
    let force = m * l / (t * t);
    let energy = force * l;
    // two sizes for each kind: lengths and angles, or forces and moments
    let pairs = [
        [l, l],
        [l / t, l / t],
        [l / (t * t), 1.0 / (t * t)],
        [l, 1.0],
        [l / t, 1.0 / t],
        [force, force * l],
        [energy, energy],
        [energy / t, energy / t],
        [force * t, force * t],
    ];
    let least: [f64; 18] = core::array::from_fn(|i| pairs[i / 2][i % 2]);
    least.map(|x| SMALLEST * x)
}

/// The part of a channel with the largest difference relative to its size, with both values; `None` where all differences are below
/// `share`.
#[must_use]
pub fn worst(judged: &Judged, rows: &Rows, share: f64) -> Option<String> {
    let right = &judged.rows;
    if rows.first().map(Vec::len) != right.first().map(Vec::len) || rows.len() != right.len() {
        return Some("number of components".to_owned());
    }
    let (parts, group) = sized(judged, right);
    let mut found = (share, None);
    for part in &parts {
        let size = largest(right, &part.components).max(SMALLEST * group[part.kind]);
        let off = difference(rows, right, &part.components) / size;
        if off.is_nan() || off > found.0 {
            let name = &judged.mechanism.scene.outputs[part.output].name;
            let at = |rows: &Rows| -> Vec<Vec<f64>> {
                rows.iter().map(|row| row[part.components.clone()].to_vec()).collect()
            };
            let both = format!("{:?}, judge {:?}", at(rows), at(right));
            found = (off, Some(format!("{name} is off by {off:.1e}: {both}")));
        }
    }
    found.1
}

/// The parts of all channels, and the size of each kind of them.
fn sized(judged: &Judged, right: &Rows) -> (Vec<Part>, [f64; 18]) {
    let parts = parts(judged);
    let mut group = least_sizes(judged);
    for part in &parts {
        group[part.kind] = group[part.kind].max(largest(right, &part.components));
    }
    (parts, group)
}

/// Compares rows of two steps with those of the judge.
pub(super) fn compare(judged: &Judged, right: &Rows, coarse: &Rows, fine: &Rows) -> Verdict {
    if fine.first().map(Vec::len) != right.first().map(Vec::len) {
        return Verdict::Differs {
            channel: "number of components".to_owned(),
            off: f64::NAN,
            allowed: 0.0,
            size: 0.0,
            start: true,
        };
    }
    let (parts, group) = sized(judged, right);
    // a difference at the start is reported as such, and first
    let first = [right, fine].map(|rows| rows[..1].to_vec());
    let mut worst = (1.0, Verdict::Agrees);
    for start in [true, false] {
        for part in &parts {
            let size = largest(right, &part.components).max(SMALLEST * group[part.kind]);
            let own = if start { 0.0 } else { difference(coarse, fine, &part.components) };
            let off = if start {
                difference(&first[0], &first[1], &part.components)
            } else {
                difference(fine, right, &part.components)
            };
            let allowed = (ERROR_FACTOR * own).max(ROUNDING * size);
            if off.is_nan() || off > allowed * worst.0 {
                let channel = judged.mechanism.scene.outputs[part.output].name.clone();
                worst = (off / allowed, Verdict::Differs { channel, off, allowed, size, start });
            }
        }
        if worst.1 != Verdict::Agrees {
            break;
        }
    }
    worst.1
}

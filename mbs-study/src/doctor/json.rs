//! Examination result as one JSON object. Keys are never removed.

use super::{Checkup, Finding, Motion, Moved};
use crate::redundancy::{JointChange, Loop, Remedy, Set};
use mbs_core::scene::Entry;
use serde_json::{Value, json};

/// Function that finds the place of an entry's key: the line, and the file if it is included by the scene's file.
pub type Written<'a> = &'a dyn Fn(Entry, &str) -> Option<(Option<String>, usize)>;

/// Returns the JSON object of a checkup; `line` gives the place of an entry's key.
#[must_use]
pub fn to_json(checkup: &Checkup, line: Written<'_>) -> Value {
    let c = checkup;
    let names = Names { joints: &c.joints, bodies: &c.bodies };
    let level = &c.joint_level;
    let [rows, columns, rank] = level.sizes;
    json!({
        "scene": c.scene,
        "dimension": c.dimension,
        "dof": c.dof(),
        "worst": c.worst().map(|s| s.name()),
        "findings": c.findings.iter().map(|f| names.finding(f, line)).collect::<Vec<_>>(),
        "position": if c.is_at_start { "start" } else { "reference" },
        "natural": c.natural.map(|[n, m, rank]| json!({
            "coordinates": n, "constraints": m, "rank": rank, "dof": n - rank, "redundant": m - rank,
        })),
        "joint_level": {
            "velocities": columns,
            "equations": rows,
            "rank": rank,
            "dof": columns - rank,
            "redundant": rows - rank,
            "gap": finite(level.gap),
            "uncertain": level.gap < crate::redundancy::UNCERTAIN,
            "least_singular_value": level.least,
        },
        "dependent_sets": level.sets.iter().map(|s| names.set(s)).collect::<Vec<_>>(),
        "reactions": names.reactions(c, c.dimension),
        "loops": c.loops.iter().map(|l| names.round(l)).collect::<Vec<_>>(),
        "shares_of_the_motion": c.drives.iter().map(|d| json!({
            "joint": names.joint(d.joint), "share": d.share,
        })).collect::<Vec<_>>(),
        "massless": c.massless.as_ref().map(|all| all.iter().map(|m| json!({
            "bodies": names.bodies(&m.bodies), "idle_spin": m.is_idle_spin,
        })).collect::<Vec<_>>()),
        "methods": c.methods.iter().map(|a| json!({
            "formulation": a.formulation,
            "runs": a.error.is_none(),
            "error": a.error.as_ref().map(|(code, message)| json!({ "code": code, "message": message })),
        })).collect::<Vec<_>>(),
        "motion": c.motion.as_ref().map(|m| names.motion(m)),
        "start": c.start.as_ref().map(|s| names.start(s)),
    })
}

/// Returns `None` for an infinite number, which JSON does not have.
fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

struct Names<'a> {
    joints: &'a [String],
    bodies: &'a [String],
}

impl Names<'_> {
    fn joint(&self, j: usize) -> &str {
        &self.joints[j]
    }

    fn joints(&self, all: &[usize]) -> Vec<&str> {
        all.iter().map(|&j| self.joints[j].as_str()).collect()
    }

    fn bodies(&self, all: &[usize]) -> Vec<&str> {
        all.iter().map(|&b| self.bodies[b].as_str()).collect()
    }

    fn finding(&self, f: &Finding, line: Written<'_>) -> Value {
        let (file, line) = f.place.and_then(|(entry, key)| line(entry, key)).unzip();
        json!({
            "severity": f.severity.name(),
            "code": f.code,
            "topic": f.topic.name(),
            "message": f.message,
            "remedy": f.remedy,
            "joints": self.joints(&f.joints),
            "bodies": self.bodies(&f.bodies),
            "line": line,
            "file": file.flatten(),
        })
    }

    fn set(&self, set: &Set) -> Value {
        let member = |m: &crate::redundancy::Member| {
            let [forces, moments, both] = m.open;
            json!({
                "joint": self.joint(m.joint),
                "open_forces": forces,
                "open_moments": moments,
                "open": both,
                "guide": m.guide,
            })
        };
        json!({
            "joints": set.members.iter().map(|m| self.joint(m.joint)).collect::<Vec<_>>(),
            "redundant": set.redundant,
            "exact": set.is_exact,
            "nature": set.nature.name(),
            "singular_value": set.sigma,
            "members": set.members.iter().map(member).collect::<Vec<_>>(),
            "remedy": set.remedy.as_ref().map(|remedy| self.remedy(remedy)),
        })
    }

    fn remedy(&self, remedy: &Remedy) -> Value {
        let change = |c: &JointChange| {
            json!({
                "joint": self.joint(c.joint),
                "kind": if c.kind.is_free() { "left-out" } else { c.kind.name() },
                "second_axis": c.axis,
            })
        };
        json!({
            "changes": remedy.changes.iter().map(change).collect::<Vec<_>>(),
            "body_left_out": remedy.body.map(|b| self.bodies[b].as_str()),
            "fewest": remedy.is_smallest,
        })
    }

    fn reactions(&self, c: &Checkup, dimension: usize) -> Vec<Value> {
        let of = |(j, components): (usize, &Vec<bool>)| {
            let labels = labels(dimension).iter().zip(components);
            let open: Vec<&str> = labels.filter(|(_, unique)| !**unique).map(|(l, _)| *l).collect();
            let lacking = c.lacking.iter().filter(|(joint, _)| *joint == j);
            let lacks: Vec<&str> = lacking.map(|(_, coupling)| coupling.as_str()).collect();
            json!({ "joint": self.joint(j), "unique": open.is_empty(), "not_unique": open, "lacks": lacks })
        };
        c.unique.iter().enumerate().map(of).collect()
    }

    fn round(&self, lap: &Loop) -> Value {
        let corner = |c: &crate::redundancy::Corner| {
            json!({
                "joint": self.joint(c.joint),
                "turn": c.turn,
                "branch": if c.has_sign { Some(if c.turn < 0.0 { -1 } else { 1 }) } else { None },
                "distance": c.distance(),
            })
        };
        json!({
            "joints": self.joints(&lap.joints),
            "corners": lap.corners.iter().map(corner).collect::<Vec<_>>(),
        })
    }

    fn motion(&self, m: &Motion) -> Value {
        json!({
            "formulation": m.formulation,
            "positions": m.positions,
            "reached": m.reached,
            "duration": m.duration,
            "cut_short": m.is_cut_short,
            "nearest_singular": m.nearest.iter().map(|n| json!({
                "time": n.time,
                "singular_value": n.sigma,
                "singular_value_at_start": n.sigma_at_start,
                "rank": n.rank[0],
                "rank_at_start": n.rank[1],
                "joints": self.joints(&n.joints),
                "passages": n.passages,
            })).collect::<Vec<_>>(),
            "corners": m.corners.iter().map(|s| json!({
                "loop": s.lap,
                "joint": self.joint(s.joint),
                "least_distance": s.least[0],
                "time": s.least[1],
                "changed_side": s.changed,
            })).collect::<Vec<_>>(),
            "error": m.error.as_ref().map(|(code, message, hint)| json!({
                "code": code, "message": message, "hint": hint, "time": m.reached,
            })),
        })
    }

    fn start(&self, s: &Moved) -> Value {
        let bodies = self.bodies.iter().zip(s.bodies.iter().zip(&s.speeds));
        json!({
            "residual_before": s.residual_before,
            "residual": s.residual,
            "bodies": bodies.map(|(name, (way, speed))| json!({
                "body": name, "way": way[0], "turn": way[1], "speed": speed[0], "angular_speed": speed[1],
            })).collect::<Vec<_>>(),
        })
    }
}

/// Names of the components of a reaction.
#[must_use]
pub fn labels(dimension: usize) -> &'static [&'static str] {
    if dimension == 2 { &["Fx", "Fy", "Mz"] } else { &["Fx", "Fy", "Fz", "Mx", "My", "Mz"] }
}

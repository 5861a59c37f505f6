//! Report of a checkup: findings in sentences, and the tables with their data.

use crate::report::{Report, Section, row, wrapped};
use core::fmt::Write;
use mbs::record::{Provenance, RecordedMotion};
use mbs_core::scene::Scene;
use mbs_scene::format::{counted, few, significant, size};
use mbs_study::doctor::{Checkup, Finding, Written, labels};
use mbs_study::redundancy::UNCERTAIN;

/// Displacement or rotation up to which a value counts as rounding error [m or rad]. Chosen, not tuned.
const ROUNDING: f64 = 1e-12;

/// Largest number of letters in a line of findings in the terminal [-].
const WIDTH: usize = 110;

/// Returns the page of a checkup, with a picture of the scene's start if there is one, and its text for a terminal.
#[must_use]
pub fn report(
    scene: &Scene<f64>,
    checkup: &Checkup,
    line: Written<'_>,
    (start_view, provenance): (Option<RecordedMotion>, Provenance),
) -> (Report, String) {
    let mut sections = vec![findings(checkup, line), what(checkup)];
    sections.extend(sets(checkup));
    sections.push(reactions(checkup));
    sections.extend(loops(checkup).map(Section::folded));
    sections.extend(motion(checkup).map(Section::folded));
    sections.extend(start(scene, checkup).map(Section::folded));
    let title = format!("{}: {}", checkup.scene, verdict(checkup));
    let motion = start_view.map(|motion| with_named(motion, checkup));
    let report = Report { title, sections, motion, provenance, ..Report::default() };
    let text = report.text() + &sentences(checkup, line);
    (report, text)
}

/// Returns the picture with joint names. Only joints that occur in findings have names.
fn with_named(mut motion: RecordedMotion, c: &Checkup) -> RecordedMotion {
    let found: Vec<&str> =
        c.findings.iter().flat_map(|f| &f.joints).map(|&j| c.joints[j].as_str()).collect();
    motion.joints.retain(|joint| found.contains(&joint.name.as_str()));
    motion
}

/// Summarises the checkup by the numbers of its findings.
fn verdict(c: &Checkup) -> String {
    let count = |severity| c.findings.iter().filter(|f| f.severity == severity).count();
    let kinds = [
        (mbs_study::doctor::Severity::Fault, "fault"),
        (mbs_study::doctor::Severity::Doubt, "doubt"),
        (mbs_study::doctor::Severity::Note, "note"),
    ];
    let parts: Vec<String> = kinds
        .into_iter()
        .map(|(severity, noun)| (count(severity), noun))
        .filter(|(n, _)| *n > 0)
        .map(|(n, noun)| counted(n, noun))
        .collect();
    if parts.is_empty() { "nothing found".to_owned() } else { parts.join(", ") }
}

/// Returns the findings as sentences for a terminal.
fn sentences(c: &Checkup, line: Written<'_>) -> String {
    let mut out = String::new();
    for finding in &c.findings {
        let place = place(finding, line).map_or_else(String::new, |place| format!(", {place}"));
        // writing to a String cannot fail
        let _ = writeln!(out, "\n{}: {}{place}", finding.severity.name(), finding.code);
        let mut lines = wrapped(&finding.message, WIDTH);
        if !finding.remedy.is_empty() {
            lines.extend(wrapped(&format!("mend: {}", finding.remedy), WIDTH));
        }
        lines.iter().for_each(|line| _ = writeln!(out, "  {line}"));
    }
    out
}

/// Returns the place of a finding: `line 12`, or `FILE:12` in an included file.
fn place(finding: &Finding, line: Written<'_>) -> Option<String> {
    let (entry, key) = finding.place?;
    let (file, line) = line(entry, key)?;
    Some(file.map_or_else(|| format!("line {line}"), |file| format!("{file}:{line}")))
}

fn findings(c: &Checkup, line: Written<'_>) -> Section {
    let row = |f: &Finding| {
        vec![
            f.severity.name().to_owned(),
            f.code.to_owned(),
            place(f, line).unwrap_or_default(),
            f.message.clone(),
            f.remedy.clone(),
        ]
    };
    let head = ["", "code", "where", "what was found", "what would mend it"];
    let rows = c.findings.iter().map(row).collect();
    Section { is_detail: true, ..Section::new("Findings", &head, rows) }
}

fn what(c: &Checkup) -> Section {
    let level = &c.joint_level;
    let [rows, columns, rank] = level.sizes;
    let natural = c.natural.map_or("no start".to_owned(), |[n, m, r]| {
        format!("{n} coordinates, {m} constraints of rank {r}{}", redundant(m - r))
    });
    let gap = match (level.gap.is_finite(), level.gap < UNCERTAIN) {
        (false, _) => "no loop".to_owned(),
        (true, false) => format!("{}, certain", few(level.gap)),
        (true, true) => format!("{}, uncertain", few(level.gap)),
    };
    let least = if level.gap.is_finite() { few(level.least) } else { "no loop".to_owned() };
    let whole = format!(
        "{columns} velocities, {rows} equations of joints and guides of rank {rank}{}",
        redundant(rows - rank)
    );
    let rows = vec![
        row("degrees of freedom", c.dof().to_string()),
        row("natural coordinates", natural),
        row("whole bodies", whole),
        row("gap of the rank", gap),
        row("smallest singular value that counts", least),
    ];
    Section::new("What it is", &[], rows)
}

fn redundant(n: usize) -> String {
    if n == 0 { String::new() } else { format!(" ({n} redundant)") }
}

fn sets(c: &Checkup) -> Option<Section> {
    let row = |set: &mbs_study::redundancy::Set| {
        let joints: Vec<&str> = set.members.iter().map(|m| c.joints[m.joint].as_str()).collect();
        let kind = if set.is_exact { set.nature.name() } else { "almost" };
        vec![set.redundant.to_string(), kind.to_owned(), joints.join(", ")]
    };
    let rows: Vec<_> = c.joint_level.sets.iter().map(row).collect();
    let head = ["redundant", "holds", "joints"];
    (!rows.is_empty()).then(|| Section::new("Dependent sets", &head, rows))
}

fn reactions(c: &Checkup) -> Section {
    let labels = labels(c.dimension);
    let open = |components: &Vec<bool>| {
        let open = labels.iter().zip(components).filter(|(_, unique)| !**unique);
        open.map(|(l, _)| *l).collect::<Vec<_>>().join(", ")
    };
    let all = c.unique.iter().enumerate().map(|(j, of)| (j, open(of)));
    let some: Vec<(usize, String)> = all.filter(|(_, open)| !open.is_empty()).collect();
    let lacking = c.lacking.iter().map(|(joint, coupling)| {
        row(
            &c.joints[*joint],
            format!("lacks the force of `{coupling}`, which acts as a moment alone"),
        )
    });
    let rows = if some.is_empty() && c.lacking.is_empty() {
        vec![row("all joints", "every component is determined by the motion".to_owned())]
    } else {
        let entry = |(j, open): &(usize, String)| {
            let value = format!("not unique: {open}{}", directions(c, *j));
            row(&c.joints[*j], value)
        };
        let mut rows: Vec<_> = some.iter().map(entry).collect();
        rows.extend(lacking);
        if c.unique.len() > some.len() + c.lacking.len() {
            rows.push(row("all others", "every component is determined by the motion".to_owned()));
        }
        rows
    };
    let caption = if some.is_empty() {
        String::new()
    } else {
        "Components in global axes at the start. A run gives the smallest reactions and marks those that are not unique."
            .to_owned()
    };
    Section { caption, ..Section::new("Reactions", &[], rows) }
}

/// Describes how many forces and moments of a joint are undetermined. The numbers do not depend on the axes.
fn directions(c: &Checkup, joint: usize) -> String {
    let exact = c.joint_level.sets.iter().filter(|set| set.is_exact);
    let member = exact.flat_map(|set| &set.members).find(|m| m.joint == joint);
    member.map_or_else(String::new, |m| {
        let [forces, moments, both] = m.open;
        let noun = |n: usize, noun| (n > 0).then(|| counted(n, noun));
        let parts: Vec<String> =
            [noun(forces, "force"), noun(moments, "moment")].into_iter().flatten().collect();
        let coupled = if both < forces + moments { ", coupled" } else { "" };
        format!(" ({}{coupled})", parts.join(" and "))
    })
}

fn loops(c: &Checkup) -> Option<Section> {
    /// Largest number of closed loops in the table [-]. They fill one page.
    const MAX_ROWS: usize = 40;
    let row = |lap: &mbs_study::redundancy::Loop| {
        let joints: Vec<&str> = lap.joints.iter().map(|&j| c.joints[j].as_str()).collect();
        let sign =
            |corner: &mbs_study::redundancy::Corner| match (corner.has_sign, corner.turn < 0.0) {
                (false, _) => 'o',
                (true, true) => '-',
                (true, false) => '+',
            };
        let nearest = lap.corners.iter().min_by(|a, b| a.distance().total_cmp(&b.distance()));
        vec![
            joints.join(", "),
            lap.corners.iter().map(sign).collect(),
            nearest.map_or("no corner".to_owned(), |n| {
                format!("{:.2} deg at {}", n.distance().to_degrees(), c.joints[n.joint])
            }),
        ]
    };
    let more = c.loops.len().saturating_sub(MAX_ROWS);
    let more =
        if more > 0 { format!(" {more} more loops are in the JSON.") } else { String::new() };
    let rows: Vec<_> = c.loops.iter().take(MAX_ROWS).map(row).collect();
    let head = ["joints", "branch", "nearest to a straight line"];
    (!rows.is_empty()).then(|| Section {
        caption: format!(
            "A sign for each corner of three places: the side to which the loop turns there about the joint's axis (o: no axis). \
             Two branches meet where a corner is straight.{more}"
        ),
        ..Section::new("Loops", &head, rows)
    })
}

fn motion(c: &Checkup) -> Option<Section> {
    let m = c.motion.as_ref()?;
    let mut rows = vec![row(
        "looked at",
        format!(
            "{} up to t = {} s, run by {}",
            counted(usize::try_from(m.positions).unwrap_or(usize::MAX), "position"),
            significant(m.reached),
            m.formulation
        ),
    )];
    for near in &m.nearest {
        let joints: Vec<&str> = near.joints.iter().map(|&j| c.joints[j].as_str()).collect();
        rows.push(row(
            "nearest singular position",
            format!(
                "{} at t = {} s ({} at the start): {}",
                few(near.sigma),
                few(near.time),
                few(near.sigma_at_start),
                joints.join(", ")
            ),
        ));
    }
    rows.extend(changes(c, &m.corners));
    if m.nearest.is_empty() {
        rows.push(row("nearest singular position", "no loop, none".to_owned()));
    }
    Some(Section {
        caption: "Distance to a singular position: the smallest singular value of a part's equations over the largest; zero is singular. \
                  A crank that turns fully changes the side of its corners twice in each turn; a change elsewhere is a change of branch."
            .to_owned(),
        ..Section::new("Along the motion", &[], rows)
    })
}

/// Returns the corners that changed their side. Corners that changed at the same time are in one row.
fn changes(c: &Checkup, corners: &[mbs_study::doctor::LinearMotion]) -> Vec<Vec<String>> {
    let mut changed: Vec<(f64, usize)> =
        corners.iter().filter_map(|s| Some((s.changed?, s.joint))).collect();
    changed.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    changed.dedup();
    let together = changed.chunk_by(|a, b| a.0.total_cmp(&b.0).is_eq());
    let entry = |of: &[(f64, usize)]| {
        let joints: Vec<&str> = of.iter().map(|(_, j)| c.joints[*j].as_str()).collect();
        let corner =
            if of.len() == 1 { "a corner changed its side" } else { "corners changed sides" };
        row(corner, format!("t = {} s: {}", few(of[0].0), joints.join(", ")))
    };
    together.map(entry).collect()
}

fn start(scene: &Scene<f64>, c: &Checkup) -> Option<Section> {
    let s = c.start.as_ref()?;
    let [position, velocity, acceleration] = s.residual.map(size);
    let farthest = |i: usize| {
        let of = (0..s.bodies.len()).max_by(|&a, &b| s.bodies[a][i].total_cmp(&s.bodies[b][i]));
        of.map_or((0.0, String::new()), |b| (s.bodies[b][i], format!("`{}`", scene.bodies[b].name)))
    };
    let ([way, turn], [far, turned]) = {
        let (a, b) = (farthest(0), farthest(1));
        ([a.0, b.0], [a.1, b.1])
    };
    let moved = if way > ROUNDING || turn > ROUNDING {
        format!("up to {} m ({far}), {} rad ({turned})", few(way), few(turn))
    } else {
        "nothing".to_owned()
    };
    let left = format!("{position} m, {velocity} m/s, {acceleration} m/s^2 (or rad)");
    let rows = vec![
        row("left open before assembly", format!("{} m (or rad)", size(s.residual_before))),
        row("moved by assembly", moved),
        row("left open after it", left),
    ];
    Some(Section::new("The start", &[], rows))
}

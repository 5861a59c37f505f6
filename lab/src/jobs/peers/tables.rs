//! Tables of the measurements: our times beside the fastest peer, times at equal digits, peers, and every algorithm.

use super::digits::{against, solvers};
use super::lanes::{Lane, Measured};
use super::problems::{ALGEBRAIC, DIGITS, Kind, LIMIT_ALGEBRAIC, limit_at};
use super::programs::Who;
use crate::format::{self, error, paragraph, ratio, time};
use crate::lab::section::{self, Section};

/// A table: its head and its rows.
type Table = (Vec<&'static str>, Vec<Vec<String>>);

const HEAD: [&str; 10] = [
    "problem",
    "mbs",
    "time",
    "error",
    "peer",
    "its time",
    "its error",
    "ratio",
    "in space",
    "limit",
];
const DIGITS_HEAD: [&str; 10] = [
    "right digits",
    "mbs",
    "time",
    "peer",
    "its time",
    "ratio",
    "in space",
    "limit",
    "over RADAU5",
    "over IDA",
];
const ALL_HEAD: [&str; 5] = ["problem", "program", "time", "error", "right digits"];

fn error_cell(lane: &Lane) -> String {
    lane.error.map_or_else(String::new, |[far, _]| error(far))
}

fn ratio_cell(x: Option<f64>) -> String {
    x.map_or_else(|| "-".to_owned(), ratio)
}

/// Table of our planar times beside the fastest peer, for every problem whose runs do not report digits.
fn beside(measured: &[Measured]) -> Table {
    let row = |m: &Measured| {
        let problem = m.problem.label();
        let Some(peer) = m.peer() else {
            return vec![problem, "no peer is installed, or none is right".to_owned()];
        };
        let ours = m.ours(false).map_or_else(
            || ["none errs as little".to_owned(), String::new(), String::new()],
            |lane| [lane.algorithm.clone(), time(lane.time()), error_cell(lane)],
        );
        let peer = [peer.label(), time(peer.time()), error_cell(peer)];
        let ratios = [m.ratio(false), m.ratio(true)].map(ratio_cell);
        let [problem, limit] = [[problem], [ratio(m.problem.limit[0])]];
        [&problem[..], &ours, &peer, &ratios, &limit].concat()
    };
    let rows = measured.iter().filter(|m| m.problem.kind != Kind::Digits).map(row).collect();
    (HEAD.to_vec(), rows)
}

/// Table of our times beside the fastest peer at equal digits.
fn at_digits(measured: &Measured) -> Table {
    let solvers = solvers(measured);
    let row = |digits: u8| {
        let Some((ours, peer, quotient)) = against(&solvers, digits, false, "") else {
            return vec![digits.to_string(), "mbs or every peer does not reach them".to_owned()];
        };
        let over = |is_spatial, name| {
            ratio_cell(against(&solvers, digits, is_spatial, name).map(|(_, _, quotient)| quotient))
        };
        let [radau, ida] = ALGEBRAIC.map(|name| over(false, name));
        let took = |x: Option<f64>| x.map_or_else(String::new, time);
        vec![
            digits.to_string(),
            ours.name.clone(),
            took(ours.time(digits)),
            peer.name.clone(),
            took(peer.time(digits)),
            ratio(quotient),
            over(true, ""),
            ratio(limit_at(digits)),
            radau,
            ida,
        ]
    };
    (DIGITS_HEAD.to_vec(), DIGITS.map(row).collect())
}

/// Versions of the peers, and the commands that install missing ones.
fn peers(measured: &[Measured]) -> Table {
    let row = |&who: &Who| {
        let failed = measured.iter().flat_map(|m| &m.failed).find(|(failed, _)| *failed == who);
        let version = match failed {
            _ if !who.is_here() => format!("not installed: {}", who.remedy()),
            Some((_, why)) => format!("{}, failed: {}", who.version(), why.trim()),
            None => who.version(),
        };
        vec![who.name().to_owned(), version]
    };
    let is_asked = |who: &&Who| measured.iter().any(|m| m.problem.peers.contains(who));
    let mut rows: Vec<_> = Who::PEERS.iter().filter(is_asked).map(row).collect();
    rows.dedup();
    (vec!["peer", "version"], rows)
}

/// Table of every algorithm of every program.
fn all(measured: &[Measured]) -> Table {
    let mut rows = Vec::new();
    for m in measured {
        for lane in &m.lanes {
            let digits = lane.digits.map_or_else(String::new, |x| format!("{x:.2}"));
            let cells =
                [m.problem.label(), lane.label(), time(lane.time()), error_cell(lane), digits];
            rows.push(cells.to_vec());
        }
    }
    (ALL_HEAD.to_vec(), rows)
}

/// Makes the sections of the page.
pub(super) fn sections(measured: &[Measured]) -> Vec<Section> {
    let mut section = Section::new("peers", "mbs beside the fastest peer");
    section.words(
        "In the plane mbs uses that a scene is planar, which the peers do not; the column 'in space' is the ratio without that. \
         Errors are distances from the exact value; a run of mbs errs no more than the peer's.",
    );
    let (head, rows) = beside(measured);
    section.table(&head, rows);
    claims(&mut section, measured);
    let mut sections = vec![section];
    for m in measured.iter().filter(|m| m.problem.kind == Kind::Digits) {
        let mut section = Section::new("digits", m.problem.title);
        let (head, rows) = at_digits(m);
        section.table(&head, rows);
        claims_at_digits(&mut section, m);
        sections.push(section);
    }
    let mut section = Section::new("programs", "The programs");
    let (head, rows) = peers(measured);
    section.table(&head, rows);
    let (head, rows) = all(measured);
    section.behind("every algorithm", &head, rows);
    sections.push(section);
    sections
}

/// Adds a claim on each problem, with its verdict.
fn claims(section: &mut Section, measured: &[Measured]) {
    for m in measured.iter().filter(|m| m.problem.kind != Kind::Digits) {
        let [limit, aim] = m.problem.limit;
        let what = format!("{}, {}: at most {}", m.problem.label(), m.problem.title, ratio(limit));
        let found = m.ratio(false);
        let measured = format!("{}, aim {}", ratio_cell(found), ratio(aim));
        section.claim(what, measured, found.map(|x| x <= limit));
    }
    for lane in measured.iter().flat_map(Measured::wrong) {
        section.claim(format!("{} is exact", lane.label()), error_cell(lane), Some(false));
    }
}

/// Adds the claims at equal digits. They have a verdict if both solvers reach the digits.
fn claims_at_digits(section: &mut Section, measured: &Measured) {
    let solvers = solvers(measured);
    let mut claim = |digits: u8, name: &str, limit: f64| {
        let Some((ours, peer, quotient)) = against(&solvers, digits, false, name) else { return };
        let what =
            format!("{digits} digits, {} over {}: at most {}", ours.name, peer.name, ratio(limit));
        section.claim(what, ratio(quotient), Some(quotient <= limit));
    };
    for digits in DIGITS {
        claim(digits, "", limit_at(digits));
        for name in ALGEBRAIC {
            claim(digits, name, LIMIT_ALGEBRAIC);
        }
    }
}

/// Writes the tables for a terminal.
pub(super) fn text(measured: &[Measured], remark: &str) -> String {
    let mut text = String::new();
    paragraph(&mut text, 0, remark);
    text + "\n" + &section::text(&sections(measured))
}

/// Writes the tables for a document.
pub(super) fn markdown(measured: &[Measured], remark: &str) -> String {
    let mut text = format!("{remark}\n");
    let digits = measured.iter().filter(|m| m.problem.kind == Kind::Digits).map(at_digits);
    let tables = [beside(measured)].into_iter().chain(digits).chain([peers(measured)]);
    for (head, rows) in tables.filter(|(_, rows)| !rows.is_empty()) {
        text.push('\n');
        text.push_str(&format::markdown(&head, rows));
    }
    text
}

/// The times of every algorithm in every turn, as CSV.
pub(super) fn csv(measured: &[Measured]) -> Result<Vec<u8>, String> {
    let number = |x: Option<f64>| x.map(|x| format!("{x:e}")).unwrap_or_default();
    let mut records = Vec::new();
    for (m, lane) in measured.iter().flat_map(|m| m.lanes.iter().map(move |lane| (m, lane))) {
        for (turn, seconds) in (1..).zip(&lane.seconds) {
            records.push(vec![
                m.problem.name.to_owned(),
                m.problem.n.to_string(),
                lane.who.name().to_owned(),
                lane.algorithm.clone(),
                i32::to_string(&turn),
                format!("{seconds:e}"),
                number(lane.error.map(|[far, _]| far)),
                number(lane.digits),
            ]);
        }
    }
    format::csv("problem,size,program,algorithm,turn,seconds,error,digits", records)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::peers::lanes::tests::line;
    use crate::peers::problems::selected;

    #[test]
    fn a_missed_limit_is_reported_and_a_missing_peer_too() {
        let mut measured = Measured::new(selected(&["tree".to_owned()]).unwrap()[0]);
        let own = [line("reference", 0.0, 3.0), line("planar", 1.0, 3.0)];
        measured.take(Who::Ours, own.to_vec());
        let alone = text(&[measured.clone()], "remark");
        assert!(
            alone.contains("no peer is installed") && alone.contains("(not judged)"),
            "{alone}"
        );
        measured.take(Who::MuJoCo, vec![line("mj_forward", 1.25, 3.0)]);
        let page = text(&[measured.clone()], "remark");
        assert!(page.contains("0.80, aim 0.55 (does not hold)"), "{page}");
        assert!(markdown(&[measured], "remark").contains("| tree 127 | planar | 1.00 s |"));
    }
}

//! Notes on tables whose splines overshoot: between two neighbouring rows the spline leaves the range of their values.

use crate::Real;
use crate::effects::Value;
use crate::laws::guide;
use crate::measure::knots;
use crate::mechanism::Scene;
use crate::scene::{
    CouplingKind, CouplingTerm, Curve, Entry, Interpolation, Motion, RoadFeature, SignalKind,
    TableEnds,
};
use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// Smallest excess over the range of two rows that gives a note, relative to the range of the table [-]. It is larger than the excess near
/// rounded corners.
const NOTED_EXCESS: f64 = 0.05;

/// Note on a spline that leaves the range of two neighbouring rows.
#[derive(Debug, Clone, PartialEq)]
pub struct TableNote {
    /// Entry that contains the table.
    pub entry: Entry,
    /// Key of the table in that entry.
    pub key: &'static str,
    /// Text of the note.
    pub text: String,
}

/// Table that is interpolated by a spline, with its entry and key.
struct Spline {
    entry: Entry,
    key: &'static str,
    /// Description of the part of the scene that has the table.
    of: String,
    rows: Vec<[f64; 2]>,
    ends: TableEnds,
    is_periodic: bool,
    /// Names of the two axes.
    axes: [&'static str; 2],
}

/// Features of the road under the wheels of one side, with the constructor of their entries.
type Side<'a, T> = (fn(usize) -> Entry, &'a [RoadFeature<T>]);

impl<T: Real> Scene<T> {
    /// Notes on the splines of a scene that leave the range of two neighbouring rows by more than a twentieth of the table's range.
    ///
    /// Cost: one tridiagonal elimination for each table.
    #[must_use]
    pub fn table_notes(&self) -> Vec<TableNote> {
        let mut splines = Vec::new();
        self.add_curves(&mut splines);
        self.add_motions(&mut splines);
        self.add_roads(&mut splines);
        splines.iter().filter_map(Spline::note).collect()
    }

    /// Adds the splines of couplings, effects and signals.
    fn add_curves(&self, to: &mut Vec<Spline>) {
        let of_terms = |place: (Entry, &'static str), of: &str, terms: &[CouplingTerm<T>]| {
            let curves = terms.iter().filter_map(|term| term.curve.as_ref());
            curves.filter_map(|of_term| curve(place, of.to_owned(), of_term)).collect::<Vec<_>>()
        };
        for (i, coupling) in self.couplings.iter().enumerate() {
            let key = if coupling.kind == CouplingKind::Cam { "table" } else { "terms" };
            let of = format!("coupling `{}`", coupling.name);
            to.extend(of_terms((Entry::Coupling(i), key), &of, &coupling.terms));
        }
        for (i, effect) in self.effects.iter().enumerate() {
            for value in effect.kind.values() {
                let Value::Terms(terms) = value else { continue };
                let of = format!("effect `{}`", effect.name);
                to.extend(of_terms((Entry::Effect(i), "terms"), &of, &terms));
            }
        }
        for (i, signal) in self.signals.iter().enumerate() {
            if let SignalKind::Curve { curve: of_signal, .. } = &signal.kind {
                let of = format!("signal `{}`", signal.name);
                to.extend(curve((Entry::Signal(i), "table"), of, of_signal));
            }
        }
    }

    /// Adds the splines of functions of time.
    fn add_motions(&self, to: &mut Vec<Spline>) {
        let axes = ["t", "value"];
        let mut add = |entry, of: String, rows: &[[T; 2]], ends, is_periodic| {
            to.push(Spline {
                entry,
                key: "table",
                of,
                rows: doubles(rows),
                ends,
                is_periodic,
                axes,
            });
        };
        for (i, guide) in self.guides.iter().enumerate() {
            if let Motion::Table { rows, ends } = &guide.law {
                let joint = self.joints.get(guide.joint.index());
                let name = joint.map_or("", |joint| joint.name.as_str());
                add(Entry::Guide(i), format!("the guide of joint `{name}`"), rows, *ends, false);
            }
        }
        for (i, coupling) in self.couplings.iter().enumerate() {
            if let Some(Motion::Table { rows, ends }) = &coupling.motion {
                let of = format!("coupling `{}`", coupling.name);
                add(Entry::Coupling(i), of, rows, *ends, false);
            }
        }
        for (i, signal) in self.signals.iter().enumerate() {
            if let SignalKind::Table {
                rows,
                interpolation: Interpolation::Spline(ends),
                periodic,
            } = &signal.kind
            {
                let of = format!("signal `{}`", signal.name);
                add(Entry::Signal(i), of, rows, *ends, *periodic);
            }
        }
    }

    /// Adds the splines of roads. A road that is the same on both sides is added once.
    fn add_roads(&self, to: &mut Vec<Spline>) {
        let right = if self.road.left == self.road.right { &[][..] } else { &self.road.right };
        let sides: [Side<'_, T>; 2] =
            [(Entry::RoadLeft, &self.road.left), (Entry::RoadRight, right)];
        for (entry, features) in sides {
            for (i, feature) in features.iter().enumerate() {
                if let RoadFeature::Table(points) = feature {
                    to.push(Spline {
                        entry: entry(i),
                        key: "points",
                        of: format!("{}", entry(i)),
                        rows: doubles(points),
                        ends: TableEnds::Natural,
                        is_periodic: false,
                        axes: ["x", "z"],
                    });
                }
            }
        }
    }
}

fn doubles<T: Real>(rows: &[[T; 2]]) -> Vec<[f64; 2]> {
    rows.iter().map(|row| row.map(T::to_f64)).collect()
}

/// Spline of a curve; `None` for curves of other kinds.
fn curve<T: Real>(
    (entry, key): (Entry, &'static str),
    of: String,
    curve: &Curve<T>,
) -> Option<Spline> {
    let (rows, is_periodic) = match curve {
        Curve::Table(rows) => (rows, false),
        Curve::Periodic(rows) => (rows, true),
        Curve::Polynomial(_) | Curve::Shaped { .. } => return None,
    };
    let (rows, ends) = (doubles(rows), TableEnds::Natural);
    Some(Spline { entry, key, of, rows, ends, is_periodic, axes: ["x", "f"] })
}

impl Spline {
    /// Note on the spline; `None` if it leaves the range of its rows only slightly.
    fn note(&self) -> Option<TableNote> {
        let values = || self.rows.iter().map(|row| row[1]);
        let [low, high] = [values().fold(f64::MAX, f64::min), values().fold(f64::MIN, f64::max)];
        let (found, by, i) = self.farthest()?;
        if !(by > NOTED_EXCESS * (high - low)) {
            return None;
        }
        let ([a, f], [b, g]) = (self.rows[i], self.rows[i + 1]);
        let Self { entry, key, of, axes: [x, y], .. } = self;
        let text = format!(
            "the spline of `{key}` of {of} goes to {y} = {found:.4} between {x} = {a} and {b}, whose values are {f} and {g}: give it \
             `interpolation = \"monotone\"`"
        );
        Some(TableNote { entry: *entry, key, text })
    }

    /// Value farthest outside the range of its two rows, its distance from the range, and the index of the first row.
    fn farthest(&self) -> Option<(f64, f64, usize)> {
        let (knots, bends) = knots(&self.rows, Interpolation::Spline(self.ends), self.is_periodic);
        let mut farthest: Option<(f64, f64, usize)> = None;
        for (i, pair) in self.rows.windows(2).enumerate() {
            let [[x0, f0], [x1, f1]] = [pair[0], pair[1]];
            let (low, high) = (f0.min(f1), f0.max(f1));
            for s in turning((x1 - x0, f1 - f0), [bends[i], bends[i + 1]]) {
                let value = guide::spline(&knots, &bends, x0 + s).value;
                let by = (low - value).max(value - high);
                if by > farthest.map_or(0.0, |(_, most, _)| most) {
                    farthest = Some((value, by, i));
                }
            }
        }
        farthest
    }
}

/// Zeros of the first derivative of a cubic within its interval, measured from the beginning. The interval has length h, the cubic the
/// given rise and second derivatives c0 and c1 at the ends.
fn turning((h, rise): (f64, f64), [c0, c1]: [f64; 2]) -> impl Iterator<Item = f64> {
    // m + c0 s + (c1 - c0) s^2 / (2 h) = 0
    let m = rise / h - h * (2.0 * c0 + c1) / 6.0;
    let a = (c1 - c0) / (2.0 * h);
    let root = libm::sqrt(c0 * c0 - 4.0 * a * m);
    let q = -0.5 * (c0 + libm::copysign(root, c0));
    [q / a, m / q].into_iter().filter(move |s| *s > 0.0 && *s < h)
}

//! The rope net: rods between knots, in a shape that leaves every rope slack.
//!
//! ```text
//! knot (i, j) at (x_i, y_j, f_i + g_j),   (x, f) and (y, g) points of an arc with equal chords
//! ```
//!
//! A sum of two arcs has rods of equal length everywhere, and no rope is taut between two corners, as it would be in a flat net.

use super::text::Text;

/// Length of a rod [m], and its mass [kg].
const ROD: f64 = 0.2;
const MASS: f64 = 0.02;
/// Slope of the arc at its ends [rad].
const SLOPE: f64 = 0.5;

const COMMENT: &str = "\
Rope net: slender rods of 0.2 m and 20 g between the knots of a grid, held together by balls, hung on the ground at its
four corners and let go from rest.

The knot (i, j) lies at (x_i, y_j, f_i + g_j), where (x, f) and (y, g) are points of one arc each, that hangs through with
0.5 rad at its ends: all rods are equally long, and no rope is taut. The inner ropes begin higher than they will hang.
Three freedoms for each knot but the corners, less one for each rod; the energy is kept.";

pub(super) fn text([rows, columns]: [usize; 2], command: &str) -> String {
    let mut text = Text::new(COMMENT, command);
    text.scene(&format!("rope net of {rows} by {columns} meshes"), 3, 1.0);
    let net = Net { across: arc(columns), along: arc(rows) };
    let rods: Vec<[[usize; 2]; 2]> = net.rods().collect();
    for ends in &rods {
        let [from, to] = ends.map(|knot| net.place(knot));
        text.rod(&rod(*ends), [&from, &to], MASS);
    }
    for j in 0..=rows {
        for i in 0..=columns {
            net.tie(&mut text, [i, j]);
        }
    }
    text.step(1e-3);
    let middle = [columns / 2, rows / 2];
    let name = rod([middle, [middle[0] + 1, middle[1]]]);
    text.position("middle", &name, &net.place(middle));
    let edge = [columns / 2, 0];
    text.position("edge", &rod([edge, [edge[0] + 1, 0]]), &net.place(edge));
    text.0
}

/// Places of an arc of equal chords: along it, and down.
fn arc(n: usize) -> Vec<[f64; 2]> {
    let mut points = vec![[0.0; 2]];
    let mut at = [0.0; 2];
    for k in 0..n {
        let slope = SLOPE * (1.0 - (2 * k + 1) as f64 / n as f64);
        at = [at[0] + ROD * slope.cos(), at[1] - ROD * slope.sin()];
        points.push(at);
    }
    points
}

struct Net {
    /// Places of the knots in x, and in y.
    across: Vec<[f64; 2]>,
    along: Vec<[f64; 2]>,
}

impl Net {
    fn place(&self, [i, j]: [usize; 2]) -> [f64; 3] {
        let ([x, f], [y, g]) = (self.across[i], self.along[j]);
        [x, y, f + g]
    }

    /// The rods in x, rope by rope, then those in y.
    fn rods(&self) -> impl Iterator<Item = [[usize; 2]; 2]> {
        let (m, n) = (self.along.len(), self.across.len());
        let across = (0..m).flat_map(move |j| (1..n).map(move |i| [[i - 1, j], [i, j]]));
        let along = (0..n).flat_map(move |i| (1..m).map(move |j| [[i, j - 1], [i, j]]));
        across.chain(along)
    }

    /// The joints of a knot: every rod on the first one, and a corner on the ground.
    fn tie(&self, text: &mut Text, knot: [usize; 2]) {
        let [i, j] = knot;
        let (last_i, last_j) = (self.across.len() - 1, self.along.len() - 1);
        let neighbours = [
            (i > 0).then(|| rod([[i.wrapping_sub(1), j], knot])),
            (i < last_i).then(|| rod([knot, [i + 1, j]])),
            (j > 0).then(|| rod([[i, j.wrapping_sub(1)], knot])),
            (j < last_j).then(|| rod([knot, [i, j + 1]])),
        ];
        let mut rods = neighbours.into_iter().flatten();
        let at = self.place(knot);
        let Some(first) = rods.next() else { return };
        if (i == 0 || i == last_i) && (j == 0 || j == last_j) {
            text.joint(&format!("corner-{i}-{j}"), "spherical", ["ground", &first], &at);
        }
        for (k, other) in rods.enumerate() {
            let name = format!("knot-{i}-{j}-{}", k + 1);
            text.joint(&name, "spherical", [&first, &other], &at);
        }
    }
}

/// A rod by the knot where it begins, and its direction.
fn rod([[i, j], to]: [[usize; 2]; 2]) -> String {
    if to[0] > i { format!("across-{i}-{j}") } else { format!("along-{i}-{j}") }
}

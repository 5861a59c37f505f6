//! The rope net: rods between knots, in an initial shape in which every rope sags.
//!
//! ```text
//! knot (i, j) at (x_i, y_j, f_i + g_j),   (x, f) and (y, g) points of an arc with equal chords
//! ```
//!
//! In this sum of two arcs, all rods have equal length. No rope is straight between two corners. In a flat net, every rope would be straight.

use super::text::{self, vector};
use mbs_core::scene::{Body, BodyId, Dimension, GROUND, Joint, Number, Scene};

/// Length of a rod [m].
const ROD: f64 = 0.2;
/// Mass of a rod [kg].
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
    let name = format!("rope net of {rows} by {columns} meshes");
    let mut scene = text::scene(&name, Dimension::Spatial, 1.0);
    let net = Net { across: arc(columns), along: arc(rows) };
    for ends in net.rods() {
        let [from, to] = ends.map(|knot| vector(net.place(knot)));
        scene.bodies.push(Body::rod(from, to, MASS).named(&rod(ends)));
    }
    for j in 0..=rows {
        for i in 0..=columns {
            net.tie(&mut scene, [i, j]);
        }
    }
    for (name, [i, j]) in [("middle", [columns / 2, rows / 2]), ("edge", [columns / 2, 0])] {
        let body = net.index([[i, j], [i + 1, j]]);
        scene.outputs.push(text::position(name, body, vector(net.place([i, j]))));
    }
    text::text(COMMENT, command, &scene)
}

/// Points of an arc of n chords of equal length: distance along its base, and height relative to its first point [m].
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
    /// Coordinates x of the knots, each with its part f of the height [m]. `along` has the coordinates y, each with the part g.
    across: Vec<[f64; 2]>,
    along: Vec<[f64; 2]>,
}

impl Net {
    fn place(&self, [i, j]: [usize; 2]) -> [f64; 3] {
        let ([x, f], [y, g]) = (self.across[i], self.along[j]);
        [x, y, f + g]
    }

    /// All rods as pairs of knots: first the rods in x, rope by rope, then the rods in y.
    fn rods(&self) -> impl Iterator<Item = [[usize; 2]; 2]> {
        let (m, n) = (self.along.len(), self.across.len());
        let across = (0..m).flat_map(move |j| (1..n).map(move |i| [[i - 1, j], [i, j]]));
        let along = (0..n).flat_map(move |i| (1..m).map(move |j| [[i, j - 1], [i, j]]));
        across.chain(along)
    }

    /// Index of a rod among the bodies, in the order of [`Self::rods`].
    fn index(&self, [[i, j], to]: [[usize; 2]; 2]) -> usize {
        let (m, n) = (self.along.len(), self.across.len());
        if to[0] > i { j * (n - 1) + i } else { m * (n - 1) + i * (m - 1) + j }
    }

    /// Adds the joints of a knot. Each rod at the knot but the first is joined to the first rod. At a corner, the first rod is joined to the
    /// ground.
    fn tie(&self, scene: &mut Scene<Number>, knot: [usize; 2]) {
        let [i, j] = knot;
        let (last_i, last_j) = (self.across.len() - 1, self.along.len() - 1);
        let neighbours = [
            (i > 0).then(|| [[i.wrapping_sub(1), j], knot]),
            (i < last_i).then(|| [knot, [i + 1, j]]),
            (j > 0).then(|| [[i, j.wrapping_sub(1)], knot]),
            (j < last_j).then(|| [knot, [i, j + 1]]),
        ];
        let mut rods = neighbours.into_iter().flatten().map(|rod| BodyId::Body(self.index(rod)));
        let Some(first) = rods.next() else { return };
        let mut ball = |bodies, name: String| {
            let joint = Joint::spherical(bodies, vector(self.place(knot)));
            scene.joints.push(joint.named(&name));
        };
        if (i == 0 || i == last_i) && (j == 0 || j == last_j) {
            ball([GROUND, first], format!("corner-{i}-{j}"));
        }
        for (k, other) in rods.enumerate() {
            ball([first, other], format!("knot-{i}-{j}-{}", k + 1));
        }
    }
}

/// Name of a rod: its direction, and the knot where it begins.
fn rod([[i, j], to]: [[usize; 2]; 2]) -> String {
    if to[0] > i { format!("across-{i}-{j}") } else { format!("along-{i}-{j}") }
}

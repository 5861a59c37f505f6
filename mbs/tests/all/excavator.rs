//! The excavator against two independent computations: triangles of its pins, and the slope of its potential energy.

use crate::common::oracle::{TRAPEZOIDAL, Way, rows};

type Point = [f64; 2];

/// Pins in the reference configuration [m]: foot points of boom, stick and bucket, attachment points of the cylinders, rocker and link.
const A: Point = [0.0, 1.6];
const C: Point = [3.9, 4.9];
const F: Point = [5.2, 2.5];
const D: Point = [0.8, 1.1];
const E: Point = [2.3, 3.0];
const G: Point = [2.5, 4.4];
const H: Point = [3.5, 5.6];
const K: Point = [4.45, 4.9];
const M: Point = [5.1, 3.1];
const L: Point = [5.65, 3.4];
const N: Point = [5.6, 2.8];
const TIP: Point = [4.6, 1.3];

fn distance(p: Point, q: Point) -> f64 {
    (q[0] - p[0]).hypot(q[1] - p[1])
}

/// Returns the point at distance r from p and s from q. It is on the side of the line from p to q on which `like` is in the reference
/// configuration.
fn corner((p, r): (Point, f64), (q, s): (Point, f64), [p0, q0, like]: [Point; 3]) -> Point {
    let turn = (q0[0] - p0[0]) * (like[1] - p0[1]) - (q0[1] - p0[1]) * (like[0] - p0[0]);
    let d = distance(p, q);
    let along = (r * r - s * s + d * d) / (2.0 * d);
    let across = (r * r - along * along).sqrt() * turn.signum();
    let [x, y] = [(q[0] - p[0]) / d, (q[1] - p[1]) / d];
    [p[0] + along * x - across * y, p[1] + along * y + across * x]
}

/// Returns the present position of a point x of a body. Two of its points are given in the present and the reference configuration.
fn carried([p0, q0]: [Point; 2], [p, q]: [Point; 2], x: Point) -> Point {
    let angle = (q[1] - p[1]).atan2(q[0] - p[0]) - (q0[1] - p0[1]).atan2(q0[0] - p0[0]);
    let (sin, cos) = angle.sin_cos();
    let [x, y] = [x[0] - p0[0], x[1] - p0[1]];
    [p[0] + cos * x - sin * y, p[1] + sin * x + cos * y]
}

fn between(p: Point, q: Point, share: f64) -> Point {
    [p[0] + (q[0] - p[0]) * share, p[1] + (q[1] - p[1]) * share]
}

/// Position of the bucket's tip [m] and potential energy [J], from the extensions of the boom, stick and bucket cylinders [m].
fn placed([s1, s2, s3]: [f64; 3]) -> (Point, f64) {
    let e = corner((A, distance(A, E)), (D, distance(D, E) + s1), [A, D, E]);
    let boom = |x| carried([A, E], [A, e], x);
    let (c, g) = (boom(C), boom(G));
    let h = corner((c, distance(C, H)), (g, distance(G, H) + s2), [C, G, H]);
    let stick = |x| carried([C, H], [c, h], x);
    let (f, k, m) = (stick(F), stick(K), stick(M));
    let l = corner((m, distance(M, L)), (k, distance(K, L) + s3), [M, K, L]);
    let n = corner((f, distance(F, N)), (l, distance(L, N)), [F, L, N]);
    let bucket = |x| carried([F, N], [f, n], x);
    // the centres of a cylinder's barrel and rod keep their distances from their pins
    let cylinder = |[p, q]: [Point; 2], [p0, q0]: [Point; 2], masses: [f64; 2]| {
        let quarter = 0.25 * distance(p0, q0) / distance(p, q);
        masses[0] * between(p, q, quarter)[1] + masses[1] * between(q, p, quarter)[1]
    };
    let moment = 1100.0 * boom([1.95, 3.4])[1]
        + 550.0 * stick([4.5, 3.9])[1]
        + 420.0 * bucket([4.9, 2.0])[1]
        + 30.0 * between(m, l, 0.5)[1]
        + 25.0 * between(l, n, 0.5)[1]
        + cylinder([D, e], [D, E], [60.0, 40.0])
        + cylinder([g, h], [G, H], [55.0, 35.0])
        + cylinder([k, l], [K, L], [45.0, 28.0]);
    (bucket(TIP), 9.81 * moment)
}

#[test]
fn the_excavator_reaches_where_its_triangles_say_and_its_cylinders_carry_it() {
    let scene = mbs_testkit::file("excavator");
    for formulation in TRAPEZOIDAL {
        let rows = rows(&scene, Way(formulation, "trapezoidal"), (2e-3, 8.0), 20);
        let rows = rows.unwrap_or_else(|e| panic!("{formulation}: {e}"));
        for (t, row) in &rows {
            let lengths = [row[2], row[4], row[6]];
            let (tip, energy) = placed(lengths);
            // the tolerance is a thousand times the violation of the joints' constraints
            let off = distance(tip, [row[0], row[1]]);
            assert!(off < 1e-8, "{formulation}, {t} s: {row:?}, {tip:?}");
            // the machine is at rest before the first and after the last motion
            if !(*t < 0.45 || *t > 7.6) {
                continue;
            }
            assert!((row[8] - energy).abs() < 1e-4, "{formulation}, {t} s: {} {energy} J", row[8]);
            for i in 0..3 {
                let slope = |h: f64| {
                    let mut lengths = lengths;
                    lengths[i] += h;
                    placed(lengths).1
                };
                // central differences of fourth order have a relative error of 1e-9
                let h = 1e-3;
                let right = (8.0 * (slope(h) - slope(-h)) - (slope(2.0 * h) - slope(-2.0 * h)))
                    / (12.0 * h);
                let force = row[3 + 2 * i];
                assert!(
                    (force - right).abs() < 1e-5 * right.abs(),
                    "{formulation}, {t} s, {i}: {force} {right} N"
                );
            }
        }
    }
}

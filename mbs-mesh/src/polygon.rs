//! Polygons as triangles: those of four corners at the shorter diagonal, larger ones ear by ear.

type Point = [f64; 3];

/// Corners up to which ears are looked for [-]: their search takes the cube of them. Chosen, not tuned.
const MOST_CORNERS: usize = 64;

fn minus(a: Point, b: Point) -> Point {
    core::array::from_fn(|i| a[i] - b[i])
}

fn dot(a: Point, b: Point) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: Point, b: Point) -> Point {
    core::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

/// The triangles of a polygon of three or more corners. MuJoCo reads an OBJ so: where the corners are not in one plane, or dents count, a
/// volume depends on it.
pub(crate) fn triangles(corners: &[usize], place: impl Fn(usize) -> Point) -> Vec<[usize; 3]> {
    match *corners {
        [a, b, c, d] => {
            let [ac, bd] = [[a, c], [b, d]].map(|[a, c]| {
                let way = minus(place(a), place(c));
                dot(way, way)
            });
            if ac < bd { vec![[a, b, c], [a, c, d]] } else { vec![[a, b, d], [b, c, d]] }
        }
        _ => ears(corners, place),
    }
}

/// Cuts ears off as long as there are any; what has none, or too many corners, is a fan.
fn ears(corners: &[usize], place: impl Fn(usize) -> Point) -> Vec<[usize; 3]> {
    let mut left = corners.to_vec();
    let normal = normal(corners, &place);
    let mut found = Vec::with_capacity(corners.len().saturating_sub(2));
    while left.len() > 3 && corners.len() <= MOST_CORNERS {
        let n = left.len();
        let ear = (0..n).find(|&i| {
            let [a, b, c] = [left[i], left[(i + 1) % n], left[(i + 2) % n]];
            let others = left.iter().filter(|&&other| other != a && other != b && other != c);
            let [pa, pb, pc] = [a, b, c].map(&place);
            turn(pa, pb, pc, normal) > 0.0
                && !others.into_iter().any(|&other| is_within(place(other), [pa, pb, pc], normal))
        });
        let Some(i) = ear else { break };
        found.push([left[i], left[(i + 1) % n], left[(i + 2) % n]]);
        left.remove((i + 1) % n);
    }
    found.extend(left[1..].windows(2).map(|pair| [left[0], pair[0], pair[1]]));
    found
}

/// Twice the area of the polygon along its normal.
fn normal(corners: &[usize], place: &impl Fn(usize) -> Point) -> Point {
    let first = place(corners[0]);
    corners.windows(2).fold([0.0; 3], |sum, pair| {
        let part = cross(minus(place(pair[0]), first), minus(place(pair[1]), first));
        core::array::from_fn(|i| sum[i] + part[i])
    })
}

/// How far the way from a to b to c turns to the left, seen against the normal.
fn turn(a: Point, b: Point, c: Point, normal: Point) -> f64 {
    dot(cross(minus(b, a), minus(c, b)), normal)
}

/// Is a place in a triangle or on its edge?
fn is_within(x: Point, [a, b, c]: [Point; 3], normal: Point) -> bool {
    [[a, b], [b, c], [c, a]].into_iter().all(|[a, b]| turn(a, b, x, normal) >= 0.0)
}

//! Triangulation of the polygons of an OBJ file, the same as that of MuJoCo 4.0.0. A polygon of four corners is cut at the shorter diagonal.
//! A larger one is projected along an axis of the file and cut by ears. The test for an ear depends on the side on which an edge passes the
//! origin, so that triangles may be lost.

/// Largest number of corners of a polygon that MuJoCo reads [-]. The number was measured with regular polygons of 98 to 600 corners.
const MOST_CORNERS: usize = 100;

type Point = [f64; 3];

fn minus(a: Point, b: Point) -> Point {
    core::array::from_fn(|i| a[i] - b[i])
}

/// Returns the triangles of a polygon of three or more corners, and the corners of the part that MuJoCo loses. If the corners are not in
/// one plane, or if the volume rule counts dents, the volume of a mesh depends on both results.
pub(crate) fn triangles(
    corners: &[usize],
    place: impl Fn(usize) -> Point,
) -> (Vec<[usize; 3]>, Vec<usize>) {
    match *corners {
        [a, b, c, d] => {
            let [ac, bd] = [[a, c], [b, d]].map(|[a, c]| {
                let way = minus(place(a), place(c));
                way.iter().map(|part| part * part).sum::<f64>()
            });
            let found =
                if ac < bd { vec![[a, b, c], [a, c, d]] } else { vec![[a, b, d], [b, c, d]] };
            (found, Vec::new())
        }
        _ if corners.len() > MOST_CORNERS => (Vec::new(), corners.to_vec()),
        _ => ears(corners, place),
    }
}

/// Returns the triangles of a polygon about its first corner.
pub(crate) fn fan(corners: &[usize]) -> impl Iterator<Item = [usize; 3]> + '_ {
    let (first, rest) = corners.split_first().map_or((0, &[][..]), |(first, rest)| (*first, rest));
    rest.windows(2).map(move |pair| [first, pair[0], pair[1]])
}

/// Cuts ears until three corners are left, or until one pass around the polygon finds none.
fn ears(corners: &[usize], place: impl Fn(usize) -> Point) -> (Vec<[usize; 3]>, Vec<usize>) {
    let axes = axes_seen(corners, &place);
    let seen = |corner: usize| axes.map(|axis| place(corner)[axis] as f32);
    let mut left = corners.to_vec();
    let mut found = Vec::with_capacity(corners.len().saturating_sub(2));
    let (mut at, mut looks, mut before) = (0, left.len(), left.len());
    while left.len() > 3 && looks > 0 {
        let n = left.len();
        // as in MuJoCo, the first trial counts in the first pass only: if the last trial of the first pass finds an ear, the search ends
        looks = if n == before { looks - 1 } else { n };
        before = n;
        at %= n;
        let ear = core::array::from_fn(|k| left[(at + k) % n]);
        let mut others = (3..n).map(|k| seen(left[(at + k) % n]));
        let places = ear.map(seen);
        if turns_as_the_origin_is_passed(places) && !others.any(|other| is_within(other, places)) {
            found.push(ear);
            left.remove((at + 1) % n);
        } else {
            at += 1;
        }
    }
    if let [a, b, c] = left[..] {
        found.push([a, b, c]);
        left.clear();
    }
    (found, left)
}

/// Returns the two axes orthogonal to the axis closest to the polygon's normal. The normal is that of the first corner that is not
/// straight.
fn axes_seen(corners: &[usize], place: &impl Fn(usize) -> Point) -> [usize; 2] {
    let n = corners.len();
    let normal = (0..n).find_map(|i| {
        let [a, b, c] = core::array::from_fn(|k| place(corners[(i + k) % n]).map(|x| x as f32));
        let [before, after]: [[f32; 3]; 2] =
            [core::array::from_fn(|i| b[i] - a[i]), core::array::from_fn(|i| c[i] - b[i])];
        let [x, y, z] = core::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            (before[j] * after[k] - before[k] * after[j]).abs()
        });
        [x, y, z].into_iter().any(|part| part > f32::EPSILON).then_some([x, y, z])
    });
    match normal {
        None => [1, 2],
        Some([x, y, z]) if x > y && x > z => [1, 2],
        Some([x, y, z]) if z > x && z > y => [0, 1],
        Some(_) => [0, 2],
    }
}

/// True if the corner turns to the side on which its first edge passes the origin, or goes straight on.
fn turns_as_the_origin_is_passed([a, b, c]: [[f32; 2]; 3]) -> bool {
    let turn = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
    let passed = (a[0] * b[1] - a[1] * b[0]) * 0.5;
    // a product as in MuJoCo's reader, because the product may underflow to zero
    !(turn * passed < 0.0)
}

/// True if a point is inside a triangle. The test counts the edges that a ray along the first axis crosses.
fn is_within([x, y]: [f32; 2], triangle: [[f32; 2]; 3]) -> bool {
    let crossings = [[0, 2], [1, 0], [2, 1]].map(|ends| {
        let [a, b] = ends.map(|end| triangle[end]);
        (a[1] > y) != (b[1] > y) && x < (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) + a[0]
    });
    crossings.into_iter().filter(|crosses| *crosses).count() % 2 == 1
}

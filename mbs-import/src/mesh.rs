//! Triangles of a surface, and the mass of what they enclose.

use crate::inertia::Mass;
use crate::pose::{M3, V3, v3};
use std::collections::HashMap;

/// A surface of triangles.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Mesh {
    pub(crate) vertices: Vec<V3>,
    pub(crate) triangles: Vec<[usize; 3]>,
}

/// Reads the bytes of a file by its ending; the message says what is wrong.
pub(crate) fn read(bytes: &[u8], ending: &str) -> Result<Mesh, String> {
    let mesh = match ending {
        "stl" => stl(bytes),
        "obj" => obj(bytes),
        "msh" => msh(bytes),
        other => Err(format!("files `.{other}` are not read: give STL or OBJ")),
    }?;
    if mesh.triangles.iter().flatten().any(|i| *i >= mesh.vertices.len()) {
        return Err("a triangle has a vertex that is not there".to_owned());
    }
    if mesh.vertices.iter().flatten().any(|x| !x.is_finite()) {
        return Err("a vertex is not finite".to_owned());
    }
    Ok(mesh)
}

/// Little-endian numbers of four bytes.
struct Words<'a>(&'a [u8]);

impl Words<'_> {
    fn next(&mut self) -> Result<[u8; 4], String> {
        let (word, rest) = self.0.split_first_chunk().ok_or("the file ends within its numbers")?;
        self.0 = rest;
        Ok(*word)
    }

    fn number(&mut self) -> Result<f64, String> {
        self.next().map(|word| f64::from(f32::from_le_bytes(word)))
    }

    fn vertex(&mut self) -> Result<V3, String> {
        Ok(v3([self.number()?, self.number()?, self.number()?]))
    }

    fn count(&mut self) -> Result<usize, String> {
        let count = i32::from_le_bytes(self.next()?);
        usize::try_from(count).map_err(|_| format!("a count is {count}"))
    }
}

/// Vertices that are the same are one.
#[derive(Default)]
struct Joined {
    mesh: Mesh,
    numbers: HashMap<[u64; 3], usize>,
}

impl Joined {
    fn vertex(&mut self, x: V3) -> usize {
        // both zeros are one
        let key = [x[0], x[1], x[2]].map(|x| (x + 0.0).to_bits());
        let next = self.mesh.vertices.len();
        let number = *self.numbers.entry(key).or_insert(next);
        if number == next {
            self.mesh.vertices.push(x);
        }
        number
    }
}

/// STL: a head of 80 bytes and a count, or text.
fn stl(bytes: &[u8]) -> Result<Mesh, String> {
    /// Bytes of the head, and of each triangle.
    const SIZES: [usize; 2] = [80, 50];
    let mut joined = Joined::default();
    let count = bytes.get(SIZES[0]..).map(|rest| Words(rest).count());
    let is_binary = count.as_ref().is_some_and(|n| {
        n.as_ref().is_ok_and(|n| n.checked_mul(SIZES[1]) == bytes.len().checked_sub(SIZES[0] + 4))
    });
    if is_binary {
        for triangle in bytes[SIZES[0] + 4..].chunks_exact(SIZES[1]) {
            let mut words = Words(triangle);
            // the normal follows from the vertices
            words.vertex()?;
            let three = [words.vertex()?, words.vertex()?, words.vertex()?];
            let three = three.map(|x| joined.vertex(x));
            joined.mesh.triangles.push(three);
        }
        return Ok(joined.mesh);
    }
    let text = core::str::from_utf8(bytes).map_err(|_| "neither binary STL nor its text")?;
    let mut words = text.split_ascii_whitespace();
    let mut three = Vec::new();
    while let Some(word) = words.next() {
        if word == "vertex" {
            let mut number = || words.next().and_then(|x| x.parse::<f64>().ok());
            let [x, y, z] =
                [number(), number(), number()].map(|x| x.ok_or("a vertex without three numbers"));
            three.push(joined.vertex(v3([x?, y?, z?])));
        }
        if let [a, b, c] = three[..] {
            joined.mesh.triangles.push([a, b, c]);
            three.clear();
        }
    }
    Ok(joined.mesh)
}

/// OBJ: lines `v x y z` and `f a b c ...`, of which each may be `a/b/c` and counts from 1, or from the end.
fn obj(bytes: &[u8]) -> Result<Mesh, String> {
    let text = core::str::from_utf8(bytes).map_err(|_| "the file is not UTF-8 text")?;
    let (mut joined, mut numbers) = (Joined::default(), Vec::new());
    for (i, line) in text.lines().enumerate() {
        let mut words = line.split_ascii_whitespace();
        let fault = || format!("line {}: {line}", i + 1);
        match words.next() {
            Some("v") => {
                let mut number =
                    || words.next().and_then(|x| x.parse::<f64>().ok()).ok_or_else(fault);
                let x = v3([number()?, number()?, number()?]);
                numbers.push(joined.vertex(x));
            }
            Some("f") => {
                let number = |word: &str| {
                    let i = word.split('/').next()?.parse::<i64>().ok()?;
                    let n = i64::try_from(numbers.len()).ok()?;
                    let at = usize::try_from(if i < 0 { n + i } else { i - 1 }).ok()?;
                    numbers.get(at).copied()
                };
                let face: Option<Vec<usize>> = words.map(number).collect();
                let face = face.filter(|face| face.len() > 2).ok_or_else(fault)?;
                // a face of more corners is a fan
                joined
                    .mesh
                    .triangles
                    .extend(face[1..].windows(2).map(|pair| [face[0], pair[0], pair[1]]));
            }
            _ => {}
        }
    }
    Ok(joined.mesh)
}

/// The older binary form of MuJoCo: four counts, vertices, normals, texture coordinates, triangles.
fn msh(bytes: &[u8]) -> Result<Mesh, String> {
    let mut words = Words(bytes);
    let [vertices, normals, coordinates, triangles] =
        [words.count()?, words.count()?, words.count()?, words.count()?];
    let mut joined = Joined::default();
    let mut numbers = Vec::new();
    for _ in 0..vertices {
        let x = words.vertex()?;
        numbers.push(joined.vertex(x));
    }
    for _ in 0..normals {
        words.vertex()?;
    }
    for _ in 0..coordinates {
        words.number()?;
        words.number()?;
    }
    for _ in 0..triangles {
        let three = [words.count()?, words.count()?, words.count()?];
        let found = three.map(|i| numbers.get(i).copied());
        let [Some(a), Some(b), Some(c)] = found else {
            return Err("a triangle has a vertex that is not there".into());
        };
        joined.mesh.triangles.push([a, b, c]);
    }
    Ok(joined.mesh)
}

/// How the tetrahedra between a point and the triangles count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Count {
    /// With the sign of their volume: the enclosed volume, of a closed surface alone.
    Signed,
    /// Each as a volume: the centre from the centre of the surface, the rest from that centre. Dents count too, and holes do no harm.
    Unsigned,
}

impl Mesh {
    /// The edge that no other triangle has the other way round; `None` where the surface is closed.
    pub(crate) fn open_edge(&self) -> Option<[usize; 2]> {
        let mut edges: HashMap<[usize; 2], i64> = HashMap::new();
        for [a, b, c] in &self.triangles {
            for [a, b] in [[*a, *b], [*b, *c], [*c, *a]] {
                if a != b {
                    *edges.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
                }
            }
        }
        edges.into_iter().filter(|(_, sum)| *sum != 0).map(|(edge, _)| edge).min()
    }

    /// Mass, centre and tensor at a density [kg/m³]; a surface that is turned inside out has a mass below zero.
    pub(crate) fn mass(&self, density: f64, count: Count) -> Mass {
        let center = match count {
            Count::Signed => {
                self.sums(&self.vertices.first().copied().unwrap_or_default(), count).1
            }
            Count::Unsigned => self.sums(&self.surface_center(), count).1,
        };
        // about the centre that was found; the sums of volumes differ where tetrahedra are not signed
        let (volume, _, second) = self.sums(&center, count);
        let tensor = (M3::identity() * second.trace() - second) * density;
        Mass { mass: volume * density, center, tensor }
    }

    /// Volume, its centre, and its second moments about a point.
    fn sums(&self, origin: &V3, count: Count) -> (f64, V3, M3) {
        let (mut volume, mut first, mut second) = (0.0, V3::zeros(), M3::zeros());
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|i| self.vertices[i] - origin);
            let part = a.dot(&b.cross(&c)) / 6.0;
            let part = if count == Count::Unsigned { part.abs() } else { part };
            let sum = a + b + c;
            volume += part;
            first += sum * (part / 4.0);
            let squares = a * a.transpose() + b * b.transpose() + c * c.transpose();
            second += (sum * sum.transpose() + squares) * (part / 20.0);
        }
        let center = if volume == 0.0 { *origin } else { origin + first / volume };
        (volume, center, second)
    }

    /// The centre of the triangles, by their areas.
    fn surface_center(&self) -> V3 {
        let (mut area, mut sum) = (0.0, V3::zeros());
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|i| self.vertices[i]);
            let part = (b - a).cross(&(c - a)).norm() / 2.0;
            area += part;
            sum += (a + b + c) * (part / 3.0);
        }
        if area > 0.0 { sum / area } else { V3::zeros() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box of 1, 2 and 3 m at a corner of the origin.
    const BOX: &str = "\
v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3/1 4/2/3 8//1 7\nf -5 -8 -4 -1\n";

    #[test]
    fn a_box_has_the_mass_and_the_moments_of_a_box() {
        let mesh = read(BOX.as_bytes(), "obj").expect("read");
        assert_eq!((mesh.vertices.len(), mesh.triangles.len(), mesh.open_edge()), (8, 12, None));
        for count in [Count::Signed, Count::Unsigned] {
            let mass = mesh.mass(2.0, count);
            // m (b² + c²)/12 with m = 12
            let expected = [12.0, 0.5, 1.0, 1.5, 13.0, 10.0, 5.0, 0.0, 0.0, 0.0];
            let found = [&[mass.mass][..], mass.center.as_slice(), &mass.six()].concat();
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1.0e-14, "{count:?}: {found} {expected}");
            }
        }
    }

    #[test]
    fn an_open_surface_and_a_wrong_one_are_seen() {
        let open = read(BOX.replace("f 5 6 7 8\n", "").as_bytes(), "obj").expect("read");
        assert_eq!(open.open_edge(), Some([4, 5]));
        let mut inside_out = read(BOX.as_bytes(), "obj").expect("read");
        inside_out.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
        assert!((inside_out.mass(1.0, Count::Signed).mass + 6.0).abs() < 1.0e-14);
        assert!(read(b"v 0 0 0\nf 1 2 3\n", "obj").is_err_and(|why| why == "line 2: f 1 2 3"));
        assert!(read(b"solid\nvertex 0 0\n", "stl").is_err());
        assert!(read(&[0; 20], "msh").is_err_and(|_| true) || read(&[0; 16], "msh").is_ok());
    }

    #[test]
    fn binary_and_text_of_one_surface_are_one_surface() {
        let mesh = read(BOX.as_bytes(), "obj").expect("read");
        let (mut text, mut bytes) = ("solid box\n".to_owned(), vec![0; 80]);
        bytes.extend(12_u32.to_le_bytes());
        for triangle in &mesh.triangles {
            text += "facet normal 0 0 0\nouter loop\n";
            bytes.extend([0; 12]);
            for x in triangle.map(|i| mesh.vertices[i]) {
                text += &format!("vertex {} {} {}\n", x[0], x[1], x[2]);
                x.iter().for_each(|x| bytes.extend((*x as f32).to_le_bytes()));
            }
            text += "endloop\nendfacet\n";
            bytes.extend([0; 2]);
        }
        let [one, other] = [text.as_bytes(), &bytes].map(|bytes| read(bytes, "stl").expect("read"));
        assert_eq!(one, other);
        assert_eq!((one.vertices.len(), one.open_edge()), (8, None));
    }
}

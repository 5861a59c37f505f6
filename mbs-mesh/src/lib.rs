#![doc = include_str!("../README.md")]

mod hull;
mod polygon;
mod simplify;
mod solid;

use core::fmt::{self, Display, Formatter};
pub use hull::hull;
use polygon::{fan, triangles};
pub use solid::{Solid, VolumeRule};
use std::collections::HashMap;
use std::io::{ErrorKind, Read as _};
use std::path::Path;

/// Extensions of the files that can be read, in lower case.
pub const MESH_ENDINGS: [&str; 3] = ["stl", "obj", "msh"];
/// Largest size of a file [bytes]. Chosen, not tuned.
const MOST_BYTES: u64 = 64 << 20;

/// A surface made of triangles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TriangleMesh {
    /// Points of the surface [m or the file's unit]. No two points are the same.
    pub vertices: Vec<[f64; 3]>,
    /// Indices of the three vertices of each triangle.
    pub triangles: Vec<[usize; 3]>,
}

/// Reason why a file cannot be read as a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshFault {
    /// The file cannot be read.
    File(ErrorKind),
    /// The extension of the file is none of [`MESH_ENDINGS`].
    Ending,
    /// The file is too large.
    TooLarge,
    /// The file does not contain text.
    NotText,
    /// The line with this number, counted from 1, does not follow the format.
    Line(usize),
    /// A vertex does not have three numbers.
    Vertex,
    /// The file ends before all its numbers.
    Ends,
    /// A count in the file is negative.
    Count,
    /// A triangle refers to a vertex that does not exist.
    Missing,
    /// A coordinate of a vertex is infinite or not a number.
    NotFinite,
}

impl Display for MeshFault {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(ErrorKind::NotFound) => f.write_str("there is no such file"),
            Self::File(kind) => write!(f, "{kind}"),
            Self::Ending => f.write_str("this format is not read: give STL or OBJ"),
            Self::TooLarge => write!(f, "more than {} MiB", MOST_BYTES >> 20),
            Self::NotText => f.write_str("it is no text"),
            Self::Line(line) => write!(f, "line {line} is wrong"),
            Self::Vertex => f.write_str("a vertex without three numbers"),
            Self::Ends => f.write_str("it ends within its numbers"),
            Self::Count => f.write_str("a count is below zero"),
            Self::Missing => f.write_str("a triangle has a vertex that is not there"),
            Self::NotFinite => f.write_str("a vertex is not finite"),
        }
    }
}

impl core::error::Error for MeshFault {}

/// Returns the extension of a file in lower case. Returns an empty text if the file has none.
#[must_use]
pub fn mesh_ending(path: &Path) -> String {
    path.extension().and_then(|x| x.to_str()).unwrap_or_default().to_ascii_lowercase()
}

impl TriangleMesh {
    /// Reads a surface from a file.
    ///
    /// # Errors
    /// [`MeshFault`] if the file cannot be read or is not a surface.
    pub fn read(path: &Path) -> Result<Self, MeshFault> {
        Self::read_parts(path, Parts::All)
    }

    /// Reads a surface from a file. From an OBJ file it reads all vertices, but only the triangles that MuJoCo reads: those of the first
    /// object or group that has triangles.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read).
    pub fn read_first(path: &Path) -> Result<Self, MeshFault> {
        Self::read_parts(path, Parts::First)
    }

    fn read_parts(path: &Path, parts: Parts) -> Result<Self, MeshFault> {
        let ending = mesh_ending(path);
        if !MESH_ENDINGS.contains(&ending.as_str()) {
            return Err(MeshFault::Ending);
        }
        let fault = |error: std::io::Error| MeshFault::File(error.kind());
        // opening a pipe would wait for a writer
        if !std::fs::metadata(path).map_err(fault)?.is_file() {
            return Err(MeshFault::File(ErrorKind::InvalidInput));
        }
        let mut bytes = Vec::new();
        let file = std::fs::File::open(path).map_err(fault)?;
        // reading one byte more than the limit shows that the file is larger
        file.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(fault)?;
        if bytes.len() as u64 > MOST_BYTES {
            return Err(MeshFault::TooLarge);
        }
        Self::of_parts(&bytes, &ending, parts)
    }

    /// Reads a surface from the bytes of a file with this extension.
    ///
    /// # Errors
    /// [`MeshFault`] if they are not a surface.
    pub fn of_bytes(bytes: &[u8], ending: &str) -> Result<Self, MeshFault> {
        Self::of_parts(bytes, ending, Parts::All)
    }

    fn of_parts(bytes: &[u8], ending: &str, parts: Parts) -> Result<Self, MeshFault> {
        let mesh = match ending {
            "stl" => stl(bytes),
            "obj" => obj(bytes, parts),
            "msh" => msh(bytes),
            _ => Err(MeshFault::Ending),
        }?;
        if mesh.vertices.iter().flatten().any(|x| !x.is_finite()) {
            return Err(MeshFault::NotFinite);
        }
        Ok(mesh)
    }
}

/// Objects of a file whose triangles are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Parts {
    All,
    First,
}

/// Reader of little-endian numbers of four bytes.
struct Words<'a>(&'a [u8]);

impl Words<'_> {
    fn next(&mut self) -> Result<[u8; 4], MeshFault> {
        let (word, rest) = self.0.split_first_chunk().ok_or(MeshFault::Ends)?;
        self.0 = rest;
        Ok(*word)
    }

    fn number(&mut self) -> Result<f64, MeshFault> {
        self.next().map(|word| f64::from(f32::from_le_bytes(word)))
    }

    fn vertex(&mut self) -> Result<[f64; 3], MeshFault> {
        Ok([self.number()?, self.number()?, self.number()?])
    }

    fn count(&mut self) -> Result<usize, MeshFault> {
        let count = i32::from_le_bytes(self.next()?);
        usize::try_from(count).map_err(|_| MeshFault::Count)
    }
}

/// A mesh in which equal vertices are stored once.
#[derive(Default)]
struct Joined {
    mesh: TriangleMesh,
    numbers: HashMap<[u64; 3], usize>,
}

impl Joined {
    fn vertex(&mut self, x: [f64; 3]) -> usize {
        // -0 and +0 are the same
        let key = x.map(|x| (x + 0.0).to_bits());
        let next = self.mesh.vertices.len();
        let number = *self.numbers.entry(key).or_insert(next);
        if number == next {
            self.mesh.vertices.push(x);
        }
        number
    }
}

/// Returns the next three words as numbers. Returns `None` if one of them is not a number.
fn coordinates<'a>(words: &mut impl Iterator<Item = &'a str>) -> Option<[f64; 3]> {
    let mut number = || words.next()?.parse().ok();
    Some([number()?, number()?, number()?])
}

/// Reads an STL file. It is either text, or binary with a header of 80 bytes and a count.
fn stl(bytes: &[u8]) -> Result<TriangleMesh, MeshFault> {
    /// Size of the header, and of each triangle [bytes].
    const SIZES: [usize; 2] = [80, 50];
    let mut joined = Joined::default();
    let count = bytes.get(SIZES[0]..).and_then(|rest| Words(rest).count().ok());
    let is_binary =
        count.is_some_and(|n| n.checked_mul(SIZES[1]) == bytes.len().checked_sub(SIZES[0] + 4));
    if is_binary {
        for triangle in bytes[SIZES[0] + 4..].chunks_exact(SIZES[1]) {
            let mut words = Words(triangle);
            // the normal is skipped, since it follows from the vertices
            words.vertex()?;
            let three = [words.vertex()?, words.vertex()?, words.vertex()?];
            let three = three.map(|x| joined.vertex(x));
            joined.mesh.triangles.push(three);
        }
        return Ok(joined.mesh);
    }
    let text = core::str::from_utf8(bytes).map_err(|_| MeshFault::NotText)?;
    let mut words = text.split_ascii_whitespace();
    let mut three = Vec::new();
    while let Some(word) = words.next() {
        if word == "vertex" {
            let x = coordinates(&mut words).ok_or(MeshFault::Vertex)?;
            three.push(joined.vertex(x));
        }
        if let [a, b, c] = three[..] {
            joined.mesh.triangles.push([a, b, c]);
            three.clear();
        }
    }
    Ok(joined.mesh)
}

/// Reads an OBJ file: lines `v x y z` and `f a b c ...`. A corner may be `a/b/c`. Indices count from 1, and negative indices count from the
/// last vertex.
fn obj(bytes: &[u8], parts: Parts) -> Result<TriangleMesh, MeshFault> {
    let text = core::str::from_utf8(bytes).map_err(|_| MeshFault::NotText)?;
    let (mut joined, mut numbers, mut counts) = (Joined::default(), Vec::new(), true);
    for (i, line) in text.lines().enumerate() {
        let mut words = line.split_ascii_whitespace();
        let fault = || MeshFault::Line(i + 1);
        match words.next() {
            Some("v") => {
                let x = coordinates(&mut words).ok_or_else(fault)?;
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
                if counts {
                    let (cut, lost) = triangles(&face, |i| joined.mesh.vertices[i]);
                    joined.mesh.triangles.extend(cut);
                    if parts == Parts::All {
                        joined.mesh.triangles.extend(fan(&lost));
                    }
                }
            }
            Some("o" | "g") => counts &= parts == Parts::All || joined.mesh.triangles.is_empty(),
            _ => {}
        }
    }
    Ok(joined.mesh)
}

/// Reads the older binary format of MuJoCo: four counts, vertices, normals, texture coordinates, triangles.
fn msh(bytes: &[u8]) -> Result<TriangleMesh, MeshFault> {
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
            return Err(MeshFault::Missing);
        };
        joined.mesh.triangles.push([a, b, c]);
    }
    Ok(joined.mesh)
}

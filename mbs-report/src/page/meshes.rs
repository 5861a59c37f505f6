//! Meshes of a page. Each file is read once. If there are too many triangles, vertices are merged.

use super::pack::{Pack, ends};
use mbs::record::{RecordedMotion, ShapeForm};
use mbs_scene::TriangleMesh;
use mbs_scene::format::counted;
use serde_json::{Value, json};
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// Largest number of triangles on a page [-]. All of them are drawn in every picture. They need a hundred kilobytes.
const MOST_TRIANGLES: usize = 20_000;
/// The search for a cell size ends if the number of triangles is at least this fraction of the largest number [-]. Chosen, not tuned.
const ENOUGH: f64 = 0.8;
/// Number of cell sizes that are tried [-]. Chosen, not tuned.
const TRIALS: usize = 6;
/// Number of steps along the longest side of a mesh [-]. A step is 0.06 mm for a mesh of one metre. Most differences of vertices then need
/// two bytes.
const STEPS: f64 = 16_383.0;
/// Largest number of file names in a note [-].
const NAMED: usize = 3;

/// Meshes of a motion, and notes on these meshes for the reader of the page.
#[derive(Debug, Default)]
pub(super) struct PageMeshes {
    /// Meshes in the form in which they are drawn.
    list: Vec<TriangleMesh>,
    /// Indices of the meshes by the names of their files.
    by_file: HashMap<String, usize>,
    pub(super) notes: Vec<String>,
}

impl PageMeshes {
    /// Reads the files of all drawn meshes.
    pub(super) fn of(motion: &RecordedMotion) -> Self {
        let (mut meshes, mut scales, mut uses) = (Self::default(), Vec::new(), Vec::new());
        let mut lost: Vec<String> = Vec::new();
        let mut tried = HashSet::new();
        for shape in &motion.shapes {
            let ShapeForm::Mesh { file, axes, .. } = &shape.form else { continue };
            if tried.insert(file.as_str()) {
                match TriangleMesh::read(Path::new(file)) {
                    Ok(mesh) if mesh.triangles.is_empty() => {
                        lost.push(format!("{} (no triangles)", name(file)));
                    }
                    Ok(mesh) => {
                        meshes.by_file.insert(file.clone(), meshes.list.len());
                        meshes.list.push(mesh.used());
                        scales.push(0.0_f64);
                        uses.push(0);
                    }
                    Err(why) => lost.push(format!("{} ({why})", name(file))),
                }
            }
            if let Some(number) = meshes.by_file.get(file) {
                let longest = axes.iter().map(|axis| axis.iter().map(|x| x * x).sum::<f64>());
                scales[*number] = longest.fold(scales[*number], |a, b| a.max(b.sqrt()));
                uses[*number] += 1;
            }
        }
        meshes.say_lost(&lost);
        meshes.simplify(&scales, &uses);
        meshes
    }

    fn say_lost(&mut self, lost: &[String]) {
        if lost.is_empty() {
            return;
        }
        let more = match lost.len().saturating_sub(NAMED) {
            0 => String::new(),
            n => format!(", and {n} more"),
        };
        let named = lost.iter().take(NAMED).cloned().collect::<Vec<_>>().join(", ");
        let count = counted(lost.len(), "mesh file");
        self.notes.push(format!("Not drawn, since it cannot be read: {count}: {named}{more}."));
    }

    /// Merges the vertices in each cell of a grid until there are few enough triangles. `scales` are the lengths of the files' units [m].
    fn simplify(&mut self, scales: &[f64], uses: &[usize]) {
        let drawn = |list: &[TriangleMesh]| -> usize {
            list.iter().zip(uses).map(|(mesh, uses)| mesh.triangles.len() * uses).sum()
        };
        let whole = drawn(&self.list);
        if whole <= MOST_TRIANGLES {
            return;
        }
        let areas = self.list.iter().zip(scales).zip(uses);
        #[allow(clippy::cast_precision_loss, reason = "counts of triangles are far below 2^53")]
        let (area, most) = (
            areas
                .map(|((mesh, scale), uses)| mesh.area() * scale * scale * *uses as f64)
                .sum::<f64>(),
            MOST_TRIANGLES as f64,
        );
        // a surface has about two triangles for each cell
        let mut cell = (2.0 * area / most).sqrt();
        let mut best: Option<(f64, Vec<TriangleMesh>)> = None;
        for _ in 0..TRIALS {
            let list = self.list.iter().zip(scales);
            let list: Vec<_> = list.map(|(mesh, scale)| mesh.clustered(cell / scale)).collect();
            let n = drawn(&list);
            #[allow(clippy::cast_precision_loss, reason = "counts of triangles are far below 2^53")]
            let share = n as f64 / most;
            if share <= 1.0 && best.as_ref().is_none_or(|(_, best)| drawn(best) < n) {
                best = Some((cell, list));
            }
            if (ENOUGH..=1.0).contains(&share) {
                break;
            }
            cell *= (share.max(0.01) / (0.5 * (ENOUGH + 1.0))).sqrt();
        }
        match best {
            Some((cell, list)) => {
                self.list = list;
                let cell = mbs_scene::format::few(1000.0 * cell);
                let drawn = drawn(&self.list);
                self.notes.push(format!(
                    "Of {whole} triangles of meshes {drawn} are drawn: corners nearer than about {cell} mm are one."
                ));
            }
            None => {
                (self.list, self.by_file) = (Vec::new(), HashMap::new());
                self.notes.push(format!("Meshes are not drawn: they have {whole} triangles."));
            }
        }
    }

    /// Returns the index of a file's mesh. Returns `None` if the mesh has no triangles to draw.
    pub(super) fn number(&self, file: &str) -> Option<usize> {
        let number = *self.by_file.get(file)?;
        (!self.list[number].triangles.is_empty()).then_some(number)
    }

    /// Packs the meshes into columns: the coordinates of vertices, and the vertex indices of the triangles.
    pub(super) fn packed(&self, pack: &mut Pack) -> Vec<Value> {
        let packed = self.list.iter().map(|mesh| {
            let column =
                |i: usize| -> Vec<f64> { mesh.vertices.iter().map(|vertex| vertex[i]).collect() };
            let columns = [column(0), column(1), column(2)];
            let sides = columns.iter().filter_map(|column| ends(column));
            let side = sides.map(|[low, high]| high - low).fold(0.0, f64::max);
            let step = if side > 0.0 { side / STEPS } else { 1.0 };
            #[allow(clippy::cast_precision_loss, reason = "numbers of vertices are far below 2^53")]
            let numbers = |i: usize| -> Vec<f64> {
                mesh.triangles.iter().map(|triangle| triangle[i] as f64).collect()
            };
            let places = pack.fixed(&columns, step);
            json!({ "places": places, "triangles": pack.fixed(&[numbers(0), numbers(1), numbers(2)], 1.0) })
        });
        packed.collect()
    }
}

/// Returns the name of a file without its folders, because other persons may get the page.
fn name(file: &str) -> String {
    Path::new(file)
        .file_name()
        .map_or_else(|| file.to_owned(), |name| name.to_string_lossy().into_owned())
}

//! The meshes of a page: files that are read once, and corners that become one where there are too many triangles.

use super::pack::{Pack, ends};
use mbs::record::{RecordedMotion, ShapeForm};
use mbs_scene::TriangleMesh;
use mbs_scene::format::counted;
use serde_json::{Value, json};
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// Most triangles of a page [-]: they are drawn at every picture, and take a hundred kilobytes.
const MOST_TRIANGLES: usize = 20_000;
/// Fraction of them that is enough [-]. Chosen, not tuned.
const ENOUGH: f64 = 0.8;
/// Lengths of cells that are tried [-]. Chosen, not tuned.
const TRIALS: usize = 6;
/// Steps of the longest side of a mesh [-]: 0.06 mm of a metre, so that most differences between corners take two bytes.
const STEPS: f64 = 16_383.0;
/// Files that a note names [-].
const NAMED: usize = 3;

/// The meshes of a motion, and what the reader of a page should know of them.
#[derive(Debug, Default)]
pub(super) struct PageMeshes {
    /// Meshes as they are drawn.
    list: Vec<TriangleMesh>,
    /// Numbers of the meshes by their files.
    by_file: HashMap<String, usize>,
    pub(super) notes: Vec<String>,
}

impl PageMeshes {
    /// Reads the files of all meshes that are drawn.
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

    /// Makes corners one that lie in one cell, until there are few enough triangles; `scales` are metres for each unit of the files.
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
        // two triangles stand on each cell
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

    /// The number of a file's mesh, where something of it is drawn.
    pub(super) fn number(&self, file: &str) -> Option<usize> {
        let number = *self.by_file.get(file)?;
        (!self.list[number].triangles.is_empty()).then_some(number)
    }

    /// The meshes in a pack: columns of places, and of the numbers of their triangles.
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

/// The name of a file without its folders: a page goes to others.
fn name(file: &str) -> String {
    Path::new(file)
        .file_name()
        .map_or_else(|| file.to_owned(), |name| name.to_string_lossy().into_owned())
}

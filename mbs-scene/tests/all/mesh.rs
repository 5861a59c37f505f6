//! Tests of mesh files in each format.

use mbs_scene::{MeshFault, TriangleMesh};
use std::io::ErrorKind;
use std::path::Path;

/// A box of 1 m, 2 m and 3 m with one corner at the origin.
const BOX: &str = "\
v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3/1 4/2/3 8//1 7\nf -5 -8 -4 -1\n";

#[test]
fn a_file_that_is_no_surface_is_refused() {
    let read = TriangleMesh::of_bytes;
    assert_eq!(read(b"v 0 0 0\nf 1 2 3\n", "obj"), Err(MeshFault::Line(2)));
    assert_eq!(read(b"solid\nvertex 0 0\n", "stl"), Err(MeshFault::Vertex));
    assert_eq!(read(&[255; 20], "msh"), Err(MeshFault::Count));
    assert_eq!(read(&[1, 0, 0, 0], "msh"), Err(MeshFault::Ends));
    assert_eq!(read(b"", "dae"), Err(MeshFault::Ending));
    let missing = TriangleMesh::read(Path::new("no/such/file.stl"));
    assert_eq!(missing, Err(MeshFault::File(ErrorKind::NotFound)));
}

#[test]
fn binary_and_text_of_one_surface_are_one_surface() {
    let mesh = TriangleMesh::of_bytes(BOX.as_bytes(), "obj").expect("read");
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
    let [one, other] =
        [text.as_bytes(), &bytes].map(|bytes| TriangleMesh::of_bytes(bytes, "stl").expect("read"));
    assert_eq!(one, other);
    assert_eq!((one.vertices.len(), one.triangles.len()), (8, 12));
}

//! Convex hulls of points in a box and at random.

use mbs_mesh::{TriangleMesh, VolumeRule, hull};

fn volume(mesh: &TriangleMesh) -> f64 {
    assert_eq!(mesh.open_edge(), None);
    mesh.solid(VolumeRule::Signed).size
}

/// Returns the points of a grid in a box of 1, 2 and 3 m, in a mixed order.
fn grid(n: usize) -> Vec<[f64; 3]> {
    let all = n * n * n;
    let at = |i: usize| {
        let i = i * 7919 % all;
        let x = [i % n, i / n % n, i / n / n].map(|x| x as f64 / (n - 1) as f64);
        [x[0], 2.0 * x[1], 3.0 * x[2]]
    };
    (0..all).map(at).collect()
}

#[test]
fn a_box_full_of_points_in_planes_and_lines_is_a_box() {
    for n in [2, 3, 4, 11] {
        let mesh = hull(&grid(n)).expect("a volume");
        assert!((volume(&mesh) - 6.0).abs() < 1.0e-12, "{n}: {}", volume(&mesh));
    }
}

#[test]
fn a_turned_and_shifted_box_is_the_same_box() {
    // three times a rotation matrix: the rows have a length of three
    let turn = [[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]];
    let at = [5.0, -2.0, 0.0];
    let points = grid(6).into_iter().map(|x| {
        let dot = |row: [f64; 3]| row.iter().zip(x).map(|(a, b)| a * b).sum::<f64>();
        core::array::from_fn(|i| dot(turn[i]) / 3.0 * 1.0e-3 + at[i])
    });
    let mesh = hull(&points.collect::<Vec<_>>()).expect("a volume");
    assert!((volume(&mesh) / 6.0e-9 - 1.0).abs() < 1.0e-8, "{}", volume(&mesh));
}

#[test]
fn every_point_is_within_the_hull_of_a_cloud() {
    let mut state = 5_u64;
    let mut number = || {
        // Knuth's generator of pseudo-random numbers for MMIX
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / (1_u64 << 31) as f64
    };
    let points: Vec<[f64; 3]> = (0..500).map(|_| core::array::from_fn(|_| number())).collect();
    let mesh = hull(&points).expect("a volume");
    assert!((0.8..1.0).contains(&volume(&mesh)));
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|i| mesh.vertices[i]);
        let minus = |x: [f64; 3], y: [f64; 3]| [x[0] - y[0], x[1] - y[1], x[2] - y[2]];
        let (u, v) = (minus(b, a), minus(c, a));
        let normal =
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        for point in &points {
            let height: f64 = minus(*point, a).iter().zip(normal).map(|(x, n)| x * n).sum();
            assert!(height < 1.0e-12);
        }
    }
}

#[test]
fn points_of_one_plane_have_no_hull() {
    let flat = |x: f64, y: f64| [x, y, 2.0 * x - y];
    assert_eq!(hull(&[flat(0.0, 0.0), flat(1.0, 0.0), flat(0.0, 1.0), flat(1.0, 1.0)]), None);
    assert_eq!(hull(&[]), None);
    assert_eq!(hull(&[[1.0, 2.0, 3.0]; 9]), None);
}

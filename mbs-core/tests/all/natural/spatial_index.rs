//! Search for points that are near each other.

use mbs_core::algebra::Vector;
use mbs_core::inside::natural::SpatialIndex;

/// Distance within which points count as equal [m].
const TOLERANCE: f64 = 1e-9;

#[test]
fn what_is_near_is_found_whatever_the_number_of_places_and_the_side_of_a_cell() {
    let mut index = SpatialIndex::new(TOLERANCE);
    let mut places: Vec<Vector<f64, 3>> = Vec::new();
    for i in 0..100_usize {
        let at = Vector::<f64, 3>::new(i as f64 * 0.1, -(i as f64), 4e-9 * i as f64);
        for shift in [0.0, 0.9 * TOLERANCE, -0.9 * TOLERANCE] {
            let moved = at + Vector::<f64, 3>::new(shift, 0.0, 0.0);
            let same = |k: usize| (places[k] - moved).norm() <= TOLERANCE;
            let found = index.first(&[moved], same, |k| places[k]);
            assert_eq!(found, places.iter().position(|p| (p - moved).norm() <= TOLERANCE));
            if found.is_none() {
                index.push(places.len(), &moved);
                places.push(moved);
            }
        }
    }
    assert_eq!(places.len(), 100);
}

//! Which coordinates are the states.

use mbs::inside::tested::choose;

#[test]
fn the_first_independent_coordinates_are_states_and_bodies_fill_up() {
    let rows = |rows: &[[f64; 2]]| rows.iter().map(|row| row.to_vec()).collect::<Vec<_>>();
    // the second joint depends on the first, and the third is held
    let joints = rows(&[[1.0, 0.0], [-3.0, 1e-9], [1e-12, 0.0], [0.5, 0.1]]);
    assert_eq!(choose(&joints, 4), Some(vec![0, 3]));
    // almost dependent joints: the one with the largest independent part is chosen
    let near = rows(&[[1.0, 0.0], [1.0, 0.01], [1.0, 0.05]]);
    assert_eq!(choose(&near, 3), Some(vec![0, 2]));
    assert_eq!(choose(&near, 1), Some(vec![0, 2]));
    assert_eq!(choose(&rows(&[[1.0, 0.0], [2.0, 0.0]]), 1), None);
}

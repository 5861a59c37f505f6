//! Rotors on every coordinate of every kind of joint: natural coordinates and the tree give the same motion.

use super::head;
use crate::common::oracle::{TRAPEZOIDAL, Way, rows};
use mbs_testkit::scene;

/// Relative difference of motions in natural coordinates and in the tree, each extrapolated from two steps [-].
const SAME: f64 = 1e-9;

/// Scene of a body on a joint of a first body, which is on a universal joint. Every coordinate of the joint has a rotor.
fn on(joint: &str, coordinates: &[&str], is_reversed: bool) -> String {
    let bodies = if is_reversed { ["b", "a"] } else { ["a", "b"] };
    let rotors = coordinates.iter().enumerate().map(|(i, coordinate)| {
        let inertia = 1e-4 * (1.0 + i as f64);
        let name = if coordinate.is_empty() {
            String::new()
        } else {
            format!("coordinate = \"{coordinate}\"\n")
        };
        format!(
            "[[effect]]\nkind = \"rotor\"\njoint = \"j\"\n{name}inertia = {inertia:?}\nratio = 70.0\n"
        )
    });
    [
        head(3, "[0.3, -0.2, -9.81]"),
        "[[body]]\nname = \"a\"\nmass = 2.0\ncenter = [0.2, 0.1, -0.3]\ninertia = [0.1, 0.12, 0.09, 0.01, 0.0, -0.01]\n".into(),
        "[[body]]\nname = \"b\"\nmass = 1.5\ncenter = [0.6, 0.2, -0.5]\ninertia = [0.06, 0.05, 0.08, 0.0, 0.01, 0.005]\n".into(),
        "[[joint]]\nname = \"u\"\nkind = \"universal\"\nbodies = [\"ground\", \"a\"]\nat = [0.0, 0.0, 0.0]\naxes = [[1.0, 0.0, 0.2], [0.0, 1.0, 0.1]]\n".into(),
        "[[effect]]\nkind = \"rotor\"\njoint = \"u\"\ncoordinate = \"second\"\ninertia = 1e-4\nratio = 60.0\n".into(),
        format!("[[joint]]\nname = \"j\"\nbodies = {bodies:?}\nat = [0.4, 0.2, -0.4]\n{joint}"),
        rotors.collect(),
        "[[initial]]\njoint = \"u\"\nvalue = [0.1, -0.2]\nrate = [0.7, 0.5]\n".into(),
        "[[output]]\nname = \"p\"\nbody = \"b\"\nat = [0.6, 0.2, -0.5]\nquantity = \"position\"\n".into(),
        "[[output]]\nname = \"v\"\nbody = \"b\"\nat = [0.7, 0.2, -0.5]\nquantity = \"velocity\"\n".into(),
        "[[output]]\nname = \"a\"\nbody = \"b\"\nat = [0.7, 0.2, -0.5]\nquantity = \"acceleration\"\n".into(),
        "[[output]]\nname = \"e\"\nquantity = \"energy\"\n".into(),
        "[[output]]\nname = \"rj\"\njoint = \"j\"\nquantity = \"reaction\"\n".into(),
        "[[output]]\nname = \"ru\"\njoint = \"u\"\nquantity = \"reaction\"\n".into(),
    ]
    .concat()
}

/// Last row, extrapolated from two steps of the trapezoidal rule.
fn end(text: &str, formulation: &'static str) -> Vec<f64> {
    let [coarse, fine] = [5e-4, 2.5e-4].map(|step| {
        let rows = rows(&scene(text), Way(formulation, "trapezoidal"), (step, 0.1), 1);
        let rows = rows.unwrap_or_else(|e| panic!("{formulation}: {e}\n{text}"));
        rows.last().expect("a row").1.clone()
    });
    fine.iter().zip(&coarse).map(|(fine, coarse)| fine + (fine - coarse) / 3.0).collect()
}

#[test]
fn natural_coordinates_and_the_tree_agree_on_every_kind_of_joint() {
    let kinds: [(&str, &[&str]); 6] = [
        ("kind = \"revolute\"\naxis = [0.3, 1.0, 0.2]\n", &[""]),
        ("kind = \"prismatic\"\naxis = [0.3, 1.0, 0.2]\n", &[""]),
        ("kind = \"cylindrical\"\naxis = [0.3, 1.0, 0.2]\n", &["slide", "turn"]),
        (
            "kind = \"universal\"\naxes = [[0.3, 1.0, 0.2], [1.0, 0.0, -0.4]]\n",
            &["first", "second"],
        ),
        (
            "kind = \"planar\"\naxis = [0.3, 1.0, 0.2]\ndirection = [1.0, 0.0, 0.0]\n",
            &["x", "y", "turn"],
        ),
        ("kind = \"pin-in-slot\"\naxis = [0.3, 1.0, 0.2]\n", &["slide"]),
    ];
    for (joint, coordinates) in kinds {
        for is_reversed in [false, true] {
            let text = on(joint, coordinates, is_reversed);
            let ends = TRAPEZOIDAL.map(|formulation| (formulation, end(&text, formulation)));
            let (_, tree) = &ends[4];
            let size = tree.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
            for (formulation, found) in &ends[..4] {
                let off = found.iter().zip(tree).fold(0.0, |off, (x, y)| (x - y).abs().max(off));
                println!("{joint:?} {is_reversed} {formulation}: {:.1e}", off / size);
                assert!(off < SAME * size, "{joint} {formulation}: {found:?}, {tree:?}");
            }
        }
    }
}

#[test]
fn a_loop_is_cut_where_no_rotor_is() {
    // a four-bar linkage with a rotor at any joint conserves its energy
    let joints = ["a", "b", "c", "d"];
    for driven in joints {
        let text = [
            head(2, "[0.0, -9.81]"),
            "[[body]]\nname = \"crank\"\nmass = 1.0\ncenter = [0.0, 0.2]\ninertia = 0.02\n".into(),
            "[[body]]\nname = \"coupler\"\nmass = 2.0\ncenter = [0.5, 0.5]\ninertia = 0.2\n".into(),
            "[[body]]\nname = \"rocker\"\nmass = 1.5\ncenter = [1.0, 0.3]\ninertia = 0.1\n".into(),
            "[[joint]]\nname = \"a\"\nkind = \"revolute\"\nbodies = [\"ground\", \"crank\"]\nat = [0.0, 0.0]\n".into(),
            "[[joint]]\nname = \"b\"\nkind = \"revolute\"\nbodies = [\"crank\", \"coupler\"]\nat = [0.0, 0.4]\n".into(),
            "[[joint]]\nname = \"c\"\nkind = \"revolute\"\nbodies = [\"coupler\", \"rocker\"]\nat = [1.0, 0.6]\n".into(),
            "[[joint]]\nname = \"d\"\nkind = \"revolute\"\nbodies = [\"rocker\", \"ground\"]\nat = [1.0, 0.0]\n".into(),
            super::rotor(driven, 1e-4, 50.0),
            "[[initial]]\njoint = \"a\"\nrate = 1.0\n".into(),
            joints.map(|joint| super::output(joint, "rate")).concat(),
            "[[output]]\nname = \"r\"\njoint = \"b\"\nquantity = \"reaction\"\n".into(),
        ]
        .concat();
        let ends = TRAPEZOIDAL.map(|formulation| end(&text, formulation));
        let size = ends[4].iter().fold(1.0_f64, |size, x| size.max(x.abs()));
        for found in &ends[..4] {
            let off = found.iter().zip(&ends[4]).fold(0.0, |off, (x, y)| (x - y).abs().max(off));
            println!("{driven}: {:.1e}", off / size);
            assert!(off < SAME * size, "{driven}: {ends:?}");
        }
    }
}

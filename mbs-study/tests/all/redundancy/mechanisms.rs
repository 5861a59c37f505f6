//! Mechanisms with a redundancy known from textbooks: dependent sets, their nature, and remedies.

use super::support::{Build, GROUND, Point, diagnosis, dof, four_bar, sets};
use mbs_core::scene::{Dimension, JointId, JointKind};
use mbs_study::redundancy::{Linkage, Nature, diagnose, reference};
use mbs_testkit::retell;

const Z: Option<Point> = Some([0.0, 0.0, 1.0]);

#[test]
fn a_planar_four_bar_is_sound() {
    let mut b = Build::planar();
    four_bar(&mut b, 0.0);
    let d = diagnosis(&b.0);
    assert_eq!((d.sizes, dof(&d), d.sets.len()), ([8, 9, 8], 1, 0));
    assert!(d.gap > 1e6, "{}", d.gap);
}

#[test]
fn a_spatial_four_bar_has_three_redundancies_across_its_plane() {
    let mut b = Build::spatial();
    four_bar(&mut b, 0.0);
    let d = diagnosis(&b.0);
    assert_eq!((d.sizes, dof(&d)), ([20, 18, 17], 1));
    assert_eq!(sets(&d), [(vec![0, 1, 2, 3], 3, Nature::Structural)]);
    for member in &d.sets[0].members {
        // one force normal to the plane and two moments in it are not determined; loads in the plane are determined
        assert_eq!(member.open, [1, 2, 3]);
        assert_eq!(member.is_unique, [true, true, false, false, false, true]);
    }
    let cure =
        d.sets[0].remedy.as_ref().expect("revolute, spherical, cylindrical: two joints are enough");
    assert!(cure.changes.len() == 2 && cure.is_smallest && cure.body.is_none(), "{cure:?}");
    for change in &cure.changes {
        let joint = &mut b.0.joints[change.joint];
        joint.kind = change.kind;
        joint.axes[1] = change.axis.or(joint.axes[1]);
        if change.kind == JointKind::Spherical {
            joint.axes = [None; 2];
        }
    }
    let mended = diagnosis(&b.0);
    assert_eq!((mended.sets.len(), dof(&mended)), (0, 1), "the change made in the scene itself");
}

#[test]
fn two_mechanisms_on_one_ground_are_two_sets() {
    let mut b = Build::spatial();
    four_bar(&mut b, 0.0);
    four_bar(&mut b, 2.0);
    let arm = b.bar([5.0, 0.0, 0.0], [5.5, 0.0, 0.0]);
    b.pin(GROUND, arm, [5.0, 0.0, 0.0]);
    let expected =
        [vec![0, 1, 2, 3], vec![4, 5, 6, 7]].map(|joints| (joints, 3, Nature::Structural));
    assert_eq!(sets(&diagnosis(&b.0)), expected);
}

#[test]
fn a_third_crank_makes_all_six_pins_of_a_parallelogram_dependent() {
    let mut b = Build::planar();
    let top = |x: f64| [x + 0.2, 0.5, 0.0];
    let coupler = b.bar(top(0.0), top(2.0));
    for x in [0.0, 0.7, 2.0] {
        let crank = b.bar([x, 0.0, 0.0], top(x));
        b.pin(GROUND, crank, [x, 0.0, 0.0]);
        b.pin(crank, coupler, top(x));
    }
    let d = diagnosis(&b.0);
    assert_eq!(dof(&d), 1);
    assert_eq!(sets(&d), [((0..6).collect(), 1, Nature::Structural)]);
    let cure = d.sets[0].remedy.as_ref().expect("one crank may go");
    assert_eq!((cure.changes.len(), cure.body), (2, Some(3)), "{cure:?}");
}

#[test]
fn scott_russell_with_both_slides_has_one_redundancy_in_all_joints() {
    let mut b = Build::planar();
    let (s, c) = 0.9_f64.sin_cos();
    let [a, x, y] = [[c, s, 0.0], [2.0 * c, 0.0, 0.0], [0.0, 2.0 * s, 0.0]];
    let [crank, coupler] = [b.bar([0.0; 3], a), b.bar(x, y)];
    let [right, up] = [b.bar(x, x), b.bar(y, y)];
    b.pin(GROUND, crank, [0.0; 3]);
    b.pin(crank, coupler, a);
    b.pin(coupler, right, x);
    b.joint(JointKind::Prismatic, [GROUND, right], x, Some([1.0, 0.0, 0.0]));
    b.pin(coupler, up, y);
    b.joint(JointKind::Prismatic, [GROUND, up], y, Some([0.0, 1.0, 0.0]));
    let d = diagnosis(&b.0);
    assert_eq!((d.sizes, dof(&d)), ([12, 12, 11], 1));
    assert_eq!(sets(&d), [((0..6).collect(), 1, Nature::Structural)]);
    // the moments of the slides are determined; at a slide only the force across it is not determined
    assert_eq!(d.sets[0].members[3].is_unique, [true, false, true]);
}

/// Points and axes of a Bennett linkage with twists α, β and lengths sin α, sin β.
fn bennett(alpha: f64, beta: f64, theta: f64) -> ([Point; 4], [Point; 4], Point) {
    let other = ((0.5 * (beta + alpha)).sin() / (0.5 * (beta - alpha)).sin() / (0.5 * theta).tan())
        .atan()
        * 2.0;
    let angles = [theta, other, -theta, -other];
    let twists = [alpha, beta, alpha, beta];
    let (mut at, mut x, mut y, mut z) =
        ([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let mix = |a: Point, s: f64, b: Point, t: f64| [0, 1, 2].map(|i| s * a[i] + t * b[i]);
    let (mut places, mut axes) = ([[0.0; 3]; 4], [[0.0; 3]; 4]);
    for i in 0..4 {
        (places[i], axes[i]) = (at, z);
        let (s, c) = angles[i].sin_cos();
        (x, y) = (mix(x, c, y, s), mix(y, c, x, -s));
        at = mix(at, 1.0, x, twists[i].sin());
        let (s, c) = twists[i].sin_cos();
        (y, z) = (mix(y, c, z, s), mix(z, c, y, -s));
    }
    (places, axes, at)
}

#[test]
fn a_bennett_linkage_moves_though_it_is_overconstrained_three_times() {
    let (places, axes, end) = bennett(0.5, 1.1, 1.3);
    assert!(end.iter().all(|x| x.abs() < 1e-14), "it closes: {end:?}");
    let mut b = Build::spatial();
    let bars = [0, 1, 2].map(|i| b.bar(places[i], places[i + 1]));
    let ends = [GROUND, bars[0], bars[1], bars[2], GROUND];
    for i in 0..4 {
        b.joint(JointKind::Revolute, [ends[i], ends[i + 1]], places[i], Some(axes[i]));
    }
    let d = diagnosis(&b.0);
    assert_eq!((d.sizes, dof(&d)), ([20, 18, 17], 1));
    assert_eq!(sets(&d), [(vec![0, 1, 2, 3], 3, Nature::Structural)]);
    assert!(d.gap > 1e9, "{}", d.gap);
}

#[test]
fn a_linkage_of_four_skew_hinges_is_a_structure_and_one_digit_off_is_reported_so() {
    let (places, axes, _) = bennett(0.5, 1.1, 1.3);
    let build = |off: f64| {
        let mut b = Build::spatial();
        let places = places.map(|p| [p[0], p[1], p[2] + off * p[0] * p[0]]);
        let bars = [0, 1, 2].map(|i| b.bar(places[i], places[i + 1]));
        let ends = [GROUND, bars[0], bars[1], bars[2], GROUND];
        for i in 0..4 {
            b.joint(JointKind::Revolute, [ends[i], ends[i + 1]], places[i], Some(axes[i]));
        }
        diagnosis(&b.0)
    };
    let far = build(0.1);
    assert_eq!((dof(&far), far.sets[0].redundant, far.sets[0].nature), (0, 2, Nature::Rigid));
    // an error in the seventh digit leaves two exact redundancies, and makes the third almost exact
    let near = build(3e-7);
    assert_eq!((dof(&near), near.sets.len()), (0, 2));
    let almost = &near.sets[1];
    assert_eq!((almost.is_exact, almost.redundant, almost.members.len()), (false, 3, 4));
    assert!(almost.sigma > 1e-9 && almost.sigma < 1e-6, "{}", almost.sigma);
}

#[test]
fn the_same_joint_twice_is_named_and_one_of_them_may_go() {
    let holds = |kind: &JointKind| !kind.is_link() && !kind.is_free();
    for kind in JointKind::ALL.into_iter().filter(holds) {
        let n = 6 - kind.n_coordinates(Dimension::Spatial);
        let mut b = Build::spatial();
        let first = b.bar([0.0; 3], [1.0, 0.0, 0.0]);
        let second = b.bar([1.0, 0.0, 0.0], [2.0, 0.3, 0.1]);
        b.pin(GROUND, first, [0.0; 3]);
        let [needs_first, needs_second] = kind.needs_axes(Dimension::Spatial);
        let axes = [Z.filter(|_| needs_first), needs_second.then_some([1.0, 0.0, 0.0])];
        for _ in 0..2 {
            b.link(kind, [first, second], [[1.0, 0.0, 0.0]; 2], axes);
        }
        let d = diagnosis(&b.0);
        let found = sets(&d);
        assert_eq!(found, [(vec![1, 2], n, Nature::Structural)], "{kind:?}");
        let cure = d.sets[0].remedy.as_ref().expect("one is enough");
        assert_eq!(
            cure.changes.iter().map(|c| (c.joint, c.kind)).collect::<Vec<_>>(),
            [(1, JointKind::Free)]
        );
    }
}

#[test]
fn a_dead_point_is_a_position_and_not_a_redundancy() {
    // a flat parallelogram: all four pins are in a line, where its two branches meet
    let mut b = Build::planar();
    let [o, a, c, d] = [0.0, 0.5, 1.7, 1.2].map(|x| [x, 0.0, 0.0]);
    let [crank, coupler, rocker] = [b.bar(o, a), b.bar(a, c), b.bar(c, d)];
    b.pin(GROUND, crank, o);
    b.pin(crank, coupler, a);
    b.pin(coupler, rocker, c);
    b.pin(rocker, GROUND, d);
    let flat = diagnosis(&b.0);
    assert_eq!((dof(&flat), sets(&flat)), (2, vec![(vec![0, 1, 2, 3], 1, Nature::Singular)]));
    assert!(flat.sets[0].remedy.is_none(), "no joint is to blame");
}

#[test]
fn a_bar_in_line_is_a_singular_position_of_a_structure() {
    // two bars in a line between fixed pins: they cannot move, though the rows of the Jacobian allow a motion
    let mut b = Build::planar();
    let [o, a, c] = [0.0, 0.5, 1.0].map(|x| [x, 0.0, 0.0]);
    let [first, second] = [b.bar(o, a), b.bar(a, c)];
    b.pin(GROUND, first, o);
    b.pin(first, second, a);
    b.pin(second, GROUND, c);
    let d = diagnosis(&b.0);
    let found = sets(&d);
    assert_eq!((dof(&d), &found[0].0, found[0].1), (1, &vec![0, 1, 2], 1));
    assert_eq!(found[0].2, Nature::Untried, "there is no position near by");
}

#[test]
fn guides_that_say_the_same_twice_are_in_the_set() {
    use mbs_core::scene::{Guide, Motion};
    let mut b = Build::planar();
    four_bar(&mut b, 0.0);
    for joint in [0, 3] {
        b.0.guides.push(Guide {
            joint: JointId::new(joint),
            number: 0,
            law: Motion::Ramp { rate: 1.0 },
        });
    }
    let d = diagnosis(&b.0);
    assert_eq!(
        (d.sizes, sets(&d)[0].0.clone(), d.sets[0].redundant),
        ([10, 9, 9], vec![0, 1, 2, 3], 1)
    );
    assert_eq!(
        d.sets[0].members.iter().map(|m| m.guide).collect::<Vec<_>>(),
        [true, false, false, true]
    );
}

#[test]
fn a_report_does_not_depend_on_axes_units_or_the_order_of_bodies() {
    let mut b = Build::spatial();
    four_bar(&mut b, 0.0);
    let d = diagnosis(&b.0);
    let turned = retell::turn_scene(&b.0);
    let reversed = retell::reorder(&b.0);
    let mut small = b.0.clone();
    for body in &mut small.bodies {
        body.center = body.center.map(|x| 1e-3 * x);
    }
    for joint in &mut small.joints {
        joint.points = joint.points.map(|p| p.map(|x| 1e-3 * x));
    }
    for other in [&turned, &reversed, &small] {
        let e = diagnosis(other);
        assert_eq!((sets(&e), e.sizes), (sets(&d), d.sizes));
        assert!((e.least - d.least).abs() < 1e-9, "{} {}", e.least, d.least);
        let open = |d: &mbs_study::redundancy::Diagnosis| {
            d.sets[0].members.iter().map(|m| m.open).collect::<Vec<_>>()
        };
        assert_eq!(open(&e), open(&d));
    }
}

#[test]
fn loops_have_corners_with_the_sign_of_their_branch() {
    let mut b = Build::planar();
    four_bar(&mut b, 0.0);
    let linkage = Linkage::new(&b.0);
    let loops = mbs_study::redundancy::loops(&linkage, &reference(&b.0));
    assert_eq!((loops.len(), &loops[0].joints), (1, &vec![0, 1, 2, 3]));
    let turn = |i: usize| loops[0].corners[i].turn;
    // the angles around a convex loop add up to a full revolution, |sum| = 2 π
    let sum: f64 = (0..4).map(turn).sum();
    assert!((sum.abs() - core::f64::consts::TAU).abs() < 1e-12, "{sum}");
    let mut other = b.0.clone();
    other.bodies.iter_mut().for_each(|body| body.center[1] *= -1.0);
    other.joints.iter_mut().for_each(|j| j.points.iter_mut().for_each(|p| p[1] *= -1.0));
    let mirrored = mbs_study::redundancy::loops(&Linkage::new(&other), &reference(&other));
    for (x, y) in loops[0].corners.iter().zip(&mirrored[0].corners) {
        assert!((x.turn + y.turn).abs() < 1e-12 && x.has_sign);
    }
}

#[test]
fn a_joint_at_its_dead_point_has_no_share_in_the_motion() {
    // crank and coupler are in line: the rocker is at the end of its motion
    let mut b = Build::planar();
    let [o, a, c] = [[0.0; 3], [0.3, 0.0, 0.0], [0.9, 0.0, 0.0]];
    let d = [0.7, -0.5, 0.0];
    let [crank, coupler, rocker] = [b.bar(o, a), b.bar(a, c), b.bar(c, d)];
    b.pin(GROUND, crank, o);
    b.pin(crank, coupler, a);
    b.pin(coupler, rocker, c);
    b.pin(rocker, GROUND, d);
    let linkage = Linkage::new(&b.0);
    let at = reference(&b.0);
    let part = &linkage.parts[0];
    let rank =
        mbs_study::redundancy::Rank::of(&linkage.jacobian(part, &at).matrix).expect("finite");
    let shares: Vec<f64> = mbs_study::redundancy::drives(&linkage, part, &at, &rank)
        .iter()
        .map(|d| d.share.abs())
        .collect();
    assert!(shares[3] < 1e-12 && shares[0] > 0.1, "{shares:?}");
    assert!(diagnose(&linkage, &at).sets.is_empty(), "the part itself is not singular there");
    let corner = &mbs_study::redundancy::loops(&linkage, &at)[0].corners[1];
    assert!(corner.distance() < 1e-12 && b.0.dimension == Dimension::Planar);
}

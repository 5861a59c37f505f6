//! Checks of effects and roads: impossible data is refused, and published data passes.

use super::{planar, refused, spatial};
use mbs_core::scene::*;

const PAIR: [BodyId; 2] = [BodyId::Ground, BodyId::Body(0)];
/// Attachment points one metre apart along x [m].
const APART: [[f64; 3]; 2] = [[0.0; 3], [1.0, 0.0, 0.0]];

pub(super) fn effect(kind: EffectKind<f64>) -> Vec<Effect<f64>> {
    vec![Effect { name: "e".into(), enabled: true, kind }]
}

/// Key and fault with which an effect is refused.
fn fault(scene: Scene<f64>, kind: EffectKind<f64>) -> (&'static str, SceneFault) {
    let (entry, field, fault) = refused(scene, |s| s.effects = effect(kind));
    assert_eq!(entry, Entry::Effect(0));
    (field, fault)
}

fn pieces(rows: &[(f64, f64, &[f64])]) -> EffectKind<f64> {
    let piece = |row: &(f64, f64, &[f64])| PolynomialPiece {
        lower: row.0,
        upper: row.1,
        coefficients: row.2.to_vec(),
    };
    EffectKind::Polynomial(Polynomial {
        bodies: PAIR,
        points: APART,
        direction: None,
        of_rate: true,
        pieces: rows.iter().map(piece).collect(),
    })
}

fn tire(radius: f64, axis: Option<[f64; 3]>, rolling_resistance: f64) -> EffectKind<f64> {
    EffectKind::Tire(Tire {
        body: BodyId::Body(0),
        center: [0.0; 3],
        axis,
        radius,
        stiffness: 1.0,
        damping: 0.0,
        rolling_resistance,
        side: None,
        spin: None,
        longitudinal: None,
    })
}

#[test]
fn polynomials_have_ordered_pieces_without_gaps() {
    let found = |rows: &[(f64, f64, &[f64])]| fault(planar(), pieces(rows));
    assert_eq!(found(&[]).1, SceneFault::WrongCount { needed: 1, found: 0 });
    assert_eq!(found(&[(0.0, 0.0, &[1.0])]).1, SceneFault::PieceRange(0));
    let gap = found(&[(0.0, 1.0, &[1.0]), (1.5, 2.0, &[1.0])]);
    assert_eq!(gap, ("coefficients", SceneFault::PieceGap(1)));
    let many = found(&[(0.0, 1.0, &[1.0; 9])]);
    assert_eq!(many.1, SceneFault::PieceCoefficients { piece: 0, found: 9 });
    assert_eq!(found(&[(0.0, 1.0, &[f64::NAN])]).1, SceneFault::NotFinite);
    // a jump of the value, as in the published damper of the Iltis
    let mut scene = planar();
    scene.effects = effect(pieces(&[(-2.0, -0.2, &[-416.42, 1844.3]), (-0.2, 2.0, &[-400.0])]));
    assert_eq!(scene.check(), Ok(()));
}

#[test]
fn a_distance_along_a_line_may_be_zero_but_the_line_has_a_direction() {
    let along = |direction| {
        let pieces = vec![PolynomialPiece { lower: 0.0, upper: 1.0, coefficients: vec![1.0] }];
        let (points, of_rate) = ([[0.0; 3]; 2], false);
        EffectKind::Polynomial(Polynomial { bodies: PAIR, points, direction, of_rate, pieces })
    };
    assert_eq!(fault(planar(), along(None)), ("points", SceneFault::CoincidentPoints));
    assert_eq!(fault(planar(), along(Some([0.0; 3]))), ("direction", SceneFault::ZeroAxis));
    let mut scene = planar();
    scene.effects = effect(along(Some([0.0, 3.0, 0.0])));
    assert_eq!(scene.check(), Ok(()));
}

#[test]
fn limits_and_friction_need_one_coordinate_and_ordered_levels() {
    let limit = |joint, lower| {
        EffectKind::Limit(Limit {
            joint,
            coordinate: None,
            range: false,
            lower,
            upper: 1.0,
            stiffness: 1.0,
            damping: 0.0,
        })
    };
    assert_eq!(
        fault(planar(), limit(JointId::new(7), 0.0)),
        ("joint", SceneFault::UnknownReference)
    );
    assert_eq!(
        fault(planar(), limit(JointId::new(0), 1.0)),
        ("lower", SceneFault::RangeOrder([1.0, 1.0]))
    );
    let mut scene = spatial();
    scene.joints[0].kind = JointKind::Spherical;
    scene.joints[0].axes = [None; 2];
    assert_eq!(
        fault(scene, limit(JointId::new(0), 0.0)),
        ("joint", SceneFault::NoSingleCoordinate(3))
    );
    let friction = |coulomb, regularisation| {
        let (r#static, stribeck, viscous) = (2.0, 0.1, 0.0);
        EffectKind::Friction(Friction {
            joint: JointId::new(0),
            coordinate: None,
            coulomb,
            r#static,
            stribeck,
            viscous,
            regularisation,
            factor: Signal::Constant([1.0, 0.0, 0.0]),
        })
    };
    let low = SceneFault::StaticBelowCoulomb([2.0, 3.0]);
    assert_eq!(fault(planar(), friction(3.0, 1e-3)), ("static", low));
    let zero = SceneFault::NotPositive(0.0);
    assert_eq!(fault(planar(), friction(1.0, 0.0)), ("regularisation", zero));
}

#[test]
fn a_torque_about_one_axis_is_one_number() {
    let course = |value| Signal::Constant(value);
    let on_body =
        |value| EffectKind::BodyTorque(BodyTorque { body: BodyId::Body(0), course: course(value) });
    let at_joint = |value| {
        EffectKind::JointTorque(JointTorque {
            joint: JointId::new(0),
            coordinate: None,
            course: course(value),
        })
    };
    // a vector about z, as in space, is refused: in the plane its first number is no torque
    let three = ("value", SceneFault::WrongCount { needed: 1, found: 3 });
    assert_eq!(fault(planar(), on_body([0.0, 0.0, 5.0])), three);
    assert_eq!(fault(planar(), at_joint([0.0, 0.0, 5.0])), three);
    let table = Signal::Table(vec![(0.0, [0.0, 5.0, 0.0])]);
    let found = EffectKind::JointTorque(JointTorque {
        joint: JointId::new(0),
        coordinate: None,
        course: table,
    });
    let two = ("table", SceneFault::WrongCount { needed: 1, found: 2 });
    assert_eq!(fault(planar(), found), two);
    let mut scene = spatial();
    scene.effects = effect(on_body([0.0, 0.0, 5.0]));
    assert_eq!(scene.check(), Ok(()));
}

#[test]
fn a_bushing_in_the_plane_has_three_directions() {
    let bushing = |stiffness| {
        let (bodies, at, damping) = (PAIR, [0.0; 3], [0.0; 6]);
        EffectKind::Bushing(Bushing { bodies, at, stiffness, damping })
    };
    let found = fault(planar(), bushing([1.0, 1.0, 5.0, 0.0, 0.0, 1.0]));
    assert_eq!(found, ("stiffness", SceneFault::OutOfPlane(5.0)));
    let found = fault(spatial(), bushing([1.0, 1.0, 1.0, 0.0, 0.0, -1.0]));
    assert_eq!(found, ("stiffness", SceneFault::Negative(-1.0)));
}

#[test]
fn a_tire_has_an_axis_where_it_needs_one() {
    let y = Some([0.0, 1.0, 0.0]);
    assert_eq!(fault(spatial(), tire(0.0, y, 0.0)), ("radius", SceneFault::NotPositive(0.0)));
    assert_eq!(fault(spatial(), tire(0.4, None, 0.1)), ("axis", SceneFault::Missing));
    assert_eq!(fault(planar(), tire(0.4, y, 0.0)), ("axis", SceneFault::NotUsed));
    let calspan = |c: CalspanCoefficients<f64>| {
        let EffectKind::Tire(Tire { body, center, radius, stiffness, damping, .. }) =
            tire(0.4, y, 0.0)
        else {
            unreachable!()
        };
        let (axis, rolling_resistance, side) = (y, 0.0, Some(c));
        EffectKind::Tire(Tire {
            body,
            center,
            axis,
            radius,
            stiffness,
            damping,
            rolling_resistance,
            side,
            spin: None,
            longitudinal: None,
        })
    };
    let iltis = CalspanCoefficients::iltis();
    let swapped = CalspanCoefficients { b: [1.216, -0.464e-4, 2.18e-11], ..iltis };
    assert_eq!(fault(spatial(), calspan(swapped)), ("coefficients", SceneFault::CalspanRange));
    let mut scene = spatial();
    scene.effects = effect(calspan(iltis));
    assert_eq!(scene.check(), Ok(()));
}

#[test]
fn roads_have_room_for_their_corners_and_for_the_largest_wheel() {
    let road = |feature: RoadFeature<f64>| {
        let mut scene = spatial();
        scene.effects = effect(tire(0.5, None, 0.0));
        let (entry, field, fault) = refused(scene, |s| s.road.right = vec![feature]);
        assert_eq!(entry, Entry::RoadRight(0));
        (field, fault)
    };
    let rise = |length, height, rounding| {
        let start = 0.0;
        RoadFeature::Rise { start, length, height, rounding }
    };
    let overlap = SceneFault::LongRounding { rounding: 0.6, most: 0.5 };
    assert_eq!(road(rise(1.0, 0.1, 0.6)), ("rounding", overlap));
    // h'' = height / ((length - rounding) rounding), for falls and rises
    let tight = SceneFault::TightHollow { hollow: 0.25, wheel: 0.5 };
    assert_eq!(road(rise(1.0, -1.0, 0.5)), ("height", tight));
    let step = RoadFeature::Table(vec![[0.0, 0.0], [0.1, 0.0], [0.2, 1.0], [0.3, 1.0]]);
    assert!(matches!(road(step), ("points", SceneFault::TightHollow { .. })));
    let back = RoadFeature::Table(vec![[0.0, 0.0], [0.0, 1.0]]);
    assert_eq!(road(back), ("points", SceneFault::PointOrder(1)));
    // a road without wheels may have any hollow
    let mut scene = spatial();
    scene.road.left = vec![rise(1.0, -1.0, 0.5)];
    assert_eq!(scene.check(), Ok(()));
}

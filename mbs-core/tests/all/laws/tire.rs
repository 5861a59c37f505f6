//! Law of a tire alone: its rows compared with differences, its work, and forces without jumps.

use mbs_core::algebra::{Vector, cross, norm, rotation};
use mbs_core::laws::body::{BodyMotion, MAX_ACTIONS, UnitWrench, WrenchesLaw};
use mbs_core::laws::calspan::Coefficients;
use mbs_core::laws::road::{self, Feature};
use mbs_core::laws::slip::LongitudinalSlip;
use mbs_core::laws::tire::*;
use mbs_core::laws::{LawInputs, Part};

type V = Vector<f64, 3>;

/// Road of a straight slope with a bump, and level ground before it.
const ROAD: [Feature<f64>; 2] = [
    Feature::Rise { start: 1.0, length: 8.0, height: 1.6, rounding: 1.0 },
    Feature::Bump { start: 4.0, length: 3.0, amplitude: 0.05 },
];
/// Places x [m] at which the road is level, bends up, is straight, and is on the bump.
const PLACES: [f64; 4] = [0.3, 1.4, 3.0, 5.1];

fn wheel(leans: bool) -> TireLaw<f64> {
    TireLaw {
        radius: 0.36,
        radial: [4.6e5, 800.0],
        rolling: 0.01,
        side: leans.then(Coefficients::iltis),
        longitudinal: None,
        road: Part { first: 0, n: 2 },
        travel: None,
        up: 2,
        leans,
    }
}

fn law_inputs() -> LawInputs<'static, f64> {
    LawInputs { features: &ROAD, ..LawInputs::courses(&[]) }
}

/// Motion of a wheel that is pressed in by `depth`, and whose axis is leaned by `camber` and turned by `steer`.
fn motion(x: f64, depth: f64, [camber, steer]: [f64; 2]) -> BodyMotion<f64> {
    let axis = rotation(&(V::z() * steer)) * rotation(&(V::x() * camber)) * V::y();
    let tire = wheel(true);
    let mut z = road::height(tire.road, &law_inputs(), x).value + 0.2;
    let mut motion = BodyMotion {
        position: [x, 0.4, z],
        velocity: [3.0, 0.2, -0.1],
        axis: axis.into(),
        spin: [0.3, -0.2, 0.5],
    };
    // The deflection falls with the height by about 1 / cos g: a few iterations correct the height.
    for _ in 0..60 {
        z += (radial(&tire, &motion).measure.value - depth) * 0.5 * camber.cos();
        motion.position[2] = z;
    }
    motion
}

fn actions(tire: &TireLaw<f64>, motion: &BodyMotion<f64>) -> [UnitWrench<f64>; MAX_ACTIONS] {
    let mut out = [UnitWrench::default(); MAX_ACTIONS];
    tire.evaluate(motion, &law_inputs(), &mut out[..tire.n_actions()]);
    out
}

fn radial(tire: &TireLaw<f64>, motion: &BodyMotion<f64>) -> UnitWrench<f64> {
    actions(tire, motion)[RADIAL]
}

/// Motion of the wheel after a small translation and rotation about its centre.
fn moved(motion: &BodyMotion<f64>, by: [V; 2]) -> BodyMotion<f64> {
    let position = V::from(motion.position) + by[0];
    let axis = rotation(&by[1]) * V::from(motion.axis);
    BodyMotion { position: position.into(), axis: axis.into(), ..*motion }
}

/// Force and moment of all actions about the centre.
fn wrench(tire: &TireLaw<f64>, motion: &BodyMotion<f64>) -> [V; 2] {
    actions(tire, motion).iter().fold([V::zeros(); 2], |[force, moment], action| {
        let f = -action.measure.tension;
        [force + V::from(action.force) * f, moment + V::from(action.moment) * f]
    })
}

/// Camber and steer angles [rad], up to a wheel almost flat on its side.
const ANGLES: [[f64; 2]; 6] =
    [[0.0, 0.0], [0.03, 0.1], [-0.2, 0.4], [0.6, -0.7], [-1.0, 0.3], [1.35, 1.2]];

#[test]
fn the_row_of_the_deflection_is_its_gradient_in_every_position() {
    let (tire, h) = (wheel(true), 1e-6);
    for x in PLACES {
        for angles in ANGLES {
            let motion = motion(x, 0.008, angles);
            let row = radial(&tire, &motion);
            let value = |by: [V; 2]| radial(&tire, &moved(&motion, by)).measure.value;
            // Second-order differences err by 1e-12 times third derivatives of up to 1e4, and by rounding, 1e-16 over 1e-6.
            let slope = |by: [V; 2]| (value(by) - value(by.map(|b| -b))) / (2.0 * h);
            for i in 0..3 {
                let unit = V::from_fn(|k, _| if k == i { h } else { 0.0 });
                let case = format!("x {x}, angles {angles:?}, axis {i}");
                let (by_place, by_turn) = (slope([unit, V::zeros()]), slope([V::zeros(), unit]));
                assert!((by_place + row.force[i]).abs() < 1e-7, "{case}: {by_place}, {row:?}");
                assert!((by_turn + row.moment[i]).abs() < 1e-7, "{case}: {by_turn}, {row:?}");
            }
            let rate = V::from(row.force).dot(&V::from(motion.velocity))
                + V::from(row.moment).dot(&V::from(motion.spin));
            assert!((row.measure.rate - rate).abs() < 1e-13, "{angles:?}");
        }
    }
}

#[test]
fn a_spring_carries_a_wheel_round_a_closed_way_without_work() {
    let tire = TireLaw { radial: [4.6e5, 0.0], rolling: 0.0, side: None, ..wheel(true) };
    // A closed path in the space of a place and two angles, on the bend of the road. The sum of the work over many chords has an
    // error of the order of the square of a chord.
    let place = |phase: f64| {
        let (sin, cos) = phase.sin_cos();
        let start = motion(1.4, 0.02, [0.3, 0.2]);
        moved(&start, [V::new(0.1 * cos, 0.0, 0.01 * sin), V::new(0.02 * sin, 0.0, 0.3 * cos)])
    };
    let work = |n: u32| {
        let turn = core::f64::consts::TAU / f64::from(n);
        let (mut sum, mut size) = (0.0, 0.0_f64);
        for k in 0..n {
            let phase = f64::from(k) * turn;
            let [before, here, after] =
                [-0.5, 0.0, 0.5].map(|share: f64| place(phase + share * turn));
            let way = V::from(after.position) - V::from(before.position);
            // The displacements of `moved` for two vectors differ by a rotation of the axis.
            let [a, b] = [before, after].map(|m| V::from(m.axis));
            let turned = cross(&V::from(here.axis), &(b - a));
            let [force, moment] = wrench(&tire, &here);
            let part = force.dot(&way) + moment.dot(&turned);
            (sum, size) = (sum + part, size + part.abs());
        }
        (sum, size)
    };
    let (sum, size) = work(4000);
    assert!(size > 10.0, "{size}");
    // The error of each of 4000 chords is (2 pi / 4000)^2 of its work. Over the closed path these errors cancel to that of one
    // chord.
    assert!(sum.abs() < 1e-6 * size, "{sum} of {size} J");
}

#[test]
fn an_upright_wheel_and_one_without_an_axis_are_the_same() {
    let disc = TireLaw { side: None, ..wheel(true) };
    for x in PLACES {
        let motion = motion(x, 0.01, [0.0, 0.0]);
        let (a, b) = (radial(&disc, &motion), radial(&wheel(false), &motion));
        assert_eq!(a, b);
        assert!(a.moment.iter().all(|m| *m == 0.0));
    }
}

#[test]
fn on_level_ground_a_leaning_disc_touches_at_its_lowest_point() {
    let tire = wheel(true);
    for [camber, steer] in ANGLES {
        let motion = motion(0.3, 0.01, [camber, steer]);
        let lowest = motion.position[2] - 0.36 * camber.cos();
        let depth = radial(&tire, &motion).measure.value;
        // The disc reaches below the ground by the component of the deflection along the normal.
        assert!((depth * camber.cos() + lowest).abs() < 1e-12, "{camber}");
        let arm = cross(&V::from(motion.axis), &cross(&V::from(motion.axis), &V::z()));
        let arm = arm * (0.35 / norm(&arm));
        let row = radial(&tire, &motion);
        let moment = cross(&arm, &V::from(row.force));
        assert!(norm(&(moment - V::from(row.moment))) < 1e-12, "{camber} {steer}");
    }
}

#[test]
fn a_wheel_on_its_side_and_one_below_the_road_have_finite_forces() {
    let tire = wheel(true);
    for camber in [1.4, 1.47, 1.5, 1.57, core::f64::consts::FRAC_PI_2, 2.0, -3.0] {
        let mut last = None;
        for i in 0..400 {
            let mut motion = motion(0.3, 0.01, [camber, 0.2]);
            motion.position[2] = 0.4 - 0.002 * f64::from(i);
            let row = radial(&tire, &motion);
            let value = row.measure.value;
            // Bounds of the row. For the force it is 1 / cos g. For the moment it is the distance to the road along the wheel (R at
            // contact), divided by cos^2 g.
            let reach = (10.0 * motion.position[2].abs()).max(0.36);
            assert!(norm(&V::from(row.force)) < 10.1, "{camber} {i}");
            let moment = norm(&V::from(row.moment));
            assert!(value < 0.0 || moment < 100.0 * reach + 0.1, "{camber} {i}");
            // The least cosine is a tenth.
            assert!(last.is_none_or(|last: f64| (value - last).abs() <= 0.0201), "{camber} {i}");
            last = Some(value);
        }
    }
}

/// Load of the wheel: stiffness times a deflection of 1 cm [N].
const LOAD: f64 = 4.6e5 * 0.01;
/// Largest cornering stiffness, at the top of the parabola: A0 + A1 A2 / 4 [N/rad].
const CORNERING: f64 = 2625.0 + 14.47 * 12930.0 / 4.0;

#[test]
fn forces_do_not_jump_at_standstill_and_without_slip() {
    let tire = TireLaw { radial: [4.6e5, 0.0], ..wheel(true) };
    let step = 1e-4;
    // Slip changes by at most 1 / v_s per m/s, as does the direction of the rolling resistance. Trail times load is 0.08 m.
    let force = (CORNERING + 0.01 * LOAD) / STANDSTILL * step;
    let moment = force * (0.36 + 2.0 * 0.08);
    for angles in [[0.0, 0.0], [0.1, 0.3]] {
        let start = motion(0.3, 0.01, angles);
        let start = BodyMotion { spin: [0.0; 3], ..start };
        // Through standstill at several lateral velocities, and through zero slip at several forward velocities.
        for (way, other) in [(0, 1), (1, 0)] {
            for aside in [-0.4, -0.03, 0.0, 0.002, 0.1, 3.0] {
                let mut last: Option<[V; 2]> = None;
                for k in -5000..=5000 {
                    let mut velocity = [0.0; 3];
                    (velocity[way], velocity[other]) = (f64::from(k) * step, aside);
                    let now = wrench(&tire, &BodyMotion { velocity, ..start });
                    if let Some(last) = last {
                        let [f, m] = [0, 1].map(|i| norm(&(now[i] - last[i])));
                        let case = format!("{angles:?} {velocity:?}: {f} N, {m} N m");
                        assert!(f < force && m < moment, "{case}");
                    }
                    last = Some(now);
                }
            }
        }
    }
    // At rest only the load acts, and the force of camber.
    let rest = BodyMotion { velocity: [0.0; 3], spin: [0.0; 3], ..motion(0.3, 0.01, [0.0; 2]) };
    assert!(norm(&(wrench(&tire, &rest)[0] - V::z() * LOAD)) < 1e-8);
}

#[test]
fn a_mirrored_wheel_has_mirrored_forces_and_the_sense_of_its_axis_does_not_matter() {
    let tire = wheel(true);
    let mirror = |[x, y, z]: [f64; 3]| [x, -y, z];
    // A mirror reverses the other components of a rotation.
    let turning = |[x, y, z]: [f64; 3]| [-x, y, -z];
    for x in PLACES {
        for angles in ANGLES {
            let motion = motion(x, 0.01, angles);
            let [force, moment] = wrench(&tire, &motion);
            let mirrored = BodyMotion {
                position: mirror(motion.position),
                velocity: mirror(motion.velocity),
                axis: mirror(motion.axis),
                spin: turning(motion.spin),
            };
            let reversed = BodyMotion { axis: motion.axis.map(|a| -a), ..motion };
            let case = format!("x {x}, {angles:?}");
            // Tolerance: rounding of forces of some kN.
            let [f, m] = wrench(&tire, &mirrored);
            assert!(norm(&(f - V::from(mirror(force.into())))) < 1e-9, "{case}");
            assert!(norm(&(m - V::from(turning(moment.into())))) < 1e-9, "{case}");
            let [f, m] = wrench(&tire, &reversed);
            assert!(norm(&(f - force)) < 1e-9 && norm(&(m - moment)) < 1e-9, "{case}");
        }
    }
}

#[test]
fn nothing_pulls_a_wheel_down_and_one_off_the_road_is_free() {
    let tire = wheel(true);
    for x in PLACES {
        for angles in ANGLES {
            for i in -40..=40 {
                let depth = 1e-4 * f64::from(i);
                for speed in [-8.0, -0.5, 0.0, 0.5, 8.0] {
                    let mut motion = motion(x, depth, angles);
                    motion.velocity[2] = speed;
                    let computed = actions(&tire, &motion);
                    let case = format!("x {x}, {angles:?}, {depth} m, {speed} m/s");
                    assert!(computed[RADIAL].measure.tension <= 0.0, "{case}");
                    // `motion` reaches the depth up to rounding.
                    if depth < -1e-9 || computed[RADIAL].measure.tension == 0.0 {
                        assert!(
                            computed.iter().all(|action| action.measure.tension == 0.0),
                            "{case}"
                        );
                    }
                }
            }
        }
    }
}

/// Law of a tire with longitudinal slip force.
fn driven() -> TireLaw<f64> {
    TireLaw {
        longitudinal: Some(LongitudinalSlip { stiffness: 6e4, friction: 0.8 }),
        ..wheel(true)
    }
}

/// Motion with another rate about the wheel's axis [rad/s].
fn spinning(motion: &BodyMotion<f64>, rate: f64) -> BodyMotion<f64> {
    let axis = V::from(motion.axis);
    let spin = V::from(motion.spin);
    BodyMotion { spin: (spin + axis * (rate - spin.dot(&axis))).into(), ..*motion }
}

/// Rate at which the wheel has no slip [rad/s].
fn free_rate(motion: &BodyMotion<f64>) -> f64 {
    let slipping = |rate: f64| actions(&driven(), &spinning(motion, rate))[SLIP].measure.rate;
    slipping(0.0) / (slipping(0.0) - slipping(1.0))
}

#[test]
fn a_wheel_without_slip_has_the_forces_of_one_that_rolls_freely() {
    for x in PLACES {
        for angles in ANGLES {
            let motion = motion(x, 0.01, angles);
            let motion = spinning(&motion, free_rate(&motion));
            let (slips, rolls) = (wrench(&driven(), &motion), wrench(&wheel(true), &motion));
            for (slips, rolls) in slips.iter().zip(rolls) {
                assert!(norm(&(slips - rolls)) < 1e-6, "x {x}, {angles:?}: {slips} {rolls}");
            }
        }
    }
}

#[test]
fn slip_drives_with_the_arm_of_the_radius_and_its_slope_is_that_of_differences() {
    let tire = driven();
    for angles in ANGLES {
        let motion = motion(0.3, 0.01, angles);
        let free = free_rate(&motion);
        for faster in [-30.0, -3.0, -0.1, 0.0, 0.2, 2.0, 40.0] {
            let at = |rate: f64| actions(&tire, &spinning(&motion, free + rate))[SLIP];
            let (slip, h) = (at(faster), 1e-6);
            let measure = slip.measure;
            let case = format!("{angles:?}, {faster} rad/s");
            assert!(measure.tension * measure.rate >= 0.0, "{case}: slip takes energy");
            let arm = V::from(slip.moment).dot(&V::from(motion.axis));
            assert!((arm.abs() - tire.radius).abs() < 1e-12, "{case}: {arm}");
            let [before, after] = [-h, h].map(|h| at(faster + h).measure);
            let slope = (after.tension - before.tension) / (after.rate - before.rate);
            assert!((slope - measure.damping).abs() < 1e-4 * (1.0 + slope.abs()), "{case}");
        }
    }
}

//! The Iltis with its drive line, against a point mass with the reduced rotational inertias.

use crate::common::oracle::{Way, rows};

/// Gear ratio of engine and cage [-], and radius of the wheels [m].
const RATIO: f64 = 9.4;
const RADIUS: f64 = 0.364;
/// Mass of all bodies [kg]: chassis, engine, cage, arms, and carriers with wheels.
const MASS: f64 = 1210.0 + 40.0 + 10.0 + 24.0 + 4.0 * 57.35;
/// Inertia of wheels with cage, and of the engine [kg m^2].
const INERTIAS: [f64; 2] = [4.0 * 1.6 + 0.08, 0.3];
/// Brake torque of all wheels [N m].
const BRAKES: f64 = 2.0 * (900.0 + 500.0);

#[test]
fn the_iltis_accelerates_and_brakes_as_engine_gears_and_brakes_say() {
    let scene = mbs_testkit::file("iltis-drive-line");
    let inertia = MASS + (INERTIAS[0] + INERTIAS[1] * RATIO * RATIO) / (RADIUS * RADIUS);
    for formulation in ["index-3", "recursive"] {
        let rows = rows(&scene, Way(formulation, "trapezoidal"), (1e-3, 8.0), 50);
        let rows = rows.unwrap_or_else(|e| panic!("{formulation}: {e}"));
        let at = |t: f64| {
            let row = rows.iter().find(|row| (row.0 - t).abs() < 1e-6);
            row.unwrap_or_else(|| panic!("no row at {t} s")).1.as_slice()
        };
        for (t, row) in &rows {
            let [speed, left, right, cage] = [row[6], row[8], row[9], row[11]];
            let off = (speed - RATIO * cage).abs().max((left + right - 2.0 * cage).abs());
            assert!(off < 1e-9 * (1.0 + speed.abs()), "{formulation}, {t} s: {row:?}");
        }
        let ahead = |t: f64| at(t)[3].hypot(at(t)[4]);
        // the vehicle drives straight ahead at full throttle
        let rate = (ahead(1.9) - ahead(1.3)) / 0.6;
        let mean = (0..=12).map(|i| at(1.3 + 0.05 * f64::from(i))[7]).sum::<f64>() / 13.0;
        let right = mean * RATIO / RADIUS / inertia;
        // slip grows with the force, and the rear wheels have a radius smaller by 0.14 %
        assert!((rate / right - 1.0).abs() < 0.01, "{formulation}: {rate}, not {right} m/s^2");
        // the outer wheel is faster: the vehicle turns to the left
        let [left, right] = [at(4.0)[8], at(4.0)[9]];
        assert!(right > left + 0.5, "{formulation}: {left}, {right} rad/s");
        // the vehicle brakes with the engine in gear
        let rate = (ahead(6.5) - ahead(5.5)) / 1.0;
        let right = -(BRAKES - RATIO * at(6.0)[7]) / RADIUS / inertia;
        assert!((rate / right - 1.0).abs() < 0.06, "{formulation}: {rate}, not {right} m/s^2");
        assert!(ahead(8.0) < 0.01, "{formulation}: it stands, but for {} m/s", ahead(8.0));
    }
}

//! Closed forms: a sleigh, a free disc, a disc on a steady circle, a ball on a turntable.

use super::{EXPLICIT, WAYS, apart, check, end, run};
use crate::common::oracle::Way;

/// Scene of Chaplygin's sleigh: a blade 0.4 m behind the centre of mass.
fn sleigh() -> String {
    "[scene]\nname = \"sleigh\"\ndimension = 2\nduration = 2.0\n\
     [[body]]\nname = \"sleigh\"\nmass = 2.0\ncenter = [0.4, 0.0]\ninertia = 0.5\n\
     [[rolling]]\nname = \"blade\"\nkind = \"blade\"\nbody = \"sleigh\"\nat = [0.0, 0.0]\ndirection = [1.0, 0.0]\n\
     [[initial]]\nbody = \"sleigh\"\nat = [0.0, 0.0]\nvelocity = [-0.5, 0.0]\nangular_velocity = 2.0\n\
     [[output]]\nname = \"p\"\nbody = \"sleigh\"\nat = [0.0, 0.0]\nquantity = \"position\"\n\
     [[output]]\nname = \"a\"\nbody = \"sleigh\"\nquantity = \"orientation\"\n\
     [[output]]\nname = \"w\"\nbody = \"sleigh\"\nquantity = \"angular-velocity\"\n"
        .to_owned()
}

#[test]
fn the_sleigh_ends_where_its_closed_form_says() {
    // v = V tanh k (t - t0), w = V sqrt(m/J) sech k (t - t0); the position is integrated by the midpoint rule in 200,000 parts
    let [mass, arm, inertia] = [2.0_f64, 0.4, 0.5];
    let j = inertia + mass * arm * arm;
    let speed = (0.25 + j * 4.0 / mass).sqrt();
    let k = arm * speed * mass / j;
    let t0 = -(-0.5 / speed).atanh() / k;
    let v = |t: f64| speed * (k * (t - t0)).tanh();
    let w = |t: f64| speed * (mass / j).sqrt() / (k * (t - t0)).cosh();
    // the heading is the integral of w
    let heading = |t: f64| {
        let at = |t: f64| 2.0 * (0.5 * k * (t - t0)).tanh().atan();
        speed * (mass / j).sqrt() / k * (at(t) - at(0.0))
    };
    let n = 200_000;
    let h = 2.0 / f64::from(n);
    let (mut x, mut y) = (0.0, 0.0);
    for i in 0..n {
        let t = (f64::from(i) + 0.5) * h;
        (x, y) = (x + v(t) * heading(t).cos() * h, y + v(t) * heading(t).sin() * h);
    }
    let right = [x, y, heading(2.0), w(2.0)];
    assert!(apart(&right, &[-0.996243, 1.134070, 2.790875638, 0.425672798]) < 6e-7, "{right:?}");
    check(&sleigh(), 2.0, (5e-3, 2e-5), (&right, 2e-9));
}

/// Scene of a uniform thin disc of 0.3 m on level ground, with its centre above the origin. `lean` is about x, `turning` the angular velocity
/// in global axes.
fn disc(mass: f64, lean: f64, turning: [f64; 3]) -> String {
    let radius = 0.3;
    let (sin, cos) = lean.sin_cos();
    let axis = [0.0, cos, sin];
    let (across, along) = (mass * radius * radius / 4.0, mass * radius * radius / 2.0);
    let entry = |i: usize, j: usize| {
        (along - across) * axis[i] * axis[j] + if i == j { across } else { 0.0 }
    };
    let inertia = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].map(|(i, j)| entry(i, j));
    let height = radius * cos;
    format!(
        "[scene]\nname = \"disc\"\ndimension = 3\nduration = 1.0\ngravity = [0.0, 0.0, -9.81]\n\
         [[body]]\nname = \"disc\"\nmass = {mass:?}\ncenter = [0.0, 0.0, {height:?}]\ninertia = {inertia:?}\n\
         [[rolling]]\nkind = \"wheel\"\nbody = \"disc\"\ncenter = [0.0, 0.0, {height:?}]\naxis = {axis:?}\nradius = {radius:?}\n\
         [[initial]]\nbody = \"disc\"\nangular_velocity = {turning:?}\n\
         [[output]]\nname = \"c\"\nbody = \"disc\"\nat = [0.0, 0.0, {height:?}]\nquantity = \"position\"\n\
         [[output]]\nname = \"w\"\nbody = \"disc\"\nquantity = \"angular-velocity\"\n"
    )
}

/// Angular velocity in global axes, from rates about x, about y = (0, sin, -cos) and about the disc's axis (0, cos, sin).
fn turning(lean: f64, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let (sin, cos) = lean.sin_cos();
    [x, y * sin + z * cos, -y * cos + z * sin]
}

#[test]
fn a_free_disc_rolls_as_its_equations_of_motion_say() {
    let text = disc(1.5, 0.4, turning(0.4, [0.3, 0.2, 9.0]));
    let right = [2.10568431, -1.46195862, 0.27194766, 7.91511286, 3.25082202, 3.03030758];
    check(&text, 1.0, (2e-3, 2e-3), (&right, 2e-8));
}

#[test]
fn a_disc_leans_into_its_steady_circle() {
    // a disc of radius R on a steady circle of radius rho = 1 m, with an inward lean of b = 0.3 rad, turns at the rate W: W^2 = 4 g tan b / (6
    // rho + R sin b)
    let (lean, rho, radius) = (0.3_f64, 1.0, 0.3);
    let w = (4.0 * 9.81 * lean.tan() / (6.0 * rho + radius * lean.sin())).sqrt();
    assert!((w - 1.411949572).abs() < 1e-9);
    // the disc leans towards -y, where the circle's centre is; it rotates with W about z, and with -5.123758204 rad/s about its axis
    let (sin, cos) = lean.sin_cos();
    let spin = 5.123758204;
    let text = disc(1.0, lean, [0.0, -spin * cos, w - spin * sin]);
    let rows = run(&text, Way("recursive", "rk853"), 1e-3, 2.0);
    for (t, row) in &rows {
        let reach = row[0].hypot(row[1] + rho);
        assert!((reach - rho).abs() < 1e-7, "{t}: {reach}");
        assert!((row[2] - radius * lean.cos()).abs() < 1e-8, "{t}: {}", row[2]);
    }
}

#[test]
fn an_upright_disc_is_stable_above_a_speed_and_not_below() {
    let least = (9.81_f64 * 0.3 / 3.0).sqrt();
    assert!((least - 0.990454441).abs() < 1e-9);
    // below this speed a small wobble grows as exp(s t), s^2 = (4/5)(g/R)(1 - (v/v0)^2); above it the wobble stays small
    let widest = |speed: f64| {
        let text = disc(1.0, 0.0, [1e-4, speed / 0.3, 0.0]);
        let rows = run(&text, Way("recursive", "rk853"), 2e-3, 8.0);
        rows.iter().fold(0.0_f64, |a, (_, row)| a.max(row[3].abs().max(row[5].abs())))
    };
    let [slow, fast] = [0.9, 1.1].map(|part| widest(part * least));
    assert!(slow > 100.0 * fast, "{slow:e} {fast:e}");
}

#[test]
fn a_ball_on_a_turntable_runs_a_circle() {
    let (mass, radius, rate) = (0.4, 0.05, 3.0);
    let inertia = 0.4 * mass * radius * radius;
    let text = format!(
        "[scene]\nname = \"turntable\"\ndimension = 3\nduration = 2.0\ngravity = [0.0, 0.0, -9.81]\n\
         [[body]]\nname = \"table\"\nmass = 2.0\ncenter = [0.0, 0.0, -0.1]\ninertia = [0.1, 0.1, 0.2, 0.0, 0.0, 0.0]\n\
         [[body]]\nname = \"ball\"\nmass = {mass:?}\ncenter = [0.2, 0.0, {radius:?}]\n\
         inertia = [{inertia:?}, {inertia:?}, {inertia:?}, 0.0, 0.0, 0.0]\n\
         [[joint]]\nname = \"shaft\"\nkind = \"revolute\"\nbodies = [\"ground\", \"table\"]\nat = [0.0, 0.0, 0.0]\naxis = [0.0, 0.0, 1.0]\n\
         [[guide]]\njoint = \"shaft\"\nramp = {{ rate = {rate:?} }}\n\
         [[rolling]]\nname = \"contact\"\nkind = \"ball\"\nbody = \"ball\"\ncenter = [0.2, 0.0, {radius:?}]\nradius = {radius:?}\n\
         on = \"table\"\n\
         [[initial]]\nbody = \"ball\"\nat = [0.2, 0.0, {radius:?}]\nvelocity = [0.0, 0.1, 0.0]\n\
         [[output]]\nname = \"p\"\nbody = \"ball\"\nat = [0.2, 0.0, {radius:?}]\nquantity = \"position\"\n"
    );
    // the velocity rotates at 2/7 of the table's rate
    let n = 2.0 / 7.0 * rate;
    let (sin, cos) = (n * 2.0_f64).sin_cos();
    let right = [0.2 - 0.1 / n * (1.0 - cos), 0.1 / n * sin, radius];
    assert!(apart(&right[..2], &[0.066650291, 0.115467689]) < 1e-9, "{right:?}");
    for method in EXPLICIT {
        let found = end(&text, Way("recursive", method), 2e-3, 2.0);
        assert!(apart(&found, &right) < 1e-9, "{method}: {found:?}");
    }
    for formulation in WAYS {
        let way = Way(formulation, "trapezoidal");
        let [coarse, fine] = [1e-2, 5e-3].map(|step| apart(&end(&text, way, step, 2.0), &right));
        println!("{formulation}: {coarse:.2e}, {fine:.2e}");
        assert!(coarse < 3e-4, "{formulation}: {coarse:e}");
        assert!((3.6..4.4).contains(&(coarse / fine)), "{formulation}: {coarse:e} {fine:e}");
    }
}

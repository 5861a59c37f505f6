//! Modes of steady motions: bodies that spin, precess, or drive in a bend, against closed forms and independent equations. Other motions are
//! refused as not steady.

use crate::common::{path, run, scene};
use mbs::core::scene::{InitialCondition, InitialTarget, JointId, Quantity, Scene, Start};
use mbs::{
    LinearSystem, LinearizeOptions, Method, Mode, Modes, Place, Search, StopError, Unsteady,
};
use mbs_testkit::repository::{field, read, text};

/// Relative error of eigenvalues by differences of fourth order [-], without cancellation of digits.
const CLOSE: f64 = 1e-8;

fn modes(scene: &Scene<f64>) -> Modes {
    let found = Modes::new(scene, Place::Initial, Search::Down);
    found.unwrap_or_else(|e| panic!("{}: {e}", scene.name))
}

/// Asserts these eigenvalues, and that all others are neutral.
fn has(found: &Modes, right: &[[f64; 2]]) {
    has_to(CLOSE, found, right);
}

fn has_to(close: f64, found: &Modes, right: &[[f64; 2]]) {
    let others: Vec<&Mode> = found.modes.iter().filter(|mode| !mode.is_neutral).collect();
    assert_eq!(others.len(), right.len(), "{others:?}");
    for &[real, imaginary] in right {
        let size = f64::hypot(real, imaginary);
        let is = |m: &&&Mode| f64::hypot(m.real - real, m.imaginary - imaginary) < close * size;
        assert!(others.iter().any(|mode| is(&mode)), "{real}, {imaginary}: {others:?}");
    }
}

/// Returns `text` with some numbers replaced.
fn with(text: &str, changes: &[[&str; 2]]) -> String {
    changes.iter().fold(text.to_owned(), |text, [from, to]| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    })
}

/// Characteristic equation (A s² + k)(C s² + k) + (Ip Ω)² s² = 0 of a rotor at the speed Ω: A = 0.045, C = 0.035, Ip = 0.05 kg m², k = 300 N
/// m/rad.
#[test]
fn a_rotor_in_gimbals_whirls_by_its_speed() {
    let rotor = text("23-whirl-of-a-rotor");
    for rate in [-160.0, 40.0, 100.0, 1000.0_f64] {
        let rotor = with(&rotor, &[["rate = 100.0", &format!("rate = {rate:?}")]]);
        let (a, b, c) = (0.045 * 0.035, 300.0 * 0.08 + (0.05 * rate).powi(2), 9e4);
        let root = (b * b - 4.0 * a * c).sqrt();
        let both = [2.0 * c / (b + root), (b + root) / (2.0 * a)];
        let found = modes(&read(&rotor, "rotor"));
        has(&found, &both.map(|square| [0.0, square.sqrt()]));
        assert!(found.is_stable());
    }
}

/// Characteristic equation of a blade with a hinge spring on a hub at 30 rad/s: 0.28 s² + 50 + 0.329 · 900 = 0.
#[test]
fn a_blade_on_a_driven_hub_flaps_stiffer_as_it_turns() {
    let blade = field("23-hinged-blade");
    let right = ((50.0 + 0.329 * 900.0) / 0.28_f64).sqrt();
    has(&modes(&blade), &[[0.0, right]]);
    let moving = Modes::new(&blade, Place::Moving, Search::Down).expect("it turns at its rest");
    has(&moving, &[[0.0, right]]);
}

/// Equilibrium of a governor at 6 rad/s: cos α = m g l / (36 (m l² + 0.0295)), α = 1.061597765855 rad. The mode is from the same equation.
#[test]
fn a_governor_swings_about_its_rest_in_the_turning_axes() {
    let governor = with(
        &text("25-governor-at-speed"),
        &[
            ["mass = 2.0", "mass = 1.0"],
            ["[0.0, 0.0, -0.4]", "[0.0, 0.0, -0.5]"],
            ["[0.01, 0.01, 0.0002", "[0.03, 0.03, 0.0005"],
            ["rate = 8.0", "rate = 6.0"],
            ["value = 0.2", "value = 1.0615977658549"],
        ],
    );
    let damped = format!(
        "{governor}\n[[effect]]\nkind = \"friction\"\njoint = \"arm\"\ncoulomb = 0.0\nviscous = 0.4\n"
    );
    has(&modes(&read(&damped, "governor")), &[[-0.714_285_714, 5.185_166_012]]);
    let error = Modes::new(&field("25-governor-at-speed"), Place::Initial, Search::Down);
    let Err(StopError::NotSteady(unsteady)) = error else { panic!("{error:?}") };
    let Unsteady::Accelerates { state, by, unit } = *unsteady else { panic!("{unsteady:?}") };
    // the angle a has the acceleration a'' = (64 · 0.3298 cos 0.2 − 2 · 9.81 · 0.4) sin 0.2 / 0.33
    let (sine, cosine) = 0.2_f64.sin_cos();
    let right = (64.0 * 0.3298 * cosine - 7.848) * sine / 0.33;
    assert!(
        state == "arm" && unit == "rad/s^2" && (by - right.abs()).abs() < 1e-6,
        "{by}, {right}"
    );
}

/// Scene of a top with m g l = 0.981 N m. Its inertias about the tip are A = 0.024 kg m² across the axis, and C = 0.002 kg m² about the axis.
fn top(tilt: f64, spin: f64, precession: f64) -> Scene<f64> {
    let (sine, cosine) = tilt.sin_cos();
    let (along, across) = (0.002, 0.004);
    let [xx, zz] = [sine, cosine].map(|part| across + (along - across) * part * part);
    let xz = (along - across) * sine * cosine;
    let about = spin - precession * cosine;
    let text = format!(
        "[scene]\ndimension = 3\nduration = 1.0\ngravity = [0.0, 0.0, -9.81]\n\
         [[body]]\nname = \"top\"\nmass = 0.5\ncenter = [{:?}, 0.0, {:?}]\ninertia = [{xx:?}, {across:?}, {zz:?}, 0.0, 0.0, {xz:?}]\n\
         [[joint]]\nname = \"tip\"\nkind = \"spherical\"\nbodies = [\"ground\", \"top\"]\nat = [0.0, 0.0, 0.0]\n\
         [[initial]]\nbody = \"top\"\nat = [0.0, 0.0, 0.0]\nvelocity = [0.0, 0.0, 0.0]\nangular_velocity = [{:?}, 0.0, {:?}]\n",
        0.2 * sine,
        0.2 * cosine,
        about * sine,
        precession + about * cosine,
    );
    read(&text, "top")
}

/// Characteristic equation of a sleeping top with the spin ω, in axes that do not rotate: A s² − i C ω s − m g l = 0.
#[test]
fn a_top_sleeps_above_its_limit_alone() {
    for spin in [100.0, 150.0, 160.0_f64] {
        let (middle, square) = (0.002 * spin / 0.048, 0.981 / 0.024);
        let rest = middle * middle - square;
        let right = if rest < 0.0 {
            let grows = (-rest).sqrt();
            [[grows, middle], [-grows, middle]]
        } else {
            [[0.0, middle - rest.sqrt()], [0.0, middle + rest.sqrt()]]
        };
        let found = modes(&top(0.0, spin, 0.0));
        has(&found, &right);
        assert_eq!(found.is_stable(), rest > 0.0, "{spin}");
    }
}

/// Steady precession Ω of a top with the spin ω and the tilt θ: A cos θ Ω² − C ω Ω + m g l = 0. Nutation: ν² = Ω² − 2 g' cos θ + (g'/Ω)², g'
/// = m g l/A.
#[test]
fn a_top_that_precesses_nutates() {
    let (cosine, weight) = (0.5_f64.cos(), 0.981);
    let (a, b) = (0.024 * cosine, 0.002 * 150.0);
    let precession = 2.0 * weight / (b + f64::sqrt(b * b - 4.0 * a * weight));
    let found = modes(&top(0.5, 150.0, precession));
    let g = weight / 0.024;
    let square = precession.powi(2) - 2.0 * g * cosine + (g / precession).powi(2);
    // differences lose digits: the centripetal acceleration at 150 rad/s is much larger than that of the nutation
    has_to(3.0 * CLOSE, &found, &[[0.0, square.sqrt()]]);
    assert!(found.is_stable());
    let faster = Modes::new(&top(0.5, 150.0, 1.01 * precession), Place::Initial, Search::Down);
    assert!(matches!(faster, Err(StopError::NotSteady(_))), "{faster:?}");
}

/// Orbit around a centre to which a spring of 600 N/m pulls: ω² = k (r − l)/(m r) = 36, ν² = 3 ω² + k/m.
#[test]
fn a_body_on_its_orbit_swings_across_it_in_axes_that_turn() {
    let orbit = "[scene]\ndimension = 2\nduration = 1.0\n\
        [[body]]\nname = \"stone\"\nmass = 4.0\ncenter = [0.6, 0.8]\ninertia = 0.3\n\
        [[effect]]\nkind = \"spring-damper\"\nbodies = [\"ground\", \"stone\"]\npoints = [[0.0, 0.0], [0.6, 0.8]]\nstiffness = 600.0\nfree_length = 0.76\n\
        [[initial]]\nbody = \"stone\"\nat = [0.6, 0.8]\nvelocity = [-4.8, 3.6]\nangular_velocity = 2.0\n";
    let found = modes(&read(orbit, "orbit"));
    has_to(1e-7, &found, &[[0.0, f64::sqrt(3.0 * 36.0 + 150.0)]]);
}

#[test]
fn a_rotor_with_two_moments_across_its_axis_is_refused_and_frozen_when_asked() {
    let rotor = text("23-whirl-of-a-rotor");
    let rotor = with(&rotor, &[["[0.05, 0.03, 0.03", "[0.05, 0.03, 0.02"]]);
    let scene = read(&rotor, "rotor");
    let error = Modes::new(&scene, Place::Initial, Search::Down);
    let Err(StopError::NotSteady(unsteady)) = error else { panic!("{error:?}") };
    assert!(matches!(*unsteady, Unsteady::Changes { .. }), "{unsteady:?}");
    let frozen = Modes::frozen(&scene, Place::Initial, Search::Down).expect("of an instant");
    assert_eq!(frozen.unsteady, Some(*unsteady));
    assert!(frozen.to_json()["stable"].is_null());
    assert_eq!(frozen.modes.len(), 4);
}

#[test]
fn of_a_rest_the_start_and_the_equilibrium_have_the_same_modes() {
    let places = [("quarter-car", Place::Initial), ("double-pendulum", Place::Moving)];
    for (name, place) in places.into_iter().chain([("iltis-suspension", Place::Moving)]) {
        let scene = scene(name);
        let rest = Modes::new(&scene, Place::Equilibrium, Search::Down).expect("it rests");
        let right: Vec<[f64; 2]> = rest
            .modes
            .iter()
            .filter(|mode| !mode.is_neutral)
            .map(|mode| [mode.real, mode.imaginary])
            .collect();
        let found = Modes::new(&scene, place, Search::Down).expect("it stands there");
        has(&found, &right);
    }
}

#[test]
fn what_a_rest_leaves_out_of_a_motion_is_listed_and_a_motion_has_it() {
    for (name, left_out) in [
        ("25-governor-at-speed", ["joint", "shaft", "motion of the guide"]),
        ("23-whirl-of-a-rotor", ["joint", "spin", "initial rate"]),
        ("23-closed-clutch", ["effect", "clutch", "dry friction"]),
    ] {
        let scene = field(name);
        let rest = Modes::new(&scene, Place::Equilibrium, Search::Down).expect("it rests");
        let listed = rest.left_out.iter().map(|l| [l.of, &l.name, l.part]).collect::<Vec<_>>();
        assert_eq!(listed, [left_out], "{name}");
        let [of, name, part] = left_out;
        assert_eq!(rest.to_json()["left_out"][0], serde_json::json!({ of: name, "part": part }));
    }
    // 18.973666 rad/s is the mode of the locked pair, so the friction of the clutch acts
    let clutch = field("23-closed-clutch");
    let moving = Modes::new(&clutch, Place::Moving, Search::Down).expect("it is steady");
    assert!(moving.modes.iter().any(|mode| (mode.imaginary - 18.973_666).abs() < 1e-6));
}

/// Scene of a mass of 10 kg on two slides of a driven hub. Its intermediate slider has `slider` kg, and the springs 40 kN/m. The mass is `x`
/// from its drawn position, and its centre `e` further out.
fn shaft((rate, slider): (f64, f64), [x, e]: [f64; 2], effects: &str) -> Scene<f64> {
    let slide = |name: &str, bodies: [&str; 2], axis: &str, value: f64| {
        format!(
            "[[joint]]\nname = \"{name}\"\nkind = \"prismatic\"\nbodies = {bodies:?}\nat = [0, 0]\naxis = {axis}\n\
             [[effect]]\nkind = \"torsion-spring\"\njoint = \"{name}\"\nstiffness = 4.0e4\n\
             [[initial]]\njoint = \"{name}\"\nvalue = {value:?}\nrate = 0.0\n"
        )
    };
    let text = format!(
        "[scene]\ndimension = 2\nduration = 1.0\n\
         [[body]]\nname = \"hub\"\nmass = 1.0\ncenter = [0, 0]\ninertia = 0.1\n\
         [[body]]\nname = \"slider\"\nmass = {slider:?}\ncenter = [0, 0]\ninertia = 0.0\n\
         [[body]]\nname = \"mass\"\nmass = 10.0\ncenter = [{e:?}, 0]\ninertia = 0.1\n\
         [[joint]]\nname = \"axle\"\nkind = \"revolute\"\nbodies = [\"ground\", \"hub\"]\nat = [0, 0]\n\
         [[guide]]\njoint = \"axle\"\nramp = {{ rate = {rate:?} }}\n{}{}{effects}",
        slide("x", ["hub", "slider"], "[1, 0]", x),
        slide("y", ["slider", "mass"], "[0, 1]", 0.0)
    );
    read(&text, "shaft")
}

/// Characteristic equation m s² + (ci + ce) s + k − i ci Ω = 0 in fixed axes; ci and ce are the inner and outer damping. In rotating axes the
/// eigenvalue is s − i Ω. The motion grows above 189.7 rad/s.
#[test]
fn damping_in_turning_axes_makes_a_shaft_grow_beyond_its_limit() {
    let (m, ci, ce, k) = (10.0_f64, 30.0_f64, 60.0_f64, 4e4);
    let effects = ["x", "y"].map(|joint| {
        format!("[[effect]]\nkind = \"torsion-spring\"\njoint = \"{joint}\"\ndamping = {ci:?}\n")
    });
    let outer = format!(
        "[[effect]]\nkind = \"bushing\"\nbodies = [\"ground\", \"mass\"]\nat = [0, 0]\nstiffness = [0.0, 0.0, 0.0]\n\
         damping = [{ce:?}, {ce:?}, 0.0]\n"
    );
    for (rate, grows) in [(100.0, false), (189.0, false), (191.0, true), (200.0_f64, true)] {
        let found = modes(&shaft((rate, 0.0), [0.0; 2], &(effects.concat() + &outer)));
        // `root` is the root of the discriminant, √((ci + ce)² − 4 m (k − i ci Ω))
        let (a, b) = ((ci + ce).powi(2) - 4.0 * m * k, 4.0 * m * ci * rate);
        let size = f64::hypot(a, b);
        let root = [((size + a) / 2.0).sqrt(), ((size - a) / 2.0).sqrt()];
        let both = [1.0, -1.0].map(|sign| {
            let s = [(-(ci + ce) + sign * root[0]) / (2.0 * m), sign * root[1] / (2.0 * m)];
            [s[0], (s[1] - rate).abs()]
        });
        has(&found, &both);
        assert_eq!(found.modes.iter().any(|mode| mode.real > 1e-6), grows, "{rate}");
    }
}

/// Deflection of an unbalanced shaft: x = m e Ω²/(k − (m + ms) Ω²) = 6.667111141e-4 m. In one direction its modes contain the slider's mass
/// ms.
#[test]
fn unbalance_is_a_steady_motion_where_the_shaft_bends_by_it_alone() {
    let (m, ms, k, e, rate) = (10.0_f64, 0.001, 4e4, 1e-3, 40.0_f64);
    let x = m * e * rate * rate / (k - (m + ms) * rate * rate);
    assert!((x - 6.667_111_141e-4).abs() < 1e-13);
    let found = modes(&shaft((rate, ms), [x, e], ""));
    // the characteristic equation is ((m + ms) s² + k − (m + ms) Ω²)(m s² + k − m Ω²) + 4 m² Ω² s² = 0
    let w = rate * rate;
    let [kx, ky] = [k - (m + ms) * w, k - m * w];
    let (a, b, c) = ((m + ms) * m, (m + ms) * ky + m * kx + 4.0 * m * m * w, kx * ky);
    let root = (b * b - 4.0 * a * c).sqrt();
    has(&found, &[(b - root) / (2.0 * a), (b + root) / (2.0 * a)].map(|s| [0.0, s.sqrt()]));
    // in another position the shaft accelerates
    let off = Modes::new(&shaft((rate, ms), [0.0, e], ""), Place::Initial, Search::Down);
    assert!(matches!(off, Err(StopError::NotSteady(_))), "{off:?}");
}

/// Matrix exponential e^(A t), by the series for t/1024 and ten squarings.
fn exponential(a: &[Vec<f64>], t: f64) -> Vec<Vec<f64>> {
    let n = a.len();
    let times = |x: &[Vec<f64>], y: &[Vec<f64>]| -> Vec<Vec<f64>> {
        let entry = |i: usize, j: usize| (0..n).map(|k| x[i][k] * y[k][j]).sum();
        (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
    };
    let unit = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
    let one: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| unit(i, j)).collect()).collect();
    let (mut sum, mut power) = (one.clone(), one);
    for k in 1..20 {
        power = times(&power, a);
        for (sum, power) in sum.iter_mut().flatten().zip(power.iter_mut().flatten()) {
            *power *= t / 1024.0 / f64::from(k);
            *sum += *power;
        }
    }
    (0..10).fold(sum, |sum, _| times(&sum, &sum))
}

/// Joints whose coordinates are all states of a system, without states of signals.
fn joints(scene: &Scene<f64>, states: &[String]) -> Option<Vec<JointId>> {
    let joint = |state: &String| {
        let place = scene.joints.iter().position(|joint| joint.name == *state)?;
        let is_one = scene.joints[place].kind.n_coordinates(scene.dimension) == 1;
        is_one.then(|| JointId::new(place))
    };
    states[..states.len() / 2].iter().map(joint).collect()
}

/// States after a time, from given states at the start.
fn flow(scene: &Scene<f64>, joints: &[JointId], start: &[f64], t: f64) -> Vec<f64> {
    let mut scene = scene.clone();
    scene.start = Start::Initial;
    let n = joints.len();
    scene.initials.clear();
    for (k, &joint) in joints.iter().enumerate() {
        let (value, rate) = (Some(vec![start[k]]), Some(vec![start[n + k]]));
        scene
            .initials
            .push(InitialCondition { target: InitialTarget::Joint { joint, value, rate } });
    }
    scene.outputs.clear();
    let quantities = joints.iter().map(|&joint| Quantity::JointValue { joint });
    let rates = joints.iter().map(|&joint| Quantity::JointRate { joint });
    mbs_testkit::quantities::show(&mut scene, quantities.chain(rates));
    let method = Method {
        formulation: Some("recursive".to_owned()),
        integrator: Some("rk853".to_owned()),
        tolerance: Some(1e-13),
        step_max: Some(t),
        duration: Some(t),
        ..Method::default()
    };
    let outcome = run(&scene, &method);
    assert_eq!(outcome.error, None, "{}", scene.name);
    outcome.rows().last().expect("a row").1.clone()
}

/// Equilibria and motions that are steady in joint coordinates, of scenes of the repository and from users.
#[test]
fn the_flow_of_the_motion_is_the_exponential_of_a() {
    /// Time of the flow [s].
    const T: f64 = 0.05;
    /// Change of a state for differences, relative to its size or one [-]. Differences of fourth order then have ten digits.
    const STEP: f64 = 1e-4;
    let fields = ["23-whirl-of-a-rotor", "23-hinged-blade"].map(field);
    let files = std::fs::read_dir(path("four-bar").with_file_name("")).expect("the scenes");
    let names = files.filter_map(|file| {
        let path = file.expect("a file").path();
        let is_scene = path.extension().is_some_and(|extension| extension == "toml");
        // the hammer rests on the edge of its stop, where the motion has a kink
        let is_smooth = is_scene && !path.ends_with("hammer-blow.toml");
        is_smooth.then(|| path.file_stem().expect("a name").to_string_lossy().into_owned())
    });
    let scenes = names.map(|name| scene(&name)).chain(fields);
    let mut n_compared = 0;
    for scene in scenes {
        for place in [Place::Initial, Place::Moving] {
            let options = LinearizeOptions { place, search: Search::Down };
            let Ok(system) = LinearSystem::steady(&scene, &options) else { continue };
            let n = system.states.len();
            let Some(joints) = joints(&scene, &system.states).filter(|_| n > 0) else { continue };
            // forces that begin with the run move some of these scenes away from the state
            let base = flow(&scene, &joints, &system.state_values, T);
            let of = |k: usize| system.state_values[k];
            let is_steady = (0..n / 2).all(|k| {
                let rate = of(n / 2 + k);
                let off = [base[k] - of(k) - rate * T, base[n / 2 + k] - rate];
                off.iter().all(|off| off.abs() < 1e-7)
            });
            if !is_steady {
                continue;
            }
            let a: Vec<Vec<f64>> =
                (0..n).map(|i| (0..n).map(|j| system.a[(i, j)]).collect()).collect();
            let right = exponential(&a, T);
            let largest = right.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
            for j in 0..n {
                let at = |step: f64| {
                    let mut start = system.state_values.clone();
                    start[j] += step * STEP;
                    flow(&scene, &joints, &start, T)
                };
                let [two, one, back, far] = [2.0, 1.0, -1.0, -2.0].map(at);
                for i in 0..n {
                    let slope = (8.0 * (one[i] - back[i]) - (two[i] - far[i])) / (12.0 * STEP);
                    let off = (slope - right[i][j]).abs() / largest;
                    assert!(
                        off < 1e-6,
                        "{} at {place:?}: {} by {}: {slope}, {}",
                        scene.name,
                        system.states[i],
                        system.states[j],
                        right[i][j]
                    );
                }
            }
            n_compared += 1;
            println!("{} at {place:?}: {n} states", scene.name);
        }
    }
    assert!(n_compared >= 12, "{n_compared} motions");
}

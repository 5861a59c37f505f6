//! Every element is compared with central differences through [`Model`], at random configurations close to and far from the
//! constraint manifold.

use mbs_core::model::{Load, Model, Owner, State, Tangent, Terms};
use mbs_core::scene::{JointId, Scene};
use mbs_testkit::{
    PLANAR, Random, SPATIAL, close, jacobian, matrix, model, plus, rates, reference, residual,
    scene,
};

/// Step of central differences. Rows and forces are smooth. The rounding error is 1e-16 / 1e-5, and the truncation error is 1e-10.
const STEP: f64 = 1e-5;
/// Allowed difference: rounding and truncation, times derivatives of order 100.
const DIFFERENCE: f64 = 2e-7;
/// Allowed error: rounding in sums of some tens of products, whose numbers are of order ten.
const ROUNDING: f64 = 1e-12;
/// Distances from the constraint manifold at which elements are checked.
const SPREADS: [f64; 3] = [0.0, 0.01, 0.3];

/// Model with its terms at random (q, v, t).
struct At<M> {
    model: M,
    q: Vec<f64>,
    v: Vec<f64>,
    t: f64,
    terms: Terms<f64>,
}

impl<M: Model<f64>> At<M> {
    fn new(model: M, random: &mut Random, spread: f64) -> Self {
        let (n, e) = (model.n_unknowns(), model.n_extended());
        let q = plus(&reference(&model), 1.0, &random.vector(n, e, spread));
        let (v, t) = (random.vector(n, e, 1.0), 0.35 + 0.3 * random.next());
        let terms = model.terms();
        let mut at = Self { model, q, v, t, terms };
        at.everything();
        at
    }

    /// Evaluates all terms at (q, v, t).
    fn everything(&mut self) {
        let (model, terms) = (&self.model, &mut self.terms);
        model.set_inputs(self.t, &State::at_rest(model), terms);
        model.evaluate(&self.q, terms);
        model.evaluate_phi_t(&self.q, terms);
        model.evaluate_bias(&self.q, &self.v, terms);
        model.evaluate_forces(&self.q, &self.v, terms);
    }

    /// Central difference (g(+STEP) - g(-STEP)) / 2 STEP, where `moved` changes (q, v, t) by its argument.
    fn difference(
        &mut self,
        moved: impl Fn(&mut Self, f64),
        g: impl Fn(&Self) -> Vec<f64>,
    ) -> Vec<f64> {
        let (q, v, t) = (self.q.clone(), self.v.clone(), self.t);
        let mut side = |h: f64| {
            moved(self, h);
            self.everything();
            let value = g(self);
            (self.q, self.v, self.t) = (q.clone(), v.clone(), t);
            value
        };
        let (before, after) = (side(-STEP), side(STEP));
        self.everything();
        after.iter().zip(before).map(|(a, b)| (a - b) / (2.0 * STEP)).collect()
    }

    /// Negative applied forces, -Q: the residual without all other parts.
    fn minus_force(&self) -> Vec<f64> {
        let load = Load { mass: None, multipliers: None, force: 1.0 };
        residual(&self.model, &self.terms, &load)
    }
}

/// Couplings with every kind of term: angles and slides about axes of either body, a curve, a length, a sum that depends on time.
const PLANAR_COUPLINGS: &str = r#"
[[coupling]]
kind = "linear"
terms = [{ joint = "pivot", factor = 3.0 }, { joint = "slot", factor = -0.5 }, { joint = "floating", coordinate = 2, factor = 1.5 }]
sine = { amplitude = 0.3, frequency = 0.7 }
[[coupling]]
kind = "cam"
joints = ["ankle", "rail"]
table = [[-4.0, 0.1], [-1.0, 0.4], [0.0, 0.0], [1.2, -0.3], [4.0, 0.1]]
periodic = true
[[coupling]]
kind = "linear"
value = 0.2
terms = [{ points = [{ body = "ground", at = [2.0, 3.0] }, { body = "BODY", at = [-1.0, -2.0] }, { body = "ground", at = [-3.0, 0.5] }], factor = 2.0 }, { joint = "pin", factor = 0.7, coefficients = [0.0, 0.2, 0.1, -0.3] }]
"#;
const SPATIAL_COUPLINGS: &str = r#"
[[coupling]]
kind = "linear"
terms = [{ joint = "cross", coordinate = 0, factor = 3.0 }, { joint = "cross", coordinate = 1, factor = -2.0 }, { joint = "slide", factor = 0.5 }]
ramp = { rate = 0.4 }
[[coupling]]
kind = "screw"
joint = "sleeve"
lead = 0.3
[[coupling]]
kind = "linear"
value = 0.2
terms = [{ joint = "table", coordinate = 2, factor = 1.5, coefficients = [0.0, 0.2, 0.1, -0.3] }, { points = [{ body = "ground", at = [2.0, 3.0, 1.0] }, { body = "BODY", at = [-1.0, -2.0, 4.0] }], factor = -2.0 }, { joint = "floating", coordinate = 1, factor = 0.3 }]
"#;

/// Scene with couplings of its first body.
fn coupled(text: &str, couplings: &str) -> Scene<f64> {
    let name = scene(text).bodies[0].name.clone();
    scene(&(text.to_owned() + &couplings.replace("BODY", &name)))
}

/// Calls a check for both scenes, with couplings and without, at every spread.
macro_rules! at_random {
    ($check:expr) => {
        for seed in 1..4 {
            for spread in SPREADS {
                let random = &mut Random(seed);
                $check(&mut At::new(model::<2>(&scene(PLANAR)), random, spread), random);
                $check(&mut At::new(model::<3>(&scene(SPATIAL)), random, spread), random);
                let [planar, spatial] = [(PLANAR, PLANAR_COUPLINGS), (SPATIAL, SPATIAL_COUPLINGS)]
                    .map(|(s, c)| coupled(s, c));
                $check(&mut At::new(model::<2>(&planar), random, spread), random);
                $check(&mut At::new(model::<3>(&spatial), random, spread), random);
            }
        }
    };
}

#[test]
fn jacobian_is_the_derivative_of_phi() {
    fn check<M: Model<f64>>(at: &mut At<M>, _: &mut Random) {
        let rows = jacobian(&at.model, &at.terms);
        for i in 0..at.model.n_unknowns() {
            let column: Vec<f64> = rows.iter().map(|row| row[i]).collect();
            let difference = at.difference(|at, h| at.q[i] += h, |at| at.terms.phi.clone());
            close(&format!("column {i}"), &column, &difference, DIFFERENCE);
        }
    }
    at_random!(check);
}

#[test]
fn phi_t_and_bias_are_the_time_derivatives_along_a_motion() {
    fn check<M: Model<f64>>(at: &mut At<M>, _: &mut Random) {
        let driven = at.difference(|at, h| at.t += h, |at| at.terms.phi.clone());
        close("phi_t", &at.terms.phi_t, &driven, DIFFERENCE);
        let along = |at: &mut At<M>, h: f64| {
            at.q = plus(&at.q, h, &at.v);
            at.t += h;
        };
        let rate = |at: &At<M>| plus(&rates(&at.model, &at.terms, &at.v), 1.0, &at.terms.phi_t);
        let bias = at.difference(along, rate);
        close("bias", &at.terms.phi_bias, &bias, DIFFERENCE);
    }
    at_random!(check);
}

/// Scene with wheels, a ball and blades of its first body, on the ground and on the second body.
fn rolling(text: &str) -> Scene<f64> {
    let of = scene(text);
    let [first, second] = [0, 1].map(|i| of.bodies[i].name.clone());
    let head = format!("[[rolling]]\nbody = \"{first}\"\n");
    let planar = [
        "kind = \"wheel\"\ncenter = [0.4, 0.7]\nradius = 0.3".to_owned(),
        format!("kind = \"wheel\"\ncenter = [0.2, 0.5]\nradius = 0.2\non = \"{second}\""),
        format!("kind = \"blade\"\nat = [0.3, -0.4]\ndirection = [1.0, 0.4]\non = \"{second}\""),
    ];
    let spatial = [
        "kind = \"wheel\"\ncenter = [0.4, 0.7, 0.2]\naxis = [0.3, 1.0, 0.2]\nradius = 0.3"
            .to_owned(),
        format!(
            "kind = \"wheel\"\ncenter = [0.2, 0.5, 0.6]\naxis = [0.7, -0.6, 0.3]\nradius = 0.2\non = \"{second}\""
        ),
        format!("kind = \"ball\"\ncenter = [0.2, 0.5, 0.6]\nradius = 0.2\non = \"{second}\""),
        format!(
            "kind = \"blade\"\nat = [0.3, -0.4, 0.1]\ndirection = [1.0, 0.4, 0.2]\non = \"{second}\""
        ),
    ];
    let list = if of.dimension.count() == 2 { &planar[..] } else { &spatial };
    let entries = list.iter().map(|entry| format!("{head}{entry}\n"));
    scene(&(text.to_owned() + &entries.collect::<String>()))
}

#[test]
fn rows_of_what_rolls_have_their_bias_and_are_the_same_at_a_sum() {
    fn check<M: Model<f64>>(at: &mut At<M>, random: &mut Random) {
        let along = |at: &mut At<M>, h: f64| {
            at.q = plus(&at.q, h, &at.v);
            at.t += h;
        };
        let rate = |at: &At<M>| plus(&rates(&at.model, &at.terms, &at.v), 1.0, &at.terms.phi_t);
        let bias = at.difference(along, rate);
        close("bias", &at.terms.phi_bias, &bias, DIFFERENCE);
        let dq = random.vector(at.model.n_unknowns(), at.model.n_extended(), 1e-2);
        let (mut advanced, mut evaluated) = (at.terms.clone(), at.terms.clone());
        at.model.advance(&at.q, &dq, &at.terms.phi, &mut advanced);
        at.model.evaluate(&plus(&at.q, 1.0, &dq), &mut evaluated);
        close("phi", &advanced.phi, &evaluated.phi, ROUNDING);
        close("jacobian", &advanced.jacobian, &evaluated.jacobian, ROUNDING);
    }
    for seed in 1..4 {
        for spread in [0.0, 0.01, 0.1] {
            let random = &mut Random(seed);
            check(&mut At::new(model::<2>(&rolling(PLANAR)), random, spread), random);
            check(&mut At::new(model::<3>(&rolling(SPATIAL)), random, spread), random);
        }
    }
}

#[test]
fn advance_equals_evaluate_at_the_sum() {
    fn check<M: Model<f64>>(at: &mut At<M>, random: &mut Random) {
        let (n, e) = (at.model.n_unknowns(), at.model.n_extended());
        for size in [1e-6, 1e-2, 0.5] {
            let dq = random.vector(n, e, size);
            let phi = at.terms.phi.clone();
            let (mut advanced, mut evaluated) = (at.terms.clone(), at.terms.clone());
            at.model.advance(&at.q, &dq, &phi, &mut advanced);
            at.model.evaluate(&plus(&at.q, 1.0, &dq), &mut evaluated);
            close("phi", &advanced.phi, &evaluated.phi, ROUNDING);
            close("jacobian", &advanced.jacobian, &evaluated.jacobian, ROUNDING);
        }
    }
    at_random!(check);
}

#[test]
fn geometric_stiffness_is_the_derivative_of_the_constraint_forces() {
    fn check<M: Model<f64>>(at: &mut At<M>, random: &mut Random, scene: &Scene<f64>) {
        let m = at.model.n_constraints();
        let guided = |row| match at.model.owner_of_row(row) {
            Owner::Joint(j) => scene.guides.iter().any(|g| g.joint == JointId::new(j)),
            _ => false,
        };
        // The tangent does not contain the curvature of guided rows.
        let lambda: Vec<f64> =
            (0..m).map(|k| if guided(k) { 0.0 } else { 10.0 * random.next() }).collect();
        let zero = vec![0.0; m];
        let tangent =
            |geometric| Tangent { stiffness: 0.0, damping: 0.0, penalty: &zero, geometric };
        let with = matrix(&at.model, &at.terms, &tangent(Some(&lambda)));
        let without = matrix(&at.model, &at.terms, &tangent(None));
        let load = Load { mass: None, multipliers: Some(&lambda), force: 0.0 };
        for i in 0..at.model.n_unknowns() {
            let difference =
                at.difference(|at, h| at.q[i] += h, |at| residual(&at.model, &at.terms, &load));
            close(
                &format!("column {i}"),
                &plus(&with[i], -1.0, &without[i]),
                &difference,
                DIFFERENCE,
            );
        }
    }
    for spread in SPREADS {
        let (random, planar, spatial) = (&mut Random(7), scene(PLANAR), scene(SPATIAL));
        check(&mut At::new(model::<2>(&planar), random, spread), random, &planar);
        check(&mut At::new(model::<3>(&spatial), random, spread), random, &spatial);
    }
}

#[test]
fn damping_is_the_derivative_of_the_forces_with_respect_to_velocity() {
    fn check<M: Model<f64>>(at: &mut At<M>, _: &mut Random) {
        let zero = vec![0.0; at.model.n_constraints()];
        let tangent =
            |damping| Tangent { stiffness: 0.0, damping, penalty: &zero, geometric: None };
        let with = matrix(&at.model, &at.terms, &tangent(1.0));
        let without = matrix(&at.model, &at.terms, &tangent(0.0));
        for i in 0..at.model.n_unknowns() {
            let difference = at.difference(|at, h| at.v[i] += h, At::minus_force);
            close(
                &format!("column {i}"),
                &plus(&with[i], -1.0, &without[i]),
                &difference,
                DIFFERENCE,
            );
        }
    }
    at_random!(check);
}

/// Scene with only the named effects, without damping. Gravity has no tangent.
fn with_effects(text: &str, names: &[&str]) -> Scene<f64> {
    let mut scene = scene(&text.replace("damping = 7.0", "").replace("damping = 2.0", ""));
    scene.effects.retain(|e| names.contains(&e.name.as_str()));
    assert_eq!(scene.effects.len(), names.len());
    scene
}

fn stiffness_check<M: Model<f64>>(at: &mut At<M>) {
    let zero = vec![0.0; at.model.n_constraints()];
    let tangent = |stiffness| Tangent { stiffness, damping: 0.0, penalty: &zero, geometric: None };
    let with = matrix(&at.model, &at.terms, &tangent(1.0));
    let without = matrix(&at.model, &at.terms, &tangent(0.0));
    for i in 0..at.model.n_unknowns() {
        let difference = at.difference(|at, h| at.q[i] += h, At::minus_force);
        close(&format!("column {i}"), &plus(&with[i], -1.0, &without[i]), &difference, DIFFERENCE);
    }
}

#[test]
fn stiffness_of_a_stretched_spring_is_the_derivative_of_its_force() {
    for spread in [0.0, 0.1] {
        let random = &mut Random(11);
        stiffness_check(&mut At::new(
            model::<2>(&with_effects(PLANAR, &["strut"])),
            random,
            spread,
        ));
        stiffness_check(&mut At::new(
            model::<3>(&with_effects(SPATIAL, &["strut"])),
            random,
            spread,
        ));
    }
}

#[test]
fn stiffness_of_a_torsion_spring_without_torque_is_the_derivative_of_its_force() {
    // At the free value the torque is zero, so that the curvature of the angle, which the tangent omits, has no effect.
    let random = &mut Random(12);
    stiffness_check(&mut At::new(model::<2>(&with_effects(PLANAR, &["coil"])), random, 0.0));
    stiffness_check(&mut At::new(model::<3>(&with_effects(SPATIAL, &["coil"])), random, 0.0));
}

#[test]
fn block_is_mass_plus_weighted_gram_matrix() {
    fn check<M: Model<f64>>(at: &mut At<M>, random: &mut Random) {
        let (n, m) = (at.model.n_unknowns(), at.model.n_constraints());
        let penalty: Vec<f64> = (0..m).map(|_| 2.0 + random.next()).collect();
        let tangent = Tangent { stiffness: 0.0, damping: 0.0, penalty: &penalty, geometric: None };
        let a = matrix(&at.model, &at.terms, &tangent);
        let rows = jacobian(&at.model, &at.terms);
        let mut unit = vec![0.0; at.model.n_extended()];
        for i in 0..n {
            unit[i] = 1.0;
            let weighted: Vec<f64> = (0..m).map(|k| penalty[k] * rows[k][i]).collect();
            let load = Load { mass: Some(&unit), multipliers: Some(&weighted), force: 0.0 };
            close("column", &a[i], &residual(&at.model, &at.terms, &load), ROUNDING);
            unit[i] = 0.0;
        }
    }
    at_random!(check);
}

#[test]
fn residual_changes_as_the_tangent_says_along_the_whole_newton_residual() {
    // residual f = M x + J^T (lambda + s phi), tangent T = M + J^T s J + K_geo(lambda + s phi); x changes with q
    fn check<M: Model<f64>>(at: &mut At<M>, random: &mut Random, scene: &Scene<f64>) {
        let (n, m, e) = (at.model.n_unknowns(), at.model.n_constraints(), at.model.n_extended());
        let guided = |row| match at.model.owner_of_row(row) {
            Owner::Joint(j) => scene.guides.iter().any(|g| g.joint == JointId::new(j)),
            _ => false,
        };
        let free: Vec<bool> = (0..m).map(guided).collect();
        let lambda: Vec<f64> = free.iter().map(|&g| if g { 0.0 } else { random.next() }).collect();
        let penalty: Vec<f64> =
            free.iter().map(|&g| if g { 0.0 } else { 3.0 + random.next() }).collect();
        let reference = at.q.clone();
        let mu = |at: &At<M>| -> Vec<f64> {
            (0..m).map(|k| lambda[k] + penalty[k] * at.terms.phi[k]).collect()
        };
        let f = |at: &At<M>| {
            let x = plus(&at.q, -1.0, &reference);
            let load = Load { mass: Some(&x), multipliers: Some(&mu(at)), force: 0.0 };
            residual(&at.model, &at.terms, &load)
        };
        let mu = mu(at);
        let tangent =
            Tangent { stiffness: 0.0, damping: 0.0, penalty: &penalty, geometric: Some(&mu) };
        let a = matrix(&at.model, &at.terms, &tangent);
        let direction = random.vector(n, e, 1.0);
        let change: Vec<f64> = a.iter().map(|row| mbs_testkit::dot(row, &direction)).collect();
        let difference = at.difference(|at, h| at.q = plus(&at.q, h, &direction), f);
        close("T d", &change, &difference, DIFFERENCE);
    }
    for spread in SPREADS {
        let (random, planar, spatial) = (&mut Random(5), scene(PLANAR), scene(SPATIAL));
        check(&mut At::new(model::<2>(&planar), random, spread), random, &planar);
        check(&mut At::new(model::<3>(&spatial), random, spread), random, &spatial);
    }
}

#[test]
fn power_of_the_applied_forces_is_the_fall_of_potential_energy_plus_the_booked_power() {
    fn check<M: Model<f64>>(at: &mut At<M>, _: &mut Random) {
        // -Q.v = dV/dt - power, along any velocity, for all effects together; lambda = 0 switches guides off
        let zero = vec![0.0; at.model.n_constraints()];
        let power = at.model.power(&at.q, &at.v, &zero, &at.terms);
        let along = |at: &mut At<M>, h: f64| at.q = plus(&at.q, h, &at.v);
        let v = at.difference(along, |at| vec![at.model.potential_energy(&at.q, &at.terms)]);
        let f = at.minus_force();
        let work = mbs_testkit::dot(&f, &at.v[..f.len()]);
        assert!((work - (v[0] - power)).abs() < 1e-5, "{work} against {} less {power}", v[0]);
    }
    at_random!(check);
}

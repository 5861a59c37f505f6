//! Tangents of effects compared with differences of their forces.

use mbs_core::algebra::Vector;
use mbs_core::laws::LawInputs;
use mbs_core::scene::Scene;
use mbs_recursive::link::{ArticulatedInertia, LinkMotion};
use mbs_recursive::loads::{Instant, Load, Reach};
use mbs_recursive::space::Space;
use mbs_recursive::{Planar, TreeModel, passes};

type Motion = Vector<f64, 3>;

const Z: [f64; 3] = [0.3, -0.7, 1.1];
const V: [f64; 3] = [0.4, 0.9, -1.3];

/// Returns a chain of three bars with one effect.
fn chain(effect: &str) -> TreeModel<f64, Planar> {
    let bar = |i: usize, before: &str| {
        let x = i as f64;
        format!(
            "[[body]]\nname = \"b{i}\"\nmass = 1.0\ncenter = [{:?}, 0.0]\ninertia = 0.1\n\
             [[joint]]\nname = \"j{i}\"\nkind = \"revolute\"\nbodies = [\"{before}\", \"b{i}\"]\nat = [{x:?}, 0.0]\n",
            x + 0.5
        )
    };
    let text = "[scene]\nname = \"bars\"\ndimension = 2\nduration = 1.0\n".to_owned()
        + &bar(0, "ground")
        + &bar(1, "b0")
        + &bar(2, "b1")
        + "[[effect]]\nname = \"e\"\n"
        + effect;
    let scene: Scene<f64> = mbs_testkit::scene(&text);
    TreeModel::new(&scene).expect("a tree")
}

/// Returns a spring with a damper between two bodies.
fn spring(first: &str, second: &str, points: [[f64; 2]; 2], free: f64) -> String {
    format!(
        "kind = \"spring-damper\"\nbodies = [\"{first}\", \"{second}\"]\npoints = {points:?}\nstiffness = 70.0\ndamping = 9.0\nfree_length = {free:?}\n"
    )
}

struct Bench {
    model: TreeModel<f64, Planar>,
    placed: Vec<LinkMotion<f64, Planar>>,
}

impl Bench {
    fn new(effect: &str) -> Self {
        Self { model: chain(effect), placed: vec![LinkMotion::ground(); 4] }
    }

    /// Returns the forces along the three freedoms from the forces that `fill` adds to the links.
    fn along(
        &mut self,
        (z, v): (&[f64; 3], &[f64; 3]),
        fill: impl Fn(
            &Load<f64, Planar>,
            &Instant<'_, f64, Planar>,
            &mut [ArticulatedInertia<f64, Planar>],
        ),
    ) -> [f64; 3] {
        let m = self.model.mechanism();
        passes::kinematics(m.links, (z, v, &[]), &mut self.placed).expect("tables that fit");
        let mut condensed = [ArticulatedInertia::<f64, Planar>::empty(); 4];
        let at = Instant {
            links: m.links,
            placed: &self.placed,
            coordinates: (z, v, &[]),
            couplings: &m.loops.couplings,
            law_inputs: LawInputs { courses: &[], ..m.tables },
            base: m.base,
        };
        fill(&m.loads[0], &at, &mut condensed);
        let mut out = [0.0; 3];
        for i in (1..4).rev() {
            let (c, p) = (condensed[i], &self.placed[i]);
            out[i - 1] = c.effort - p.freedom.dot(&c.force);
            condensed[i - 1].force += Planar::gathered(&c.force, &p.arm);
        }
        out
    }

    fn forces(&mut self, z: &[f64; 3], v: &[f64; 3]) -> [f64; 3] {
        self.along((z, v), |load, at, condensed| {
            load.apply(at, condensed).expect("tables that fit")
        })
    }

    /// Returns the decrease of the forces that accelerations `x` cause, computed from the tangents at (z, v).
    fn resistance(&mut self, reach: Reach<f64>, v: &[f64; 3], x: &[f64; 3]) -> [f64; 3] {
        self.along((&Z, v), |load, at, condensed| {
            load.apply_ahead(at, (reach, &[0.0; 3], &[Motion::zeros(); 4]), condensed)
                .expect("tables that fit");
            let mut a = [Motion::zeros(); 4];
            for i in 1..4 {
                let p = &at.placed[i];
                a[i] = Planar::carried(&a[i - 1], &p.arm) + p.freedom * x[i - 1];
                let c = &mut condensed[i];
                c.force = Planar::times(&c.inertia, &a[i]);
                c.effort = -c.resistance * x[i - 1];
            }
        })
        .map(|f| -f)
    }

    /// Returns the decrease of the forces that accelerations `x` cause, computed from central differences of the forces.
    fn difference(&mut self, reach: Reach<f64>, v: &[f64; 3], x: &[f64; 3]) -> [f64; 3] {
        let h = 1e-6;
        let mut moved = |sign: f64| {
            let by = |from: &[f64; 3], reach: f64| {
                core::array::from_fn(|i| from[i] + sign * h * reach * x[i])
            };
            self.forces(&by(&Z, reach.place), &by(v, reach.speed))
        };
        let (ahead, behind) = (moved(1.0), moved(-1.0));
        core::array::from_fn(|i| (behind[i] - ahead[i]) / (2.0 * h))
    }
}

/// Directions of acceleration in joint coordinates.
const X: [[f64; 3]; 4] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.7, -1.2, 0.4]];
/// Coefficients of a step of 0.2 s with the trapezoidal rule.
const REACH: Reach<f64> = Reach { place: 0.01, speed: 0.1 };

/// Returns the length of a spring at [`Z`], if the length is larger than zero. With free length zero it follows from the energy V = k L² /
/// 2.
fn at_z(effect: &str, stiffness: f64) -> f64 {
    let mut bench = Bench::new(effect);
    let m = bench.model.mechanism();
    passes::kinematics(m.links, (&Z, &[0.0; 3], &[]), &mut bench.placed).expect("tables that fit");
    let at = Instant {
        links: m.links,
        placed: &bench.placed,
        coordinates: (&Z, &[0.0; 3], &[]),
        couplings: &m.loops.couplings,
        law_inputs: LawInputs { courses: &[], ..m.tables },
        base: m.base,
    };
    (2.0 * m.loads[0].potential(&at).expect("tables that fit") / stiffness).sqrt()
}

/// Returns a spring whose free length is its length at [`Z`]. The spring has no force there, so that a rotation of the spring does not
/// change the forces.
fn slack(first: &str, second: &str, points: [[f64; 2]; 2]) -> String {
    spring(first, second, points, at_z(&spring(first, second, points, 0.0), 70.0))
}

#[test]
fn tangents_against_the_ground_and_across_joints_are_those_of_the_forces() {
    let hinge = "kind = \"torsion-spring\"\njoint = \"j1\"\nstiffness = 30.0\ndamping = 4.0\nfree_value = 0.2\n";
    let effects = [
        slack("ground", "b1", [[0.2, -2.0], [1.3, 0.1]]),
        slack("b2", "ground", [[2.9, 0.0], [1.0, 3.0]]),
        slack("b0", "b1", [[0.4, 0.3], [1.8, 0.2]]),
        slack("b2", "b1", [[2.7, 0.3], [1.2, 0.3]]),
        hinge.to_owned(),
        hinge.replace("joint = \"j1\"", "terms = [{ joint = \"j1\", factor = -1.5 }]"),
    ];
    for effect in &effects {
        let mut bench = Bench::new(effect);
        for (reach, v) in [(REACH, [0.0; 3]), (Reach { place: 0.0, ..REACH }, V)] {
            for x in &X {
                let told = bench.resistance(reach, &v, x);
                let found = bench.difference(reach, &v, x);
                for i in 0..3 {
                    // Central differences have an error of (1e-6)² times third derivatives. They also have a rounding error: 1e-16 of 10 N,
                    // divided by 1e-6.
                    assert!((told[i] - found[i]).abs() < 1e-7, "{effect}{x:?}: {told:?} {found:?}");
                }
            }
        }
    }
}

/// Checks that the iteration with (M + T̃)⁻¹ (T̃ − T) contracts for every mass matrix M. T is the tangent of the effect, T̃ its
/// approximation by separate links. The condition is that xᵀ (2 T̃ − T) x is not negative; it is checked for many directions x.
fn contracts(effect: &str) {
    let mut bench = Bench::new(effect);
    for i in 0..200_u32 {
        let t = f64::from(i);
        let x = [(0.37 * t).sin(), (0.61 * t).sin(), (1.13 * t).cos()];
        let told = bench.resistance(REACH, &[0.0; 3], &x);
        let found = bench.difference(REACH, &[0.0; 3], &x);
        let work = |f: &[f64; 3]| f.iter().zip(&x).map(|(f, x)| f * x).sum::<f64>();
        // The tolerance is the rounding error of central differences, as in the check of the tangents.
        assert!(2.0 * work(&told) - work(&found) > -1e-7, "{x:?}");
        assert!(work(&found) > -1e-7, "{x:?}");
    }
}

#[test]
fn between_other_links_the_tangent_is_enough_for_the_iteration_to_contract() {
    contracts(&slack("b0", "b2", [[0.4, 0.3], [2.8, 0.2]]));
}

#[test]
fn along_a_sum_the_tangent_is_enough_for_the_iteration_to_contract() {
    // The effects have no tension at Z, because with a tension the rotation of lines would add a term to the differences.
    let joints = "{ joint = \"j0\", factor = 0.7 }, { joint = \"j1\", factor = 1.0 }, { joint = \"j2\", factor = -2.0 }";
    let sum = 0.7 * Z[0] + Z[1] - 2.0 * Z[2];
    let of = |terms: &str, free: f64| {
        format!(
            "kind = \"torsion-spring\"\nterms = [{terms}]\nstiffness = 30.0\ndamping = 4.0\nfree_value = {free:?}\n"
        )
    };
    contracts(&of(joints, sum));
    contracts(&of("{ joint = \"j0\" }, { joint = \"j2\", factor = -1.0 }", Z[0] - Z[2]));
    let line = "{ points = [{ body = \"b0\", at = [0.4, 0.3] }, { body = \"ground\", at = [1.0, 2.0] }, { body = \"b2\", at = [2.8, 0.2] }] }";
    // The sum is relative to the reference configuration. The energy does not determine the sign of the sum, so both signs are tried.
    let sum = at_z(&of(line, 0.0), 30.0);
    let free = if at_z(&of(line, sum), 30.0) < 1e-9 { sum } else { -sum };
    contracts(&of(line, free));
}

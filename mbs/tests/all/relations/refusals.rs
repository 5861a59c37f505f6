//! Relations that stop a run, and uses where code is refused.

use super::{Product, Sum, of_joints, slides, with};
use mbs::core::laws::relation::{MAX_ARGUMENTS, RelationFault};
use mbs::core::real::DoubleDouble;
use mbs::core::scene::SceneFault;
use mbs::{
    Body, Coupling, CouplingTerm, Curve, Error, FormulationKind, GROUND, Joint, JointId, Mechanism,
    Method, Relation, StepRule,
};

/// Mechanism of two perpendicular slides, held by a relation that is zero at the start.
fn mechanism(relation: impl Relation + 'static, value: f64) -> (Mechanism, [JointId; 2]) {
    let mut m = Mechanism::planar("two slides");
    m.set_gravity([2.0, -9.81]).set_duration(1.0);
    let joints = [[0.8, 0.6], [-0.6, 0.8]].map(|axis| {
        let body = m.add(Body::planar([0.0, 0.0], 1.0, 0.1));
        m.add(Joint::prismatic([GROUND, body], [0.0, 0.0]).along(axis))
    });
    m.add(Coupling::relation(joints, relation).holding(value).named("track"));
    (m, joints)
}

/// Product that is not finite below a value of the second number.
#[derive(Debug)]
struct Ending {
    below: f64,
    what: [f64; 3],
}

impl Relation for Ending {
    fn evaluate(&self, at: &[f64], gradient: &mut [f64]) -> f64 {
        let value = Product.evaluate(at, gradient);
        if at[1] > self.below {
            return value;
        }
        gradient[1] += self.what[1];
        value + self.what[0]
    }

    fn curvature(&self, at: &[f64], rates: &[f64]) -> f64 {
        let along = Product.curvature(at, rates);
        if at[1] > self.below { along } else { along + self.what[2] }
    }
}

#[test]
fn a_relation_that_is_not_finite_ends_the_step_with_the_name_of_its_coupling() {
    let fixed = FormulationKind::ALL.map(Method::new);
    let integrators = ["rk4", "rk54", "rk853", "gbs", "radau5"].map(|name| Method {
        integrator: Some(name.to_owned()),
        ..Method::new(FormulationKind::Recursive)
    });
    let controlled = FormulationKind::ALL
        .into_iter()
        .flat_map(|f| [StepRule::Error, StepRule::Energy].map(|rule| Method::new(f).control(rule)));
    let nan = f64::NAN;
    for method in fixed.into_iter().chain(integrators).chain(controlled) {
        for what in [[nan, 0.0, 0.0], [0.0, f64::INFINITY, 0.0], [0.0, 0.0, nan]] {
            let (m, joints) = mechanism(Ending { below: -0.1, what }, 1.0);
            // not every formulation has every integrator
            let Ok(mut sim) = m.simulate(&method) else { continue };
            let error = sim.advance_to(1.0).expect_err("the relation ends");
            assert_eq!(error.code(), "relation-not-finite", "{method:?}, {what:?}: {error}");
            assert!(error.to_string().starts_with("`track`: its relation"), "{error}");
            let x = sim.value(joints[1]);
            assert!(x.is_finite() && x < -0.05 && sim.time() > 0.01, "{method:?}: {x}");
        }
    }
}

#[test]
fn a_relation_that_is_not_finite_in_the_reference_configuration_is_refused() {
    let (m, _) = mechanism(Ending { below: 0.5, what: [f64::NAN, 0.0, 0.0] }, 1.0);
    let error = m.simulate(&Method::default()).expect_err("it has no value");
    assert!(error.to_string().contains("infinite or NaN"), "{error}");
}

/// Product with a wrong derivative.
#[derive(Debug)]
struct Wrong {
    slope: f64,
    mixed: f64,
}

impl Relation for Wrong {
    fn evaluate(&self, at: &[f64], gradient: &mut [f64]) -> f64 {
        let value = Product.evaluate(at, gradient);
        gradient[1] *= self.slope;
        value
    }

    fn curvature(&self, at: &[f64], rates: &[f64]) -> f64 {
        self.mixed * Product.curvature(at, rates)
    }
}

#[test]
fn a_wrong_derivative_is_refused_with_its_number_and_the_right_value() {
    let (m, _) = mechanism(Wrong { slope: -1.0, mixed: 1.0 }, 1.0);
    let error = m.simulate(&Method::default()).expect_err("the sign is wrong").to_string();
    assert!(error.contains("coupling 1") && error.contains("by its number 2"), "{error}");
    assert!(error.contains("-1e0") && error.contains("change by"), "{error}");
    let (m, _) = mechanism(Wrong { slope: 1.0, mixed: 0.5 }, 1.0);
    let error = m.simulate(&Method::default()).expect_err("half of the mixed term is missing");
    assert!(error.to_string().contains("curvature"), "{error}");
    let (m, _) = mechanism(Wrong { slope: 1.0, mixed: 1.0 }, 1.0);
    assert!(m.simulate(&Method::default()).is_ok());
}

#[test]
fn a_derivative_that_is_right_in_the_reference_configuration_alone_is_refused_at_the_start() {
    /// Relation (1 + x)(1 + y) - 1 with the gradient of x + y.
    #[derive(Debug)]
    struct Late;
    impl Relation for Late {
        fn evaluate(&self, at: &[f64], gradient: &mut [f64]) -> f64 {
            gradient.fill(1.0);
            at[0] + at[1] + at[0] * at[1] * (at[0] * at[0])
        }
        fn curvature(&self, _: &[f64], _: &[f64]) -> f64 {
            0.0
        }
    }
    let text = slides(
        2,
        [0.0; 3],
        &[("a", 1.0, "ground", [1.0, 0.0, 0.0]), ("b", 1.0, "ground", [0.0, 1.0, 0.0])],
    );
    let starts = "[[initial]]\njoint = \"a-s\"\nvalue = [1.0]\n[[initial]]\njoint = \"b-s\"\nvalue = [-0.5]\n";
    let refused = |text: &str| with(text, [of_joints(&[0, 1], Late)]).resolve::<f64>().err();
    assert_eq!(refused(&text), None);
    let fault = refused(&(text + starts)).expect("the gradient is wrong there").fault;
    let SceneFault::Relation(RelationFault::Gradient { argument, numbers }) = fault else {
        panic!("{fault:?}")
    };
    // the derivative d/dx (x + y + x^3 y) at (1, -0.5) is -0.5
    assert_eq!((argument, numbers[0]), (0, 1.0));
    assert!((numbers[1] + 0.5).abs() < 1e-5, "{numbers:?}");
}

#[test]
fn too_many_terms_curves_and_factors_of_zero_are_refused() {
    let bodies = [("a", 1.0, "ground", [1.0, 0.0, 0.0]), ("b", 1.0, "ground", [0.0, 1.0, 0.0])];
    let refused = |coupling: Coupling| {
        let scene = with(&slides(2, [0.0; 3], &bodies), [coupling]).resolve::<f64>();
        scene.expect_err("refused").fault
    };
    let n = MAX_ARGUMENTS + 1;
    let many = of_joints(&vec![0; n], Sum(vec![1.0; n]));
    assert_eq!(refused(many), SceneFault::Relation(RelationFault::TooMany { found: n }));
    let mut curved = of_joints(&[0, 1], Product).holding(1.0);
    curved.terms[1].curve = Some(Curve::Polynomial(vec![1.into(), 2.into()]));
    assert_eq!(refused(curved), SceneFault::Relation(RelationFault::Curve { term: 1 }));
    let mut zero = of_joints(&[0, 1], Product).holding(1.0);
    zero.terms[0] = CouplingTerm::of_joint(JointId::new(0), 0, 0.0);
    assert_eq!(refused(zero), SceneFault::NoTerm);
    assert_eq!(refused(of_joints(&[], Product)), SceneFault::NoTerm);
}

#[test]
fn start_values_off_the_relation_are_refused_with_both_numbers() {
    let bodies = [("a", 1.0, "ground", [1.0, 0.0, 0.0]), ("b", 1.0, "ground", [0.0, 1.0, 0.0])];
    let starts = "[[initial]]\njoint = \"a-s\"\nvalue = [1.0]\n[[initial]]\njoint = \"b-s\"\nvalue = [0.5]\n";
    let text = slides(2, [0.0; 3], &bodies) + starts;
    let fault = with(&text, [of_joints(&[0, 1], Product).holding(1.0)]).resolve::<f64>();
    assert_eq!(fault.expect_err("3 is not 1").fault, SceneFault::SumAtStart([3.0, 1.0]));
}

#[test]
fn what_is_written_and_exported_refuses_relations_by_name() {
    let (mut m, _) = mechanism(Product, 1.0);
    let error = m.to_toml().expect_err("code has no text");
    assert_eq!(error.code(), "not-written");
    assert!(error.to_string().contains("coupling `track`"), "{error}");
    let error = m.set("scene.duration", 1.0).expect_err("no text to set it in");
    assert!(error.to_string().contains("`track`"), "{error}");
    let bodies = [("a", 1.0, "ground", [1.0, 0.0, 0.0]), ("b", 1.0, "ground", [0.0, 1.0, 0.0])];
    let scene = with(&slides(2, [0.0; 3], &bodies), [of_joints(&[0, 1], Product).holding(1.0)]);
    let pairs = scene.resolve::<DoubleDouble>().expect_err("a relation has 16 digits");
    assert_eq!(pairs.fault, SceneFault::Relation(RelationFault::Doubles));
    let scene = scene.resolve::<f64>().expect("a scene");
    let settings = mbs::ResolvedMethod::new(&scene, &Method::new(FormulationKind::Recursive));
    let settings = settings.expect("settings");
    let error = mbs::export::export(&scene, &settings, (&[], false)).expect_err("code");
    assert!(error.to_string().contains("`held`"), "{error}");
}

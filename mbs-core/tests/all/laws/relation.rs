//! Checks of the derivatives of a user-defined relation.

use mbs_core::laws::relation::*;

/// Relation x y^2 z / l^3 whose derivatives are multiplied by factors. The derivatives are right if the factors are one.
#[derive(Debug)]
struct Product {
    length: f64,
    by: [f64; 3],
    mixed: f64,
}

impl Relation for Product {
    fn evaluate(&self, at: &[f64], gradient: &mut [f64]) -> f64 {
        let [x, y, z] = [at[0], at[1], at[2]].map(|x| x / self.length);
        let slopes = [y * y * z, 2.0 * x * y * z, x * y * y];
        for (to, (slope, by)) in gradient.iter_mut().zip(slopes.iter().zip(self.by)) {
            *to = by * slope / self.length;
        }
        x * y * y * z
    }

    fn curvature(&self, at: &[f64], rates: &[f64]) -> f64 {
        let [x, y, z] = [at[0], at[1], at[2]].map(|x| x / self.length);
        let [u, v, w] = [rates[0], rates[1], rates[2]].map(|x| x / self.length);
        let mixed = 2.0 * y * z * u * v + y * y * u * w + 2.0 * x * y * v * w;
        2.0 * x * z * v * v + 2.0 * self.mixed * mixed
    }
}

#[test]
fn a_relation_is_right_over_any_length_and_each_wrong_derivative_is_found() {
    // a place off the axes, in units of the relation's length
    let place = [0.7, -1.3, 0.4];
    for length in [1e-4, 1.0, 1e3] {
        let at = place.map(|x| x * length);
        let right = Product { length, by: [1.0; 3], mixed: 1.0 };
        assert_eq!(check(&right, &at), Ok(()), "{length}");
        for k in 0..3 {
            let mut by = [1.0; 3];
            by[k] = -1.0;
            let fault = check(&Product { length, by, mixed: 1.0 }, &at);
            let Err(RelationFault::Gradient { argument, numbers: [given, found] }) = fault else {
                panic!("{length}, {k}: {fault:?}")
            };
            assert_eq!(argument, k);
            assert!((given + found).abs() < 1e-2 * found.abs(), "{given} {found}");
        }
        // mixed derivatives counted once instead of twice
        let fault = check(&Product { length, by: [1.0; 3], mixed: 0.5 }, &at);
        assert!(matches!(fault, Err(RelationFault::Curvature { .. })), "{length}: {fault:?}");
    }
}

#[test]
fn a_relation_that_is_not_finite_is_refused_and_one_at_the_edge_of_its_values_is_not() {
    #[derive(Debug)]
    struct Root;
    impl Relation for Root {
        fn evaluate(&self, at: &[f64], gradient: &mut [f64]) -> f64 {
            gradient[0] = 0.5 / at[0].sqrt();
            at[0].sqrt()
        }
        fn curvature(&self, at: &[f64], rates: &[f64]) -> f64 {
            -0.25 * rates[0] * rates[0] / (at[0] * at[0].sqrt())
        }
    }
    assert_eq!(check(&Root, &[-1.0]), Err(RelationFault::NotFinite));
    assert_eq!(check(&Root, &[0.0]), Err(RelationFault::NotFinite));
    assert_eq!(check(&Root, &[2e-5]), Ok(()));
}

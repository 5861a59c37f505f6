//! The size of a convergence map.

use mbs::{FormulationKind, Precision};
use mbs_study::inside::compare::{Instants, MapPlan};

#[test]
fn a_map_is_made_smaller_where_it_would_take_long() {
    let instants = Instants { count: 200, interval: 0.05 };
    let which = || (vec![FormulationKind::Index3, FormulationKind::Index1], vec![Precision::F64]);
    let plan = MapPlan::new((instants, 1e-3), which(), (6, 60.0));
    assert_eq!((plan.instants.count, plan.between.len()), (4, 7));
    assert!((plan.steps()[0] - 1e-2).abs() < 1e-12);
    let smaller = MapPlan::new((instants, 1e-3), which(), (6000, 1.0));
    assert!(smaller.instants.count == 1 && smaller.between.len() < 7, "{smaller:?}");
}

//! Methods of a comparison, by their names.

use mbs::{FormulationKind, Precision};
use mbs_study::inside::compare::MethodCase;

#[test]
fn every_formulation_is_compared_and_names_are_unique() {
    let methods = MethodCase::all(&[], &[]);
    for formulation in FormulationKind::ALL {
        assert!(methods.iter().any(|m| m.formulation == formulation), "{formulation:?}");
    }
    let mut names: Vec<String> = methods.iter().map(MethodCase::name).collect();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), methods.len());
    assert_eq!(MethodCase::all(&[FormulationKind::Classical], &[Precision::F64]).len(), 2);
}

//! Tables of a reference.

use mbs::record::Channel;
use mbs_scene::Component;
use mbs_study::compare::TableError;
use mbs_study::inside::compare::{Instants, read};

fn channels() -> Vec<Channel> {
    let part = |label: &str| Component { label: label.into(), unit: "m".into() };
    vec![Channel { name: "tip".into(), quantity: "", components: vec![part("x"), part("y")] }]
}

const INSTANTS: Instants = Instants { count: 4, interval: 0.5 };

#[test]
fn a_table_may_have_some_instants_and_some_columns() {
    let text = "t, tip.y\n0,0\n0.5,-1.25\n0.7,3\n2.0,1.5e-3\n";
    let table = read(text, &channels(), (&INSTANTS, 2.0)).unwrap();
    let given: Vec<bool> = table.rows.iter().map(Option::is_some).collect();
    assert_eq!(given, [true, false, false, true]);
    assert_eq!(table.rows[3].as_ref().unwrap()[1].to_bits(), 1.5e-3_f64.to_bits());
    assert_eq!(table.has, [false, true]);
    // this is the root mean square of half units of the last digits, 0.005 and 0.00005
    let expected = 0.005 * (0.5_f64 * 1.0001).sqrt();
    assert!((table.digits[1] - expected).abs() < 1e-15, "{:?}", table.digits);
}

#[test]
fn what_cannot_be_used_is_said() {
    let refused = |text: &str| read(text, &channels(), (&INSTANTS, 3.0)).unwrap_err();
    assert_eq!(refused("time,tip.x\n"), TableError::NoTime);
    assert_eq!(refused("t,x\n0.5,1\n"), TableError::NoOutput);
    assert_eq!(refused("t,tip.x\n0.5,one\n"), TableError::NotANumber(2, "tip.x".into()));
    for number in ["NaN", "inf", ""] {
        let found = refused(&format!("t,tip.x\n0.5,1\n0.7,{number}\n1.0,1\n"));
        assert_eq!(found, TableError::NotANumber(3, "tip.x".into()), "at no instant either");
    }
    assert_eq!(refused("t,tip.x\n0.6,1\n"), TableError::NoInstant("0.5".into()));
    assert_eq!(refused("t,tip.x\n"), TableError::Empty);
    assert_eq!(refused("t,tip.x\n1.0,1\n0.5,1\n"), TableError::Order(3));
    assert_eq!(refused("t,tip.x\n0.5,1\n0.5,1\n"), TableError::Order(3));
    assert_eq!(refused("t,tip.x\n0.5,1\n3.5,1\n"), TableError::Beyond(3, "3.5".into(), "3".into()));
    assert!(matches!(refused("t,tip.x\n-0.5,1\n"), TableError::Beyond(2, ..)));
    assert!(read("t,tip.x\n0.5,1\n3.0,1\n", &channels(), (&INSTANTS, 3.0)).is_ok());
    let unknown = refused("t,tip.x,tip.yy\n0.5,1,2\n");
    assert!(matches!(&unknown, TableError::UnknownColumn(name, _) if name == "tip.yy"));
    assert!(unknown.hint().starts_with("did you mean `tip.y`?"), "{}", unknown.hint());
}

//! Order, energy and invariance.

use crate::{mechanism, run, scene};

#[test]
fn steps_are_of_order_eight() {
    let m = scene("scenes/spinning-top.toml");
    let exact = run(&m, 0.2);
    let error = |n: usize| {
        let mut state = m.start().expect("it starts");
        (0..n).for_each(|_| state = m.step(&state, 0.2 / n as f64));
        judge::vector::norm(judge::vector::sub(state.frames[0].r, exact.frames[0].r))
    };
    let (coarse, fine) = (error(16), error(32));
    let order = (coarse / fine).log2();
    // a wrong coefficient would give an order of six or less
    assert!(order > 7.7 && order < 8.5, "order {order}: {coarse:e} {fine:e}");
}

#[test]
fn springs_store_what_the_motion_gives() {
    let text = "[scene]\ndimension = 3\nduration = 1.0\ngravity = [1.0, 2.0, -9.81]\n\
        [[body]]\nname = \"a\"\nmass = 1.0\ncenter = [0.1, 0.2, 0.3]\ninertia = [0.1, 0.2, 0.25, 0.01, -0.02, 0.03]\n\
        [[body]]\nname = \"b\"\nmass = 0.5\ncenter = [0.8, 0.1, 0.2]\ninertia = [0.02, 0.03, 0.04, 0.0, 0.0, 0.0]\n\
        [[joint]]\nname = \"u\"\nkind = \"universal\"\nbodies = [\"ground\", \"a\"]\nat = [0.0, 0.0, 0.0]\naxes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]\n\
        [[joint]]\nname = \"c\"\nkind = \"cylindrical\"\nbodies = [\"b\", \"a\"]\nat = [0.5, 0.1, 0.2]\naxis = [1.0, 1.0, 0.0]\n\
        [[initial]]\njoint = \"u\"\nvalue = [0.3, -0.4]\nrate = [1.0, 2.0]\n\
        [[effect]]\nkind = \"spring-damper\"\nbodies = [\"ground\", \"b\"]\npoints = [[1.0, 1.0, 0.0], [0.9, 0.1, 0.2]]\nstiffness = 20.0\nfree_length = 0.3\n\
        [[effect]]\nkind = \"torsion-spring\"\njoint = \"c\"\nstiffness = 2.0\n";
    let m = mechanism(text);
    let (start, end) = (m.start().expect("it starts"), run(&m, 1.0));
    let [before, after] = [&start, &end].map(|s| m.invariant(s));
    assert!((before - after).abs() < 1e-9, "{before} {after}");
    assert!(end.work.abs() < 1e-9, "no work: {}", end.work);
    assert!(m.violation(&end)[0] < 1e-13);
}

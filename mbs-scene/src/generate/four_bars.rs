//! Four-bar linkages side by side.

use super::text::Text;

const COMMENT: &str = "\
Four-bar linkages side by side: uniform rods of 1 m and 1 kg, cranks up, tips moving at 1 m/s in x.

The scene four-bar many times over; with forty, n-four-bar-40. One freedom, and one more for each linkage at every
passage through the horizontal. With parallel cranks the motion is the pendulum I a'' = -g ((N + 1) / 2 + N) cos a,
I = ((N + 1) / 3 + N) 1 kg m^2, a from +x, a(0) = pi / 2, |a'(0)| = 1 rad/s.";

pub(super) fn text(loops: usize, command: &str) -> String {
    let mut text = Text::new(COMMENT, command);
    text.scene(&format!("n-four-bar {loops}"), 2, 10.0);
    let place = |k: usize, up: f64| [k as f64, up];
    let (crank, coupler) = (|k: usize| format!("crank-{k}"), |k: usize| format!("coupler-{k}"));
    for k in 0..=loops {
        text.rod(&crank(k), [&place(k, 0.0), &place(k, 1.0)], 1.0);
        if k < loops {
            text.rod(&coupler(k), [&place(k, 1.0), &place(k + 1, 1.0)], 1.0);
        }
    }
    let mut revolute = |name: &str, k: usize, bodies: [&str; 2], at: [f64; 2]| {
        text.joint(&format!("{name}-{k}"), "revolute", bodies, &at);
    };
    for k in 0..=loops {
        revolute("pivot", k, ["ground", &crank(k)], place(k, 0.0));
    }
    for k in 0..loops {
        revolute("start", k, [&crank(k), &coupler(k)], place(k, 1.0));
        revolute("end", k, [&coupler(k), &crank(k + 1)], place(k + 1, 1.0));
    }
    text.table("[[initial]]");
    text.key("joint", "\"pivot-0\"");
    text.key("value", "0.0");
    text.key("rate", "-1.0");
    text.step(1e-3);
    text.position("crank-end", &crank(0), &place(0, 1.0));
    text.position("last-crank-end", &crank(loops), &place(loops, 1.0));
    text.0
}

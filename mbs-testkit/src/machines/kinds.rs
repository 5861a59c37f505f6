//! Kinds of random machines: gears, belts, racks, a screw, differentials, a winch, rolling wheels.

use super::{Drawn, Machine, Slip, Vector, Wording, Written, Z, dot, plus, slide, turn};
use crate::Random;

/// Direction from one wheel to the next, and the direction orthogonal to it.
const WAY: Vector = [0.8, 0.6, 0.0];
const ACROSS: Vector = [-0.6, 0.8, 0.0];
/// Direction in which racks and wheels move, and the upward direction.
const X: Vector = [1.0, 0.0, 0.0];
const Y: Vector = [0.0, 1.0, 0.0];
/// First lines of the text of every coupling.
const LINK: &str = "[[coupling]]\nname = \"link\"";

/// Radii of two parts, and the point of the first part.
#[derive(Debug, Clone, Copy)]
struct Parts {
    r1: f64,
    r2: f64,
    one: Vector,
}

impl Parts {
    /// Returns a point at a distance from the first part.
    fn apart(&self, distance: f64) -> Vector {
        plus(self.one, distance, WAY)
    }

    /// Returns the coupling of two gears with these radii, including their pitch point.
    fn in_mesh(self, head: &'static str) -> Written {
        let wheels = self.by_radii(head);
        Box::new(move |wording| {
            format!("{}\nat = {:?}", wheels(wording), wording.place(self.apart(self.r1)))
        })
    }

    /// Returns the coupling of a belt on wheels with these radii.
    fn with_strands(self, head: &'static str) -> Written {
        let wheels = self.by_radii(head);
        Box::new(move |wording| {
            format!("{}\npretension = {:?}", wheels(wording), 200.0 * wording.metre)
        })
    }

    /// Returns a coupling of both parts by their radii.
    fn by_radii(self, head: &'static str) -> Written {
        Box::new(move |wording| {
            let [r1, r2] = [self.r1, self.r2].map(|r| r * wording.metre);
            format!("{LINK}\n{head}\njoints = [\"one\", \"two\"]\nradii = [{r1:?}, {r2:?}]")
        })
    }

    fn one(&self) -> Drawn {
        turn("one", ["frame", "one"], self.one)
    }
}

/// Returns the relative velocity of two bodies at a point, along a direction.
fn touching(bodies: [&'static str; 2], place: Vector, along: Vector) -> Slip {
    Box::new(move |v| {
        let [a, b] = bodies.map(|body| v(body).at(place));
        dot(plus(a, -1.0, b), along)
    })
}

/// Creates a machine with two gears.
fn gears(of: Parts, kind: usize) -> Machine {
    let other = of.apart(of.r1 + of.r2);
    let coupling = of.by_radii("kind = \"gear\"");
    let arm = turn("arm", ["frame", "arm"], of.one);
    let slip = touching(["one", "two"], of.apart(of.r1), ACROSS);
    let (what, joints) = match kind {
        0 => {
            let joints = vec![of.one(), turn("two", ["frame", "two"], other)];
            let coupling = of.in_mesh("kind = \"gear\"");
            return Machine { what: "gears", joints, coupling, slip };
        }
        1 => ("planet on an arm", vec![of.one(), arm, turn("two", ["arm", "two"], other)]),
        2 => (
            "arms about both axes",
            vec![
                of.one(),
                arm,
                turn("fork", ["arm", "fork"], other),
                turn("two", ["fork", "two"], other),
            ],
        ),
        3 => {
            let joints =
                vec![turn("one", ["frame", "arm"], of.one), turn("two", ["arm", "two"], other)];
            let slip = touching(["frame", "two"], of.apart(of.r1), ACROSS);
            return Machine { what: "sun held by the frame", joints, coupling, slip };
        }
        _ => {
            let inside = Parts { r2: 0.4 * of.r1, ..of };
            let joints = vec![of.one(), turn("two", ["frame", "two"], of.apart(0.6 * of.r1))];
            let coupling = inside.in_mesh("kind = \"gear\"\nmesh = \"internal\"");
            return Machine { what: "wheel in a ring", joints, coupling, slip };
        }
    };
    Machine { what, joints, coupling, slip }
}

/// Creates a machine with two wheels and a belt. One straight strand of the belt runs from rim to rim.
fn belt(of: Parts, is_crossed: bool) -> Machine {
    let d = of.r1 + of.r2 + 0.5;
    let r2 = if is_crossed { -of.r2 } else { of.r2 };
    // normal of the strand, the same at both rims
    let c = (of.r1 - r2) / d;
    let n = plus(plus([0.0; 3], c, WAY), (1.0 - c * c).sqrt(), ACROSS);
    let ends = [plus(of.one, of.r1, n), plus(of.apart(d), r2, n)];
    let strand = plus(ends[1], -1.0, ends[0]);
    Machine {
        what: if is_crossed { "crossed belt" } else { "belt" },
        joints: vec![of.one(), turn("two", ["frame", "two"], of.apart(d))],
        coupling: of.with_strands(if is_crossed {
            "kind = \"belt\"\ncrossed = true"
        } else {
            "kind = \"belt\""
        }),
        slip: Box::new(move |v| {
            dot(v("one").at(ends[0]), strand) - dot(v("two").at(ends[1]), strand)
        }),
    }
}

/// Creates a machine with a pinion and a rack along x, above or below the pinion.
fn rack(of: Parts, kind: usize) -> Machine {
    let side = if kind == 0 { -of.r1 } else { of.r1 };
    let line = plus(of.one, side, Y);
    let coupling = Box::new(move |wording: &Wording| {
        let radius = of.r1 * wording.metre;
        format!("{LINK}\nkind = \"rack\"\njoints = [\"one\", \"two\"]\nradius = {radius:?}")
    });
    let along = plus(line, 0.7, X);
    let on_cart = turn("one", ["cart", "one"], of.one);
    let (what, joints, other) = match kind {
        0 | 1 => ("rack", vec![of.one(), slide("two", ["frame", "two"], along)], "two"),
        2 => (
            "pinion on a cart, rack on the frame",
            vec![
                slide("cart", ["frame", "cart"], of.one),
                on_cart,
                slide("two", ["frame", "two"], along),
            ],
            "two",
        ),
        _ => (
            "pinion on a cart that runs along a rack",
            vec![slide("two", ["frame", "cart"], line), on_cart],
            "frame",
        ),
    };
    Machine { what, joints, coupling, slip: touching(["one", other], line, X) }
}

/// Creates a machine with a rotating screw and a sliding nut.
fn screw(of: Parts) -> Machine {
    let lead = of.r1;
    Machine {
        what: "screw",
        joints: vec![of.one(), Drawn { axis: Z, ..slide("two", ["frame", "two"], of.apart(1.0)) }],
        coupling: Box::new(move |wording| {
            let lead = lead * wording.metre;
            format!("{LINK}\nkind = \"screw\"\njoints = [\"one\", \"two\"]\nlead = {lead:?}")
        }),
        slip: Box::new(move |v| {
            let frame = v("frame");
            let turns = dot(plus(v("one").0, -1.0, frame.0), Z) / core::f64::consts::TAU;
            let at = of.apart(1.0);
            dot(plus(v("two").at(at), -1.0, frame.at(at)), Z) - lead * turns
        }),
    }
}

/// Creates a differential of two wheels and a cage. Both wheels are on the frame, or one of them is on the cage.
fn differential(of: Parts, is_on_cage: bool) -> Machine {
    let own = if is_on_cage { "cage" } else { "frame" };
    Machine {
        what: if is_on_cage { "sun on the carrier" } else { "half shafts" },
        joints: vec![
            turn("cage", ["frame", "cage"], of.one),
            turn("one", [own, "one"], plus(of.one, 1.0, Z)),
            turn("two", ["frame", "two"], plus(of.one, -1.0, Z)),
        ],
        coupling: Box::new(|_| {
            let joints = "joints = [\"one\", \"two\", \"cage\"]";
            format!("{LINK}\nkind = \"differential\"\n{joints}\nteeth = [20, 30]")
        }),
        slip: Box::new(move |v| {
            let [a, b] = ["one", "two"].map(|wheel| dot(plus(v(wheel).0, -1.0, v("cage").0), Z));
            20.0 * a + 30.0 * b
        }),
    }
}

/// Creates a winch: a drum, and a weight on a slide, connected by a rope that leaves the drum at its rim.
fn winch(of: Parts) -> Machine {
    let (rim, weight) = (of.apart(of.r1), plus(of.apart(of.r1), -3.0, ACROSS));
    Machine {
        what: "winch",
        joints: vec![of.one(), Drawn { axis: ACROSS, ..slide("two", ["frame", "two"], weight) }],
        coupling: Box::new(move |wording| {
            // the rope below the rim becomes longer when the drum rotates in the negative sense about z
            let radius = of.r1 * wording.metre * wording.sense("one");
            format!(
                "{LINK}\nkind = \"rope\"\npoints = [{{ body = \"frame\", at = {:?} }}, {{ body = \"two\", at = {:?} }}]\n\
                 drum = {{ joint = \"one\", radius = {radius:?} }}",
                wording.place(rim),
                wording.place(weight)
            )
        }),
        slip: Box::new(move |v| {
            let [drum, weight, frame] =
                [("one", rim), ("two", weight), ("frame", weight)].map(|(body, at)| v(body).at(at));
            let carried = v("frame").at(rim);
            dot(plus(drum, -1.0, carried), ACROSS) - dot(plus(weight, -1.0, frame), ACROSS)
        }),
    }
}

/// Creates a wheel that rolls without slip. It is on a cart along the frame, or on an arm over a tilting plank.
fn wheel(of: Parts, is_on_plank: bool) -> Machine {
    let line = plus(of.one, -of.r1, Y);
    let (what, joints, on) = if is_on_plank {
        let arm = turn("arm", ["frame", "arm"], plus(plus(of.one, -1.0, X), 0.2, Y));
        let plank = turn("two", ["frame", "two"], plus(plus(line, 0.9, X), -0.1, Y));
        let joints = vec![arm, turn("one", ["arm", "one"], of.one), plank];
        ("wheel on a plank", joints, "two")
    } else {
        let cart = slide("cart", ["frame", "cart"], of.one);
        ("wheel under a cart", vec![cart, turn("one", ["cart", "one"], of.one)], "frame")
    };
    let coupling: Written = Box::new(move |wording| {
        format!(
            "[[rolling]]\nname = \"link\"\nkind = \"wheel\"\nbody = \"one\"\non = \"{on}\"\ncenter = {:?}\naxis = {:?}\nradius = {:?}\n\
             plane = {{ point = {:?}, normal = {:?} }}",
            wording.place(of.one),
            wording.turned(Z),
            of.r1 * wording.metre,
            wording.place(line),
            wording.turned(Y),
        )
    });
    Machine { what, joints, coupling, slip: touching(["one", on], line, X) }
}

/// Number of the kinds of machines with a coupling. These kinds have the first indices.
pub const COUPLED: usize = 15;
/// Number of all kinds of machines. The kinds after the coupled ones have a rolling contact.
pub const KINDS: usize = 17;

/// Creates a machine of a kind with parts of random sizes. The machine is on a rotating frame, and the frame on a sliding base.
///
/// # Panics
/// Never.
pub fn machine(random: &mut Random, kind: usize) -> Machine {
    let mut size = || 0.6 + 0.4 * random.next();
    let of = Parts { r1: size(), r2: size(), one: [0.3, size(), 0.0] };
    let base = slide("base", ["ground", "base"], [0.0, size(), 0.0]);
    let swing = turn("swing", ["base", "frame"], [-3.0, size(), 0.0]);
    let mut machine = match kind {
        0..5 => gears(of, kind),
        5 | 6 => belt(of, kind == 6),
        7..11 => rack(of, kind - 7),
        11 => screw(of),
        12 | 13 => differential(of, kind == 13),
        14 => winch(of),
        _ => wheel(of, kind == 16),
    };
    machine.joints.splice(0..0, [base, swing]);
    machine
}

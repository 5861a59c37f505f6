//! Random machines with a coupling or a rolling wheel. Each machine can be written as a scene in several equivalent ways.

pub mod kinds;

use crate::Random;

type Vector = [f64; 3];

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn plus(a: Vector, s: f64, b: Vector) -> Vector {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

/// A joint of a machine. Its second body moves relative to the first along the axis, or about it.
#[derive(Debug, Clone)]
pub struct Drawn {
    /// Name of the joint.
    pub name: &'static str,
    /// Bodies of the joint; the first is closer to the ground.
    pub bodies: [&'static str; 2],
    /// True for a rotation; false for a slide.
    pub is_turn: bool,
    /// Point of the joint [m].
    pub at: Vector,
    /// Axis of the joint.
    pub axis: Vector,
}

fn turn(name: &'static str, bodies: [&'static str; 2], at: Vector) -> Drawn {
    Drawn { name, bodies, is_turn: true, at, axis: [0.0, 0.0, 1.0] }
}

fn slide(name: &'static str, bodies: [&'static str; 2], at: Vector) -> Drawn {
    Drawn { name, bodies, is_turn: false, at, axis: [1.0, 0.0, 0.0] }
}

/// Slip of two parts at their contact [m/s], as a function of the velocities of the bodies.
pub type Slip = Box<dyn Fn(&dyn Fn(&str) -> Twist) -> f64>;

/// Function that writes the text of a coupling, or of a rolling contact, in a wording.
pub type Written = Box<dyn Fn(&Wording) -> String>;

/// A machine with a coupling, and the slip that the coupling constrains to zero.
pub struct Machine {
    /// Description of the machine.
    pub what: &'static str,
    /// Joints of the machine.
    pub joints: Vec<Drawn>,
    /// Coupling of the machine, or its rolling contact.
    pub coupling: Written,
    /// Slip of the parts of the machine at their contact [m/s].
    pub slip: Slip,
}

impl core::fmt::Debug for Machine {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Machine")
            .field("what", &self.what)
            .field("joints", &self.joints)
            .finish_non_exhaustive()
    }
}

/// Twist of a body: the angular velocity, and the velocity of the body's point at the origin of coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist(pub Vector, pub Vector);

impl Twist {
    /// Returns the velocity of the body's point at `place`.
    #[must_use]
    pub fn at(self, place: Vector) -> Vector {
        plus(self.1, 1.0, cross(self.0, place))
    }
}

/// Returns the velocities of the bodies from the rates of the joints, computed outward from the ground.
#[must_use]
pub fn twists(joints: &[Drawn], rates: &[f64]) -> Vec<(&'static str, Twist)> {
    let mut known = vec![("ground", Twist([0.0; 3], [0.0; 3]))];
    while known.len() <= joints.len() {
        for (joint, &rate) in joints.iter().zip(rates) {
            let of = |body: &str| known.iter().find(|(name, _)| *name == body).map(|(_, t)| *t);
            if let (Some(own), None) = (of(joint.bodies[0]), of(joint.bodies[1])) {
                let twist = if joint.is_turn {
                    let way = cross(joint.at, joint.axis);
                    Twist(plus(own.0, rate, joint.axis), plus(own.1, rate, way))
                } else {
                    Twist(own.0, plus(own.1, rate, joint.axis))
                };
                known.push((joint.bodies[1], twist));
            }
        }
    }
    known
}

const Z: Vector = [0.0, 0.0, 1.0];

/// Ways in which the text of a machine may differ from its definition.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ways {
    /// Swaps the two bodies of joints.
    pub swaps: bool,
    /// Gives axes any length and either sense.
    pub reverses: bool,
    /// Shuffles bodies and joints.
    pub shuffles: bool,
    /// Rotates the whole machine.
    pub turns: bool,
    /// Writes lengths in millimetres.
    pub millimetres: bool,
}

impl Ways {
    /// All ways except the unit of length.
    pub const ALL: Self =
        Self { swaps: true, reverses: true, shuffles: true, turns: true, millimetres: false };
}

/// Wording of a machine in a scene. It determines the order of joints and of their bodies, the length and sense of axes, the rotation of
/// the machine, and the unit of length.
#[derive(Debug, Clone)]
pub struct Wording {
    /// Number of length units in a metre.
    pub metre: f64,
    /// Axes of the rotated machine.
    axes: [Vector; 3],
    /// Joints: the name, whether the bodies are swapped, and the length of the axis.
    joints: Vec<(&'static str, bool, f64)>,
}

impl Wording {
    /// Creates a random wording of a machine with the given differences.
    pub fn new(random: &mut Random, machine: &Machine, ways: Ways) -> Self {
        let unit = |a: Vector| plus([0.0; 3], 1.0 / dot(a, a).sqrt(), a);
        let mut any = || [0; 3].map(|_| random.next());
        let (first, second) = (unit(any()), any());
        let second = unit(plus(second, -dot(second, first), first));
        let turned = [first, second, cross(first, second)];
        let axes = if ways.turns { turned } else { [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], Z] };
        let mut joints: Vec<_> = machine
            .joints
            .iter()
            .map(|joint| {
                let (swap, size) = (random.next() > 0.0, 2.0 * random.next());
                let size = if ways.reverses { size } else { 1.0 };
                (joint.name, ways.swaps && swap, size)
            })
            .collect();
        if ways.shuffles {
            for i in (1..joints.len()).rev() {
                joints.swap(i, random.below(i + 1));
            }
        }
        Self { metre: if ways.millimetres { 1000.0 } else { 1.0 }, axes, joints }
    }

    /// Rotates a direction into the axes of the wording.
    #[must_use]
    pub fn turned(&self, a: Vector) -> Vector {
        (0..3).fold([0.0; 3], |sum, i| plus(sum, a[i], self.axes[i]))
    }

    /// Converts a point to the axes and the unit of the wording.
    #[must_use]
    pub fn place(&self, at: Vector) -> Vector {
        self.turned(at).map(|x| x * self.metre)
    }

    /// Converts a direction from the axes of the wording to those of the machine.
    #[must_use]
    pub fn back(&self, a: Vector) -> Vector {
        self.axes.map(|axis| dot(axis, a))
    }

    /// Returns the sign of a joint's coordinate relative to that of the machine's definition.
    ///
    /// # Panics
    /// If there is no such joint.
    #[must_use]
    pub fn sense(&self, joint: &str) -> f64 {
        let (_, swap, size) = self.joints.iter().find(|(of, ..)| *of == joint).expect("a joint");
        if *swap == (*size > 0.0) { -1.0 } else { 1.0 }
    }

    /// Returns the text of the joints in the order of the wording, each with its second body. `body` writes a body, given its name and the
    /// joint's point.
    ///
    /// # Panics
    /// Never: the wording has the joints of its machine.
    #[must_use]
    pub fn parts(&self, machine: &Machine, body: impl Fn(&str, Vector) -> String) -> String {
        let (mut bodies, mut joints) = (String::new(), String::new());
        for &(name, swap, size) in &self.joints {
            let of = |joint: &&Drawn| joint.name == name;
            let joint = machine.joints.iter().find(of).expect("a joint of the machine");
            bodies += &body(joint.bodies[1], joint.at);
            let [mut a, mut b] = joint.bodies;
            if swap {
                (a, b) = (b, a);
            }
            let kind = if joint.is_turn { "revolute" } else { "prismatic" };
            joints += &format!(
                "[[joint]]\nname = \"{name}\"\nkind = \"{kind}\"\nbodies = [\"{a}\", \"{b}\"]\nat = {:?}\naxis = {:?}\n",
                self.place(joint.at),
                self.turned(plus([0.0; 3], size, joint.axis)),
            );
        }
        format!("{bodies}{joints}{}\n", (machine.coupling)(self))
    }

    /// Returns a scene with masses, gravity, springs, a controlled motor and initial velocities. Every wording gives the same motion for
    /// the same seed.
    #[must_use]
    pub fn moving(&self, machine: &Machine, seed: u64) -> String {
        let outputs = machine.joints.iter().map(|joint| {
            let body = joint.bodies[1];
            ["position", "angular-velocity"].map(|quantity| {
                format!("[[output]]\nname = \"{body} {quantity}\"\nbody = \"{body}\"\nquantity = \"{quantity}\"\n")
            })
        });
        self.moving_with(machine, seed, &outputs.flatten().collect::<String>())
    }

    /// Returns the scene of [`Self::moving`] with other outputs.
    #[must_use]
    pub fn moving_with(&self, machine: &Machine, seed: u64, outputs: &str) -> String {
        let m = self.metre;
        let body = |name: &str, at: Vector| self.body(name, at, seed);
        let parts = self.parts(machine, body);
        let (damping, sense) = (0.3 * m * m, self.sense("one"));
        let gravity = self.place([0.7, -9.0, 2.0]);
        let [from, to] = [[1.0, 2.0, 0.5], [0.2, 1.1, 0.1]];
        let free = 0.8 * dot(plus(from, -1.0, to), plus(from, -1.0, to)).sqrt() * m;
        let rates = [("base", 0.4 * m), ("swing", 0.7), ("one", 3.0)].map(|(joint, rate)| {
            let (value, rate) = (0.0, rate * self.sense(joint));
            format!("[[initial]]\njoint = \"{joint}\"\nvalue = {value:?}\nrate = {rate:?}\n")
        });
        format!(
            "[scene]\ndimension = 3\nduration = 0.2\ngravity = {gravity:?}\n{parts}{}\
             [[effect]]\nkind = \"torsion-spring\"\njoint = \"swing\"\nstiffness = {:?}\ndamping = {damping:?}\n\
             [[effect]]\nkind = \"spring-damper\"\nbodies = [\"ground\", \"frame\"]\npoints = [{:?}, {:?}]\nstiffness = 40.0\n\
             free_length = {free:?}\n\
             [[signal]]\nname = \"turn\"\nkind = \"measure\"\njoint = \"one\"\n\
             [[signal]]\nname = \"wanted\"\nkind = \"constant\"\nvalue = {:?}\n\
             [[signal]]\nname = \"asked\"\nkind = \"pid\"\ntarget = \"wanted\"\nmeasured = \"turn\"\np = {:?}\ni = {:?}\nd = {:?}\n\
             [[effect]]\nkind = \"torque\"\njoint = \"one\"\nsignal = \"asked\"\n{outputs}",
            rates.concat(),
            30.0 * m * m,
            self.place(from),
            self.place(to),
            0.4 * sense,
            6.0 * m * m,
            2.0 * m * m,
            0.2 * m * m,
        )
    }

    /// Returns the text of a body near a point. The mass and the axes of inertia depend on the name and the seed.
    fn body(&self, name: &str, at: Vector, seed: u64) -> String {
        let sum = name.bytes().fold(seed, |sum, byte| sum.wrapping_mul(31) + u64::from(byte));
        let mut random = Random::new(sum);
        let mass = 1.5 + random.next();
        let center = plus(at, 0.3, [0; 3].map(|_| random.next()));
        let [a, b, c] =
            [0; 3].map(|_| mass * (0.06 + 0.02 * random.next()) * self.metre * self.metre);
        // principal moments about the axes of the machine
        let entry = |i: usize, j: usize| {
            let products = self.axes.map(|axis| axis[i] * axis[j]);
            a * products[0] + b * products[1] + c * products[2]
        };
        let [xx, yy, zz] = [0, 1, 2].map(|i| entry(i, i));
        format!(
            "[[body]]\nname = \"{name}\"\nmass = {mass:?}\ncenter = {:?}\ninertia = {:?}\n",
            self.place(center),
            [xx, yy, zz, entry(0, 1), entry(1, 2), entry(2, 0)]
        )
    }
}

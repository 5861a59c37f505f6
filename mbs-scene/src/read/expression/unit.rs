//! Units that may follow a number, and their dimensions.

use mbs_core::real::DoubleDouble;

/// Powers of metre, kilogram and second. A radian has no dimension.
pub(crate) type Dimensions = [i32; 3];

const NONE: Dimensions = [0, 0, 0];
const LENGTH: Dimensions = [1, 0, 0];
const MASS: Dimensions = [0, 1, 0];
const TIME: Dimensions = [0, 0, 1];
const RATE: Dimensions = [0, 0, -1];
const FORCE: Dimensions = [1, 1, -2];
const WORK: Dimensions = [2, 1, -2];
const POWER: Dimensions = [2, 1, -3];
const PRESSURE: Dimensions = [-1, 1, -2];

/// A unit: its name, its factor to SI units as numerator and denominator, whether that factor includes pi, and its dimensions.
#[derive(Debug)]
pub(crate) struct Unit(&'static str, f64, f64, bool, Dimensions);

/// All units of expressions. Factors are quotients of whole numbers, so that `9 mm` is the number nearest to 0.009.
static UNITS: [Unit; 31] = [
    Unit("m", 1.0, 1.0, false, LENGTH),
    Unit("mm", 1.0, 1e3, false, LENGTH),
    Unit("cm", 1.0, 1e2, false, LENGTH),
    Unit("um", 1.0, 1e6, false, LENGTH),
    Unit("km", 1e3, 1.0, false, LENGTH),
    Unit("in", 254.0, 1e4, false, LENGTH),
    Unit("kg", 1.0, 1.0, false, MASS),
    Unit("g", 1.0, 1e3, false, MASS),
    Unit("mg", 1.0, 1e6, false, MASS),
    Unit("t", 1e3, 1.0, false, MASS),
    Unit("s", 1.0, 1.0, false, TIME),
    Unit("ms", 1.0, 1e3, false, TIME),
    Unit("us", 1.0, 1e6, false, TIME),
    Unit("min", 60.0, 1.0, false, TIME),
    Unit("h", 3600.0, 1.0, false, TIME),
    Unit("N", 1.0, 1.0, false, FORCE),
    Unit("kN", 1e3, 1.0, false, FORCE),
    Unit("MN", 1e6, 1.0, false, FORCE),
    Unit("J", 1.0, 1.0, false, WORK),
    Unit("kJ", 1e3, 1.0, false, WORK),
    Unit("W", 1.0, 1.0, false, POWER),
    Unit("kW", 1e3, 1.0, false, POWER),
    Unit("rad", 1.0, 1.0, false, NONE),
    Unit("deg", 1.0, 180.0, true, NONE),
    Unit("rpm", 1.0, 30.0, true, RATE),
    Unit("Hz", 1.0, 1.0, false, RATE),
    Unit("Pa", 1.0, 1.0, false, PRESSURE),
    Unit("kPa", 1e3, 1.0, false, PRESSURE),
    Unit("MPa", 1e6, 1.0, false, PRESSURE),
    Unit("bar", 1e5, 1.0, false, PRESSURE),
    Unit("GPa", 1e9, 1.0, false, PRESSURE),
];

/// The unit with this name.
pub(crate) fn of_name(name: &str) -> Option<&'static Unit> {
    UNITS.iter().find(|unit| unit.0 == name)
}

/// A product of powers of units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Product {
    /// Numerator and denominator of the factor to SI units.
    factor: [DoubleDouble; 2],
    pub(crate) dimensions: Dimensions,
}

impl Product {
    pub(crate) const ONE: Self =
        Self { factor: [DoubleDouble::ONE, DoubleDouble::ONE], dimensions: NONE };

    /// The product multiplied by a power of a unit.
    pub(crate) fn times(mut self, unit: &Unit, power: i32) -> Self {
        let [up, down] = if power < 0 { [1, 0] } else { [0, 1] };
        let pi = if unit.3 { DoubleDouble::PI } else { DoubleDouble::ONE };
        for _ in 0..power.unsigned_abs() {
            self.factor[up] = self.factor[up] * DoubleDouble::from_f64(unit.1) * pi;
            self.factor[down] *= DoubleDouble::from_f64(unit.2);
        }
        for (sum, own) in self.dimensions.iter_mut().zip(unit.4) {
            *sum += own * power;
        }
        self
    }

    /// Converts a number in this unit to SI units.
    pub(crate) fn of(self, number: DoubleDouble) -> DoubleDouble {
        number * self.factor[0] / self.factor[1]
    }
}

/// The dimensions of a key's unit, for each alternative of `or` in it. The list is empty when the key allows any unit.
pub fn of_key(unit: &str) -> Vec<Dimensions> {
    let ways = unit.split(" or ").map(|way| {
        let mut product = Product::ONE;
        let mut power = 1;
        for word in way.split_inclusive([' ', '/']) {
            let name = word.trim_end_matches([' ', '/']);
            let (name, exponent) = name.split_once('^').unwrap_or((name, "1"));
            if name != "1" {
                let exponent: i32 = exponent.parse().ok()?;
                product = product.times(of_name(name)?, power * exponent);
            }
            power = if word.ends_with('/') { -1 } else { power };
        }
        Some(product.dimensions)
    });
    ways.collect::<Option<Vec<_>>>().unwrap_or_default()
}

/// Description of the quantity that has these dimensions.
pub(crate) fn described(dimensions: Dimensions) -> String {
    let known = [
        (LENGTH, "a length"),
        (MASS, "a mass"),
        (TIME, "a time"),
        (FORCE, "a force"),
        (WORK, "a moment or an energy"),
        (RATE, "a rate"),
        (NONE, "a plain number or an angle"),
        ([1, 0, -1], "a speed"),
        ([1, 0, -2], "an acceleration"),
        ([0, 1, -2], "a stiffness"),
        ([2, 1, 0], "an inertia"),
        (POWER, "a power"),
        (PRESSURE, "a pressure"),
    ];
    let known = known.iter().find(|(own, _)| *own == dimensions);
    known.map_or_else(
        || {
            let powers = ["m", "kg", "s"].iter().zip(dimensions).filter(|(_, power)| *power != 0);
            let powers: Vec<_> = powers.map(|(name, power)| format!("{name}^{power}")).collect();
            format!("in {}", powers.join(" "))
        },
        |(_, name)| (*name).to_owned(),
    )
}

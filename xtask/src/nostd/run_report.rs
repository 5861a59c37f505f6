//! Report of a run of the firmware.

/// Kind of a coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Unit {
    /// Coordinate that is a displacement [m].
    Way,
    /// Coordinate that is an angle [rad].
    Angle,
    /// One of the four components of a quaternion.
    Turn,
}

/// How far two runs are apart: the largest differences of a way [m] and of an angle [rad].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Apart {
    pub(super) way: f64,
    pub(super) angle: f64,
}

impl Apart {
    /// True if both differences are within these limits. A difference that is NaN is not.
    pub(super) fn is_within(self, [way, angle]: [f64; 2]) -> bool {
        self.way <= way && self.angle <= angle
    }
}

impl std::fmt::Display for Apart {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.2} mm and {:.3} mrad", self.way * 1e3, self.angle * 1e3)
    }
}

/// Lines and figures that a run reports.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct RunReport {
    /// Lines with states, as the run prints them.
    pub(super) lines: Vec<String>,
    /// Least and largest number of instructions of a step.
    pub(super) least: u64,
    pub(super) most: u64,
    /// Sizes of the used stack and of the solver, in bytes.
    pub(super) stack: u64,
    pub(super) solver: u64,
    /// Number of instructions that one more evaluation adds to a step.
    pub(super) evaluation: u64,
    /// Largest number of instructions of a step by the formula. Only the host reports it, and the kinds of the coordinates.
    pub(super) bound: u64,
    units: Vec<Unit>,
    is_single: bool,
}

impl RunReport {
    /// Reads the report from the text that a run prints.
    ///
    /// # Errors
    ///
    /// A line of an unknown kind, or a text without states.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let mut report = Self { is_single: true, ..Self::default() };
        for line in text.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            let number = |i: usize| words.get(i).and_then(|w| w.parse::<u64>().ok());
            match words.first() {
                Some(&("s" | "v")) => {
                    report.is_single &= words[2..].iter().all(|bits| bits.len() <= 8);
                    report.lines.push(line.to_owned());
                }
                Some(&"n") => {
                    (report.least, report.most) = (number(1).unwrap_or(0), number(3).unwrap_or(0));
                }
                Some(&"m") => report.stack = number(1).unwrap_or(0),
                Some(&"z") => report.solver = number(1).unwrap_or(0),
                Some(&"b") => report.bound = number(1).unwrap_or(0),
                Some(&"e") => report.evaluation = number(1).unwrap_or(0),
                Some(&"u") => report.units = words[1..].iter().filter_map(|w| unit(w)).collect(),
                Some(&"r") | None => {}
                Some(_) => return Err(format!("the run printed: {line}")),
            }
        }
        if report.lines.is_empty() {
            Err("the run printed no states".to_owned())
        } else {
            Ok(report)
        }
    }

    /// Largest differences from another run, which must have reported the kinds of its coordinates.
    ///
    /// # Errors
    ///
    /// The runs have different lengths or different coordinates.
    pub(super) fn apart(&self, other: &Self) -> Result<Apart, String> {
        if self.lines.len() != other.lines.len() {
            return Err("the runs have different lengths".to_owned());
        }
        let mut apart = Apart::default();
        for (line, partner) in self.lines.iter().zip(&other.lines) {
            if line.starts_with('s') {
                let (x, y) = (self.numbers(line), other.numbers(partner));
                if x.len() != other.units.len() || y.len() != x.len() {
                    return Err("the runs have different coordinates".to_owned());
                }
                let differences: Vec<f64> = x.iter().zip(&y).map(|(x, y)| x - y).collect();
                apart.widen(&differences, &other.units);
            }
        }
        Ok(apart)
    }

    fn numbers(&self, line: &str) -> Vec<f64> {
        let of = |bits: &str| {
            if self.is_single {
                u32::from_str_radix(bits, 16).map_or(f64::NAN, |bits| f32::from_bits(bits).into())
            } else {
                u64::from_str_radix(bits, 16).map_or(f64::NAN, f64::from_bits)
            }
        };
        line.split_whitespace().skip(2).map(of).collect()
    }
}

impl Apart {
    /// Includes the differences of one state. The angle between two orientations is approximately twice the distance of their quaternions.
    fn widen(&mut self, mut differences: &[f64], mut units: &[Unit]) {
        while let Some(unit) = units.first() {
            let n = if *unit == Unit::Turn { 4.min(units.len()) } else { 1 };
            let (own, rest) = differences.split_at(n);
            let size = own.iter().map(|x| x * x).sum::<f64>().sqrt();
            let (largest, size) = match unit {
                Unit::Way => (&mut self.way, size),
                Unit::Angle => (&mut self.angle, size),
                Unit::Turn => (&mut self.angle, 2.0 * size),
            };
            // a NaN is never replaced
            if size > *largest || size.is_nan() {
                *largest = size;
            }
            (differences, units) = (rest, &units[n..]);
        }
    }
}

fn unit(word: &str) -> Option<Unit> {
    match word {
        "m" => Some(Unit::Way),
        "r" => Some(Unit::Angle),
        "q" => Some(Unit::Turn),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::RunReport;

    #[test]
    fn bits_of_both_precisions_are_compared_as_ways_and_angles() {
        let single = RunReport::read("s 100 3f800000 0\nv 100 0\nn 10 20 30\nm 7\nz 5\ne 4\n");
        let single = single.expect("a run");
        let text = "s 100 3ff8000000000000 3fd0000000000000\nv 100 0\nb 9\nu m r\n";
        let double = RunReport::read(text).expect("a run");
        assert_eq!((single.least, single.most, single.stack, double.bound), (10, 30, 7, 9));
        assert_eq!(single.evaluation, 4);
        let apart = single.apart(&double).expect("one length");
        assert_eq!((apart.way, apart.angle), (0.5, 0.25));
        assert!(apart.is_within([0.5, 0.25]) && !apart.is_within([0.5, 0.2]));
        assert!(RunReport::read("step 3: singular\n").is_err());
        assert!(single.apart(&single).is_err(), "it has no units");
    }

    #[test]
    fn the_angle_of_two_turns_is_twice_the_distance_of_their_quaternions() {
        // the quaternions (1, 0, 0, 0) and (1, 0.001, 0, 0) differ by an angle of two milliradians
        let text = |x: f64| {
            let bits = [1.0, x, 0.0, 0.0, 0.3].map(|x: f64| format!("{:x}", x.to_bits())).join(" ");
            RunReport::read(&format!("s 100 {bits}\nu q q q q m\n")).expect("a run")
        };
        let apart = text(1e-3).apart(&text(0.0)).expect("one length");
        assert!((apart.angle - 2e-3).abs() < 1e-15 && apart.way == 0.0, "{apart}");
    }

    #[test]
    fn a_difference_that_is_no_number_is_within_nothing() {
        let nan = RunReport::read("s 100 7fc00000\n").expect("a run");
        let double = RunReport::read("s 100 0\nu r\n").expect("a run");
        assert!(!nan.apart(&double).expect("one length").is_within([1.0, 1.0]));
    }
}

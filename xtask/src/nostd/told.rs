//! What a run of the firmware told.

/// Lines and figures.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Told {
    /// Lines of states, as they stand.
    pub(super) lines: Vec<String>,
    /// Least and most instructions of a step.
    pub(super) least: u64,
    pub(super) most: u64,
    /// Bytes of stack, and of the solver.
    pub(super) stack: u64,
    pub(super) solver: u64,
    /// Instructions of a step that the formula allows; told on the host alone.
    pub(super) bound: u64,
    is_single: bool,
}

impl Told {
    /// Reads it.
    ///
    /// # Errors
    ///
    /// A line that is not one.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let mut told = Self { is_single: true, ..Self::default() };
        for line in text.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            let number = |i: usize| words.get(i).and_then(|w| w.parse::<u64>().ok());
            match words.first() {
                Some(&("s" | "v")) => {
                    told.is_single &= words[2..].iter().all(|bits| bits.len() <= 8);
                    told.lines.push(line.to_owned());
                }
                Some(&"n") => {
                    (told.least, told.most) = (number(1).unwrap_or(0), number(3).unwrap_or(0));
                }
                Some(&"m") => told.stack = number(1).unwrap_or(0),
                Some(&"z") => told.solver = number(1).unwrap_or(0),
                Some(&"b") => told.bound = number(1).unwrap_or(0),
                Some(&"r") | None => {}
                Some(_) => return Err(format!("the run told: {line}")),
            }
        }
        if told.lines.is_empty() { Err("the run told no states".to_owned()) } else { Ok(told) }
    }

    /// The largest difference of a coordinate from another run's [m or rad].
    ///
    /// # Errors
    ///
    /// Runs of other lengths.
    pub(super) fn apart(&self, other: &Self) -> Result<f64, String> {
        if self.lines.len() != other.lines.len() {
            return Err("the runs have different lengths".to_owned());
        }
        let mut largest = 0.0_f64;
        for (line, partner) in self.lines.iter().zip(&other.lines) {
            if line.starts_with('s') {
                let (x, y) = (self.numbers(line), other.numbers(partner));
                for (x, y) in x.iter().zip(&y) {
                    largest = if (x - y).abs() <= largest { largest } else { (x - y).abs() };
                }
            }
        }
        Ok(largest)
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

#[cfg(test)]
mod tests {
    use super::Told;

    #[test]
    fn bits_of_both_precisions_are_compared_as_numbers() {
        let single = Told::read("s 100 3f800000 0\nv 100 0\nn 10 20 30\nm 7\nz 5\n");
        let single = single.expect("a run");
        let double = Told::read("s 100 3ff8000000000000 0\nv 100 0\nb 9\n").expect("a run");
        assert_eq!((single.least, single.most, single.stack, double.bound), (10, 30, 7, 9));
        assert!((single.apart(&double).expect("one length") - 0.5).abs() < 1e-15);
        assert!(Told::read("step 3: singular\n").is_err());
    }
}

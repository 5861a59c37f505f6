//! Comparison of outputs in documents with those of the command: words must be equal, and numbers must agree to the digits shown.

/// Words in a line whose numbers depend on the machine: CPU times and ratios of them.
const OF_THE_MACHINE: [&str; 2] = ["CPU time", "real time"];

/// Largest difference of two numbers in units of the last digit shown, since both were rounded.
const LAST_DIGIT: f64 = 1.01;

/// Numbers smaller than this count as rounding errors of zero; only their size is compared.
const ROUNDING: f64 = 1e-9;

/// Finds each line of a document in the output, in order. A line `...` stands for any number of lines.
pub(super) fn shown(shown: &str, printed: &str) -> Result<(), String> {
    let mut rest = printed.lines();
    for line in shown.lines().filter(|line| !line.trim().is_empty() && line.trim() != "...") {
        if !rest.any(|found| agree(line, found)) {
            return Err(format!(
                "this line is not in the output, or not in this order:\n{line}\nThe output:\n{printed}"
            ));
        }
    }
    Ok(())
}

fn agree(shown: &str, found: &str) -> bool {
    let is_timed = |line: &str| OF_THE_MACHINE.iter().any(|word| line.contains(word));
    if is_timed(shown) && is_timed(found) {
        return true;
    }
    let is_gap = |c: char| c.is_whitespace() || c == ',';
    let words = |line| str::split(line, is_gap).filter(|word| !word.is_empty()).collect::<Vec<_>>();
    let [shown, found] = [shown, found].map(words);
    shown.len() == found.len() && shown.iter().zip(&found).all(|(a, b)| a == b || near(a, b))
}

/// True if two words are the same number, to the digits of the first.
fn near(shown: &str, found: &str) -> bool {
    let plain = |word: &str| word.trim_matches(['(', ')', ',', ';', ':', '%', '.']).to_owned();
    let [a, b] = [shown, found].map(plain);
    let ([Ok(x), Ok(y)], true) = ([a.parse::<f64>(), b.parse::<f64>()], a.len() < 25) else {
        return false;
    };
    let (mantissa, power) = a.split_once('e').unwrap_or((&a, "0"));
    let places = mantissa.split_once('.').map_or(0, |(_, places)| places.len());
    let unit = 10f64.powi(power.parse::<i32>().unwrap_or(0) - i32::try_from(places).unwrap_or(0));
    let is_rounding = x.abs() < ROUNDING && y.abs() < 10.0 * ROUNDING && mantissa.len() < 12;
    (x - y).abs() <= LAST_DIGIT * unit || (is_rounding && x != 0.0)
}

#[test]
fn numbers_agree_to_the_digits_shown_and_not_beyond() {
    for (a, b) in [
        ("peak 20.22 N", "peak 20.2206 N"),
        ("(1.5e-3)", "(1.45e-3)"),
        ("0.35,-0.1027", "0.35,-0.10268"),
        ("residual 2e-13", "residual 9e-14"),
        ("CPU time of the steps 3 ms", "CPU time of the steps 9 ms"),
    ] {
        assert!(agree(a, b), "{a} | {b}");
    }
    for (a, b) in
        [("peak 20.22 N", "peak 20.24 N"), ("1.5e-3", "1.5e-2"), ("a 1", "b 1"), ("1 m", "1 m s")]
    {
        assert!(!agree(a, b), "{a} | {b}");
    }
    let printed = "head\n a 1.25\n b 2\n c 3\n";
    assert!(shown("a 1.2\n...\nc 3\n", printed).is_ok());
    assert!(shown("c 3\na 1.25\n", printed).is_err());
}

//! Evaluation of an expression, with units and names.

use super::unit::{self, Dimensions, Product};
use core::ops::Range;
use mbs_core::Real;
use mbs_core::real::DoubleDouble;

/// Largest depth of brackets and signs within each other [-]. A deeper expression is a mistake or an attack. Chosen, not tuned.
const MAX_DEPTH: usize = 64;
/// Largest whole exponent [-]. Chosen, not tuned.
const MAX_POWER: i32 = 64;
/// Names of the functions: first those of one number, then those of two.
const FUNCTIONS: [&str; 8] = ["sqrt", "sin", "cos", "tan", "abs", "atan2", "min", "max"];
/// Number of functions that have one argument.
const N_UNARY: usize = 5;

/// Error of an expression, with its place in the text.
#[derive(Debug, Clone, PartialEq)]
pub struct EvaluationFault {
    /// Message that says what is wrong.
    pub message: String,
    /// Hint that says what to do.
    pub hint: String,
    /// Bytes of the text to which the message refers.
    pub span: Range<usize>,
}

/// Value of an expression. A text that is only a number with a unit also has its dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evaluated {
    /// The value, in SI units.
    pub value: DoubleDouble,
    /// Powers of length, mass and time; `None` for any other expression.
    pub dimensions: Option<Dimensions>,
}

/// True if the name is a constant, a function or a unit of expressions. No parameter may have such a name.
pub(crate) fn is_reserved(name: &str) -> bool {
    name == "pi" || FUNCTIONS.contains(&name) || unit::of_name(name).is_some()
}

/// The value of the expression `text`. `named` returns the value of a name, or the message and hint of an error.
///
/// # Errors
/// [`EvaluationFault`] at the first place that is not part of an expression, or whose value is not finite.
pub fn evaluate(
    text: &str,
    named: &mut dyn FnMut(&str) -> Result<DoubleDouble, [String; 2]>,
) -> Result<Evaluated, EvaluationFault> {
    let mut reader = Reader { text, at: 0, depth: 0, named };
    let value = reader.sum()?;
    reader.blank();
    if reader.at < text.len() {
        return Err(reader.unexpected());
    }
    if !value.is_finite() {
        return Err(fault("the value is not finite", "change the numbers", 0..text.len()));
    }
    Ok(Evaluated { value, dimensions: alone(text) })
}

/// The dimensions of a text that is only a number with a unit; `None` for any other text.
fn alone(text: &str) -> Option<Dimensions> {
    let mut named = |_: &str| Err([String::new(), String::new()]);
    let mut reader = Reader { text: text.trim(), at: 0, depth: 0, named: &mut named };
    reader.take('-');
    reader.decimal()?;
    reader.blank();
    let begin = reader.at;
    let product = reader.unit()?;
    (reader.at == reader.text.len() && reader.at > begin).then_some(product.dimensions)
}

fn fault(message: &str, hint: &str, span: Range<usize>) -> EvaluationFault {
    EvaluationFault { message: message.to_owned(), hint: hint.to_owned(), span }
}

/// Reader of an expression, with the present byte in its text.
struct Reader<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
    named: &'a mut dyn FnMut(&str) -> Result<DoubleDouble, [String; 2]>,
}

type Read<T> = Result<T, EvaluationFault>;

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn blank(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start().len();
    }

    /// Skips blanks, then reads the given sign; returns `true` when the sign was there.
    fn take(&mut self, sign: char) -> bool {
        let before = self.at;
        self.blank();
        let has = self.rest().starts_with(sign);
        self.at = if has { self.at + sign.len_utf8() } else { before };
        has
    }

    fn unexpected(&self) -> EvaluationFault {
        let rest = self.rest().trim_start();
        let start = self.text.len() - rest.len();
        let n = rest.chars().next().map_or(0, char::len_utf8);
        match n {
            0 => fault(
                "the expression ends too early",
                "write the number that is missing",
                start..start,
            ),
            _ => fault(
                &format!("`{}` cannot stand here", &rest[..n]),
                "a number, a name, `+ - * / ^` and brackets make an expression",
                start..start + n,
            ),
        }
    }

    fn sum(&mut self) -> Read<DoubleDouble> {
        let mut sum = self.product()?;
        loop {
            if self.take('+') {
                sum += self.product()?;
            } else if self.take('-') {
                sum -= self.product()?;
            } else {
                return Ok(sum);
            }
        }
    }

    fn product(&mut self) -> Read<DoubleDouble> {
        let mut product = self.signed()?;
        loop {
            if self.take('*') {
                product *= self.signed()?;
            } else if self.take('/') {
                let start = self.at;
                let under = self.signed()?;
                if under == DoubleDouble::ZERO {
                    return Err(fault(
                        "division by zero",
                        "divide by another number",
                        start..self.at,
                    ));
                }
                product /= under;
            } else {
                return Ok(product);
            }
        }
    }

    fn signed(&mut self) -> Read<DoubleDouble> {
        if !self.take('-') {
            return self.power();
        }
        self.deeper(|reader| Ok(-reader.signed()?))
    }

    fn deeper<T>(&mut self, read: impl FnOnce(&mut Self) -> Read<T>) -> Read<T> {
        if self.depth == MAX_DEPTH {
            let hint = "name a part of it in [parameters]";
            return Err(fault(
                "more than 64 brackets or signs within each other",
                hint,
                self.at..self.at,
            ));
        }
        self.depth += 1;
        let read = read(self);
        self.depth -= 1;
        read
    }

    fn power(&mut self) -> Read<DoubleDouble> {
        let base = self.atom()?;
        if !self.take('^') {
            return Ok(base);
        }
        self.blank();
        let start = self.at;
        let power = self.whole();
        let Some(power) = power.filter(|power| power.abs() <= MAX_POWER) else {
            let hint = "write a whole number up to 64";
            return Err(fault("an exponent is a whole number", hint, start..start + 1));
        };
        let product = (0..power.abs()).fold(DoubleDouble::ONE, |product, _| product * base);
        if power < 0 && product == DoubleDouble::ZERO {
            return Err(fault("division by zero", "divide by another number", start..self.at));
        }
        Ok(if power < 0 { DoubleDouble::ONE / product } else { product })
    }

    /// Reads a whole number with its sign.
    fn whole(&mut self) -> Option<i32> {
        let rest = self.rest();
        let digits = rest.strip_prefix('-').unwrap_or(rest);
        let n = digits.bytes().take_while(u8::is_ascii_digit).count();
        let end = rest.len() - digits.len() + n;
        let whole = rest[..end].parse().ok()?;
        self.at += end;
        Some(whole)
    }

    fn atom(&mut self) -> Read<DoubleDouble> {
        self.blank();
        let start = self.at;
        if self.take('(') {
            let value = self.deeper(Self::sum)?;
            return self.closed(start).map(|()| value);
        }
        if let Some(number) = self.decimal() {
            return self.with_unit(number);
        }
        let Some(name) = self.name() else { return Err(self.unexpected()) };
        if self.axis() {
            let (name, span) = (&self.text[start..self.at], start..self.at);
            return (self.named)(name).map_err(|[message, hint]| EvaluationFault {
                message,
                hint,
                span,
            });
        }
        let span = start..self.at;
        if name == "pi" {
            return Ok(DoubleDouble::PI);
        }
        if let Some(i) = FUNCTIONS.iter().position(|function| *function == name) {
            return self.function(i, span);
        }
        if unit::of_name(name).is_some() {
            let hint = format!("write a number before it, such as `1 {name}`");
            return Err(fault(&format!("`{name}` is a unit"), &hint, span));
        }
        (self.named)(name).map_err(|[message, hint]| EvaluationFault { message, hint, span })
    }

    fn closed(&mut self, start: usize) -> Read<()> {
        if self.take(')') {
            return Ok(());
        }
        if self.rest().trim().is_empty() {
            return Err(fault("a bracket is not closed", "add `)`", start..start + 1));
        }
        Err(self.unexpected())
    }

    /// Evaluates a function of one number or of two.
    fn function(&mut self, i: usize, span: Range<usize>) -> Read<DoubleDouble> {
        let name = FUNCTIONS[i];
        let open = self.at;
        if !self.take('(') {
            let hint = format!("write `{name}(...)`");
            return Err(fault(&format!("`{name}` is a function"), &hint, span));
        }
        let first = self.deeper(Self::sum)?;
        if i < N_UNARY {
            self.closed(open)?;
            let (sine, cosine) = first.sin_cos();
            return match name {
                "sqrt" if first < DoubleDouble::ZERO => Err(fault(
                    "the root of a negative number",
                    "change the number",
                    span.start..self.at,
                )),
                "sqrt" => Ok(first.sqrt()),
                "sin" => Ok(sine),
                "cos" => Ok(cosine),
                "tan" => Ok(sine / cosine),
                _ => Ok(Real::abs(first)),
            };
        }
        if !self.take(',') {
            let hint = format!("write `{name}(a, b)`");
            return Err(fault(&format!("`{name}` takes two numbers"), &hint, span));
        }
        let second = self.deeper(Self::sum)?;
        self.closed(open)?;
        Ok(match name {
            "atan2" => first.atan2(second),
            "min" => Real::min(first, second),
            _ => Real::max(first, second),
        })
    }

    /// Reads the axis after the name of a point: `.x`, `.y` or `.z`.
    fn axis(&mut self) -> bool {
        let rest = self.rest().as_bytes();
        let is_name = |c: &u8| c.is_ascii_alphanumeric() || *c == b'_';
        let has =
            matches!(rest, [b'.', b'x' | b'y' | b'z', ..]) && !rest.get(2).is_some_and(is_name);
        self.at += if has { 2 } else { 0 };
        has
    }

    fn name(&mut self) -> Option<&'a str> {
        let rest = self.rest();
        let first = rest.chars().next()?;
        if !(first.is_alphabetic() || first == '_') {
            return None;
        }
        let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
        self.at += end;
        Some(&rest[..end])
    }

    /// Reads a decimal number in the notation of scene files.
    fn decimal(&mut self) -> Option<DoubleDouble> {
        let bytes = self.rest().as_bytes();
        let digits = |from: usize| bytes[from..].iter().take_while(|c| c.is_ascii_digit()).count();
        let mut end = digits(0);
        if end == 0 {
            return None;
        }
        if bytes.get(end) == Some(&b'.') && digits(end + 1) > 0 {
            end += 1 + digits(end + 1);
        }
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
            let n = digits((end + 1 + sign).min(bytes.len()));
            end += if n > 0 { 1 + sign + n } else { 0 };
        }
        let number = DoubleDouble::from_decimal(&self.rest()[..end])?;
        self.at += end;
        Some(number)
    }

    /// Reads the unit after a number, if there is one, and converts the number to SI units.
    fn with_unit(&mut self, number: DoubleDouble) -> Read<DoubleDouble> {
        let behind = self.at;
        self.blank();
        let start = self.at;
        if let Some(product) = self.unit() {
            return Ok(product.of(number));
        }
        if let Some(name) = self.name() {
            let before = self.text[..behind].trim();
            let message = format!("`{name}` is no unit");
            let hint = format!("to multiply, write `{before}*{name}`");
            return Err(fault(&message, &hint, start..self.at));
        }
        self.at = behind;
        Ok(number)
    }

    /// Reads a product of units; `None` when no unit begins here.
    fn unit(&mut self) -> Option<Product> {
        let mut product = Product::ONE;
        let mut sign = 1;
        let mut is_any = false;
        loop {
            let before = self.at;
            if is_any {
                sign = match self.rest().as_bytes().first() {
                    Some(b'*') => 1,
                    Some(b'/') => -1,
                    _ => return Some(product),
                };
                self.at += 1;
            }
            let Some(unit) = self.name().and_then(unit::of_name) else {
                self.at = before;
                return is_any.then_some(product);
            };
            // The function `min(`, not the unit of minutes.
            if self.rest().starts_with('(') {
                self.at = before;
                return is_any.then_some(product);
            }
            let mut power = 1;
            if self.rest().starts_with('^') {
                self.at += 1;
                match self.whole().filter(|power| power.abs() <= MAX_POWER) {
                    Some(whole) => power = whole,
                    None => {
                        self.at = before;
                        return is_any.then_some(product);
                    }
                }
            }
            product = product.times(unit, sign * power);
            is_any = true;
        }
    }
}

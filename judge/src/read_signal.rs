//! Reads signals of a scene. Each signal is read as a tree of sources.

use crate::names::Names;
use crate::node::{Node, Read, Table, fault};
use crate::read_curve::{by_name, curve, measure};
use crate::scene::{Given, Joint, Signal, Source};

/// Reader of all signals of a scene, which may refer to each other by name.
pub(crate) struct Reader<'a> {
    names: &'a Names,
    joints: &'a [Joint],
    tables: Vec<(String, Table)>,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(tables: Vec<Table>, names: &'a Names, joints: &'a [Joint]) -> Read<Self> {
        let named = tables.into_iter().map(|mut table| Ok((table.text("name")?, table)));
        Ok(Self { names, joints, tables: named.collect::<Read<_>>()? })
    }

    /// Returns the signals in the order of the file.
    pub(crate) fn all(&self) -> Read<Vec<Signal>> {
        let one = |k: usize| {
            let (name, mut table) = self.tables[k].clone();
            let source = self.source(&mut table, k, 0)?;
            let start = match source {
                Source::Lag(..) | Source::Integral(..) => table.number_or("value", 0.0)?,
                _ => 0.0,
            };
            table.done(&name)?;
            Ok(Signal { name, source, start })
        };
        (0..self.tables.len()).map(one).collect()
    }

    fn named(&self, name: &str, depth: usize) -> Read<Source> {
        let Some(k) = self.tables.iter().position(|known| known.0 == name) else {
            return fault(format!("no signal `{name}`"));
        };
        if depth > self.tables.len() {
            return fault("signals in a circle");
        }
        self.source(&mut self.tables[k].1.clone(), k, depth + 1)
    }

    fn one(&self, table: &mut Table, key: &str, depth: usize) -> Read<Box<Source>> {
        Ok(Box::new(self.named(&table.text(key)?, depth)?))
    }

    fn list(&self, table: &mut Table, depth: usize) -> Read<Vec<Source>> {
        let node = table.need("of")?;
        let one = |name: &Node| match name {
            Node::Text(name) => self.named(name, depth),
            other => fault(format!("not a signal: {other:?}")),
        };
        node.list()?.iter().map(one).collect()
    }

    fn source(&self, t: &mut Table, slot: usize, depth: usize) -> Read<Source> {
        let kind = t.text("kind")?;
        if let Some(source) = of_time(&kind, t)? {
            return Ok(source);
        }
        Ok(match kind.as_str() {
            "sum" => {
                let parts = self.list(t, depth)?;
                let factors = match t.take("factors") {
                    Some(node) => node.numbers()?,
                    None => vec![1.0; parts.len()],
                };
                Source::Sum(factors.into_iter().zip(parts).collect())
            }
            "product" => Source::Product(self.list(t, depth)?),
            "curve" => {
                let inner = self.one(t, "of", depth)?;
                let Some(curve) = curve(t)? else { return fault("a curve without rows") };
                Source::Of(curve, inner)
            }
            "clamp" => {
                Source::Clamp(self.one(t, "of", depth)?, [t.number("lower")?, t.number("upper")?])
            }
            "limit-ratio" => {
                let limits = [t.number("lower")?, t.number("upper")?];
                Source::LimitRatio(self.one(t, "of", depth)?, limits)
            }
            "measure" => {
                let is_rate = t.has("quantity") && t.text("quantity")? == "rate";
                Source::Measure(measure(t, self.names, self.joints)?, is_rate)
            }
            "lag" => Source::Lag(slot, self.one(t, "of", depth)?, t.number("time")?),
            "integral" => {
                let inner = self.one(t, "of", depth)?;
                let limits = [t.number_or("lower", f64::MIN)?, t.number_or("upper", f64::MAX)?];
                Source::Integral(slot, inner, limits)
            }
            "pid" => {
                let both = [self.one(t, "target", depth)?, self.one(t, "measured", depth)?];
                let [p, i, d] = ["p", "i", "d"].map(|key| t.number_or(key, 0.0));
                Source::Pid(slot, both, [p?, i?, d?], t.number_or("limit", f64::MAX)?)
            }
            other => return fault(format!("no signal of kind `{other}`")),
        })
    }
}

/// Reads a source that depends on time alone; `None` for other kinds.
fn of_time(kind: &str, t: &mut Table) -> Read<Option<Source>> {
    let wave = |t: &mut Table| -> Read<[f64; 4]> {
        let (phase, offset) = (t.number_or("phase", 0.0)?, t.number_or("offset", 0.0)?);
        Ok([t.number("amplitude")?, t.number("frequency")?, phase, offset])
    };
    Ok(Some(match kind {
        "constant" => Source::Constant(t.number("value")?),
        "input" => {
            t.take("unit");
            Source::Constant(t.number_or("value", 0.0)?)
        }
        "table" => match curve(t)? {
            Some(curve) => Source::Table(curve),
            None => return fault("a table without rows"),
        },
        "sine" => Source::Sine(wave(t)?),
        "chirp" => {
            let [a, f, phase, offset] = wave(t)?;
            let (to, duration) = (t.number("to_frequency")?, t.number("duration")?);
            Source::Chirp([a, f, phase, offset, to, duration])
        }
        "ramp" => {
            let (start, end) = (t.number_or("start", 0.0)?, t.number_or("end", f64::MAX)?);
            Source::Ramp([t.number("rate")?, start, end, t.number_or("rounding", 0.0)?])
        }
        "step" => {
            let (from, to) = (t.number_or("from", 0.0)?, t.number("to")?);
            Source::Step([from, to, t.number_or("at", 0.0)?, t.number_or("rise", 0.0)?])
        }
        _ => return Ok(None),
    }))
}

/// A force over time: `value`, `table` or `signal`; a number, or a vector.
pub(crate) fn given(table: &mut Table, signals: &[Signal], is_vector: bool) -> Read<Given> {
    let is_input = matches!(table.take("input"), Some(Node::Flag(true)));
    let Some(node) = table.take("signal") else {
        let is_constant = table.has("value") && !is_input;
        return Ok(match table.signal(is_vector)?.as_slice() {
            [(_, value)] if is_constant => Given::Constant(*value),
            rows => Given::Rows(rows.to_vec()),
        });
    };
    let mut sources = [None, None, None];
    match &node {
        Node::List(list) => {
            for (to, name) in sources.iter_mut().zip(list) {
                *to = Some(Box::new(by_name(name, signals)?));
            }
        }
        one => sources[0] = Some(Box::new(by_name(one, signals)?)),
    }
    Ok(Given::Named(sources))
}

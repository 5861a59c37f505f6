//! Sweeps: the numbers of a scene that are varied, and their values.

mod fault;
mod parameter;
pub(crate) mod path;
mod reader;
mod refusal;
mod source;
pub(crate) mod values;

pub use fault::SweepFault;
pub use refusal::SweepRefusal;
pub use source::SweepSource;

use crate::format::rounded;
use crate::read::texts::Texts;
use crate::read::tree::Span;
use crate::read::{ReadFault, SceneFile};
use fault::MOST_MEMBERS;
use mbs_core::scene::{Scene, SceneFault};
use parameter::{Combine, Parameter};
use path::Address;
use std::collections::{BTreeMap, BTreeSet};

/// A sweep of a scene: its parameters with their values, and the members that they make. Numbers are decimal text, as in a scene.
#[derive(Debug, Clone)]
pub struct SceneSweep {
    /// Texts that the byte positions of the parameters refer to.
    texts: Texts,
    combine: Combine,
    parameters: Vec<Parameter>,
    places: Vec<PlaceOfScene>,
    n_members: usize,
}

/// A number of the scene that is replaced in the members.
#[derive(Debug, Clone)]
struct PlaceOfScene {
    address: Address,
    /// Value of the number in the scene.
    base: f64,
    set_by: Option<usize>,
    /// Parameters that shift the number, each with the value that the scene has at the parameter's path.
    shifts: Vec<(usize, f64)>,
}

/// Significant digits to which a sum of decimals is rounded [-]. Every decimal text of 15 digits survives the conversion to `f64`.
const DIGITS: usize = 15;

impl SceneSweep {
    /// A sweep applied to a scene. `columns` are the names that parameters must not have.
    ///
    /// # Errors
    /// `SweepRefusal` for an entry of the sweep that is unknown, missing or not valid. It has the place in the file, or the path that
    /// code gave.
    pub fn new(
        source: &SweepSource,
        scene: &SceneFile,
        columns: &[String],
    ) -> Result<Self, SweepRefusal> {
        let (combine, parameters) = source.parameters(scene)?;
        let texts = source.texts();
        let mut sweep = Self { texts, combine, parameters, places: Vec::new(), n_members: 0 };
        sweep.check_names(columns)?;
        sweep.places = sweep.lay_out(scene)?;
        sweep.n_members = sweep.count()?;
        Ok(sweep)
    }

    /// Number of members of the sweep.
    #[must_use]
    pub fn n_members(&self) -> usize {
        self.n_members
    }

    /// The names of the parameters, in the order in which they are given.
    pub fn names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.parameters.iter().map(|parameter| parameter.name.as_str())
    }

    /// The decimal texts of a member's values, in the order of the parameters. Members are numbered from 0.
    pub fn values(&self, member: usize) -> impl ExactSizeIterator<Item = &str> {
        let choice = self.choice(member);
        self.parameters.iter().zip(choice).map(|(p, i)| p.texts[i].as_str())
    }

    /// The scene of a member. Error messages about it refer to places in the scene's file.
    ///
    /// Cost: a copy of the document; nothing is read or parsed again.
    #[must_use]
    pub fn member(&self, scene: &SceneFile, member: usize) -> SceneFile {
        let values: Vec<&str> = self.values(member).collect();
        self.replaced(scene, |p| Some(values[p]))
    }

    /// Tries the values of each parameter in the scene, one at a time. It tries all values of a list. For a range it tries the ends and two
    /// values. It rejects a value that is invalid whatever the other parameters are, such as a negative mass or a count with decimals. `also`
    /// may reject a scene with a message and a hint.
    ///
    /// Cost: the scene is read once for each trial.
    ///
    /// # Errors
    /// [`SweepFault::Refused`] with the place of the value, or with the path that code gave.
    pub fn check(
        &self,
        scene: &SceneFile,
        also: impl Fn(&Scene<f64>) -> Result<(), (String, String)>,
    ) -> Result<(), SweepRefusal> {
        for (p, parameter) in self.parameters.iter().enumerate() {
            let texts = parameter.texts.iter().enumerate();
            let is_list = parameter.ends.is_empty();
            // The first two values of a range show whether all its values are whole numbers.
            let texts = texts.take(if is_list { parameter.texts.len() } else { 2 });
            let own = texts.map(|(i, text)| {
                (text, parameter.value_spans.get(i).unwrap_or(&parameter.value_spans[0]))
            });
            for (text, span) in parameter.ends.iter().map(|(text, span)| (text, span)).chain(own) {
                let trial = self.replaced(scene, |q| (q == p).then_some(text.as_str()));
                let refused = match trial.scene::<f64>() {
                    Ok(scene) => also(&scene).err(),
                    Err(error) if is_final(error.fault()) => {
                        Some((error.fault().to_string(), error.hint()))
                    }
                    Err(_) => None,
                };
                if let Some((problem, advice)) = refused {
                    let (value, name) = (text.clone(), parameter.name.clone());
                    let fault = SweepFault::Refused { value, name, problem, advice };
                    return self.fault(parameter, span, fault);
                }
            }
        }
        Ok(())
    }

    /// True if the sweep changes the number that a path names.
    #[must_use]
    pub fn varies(&self, scene: &SceneFile, path: &str) -> bool {
        let address = path::address(scene, path);
        address.is_ok_and(|address| self.places.iter().any(|place| place.address == address))
    }

    /// The error of a parameter, at a place in the sweep's file or with the path that code gave.
    fn fault<R>(
        &self,
        parameter: &Parameter,
        span: &Span,
        fault: SweepFault,
    ) -> Result<R, SweepRefusal> {
        Err(match parameter.is_in_code {
            true => SweepRefusal::Numbers { path: parameter.name.clone(), fault },
            false => self.texts.error(span, ReadFault::Sweep(fault)).into(),
        })
    }

    /// Index of the value of each parameter in a member.
    fn choice(&self, member: usize) -> Vec<usize> {
        let mut choice = vec![member; self.parameters.len()];
        if self.combine == Combine::Grid {
            let mut rest = member;
            for (i, parameter) in choice.iter_mut().zip(&self.parameters).rev() {
                *i = rest % parameter.texts.len();
                rest /= parameter.texts.len();
            }
        }
        choice
    }

    /// Returns the scene with new numbers. `text` gives the value of a parameter, or `None` for a parameter that does not change.
    fn replaced<'a>(
        &self,
        scene: &SceneFile,
        text: impl Fn(usize) -> Option<&'a str>,
    ) -> SceneFile {
        let mut document = scene.clone();
        for place in &self.places {
            let set = place.set_by.and_then(&text);
            let number = |text: &str| text.parse::<f64>().ok();
            let shifts =
                place.shifts.iter().filter_map(|(p, from)| Some(number(text(*p)?)? - from));
            let shift = shifts.reduce(|a, b| a + b);
            let base = set.and_then(number).unwrap_or(place.base);
            let new = match (set, shift) {
                (_, Some(shift)) => rounded(base + shift, DIGITS).to_string(),
                (Some(set), None) => set.to_owned(),
                (None, None) => continue,
            };
            path::replace(document.root_mut(), &place.address, new);
        }
        document
    }

    fn check_names(&self, columns: &[String]) -> Result<(), SweepRefusal> {
        let mut taken: BTreeSet<&str> = columns.iter().map(String::as_str).collect();
        for parameter in &self.parameters {
            let name = &parameter.name;
            if name.is_empty() || !taken.insert(name) {
                let fault = SweepFault::NameTaken(name.clone());
                return self.fault(parameter, &parameter.span, fault);
            }
        }
        Ok(())
    }

    /// The numbers of the scene that change, each with the parameters that change it.
    fn lay_out(&self, scene: &SceneFile) -> Result<Vec<PlaceOfScene>, SweepRefusal> {
        let mut places: BTreeMap<&Address, PlaceOfScene> = BTreeMap::new();
        let base =
            |address: &Address| scene.number_at(address).map_or(0.0, |number| number.to_f64());
        let blank = |address: &Address| PlaceOfScene {
            address: address.clone(),
            base: base(address),
            set_by: None,
            shifts: Vec::new(),
        };
        for (p, parameter) in self.parameters.iter().enumerate() {
            for (address, span) in &parameter.sets {
                let place = places.entry(address).or_insert_with(|| blank(address));
                if let Some(first) = place.set_by.replace(p) {
                    let by = self.parameters[first].name.clone();
                    return self.fault(parameter, span, SweepFault::SetTwice { by });
                }
            }
            for (address, span) in &parameter.shifts {
                let place = places.entry(address).or_insert_with(|| blank(address));
                if parameter.sets.iter().any(|(set, _)| set == address) {
                    let by = parameter.name.clone();
                    return self.fault(parameter, span, SweepFault::SetTwice { by });
                }
                place.shifts.push((p, base(&parameter.sets[0].0)));
            }
        }
        Ok(places.into_values().collect())
    }

    fn count(&self) -> Result<usize, SweepRefusal> {
        let counts = self.parameters.iter().map(|p| p.texts.len());
        match self.combine {
            Combine::Latin(n) => Ok(n as usize),
            Combine::Grid => {
                #[allow(clippy::cast_precision_loss, reason = "sizes of lists")]
                let product: f64 = counts.clone().map(|n| n as f64).product();
                let last = self.parameters.last().filter(|_| product > f64::from(MOST_MEMBERS));
                if let Some(last) = last {
                    return self.fault(last, &last.span, SweepFault::TooMany(product));
                }
                Ok(counts.product())
            }
            Combine::Zip => {
                let first = &self.parameters[0];
                let needed = first.texts.len();
                for parameter in &self.parameters {
                    let found = parameter.texts.len();
                    if found != needed {
                        let first = first.name.clone();
                        let fault = SweepFault::ZipCount { first, needed, found };
                        return self.fault(parameter, &parameter.span, fault);
                    }
                }
                Ok(needed)
            }
        }
    }
}

/// True if the fault concerns a single number, whatever the values of the other numbers are.
fn is_final(fault: &ReadFault) -> bool {
    match fault {
        ReadFault::NotFinite { .. } | ReadFault::NotACount { .. } => true,
        ReadFault::Scene(error) => matches!(
            error.fault,
            SceneFault::NotFinite | SceneFault::NotPositive(_) | SceneFault::Negative(_)
        ),
        _ => false,
    }
}

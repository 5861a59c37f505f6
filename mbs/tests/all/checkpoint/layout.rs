//! Positions of the parts of a checkpoint among its bytes: an independent reader of the format in docs/CHECKPOINT.md.

use core::ops::Range;
use mbs::{FormulationKind, ResolvedMethod};

/// Number of bytes before those that the length and the checksum cover.
const N_HEAD: usize = 28;
/// Number of values of the energy invariant.
const N_INVARIANT: usize = mbs::core::control::Invariant::N_HISTORY;
/// Number of values of a spring's last evaluation.
const N_MEASURE: u64 = 7;

/// Bytes of a checkpoint in `f64`, and its named parts.
#[derive(Debug, Clone)]
pub(super) struct Parts {
    bytes: Vec<u8>,
    places: Vec<(&'static str, Range<usize>)>,
}

impl Parts {
    /// Of the checkpoint of a simulation.
    pub(super) fn of_simulation(bytes: Vec<u8>, settings: &ResolvedMethod) -> Self {
        let mut walk = Walk::new(&bytes);
        walk.simulation(settings).expect("all is there");
        assert_eq!(walk.at, bytes.len(), "nothing else is there");
        Self { places: walk.places, bytes }
    }

    /// Of the checkpoint of a run.
    pub(super) fn of_run(bytes: Vec<u8>, settings: &ResolvedMethod) -> Self {
        let mut walk = Walk::new(&bytes);
        walk.simulation(settings).and_then(|()| walk.record()).expect("all is there");
        assert_eq!(walk.at, bytes.len(), "nothing else is there");
        Self { places: walk.places, bytes }
    }

    /// The bytes of the whole file.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Range of a part among the bytes.
    pub(super) fn place(&self, name: &str) -> Range<usize> {
        let found = self.places.iter().find(|(part, _)| *part == name);
        found.unwrap_or_else(|| panic!("no part {name}")).1.clone()
    }

    /// The bytes of a part.
    pub(super) fn part(&self, name: &str) -> &[u8] {
        &self.bytes[self.place(name)]
    }

    /// Reads a part that is a number.
    pub(super) fn number(&self, name: &str) -> f64 {
        f64::from_le_bytes(self.part(name).try_into().expect("eight bytes"))
    }

    /// Reads a part that is a small count.
    pub(super) fn count(&self, name: &str) -> u32 {
        u32::from_le_bytes(self.part(name).try_into().expect("four bytes"))
    }

    /// Returns the file with other bytes in place of a part.
    pub(super) fn with(&self, name: &str, part: &[u8]) -> Vec<u8> {
        let mut bytes = self.bytes.clone();
        bytes.splice(self.place(name), part.iter().copied());
        sealed(&bytes)
    }
}

/// Returns the bytes of a changed checkpoint with correct length and checksum.
pub(super) fn sealed(bytes: &[u8]) -> Vec<u8> {
    let mut sealed = bytes.to_vec();
    if let Some((head, rest)) = sealed.split_at_mut_checked(N_HEAD) {
        head[12..20].copy_from_slice(&(rest.len() as u64).to_le_bytes());
        head[20..N_HEAD].copy_from_slice(&checksum(rest).to_le_bytes());
    }
    sealed
}

/// Checksum FNV-1a of 64 bits.
fn checksum(bytes: &[u8]) -> u64 {
    let step = |sum: u64, &byte: &u8| (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}

/// Walk over the bytes; its functions return `None` if the bytes end too early.
struct Walk<'a> {
    bytes: &'a [u8],
    at: usize,
    places: Vec<(&'static str, Range<usize>)>,
}

impl<'a> Walk<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: N_HEAD, places: Vec::new() }
    }

    fn skip(&mut self, n: usize) -> Option<()> {
        self.at = self.at.checked_add(n).filter(|at| *at <= self.bytes.len())?;
        Some(())
    }

    /// Passes over `n` numbers of eight bytes.
    fn numbers(&mut self, n: u64) -> Option<()> {
        self.skip(usize::try_from(n).ok()?.checked_mul(8)?)
    }

    fn word(&mut self) -> Option<u64> {
        let from = self.at;
        self.skip(8)?;
        self.bytes[from..self.at].try_into().ok().map(u64::from_le_bytes)
    }

    fn flag(&mut self) -> Option<bool> {
        let from = self.at;
        self.skip(1)?;
        Some(self.bytes[from] == 1)
    }

    /// Passes over a list that follows its length.
    fn list(&mut self, mut each: impl FnMut(&mut Self) -> Option<()>) -> Option<()> {
        let n = self.word()?;
        (0..n).try_for_each(|_| each(self))
    }

    fn list_of_numbers(&mut self) -> Option<()> {
        let n = self.word()?;
        self.numbers(n)
    }

    /// Passes over an optional part that follows its flag.
    fn option(&mut self, each: impl FnOnce(&mut Self) -> Option<()>) -> Option<()> {
        if self.flag()? { each(self) } else { Some(()) }
    }

    /// Passes over a part and records its name.
    fn named(
        &mut self,
        name: &'static str,
        part: impl FnOnce(&mut Self) -> Option<()>,
    ) -> Option<()> {
        let from = self.at;
        part(self)?;
        self.places.push((name, from..self.at));
        Some(())
    }

    /// Passes over a simulation, from the version to the inputs.
    fn simulation(&mut self, settings: &ResolvedMethod) -> Option<()> {
        self.identity()?;
        self.named("simulation", |walk| {
            walk.state()?;
            walk.formulation(settings.formulation)?;
            if walk.flag()? {
                walk.control(settings.events)?;
            }
            walk.named("invariant", |walk| walk.numbers(N_INVARIANT as u64))?;
            walk.named("inputs", |walk| {
                // these are lists of the inputs of effects, guides and signals
                let input = |walk: &mut Self| walk.numbers(5);
                walk.list(input)?;
                walk.list(input)?;
                walk.list(input)
            })
        })
    }

    fn identity(&mut self) -> Option<()> {
        let text = |walk: &mut Self| {
            let n = walk.word()?;
            walk.skip(usize::try_from(n).ok()?)
        };
        text(self)?;
        self.flag()?;
        self.numbers(2)?;
        self.list_of_numbers()?;
        self.list(text)?;
        text(self)
    }

    fn state(&mut self) -> Option<()> {
        for name in ["time", "length of the last step", "work", "power"] {
            self.named(name, |walk| walk.numbers(1))?;
        }
        let lists = [
            "positions",
            "rounding of positions",
            "velocities",
            "accelerations",
            "auxiliary accelerations",
            "multipliers",
            "multipliers before",
            "reactions",
            "residuals",
            "memory",
        ];
        lists.into_iter().try_for_each(|name| self.named(name, Self::list_of_numbers))?;
        self.named("inputs of the state", |walk| walk.list(Self::list_of_numbers))
    }

    fn formulation(&mut self, formulation: FormulationKind) -> Option<()> {
        match self.word()? {
            0 => {
                self.named("penalty", |walk| walk.numbers(1))?;
                self.named("strength of penalties", |walk| walk.numbers(1))?;
                self.named("what is left of the combination", |walk| walk.numbers(1))?;
                self.named("combination of constraints", Self::list_of_numbers)?;
                self.skip(8)?;
                if formulation.row().energy_rule {
                    self.named("index", |walk| walk.skip(1))?;
                    self.named("changes", |walk| walk.skip(4))?;
                    self.numbers(2)?;
                }
                self.springs()
            }
            2 => {
                self.named("order", |walk| {
                    walk.list(|walk| walk.skip(8))?;
                    walk.list_of_numbers()?;
                    walk.list_of_numbers()
                })?;
                self.numbers(2)?;
                self.flag()?;
                self.named("choices", |walk| walk.skip(4))?;
                self.springs()
            }
            3 => self.tree(),
            // other formulations store the state of their laws only
            _ => self.springs(),
        }
    }

    fn springs(&mut self) -> Option<()> {
        self.named("springs", |walk| {
            walk.list(|walk| walk.numbers(N_MEASURE))?;
            walk.list(Self::list_of_numbers)
        })
    }

    fn tree(&mut self) -> Option<()> {
        self.named("time of the tree", |walk| walk.numbers(1))?;
        self.numbers(2)?;
        for name in ["coordinates", "rates", "second rates", "auxiliary"] {
            self.named(name, Self::list_of_numbers)?;
        }
        self.list_of_numbers()?;
        self.named("inputs of the tree", |walk| walk.list(Self::list_of_numbers))?;
        self.word()?;
        self.named("pivots", Self::list_of_numbers)?;
        self.named("error control of the tree", |walk| {
            for _ in 0..3 {
                walk.option(Self::adaptive)?;
            }
            walk.option(|walk| {
                walk.adaptive()?;
                walk.list_of_numbers()?;
                walk.list_of_numbers()?;
                walk.flag()?;
                walk.option(|walk| walk.numbers(1))?;
                walk.option(|walk| walk.numbers(1))?;
                walk.numbers(1)
            })
        })?;
        self.named("energies", |walk| walk.numbers(2))
    }

    /// Passes over the control of steps within a step.
    fn adaptive(&mut self) -> Option<()> {
        self.numbers(1)?;
        self.errors()?;
        self.numbers(3)
    }

    fn errors(&mut self) -> Option<()> {
        self.option(|walk| walk.numbers(1))?;
        self.skip(1)
    }

    fn control(&mut self, has_events: bool) -> Option<()> {
        self.named("next step", |walk| walk.numbers(1))?;
        self.named("energy rule", |walk| walk.option(|walk| walk.skip(12)))?;
        self.named("error control", |walk| walk.option(Self::errors))?;
        self.option(|walk| walk.skip(12))?;
        if has_events {
            self.skip(12)?;
            self.list(Self::list_of_numbers)?;
        }
        Some(())
    }

    /// Passes over the parts of a run other than its simulation.
    fn record(&mut self) -> Option<()> {
        self.named("count of steps", |walk| walk.numbers(1))?;
        self.numbers(1)?;
        self.named("rows", |walk| {
            walk.list(Self::mark)?;
            walk.list_of_numbers()?;
            walk.list_of_numbers()?;
            walk.numbers(5)?;
            walk.mark()
        })?;
        self.named("statistics", |walk| {
            walk.option(|walk| walk.numbers(2))?;
            walk.numbers(6)?;
            walk.list(|walk| walk.numbers(11))
        })?;
        self.named("pictures", |walk| {
            walk.numbers(1)?;
            walk.list_of_numbers()?;
            walk.list_of_numbers()
        })?;
        self.named("turns of angles", |walk| {
            walk.list_of_numbers()?;
            walk.list_of_numbers()
        })?;
        self.named("contacts", |walk| {
            walk.list(|walk| walk.skip(25))?;
            walk.numbers(1)
        })?;
        self.named("counts", |walk| {
            walk.numbers(4)?;
            walk.named("counts of the control", |walk| walk.numbers(6))
        })?;
        self.named("alarm", |walk| walk.skip(4))?;
        self.named("CPU time", |walk| walk.numbers(1))
    }

    /// Passes over the record of one step.
    fn mark(&mut self) -> Option<()> {
        self.numbers(8)?;
        self.option(|walk| walk.skip(1))?;
        self.skip(8)?;
        self.numbers(2)?;
        self.option(|walk| walk.numbers(1))?;
        self.numbers(1)
    }
}

//! File of a checkpoint: a head of fixed length that says what follows, and what it belongs to.

use super::CheckpointError;
use super::identity::Identity;
use super::tape::{Eye, Pen, Tape, Walked, holds};
use crate::fingerprint::fingerprint;
use crate::settings::{Method, ResolvedMethod};
use mbs_core::Real;
use mbs_core::scene::Scene;
use std::io::Read;
use std::path::Path;

/// First bytes of a checkpoint.
const MAGIC: [u8; 8] = *b"mbs-ckpt";
/// Number of the layout of what follows: it grows with every change, and others are refused.
const FORMAT: u32 = 6;
/// Bytes before those that are counted and summed: magic, format, length, checksum.
const N_HEAD: usize = 28;

/// Content of a checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// State that a simulation steps on from.
    Simulation,
    /// State that a simulation steps on from, and the record of its run so far.
    Run,
}

/// A checkpoint that was read: whole, and of this version of mbs.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    identity: Identity,
    kind: Kind,
    /// Simulated time, and how much of it lies between two checkpoints of the run [s].
    times: [f64; 2],
    body: Vec<u8>,
}

impl Checkpoint {
    /// Reads a checkpoint from a file.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn open(path: &Path) -> Result<Self, CheckpointError> {
        Self::read(std::fs::File::open(path)?)
    }

    /// Reads a checkpoint, and nothing more than its bytes and one.
    ///
    /// # Errors
    /// [`CheckpointError`] for what is no checkpoint, is not whole, or was written by another version.
    pub fn read(mut source: impl Read) -> Result<Self, CheckpointError> {
        let mut start = Vec::with_capacity(N_HEAD);
        source.by_ref().take(N_HEAD as u64).read_to_end(&mut start)?;
        let magic = &MAGIC[..start.len().min(MAGIC.len())];
        if start.is_empty() || !start.starts_with(magic) {
            return Err(CheckpointError::NotACheckpoint);
        }
        let mut eye = Eye(&start);
        let (mut magic, mut format, mut stated, mut sum) = ([0; 8], [0; 4], 0, 0);
        let torn = |_| CheckpointError::Torn { stated: N_HEAD as u64, found: start.len() as u64 };
        eye.bytes(&mut magic).map_err(torn)?;
        eye.bytes(&mut format).map_err(torn)?;
        if u32::from_le_bytes(format) != FORMAT {
            let format = u32::from_le_bytes(format);
            return Err(CheckpointError::Version(format!("with format {format}")));
        }
        eye.word(&mut stated).map_err(torn)?;
        eye.word(&mut sum).map_err(torn)?;
        let mut rest = Vec::new();
        source.take(stated.saturating_add(1)).read_to_end(&mut rest)?;
        if rest.len() as u64 != stated {
            return Err(CheckpointError::Torn { stated, found: rest.len() as u64 });
        }
        if fingerprint(&rest) != sum {
            return Err(CheckpointError::Checksum);
        }
        let mut eye = Eye(&rest);
        let (mut kind, mut times, mut identity) = (Kind::Run, [0.0; 2], Identity::default());
        walk(&mut eye, &mut kind, &mut times, &mut identity)?;
        let body = eye.0.to_vec();
        Ok(Self { identity, kind, times, body })
    }

    /// The simulated time it was written at [s].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.times[0]
    }

    /// The simulated time between two checkpoints of its run [s]; zero where there was no run.
    #[must_use]
    pub fn every(&self) -> f64 {
        self.times[1]
    }

    /// The settings to resume with: those of its run. What is given must agree with them, but for the number of threads.
    ///
    /// # Errors
    /// [`CheckpointError::Settings`] for what no run could have, [`CheckpointError::Setting`] for what this run did not have.
    pub fn settings<T: Real>(
        &self,
        scene: &Scene<T>,
        given: &Method,
    ) -> Result<ResolvedMethod, CheckpointError> {
        let settings = ResolvedMethod::new(scene, &self.overrides(given)?);
        self.settle(settings.map_err(CheckpointError::Settings)?)
    }

    /// Returns the settings that are given, and those of the checkpoint's run where nothing is given. [`settle`](Self::settle) compares what
    /// [`ResolvedMethod::new`] makes of them. The two are the halves of [`settings`](Self::settings).
    ///
    /// # Errors
    /// [`CheckpointError::Setting`] for what this run did not have.
    pub fn overrides(&self, given: &Method) -> Result<Method, CheckpointError> {
        self.identity.overrides(given)
    }

    /// The settings that came of [`overrides`](Self::overrides), where they are those of the checkpoint's run.
    ///
    /// # Errors
    /// [`CheckpointError::Setting`] for what this run did not have.
    pub fn settle(&self, settings: ResolvedMethod) -> Result<ResolvedMethod, CheckpointError> {
        self.identity.settle(settings)
    }

    /// Is it of these, scene and settings?
    pub fn check(&self, identity: &Identity) -> Walked {
        identity.check(&self.identity)
    }

    /// Tape of the state of the simulation, and after it the record of its run, if it has one.
    pub fn body(&self) -> Eye<'_> {
        Eye(&self.body)
    }

    /// Has it the record of a run?
    pub fn is_of_run(&self) -> bool {
        self.kind == Kind::Run
    }
}

/// Walks along what comes before the state: version, content, times and identity.
fn walk(
    tape: &mut impl Tape,
    kind: &mut Kind,
    times: &mut [f64; 2],
    identity: &mut Identity,
) -> Walked {
    let mut version = env!("CARGO_PKG_VERSION").to_owned();
    tape.text(&mut version)?;
    if version != env!("CARGO_PKG_VERSION") {
        return Err(CheckpointError::Version(version));
    }
    let mut is_run = *kind == Kind::Run;
    tape.flag(&mut is_run)?;
    *kind = if is_run { Kind::Run } else { Kind::Simulation };
    tape.floats(times)?;
    holds(times.iter().all(|t| t.is_finite()))?;
    identity.walk(tape)
}

/// The bytes of a checkpoint at simulated times (now, between two) [s], its state by `body`.
pub fn whole(
    identity: &Identity,
    (mut kind, mut times): (Kind, [f64; 2]),
    body: impl FnOnce(&mut Pen) -> Walked,
) -> Result<Vec<u8>, CheckpointError> {
    let mut pen = Pen(vec![0; N_HEAD]);
    walk(&mut pen, &mut kind, &mut times, &mut identity.clone())?;
    body(&mut pen)?;
    let mut bytes = pen.0;
    let (stated, sum) = ((bytes.len() - N_HEAD) as u64, fingerprint(&bytes[N_HEAD..]));
    bytes[..8].copy_from_slice(&MAGIC);
    bytes[8..12].copy_from_slice(&FORMAT.to_le_bytes());
    bytes[12..20].copy_from_slice(&stated.to_le_bytes());
    bytes[20..N_HEAD].copy_from_slice(&sum.to_le_bytes());
    Ok(bytes)
}

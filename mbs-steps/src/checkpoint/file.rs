//! File of a checkpoint: a header of fixed length, the identity of scene and settings, and the state.

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
/// Version number of the file format. It increases with every change of the layout. Files with another number are not read.
const FORMAT: u32 = 6;
/// Length of the header in bytes. The header has magic, format, length and checksum; stored length and checksum cover the bytes after the
/// header.
const N_HEAD: usize = 28;

/// Content of a checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// State from which a simulation continues.
    Simulation,
    /// State from which a simulation continues, and the record of its run so far.
    Run,
}

/// Checkpoint after it was read: it is complete, and was written by this version of mbs.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    identity: Identity,
    kind: Kind,
    /// Simulated time of the checkpoint, and interval between checkpoints of the run [s].
    times: [f64; 2],
    body: Vec<u8>,
}

impl Checkpoint {
    /// Reads a checkpoint from a file.
    ///
    /// # Errors
    /// As for [`read`](Self::read).
    pub fn open(path: &Path) -> Result<Self, CheckpointError> {
        Self::read(std::fs::File::open(path)?)
    }

    /// Reads a checkpoint from a source. At most one byte after the end of the checkpoint is read.
    ///
    /// # Errors
    /// [`CheckpointError`] for data that is no checkpoint, is incomplete, or was written by another version.
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

    /// The simulated time of the checkpoint [s].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.times[0]
    }

    /// The interval between checkpoints of the run in simulated time [s]; zero without a run.
    #[must_use]
    pub fn every(&self) -> f64 {
        self.times[1]
    }

    /// Settings for the resumed run: the given settings, completed by the settings of the checkpoint. Given settings must equal those of
    /// the checkpoint, except the number of threads.
    ///
    /// # Errors
    /// [`CheckpointError::Settings`] for invalid settings, [`CheckpointError::Setting`] for a setting that differs from the checkpoint.
    pub fn settings<T: Real>(
        &self,
        scene: &Scene<T>,
        given: &Method,
    ) -> Result<ResolvedMethod, CheckpointError> {
        let settings = ResolvedMethod::new(scene, &self.overrides(given)?);
        self.settle(settings.map_err(CheckpointError::Settings)?)
    }

    /// Returns the given settings, completed by the settings of the checkpoint. The caller makes a [`ResolvedMethod::new`] from them, and
    /// [`settle`](Self::settle) compares it with the checkpoint. The function [`settings`](Self::settings) does both.
    ///
    /// # Errors
    /// [`CheckpointError::Setting`] for a setting that differs from the checkpoint.
    pub fn overrides(&self, given: &Method) -> Result<Method, CheckpointError> {
        self.identity.overrides(given)
    }

    /// Returns the resolved settings after a check that they equal those of the checkpoint. They were resolved from
    /// [`overrides`](Self::overrides).
    ///
    /// # Errors
    /// [`CheckpointError::Setting`] for a setting that differs from the checkpoint.
    pub fn settle(&self, settings: ResolvedMethod) -> Result<ResolvedMethod, CheckpointError> {
        self.identity.settle(settings)
    }

    /// Checks that the checkpoint belongs to this scene and these settings.
    pub fn check(&self, identity: &Identity) -> Walked {
        identity.check(&self.identity)
    }

    /// Tape with the state of the simulation, followed by the record of its run, if there is one.
    pub fn body(&self) -> Eye<'_> {
        Eye(&self.body)
    }

    /// True if the checkpoint has the record of a run.
    pub fn is_of_run(&self) -> bool {
        self.kind == Kind::Run
    }
}

/// Writes or reads the parts that precede the state: version, kind, times and identity.
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

/// Returns the bytes of a checkpoint. `times` has the simulated time and the checkpoint interval [s]; `body` writes the state.
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

//! Choice of the scalar type from a precision. A scene is read in the precision of its run, and generic work is done on it.
//!
//! Every step is compiled once for each scalar and dimension listed here. `f32` and `dd` are features of this crate, on by default. A build
//! without these features compiles half as much code. It rejects a scene in one of these precisions with [`PrecisionError::NotBuilt`].

use crate::choice::Precision;
use core::fmt::{self, Display, Formatter};
use mbs_core::Real;
#[cfg(feature = "dd")]
use mbs_core::real::DoubleDouble;
use mbs_core::scene::{Dimension, Scene};
use mbs_scene::{ReadError, SceneFile};
use std::borrow::Cow;

/// Generic work on a scene, in the precision and dimension of its run.
pub trait SceneWork {
    /// Result of the work.
    type Done;

    /// Does the work on a scene with known scalar and dimension.
    fn done<T: Real, const D: usize>(self, scene: &Scene<T>) -> Self::Done;
}

/// Source from which a scene can be read in every precision.
pub trait Source {
    /// Reason why the source has no scene in one of the precisions.
    type Error: From<PrecisionError>;

    /// The scene in the precision `T`.
    #[cfg_attr(
        not(any(feature = "f32", feature = "dd")),
        allow(dead_code, reason = "a build in f64 alone has its scene")
    )]
    fn scene_in<T: Real>(&self) -> Result<Scene<T>, Self::Error>;
}

impl Source for SceneFile {
    type Error = PrecisionError;

    fn scene_in<T: Real>(&self) -> Result<Scene<T>, PrecisionError> {
        Ok(self.scene()?)
    }
}

/// A scene in one precision.
#[derive(Debug)]
pub enum ReadScene<'a> {
    /// Scene in double precision.
    F64(Box<Cow<'a, Scene<f64>>>),
    /// Scene in single precision.
    #[cfg(feature = "f32")]
    F32(Box<Scene<f32>>),
    /// Scene in double-double precision (pairs of doubles).
    #[cfg(feature = "dd")]
    DoubleDouble(Box<Scene<DoubleDouble>>),
}

impl<'a> ReadScene<'a> {
    /// Takes the scene in `f64`. For another precision, reads the scene again from the source.
    ///
    /// # Errors
    /// The error of the source, or an error for a precision that is not built.
    pub fn of<S: Source>(
        source: &S,
        scene: Cow<'a, Scene<f64>>,
        precision: Precision,
    ) -> Result<Self, S::Error> {
        let _ = source;
        match precision {
            Precision::F64 => Ok(Self::F64(Box::new(scene))),
            #[cfg(feature = "f32")]
            Precision::F32 => Ok(Self::F32(Box::new(source.scene_in()?))),
            #[cfg(feature = "dd")]
            Precision::DoubleDouble => Ok(Self::DoubleDouble(Box::new(source.scene_in()?))),
            #[cfg(not(all(feature = "f32", feature = "dd")))]
            missing => Err(PrecisionError::NotBuilt(missing).into()),
        }
    }

    /// Returns the scene with owned data, so that nothing is borrowed.
    pub fn into_owned(self) -> ReadScene<'static> {
        match self {
            Self::F64(scene) => ReadScene::F64(Box::new(Cow::Owned(scene.into_owned()))),
            #[cfg(feature = "f32")]
            Self::F32(scene) => ReadScene::F32(scene),
            #[cfg(feature = "dd")]
            Self::DoubleDouble(scene) => ReadScene::DoubleDouble(scene),
        }
    }

    /// Does the work in the scene's precision and dimension.
    pub fn work<W: SceneWork>(&self, work: W) -> W::Done {
        match self {
            Self::F64(scene) => in_space(&***scene, work),
            #[cfg(feature = "f32")]
            Self::F32(scene) => in_space(&**scene, work),
            #[cfg(feature = "dd")]
            Self::DoubleDouble(scene) => in_space(&**scene, work),
        }
    }

    /// Does the work in `f32` or `f64`; `None` in double-double precision, because such work is not compiled for it.
    pub fn work_in_hardware<W: SceneWork>(&self, work: W) -> Option<W::Done> {
        match self {
            Self::F64(scene) => Some(in_space(&***scene, work)),
            #[cfg(feature = "f32")]
            Self::F32(scene) => Some(in_space(&**scene, work)),
            #[cfg(feature = "dd")]
            Self::DoubleDouble(_) => None,
        }
    }
}

/// Does the work in the dimension of the scene.
pub fn in_space<T: Real, W: SceneWork>(scene: &Scene<T>, work: W) -> W::Done {
    match scene.dimension {
        Dimension::Planar => work.done::<T, 2>(scene),
        Dimension::Spatial => work.done::<T, 3>(scene),
    }
}

/// True if this scalar has more digits than `f64`.
pub fn is_finer<T: Real>() -> bool {
    T::EPSILON.to_f64() < f64::EPSILON
}

impl Precision {
    /// True if this build has the steps of this precision. `f32` and `dd` are features of the crate, on by default.
    #[must_use]
    pub const fn is_built(self) -> bool {
        match self {
            Self::F32 => cfg!(feature = "f32"),
            Self::F64 => true,
            Self::DoubleDouble => cfg!(feature = "dd"),
        }
    }
}

/// Reason why a scene is not available in the precision of its run.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum PrecisionError {
    /// The text is a valid scene in `f64`, but not in the precision of the run.
    Read(Box<ReadError>),
    /// This build has no steps of that precision.
    NotBuilt(Precision),
}

impl PrecisionError {
    /// Message of the error, with its place in the text or its hint.
    #[must_use]
    pub fn render(&self) -> String {
        match self {
            Self::Read(error) => error.render(),
            Self::NotBuilt(_) => format!("error: {self}\nhint: {}", self.hint()),
        }
    }

    /// Hint for the user: what to do about the error.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::Read(error) => error.hint(),
            Self::NotBuilt(precision) => not_built_hint(*precision),
        }
    }
}

/// Returns the hint on how to get a precision that was left out of the build.
pub fn not_built_hint(precision: Precision) -> String {
    format!("build with the feature `{}`, which is on by default", precision.name())
}

impl From<ReadError> for PrecisionError {
    fn from(error: ReadError) -> Self {
        Self::Read(Box::new(error))
    }
}

impl Display for PrecisionError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read(error) => error.fmt(f),
            Self::NotBuilt(precision) => {
                write!(f, "this build has no precision `{}`", precision.name())
            }
        }
    }
}

impl core::error::Error for PrecisionError {}

//! Generated scenes of any size, as text of scene files.
//!
//! A generated scene is read, checked and run like any other scene. A comment at its head names the family and the command that made it.
//! The number of outputs does not grow with the scene, so that rows of results stay short.

mod chain;
mod convoy;
mod error;
mod four_bars;
mod net;
pub(crate) mod text;
mod tree;

pub use error::GenerateError;

use crate::read::SceneFile;

/// Largest number of bodies of a generated scene. A larger number is refused as a mistake. Chosen, not tuned.
pub const MOST_BODIES: usize = 10_000_000;

/// A family of scenes, with its size.
#[derive(Debug, Clone, Copy)]
pub enum Family<'a> {
    /// A spatial chain of links, hung at one end and released from the horizontal, with revolute, universal and spherical joints in turn.
    Chain {
        /// Number of links; at least 1.
        bodies: usize,
    },
    /// A binary tree of bars with spatial revolute joints. The bars of each generation are lighter and shorter.
    Tree {
        /// Number of bars; at least 1. One less than a power of two completes the last generation.
        bodies: usize,
    },
    /// Planar four-bar linkages side by side, as in `scenes/n-four-bar-40.toml`.
    FourBars {
        /// Number of linkages, n; at least 1. The scene has 2 n + 1 bodies.
        loops: usize,
    },
    /// A rope net of rods with ball joints, hung at its four corners.
    Net {
        /// Meshes from front to back; at least 2.
        rows: usize,
        /// Meshes from left to right; at least 2.
        columns: usize,
    },
    /// Copies of a vehicle, one behind the other on one road, driving in the direction of x.
    Convoy {
        /// The scene of one vehicle; it must have a tire.
        vehicle: &'a SceneFile,
        /// Number of vehicles; at least 1.
        count: usize,
        /// Distance between consecutive vehicles [m].
        spacing: f64,
    },
}

impl Family<'_> {
    /// The square net whose number of rods is nearest to `bodies`. A net of n x n meshes has 2 n (n + 1) rods, with n at least 2.
    #[must_use]
    pub fn net_of(bodies: usize) -> Self {
        // Nets of n - 1 and n meshes have 2 (n - 1) n and 2 n (n + 1) rods, so 2 n^2 is halfway between them.
        let mut n = (bodies / 2).isqrt().max(2);
        if bodies > 2 * (n + 1) * (n + 1) {
            n += 1;
        }
        Self::Net { rows: n, columns: n }
    }

    /// Number of bodies of the scene.
    fn n_bodies(&self) -> usize {
        match *self {
            Self::Chain { bodies } | Self::Tree { bodies } => bodies,
            Self::FourBars { loops } => loops.saturating_mul(2).saturating_add(1),
            Self::Net { rows, columns } => rows
                .saturating_mul(columns)
                .saturating_mul(2)
                .saturating_add(rows.saturating_add(columns)),
            Self::Convoy { vehicle, count, .. } => vehicle.count("body").saturating_mul(count),
        }
    }
}

/// The text of a scene of a family. The comment at its head names `command` as the command that made it.
///
/// Cost: proportional to the length of the text, about 250 bytes for each body of a chain.
///
/// # Errors
/// [`GenerateError`] when the size is too small or too large, or the vehicle is not usable.
///
/// # Examples
/// ```
/// use mbs_scene::{SceneFile, Family, generate};
/// let text = generate(&Family::Chain { bodies: 100 }, "mbs generate chain --count 100")?;
/// let scene = SceneFile::parse(&text, "chain.toml")?.scene::<f64>()?;
/// assert_eq!((scene.bodies.len(), scene.joints.len()), (100, 100));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn generate(family: &Family<'_>, command: &str) -> Result<String, GenerateError> {
    let (given, least) = match *family {
        Family::Chain { bodies: n }
        | Family::Tree { bodies: n }
        | Family::FourBars { loops: n }
        | Family::Convoy { count: n, .. } => (n, 1),
        Family::Net { rows, columns } => (rows.min(columns), 2),
    };
    if given < least {
        return Err(GenerateError::TooFew { given, least });
    }
    if family.n_bodies() > MOST_BODIES {
        return Err(GenerateError::TooMany { bodies: family.n_bodies(), most: MOST_BODIES });
    }
    match *family {
        Family::Chain { bodies } => Ok(chain::text(bodies, command)),
        Family::Tree { bodies } => Ok(tree::text(bodies, command)),
        Family::FourBars { loops } => Ok(four_bars::text(loops, command)),
        Family::Net { rows, columns } => Ok(net::text([rows, columns], command)),
        Family::Convoy { vehicle, count, spacing } => {
            convoy::text(vehicle, (count, spacing), command)
        }
    }
}

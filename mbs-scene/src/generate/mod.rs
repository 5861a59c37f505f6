//! Large scenes by rule: text of scene files, as long as wanted.
//!
//! What is generated is read, checked and run as any other scene; a comment at its head says what it is and which command made
//! it. Outputs are few whatever the size, so that rows stay short.

mod chain;
mod convoy;
mod error;
mod four_bars;
mod net;
pub(crate) mod text;
mod tree;

pub use error::GenerateError;

use crate::read::SceneFile;

/// Most bodies of a generated scene. Chosen, not tuned: a slip of a count ends in a message.
pub const MOST_BODIES: usize = 10_000_000;

/// A family of scenes, with its size.
#[derive(Debug, Clone, Copy)]
pub enum Family<'a> {
    /// A spatial chain of links hung at one end and let go from the horizontal: revolute, universal and spherical joints in this order.
    Chain {
        /// Number of links; at least 1.
        bodies: usize,
    },
    /// A binary tree of bars with spatial revolute joints, each generation lighter and shorter.
    Tree {
        /// Number of bars; at least 1. One less than a power of two fills its generations.
        bodies: usize,
    },
    /// Planar four-bar linkages side by side, as in `scenes/n-four-bar-40.toml`.
    FourBars {
        /// Number of linkages; at least 1. There is one body more than twice as many.
        loops: usize,
    },
    /// A rope net of rods joined by balls, hung at its four corners.
    Net {
        /// Meshes from front to back; at least 2.
        rows: usize,
        /// Meshes from left to right; at least 2.
        columns: usize,
    },
    /// Copies of a vehicle behind each other on one road, driving in x.
    Convoy {
        /// The scene of one vehicle; it must have a tire.
        vehicle: &'a SceneFile,
        /// Number of vehicles; at least 1.
        count: usize,
        /// Distance from one to the next [m].
        spacing: f64,
    },
}

impl Family<'_> {
    /// The square net whose number of rods is nearest to `bodies`: 2 n (n + 1) for n meshes each way, n at least 2.
    #[must_use]
    pub fn net_of(bodies: usize) -> Self {
        // 2 (n - 1) n .. 2 n (n + 1): halfway lies 2 n^2.
        let mut n = (bodies / 2).isqrt().max(2);
        if bodies > 2 * (n + 1) * (n + 1) {
            n += 1;
        }
        Self::Net { rows: n, columns: n }
    }

    /// Bodies of the scene.
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

/// The text of a scene of a family; `command` is what the comment at its head names as its maker.
///
/// Cost: proportional to the length of the text, some 250 bytes for each body of a chain.
///
/// # Errors
/// [`GenerateError`] when the size is none, too large, or the vehicle is none.
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

//! What one channel reads: a quantity of each kind.

use super::Quantity;
use super::kind::{Followed, Instant, Maker, Measured};
use super::seen::SeenPoint;
use crate::Real;

super::list::list!(channels);

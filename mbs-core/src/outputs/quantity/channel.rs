//! What one channel reads: a quantity of each kind.

use super::kind::{Followed, Instant, Maker, Measured};
use super::seen::SeenPoint;
use super::table;
use crate::Real;
use crate::scene::Quantity;
use crate::scene::quantity::list;

list::list!(table::channels);

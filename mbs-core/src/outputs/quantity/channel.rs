//! Channel of an output: one of the kinds of quantity.

use super::kind::{Followed, Instant, Maker, Measured};
use super::seen::SeenPoint;
use super::table;
use crate::Real;
use crate::scene::Quantity;
use crate::scene::quantity::list;

list::list!(table::channels);

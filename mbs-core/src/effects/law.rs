//! The laws of all effects: one along a length or about an angle, one on a body.

use super::table;
use crate::Real;
use crate::laws::Supplies;
use crate::laws::body::{Action, BodyMotion, NeverLaw, WrenchesLaw};
use crate::laws::entry::{Entry, EntryReader, EntryWriter};
use crate::laws::kink::Kink;
use crate::laws::operations::Operations;
use crate::laws::scalar::{Measure, TensionLaw};

super::list::list!(laws);

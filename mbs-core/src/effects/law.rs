//! Enums of the laws of all effects: laws along a length or about an angle, and laws on one body.

use super::table;
use crate::Real;
use crate::laws::LawInputs;
use crate::laws::body::{BodyMotion, NeverLaw, TireForces, UnitWrench, WrenchesLaw};
use crate::laws::corner::LawCorner;
use crate::laws::entry::{Entry, EntryReader, EntryWriter};
use crate::laws::operations::Operations;
use crate::laws::scalar::{ScalarForce, TensionLaw};

super::list::list!(laws);

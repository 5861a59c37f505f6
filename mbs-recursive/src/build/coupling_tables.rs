//! Tables of couplings, filled while a tree is built.

use crate::build::curve_tables::CurveTables;
use crate::rows::coupled::{
    CoupledRow, Couplings, LinePoint, LinkStart, NONE, SumMeasure, SumTerm,
};
use crate::space::Space;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::laws::code::Codes;

/// Start of a row that is carried inward along the tree. A row starts at a link with its gradient K, or at the joint of a link with its
/// slope g.
pub(crate) struct Begin<'a> {
    pub(crate) link: u32,
    pub(crate) at_joint: bool,
    /// Table entry that receives the index of the side.
    pub(crate) side: Option<&'a mut u32>,
}

/// Tables that own the data of the slices in [`Couplings`].
#[derive(Debug, Clone)]
pub(crate) struct CouplingTables<T: Real, S: Space<T>> {
    pub(crate) n_cut: u32,
    pub(crate) terms: Vec<SumTerm<T>>,
    pub(crate) points: Vec<LinePoint<T, S>>,
    pub(crate) starts: Vec<LinkStart>,
    pub(crate) curves: CurveTables<T>,
}

impl<T: Real, S: Space<T>> Default for CouplingTables<T, S> {
    fn default() -> Self {
        Self {
            n_cut: NONE,
            terms: Vec::new(),
            points: Vec::new(),
            starts: Vec::new(),
            curves: CurveTables::default(),
        }
    }
}

impl<T: Real, S: Space<T>> CouplingTables<T, S> {
    pub(crate) fn slices<'a>(&'a self, relations: &'a Codes) -> Couplings<'a, T, S> {
        let (curves, knots, numbers) = self.curves.slices();
        Couplings {
            n_cut: self.n_cut,
            terms: &self.terms,
            points: &self.points,
            starts: &self.starts,
            curves,
            knots,
            numbers,
            relations: Some(relations),
        }
    }

    /// Returns the starts of a row: the links of its lines, and the joints whose coordinates are its terms.
    pub(crate) fn begins(&mut self, row: &CoupledRow<T>) -> Vec<Begin<'_>> {
        let starts = self.starts[row.starts.range()].iter_mut();
        let starts =
            starts.map(|s| Begin { link: s.link, at_joint: false, side: Some(&mut s.side) });
        let terms = self.terms[row.terms.range()].iter_mut();
        let joints = terms.filter_map(|term| match &mut term.of {
            SumMeasure::Joint { link, side } if *side != NONE => {
                Some(Begin { link: *link, at_joint: true, side: Some(side) })
            }
            _ => None,
        });
        starts.chain(joints).collect()
    }
}

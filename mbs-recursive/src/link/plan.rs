//! The order in which loops are carried inward and eliminated: fixed when the tree is built, read by the passes.
//!
//! A loop's rows travel from its two bodies to the link nearest to both from which both hang. Λ has a block for each two
//! loops that meet on the way or through an eliminated third one. The lists below say who meets whom, so that the passes
//! run along flat arrays.

/// A range of a flat list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Span {
    /// First place of the range.
    pub first: u32,
    /// The place behind its last.
    pub end: u32,
}

impl Span {
    /// Returns the places of the range.
    #[inline(always)]
    #[must_use]
    pub fn range(self) -> core::ops::Range<usize> {
        self.first as usize..self.end as usize
    }
    /// Is the range empty?
    #[inline(always)]
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.first == self.end
    }
}

/// Loops at a link: those that pass its joint, meet there, and are eliminated there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Station {
    /// Sides of loops that pass its joint.
    pub passes: Span,
    /// Pairs of these sides that meet.
    pub pairs: Span,
    /// Loops that are eliminated there, in order.
    pub ends: Span,
}

/// One side of a loop passing a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pass {
    /// Number of the loop.
    pub lap: u32,
    /// Side of the loop: 0 from the first body, 1 from the second.
    pub side: u32,
    /// Place of its gains: rows times freedoms of the joint.
    pub gain: u32,
}

/// Two passes of a joint that meet in a block of Λ; the block's rows belong to the loop eliminated later.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pair {
    /// The pass that gives the block's rows.
    pub row: u32,
    /// The pass that gives its columns.
    pub column: u32,
    /// Place of the block.
    pub block: u32,
}

/// A loop being eliminated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct End {
    /// Number of the loop.
    pub lap: u32,
    /// Loops eliminated later that it is coupled with.
    pub couplings: Span,
    /// Blocks that its elimination changes.
    pub updates: Span,
}

/// A later loop that an eliminated one is coupled with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LoopCoupling {
    /// Number of the later loop.
    pub lap: u32,
    /// The side by which it reaches the link of elimination.
    pub side: u32,
    /// Place of the block (later loop, eliminated loop).
    pub block: u32,
}

/// A block changed by an elimination: block −= W(row) W(column)ᵀ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Update {
    /// The coupling that gives the rows.
    pub row: u32,
    /// The coupling that gives the columns.
    pub column: u32,
    /// Place of the block.
    pub block: u32,
}

/// Lists of the order of all loops.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plan<'a> {
    /// Loops at each link; see [`Station`].
    pub stations: &'a [Station],
    /// Sides that pass joints; see [`Pass`].
    pub passes: &'a [Pass],
    /// Passes that meet; see [`Pair`].
    pub pairs: &'a [Pair],
    /// Loops being eliminated; see [`End`].
    pub ends: &'a [End],
    /// Couplings of eliminated loops with later ones; see [`LoopCoupling`].
    pub couplings: &'a [LoopCoupling],
    /// Blocks changed by eliminations; see [`Update`].
    pub updates: &'a [Update],
}

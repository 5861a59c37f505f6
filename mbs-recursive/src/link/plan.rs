//! Order in which the rows of loops are carried inward and eliminated. It is fixed when the tree is built, and the passes read it.
//!
//! The rows of a loop are carried inward from its two bodies to their nearest common ancestor, and eliminated there. Λ = J M⁻¹ Jᵀ has a
//! block for every pair of coupled loops. Two loops are coupled if their rows pass the same joint, or if an eliminated third loop couples
//! both. The lists below contain these pairs, so that the passes read flat arrays only.

/// A range of a flat list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Span {
    /// First index of the range.
    pub first: u32,
    /// Index after the last index of the range.
    pub end: u32,
}

impl Span {
    /// Returns the indices of the range.
    #[inline(always)]
    #[must_use]
    pub fn range(self) -> core::ops::Range<usize> {
        self.first as usize..self.end as usize
    }
    /// True if the range is empty.
    #[inline(always)]
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.first == self.end
    }
}

/// Loops at a link: loops whose rows pass the joint of the link, loops that are coupled by this, and loops that are eliminated at the link.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Station {
    /// Passes of loops through the joint of the link.
    pub passes: Span,
    /// Pairs of these passes that are coupled.
    pub pairs: Span,
    /// Loops that are eliminated at the link, in order.
    pub ends: Span,
}

/// Passage of one side of a loop through a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pass {
    /// Index of the loop.
    pub lap: u32,
    /// Side of the loop: 0 for the side of the first body, 1 for the side of the second.
    pub side: u32,
    /// Index of the first gain of the pass. A pass has one gain for each row of the loop and each freedom of the joint.
    pub gain: u32,
}

/// Two passes through a joint whose loops are coupled by a block of Λ. The block's rows belong to the loop that is eliminated later.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pair {
    /// Index of the pass that gives the rows of the block.
    pub row: u32,
    /// Index of the pass that gives the columns of the block.
    pub column: u32,
    /// Index of the block.
    pub block: u32,
}

/// Elimination of one loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct End {
    /// Index of the loop.
    pub lap: u32,
    /// Couplings of the loop with loops that are eliminated later.
    pub couplings: Span,
    /// Updates of blocks by this elimination.
    pub updates: Span,
}

/// Coupling of an eliminated loop with a loop that is eliminated later.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LoopCoupling {
    /// Index of the later loop.
    pub lap: u32,
    /// Side by which the later loop passes the link of elimination.
    pub side: u32,
    /// Index of the block (later loop, eliminated loop).
    pub block: u32,
}

/// Update of a block by an elimination: block −= W(row) W(column)ᵀ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Update {
    /// Index of the coupling that gives the rows.
    pub row: u32,
    /// Index of the coupling that gives the columns.
    pub column: u32,
    /// Index of the block.
    pub block: u32,
}

/// All lists of the elimination order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plan<'a> {
    /// Loops at each link; see [`Station`].
    pub stations: &'a [Station],
    /// Passes of loops through joints; see [`Pass`].
    pub passes: &'a [Pass],
    /// Pairs of passes that are coupled; see [`Pair`].
    pub pairs: &'a [Pair],
    /// Eliminations of loops, in order; see [`End`].
    pub ends: &'a [End],
    /// Couplings of eliminated loops with loops that are eliminated later; see [`LoopCoupling`].
    pub couplings: &'a [LoopCoupling],
    /// Updates of blocks by eliminations; see [`Update`].
    pub updates: &'a [Update],
}

//! Construction of the lists of [`Plan`](crate::link::plan::Plan). They say which rows are coupled while they are carried inward, and in
//! which order loops are eliminated.
//!
//! Ancestors are processed from the outermost inward. At one ancestor the loop with the fewest remaining couplings is eliminated first
//! (minimum degree). The matrix of many loops through the ground therefore remains sparse.

use crate::build::coupling_tables::{Begin, CouplingTables};
use crate::link::Link;
use crate::link::plan::{End, LoopCoupling, Pair, Pass, Plan, Span, Station, Update};
use crate::loops::index;
use crate::rows::Row;
use crate::rows::closed_loop::ClosedLoop;
use crate::space::Space;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;

/// Lists that own the data of the slices in a [`Plan`].
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Order {
    stations: Vec<Station>,
    passes: Vec<Pass>,
    pairs: Vec<Pair>,
    ends: Vec<End>,
    couplings: Vec<LoopCoupling>,
    updates: Vec<Update>,
    /// Number of entries of all blocks.
    pub(crate) n_blocks: usize,
    /// Number of entries of all gains.
    pub(crate) n_gains: usize,
    /// Largest number of sides of one loop. A side is a path from a start of the loop's rows inward to the ancestor.
    pub(crate) n_sides: usize,
}

impl Order {
    pub(crate) fn plan(&self) -> Plan<'_> {
        Plan {
            stations: &self.stations,
            passes: &self.passes,
            pairs: &self.pairs,
            ends: &self.ends,
            couplings: &self.couplings,
            updates: &self.updates,
        }
    }

    /// Makes the elimination order, and sets each loop's ancestor and block.
    pub(crate) fn new<T: Real, S: Space<T>>(
        links: &[Link<T, S>],
        loops: &mut [ClosedLoop<T, S>],
        (rows, couplings): (&[Row<T, S>], &mut CouplingTables<T, S>),
    ) -> Self {
        let stations = vec![Station::default(); links.len()];
        let mut order = Self { stations, n_sides: 2, ..Self::default() };
        let mut alive: Vec<Vec<Pass>> = vec![Vec::new(); links.len()];
        let mut meets: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); loops.len()];
        for (l, lap) in loops.iter_mut().enumerate() {
            let mut starts: Vec<Begin<'_>> = match rows.get(lap.first as usize) {
                Some(Row::Coupled(row)) => couplings.begins(row),
                _ => lap
                    .links
                    .iter()
                    .map(|&link| Begin { link, at_joint: false, side: None })
                    .collect(),
            };
            let n_sides = travel(links, (index(l), lap), &mut starts, &mut alive);
            order.n_sides = order.n_sides.max(n_sides);
        }
        for passes in &alive {
            for x in passes {
                for y in passes.iter().filter(|y| y.lap != x.lap) {
                    meets[x.lap as usize].insert(y.lap as usize);
                }
            }
        }
        let (sequence, later) = eliminate(links.len(), loops, meets);
        let mut turn = vec![0; loops.len()];
        for (t, &l) in sequence.iter().enumerate() {
            turn[l] = t;
        }
        let blocks = order.number_blocks(loops, (&sequence, &later));
        let block = |x: usize, y: usize| {
            if turn[x] >= turn[y] { blocks[&(x, y)] } else { blocks[&(y, x)] }
        };
        for (i, mut passes) in alive.into_iter().enumerate() {
            // The block of a pair has the rows of the loop that is eliminated later.
            passes.sort_by_key(|pass| turn[pass.lap as usize]);
            order.add_passes(links, loops, (i, &mut passes), &block);
        }
        order.add_ends(loops, (&sequence, &later, &turn), &block);
        order
    }

    /// Assigns a block to every loop and to every pair of coupled loops.
    fn number_blocks<T: Real, S: Space<T>>(
        &mut self,
        loops: &mut [ClosedLoop<T, S>],
        (sequence, later): (&[usize], &[Vec<usize>]),
    ) -> BTreeMap<(usize, usize), u32> {
        let mut blocks = BTreeMap::new();
        for &k in sequence {
            loops[k].block = index(self.n_blocks);
            blocks.insert((k, k), loops[k].block);
            self.n_blocks += (loops[k].n * loops[k].n) as usize;
            for &l in &later[k] {
                blocks.insert((l, k), index(self.n_blocks));
                self.n_blocks += (loops[k].n * loops[l].n) as usize;
            }
        }
        blocks
    }

    fn add_passes<T: Real, S: Space<T>>(
        &mut self,
        links: &[Link<T, S>],
        loops: &[ClosedLoop<T, S>],
        (i, passes): (usize, &mut [Pass]),
        block: &impl Fn(usize, usize) -> u32,
    ) {
        let first = self.passes.len();
        let freedoms = links[i].kind.n_freedoms::<T, S>();
        for pass in passes.iter_mut() {
            pass.gain = index(self.n_gains);
            self.n_gains += loops[pass.lap as usize].n as usize * freedoms;
        }
        self.passes.extend_from_slice(passes);
        let first_pair = self.pairs.len();
        if freedoms > 0 {
            for x in 0..passes.len() {
                for y in 0..=x {
                    let block = block(passes[x].lap as usize, passes[y].lap as usize);
                    let (row, column) = (index(first + x), index(first + y));
                    self.pairs.push(Pair { row, column, block });
                    // Two sides of a coupling that pass the same joint contribute twice to the same entry.
                    if x != y && passes[x].lap == passes[y].lap {
                        self.pairs.push(Pair { row: column, column: row, block });
                    }
                }
            }
        }
        self.stations[i].passes = span(first, self.passes.len());
        self.stations[i].pairs = span(first_pair, self.pairs.len());
    }

    fn add_ends<T: Real, S: Space<T>>(
        &mut self,
        loops: &[ClosedLoop<T, S>],
        (sequence, later, turn): (&[usize], &[Vec<usize>], &[usize]),
        block: &impl Fn(usize, usize) -> u32,
    ) {
        let mut last = u32::MAX;
        for &k in sequence {
            let at = loops[k].ancestor;
            let mut others = later[k].clone();
            others.sort_by_key(|&l| turn[l]);
            let (first, first_update) = (self.couplings.len(), self.updates.len());
            for (x, &l) in others.iter().enumerate() {
                // A loop that is also eliminated at this link has the sum of its sides in its first side.
                let passes = &self.passes[self.stations[at as usize].passes.range()];
                let pass = passes.iter().find(|pass| pass.lap as usize == l);
                let side = pass.map_or(0, |pass| pass.side);
                self.couplings.push(LoopCoupling { lap: index(l), side, block: block(l, k) });
                for (y, &other) in others[..=x].iter().enumerate() {
                    let (row, column) = (index(first + x), index(first + y));
                    self.updates.push(Update { row, column, block: block(l, other) });
                }
            }
            let couplings = span(first, self.couplings.len());
            let updates = span(first_update, self.updates.len());
            let here = index(self.ends.len());
            self.ends.push(End { lap: index(k), couplings, updates });
            let station = &mut self.stations[at as usize];
            if at != last {
                station.ends.first = here;
            }
            station.ends.end = here + 1;
            last = at;
        }
    }
}

fn span(first: usize, end: usize) -> Span {
    Span { first: index(first), end: index(end) }
}

/// Sets the ancestor of a loop, and adds the passes of its sides through all joints up to the ancestor. Returns the number of sides. If a
/// side of the loop passes the joint of a joint term, the term uses this side.
fn travel<T: Real, S: Space<T>>(
    links: &[Link<T, S>],
    (l, lap): (u32, &mut ClosedLoop<T, S>),
    starts: &mut [Begin<'_>],
    alive: &mut [Vec<Pass>],
) -> usize {
    let parent = |i: u32| links[i as usize].parent;
    let holds =
        starts.iter().map(|start| if start.at_joint { parent(start.link) } else { start.link });
    lap.ancestor = holds.reduce(|a, b| ancestor(links, [a, b])).unwrap_or(0);
    if starts.iter().any(|start| start.side.is_some()) {
        // Links are sorted from the outermost inward, so that sides from outside pass a joint before its own term is added.
        starts.sort_by_key(|start| (core::cmp::Reverse(start.link), start.at_joint));
    }
    let mut n_sides = 0;
    for start in starts {
        let met = alive[start.link as usize].iter().find(|pass| start.at_joint && pass.lap == l);
        let side = met.map_or(n_sides, |pass| pass.side);
        if let Some(place) = &mut start.side {
            **place = side;
        }
        if met.is_some() {
            continue;
        }
        let mut i = start.link;
        while i != lap.ancestor {
            alive[i as usize].push(Pass { lap: l, side, gain: 0 });
            i = parent(i);
        }
        n_sides += 1;
    }
    n_sides as usize
}

/// Returns the nearest common ancestor of two links.
fn ancestor<T: Real, S: Space<T>>(links: &[Link<T, S>], [mut a, mut b]: [u32; 2]) -> u32 {
    while a != b {
        if a > b {
            a = links[a as usize].parent;
        } else {
            b = links[b as usize].parent;
        }
    }
    a
}

/// Computes the order of elimination. Computes for each loop the loops that are eliminated later and are coupled with it, including
/// coupling by fill.
fn eliminate<T: Real, S: Space<T>>(
    n_links: usize,
    loops: &[ClosedLoop<T, S>],
    mut meets: Vec<BTreeSet<usize>>,
) -> (Vec<usize>, Vec<Vec<usize>>) {
    // Loops to be eliminated at each link, those with the fewest couplings first.
    let mut waiting: Vec<BTreeSet<(usize, usize)>> = vec![BTreeSet::new(); n_links];
    let end = |l: usize| loops[l].ancestor as usize;
    for l in 0..loops.len() {
        waiting[end(l)].insert((meets[l].len(), l));
    }
    let (mut sequence, mut later) = (Vec::new(), vec![Vec::new(); loops.len()]);
    for here in (0..n_links).rev() {
        while let Some((_, k)) = waiting[here].pop_first() {
            let others = core::mem::take(&mut meets[k]);
            for &x in &others {
                waiting[end(x)].remove(&(meets[x].len(), x));
                meets[x].remove(&k);
                meets[x].extend(others.iter().copied().filter(|&y| y != x));
                waiting[end(x)].insert((meets[x].len(), x));
            }
            sequence.push(k);
            later[k] = others.into_iter().collect();
        }
    }
    (sequence, later)
}

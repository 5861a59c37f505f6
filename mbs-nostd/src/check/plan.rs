//! Check of the order of elimination: every index in its lists must refer to an existing entry.

use super::{Look, ends_by, ensure, is_within, sides};
use crate::check::LoadError;
use mbs_core::Real;
use mbs_recursive::rows::coupled;
use mbs_recursive::space::Space;

impl<T: Real, S: Space<T>> Look<'_, '_, T, S> {
    pub(super) fn plan(&self) -> Result<(), LoadError> {
        let (plan, n) = (&self.m.loops.plan, self.m.loops.loops.len());
        ensure(n == 0 || plan.stations.len() == self.sizes.links, "stations", 0)?;
        let is_lap = |lap: u32| (lap as usize) < n;
        for (i, station) in plan.stations.iter().enumerate() {
            let holds = is_within(station.passes, plan.passes.len())
                && is_within(station.pairs, plan.pairs.len())
                && is_within(station.ends, plan.ends.len());
            ensure(holds, "stations", i)?;
        }
        for (i, pass) in plan.passes.iter().enumerate() {
            let has_room = pass.side < 2 || coupled::IS_BUILT;
            ensure(is_lap(pass.lap) && has_room, "passes", i)?;
        }
        for (i, pair) in plan.pairs.iter().enumerate() {
            let rows = |pass: u32| {
                let pass = plan.passes.get(pass as usize)?;
                Some(self.m.loops.loops.get(pass.lap as usize)?.n as usize)
            };
            let holds = match (rows(pair.row), rows(pair.column)) {
                (Some(rows), Some(columns)) => {
                    ends_by(pair.block, rows * columns, self.sizes.blocks)
                }
                _ => false,
            };
            ensure(holds, "pairs", i)?;
        }
        for (i, end) in plan.ends.iter().enumerate() {
            let holds = is_lap(end.lap)
                && is_within(end.couplings, plan.couplings.len())
                && is_within(end.updates, plan.updates.len());
            ensure(holds, "ends", i)?;
        }
        for (i, coupling) in plan.couplings.iter().enumerate() {
            let is_side = sides(coupling.side) <= self.sizes.sides;
            ensure(is_lap(coupling.lap) && is_side, "couplings", i)?;
        }
        for (i, update) in plan.updates.iter().enumerate() {
            let holds = [update.row, update.column]
                .iter()
                .all(|&coupling| (coupling as usize) < plan.couplings.len())
                && (update.block as usize) < self.sizes.blocks;
            ensure(holds, "updates", i)?;
        }
        Ok(())
    }
}

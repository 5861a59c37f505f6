//! Projection of positions and velocities onto the constraints by the least mass-weighted change.

use crate::motion::{Mechanism, State};
use crate::rows::{Frame, Row};
use crate::vector::{add, compose, exponential, normalised};

impl Frame {
    /// Moves the body by a displacement and a rotation vector.
    pub(crate) fn moved(&mut self, by: &[f64; 6]) {
        self.r = add(self.r, [by[0], by[1], by[2]]);
        self.q = normalised(compose(exponential([by[3], by[4], by[5]]), self.q));
        self.angle += by[5];
    }
}

impl Mechanism {
    /// Projects a state onto its constraints. Only the rows marked in `among` are used; the other rows depend on them. Then the angles of
    /// joints are updated.
    pub(crate) fn project(&self, state: &mut State, among: &[bool]) {
        for _ in 0..2 {
            let places = self.places(state);
            let now = self.now(state, &places);
            let all = self.rows(&now).into_iter().zip(among).filter(|(_, kept)| **kept);
            let rows: Vec<Row> = all.map(|((_, row), _)| row).filter(|r| !r.of_rates).collect();
            let saddle = self.saddle(&places, &rows, &self.rotors(&now));
            let right: Vec<f64> = rows.iter().map(|r| -r.value).collect();
            let none = vec![[0.0; 6]; state.frames.len()];
            let (moves, _, _) = self.solve(&saddle, &none, &right);
            state.frames.iter_mut().zip(&moves).for_each(|(f, m)| f.moved(m));
        }
        self.count_turns(state);
        self.project_velocities(state, Some(among), &[]);
    }

    /// Projects velocities onto the constraints, and onto further rows whose rates are given.
    pub(crate) fn project_velocities(
        &self,
        state: &mut State,
        among: Option<&[bool]>,
        held: &[Row],
    ) -> f64 {
        let places = self.places(state);
        let now = self.now(state, &places);
        let kept = |i: usize| among.is_none_or(|kept| kept[i]);
        let all = self.rows(&now).into_iter().enumerate().filter(|(i, _)| kept(*i));
        let mut rows: Vec<Row> = all.map(|(_, (_, row))| row).collect();
        rows.extend_from_slice(held);
        let saddle = self.saddle(&places, &rows, &self.rotors(&now));
        let right: Vec<f64> = rows.iter().map(|r| r.given[0] - r.rate(&places)).collect();
        let none = vec![[0.0; 6]; state.frames.len()];
        let (changes, _, unmet) = self.solve(&saddle, &none, &right);
        for (frame, c) in state.frames.iter_mut().zip(&changes) {
            frame.v = add(frame.v, [c[0], c[1], c[2]]);
            frame.w = add(frame.w, [c[3], c[4], c[5]]);
        }
        unmet
    }

    /// Updates the angles of all joints. Of the angles that differ by whole turns, the one nearest to the value before is used.
    pub(crate) fn count_turns(&self, state: &mut State) {
        let places = self.places(state);
        state.turns = self.now(state, &places).measured_turns();
    }
}

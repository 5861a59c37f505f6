//! Steps of order 8: Gragg's midpoint rule, extrapolated over 2, 4, 6 and 8 parts of the step, with an estimate of its error.

use crate::motion::{Mechanism, State};
use crate::vector::{compose, scale};

/// Numbers of parts of the step in the rows of the extrapolation table.
const PARTS: [usize; 4] = [2, 4, 6, 8];
/// Ratio of a longer trial step to a step [-]. The extrapolation does not evaluate the last eighth of a step. The longer step evaluates
/// there, and so detects a kink.
const BEYOND: f64 = 8.0 / 7.0;
/// Largest number of steps in one call. Chosen, not tuned.
const MOST_TRIALS: usize = 1_000;

/// Reason why a run stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stop {
    /// Steps become too small at this time.
    Steps(f64),
    /// State that is not finite at this time.
    NotFinite(f64),
}

impl Mechanism {
    fn pack(state: &State) -> Vec<f64> {
        let mut y = Vec::with_capacity(14 * state.frames.len() + 3 * state.turns.len() + 1);
        for f in &state.frames {
            y.extend(f.r.iter().chain(&f.q).chain([&f.angle]).chain(&f.v).chain(&f.w));
        }
        y.extend(state.turns.iter().flatten());
        y.extend(&state.memory);
        y.push(state.work);
        y
    }

    fn unpack(&self, y: &[f64], t: f64) -> State {
        let mut state = self.reference();
        state.t = t;
        let (bodies, rest) = y.split_at(14 * state.frames.len());
        for (f, y) in state.frames.iter_mut().zip(bodies.chunks_exact(14)) {
            f.r.copy_from_slice(&y[..3]);
            f.q.copy_from_slice(&y[3..7]);
            f.angle = y[7];
            f.v.copy_from_slice(&y[8..11]);
            f.w.copy_from_slice(&y[11..]);
        }
        for (turns, y) in state.turns.iter_mut().zip(rest.chunks_exact(3)) {
            turns.copy_from_slice(y);
        }
        let n = state.memory.len();
        state.memory.copy_from_slice(&rest[rest.len() - 1 - n..rest.len() - 1]);
        state.work = rest.last().copied().unwrap_or(0.0);
        state
    }

    fn derivative(&self, y: &[f64], t: f64, among: &[bool]) -> Vec<f64> {
        let state = self.unpack(y, t);
        let moved = self.evaluate_among(&state, Some(among));
        let mut rates = Vec::with_capacity(y.len());
        for (f, a) in state.frames.iter().zip(&moved.accelerations) {
            let half = scale(0.5, f.w);
            rates.extend(f.v);
            rates.extend(compose([0.0, half[0], half[1], half[2]], f.q));
            rates.push(f.w[2]);
            rates.extend(a);
        }
        let places = self.places(&state);
        let now = self.now(&state, &places);
        for (j, joint) in self.scene.joints.iter().enumerate() {
            let turning = joint.turning(self.scene.planar);
            let mut of = [0.0; 3];
            // a rotation vector is followed only by choosing the nearest of its equivalents
            if (1..3).contains(&turning.len()) {
                let rows = now.coordinates(j);
                rows[turning].iter().zip(&mut of).for_each(|(row, x)| *x = row.rate(&places));
            }
            rates.extend(of);
        }
        for number in 0..self.scene.wheels.len() {
            rates.extend([now.wheel(number).rate(&places), 0.0, 0.0]);
        }
        rates.extend(self.scene.signals.iter().map(|signal| now.memory_rate(&signal.source)));
        rates.push(moved.power);
        rates
    }

    /// One step without projection. Returns also the difference of the two best values, relative to the sizes of the state.
    fn extrapolate(
        &self,
        (y, first): (&[f64], &[f64]),
        among: &[bool],
        t: f64,
        h: f64,
    ) -> (Vec<f64>, Vec<f64>) {
        let mut table: Vec<Vec<f64>> = Vec::new();
        let mut second_best = Vec::new();
        for (k, &n) in PARTS.iter().enumerate() {
            let part = h / n as f64;
            let mut before = y.to_vec();
            let mut at: Vec<f64> = y.iter().zip(first).map(|(y, f)| y + part * f).collect();
            for i in 1..n {
                let rates = self.derivative(&at, t + part * i as f64, among);
                let next = before.iter().zip(&rates).map(|(y, f)| y + 2.0 * part * f).collect();
                before = std::mem::replace(&mut at, next);
            }
            // Gragg's sequence with an even number n of parts of length h has an error expansion in h² without the final smoothing
            let mut row = vec![at];
            for j in 1..=k {
                let ratio = (n as f64 / PARTS[k - j] as f64).powi(2);
                let finer: &Vec<f64> = &row[j - 1];
                let coarser = &table[j - 1];
                let next =
                    finer.iter().zip(coarser).map(|(x, y)| x + (x - y) / (ratio - 1.0)).collect();
                row.push(next);
            }
            if k + 1 == PARTS.len() {
                second_best = row[k - 1].clone();
            }
            table = row;
        }
        let best = table.pop().unwrap_or_default();
        let error = best.iter().zip(&second_best).map(|(x, y)| (x - y).abs()).collect();
        (best, error)
    }

    /// One step of order 8, followed by the projection onto the constraints.
    #[must_use]
    pub fn step(&self, state: &State, h: f64) -> State {
        let y = Self::pack(state);
        let among = self.independent(state);
        let first = self.derivative(&y, state.t, &among);
        let (next, _) = self.extrapolate((&y, &first), &among, state.t, h);
        let mut next = self.unpack(&next, state.t + h);
        self.project(&mut next, &among);
        next
    }

    /// Integrates up to a time by steps of controlled length. `h` is the first step, and is set to the step for the next call.
    ///
    /// # Errors
    /// [`Stop`] where steps become too small.
    pub fn advance(
        &self,
        state: &mut State,
        end: f64,
        h: &mut f64,
        tolerance: f64,
    ) -> Result<(), Stop> {
        let span = end - state.t;
        let mut trials = 0;
        let corners = self.corners();
        while state.t < end - 1e-12 * span {
            // steps end where a signal jumps or has a corner
            let next = corners.iter().find(|t| **t > state.t && **t < end);
            let limit = next.copied().unwrap_or(end);
            let length = h.min(limit - state.t);
            let lands = next.is_some() && length >= limit - state.t;
            let y = Self::pack(state);
            let among = self.independent(state);
            let first = self.derivative(&y, state.t, &among);
            let (next, error) = self.extrapolate((&y, &first), &among, state.t, length);
            let mut ratio = self.error_ratio(&y, &next, &error, span, tolerance);
            if ratio <= 1.0 && !lands {
                let beyond = length * BEYOND;
                let (next, error) = self.extrapolate((&y, &first), &among, state.t, beyond);
                ratio = ratio.max(self.error_ratio(&y, &next, &error, span, tolerance));
            }
            if !ratio.is_finite() && length < 1e-9 * span {
                return Err(Stop::NotFinite(state.t));
            }
            let factor = if ratio.is_finite() {
                (0.8 * ratio.powf(-1.0 / 7.0)).clamp(0.2, 4.0)
            } else {
                0.2
            };
            if ratio <= 1.0 {
                let t = if lands { limit } else { state.t + length };
                *state = self.unpack(&next, t);
                self.project(state, &among);
                // an accepted step that the end cut short does not shorten later steps
                *h = if length < *h { h.max(length * factor) } else { length * factor };
            } else {
                *h = length * factor;
            }
            trials += 1;
            if trials > MOST_TRIALS || *h < 1e-11 * span {
                return Err(Stop::Steps(state.t));
            }
        }
        state.t = end;
        Ok(())
    }

    /// The largest error relative to the allowed one. Places are relative to the mechanism's length, and quaternions to one. Velocities are
    /// relative to the largest one, or to 0.01 lengths or radians per `span` where this is larger.
    fn error_ratio(
        &self,
        y: &[f64],
        next: &[f64],
        error: &[f64],
        span: f64,
        tolerance: f64,
    ) -> f64 {
        let length = self.length();
        let fastest = y.chunks_exact(14).take(self.scene.bodies.len());
        let speed = fastest
            .clone()
            .map(|b| b[8..11].iter().fold(0.0, |a: f64, x| a.max(x.abs())))
            .fold(0.0, f64::max);
        let spin = fastest
            .map(|b| b[11..].iter().fold(0.0, |a: f64, x| a.max(x.abs())))
            .fold(0.0, f64::max);
        let bodies = 14 * self.scene.bodies.len();
        let mut worst = 0.0_f64;
        for (i, e) in error.iter().enumerate().take(bodies) {
            let allowed = match i % 14 {
                0..=2 => length,
                3..=7 => 1.0,
                8..=10 => speed.max(length / span * 0.01),
                _ => spin.max(0.01 / span),
            };
            let ratio = e / (tolerance * allowed);
            if !ratio.is_finite() || !next[i].is_finite() {
                return f64::NAN;
            }
            worst = worst.max(ratio);
        }
        // states of signals: relative to their value or their change
        let n = self.scene.signals.len();
        let first = error.len() - 1 - n;
        for i in first..first + n {
            let allowed = next[i].abs().max((next[i] - y[i]).abs()).max(1e-3);
            worst = worst.max(error[i] / (tolerance * allowed));
        }
        worst.max(1e-10)
    }

    /// Times at which signals jump or have a corner, in increasing order.
    fn corners(&self) -> Vec<f64> {
        let mut times = Vec::new();
        self.scene.signals.iter().for_each(|signal| signal.source.corners(&mut times));
        times.sort_by(f64::total_cmp);
        times
    }

    /// A length of the mechanism: the largest distance of its points from their mean.
    #[must_use]
    pub fn length(&self) -> f64 {
        let points = self
            .scene
            .bodies
            .iter()
            .map(|b| b.center)
            .chain(self.scene.joints.iter().flat_map(|j| j.points));
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for p in points {
            for i in 0..3 {
                low[i] = low[i].min(p[i]);
                high[i] = high[i].max(p[i]);
            }
        }
        let size = (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max);
        if size > 0.0 && size.is_finite() { size } else { 1.0 }
    }
}

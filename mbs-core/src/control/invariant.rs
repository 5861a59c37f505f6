//! The energy invariant of a run, watched from step to step.
//!
//! ```text
//! Pi = T + V - W = constant,   W work of dampers, courses and guides                  [P2 (31)]
//! G <- max(0, G + d(T + V) - dW)          where nothing damps:  dW what enters or leaves
//! G <- max(0, G + d(T + V) - max(0, dW))  where dampers act
//! ```
//!
//! W sums powers at the ends of steps. That overestimates the work of a damper that brings a motion to rest within a step: Pi rises, and
//! no energy does. G is the energy that came from nowhere.

/// Rounding of the energy balance, in units of the precision times the sum of its parts [-]. Chosen, not tuned.
const ROUNDINGS: f64 = 64.0;

/// Energy invariant Pi, with its changes and errors so far. Energies in joules.
///
/// Cost of a step: some thirty operations, in `f64` for every scalar.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Invariant {
    initial: f64,
    last: [f64; 3],
    error: f64,
    max_error: f64,
    max_kinetic: f64,
    potential: [f64; 2],
    gross_work: f64,
    /// Energy that is rounding, for one epsilon.
    ground: f64,
    epsilon: f64,
    /// Energy may be taken by dampers.
    is_damped: bool,
    growth: f64,
    line: Line,
}

/// Sums of the scatter and of the straight line through the errors.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Line {
    n: f64,
    squares: f64,
    /// Means of time and error, and sums of their products about them.
    t: f64,
    e: f64,
    tt: f64,
    te: f64,
}

impl Invariant {
    /// Starts from kinetic energy, potential energy and work [J]. `ground` is the energy that the scene's loads have anyway [J], such as
    /// its weight times its length: a root of the precision of it is nothing. `epsilon` is that of the scalar; energies
    /// are no finer than `f64`.
    #[must_use]
    pub fn new(energies: [f64; 3], ground: f64, epsilon: f64) -> Self {
        let [kinetic, potential, work] = energies;
        Self {
            initial: kinetic + potential - work,
            last: energies,
            error: 0.0,
            max_error: 0.0,
            max_kinetic: kinetic,
            potential: [potential; 2],
            gross_work: 0.0,
            ground,
            epsilon: epsilon.max(f64::EPSILON),
            is_damped: false,
            growth: 0.0,
            line: Line::default(),
        }
    }

    /// Says whether dampers act: a loss is then no measure of an error, a gain without a source is.
    #[must_use]
    pub fn with_dampers(self, is_damped: bool) -> Self {
        Self { is_damped, ..self }
    }

    /// Takes the energies after a step that ended at `t` [s].
    pub fn mark(&mut self, t: f64, energies: [f64; 3]) {
        let change = self.change(energies);
        let [kinetic, potential, work] = energies;
        self.error = kinetic + potential - work - self.initial;
        let size = self.error.abs();
        if size > self.max_error || size.is_nan() {
            self.max_error = size;
        }
        self.max_kinetic = self.max_kinetic.max(kinetic);
        self.potential = [self.potential[0].min(potential), self.potential[1].max(potential)];
        let entered = work - self.last[2];
        self.gross_work += entered.abs();
        let taken = if self.is_damped { entered.min(0.0) } else { 0.0 };
        self.growth = (self.growth + change + taken).max(0.0);
        self.last = energies;
        self.line.take(t, self.error, change);
    }

    /// Kinetic energy, potential energy and work after the last step [J].
    #[must_use]
    pub fn energies(&self) -> [f64; 3] {
        self.last
    }

    /// Invariant Pi(0) at the start [J].
    #[must_use]
    pub fn initial(&self) -> f64 {
        self.initial
    }

    /// Pi(t) - Pi(0) after the last step [J].
    #[must_use]
    pub fn error(&self) -> f64 {
        self.error
    }

    /// The largest |Pi(t) - Pi(0)| so far [J].
    #[must_use]
    pub fn max_error(&self) -> f64 {
        self.max_error
    }

    /// Change of Pi that energies after a step would make [J].
    #[must_use]
    pub fn change(&self, [kinetic, potential, work]: [f64; 3]) -> f64 {
        let [k, p, w] = self.last;
        (kinetic - k) + (potential - p) - (work - w)
    }

    /// The energy turned over: largest kinetic energy plus gross work [J].
    #[must_use]
    pub fn turned_over(&self) -> f64 {
        self.max_kinetic + self.gross_work
    }

    /// Scale of changes within a step, with `energies` at its end: the largest kinetic energy plus the range of the potential one [J]. It
    /// does not grow with the length of a run, and knows no zero of the potential energy.
    #[must_use]
    pub fn scale(&self, [kinetic, potential, _]: [f64; 3]) -> f64 {
        let range = self.potential[1].max(potential) - self.potential[0].min(potential);
        self.max_kinetic.max(kinetic) + range
    }

    /// A change of this size may be rounding of the energies [J].
    #[must_use]
    pub fn rounding(&self) -> f64 {
        let [kinetic, potential, work] = self.last;
        let parts = kinetic + potential.abs() + work.abs() + self.ground;
        ROUNDINGS * self.epsilon * parts
    }

    /// Has more energy moved so far than what is rounding of the energy that is stored?
    #[must_use]
    pub fn is_moving(&self) -> bool {
        self.scale(self.last) > self.stored_rounding()
    }

    /// Energy that is rounding of what is stored [J].
    fn stored_rounding(&self) -> f64 {
        (self.last[0] + self.last[1].abs()).max(self.ground) * libm::sqrt(self.epsilon)
    }

    /// Is the invariant off by more than `share` of the exchanged energy, lost or gained without a source? Nothing is
    /// said while that is rounding of what is stored, or of the ground. A NaN is off.
    #[must_use]
    pub fn is_off(&self, share: f64) -> bool {
        let limit = (share * self.turned_over()).max(self.stored_rounding());
        let is_given = self.error > 0.0 && self.growth <= limit;
        !(self.error.abs() <= limit || is_given)
    }

    /// Root of the mean square of the changes from step to step [J].
    #[must_use]
    pub fn scatter(&self) -> f64 {
        if self.line.n > 0.0 { libm::sqrt(self.line.squares / self.line.n) } else { 0.0 }
    }

    /// Slope of the straight line through the errors after all steps, by least squares [W].
    #[must_use]
    pub fn drift(&self) -> f64 {
        if self.line.tt > 0.0 { self.line.te / self.line.tt } else { 0.0 }
    }
}

impl Invariant {
    /// Count of the numbers of a [`history`](Self::history): its fields in order.
    pub const N_HISTORY: usize = 17;

    /// The measurements so far, as numbers, from which a run resumes.
    #[must_use]
    pub fn history(&self) -> [f64; Self::N_HISTORY] {
        let Self { initial, last: [k, p, w], error, max_error, max_kinetic, .. } = *self;
        let ([least, most], gross, l) = (self.potential, self.gross_work, self.line);
        let seen = [initial, k, p, w, error, max_error, max_kinetic, least, most, gross];
        let line = [l.n, l.squares, l.t, l.e, l.tt, l.te, self.growth];
        core::array::from_fn(|i| if i < seen.len() { seen[i] } else { line[i - seen.len()] })
    }

    /// Restores a [`history`](Self::history) of the same scene.
    pub fn set_history(&mut self, history: [f64; Self::N_HISTORY]) {
        let [initial, k, p, w, error, max_error, max_kinetic, least, most, gross, rest @ ..] =
            history;
        let [n, squares, t, e, tt, te, growth] = rest;
        *self = Self {
            initial,
            last: [k, p, w],
            error,
            max_error,
            max_kinetic,
            potential: [least, most],
            gross_work: gross,
            growth,
            line: Line { n, squares, t, e, tt, te },
            ..*self
        };
    }
}

impl Line {
    /// Adds one more point.
    fn take(&mut self, t: f64, error: f64, change: f64) {
        self.n += 1.0;
        self.squares += change * change;
        let (dt, de) = (t - self.t, error - self.e);
        self.t += dt / self.n;
        self.e += de / self.n;
        self.tt += dt * (t - self.t);
        self.te += dt * (error - self.e);
    }
}

//! Energy invariant of a run, recorded from step to step.
//!
//! ```text
//! Pi = T + V - W = constant,   T, V: kinetic and potential energy,  W: work of dampers, signals and guides   [P2 (31)]
//! G <- max(0, G + d(T + V) - dW)          without dampers
//! G <- max(0, G + d(T + V) - max(0, dW))  with dampers
//! ```
//!
//! d denotes the change in a step; dW is the energy that enters. W is a sum of powers at the ends of steps. It overestimates the work of a
//! damper that stops a motion within a step. Pi then rises, although no energy enters. G is the energy gained without a source.

/// Rounding error of the energy balance, in multiples of machine precision times the sum of its parts [-]. Chosen, not tuned.
const ROUNDINGS: f64 = 64.0;

/// Energy invariant Pi with its changes and errors so far. Energies are in joules.
///
/// Cost of a step: some thirty operations, in `f64` for every scalar of the run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Invariant {
    initial: f64,
    last: [f64; 3],
    error: f64,
    max_error: f64,
    max_kinetic: f64,
    potential: [f64; 2],
    gross_work: f64,
    /// Energy scale of the scene's loads, for rounding errors [J].
    ground: f64,
    epsilon: f64,
    /// Whether dampers may remove energy.
    is_damped: bool,
    growth: f64,
    line: Line,
}

/// Sums for the mean square of the changes, and for the least-squares line through the errors.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Line {
    n: f64,
    squares: f64,
    /// Means t of time and e of error. `tt` and `te` are sums of squares and products about the means.
    t: f64,
    e: f64,
    tt: f64,
    te: f64,
}

impl Invariant {
    /// Starts from kinetic energy, potential energy and work [J]. `ground` is an energy scale of the scene's loads [J], such as its weight
    /// times its length. Energies below the square root of `epsilon` times this scale count as zero. `epsilon` is the machine precision of
    /// the scalar, here at least that of `f64`.
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

    /// Sets whether dampers act. If they do, G leaves out the work that they remove, since W overestimates it.
    #[must_use]
    pub fn with_dampers(self, is_damped: bool) -> Self {
        Self { is_damped, ..self }
    }

    /// Records the energies after a step that ended at time `t` [s].
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

    /// Error Pi(t) - Pi(0) after the last step [J].
    #[must_use]
    pub fn error(&self) -> f64 {
        self.error
    }

    /// Largest |Pi(t) - Pi(0)| so far [J].
    #[must_use]
    pub fn max_error(&self) -> f64 {
        self.max_error
    }

    /// Change of Pi between the last step and the given energies [J].
    #[must_use]
    pub fn change(&self, [kinetic, potential, work]: [f64; 3]) -> f64 {
        let [k, p, w] = self.last;
        (kinetic - k) + (potential - p) - (work - w)
    }

    /// Exchanged energy: largest kinetic energy plus gross work [J].
    #[must_use]
    pub fn turned_over(&self) -> f64 {
        self.max_kinetic + self.gross_work
    }

    /// Energy scale for changes within a step that ends with `energies` [J]: the largest kinetic energy plus the range of the potential
    /// energy. It does not grow with the length of a run and does not depend on the zero of the potential energy.
    #[must_use]
    pub fn scale(&self, [kinetic, potential, _]: [f64; 3]) -> f64 {
        let range = self.potential[1].max(potential) - self.potential[0].min(potential);
        self.max_kinetic.max(kinetic) + range
    }

    /// Largest change that may be a rounding error of the energies [J].
    #[must_use]
    pub fn rounding(&self) -> f64 {
        let [kinetic, potential, work] = self.last;
        let parts = kinetic + potential.abs() + work.abs() + self.ground;
        ROUNDINGS * self.epsilon * parts
    }

    /// True if more energy has moved so far than the rounding error of the stored energy.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        self.scale(self.last) > self.stored_rounding()
    }

    /// Energy that may be a rounding error of the stored energy [J].
    fn stored_rounding(&self) -> f64 {
        (self.last[0] + self.last[1].abs()).max(self.ground) * libm::sqrt(self.epsilon)
    }

    /// True if the error of the invariant exceeds `share` times the exchanged energy. A gain of energy counts only if G exceeds the limit
    /// too: only then does the gain have no source. An error below the rounding error of the stored energy does not count. A NaN exceeds
    /// every limit.
    #[must_use]
    pub fn is_off(&self, share: f64) -> bool {
        let limit = (share * self.turned_over()).max(self.stored_rounding());
        let is_given = self.error > 0.0 && self.growth <= limit;
        !(self.error.abs() <= limit || is_given)
    }

    /// Root mean square of the changes of Pi from step to step [J].
    #[must_use]
    pub fn scatter(&self) -> f64 {
        if self.line.n > 0.0 { libm::sqrt(self.line.squares / self.line.n) } else { 0.0 }
    }

    /// Slope of the least-squares line through the errors after all steps [W].
    #[must_use]
    pub fn drift(&self) -> f64 {
        if self.line.tt > 0.0 { self.line.te / self.line.tt } else { 0.0 }
    }
}

impl Invariant {
    /// Number of values in a [`history`](Self::history).
    pub const N_HISTORY: usize = 17;

    /// Record so far, as numbers from which a run resumes.
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
    /// Adds a point to the sums.
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

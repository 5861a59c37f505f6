//! Examination along the motion: its distance from singular positions, and corners of loops that become straight.
//!
//! ```text
//! κ(t) = σ_r / σ₁,   r: the largest rank met on the way
//! ```
//!
//! σ₁ is the largest singular value of the constraint equations at time t, and σ_r the r-th largest. At a zero, κ is the absolute value of a
//! smooth function. Near the smallest sample, the sign of later samples is therefore reversed. A cubic is put through two samples before and
//! two after it. If the cubic fits the sample between them, κ passes through zero at the cubic's root. Otherwise the minimum is that of the
//! parabola through three values of κ².

use super::basis::{Effort, places, stopped};
use super::finding::{Finding, Severity, Topic, joint_names};
use crate::redundancy::{Linkage, Loop, Part, Poses, Rank, loops};
use crate::stretches::stretches;
use core::ops::ControlFlow;
use mbs::inside::{SAME_LENGTH, drive};
use mbs::typed::{Simulation, StepObserver};
use mbs::{ResolvedMethod, StopError};
use mbs_core::control::Accepted;
use mbs_core::scene::{Entry, Scene};
use mbs_scene::format::few;
use std::time::Instant;

/// Observations along the motion: the time reached, singular positions, corners of loops, and the reason of a stop.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Formulation of the run.
    pub formulation: &'static str,
    /// Number of examined positions.
    pub positions: u64,
    /// Time that was reached [s].
    pub reached: f64,
    /// Duration of the run that was requested [s].
    pub duration: f64,
    /// True if the examination reached its time limit before the end of the run.
    pub is_cut_short: bool,
    /// The nearest singular position of each part with loops.
    pub nearest: Vec<Nearest>,
    /// Corners of loops, in the order of the loops.
    pub corners: Vec<LinearMotion>,
    /// Reason why the run stopped: code, message and hint.
    pub error: Option<(&'static str, String, &'static str)>,
    /// Entry of the scene that the error concerns.
    pub entry: Option<Entry>,
}

/// Nearest singular position of a part.
#[derive(Debug, Clone, PartialEq)]
pub struct Nearest {
    /// Time of the singular position [s].
    pub time: f64,
    /// Ratio κ of the smallest to the largest singular value at this time [-]; zero in a singular position.
    pub sigma: f64,
    /// Ratio κ of the smallest to the largest singular value at the start [-].
    pub sigma_at_start: f64,
    /// Rank of the equations in this position, and at the start.
    pub rank: [usize; 2],
    /// Joints whose equations nearly depend on each other in this position.
    pub joints: Vec<usize>,
    /// Times at which the part passes a singular position [s].
    pub passages: Vec<f64>,
}

/// A corner of a loop along the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearMotion {
    /// Index of the loop.
    pub lap: usize,
    /// Joint in the corner of the loop.
    pub joint: usize,
    /// Angle of the corner at the start [rad].
    pub turn: f64,
    /// Smallest angle between the corner and a straight line [rad], and its time [s].
    pub least: [f64; 2],
    /// First time at which the corner was bent to the other side [s].
    pub changed: Option<f64>,
}

/// Value of κ below which the motion passes a singular position [-]. Chosen, not tuned.
const SINGULAR: f64 = 1e-3;
/// Largest number of joints of a part that is examined along the motion: decompositions of larger parts take minutes.
const LARGEST: usize = 200;
/// Largest number of operations of all decompositions [-]. It limits the number of positions for large parts. Chosen, not tuned.
const WORK: f64 = 2e10;
/// Operations of a decomposition into singular values and vectors, relative to the cube of its columns [-].
const SVD_WORK: f64 = 20.0;
/// Component of a unit null vector above which its joint is named [-]. Chosen, not tuned.
const MEMBER_PART: f64 = 0.05;

struct Watch<'a> {
    scene: &'a Scene<f64>,
    linkage: &'a Linkage,
    tracks: Vec<Track<'a>>,
    corners: Vec<LinearMotion>,
}

/// Samples of one part along the motion.
struct Track<'a> {
    part: &'a Part,
    rank: [usize; 2],
    /// Time and κ of each position since the last increase of the rank.
    kappa: Vec<[f64; 2]>,
    at_start: f64,
    joints: Vec<usize>,
}

/// Runs the scene and examines positions along the run.
pub(super) fn watch<const D: usize>(
    scene: &Scene<f64>,
    settings: &ResolvedMethod,
    (linkage, effort): (&Linkage, &Effort),
) -> Motion {
    let mut motion = Motion {
        formulation: settings.formulation.name(),
        positions: 0,
        reached: 0.0,
        duration: settings.duration,
        is_cut_short: false,
        nearest: Vec::new(),
        corners: Vec::new(),
        error: None,
        entry: None,
    };
    let mut simulation = match Simulation::<f64, D>::new(scene, settings) {
        Ok(simulation) => simulation,
        Err(error) => {
            let (message, hint) = stopped(scene, &error, 0.0);
            (motion.error, motion.entry) = (Some((error.code(), message, hint)), error.entry());
            return motion;
        }
    };
    let mut watch = Watch::new(scene, linkage);
    watch.look(0.0, &places(scene, simulation.model(), simulation.state()));
    motion.positions = 1;
    let every = settings.duration / positions(linkage, effort);
    let clock = Instant::now();
    let has_time = || clock.elapsed().as_secs_f64() <= effort.seconds;
    let stretches = stretches(scene, settings, simulation.is_controlled());
    let mut look =
        Look { watch: &mut watch, motion: &mut motion, every, next: every, has_time: &has_time };
    if let Err(stop) = drive(&mut simulation, stretches, &settings.interrupt, &mut look) {
        let (message, hint) = stopped(scene, &stop, motion.reached);
        (motion.error, motion.entry) = (Some((stop.code(), message, hint)), stop.entry());
    }
    motion.nearest = watch.tracks.iter().map(Track::nearest).collect();
    motion.corners = watch.corners;
    motion
}

/// Observer that examines positions along a run until its time limit.
struct Look<'a, 'b> {
    watch: &'a mut Watch<'b>,
    motion: &'a mut Motion,
    /// Time between two examined positions [s].
    every: f64,
    next: f64,
    has_time: &'a dyn Fn() -> bool,
}

impl<const D: usize> StepObserver<f64, D> for Look<'_, '_> {
    fn step(
        &mut self,
        now: &Simulation<f64, D>,
        _: &Accepted<f64>,
        is_last: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        let Self { watch, motion, every, next, .. } = self;
        let t = now.state().t;
        motion.reached = t;
        if t >= *next * (1.0 - SAME_LENGTH) {
            watch.look(t, &places(watch.scene, now.model(), now.state()));
            motion.positions += 1;
            *next += *every * ((t - *next) / *every).floor().max(0.0) + *every;
        }
        let has_time = (self.has_time)();
        self.motion.is_cut_short = !has_time && !is_last;
        Ok(mbs::inside::continue_if(has_time))
    }
}

/// Returns the number of positions at which the equations are decomposed.
fn positions(linkage: &Linkage, effort: &Effort) -> f64 {
    let watched = linkage.parts.iter().filter(|p| is_watched(p));
    let work =
        watched.map(|p| SVD_WORK * (p.bodies.len() * linkage.freedoms()).pow(3) as f64).sum();
    (effort.positions as f64).min((WORK / f64::max(work, 1.0)).ceil())
}

fn is_watched(part: &Part) -> bool {
    part.has_loop() && part.joints.len() <= LARGEST
}

impl<'a> Watch<'a> {
    fn new(scene: &'a Scene<f64>, linkage: &'a Linkage) -> Self {
        let parts = linkage.parts.iter().filter(|p| is_watched(p));
        let track = |part| Track {
            part,
            rank: [0; 2],
            kappa: Vec::new(),
            at_start: 0.0,
            joints: Vec::new(),
        };
        Self { scene, linkage, tracks: parts.map(track).collect(), corners: Vec::new() }
    }

    fn look(&mut self, t: f64, at: &Poses) {
        for track in &mut self.tracks {
            track.look(self.linkage, t, at);
        }
        if self.scene.joints.len() > LARGEST {
            return;
        }
        let all = loops(self.linkage, at);
        let corners = || {
            all.iter()
                .enumerate()
                .flat_map(|(lap, of): (usize, &Loop)| of.corners.iter().map(move |c| (lap, c)))
        };
        if t == 0.0 {
            let straight = |(lap, c): (usize, &crate::redundancy::Corner)| LinearMotion {
                lap,
                joint: c.joint,
                turn: c.turn,
                least: [c.distance(), 0.0],
                changed: None,
            };
            self.corners = corners().map(straight).collect();
        }
        for (lap, corner) in corners() {
            // a corner vanishes if two points of its loop coincide
            let Some(of) =
                self.corners.iter_mut().find(|s| s.lap == lap && s.joint == corner.joint)
            else {
                continue;
            };
            if corner.distance() < of.least[0] {
                of.least = [corner.distance(), t];
            }
            if corner.has_sign && corner.turn * of.turn < 0.0 {
                of.changed.get_or_insert(t);
            }
        }
    }
}

impl Track<'_> {
    fn look(&mut self, linkage: &Linkage, t: f64, at: &Poses) {
        let jacobian = linkage.jacobian(self.part, at);
        let Some(rank) = Rank::of(&jacobian.matrix) else { return };
        let here = rank.sizes[2];
        let is_first = self.rank == [0; 2];
        if is_first {
            self.rank = [here, here];
            self.at_start = rank.least();
        } else if here > self.rank[0] {
            // earlier positions had a lower rank, so they were singular
            self.rank[0] = here;
            self.kappa.iter_mut().for_each(|sample| sample[1] = 0.0);
            if self.kappa.iter().any(|sample| sample[0] <= 0.0) {
                self.at_start = 0.0;
            }
        }
        let Some(last) = self.rank[0].checked_sub(1) else { return };
        let kappa = if here < self.rank[0] { 0.0 } else { rank.sigma[last] / rank.sigma[0] };
        if self.kappa.iter().all(|sample| kappa < sample[1]) || self.joints.is_empty() {
            let weights = rank.combination(last);
            let weight = |range: &std::ops::Range<usize>| {
                range.clone().map(|row| weights[row] * weights[row]).sum::<f64>()
            };
            let joints = self.part.joints.iter().zip(&jacobian.rows);
            let taken = joints.filter(|(_, range)| weight(range) > MEMBER_PART * MEMBER_PART);
            self.joints = taken.map(|(&joint, _)| joint).collect();
        }
        self.kappa.push([t, kappa]);
    }

    fn nearest(&self) -> Nearest {
        let n = self.kappa.len();
        let at = |i: usize| self.kappa.get(i).map_or(f64::INFINITY, |sample| sample[1]);
        let is_low = |i: &usize| at(*i) < at(i.wrapping_sub(1)) && at(*i) <= at(i + 1);
        let lows: Vec<[f64; 2]> = (0..n).filter(is_low).map(|i| refined(&self.kappa, i)).collect();
        let least = lows.iter().copied().min_by(|a, b| a[1].total_cmp(&b[1]));
        let [time, sigma] = least.unwrap_or(self.kappa.first().copied().unwrap_or([0.0, 1.0]));
        let passed = lows.iter().filter(|low| low[0] > 0.0 && low[1] < SINGULAR);
        Nearest {
            time,
            sigma,
            sigma_at_start: self.at_start,
            rank: self.rank,
            joints: self.joints.clone(),
            passages: passed.map(|low| low[0]).collect(),
        }
    }
}

/// Time and value of the minimum of κ near sample `i`, which is smaller than its neighbours.
pub fn refined(kappa: &[[f64; 2]], i: usize) -> [f64; 2] {
    let low = touched(kappa, i);
    match crossed(kappa, i) {
        // the zero counts only if the cubic fits the samples better than the parabola's minimum
        Some(crossing) if crossing[1] < low[1].min(SINGULAR) => crossing,
        _ => low,
    }
}

/// Returns the time at which κ passes zero, and the deviation of the samples from the cubic.
fn crossed(kappa: &[[f64; 2]], i: usize) -> Option<[f64; 2]> {
    if i < 2 || i + 2 >= kappa.len() {
        return None;
    }
    let [before, behind] = [[i - 2, i - 1], [i + 1, i + 2]];
    let points: Vec<[f64; 2]> = before
        .iter()
        .map(|&k| kappa[k])
        .chain(behind.iter().map(|&k| [kappa[k][0], -kappa[k][1]]))
        .collect();
    let [t, value] = kappa[i];
    // these are the weights of Lagrange's interpolation at time t
    let weight = |a: usize| {
        let others = (0..4).filter(|&b| b != a);
        others.map(|b| (t - points[b][0]) / (points[a][0] - points[b][0])).product::<f64>()
    };
    let here: f64 = (0..4).map(|a| weight(a) * points[a][1]).sum();
    let slope = (points[2][1] - points[1][1]) / (points[2][0] - points[1][0]);
    Some([t - here / slope, (here.abs() - value).abs()])
}

/// Minimum of the parabola through κ² of three samples.
fn touched(kappa: &[[f64; 2]], i: usize) -> [f64; 2] {
    if i == 0 || i + 1 >= kappa.len() {
        return kappa[i];
    }
    let [[t0, a], [t1, b], [t2, c]] = [kappa[i - 1], kappa[i], kappa[i + 1]];
    let [a, b, c] = [a, b, c].map(|x| x * x);
    let (first, second) = ((b - a) / (t1 - t0), (c - b) / (t2 - t1));
    let curvature = (second - first) / (t2 - t0);
    if !(curvature > 0.0) {
        return kappa[i];
    }
    let slope = first + curvature * (t1 - t0);
    let t = t1 - slope / (2.0 * curvature);
    let least = b - slope * slope / (4.0 * curvature);
    // a parabola with a negative minimum cannot be a square
    if t < t0 || t > t2 || least < 0.0 { kappa[i] } else { [t, least.sqrt()] }
}

pub(super) fn findings(
    (scene, linkage): (&Scene<f64>, &Linkage),
    motion: &Motion,
    findings: &mut Vec<Finding>,
) {
    findings.extend(motion.nearest.iter().filter_map(|near| passes(scene, near)));
    if let Some((code, message, hint)) = &motion.error {
        let message = format!(
            "the run by {} stops at t = {} s: {message}",
            motion.formulation,
            few(motion.reached)
        );
        let mut finding = Finding::new(Severity::Fault, (Topic::Motion, code), message, *hint);
        match motion.entry {
            Some(Entry::Joint(j)) => finding = finding.joints(vec![j]),
            Some(Entry::Body(b)) => finding = finding.bodies(vec![b]),
            Some(entry) => finding = finding.at(entry, "name"),
            None => {}
        }
        findings.push(finding);
    }
    let left: Vec<usize> = linkage
        .parts
        .iter()
        .filter(|part| part.has_loop() && !is_watched(part))
        .map(|part| part.joints[0])
        .collect();
    if !left.is_empty() {
        let message = format!(
            "the loops that {} belong to are too many to be looked at along the motion",
            joint_names(scene, &left)
        );
        let code = (Topic::Motion, "not-watched");
        findings.push(Finding::new(Severity::Note, code, message, "").joints(left));
    }
    if motion.is_cut_short {
        let message = format!(
            "the motion was looked at up to t = {} s of {} s: the time for it was up",
            few(motion.reached),
            few(motion.duration)
        );
        let code = (Topic::Motion, "cut-short");
        findings.push(Finding::new(Severity::Note, code, message, ""));
    }
}

/// Makes the finding of a part that passes singular positions.
fn passes(scene: &Scene<f64>, near: &Nearest) -> Option<Finding> {
    let first = few(*near.passages.first()?);
    let times = match near.passages.len() {
        1 => format!("at t = {first} s the motion passes a singular position"),
        n => format!("the motion passes a singular position {n} times, first at t = {first} s,"),
    };
    let message = format!(
        "{times} of {}: branches meet there (smallest singular value {} of the largest, {} at the start)",
        joint_names(scene, &near.joints),
        few(near.sigma),
        few(near.sigma_at_start)
    );
    let remedy = "run it by index-3 or index-1, compare two steps, and check that the branch is the intended one";
    let code = (Topic::Motion, "passes-singular-position");
    Some(Finding::new(Severity::Doubt, code, message, remedy).joints(near.joints.clone()))
}

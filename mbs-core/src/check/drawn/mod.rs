//! Couplings by geometry: their sums follow from positions and axes in the reference configuration.
//!
//! ```text
//! gear          N1 w1 + N2 w2 = 0, internal N1 w1 - N2 w2 = 0        w: turn of a wheel in the carrier, about one sense of the axes
//! belt          r1 w1 - r2 w2 = 0, crossed  r1 w1 + r2 w2 = 0
//! rack          v - r (a x n).d w = 0       n: from the pinion's axis a to the pitch line of the rack, d: direction of this line
//! screw         2 pi v - lead w = 0         v: slide of the nut along the axis
//! differential  Na (wa - wc) + Nb (wb - wc) = 0
//! ```
//!
//! w1, w2, wa and wb are turns of wheels, wc is the turn of the cage. N are numbers of teeth, r radii; v is a slide. The carrier is the
//! body in which both axes are fixed.
//!
//! A joint's coordinate is the turn of its second body relative to the first. If the wheel is the first body, the sign changes. If the two
//! joints start from different bodies, the turns between these bodies and the carrier are added. The first factor keeps its sign, so a sum
//! that is already correct does not change.

mod carrier;
mod notes;

use crate::Real;
use crate::algebra::{Vector, cross, norm};
use crate::mechanism::Scene;
use crate::scene::{
    BodyId, Coupling, CouplingMeasure, CouplingTerm, Drawn, DrawnKind, Entry, Joint, NotDrawn,
    SceneError, SceneFault, Sense,
};
use alloc::vec::Vec;
use carrier::{Element, Leg};

/// Computes the sum of every coupling that follows from the geometry.
///
/// # Errors
/// [`SceneFault::NoCarrier`] if no body carries both axes. [`SceneFault::NotDrawn`] if positions and axes do not determine the sum, but the
/// coupling says explicitly that its sum follows from the geometry.
pub(super) fn fill<T: Real>(scene: &mut Scene<T>) -> Result<(), SceneError> {
    let bodies = scene.joints.iter().flat_map(|joint| joint.bodies);
    if bodies.filter_map(BodyId::index).any(|body| body >= scene.bodies.len()) {
        // the check of the joints reports a body that does not exist
        return Ok(());
    }
    for i in 0..scene.couplings.len() {
        let Some(drawn) = scene.couplings[i].drawn else { continue };
        let Some(named) = Named::new(scene, &scene.couplings[i], drawn.kind) else { continue };
        let found = named.sum();
        let coupling = &mut scene.couplings[i];
        let sense = match found {
            Ok(terms) if terms == coupling.terms => Sense::Same,
            Ok(terms) => {
                coupling.terms = terms;
                Sense::Changed
            }
            Err(SceneFault::NotDrawn(_)) if !drawn.is_stated => Sense::Undecided,
            Err(fault) => {
                return Err(SceneError { entry: Entry::Coupling(i), field: "joints", fault });
            }
        };
        coupling.drawn = Some(Drawn { sense, ..drawn });
    }
    Ok(())
}

/// Joints that a coupling names, with their coordinates and factors.
struct Named<'a, T: Real> {
    scene: &'a Scene<T>,
    kind: DrawnKind,
    elements: Vec<Element<T>>,
    /// Factors as given in the scene file.
    factors: Vec<T>,
}

impl<'a, T: Real> Named<'a, T> {
    /// Prepares a coupling for its sum. `None` if its terms are not valid, or if no carrier is necessary: a screw in one joint.
    fn new(scene: &'a Scene<T>, coupling: &Coupling<T>, kind: DrawnKind) -> Option<Self> {
        let n = match kind {
            DrawnKind::Ratio => return None,
            DrawnKind::Differential => 3,
            _ => 2,
        };
        let terms = coupling.terms.get(..n)?;
        let elements: Option<Vec<_>> =
            terms.iter().map(|term| Element::new(scene, &term.of)).collect();
        let elements = elements?;
        let slides = matches!(kind, DrawnKind::Rack | DrawnKind::Screw);
        let is_meant = |(k, element): (usize, &Element<T>)| element.is_turn != (slides && k == 0);
        let is_one = elements[0].joint == elements[1].joint;
        if is_one || !elements.iter().enumerate().all(is_meant) {
            return None;
        }
        let factors = terms.iter().map(|term| term.factor).collect();
        Some(Self { scene, kind, elements, factors })
    }

    /// Terms of the coupling's sum.
    fn sum(&self) -> Result<Vec<CouplingTerm<T>>, SceneFault> {
        match self.kind {
            DrawnKind::Gear { is_internal, .. } => self.wheels(is_internal),
            DrawnKind::Belt { is_crossed } => self.wheels(!is_crossed),
            DrawnKind::Ratio => Ok(Vec::new()),
            DrawnKind::Rack => self.rack(),
            DrawnKind::Screw => self.screw(),
            DrawnKind::Differential => self.differential(),
        }
    }

    /// Sum of two wheels on parallel axes. `is_alike`: they turn in the same sense.
    fn wheels(&self, is_alike: bool) -> Result<Vec<CouplingTerm<T>>, SceneFault> {
        let [first, second] = [&self.elements[0], &self.elements[1]];
        let sense = self.parallel(first, second)?;
        let ([of_first, of_second], path) = self.carried(first, second)?;
        let [n1, n2] = [self.factors[0].abs(), self.factors[1].abs()];
        let n2 = if is_alike { -n2 } else { n2 };
        let mut sum = self.empty();
        sum.add(first, n1 * of_first);
        sum.add(second, n2 * sense * of_second);
        // w1 = ± θ1 − (turn of the carrier relative to the first body), w2 = ± θ2 + (turn of the second body relative to the carrier)
        for leg in &path {
            let about = leg.sense_about(first);
            sum.add(&leg.element, if leg.is_first { -n1 * about } else { n2 * about });
        }
        Ok(sum.led_by(first))
    }

    fn rack(&self) -> Result<Vec<CouplingTerm<T>>, SceneFault> {
        let [rack, pinion] = [&self.elements[0], &self.elements[1]];
        let way = rack.point - pinion.point;
        let across = cross(&pinion.axis, &rack.axis);
        let size = norm(&across);
        let side = way.dot(&across);
        let least = T::from_f64(carrier::PARALLEL);
        if size <= least || side.abs() <= least * size * self.reach() {
            return Err(SceneFault::NotDrawn(NotDrawn::PitchLine));
        }
        // (a × n)·d with n = ± (a × d), since a × (a × d) is opposite to d
        let sense = if side > T::ZERO { -T::ONE } else { T::ONE };
        let radius = -self.factors[1];
        let ([of_pinion, of_rack], path) = self.carried(pinion, rack)?;
        let mut sum = self.empty();
        sum.add(rack, of_rack);
        sum.add(pinion, -radius * sense * of_pinion);
        for leg in &path {
            let along = if leg.is_first {
                radius * sense * leg.sense_about(pinion)
            } else {
                leg.sense_about(rack)
            };
            sum.add(&leg.element, along);
        }
        Ok(sum.led_by(rack))
    }

    fn screw(&self) -> Result<Vec<CouplingTerm<T>>, SceneFault> {
        let [slide, turn] = [&self.elements[0], &self.elements[1]];
        let sense = self.parallel(slide, turn)?;
        let ([of_turn, of_slide], path) = self.carried(turn, slide)?;
        let (per_turn, lead) = (self.factors[0], -self.factors[1]);
        let mut sum = self.empty();
        sum.add(slide, per_turn * of_slide);
        sum.add(turn, -lead * sense * of_turn);
        for leg in &path {
            let along = leg.sense_about(slide);
            sum.add(&leg.element, if leg.is_first { lead * along } else { per_turn * along });
        }
        Ok(sum.led_by(slide))
    }

    /// Sum of a differential's wheels and cage. Shafts with constant-velocity joints lead to wheels whose carriers turn with the housing.
    fn differential(&self) -> Result<Vec<CouplingTerm<T>>, SceneFault> {
        let [a, b, cage] = [&self.elements[0], &self.elements[1], &self.elements[2]];
        let cage_body = carrier::outer(self.scene, cage);
        let mut sum = self.empty();
        for (wheel, factor) in [(a, self.factors[0].abs()), (b, self.factors[1].abs())] {
            let sense = self.parallel(wheel, cage)?;
            match carrier::to(self.scene, (wheel, cage), cage_body) {
                Some((of_wheel, path)) => {
                    sum.add(wheel, factor * sense * of_wheel);
                    for leg in &path {
                        sum.add(&leg.element, -factor * leg.sense_about(cage));
                    }
                }
                None => {
                    let outer = carrier::outer(self.scene, wheel);
                    sum.add(wheel, factor * sense * wheel.side(outer));
                    sum.add(cage, -factor * cage.side(cage_body));
                }
            }
        }
        Ok(sum.led_by(a))
    }

    /// Sum with the named coordinates in their order and zero factors.
    fn empty(&self) -> Sum<T> {
        let mut sum = Sum(Vec::new());
        self.elements.iter().for_each(|element| sum.add(element, T::ZERO));
        sum
    }

    /// Sign of one axis relative to the other; they must be parallel.
    fn parallel(&self, one: &Element<T>, other: &Element<T>) -> Result<T, SceneFault> {
        one.sense(&other.axis).ok_or(SceneFault::NotDrawn(NotDrawn::Parallel))
    }

    /// Signs of both elements in the carrier, and the joints between their inner bodies.
    fn carried(
        &self,
        first: &Element<T>,
        second: &Element<T>,
    ) -> Result<([T; 2], Vec<Leg<T>>), SceneFault> {
        carrier::of(self.scene, [first, second], self.reach()).ok_or_else(|| {
            let bodies = [first, second].map(|element| carrier::inner(self.scene, element));
            SceneFault::NoCarrier { bodies, about: first.joint.index() }
        })
    }

    /// Largest distance of a joint from the first named joint [m].
    fn reach(&self) -> T {
        let first = self.elements[0].point;
        let far = |joint: &Joint<T>| norm(&(Vector::from(joint.points[0]) - first));
        self.scene.joints.iter().map(far).fold(T::ZERO, T::max)
    }
}

/// Terms of a sum; each coordinate occurs once.
struct Sum<T: Real>(Vec<CouplingTerm<T>>);

impl<T: Real> Sum<T> {
    fn add(&mut self, of: &Element<T>, factor: T) {
        let (joint, number) = (of.joint, of.number);
        match self.0.iter_mut().find(|term| term.of.coordinate() == Some((joint, number))) {
            Some(term) => term.factor += factor,
            None => {
                let of = CouplingMeasure::Coordinate { joint, number };
                self.0.push(CouplingTerm { factor, of, curve: None });
            }
        }
    }

    /// Nonzero terms, all with a sign such that the factor of the first element is positive.
    fn led_by(mut self, first: &Element<T>) -> Vec<CouplingTerm<T>> {
        let leads = |term: &&CouplingTerm<T>| {
            term.of.coordinate() == Some((first.joint, first.number)) && term.factor < T::ZERO
        };
        if self.0.iter().any(|term| leads(&term)) {
            self.0.iter_mut().for_each(|term| term.factor = -term.factor);
        }
        self.0.retain(|term| !term.factor.is_zero());
        self.0
    }
}

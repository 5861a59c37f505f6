//! The lowest point of a disc or a ball above a plane.
//!
//! ```text
//! rho = -R w/|w|,   w = n - a (a.n)      n: the plane's unit normal, a: the disc's unit axis; of a ball, and in the plane, a = 0
//! |w|^2 = 1 - (a.n)^2: a disc that lies flat has no lowest point
//! ```

use crate::Real;
use crate::algebra::Vector;

/// Vector and its time derivative.
pub type Moving<T> = [Vector<T, 3>; 2];

/// Square of |w| below which a disc lies flat [-]. Its axis is then within a thousandth of a radian of the normal, and its lowest point
/// does not determine its motion.
const FLAT: f64 = 1e-6;

/// Vector from the centre of a disc or ball to its lowest point [m], and its rate. The inputs are the radius [m], the normal and the axis
/// with their rates. The result is not finite for a disc that lies flat.
pub fn lowest_point<T: Real>(radius: T, [n, n_t]: &Moving<T>, [a, a_t]: &Moving<T>) -> Moving<T> {
    let (dot, dot_t) = (a.dot(n), a_t.dot(n) + a.dot(n_t));
    let (w, w_t) = (*n - *a * dot, *n_t - *a_t * dot - *a * dot_t);
    let inverse = T::ONE / w.dot(&w).sqrt();
    let (unit, w_t) = (w * inverse, w_t * inverse);
    [unit * -radius, (w_t - unit * unit.dot(&w_t)) * -radius]
}

/// Vector from the centre of a disc or ball to its lowest point [m], for a constant normal and axis.
pub fn lowest_place<T: Real>(radius: T, normal: Vector<T, 3>, axis: Vector<T, 3>) -> Vector<T, 3> {
    let still = |x| [x, Vector::zeros()];
    let [place, _] = lowest_point(radius, &still(normal), &still(axis));
    place
}

/// True if a disc with this axis lies flat on the plane with this normal.
pub fn lies_flat<T: Real>(normal: &Vector<T, 3>, axis: &Vector<T, 3>) -> bool {
    let dot = normal.dot(axis);
    !(T::ONE - dot * dot > T::from_f64(FLAT))
}

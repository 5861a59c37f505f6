//! Derivatives of efforts compared with differences in double-double precision.

use mbs_core::Real;
use mbs_core::real::DoubleDouble as Pair;
use mbs_recursive::own::{EffortSlopes, MovingColumns, OwnFreedoms};
use mbs_recursive::space::{Numbers, Space};
use mbs_recursive::{EffortTerms, Planar, Spatial, TreeModel, TreeState, Workspace};
use mbs_testkit::{Random, file_in};

/// Step of the central differences. The error of the differences is of the order of the square of this step; the rounding of double-double
/// numbers is smaller.
const STEP: f64 = 1e-8;
/// Largest error of the derivatives, relative to the largest derivative [-]: rounding of doubles through trees of twenty bodies.
const ROUNDING: f64 = 1e-12;

fn at<T: Real, S: Space<T>>(model: &TreeModel<T, S>, seed: u64) -> TreeState<T> {
    let mut state = TreeState::at_rest(model);
    let (n, mut random) = (state.v.len(), Random(seed));
    let mut vector = |size| random.vector(n, n, size).into_iter().map(T::from_f64).collect();
    let step: Vec<T> = vector(1.0);
    moved(model, &mut state, &step);
    (state.v, state.a) = (vector(2.0), vector(3.0));
    state
}

/// Moves the coordinates by a step along the velocities. In `step`, the rotation of a link is in the link's axes and comes before the
/// translation.
fn moved<T: Real, S: Space<T>>(model: &TreeModel<T, S>, state: &mut TreeState<T>, step: &[T]) {
    for link in model.mechanism().links.iter().skip(1).filter(|link| !link.kind.is_guided()) {
        let n = link.kind.n_freedoms::<T, S>();
        let [turns, numbers] = if n > 1 { [S::Spin::N, S::FREE - S::Point::N] } else { [0, 0] };
        let (z, v) = (&mut state.z[link.z as usize..], &step[link.v as usize..][..n]);
        if turns > 0 {
            S::advance_rotation(&mut z[..numbers], &v[..turns]);
        }
        z[numbers..].iter_mut().zip(&v[turns..]).for_each(|(z, &step)| *z += step);
    }
}

fn efforts<S: Space<Pair>>(model: &TreeModel<Pair, S>, state: &TreeState<Pair>) -> Vec<Pair> {
    let mut out = vec![Pair::ZERO; state.v.len()];
    let mut workspace = Workspace::new(model);
    model.write_efforts((state, EffortTerms::WithoutEffects), &mut workspace, &mut out);
    out
}

fn check<S: Space<f64> + Space<Pair>>(scene: &str, seed: u64) {
    let model = TreeModel::<f64, S>::new(&file_in(scene)).expect("a tree");
    let exact = TreeModel::<Pair, S>::new(&file_in(scene)).expect("a tree");
    let (state, there) = (at(&model, seed), at(&exact, seed));
    let n = state.v.len();
    let mut freedoms = OwnFreedoms::of_tree(&model);
    let [mut q, mut v, mut a] = [0; 3].map(|_| vec![f64::NAN; n * n]);
    let mut slopes = EffortSlopes { q: &mut q, v: &mut v, a: &mut a };
    let scratch = (&mut Workspace::new(&model), &mut MovingColumns::new(&model));
    freedoms.write_effort_slopes(&model, &state, scratch, &mut slopes);
    let largest = q.iter().chain(&v).fold(1.0_f64, |s, x| s.max(x.abs()));
    let twice = Pair::from_f64(0.5 / STEP);
    for k in 0..n {
        let difference = |change: &dyn Fn(&mut TreeState<Pair>, Pair)| -> Vec<f64> {
            let [before, after] = [-STEP, STEP].map(|h| {
                let mut state = there.clone();
                change(&mut state, Pair::from_f64(h));
                efforts(&exact, &state)
            });
            before.iter().zip(after).map(|(x, y)| ((y - *x) * twice).to_f64()).collect()
        };
        let column = |square: &[f64]| -> Vec<f64> { (0..n).map(|i| square[i * n + k]).collect() };
        let by_q = difference(&|state, h| {
            let mut step = vec![Pair::ZERO; n];
            step[k] = h;
            moved(&exact, state, &step);
        });
        let by_v = difference(&|state, h| state.v[k] += h);
        let by_a = difference(&|state, h| state.a[k] += h);
        let name = |of: &str| format!("{scene}: {of} {k}");
        mbs_testkit::close(&name("q"), &column(&q), &by_q, ROUNDING * largest);
        mbs_testkit::close(&name("v"), &column(&v), &by_v, ROUNDING * largest);
        mbs_testkit::close(&name("a"), &column(&a), &by_a, ROUNDING * largest);
    }
}

#[test]
fn derivatives_of_efforts_are_those_of_differences_in_32_digits() {
    for name in ["double-pendulum", "simple-pendulum"] {
        check::<Planar>(name, 1);
    }
    for name in ["tree-30", "spatial-chain-20", "six-joint-arm", "spinning-top", "free-body"] {
        check::<Spatial>(name, 2);
    }
}

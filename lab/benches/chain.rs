//! Time of one evaluation of accelerations: chains of 10 to 1000 bodies, in the plane and in space, and rows of four-bars.
//!
//! Run it by `cargo bench -p lab --features benches --bench chain`. The throughput line gives bodies (or loops) per second.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use mbs_core::Real;
use mbs_core::real::Lanes;
use mbs_core::scene::{Body, BodyId, Dimension, Inertia, Joint, JointKind, JointLimits, Scene};
use mbs_recursive::space::Space;
use mbs_recursive::{Options, Planar, Spatial, TreeModel, TreeState, Workspace};

fn scene<T: Real>(dimension: Dimension) -> Scene<T> {
    let gravity = Some([0.0, -9.81, 0.0].map(T::from_f64));
    Scene { gravity, ..Scene::empty("", dimension, T::ONE) }
}

fn revolute<T: Real>(bodies: [BodyId; 2], at: [f64; 3], axis: Option<[f64; 3]>) -> Joint<T> {
    let (at, axis) = (at.map(T::from_f64), axis.map(|axis| axis.map(T::from_f64)));
    Joint {
        name: String::new(),
        kind: JointKind::Revolute,
        bodies,
        points: [at; 2],
        axes: [axis, None],
        limits: JointLimits::NONE,
    }
}

/// A chain of `n` bodies. The joint axes change their direction along the chain.
fn chain<T: Real>(n: usize, dimension: Dimension) -> Scene<T> {
    let mut scene = scene(dimension);
    let mut last = BodyId::Ground;
    for i in 0..n {
        let x = 0.1 * i as f64;
        let inertia = match dimension {
            Dimension::Planar => Inertia::Planar(T::from_f64(1e-3)),
            Dimension::Spatial => {
                let tensor = [2e-4, 1e-3, 1.1e-3, 1e-5, 2e-5, -1e-5];
                Inertia::Spatial(tensor.map(T::from_f64))
            }
        };
        let center = [x + 0.05, 0.01, 0.0].map(T::from_f64);
        scene.bodies.push(Body {
            name: String::new(),
            mass: T::ONE,
            center,
            inertia,
            gravity_scale: None,
        });
        let body = BodyId::Body(i);
        let axis = [[0.0, 0.0, 1.0], [0.0, 0.6, 0.8], [0.1, 0.9, -0.2]][i % 3];
        let axis = (dimension == Dimension::Spatial).then_some(axis);
        scene.joints.push(revolute([last, body], [x, 0.0, 0.0], axis));
        last = body;
    }
    scene
}

/// A row of `n` four-bars: cranks on the ground, with couplers between the ends of neighbouring cranks.
fn four_bars(n: usize) -> Scene<f64> {
    let mut scene = scene(Dimension::Planar);
    let rod = |from: [f64; 3], to: [f64; 3]| Body {
        name: String::new(),
        mass: 1.0,
        center: [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1]), 0.0],
        inertia: Inertia::Rod { from, to },
        gravity_scale: None,
    };
    for i in 0..=n {
        let x = i as f64;
        let crank = scene.bodies.len();
        scene.bodies.push(rod([x, 0.0, 0.0], [x, 1.0, 0.0]));
        scene.joints.push(revolute([BodyId::Ground, BodyId::Body(crank)], [x, 0.0, 0.0], None));
        if i > 0 {
            let joint =
                revolute([BodyId::Body(crank - 1), BodyId::Body(crank)], [x, 1.0, 0.0], None);
            scene.joints.push(joint);
        }
        if i < n {
            scene.bodies.push(rod([x, 1.0, 0.0], [x + 1.0, 1.0, 0.0]));
            let bodies = [BodyId::Body(crank), BodyId::Body(crank + 1)];
            scene.joints.push(revolute(bodies, [x, 1.0, 0.0], None));
        }
    }
    scene
}

fn evaluations<S: Space<f64>>(
    criterion: &mut Criterion,
    group: &str,
    make: impl Fn(usize) -> Scene<f64>,
    sizes: &[usize],
) {
    let mut group = criterion.benchmark_group(group);
    for &n in sizes {
        let model = TreeModel::<f64, S>::new(&make(n)).expect("the scene has a tree");
        let mut state = TreeState::at_rest(&model);
        let loops = model.n_rows() > 0;
        for (i, (z, v)) in state.z.iter_mut().zip(&mut state.v).enumerate() {
            if !loops {
                *z = 0.3 * (i as f64).sin();
                *v = (2.0 * i as f64).cos();
            }
        }
        let mut workspace = Workspace::new(&model);
        let options = Options::default();
        group.throughput(Throughput::Elements(n as u64));
        group.bench_with_input(BenchmarkId::from_parameter(n), &n, |bencher, _| {
            bencher
                .iter(|| model.accelerate(&options, &mut state, &mut workspace).expect("regular"));
        });
    }
    group.finish();
}

/// Evaluation of as many states as there are lanes, first one after the other, then all in one call.
fn lanes<S: Space<f64> + Space<Lanes<N>>, const N: usize>(
    criterion: &mut Criterion,
    name: &str,
    dimension: Dimension,
) {
    const BODIES: usize = 30;
    let mut group = criterion.benchmark_group(format!("{name} chain of {BODIES}, {N} states"));
    group.throughput(Throughput::Elements((N * BODIES) as u64));
    let model = TreeModel::<f64, S>::new(&chain(BODIES, dimension)).expect("a tree");
    let wide = TreeModel::<Lanes<N>, S>::in_lanes(&chain(BODIES, dimension)).expect("a tree");
    let mut states: Vec<_> = (0..N).map(|_| TreeState::at_rest(&model)).collect();
    let mut together = TreeState::at_rest(&wide);
    for (lane, state) in states.iter_mut().enumerate() {
        for (i, (z, v)) in state.z.iter_mut().zip(&mut state.v).enumerate() {
            *z = 0.3 * ((i + lane) as f64).sin();
            *v = (2.0 * (i + lane) as f64).cos();
        }
        together.set_lane(lane, &state.z, &state.v);
    }
    let (mut own, mut wide_own) = (Workspace::new(&model), Workspace::new(&wide));
    let (options, wide_options) = (Options::default(), Options::default());
    group.bench_function("one by one", |bencher| {
        bencher.iter(|| {
            for state in &mut states {
                model.accelerate(&options, state, &mut own).expect("regular");
            }
        });
    });
    group.bench_function("at once", |bencher| {
        bencher.iter(|| {
            wide.accelerate(&wide_options, &mut together, &mut wide_own).expect("regular");
        });
    });
    group.finish();
}

fn benches(criterion: &mut Criterion) {
    let sizes = [10, 30, 100, 300, 1000];
    evaluations::<Planar>(criterion, "planar chain", |n| chain(n, Dimension::Planar), &sizes);
    evaluations::<Spatial>(criterion, "spatial chain", |n| chain(n, Dimension::Spatial), &sizes);
    evaluations::<Planar>(criterion, "four-bars", four_bars, &[1, 2, 10, 40, 100]);
    lanes::<Planar, 2>(criterion, "planar", Dimension::Planar);
    lanes::<Planar, 4>(criterion, "planar", Dimension::Planar);
    lanes::<Planar, 8>(criterion, "planar", Dimension::Planar);
    lanes::<Spatial, 2>(criterion, "spatial", Dimension::Spatial);
    lanes::<Spatial, 4>(criterion, "spatial", Dimension::Spatial);
    lanes::<Spatial, 8>(criterion, "spatial", Dimension::Spatial);
}

criterion_group! {
    name = chains;
    config = Criterion::default()
        .warm_up_time(std::time::Duration::from_millis(300))
        .measurement_time(std::time::Duration::from_millis(1000))
        .sample_size(20);
    targets = benches
}
criterion_main!(chains);

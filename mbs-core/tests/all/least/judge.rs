//! Reference solution of starts from their definition, in joint coordinates and with dense matrices. It uses no code of the
//! library.
//!
//! ```text
//! positions:   min sum_bodies m |c - c0|^2 + 2 tr(E) - 2 tr(R E)   over free coordinates, cuts closed, prescribed ones given
//! velocities:  min sum_bodies m |c'|^2 + w^T R I R^T w             over free rates, cuts closed, prescribed ones given
//! ```
//!
//! The second moment of a body about its centre c is E, and its inertia I = tr(E) 1 - E. R is its rotation, w its angular velocity.

pub(super) type V = [f64; 3];
pub(super) type M = [V; 3];

pub(super) struct Body {
    pub(super) mass: f64,
    pub(super) center: V,
    pub(super) moment: M,
}

pub(super) struct Joint {
    pub(super) kind: &'static str,
    /// Body before the joint; `None`: the ground. A joint has the same number as the body after it.
    pub(super) first: Option<usize>,
    pub(super) at: V,
    pub(super) axes: [V; 2],
    pub(super) value: Option<Vec<f64>>,
    pub(super) rate: Option<Vec<f64>>,
}

/// Tree of bodies with cuts: points of a body that coincide with a point of another body or of the ground.
pub(super) struct Mechanism {
    pub(super) is_planar: bool,
    pub(super) bodies: Vec<Body>,
    pub(super) joints: Vec<Joint>,
    pub(super) cuts: Vec<(Option<usize>, usize, V)>,
}

#[derive(Clone, Copy)]
pub(super) struct Pose {
    pub(super) turn: M,
    shift: V,
}

impl Pose {
    pub(super) fn point(&self, p: V) -> V {
        add(self.shift, 1.0, times(&self.turn, p))
    }
}

#[derive(Clone, Copy)]
struct Column {
    joint: usize,
    is_turn: bool,
    axis: V,
    point: V,
}

pub(super) fn add(a: V, s: f64, b: V) -> V {
    std::array::from_fn(|i| a[i] + s * b[i])
}
pub(super) fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
pub(super) fn times(a: &M, x: V) -> V {
    std::array::from_fn(|i| dot(a[i], x))
}
fn product(a: &M, b: &M) -> M {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}
fn turn(axis: V, angle: f64) -> M {
    let length = dot(axis, axis).sqrt();
    let (n, (s, c)) = (axis.map(|x| x / length), angle.sin_cos());
    std::array::from_fn(|i| {
        let e = std::array::from_fn(|k| f64::from(u8::from(k == i)));
        // row i of R: e_i c - (n x e_i) s + n n_i (1 - c)
        let nx = cross(n, e);
        std::array::from_fn(|j| e[j] * c - nx[j] * s + n[j] * n[i] * (1.0 - c))
    })
}

/// Solves a dense system by elimination with row pivoting.
fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let best = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap_or(k);
        a.swap(k, best);
        b.swap(k, best);
        for i in k + 1..n {
            let f = a[i][k] / a[k][k];
            for j in k..n {
                a[i][j] -= f * a[k][j];
            }
            b[i] -= f * b[k];
        }
    }
    for k in (0..n).rev() {
        b[k] = (b[k] - (k + 1..n).map(|j| a[k][j] * b[j]).sum::<f64>()) / a[k][k];
    }
    b
}

impl Joint {
    /// Freedoms of the joint as rotations and slides, each with its axis in the reference configuration.
    fn freedoms(&self) -> Vec<(bool, V)> {
        let [a, b] = self.axes;
        match self.kind {
            "revolute" => vec![(true, a)],
            "prismatic" => vec![(false, a)],
            "cylindrical" => vec![(false, a), (true, a)],
            "universal" => vec![(true, a), (true, b)],
            _ => vec![(true, [1.0, 0.0, 0.0]), (true, [0.0, 1.0, 0.0]), (true, [0.0, 0.0, 1.0])],
        }
    }
    fn is_ball(&self) -> bool {
        self.kind == "spherical"
    }
}

impl Mechanism {
    fn n_coordinates(&self) -> usize {
        self.joints.iter().map(|j| j.freedoms().len()).sum()
    }

    /// Poses of the bodies, and columns of the joint freedoms. Prescribed balls rotate by their rotation vector. For rates, all
    /// balls have columns about the global axes.
    fn place(&self, z: &[f64], tau: f64, is_rate: bool) -> (Vec<Pose>, Vec<Column>) {
        let still = turn([0.0, 0.0, 1.0], 0.0);
        let (mut poses, mut columns, mut at) = (Vec::<Pose>::new(), Vec::new(), 0);
        for (joint, spec) in self.joints.iter().enumerate() {
            let mut pose =
                spec.first.map_or(Pose { turn: still, shift: [0.0; 3] }, |first| poses[first]);
            let first = columns.len();
            let mut by = |pose: &mut Pose, is_turn: bool, axis: V, size: f64| {
                let (world, point) = (times(&pose.turn, axis), pose.point(spec.at));
                columns.push(Column { joint, is_turn, axis: world, point });
                if is_turn {
                    pose.turn = product(&pose.turn, &turn(axis, size));
                    pose.shift = add(point, -1.0, times(&pose.turn, spec.at));
                } else {
                    pose.shift = add(pose.shift, size, world);
                }
            };
            let freedoms = spec.freedoms();
            for (k, (is_turn, axis)) in freedoms.iter().enumerate() {
                by(&mut pose, *is_turn, *axis, z[at + k]);
            }
            if let (true, Some(w)) = (spec.is_ball(), &spec.value) {
                let w: V = [w[0], w[1], w[2]];
                by(&mut pose, true, w, tau * dot(w, w).sqrt());
                columns.pop();
            }
            if is_rate && spec.is_ball() {
                for (i, column) in columns[first..].iter_mut().enumerate() {
                    column.axis = std::array::from_fn(|k| f64::from(u8::from(k == i)));
                }
            }
            poses.push(pose);
            at += freedoms.len();
        }
        (poses, columns)
    }

    fn carries(&self, joint: usize, body: usize) -> bool {
        joint == body || self.joints[body].first.is_some_and(|first| self.carries(joint, first))
    }

    /// Velocity of a point of a body for a unit rate of a freedom.
    fn moves(&self, column: &Column, body: Option<usize>, point: V) -> V {
        match body {
            Some(body) if self.carries(column.joint, body) => {
                if column.is_turn {
                    cross(column.axis, add(point, -1.0, column.point))
                } else {
                    column.axis
                }
            }
            _ => [0.0; 3],
        }
    }

    /// Gaps of the cuts, with their derivatives.
    fn gaps(&self, poses: &[Pose], columns: &[Column]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let (mut gaps, mut rows) = (Vec::new(), Vec::new());
        let n = if self.is_planar { 2 } else { 3 };
        for &(first, second, at) in &self.cuts {
            let p = first.map_or(at, |first| poses[first].point(at));
            let q = poses[second].point(at);
            let moved: Vec<V> = columns
                .iter()
                .map(|c| add(self.moves(c, Some(second), q), -1.0, self.moves(c, first, p)))
                .collect();
            for i in 0..n {
                gaps.push(q[i] - p[i]);
                rows.push(moved.iter().map(|x| x[i]).collect());
            }
        }
        (gaps, rows)
    }

    /// Residual of the conditions for the least change: its gradient with the multipliers of the cuts, then the gaps of the cuts.
    fn stationary(&self, z: &[f64], lambda: &[f64], tau: f64, free: &[usize]) -> Vec<f64> {
        let (poses, columns) = self.place(z, tau, false);
        let (gaps, rows) = self.gaps(&poses, &columns);
        let gradient = |column: &Column| {
            let mut sum = 0.0;
            for (b, body) in self.bodies.iter().enumerate() {
                if !self.carries(column.joint, b) {
                    continue;
                }
                let c = poses[b].point(body.center);
                let moved = self.moves(column, Some(b), c);
                sum += 2.0 * body.mass * dot(add(c, -1.0, body.center), moved);
                if column.is_turn {
                    let e = product(&poses[b].turn, &body.moment);
                    let pull = [e[1][2] - e[2][1], e[2][0] - e[0][2], e[0][1] - e[1][0]];
                    sum -= 2.0 * dot(column.axis, pull);
                }
            }
            sum
        };
        let mut all: Vec<f64> = free
            .iter()
            .map(|&i| {
                let pull: f64 = rows.iter().zip(lambda).map(|(row, l)| row[i] * l).sum();
                gradient(&columns[i]) + pull
            })
            .collect();
        all.extend(gaps);
        all
    }

    /// Coordinates without a prescribed value or rate.
    fn free(&self, is_rate: bool) -> Vec<usize> {
        let mut free = Vec::new();
        let mut at = 0;
        for joint in &self.joints {
            let n = joint.freedoms().len();
            let is_held = if is_rate { joint.rate.is_some() } else { joint.value.is_some() };
            free.extend((at..at + n).filter(|_| !is_held));
            at += n;
        }
        free
    }

    /// Poses with the least change, reached from the reference configuration in 40 stages; `None` if a stage fails.
    pub(super) fn positions(&self) -> Option<(Vec<Pose>, Vec<f64>)> {
        let free = self.free(false);
        let mut z = vec![0.0; self.n_coordinates()];
        let mut lambda = vec![0.0; self.cuts.len() * if self.is_planar { 2 } else { 3 }];
        for stage in 1..=40 {
            let tau = f64::from(stage) / 40.0;
            let mut at = 0;
            for joint in &self.joints {
                let n = joint.freedoms().len();
                if let (Some(value), false) = (&joint.value, joint.is_ball()) {
                    (0..n).for_each(|i| z[at + i] = tau * value[i]);
                }
                at += n;
            }
            let mut left = f64::INFINITY;
            for _ in 0..20 {
                let f = self.stationary(&z, &lambda, tau, &free);
                let now = f.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
                if now < 1e-15 || (now < 1e-13 && now >= left) {
                    left = now;
                    break;
                }
                left = now;
                let n = f.len();
                let mut matrix = vec![vec![0.0; n]; n];
                let h = 1e-6;
                for j in 0..n {
                    let side = |s: f64| {
                        let (mut z, mut lambda) = (z.clone(), lambda.clone());
                        match free.get(j) {
                            Some(&i) => z[i] += s,
                            None => lambda[j - free.len()] += s,
                        }
                        self.stationary(&z, &lambda, tau, &free)
                    };
                    let (plus, minus) = (side(h), side(-h));
                    (0..n).for_each(|i| matrix[i][j] = (plus[i] - minus[i]) / (2.0 * h));
                }
                let step = solve(matrix, f);
                free.iter().zip(&step).for_each(|(&i, s)| z[i] -= s);
                lambda.iter_mut().zip(&step[free.len()..]).for_each(|(l, s)| *l -= s);
            }
            if !(left < 1e-12) {
                return None;
            }
        }
        Some((self.place(&z, 1.0, true).0, z))
    }

    /// Velocities of centres and angular velocities of the bodies at coordinates `z`: the smallest with the prescribed rates.
    pub(super) fn velocities(&self, z: &[f64]) -> Vec<[V; 2]> {
        let (poses, columns) = self.place(z, 1.0, true);
        let (_, rows) = self.gaps(&poses, &columns);
        let (n, free) = (columns.len(), self.free(true));
        let mut rates = vec![0.0; n];
        let mut at = 0;
        for joint in &self.joints {
            if let Some(rate) = &joint.rate {
                rates[at..at + rate.len()].copy_from_slice(rate);
            }
            at += joint.freedoms().len();
        }
        let spin = |c: &Column, b| {
            if c.is_turn && self.carries(c.joint, b) { c.axis } else { [0.0; 3] }
        };
        let momentum = |i: usize, j: usize| -> f64 {
            let (a, c) = (&columns[i], &columns[j]);
            let part = |(b, body): (usize, &Body)| {
                let center = poses[b].point(body.center);
                let (va, vc) = (self.moves(a, Some(b), center), self.moves(c, Some(b), center));
                // components in the axes of the body: w^T (tr(E) 1 - E) w
                let seen = |w: V| -> V {
                    std::array::from_fn(|k| (0..3).map(|l| poses[b].turn[l][k] * w[l]).sum())
                };
                let (wa, wc) = (seen(spin(a, b)), seen(spin(c, b)));
                let e = &body.moment;
                let trace = e[0][0] + e[1][1] + e[2][2];
                body.mass * dot(va, vc) + trace * dot(wa, wc) - dot(wa, times(e, wc))
            };
            self.bodies.iter().enumerate().map(part).sum()
        };
        let size = free.len() + rows.len();
        let (mut matrix, mut right) = (vec![vec![0.0; size]; size], vec![0.0; size]);
        for (r, &i) in free.iter().enumerate() {
            for (s, &j) in free.iter().enumerate() {
                matrix[r][s] = momentum(i, j);
            }
            right[r] = -(0..n).map(|j| momentum(i, j) * rates[j]).sum::<f64>();
            for (k, row) in rows.iter().enumerate() {
                matrix[r][free.len() + k] = row[i];
                matrix[free.len() + k][r] = row[i];
            }
        }
        for (k, row) in rows.iter().enumerate() {
            right[free.len() + k] = -row.iter().zip(&rates).map(|(a, b)| a * b).sum::<f64>();
        }
        let found = solve(matrix, right);
        free.iter().zip(&found).for_each(|(&i, &rate)| rates[i] = rate);
        self.bodies
            .iter()
            .enumerate()
            .map(|(b, body)| {
                let center = poses[b].point(body.center);
                let sum = |x: &dyn Fn(&Column) -> V| {
                    columns.iter().zip(&rates).fold([0.0; 3], |a, (c, &r)| add(a, r, x(c)))
                };
                [sum(&|c| self.moves(c, Some(b), center)), sum(&|c| spin(c, b))]
            })
            .collect()
    }
}

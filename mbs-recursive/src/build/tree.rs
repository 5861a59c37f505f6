//! [`TreeModel`]: a scene as a tree of links with cut joints. It is built once and constant afterwards.

use crate::build::coupling_tables::CouplingTables;
use crate::build::error::TreeError;
use crate::build::graph::{Branch, span};
use crate::build::joint_facts::JointFacts;
use crate::build::order::Order;
use crate::build::own_tables::own;
use crate::link::{Link, LinkKind, LinkRotor};
use crate::loads::Load;
use crate::loops::{Loops, index};
use crate::passes::feedback::{FeedbackMeasure, FeedbackSlices};
use crate::passes::slices::{Inputs, TreeSlices};
use crate::rows::Row;
use crate::rows::closed_loop::ClosedLoop;
use crate::space::{Numbers, Space};
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::actions::{Actions, Tables};
use mbs_core::algebra::{Matrix, Vector, unit};
use mbs_core::cluster::{Cluster, Clusters, scene_length};
use mbs_core::inputs::{Feedback, Prescribed};
use mbs_core::laws::code::Codes;
use mbs_core::model::Owner;
use mbs_core::scene::align::aligned;
use mbs_core::scene::{BodyId, Freedom, Joint, Scene};

/// A part of a joint: one link of the recursion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Part<T: Real> {
    pub(crate) kind: LinkKind,
    /// Axis or direction of the part, in the axes of the reference configuration.
    pub(crate) axis: Vector<T, 3>,
    /// Index of the part among the joint's coordinates.
    pub(crate) number: usize,
}

/// Links of a cluster's joint in the tree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TreePlace {
    pub(crate) branch: Branch,
    /// Last link of the joint. This link carries the body.
    pub(crate) link: u32,
    /// First link of the joint.
    pub(crate) first: u32,
}

/// A mechanism in relative coordinates: spanning tree, cut joints, effects.
#[derive(Debug, Clone)]
pub struct TreeModel<T: Real, S: Space<T>> {
    pub(crate) links: Vec<Link<T, S>>,
    pub(crate) loops: Vec<ClosedLoop<T, S>>,
    pub(crate) rows: Vec<Row<T, S>>,
    pub(crate) couplings: CouplingTables<T, S>,
    pub(crate) feedback: Feedback<T>,
    /// Link of each coordinate that signals measure.
    pub(crate) measured: Vec<u32>,
    /// Lengths and angles of ball joints that signals measure.
    pub(crate) measures: Vec<FeedbackMeasure<T>>,
    pub(crate) order: Order,
    /// Loads: first the forces at centres of mass for bodies with a factor of gravity, then the loads of effects.
    pub(crate) loads: Vec<Load<T, S>>,
    /// Number of loads that represent factors of gravity.
    pub(crate) n_weights: usize,
    pub(crate) rotors: Vec<LinkRotor<T>>,
    /// Index of the scene's effect for each load. Loads of gravity have no effect.
    pub(crate) effects: Vec<usize>,
    pub(crate) prescribed: Prescribed<T>,
    pub(crate) tables: Tables<T>,
    pub(crate) gravity: S::Point,
    /// Point from which the positions of links are measured, in global axes [m].
    pub(crate) base: Vector<T, 3>,
    pub(crate) length: T,
    pub(crate) floor: [T; 2],
    pub(crate) n_coordinates: usize,
    pub(crate) n_freedoms: usize,
    pub(crate) seats: Vec<TreePlace>,
    /// Origin of each link in the reference configuration, in global axes [m].
    pub(crate) origins: Vec<Vector<T, 3>>,
    /// Link of each body of the scene; 0 for a body that is welded to the ground.
    pub(crate) link_of_body: Vec<u32>,
    pub(crate) clusters: Clusters<T>,
    pub(crate) owner_of_link: Vec<Owner>,
}

/// Result of building a tree. The error in the pair is the reason why the tree has no accelerations, if any.
type Built<T, S> = Result<(TreeModel<T, S>, Option<TreeError>), TreeError>;

#[cfg(feature = "instances")]
type New<T, S> = fn(&Scene<T>, bool) -> Built<T, S>;
#[cfg(feature = "instances")]
mbs_core::instances!(
    NEW: New<T, S> = TreeModel::<T, S>::build,
    { type S = crate::Planar; } { type S = crate::Spatial; }
);

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Makes the tree of a scene that was checked before.
    ///
    /// A thin rod in space has no inertia about its line. The tree gives the rod the inertia of a sphere in two cases: the rod is free, or
    /// only balls, distances and ropes at points of its line hold it. Such a rod starts without spin about its line and never gets spin.
    /// Its motion is therefore the motion of the thin rod.
    ///
    /// Cost: of order n log n for n bodies and joints, plus the computation of the loops' elimination order.
    ///
    /// # Errors
    /// [`TreeError`] names the body or joint.
    pub fn new(scene: &Scene<T>) -> Result<Self, TreeError> {
        Ok(Self::made(scene, true)?.0)
    }

    /// Makes the tree of a scene that may have joints without inertia, and returns an error for the first such joint. A tree with such a
    /// joint has no accelerations. Places, velocities, Jacobians and the efforts of given accelerations do not need inertia.
    ///
    /// # Errors
    /// [`TreeError`] names the body or joint.
    pub fn with_lack(scene: &Scene<T>) -> Result<(Self, Option<TreeError>), TreeError> {
        Self::made(scene, false)
    }

    fn made(scene: &Scene<T>, needs_inertia: bool) -> Built<T, S> {
        #[cfg(feature = "instances")]
        if T::HAS_INSTANCES {
            return mbs_core::once::found::<New<T, S>>(NEW)(scene, needs_inertia);
        }
        Self::build(scene, needs_inertia)
    }

    fn build(scene: &Scene<T>, needs_inertia: bool) -> Built<T, S> {
        if scene.dimension.count() != S::DIMENSION {
            return Err(TreeError::Dimension);
        }
        let scene = &*aligned(scene);
        let clusters = Clusters::new(scene);
        let actions = Actions::new(scene)?;
        let graph = span(scene, &actions, &clusters)?;
        let Actions { list, prescribed, tables } = actions;
        let facts = JointFacts::new(scene, &clusters);
        let mut tree = Self::ground(scene, clusters, (prescribed, tables));
        for branch in &graph.branches {
            tree.add_branch((scene, &facts), *branch);
        }
        let lack = tree.check_ends().and_then(|()| tree.check_inertia()).err();
        if let Some(lack) = lack.filter(|_| needs_inertia) {
            return Err(lack);
        }
        for &cut in &graph.cuts {
            tree.add_loop(scene, cut);
        }
        tree.add_rollings(scene);
        tree.add_couplings(scene)?;
        tree.add_feedback(scene)?;
        let Self { links, loops, rows, couplings, .. } = &mut tree;
        tree.order = Order::new(links, loops, (rows, couplings));
        tree.add_weights(scene);
        tree.add_loads(scene, &list)?;
        tree.add_rotors(scene)?;
        Ok((tree, lack))
    }

    fn ground(
        scene: &Scene<T>,
        clusters: Clusters<T>,
        (prescribed, tables): (Prescribed<T>, Tables<T>),
    ) -> Self {
        let at_ground = scene.joints.iter().find_map(|joint| {
            (0..2).find(|&i| clusters.of(joint.bodies[i]).is_none()).map(|i| joint.points[i])
        });
        let base = at_ground
            .map(Vector::from)
            .or_else(|| clusters.clusters.first().map(|cluster| cluster.center))
            .unwrap_or_else(Vector::zeros);
        let mut total = T::ZERO;
        for cluster in &clusters.clusters {
            total += cluster.mass;
        }
        let length = scene_length(scene);
        let least = if total > T::ZERO { T::ONE / total } else { T::ONE };
        let ground = Link {
            parent: 0,
            kind: LinkKind::GuidedRevolute,
            z: 0,
            v: 0,
            axis: S::Spin::zero(),
            direction: S::Point::zero(),
            offset: S::Point::zero(),
            mass: T::ZERO,
            center: S::Point::zero(),
            tensor: S::tensor_from(&Matrix::zeros()),
        };
        Self {
            links: vec![ground],
            loops: Vec::new(),
            rows: Vec::new(),
            couplings: CouplingTables::default(),
            feedback: Feedback::default(),
            measured: Vec::new(),
            measures: Vec::new(),
            order: Order::default(),
            loads: Vec::new(),
            n_weights: 0,
            rotors: Vec::new(),
            effects: Vec::new(),
            prescribed,
            tables,
            gravity: scene.gravity.map_or_else(S::Point::zero, |g| S::point_from(&Vector::from(g))),
            base,
            length,
            floor: [least, least / (length * length)],
            n_coordinates: 0,
            n_freedoms: 0,
            seats: Vec::new(),
            origins: vec![base],
            link_of_body: vec![0; scene.bodies.len()],
            clusters,
            // The ground is link 0. Messages never name it.
            owner_of_link: vec![Owner::Body(0)],
        }
    }

    /// Returns the link of a cluster in the tree. For `None` it returns the ground, link 0.
    fn link_of(&self, cluster: Option<usize>) -> u32 {
        cluster.map_or(0, |c| self.link_of_body[self.clusters.clusters[c].bodies[0]])
    }

    /// Adds the links of a branch.
    fn add_branch(&mut self, (scene, facts): (&Scene<T>, &JointFacts), branch: Branch) {
        let cluster = self.clusters.clusters[branch.cluster].clone();
        let guide = branch.joint.and_then(|joint| facts.guide[joint]);
        let parts = parts(scene, &branch, guide.is_some());
        let joint = branch.joint.map(|j| &scene.joints[j]);
        let is_free = parts[0].kind == LinkKind::Free;
        let place = match joint {
            Some(joint) if !is_free => Vector::from(joint.points[usize::from(!branch.is_reversed)]),
            _ => cluster.center,
        };
        let owner = branch.joint.map_or(Owner::Body(cluster.bodies[0]), Owner::Joint);
        let first = index(self.links.len());
        let mut parent = self.link_of(branch.parent);
        for (k, part) in parts.iter().enumerate() {
            let is_last = k + 1 == parts.len();
            let (mass, center, inertia) = if is_last {
                let is_idle = S::DIMENSION == 3 && facts.is_idle[branch.cluster];
                (cluster.mass, cluster.center - place, tensor(&cluster, is_idle, &place))
            } else {
                (T::ZERO, Vector::zeros(), Matrix::zeros())
            };
            self.links.push(Link {
                parent,
                kind: part.kind,
                z: index(self.n_coordinates),
                v: index(guide.map_or(self.n_freedoms, |first| first + part.number)),
                axis: S::spin_from(&part.axis),
                direction: S::point_from(&part.axis),
                offset: S::point_from(&(place - self.origins[parent as usize])),
                mass,
                center: S::point_from(&center),
                tensor: S::tensor_from(&inertia),
            });
            self.origins.push(place);
            self.owner_of_link.push(owner);
            self.n_coordinates += part.kind.n_coordinates::<T, S>();
            self.n_freedoms += part.kind.n_freedoms::<T, S>();
            parent = index(self.links.len() - 1);
        }
        for &body in &cluster.bodies {
            self.link_of_body[body] = parent;
        }
        self.seats.push(TreePlace { branch, link: parent, first });
    }

    /// Writes the tree's coordinates in the reference configuration.
    pub(crate) fn write_reference(&self, z: &mut [T]) {
        z.fill(T::ZERO);
        for (link, origin) in self.links.iter().zip(&self.origins).skip(1) {
            if matches!(link.kind, LinkKind::Ball | LinkKind::Free) {
                S::write_rotation(&S::identity(), &mut z[link.z as usize..]);
            }
            if link.kind == LinkKind::Free {
                let at = link.z as usize + S::FREE - S::Point::N;
                own(crate::link::joint::write(&S::point_from(&(origin - self.base)), z, at));
            }
        }
    }

    /// Returns the link that carries a body.
    pub(crate) fn link(&self, body: BodyId) -> u32 {
        match body {
            BodyId::Ground => 0,
            BodyId::Body(i) => self.link_of_body[i],
        }
    }

    /// Returns the link that carries a body, and the vector from the link's origin to a point of the body [m].
    pub(crate) fn seat_point(&self, body: BodyId, at: [T; 3]) -> (u32, S::Point) {
        let link = self.link(body);
        (link, S::point_from(&(Vector::from(at) - self.origins[link as usize])))
    }

    /// Returns the tables of the mechanism as slices.
    #[must_use]
    pub fn mechanism(&self) -> TreeSlices<'_, T, S> {
        TreeSlices {
            links: &self.links,
            loops: Loops {
                loops: &self.loops,
                rows: &self.rows,
                plan: self.order.plan(),
                floor: self.floor,
                couplings: self.couplings.slices(self.tables.codes()),
            },
            loads: &self.loads,
            rotors: &self.rotors,
            tables: self.tables.law_inputs(&[]),
            feedback: FeedbackSlices {
                steps: &self.feedback.steps,
                links: &self.measured,
                measures: &self.measures,
                n_states: self.feedback.starts.len(),
                signals: &self.feedback.signals,
            },
            gravity: self.gravity,
            base: S::point_from(&self.base),
            length: self.length,
            n_coordinates: self.n_coordinates,
            n_freedoms: self.n_freedoms,
        }
    }

    /// Returns the user-defined laws that are objects.
    #[must_use]
    pub fn codes(&self) -> &Codes {
        self.tables.codes()
    }

    /// Returns the index of the scene's effect for each load of the mechanism. Loads of gravity have the index `usize::MAX`.
    #[must_use]
    pub fn effect_of_load(&self) -> &[usize] {
        &self.effects
    }

    /// True if another tree has the same coordinates, velocities and rows of cut joints, in the same order. This holds for the trees of a
    /// scene with and without an effect, unless the effect determines which joint is cut.
    #[must_use]
    pub fn has_same_coordinates(&self, other: &Self) -> bool {
        let sizes = |tree: &Self| [tree.n_coordinates, tree.n_freedoms, tree.rows.len()];
        let same = |(a, b): (&Link<T, S>, &Link<T, S>)| (a.kind, a.z, a.v) == (b.kind, b.z, b.v);
        sizes(self) == sizes(other)
            && self.seats == other.seats
            && self.links.iter().zip(&other.links).all(same)
    }

    /// Returns guides and signals. They give the indices of a state's inputs, and set the inputs.
    #[must_use]
    pub fn prescribed(&self) -> &Prescribed<T> {
        &self.prescribed
    }

    /// Number of freedoms of the tree: a ball has three, a free body six (in the plane three), a guided joint none.
    #[must_use]
    pub fn n_freedoms(&self) -> usize {
        self.n_freedoms
    }

    /// Number of equations of cut joints and couplings.
    #[must_use]
    pub fn n_rows(&self) -> usize {
        self.rows.len()
    }

    /// Number of links without the ground. The massless parts of composed joints are included.
    #[must_use]
    pub fn n_links(&self) -> usize {
        self.links.len() - 1
    }

    /// Returns the indices of the cut joints, one for each loop.
    pub fn cut_joints(&self) -> impl Iterator<Item = usize> + '_ {
        let rolls = |lap: &&ClosedLoop<T, S>| {
            self.rows.get(lap.first as usize).is_some_and(Row::begins_rolling)
        };
        let cut = self.mechanism().loops.cut();
        cut.iter().filter(move |lap| !rolls(lap)).map(|lap| lap.joint as usize)
    }

    /// Returns the characteristic length of the scene [m].
    pub fn length(&self) -> T {
        self.length
    }
}

impl<T: Real> Inputs<T> for (&Prescribed<T>, &[T]) {
    fn evaluate(&self, t: T, guides: &mut [[T; 3]], courses: &mut [[T; 3]]) {
        self.0.write(t, self.1, guides, courses);
    }
}

/// Returns the inertia tensor of a cluster about a point [kg m^2].
fn tensor<T: Real>(cluster: &Cluster<T>, is_idle: bool, at: &Vector<T, 3>) -> Matrix<T, 3> {
    let mut inertia = cluster.inertia;
    if is_idle {
        let i = &cluster.inertia;
        let transverse = (i[(0, 0)] + i[(1, 1)] + i[(2, 2)]) * T::HALF;
        inertia = Matrix::<T, 3>::identity() * transverse;
    }
    let d = cluster.center - at;
    inertia + (Matrix::<T, 3>::identity() * d.dot(&d) - d * d.transpose()) * cluster.mass
}

/// Returns the parts of a branch's joint, from the parent to the child.
pub(crate) fn parts<T: Real>(scene: &Scene<T>, branch: &Branch, is_guided: bool) -> Vec<Part<T>> {
    let zero = Vector::<T, 3>::zeros();
    let free = Part { kind: LinkKind::Free, axis: zero, number: 0 };
    if branch.is_point {
        let slide = |number| Part { kind: LinkKind::Prismatic, axis: unit(number), number };
        return (0..scene.dimension.count()).map(slide).collect();
    }
    let Some(joint) = branch.joint else { return vec![free] };
    let joint: &Joint<T> = &scene.joints[joint];
    if joint.kind.is_free() && !is_guided && !branch.is_apart {
        return vec![free];
    }
    let (turn, slide, ball) = if is_guided {
        (LinkKind::GuidedRevolute, LinkKind::GuidedPrismatic, LinkKind::GuidedBall)
    } else {
        (LinkKind::Revolute, LinkKind::Prismatic, LinkKind::Ball)
    };
    let sense = if is_guided { unit(0) } else { zero };
    let part = |(number, freedom)| match freedom {
        Freedom::Slide(axis) => Part { kind: slide, axis: joint.direction(axis), number },
        Freedom::Turn(axis) => Part { kind: turn, axis: joint.direction(axis), number },
        Freedom::Ball => Part { kind: ball, axis: sense, number },
    };
    let mut parts: Vec<Part<T>> = joint.kind.numbered(scene.dimension).map(part).collect();
    if branch.is_reversed {
        parts.reverse();
        for part in &mut parts {
            part.axis = -part.axis;
        }
    }
    parts
}

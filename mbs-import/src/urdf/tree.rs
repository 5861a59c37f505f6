//! Tree of the links and joints of a URDF, as a model or as a part of another model.

use super::root::{Graph, WORLD};
use super::{control, drake, joint, link};
use crate::context::{Context, Named};
use crate::element::Element;
use crate::pose::Pose;
use crate::robot::{Joint, Link, Robot, scene_name};
use crate::source::{Origin, Read};

/// Tree of a URDF. Its links are already in the robot, in the frame of the root link; its joints are not.
pub(crate) struct Tree {
    links: Named,
    /// Names of the links in the file.
    names: Vec<String>,
    /// Index of the first link.
    first: usize,
    joints: Vec<Joint>,
    /// Names of the joints in the file.
    joint_names: Vec<String>,
    /// Index of the root link.
    pub(crate) trunk: usize,
    /// Prefix of the names in the scene.
    prefix: String,
}

impl Tree {
    /// Adds the links of a URDF to a robot, and reads its joints. `prefix` precedes the names in the scene.
    pub(crate) fn read(
        root: &Element,
        prefix: &str,
        robot: &mut Robot,
        context: &Context<'_>,
    ) -> Read<Self> {
        let first = robot.links.len();
        let mut links = Named::new("link", first);
        let mut names = Vec::new();
        for element in root.each("link") {
            let mut link = link::read(element)?;
            let name = &element.need("name")?.value;
            links.add(name, element.at, &context.sources)?;
            link.name = scene_name(&format!("{prefix}{name}"), "link");
            names.push(name.clone());
            robot.links.push(link);
        }
        if let Some(at) = undeclared_world(root, &links) {
            links.add(WORLD, at, &context.sources)?;
            names.push(WORLD.to_owned());
            robot.links.push(Link::new(&format!("{prefix}{WORLD}"), at));
        }
        let mut tree = Self {
            links,
            names,
            first,
            joints: Vec::new(),
            joint_names: Vec::new(),
            trunk: first,
            prefix: prefix.to_owned(),
        };
        let origins = tree.read_joints(root, context)?;
        let graph = Graph { links: &robot.links[first..], joints: &tree.joints, first };
        tree.trunk = first + graph.root(root)?;
        place(&mut tree, &mut robot.links, &origins);
        Ok(tree)
    }

    /// Reads the joints, and returns the pose of each in the frame of its parent link.
    fn read_joints(&mut self, root: &Element, context: &Context<'_>) -> Read<Vec<Pose>> {
        let mut origins = Vec::new();
        for element in root.each("joint") {
            let (joint, origin) = joint::read(element, &self.prefix, &self.links, context)?;
            self.joints.push(joint);
            self.joint_names.push(element.need("name")?.value.clone());
            origins.push(origin);
        }
        Ok(origins)
    }

    /// The name of a link in the file.
    pub(crate) fn name(&self, link: usize) -> &str {
        &self.names[link - self.first]
    }

    /// The names of all links in the file, with their indices.
    pub(crate) fn links(&self) -> Vec<(String, usize)> {
        self.names.iter().cloned().zip(self.first..).collect()
    }

    /// The joints: name and place in the file, and the name of the child link.
    pub(crate) fn joints(&self) -> Vec<(String, Origin, String)> {
        let all = self.joint_names.iter().zip(&self.joints);
        all.map(|(name, joint)| (name.clone(), joint.at, self.name(joint.child).to_owned()))
            .collect()
    }

    /// Places the tree in its robot at a pose, and adds its joints, shapes and laws.
    pub(crate) fn add(
        self,
        root: &Element,
        place: &Pose,
        robot: &mut Robot,
        context: &mut Context<'_>,
    ) -> Read<()> {
        self.place_links(root, place, robot, context)?;
        let [first, first_coupling] = [robot.joints.len(), robot.couplings.len()];
        let mut joints = Named::new("joint", first);
        for (mut joint, element) in self.joints.into_iter().zip(root.each("joint")) {
            joints.add(&element.need("name")?.value, element.at, &context.sources)?;
            joint.place = place.point(&joint.place);
            joint.axes.iter_mut().for_each(|axis| *axis = place.turn * *axis);
            robot.joints.push(joint);
        }
        for (number, element) in (first..).zip(root.each("joint")) {
            joint::laws(element, number, &joints, robot, context)?;
        }
        joint::check_mimics(robot, first_coupling)?;
        drake::loops(root, &self.links, &self.prefix, robot)?;
        drake::frames(root, &self.links, &self.prefix, robot)?;
        control::inputs(root, &joints, robot, context)
    }

    /// Places a static tree in its robot at a pose. Its joints are left out, and its links and shapes remain.
    pub(crate) fn add_still(
        self,
        root: &Element,
        place: &Pose,
        robot: &mut Robot,
        context: &mut Context<'_>,
    ) -> Read<()> {
        self.place_links(root, place, robot, context)?;
        drake::frames(root, &self.links, &self.prefix, robot)?;
        root.read_whole();
        Ok(())
    }

    /// Places the links in their robot at a pose, and adds their shapes.
    fn place_links(
        &self,
        root: &Element,
        place: &Pose,
        robot: &mut Robot,
        context: &mut Context<'_>,
    ) -> Read<()> {
        for link in &mut robot.links[self.first..self.first + self.names.len()] {
            link.mass = link.mass.map(|mass| mass.seen_from(place));
            link.pose = place.then(&link.pose);
        }
        let colours = link::colours(root)?;
        for (link, element) in (self.first..).zip(root.each("link")) {
            link::shapes(element, link, &colours, (robot, context))?;
        }
        Ok(())
    }
}

/// Place of a joint whose parent is `world`, if no link has this name.
fn undeclared_world(root: &Element, links: &Named) -> Option<Origin> {
    if links.get(WORLD).is_some() {
        return None;
    }
    let parents = root.children.iter().filter(|child| child.name == "joint");
    let mut parents = parents.flat_map(|joint| &joint.children).filter(|x| x.name == "parent");
    parents.find_map(|parent| {
        let link = parent.attributes.iter().find(|attribute| attribute.name == "link")?;
        (link.value == WORLD).then_some(link.at)
    })
}

/// Converts links and joints from the frames of the file to the frame of the root link, with all joints at zero.
fn place(tree: &mut Tree, links: &mut [Link], origins: &[Pose]) {
    let mut of_parent = vec![Vec::new(); tree.names.len()];
    for (number, joint) in tree.joints.iter().enumerate() {
        of_parent[joint.parent - tree.first].push(number);
    }
    let mut open = vec![tree.trunk];
    while let Some(link) = open.pop() {
        let pose = links[link].pose;
        for number in &of_parent[link - tree.first] {
            let joint = &mut tree.joints[*number];
            let here = pose.then(&origins[*number]);
            joint.place = here.at;
            for axis in &mut joint.axes {
                *axis = here.turn * *axis;
            }
            links[joint.child].pose = here;
            open.push(joint.child);
        }
        let link = &mut links[link];
        link.mass = link.mass.map(|mass| mass.seen_from(&pose));
    }
}

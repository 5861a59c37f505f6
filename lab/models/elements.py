"""Writes the lists of elements and attributes: elements.py mjcf | elements.py sdf CHECKOUT_OF_SDFORMAT

A line is `parent/element attribute`; `-` in place of an attribute is the element itself. The list of URDF is kept by hand.
"""

import sys
from pathlib import Path
from xml.etree import ElementTree

import mujoco

POSE = "pos quat axisangle xyaxes zaxis euler"
FRAME_CHILDREN = "body joint freejoint geom site camera light frame replicate composite flexcomp attach include"

# What is resolved before the schema, or was in the format until version 3; the schema of version 4 has none of it.
MJCF_BEYOND = {
    "/mujocoinclude": "",
    "mujoco/include": "file",
    "mujoco/worldbody": "",
    "mujoco/deformable": "",
    "body/frame": f"name childclass {POSE}",
    "body/replicate": "count sep offset euler prefix",
    "body/composite": "prefix type count offset spacing vertex initial curve size solrefsmooth solimpsmooth face quat",
    "composite/joint": "kind group stiffness damping armature frictionloss limited range margin axis type",
    "composite/tendon": "kind solreffix solimpfix limited range stiffness damping width rgba group material margin",
    "composite/skin": "material texcoord rgba inflate subgrid group",
    "composite/pin": "coord",
    "composite/plugin": "plugin instance",
    "mujoco/compiler": "convexhull exactmeshinertia",
    "mujoco/option": "apirate collision mpr_iterations mpr_tolerance",
    "option/flag": "passive sensornoise",
    "body/light": "directional",
    "default/light": "directional",
    "tendon/fixed": "joint",
    "equality/distance": "name class active solref solimp geom1 geom2 distance",
}

# Parts of SDF that do not act on a mechanism: their inside is left out.
SDF_CLOSED = {
    "sensor", "light", "scene", "gui", "state", "material", "plugin", "particle_emitter", "audio", "audio_sink",
    "audio_source", "projector", "battery", "atmosphere", "spherical_coordinates", "population", "road", "actor",
    "surface", "heightmap", "image", "physics",
}
SDF_VERSIONS = [f"1.{minor}" for minor in range(4, 13)]
DRAKE = {
    "model/drake:joint": "@name @type parent child damping",
    "model/drake:linear_bushing_rpy": "frameA frameC force_damping force_stiffness torque_damping torque_stiffness",
    "model/drake:linear_spring_damper": "body_A body_B p_AP p_BQ damping free_length stiffness",
    "model/drake:ball_constraint": "body_A body_B p_AP p_BQ",
    "model/drake:tendon_constraint": "joint offset lower_limit upper_limit stiffness damping",
    "model/drake:collision_filter_group": "@name @ignore member member_group ignored_collision_filter_group",
    "joint/drake:mimic": "@joint @multiplier @offset",
    "joint/drake:rotor_inertia": "",
    "joint/drake:gear_ratio": "",
    "joint/drake:controller_gains": "@p @d",
    "joint/drake:screw_thread_pitch": "",
    "limit/drake:acceleration": "",
    "geometry/drake:capsule": "radius length",
    "geometry/drake:ellipsoid": "a b c",
    "mesh/drake:declare_convex": "",
    "collision/drake:proximity_properties": "",
    "link/drake:deformable_properties": "",
    "visual/drake:accepting_renderer": "",
    "visual/drake:perception_properties": "",
    "visual/drake:illustration_properties": "",
    "link/drake:visual": "",
}
# Their inner names carry the name of the constraint; `p_AP` of a ball constraint is drake:ball_constraint_p_AP.
DRAKE_LONG = {"linear_spring_damper", "ball_constraint", "tendon_constraint"}


def mjcf():
    """The schema that MuJoCo prints, an element a line with three blanks a level, and MJCF_BEYOND."""
    lines, parents = set(), []
    for line in mujoco.mj_printSchema(False, False).splitlines():
        words, depth = line.split(), (len(line) - len(line.lstrip())) // 3
        if len(words) > 1 and words[1] in ("(!)", "(?)", "(*)", "(R)"):
            name = words[0].replace("(world)", "")
            parents[depth:] = [name]
            element = f"{parents[depth - 1] if depth else ''}/{name}"
            lines.add((element, "-"))
            words = words[2:]
        lines |= {(element, word) for word in words}
    for element, attributes in MJCF_BEYOND.items():
        lines.add((element, "-"))
        lines |= {(element, word) for word in attributes.split()}
    lines |= {(f"{holder}/{name}", "-") for holder in ("frame", "replicate") for name in FRAME_CHILDREN.split()}
    return lines


def sdf(checkout):
    """The descriptions of all versions in one list, and what Drake adds."""
    lines = set()

    def walk(element, parent, folder, seen):
        name = element.get("name")
        path = f"{parent}/{name}"
        lines.add((path, "-"))
        lines.update((path, attribute.get("name")) for attribute in element.findall("attribute"))
        if path in seen or name in SDF_CLOSED or (parent == "world" and name in ("joint", "road")):
            return
        for child in element.findall("element"):
            if child.get("name"):
                walk(child, name, folder, seen | {path})
        for include in element.findall("include"):
            inner = ElementTree.parse(folder / include.get("filename")).getroot()
            walk(inner, name, folder, seen | {path})

    for version in SDF_VERSIONS:
        folder = Path(checkout) / "sdf" / version
        if (folder / "root.sdf").exists():
            walk(ElementTree.parse(folder / "root.sdf").getroot(), "", folder, frozenset())
    # of pybullet
    lines.add(("link/contact", "-"))
    for element, inner in DRAKE.items():
        name = element.split("/")[1]
        lines.add((element, "-"))
        for word in inner.split():
            long = name.split(":")[1]
            if word.startswith("@"):
                lines.add((element, word[1:]))
            elif long in ("capsule", "ellipsoid") and "drake:" in name:
                lines.add((f"{name}/{word}", "-"))
            else:
                stem = "bushing" if long == "linear_bushing_rpy" else long
                full = f"{stem}_{word}" if long in DRAKE_LONG or stem == "bushing" else word
                lines.add((f"{name}/drake:{full}", "name" if long == "collision_filter_group" else "-"))
    return lines


def main():
    lines = mjcf() if sys.argv[1] == "mjcf" else sdf(sys.argv[2])
    for element, attribute in sorted(lines):
        print(element, attribute)


if __name__ == "__main__":
    main()

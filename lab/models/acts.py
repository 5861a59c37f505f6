"""Which lines of an import's lists are of something that acts on the motion that is compared."""

# What is off in every reference, acts as in the other program, or cannot act: parts of what a line says.
HARMLESS = (
    "contact", "sensors measure", "settings of", "softness of a constraint", "a soft constraint there", "are soft constraints there",
    "is a soft constraint there", "not active", "data without effect", "ends without stiffness", "stops act from the end", "springdamper: ",
    "limits of a controller", "they do not act", "a body that is set from outside", "the interface is no effort", "the joint gets no input",
    "there is nothing to hold", "what a controller does", "dry friction falls to zero", "gear ratio", "the input is the effort",
    "no effect in the format", "says where a sensor sits", "code of another simulator", "no range is taken", "a program once read it",
    "the robot has no joint of that name", "as `balanceinertia` asks", "the frame of a free joint stays",
)

# Attributes of forms that could touch: they are of contacts alone.
TOUCHING = ("@contype", "@conaffinity", "@condim", "@friction", "@margin", "@priority", "@solref", "@solimp")


def is_harmless(entry):
    is_touching = "/geom" in entry["element"] and entry["element"].endswith(TOUCHING)
    return is_touching or any(word in entry["says"] for word in HARMLESS)


def lines(kind, found):
    """`element: says` of what acts. A URDF's reader takes no notice of words that it does not know, as the own program takes none."""
    listed = [*found["approximated"], *found["ignored"]]
    unknown = ("unknown", "not read") if kind == "urdf" else ()
    listed = [entry for entry in listed if not any(word in entry["says"] for word in unknown)]
    return sorted({f"{entry['element']}: {entry['says']}" for entry in listed if not is_harmless(entry)})

"""Counts the elements and attributes of all files of the packages: survey.py [urdf|mjcf|sdf]

A line `element attribute count files`; an element alone has `-` for its attribute. Elements of MJCF below
`default` count under their own name. SDF has values as elements: the line is the element with its parent.
"""

import re
import sys
from collections import Counter
from xml.etree.ElementTree import ParseError

import common


def plain(name):
    """`{where}name`, as the parser says it, as `prefix:name`; of an address the last word is the prefix."""
    return re.sub(r"\{(?:.*/)?#?([^/}]*)/?\}", r"\1:", name)


def walk(root, kind, uses):
    """Counts below one root, by a loop: nesting may be deep."""
    open_elements = [(root, "")]
    while open_elements:
        element, parent = open_elements.pop()
        name = plain(element.tag)
        line = f"{parent}/{name}" if kind == "sdf" and parent else name
        uses[line, "-"] += 1
        for attribute in element.attrib:
            uses[line, plain(attribute)] += 1
        open_elements.extend((child, name) for child in element)


def survey(kind):
    uses, files = Counter(), Counter()
    for package, path, found in common.models():
        if found == kind or (kind == "mjcf" and found == "fragment"):
            own = Counter()
            try:
                walk(common.tree(common.data() / package / path), kind, own)
            except ParseError as fault:
                print(f"# {package}/{path}: {fault}")
            uses += own
            files.update(own.keys())
    return uses, files


def main():
    for kind in sys.argv[1:] or ["urdf", "mjcf", "sdf"]:
        uses, files = survey(kind)
        print(f"# {kind}: {len(uses)} kinds")
        for element, attribute in sorted(uses):
            print(element, attribute, uses[element, attribute], files[element, attribute])


if __name__ == "__main__":
    main()

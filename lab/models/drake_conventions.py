"""Writes what Drake says of the SDF files on conventions, and of URDFs with its own elements: drake_conventions.py. Wants `setup.sh drake`."""

import json
import zlib

import numpy as np

import common
from drake_model import Drake


def plain(thing):
    if isinstance(thing, dict):
        return {key: plain(value) for key, value in thing.items()}
    return thing.tolist() if isinstance(thing, (np.ndarray, np.generic)) else thing


def main():
    folder, lines = common.HERE / "conventions", []
    for path in sorted([*folder.glob("*.sdf"), *folder.glob("drake_*.urdf")]):
        model = Drake(path)
        found = {"bodies": model.bodies()} | model.numbers(np.random.default_rng(zlib.crc32(path.name.encode())))
        lines.append(f"{json.dumps(path.name)}:{json.dumps(plain(found), separators=(',', ':'))}")
    head = json.dumps({"by": "drake 1.51.1"})
    text = head[:-1] + ',"files":{\n' + ",\n".join(lines) + "\n}}\n"
    (folder / "sdf.json").write_text(text)
    print(len(lines), "files,", len(text) // 1000, "kB")


if __name__ == "__main__":
    main()

"""Damages model files and imports them: mutate.py FORMAT [--count N] [--mbs COMMAND] [--check COMMAND]

FORMAT is urdf, xml or sdf. Each text must be imported, or refused with a place within a second; what is imported must be
accepted or refused by `mbs check`. Anything else is a fault, and its text is kept.
"""

import argparse
import random
import re
import subprocess
import sys
import time

import common

NUMBERS = ["nan", "inf", "-1", "0", "1e999", "1,5", "0x10", "", "1 2", "-0", "1e-320", "abc", "9" * 400]
LIMIT = 1.0


def texts(kind):
    found = [p.read_bytes() for p in sorted((common.HERE / "conventions").glob(f"*.{kind}"))]
    ending = {"urdf": "urdf", "xml": "mjcf", "sdf": "sdf"}[kind]
    for line in (common.HERE / "committed.txt").read_text().split():
        path = common.data() / line
        if path.exists() and common.format_of(path) == ending and path.stat().st_size < 40_000:
            found.append(path.read_bytes())
    return found


def damaged(data, draw):
    """One of six damages, or two of them."""
    way = draw.randrange(7)
    lines = data.split(b"\n")
    if way == 0:
        i = draw.randrange(len(data))
        return data[:i] + bytes([draw.randrange(256)]) + data[i + 1:]
    if way == 1:
        i = draw.randrange(len(lines))
        return b"\n".join(lines[:i] + [lines[i]] + lines[i:])
    if way == 2:
        return b"\n".join(line for i, line in enumerate(lines) if i != draw.randrange(len(lines)))
    if way == 3:
        attributes = list(re.finditer(rb'\s[\w:]+="[^"]*"', data))
        spot = draw.choice(attributes) if attributes else None
        return data[:spot.start()] + data[spot.end():] if spot else data
    if way == 4:
        numbers = list(re.finditer(rb"-?\d+\.?\d*(e-?\d+)?", data))
        spot = draw.choice(numbers) if numbers else None
        return data[:spot.start()] + draw.choice(NUMBERS).encode() + data[spot.end():] if spot else data
    if way == 5:
        names = list(re.finditer(rb'="[A-Za-z_]\w*"|>[A-Za-z_]\w*<', data))
        a, b = (draw.choice(names), draw.choice(names)) if names else (None, None)
        return data[:a.start() + 1] + data[b.start() + 1:b.end() - 1] + data[a.end() - 1:] if a and a.group()[0] == b.group()[0] else data
    return damaged(damaged(data, draw), draw)


def fault(command, wants_place):
    """None, or what is wrong with how a command ended."""
    started = time.monotonic()
    try:
        done = subprocess.run(command, capture_output=True, timeout=20)
    except subprocess.TimeoutExpired:
        return "hangs", 1
    said = done.stderr.decode(errors="replace")
    if done.returncode not in (0, 1) or "panicked" in said:
        return f"exit {done.returncode}: {said[:200]}", done.returncode
    if done.returncode and wants_place and not re.search(r":\d+(:\d+)?: ", said):
        return f"no place: {said[:200]}", 1
    if time.monotonic() - started > LIMIT:
        return f"{time.monotonic() - started:.1f} s", done.returncode
    return None, done.returncode


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("kind", choices=["urdf", "xml", "sdf"])
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--mbs", default="mbs")
    parser.add_argument("--check", help="a command with `check`, if it is another one")
    options = parser.parse_args()
    folder = common.folder() / "mutated"
    folder.mkdir(parents=True, exist_ok=True)
    draw, sources, faults, refused = random.Random(options.seed), texts(options.kind), 0, 0
    for i in range(options.count):
        path, scene = folder / f"{options.kind}-{i}.{options.kind}", folder / "scene.toml"
        path.write_bytes(damaged(draw.choice(sources), draw))
        says, code = fault([options.mbs, "import", str(path), "-o", str(scene)], True)
        if says is None and code == 0:
            says, _ = fault([options.check or options.mbs, "check", str(scene)], True)
        refused += code != 0
        if says:
            faults += 1
            print(f"{path.name}: {says}", flush=True)
        else:
            path.unlink()
    print(f"{options.count} texts, {refused} refused, {faults} faults")
    return faults > 0


if __name__ == "__main__":
    sys.exit(main())

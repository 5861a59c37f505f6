"""Tables of what agree.py has found: counts by package and format, and a line for each file."""

import csv
from collections import defaultdict

import common

COUNTS = ["package", "format", "files", "sound", "empty", "refused", "refused_sound", "listed", "compared", "agree", "worst"]
FILES = ["package", "path", "format", "sha256", "sound", "imported", "acts", "agrees", "acceleration", "motion", "saved", "says", "why"]


def is_compared(row):
    return row["sound"] and row["imported"] == "yes" and not row["acts"] and (row.get("acceleration") is not None or row.get("broken"))


def is_empty(row):
    """A file that other files include, or a floor: there is no body in it."""
    return row["sound"] and "the model has no body" in row.get("says", "")


def counts(rows):
    """One row of numbers for files of one kind; files without a body count as empty, not as refused."""
    read = [row for row in rows if row["imported"] == "yes"]
    judged = [row for row in rows if is_compared(row)]
    worst = [row[key] for row in judged if row["agrees"] for key in ("acceleration", "motion") if row.get(key) is not None]
    return {
        "files": len(rows),
        "sound": sum(row["sound"] for row in rows),
        "empty": sum(map(is_empty, rows)),
        "refused": len(rows) - len(read) - sum(map(is_empty, rows)),
        "refused_sound": sum(row["sound"] and not is_empty(row) for row in rows if row["imported"] == "no"),
        "listed": sum(bool(row["acts"]) for row in read if row["sound"]),
        "compared": len(judged),
        "agree": sum(row["agrees"] for row in judged),
        "worst": f"{max(worst):.1e}" if worst else "",
    }


def line(row):
    show = {key: f"{row[key]:.1e}" for key in ("acceleration", "motion", "saved_difference") if row.get(key) is not None}
    words = {"sound": row["sound"], "imported": row["imported"], "agrees": row.get("agrees"), "acts": len(row.get("acts", []))}
    says = {key: row[key] for key in ("saved", "says", "why") if row.get(key)}
    return " ".join([f"{row['package']}/{row['path']}", *(f"{key}={value}" for key, value in (words | show | says).items())])


def write(folder, rows):
    groups = defaultdict(list)
    for row in rows:
        groups[row["package"], row["format"]].append(row)
    with open(folder / "counts.csv", "w", newline="") as file:
        table = csv.DictWriter(file, COUNTS, restval="", lineterminator="\n")
        table.writeheader()
        for (package, kind), group in sorted(groups.items()):
            table.writerow({"package": package, "format": kind} | counts(group))
        for kind in ("urdf", "mjcf", "sdf"):
            group = [row for row in rows if row["format"] == kind]
            table.writerow({"package": "all", "format": kind} | counts(group))
        table.writerow({"package": "all", "format": "all"} | counts(rows))
    with open(folder / "files.csv", "w", newline="") as file:
        table = csv.DictWriter(file, FILES, restval="", extrasaction="ignore", lineterminator="\n")
        table.writeheader()
        table.writerows(row | {"acts": "; ".join(row.get("acts", []))} for row in rows)
    print(counts(rows))

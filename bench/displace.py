#!/usr/bin/env python3
"""How many facades `displace` resolves whose openings are nearer to each other than a map at 1:2500 shows.

    python3 bench/displace.py PROGRAM [SCALE]

Over the houses, random3dcity and the samples (../shared, or $ORIEL_SHARED), with a pack that displaces all openings
and else changes nothing. A facade is a wall plane of a building; its openings are windows and doors as `label` finds
them, each with its outline in that plane. It is counted if two of them are nearer than 0.125 mm on the map (the
profile's c), and resolved if none are afterwards, and no opening is lost. Prints a table in Markdown, and the cause
for each facade that is not resolved, numbers left out: that a row has no room, else the commonest refusal on it.
"""
import collections
import glob
import json
import math
import os
import re
import subprocess
import sys
import tempfile

PACK = """\
schema: oriel/1
pack: {name: displacing, version: 1.0.0}
extends: residential
generalise:
  - {id: vents.omit,        scale: "1:900000 ..", for: vent, do: omit}
  - {id: stairs.omit,       scale: "1:900000 ..", for: stairs, do: omit}
  - {id: canopies.omit,     scale: "1:900000 ..", for: canopy, do: omit}
  - {id: small.omit,        scale: "1:900000 ..", for: any, do: omit}
  - {id: openings.displace, scale: "1:500 .. 1:4999", for: opening, do: displace}
"""
ON_WALL_M = 0.005  # corners this near to a wall's plane are in it
SAME_M = 0.002  # rounding of the file's grid
OPENINGS = ("Window", "Door")
LEVEL = 0.9  # what looks further up or down is the floor or the head of a recess
NO_ROOM = "its wall has no room for the row"


def files_of(root):
    shared = os.environ.get("ORIEL_SHARED", os.path.join(root, "..", "shared"))
    for name in ("houses/clean", "houses/noisy", "houses/triangles", "random3dcity"):
        yield name, sorted(glob.glob(os.path.join(shared, "data", name, "*.stripped.city.json")))
    yield "samples", sorted(glob.glob(os.path.join(root, "examples", "samples", "*.stripped.city.json")))


def normal_of(ring):
    """Newell's."""
    n = [0.0, 0.0, 0.0]
    for p, q in zip(ring, ring[1:] + ring[:1]):
        for i, (j, k) in enumerate(((1, 2), (2, 0), (0, 1))):
            n[i] += (p[j] - q[j]) * (p[k] + q[k])
    size = math.hypot(*n)
    return [c / size for c in n] if size > 0 else None


def facets_of(city):
    """(building, surface, the surface's parent's key, key, rings) of each facet with semantics."""
    scale, move = city["transform"]["scale"], city["transform"]["translate"]
    at = [[v[i] * scale[i] + move[i] for i in range(3)] for v in city["vertices"]]
    for name, thing in city["CityObjects"].items():
        building = thing.get("parents", [name])[0]
        for geometry in thing.get("geometry", []):
            semantics = geometry.get("semantics")
            if not semantics:
                continue
            shells, values = geometry["boundaries"], semantics["values"]
            if geometry["type"] != "Solid":
                shells, values = [shells], [values]
            for shell, numbers in zip(shells, values):
                for rings, number in zip(shell, numbers):
                    if number is None:
                        continue
                    surface = semantics["surfaces"][number]
                    parent = surface.get("parent")
                    yield (building, surface, (name, parent), (name, number), [[at[i] for i in r] for r in rings])


def facades_of(path):
    """{(building, plane): {opening: (u0, u1, v0, v1)}}"""
    with open(path, encoding="utf-8") as file:
        city = json.load(file)
    walls, points, wall_of = collections.defaultdict(list), collections.defaultdict(list), {}
    for building, surface, parent, key, rings in facets_of(city):
        if surface["type"] in OPENINGS and "oriel_id" in surface:
            n = normal_of(rings[0])
            if n and abs(n[2]) < LEVEL:  # the floor of a door may run on into the landing before it
                points[building, surface["oriel_id"]] += rings[0]
            wall_of[building, surface["oriel_id"]] = parent
        elif surface["type"] == "WallSurface":
            n = normal_of(rings[0])
            if n and abs(n[2]) < 0.26:
                walls[key].append((n, sum(a * b for a, b in zip(n, rings[0][0]))))
    facades = collections.defaultdict(dict)
    for (building, opening), corners in points.items():
        best, mouth = None, []
        for n, offset in walls.get(wall_of[building, opening], []):
            on = [p for p in corners if abs(sum(a * b for a, b in zip(n, p)) - offset) < ON_WALL_M]
            if len(on) > len(mouth):
                best, mouth = (n, offset), on
        if len(mouth) < 3:
            continue
        n, offset = best
        across = math.hypot(n[0], n[1])
        along = [(-n[1] * p[0] + n[0] * p[1]) / across for p in mouth]
        heights = [p[2] for p in mouth]
        plane = tuple(round(c, 2) + 0.0 for c in n) + (round(offset, 1),)
        facades[building, plane][opening] = (min(along), max(along), min(heights), max(heights))
    return facades


def distance(a, b):
    return math.hypot(max(a[0] - b[1], b[0] - a[1], 0), max(a[2] - b[3], b[2] - a[3], 0))


def are_near(openings, gap_m):
    boxes = sorted(openings.values())
    return any(distance(a, b) < gap_m - SAME_M for i, a in enumerate(boxes) for b in boxes[i + 1:])


def run(program, verb, files, *options):
    subprocess.run([program, verb, *files, *options], stderr=subprocess.DEVNULL, check=False)


def causes_on(openings, building, reasons):
    counted = collections.Counter(reasons[building, one] for one in openings if (building, one) in reasons)
    crowded = [cause for cause in counted if cause.startswith(NO_ROOM)]
    if crowded:
        return crowded[0]
    return counted.most_common(1)[0][0] if counted else "moved, but still too near"


def measured(program, files, scale, gap_m):
    causes, near, resolved = collections.Counter(), 0, 0
    with tempfile.TemporaryDirectory() as folder:
        pack, why = os.path.join(folder, "pack.yaml"), os.path.join(folder, "why.jsonl")
        with open(pack, "w", encoding="utf-8") as file:
            file.write(PACK)
        before, after = os.path.join(folder, "before", ""), os.path.join(folder, "after", "")
        run(program, "label", files, "-o", before)
        run(program, "generalise", files, "--scale", f"1:{scale}", "--rules", pack, "-o", after, "--explain", why)
        reasons = {}
        with open(why, encoding="utf-8") as lines:
            for one in map(json.loads, lines):
                if one["outcome"] == "refused" and one["operation"] == "displace":
                    cause = re.split(r", beside |; it would ", one["reason"])[0]
                    reasons[one["building"], one["id"]] = re.sub(r"\d+(\.\d+)?", "…", cause)
        for path in sorted(glob.glob(before + "*.json")):
            later = facades_of(os.path.join(after, os.path.basename(path)))
            for (building, plane), openings in facades_of(path).items():
                if not are_near(openings, gap_m):
                    continue
                near += 1
                now = {name: box for (of, _), boxes in later.items() if of == building
                       for name, box in boxes.items() if name in openings}
                if len(now) == len(openings) and not are_near(now, gap_m):
                    resolved += 1
                else:
                    causes[causes_on(openings, building, reasons)] += 1
                    if os.environ.get("ORIEL_LIST"):
                        print(os.path.basename(path), plane, file=sys.stderr)
        invalid = subprocess.run([program, "validate", *sorted(glob.glob(after + "*.json"))], check=False,
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
    return near, resolved, causes, invalid


def crowded_of(causes):
    return sum(count for cause, count in causes.items() if cause.startswith(NO_ROOM))


def main():
    program = os.path.abspath(sys.argv[1])
    scale = int(sys.argv[2]) if len(sys.argv) > 2 else 2500
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    total, done, causes, invalid = 0, 0, collections.Counter(), []
    print(f"| input | facades with openings nearer than 0.125 mm at 1:{scale} | no room | resolved | share of those with room |\n"
          "|---|---|---|---|---|")
    for name, files in files_of(root):
        if not files:
            sys.exit(f"no buildings of {name}: set ORIEL_SHARED")
        near, resolved, its, failed = measured(program, files, scale, 0.000125 * scale)
        crowded = crowded_of(its)
        print(f"| {name} | {near} | {crowded} | {resolved} | {100 * resolved / max(near - crowded, 1):.0f} % |", flush=True)
        total, done = total + near, done + resolved
        causes += its
        invalid += [name] if failed else []
    crowded = crowded_of(causes)
    print(f"| all | {total} | {crowded} | {done} | {100 * done / max(total - crowded, 1):.0f} % |")
    print("\n| cause | facades |\n|---|---|")
    for cause, count in sorted(causes.items(), key=lambda item: (-item[1], item[0])):
        print(f"| {cause} | {count} |")
    print("\nNot all valid when read back: " + (", ".join(invalid) or "none"))


if __name__ == "__main__":
    main()

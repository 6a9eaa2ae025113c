#!/usr/bin/env python3
"""What comes of every solid of some files at every target, as lines of a table.

    yield.py ORIEL NAME[:LOD] FILE...
    yield.py --header

Solids: the buildings that oriel takes as solids. Valid: their outputs that `oriel validate` calls valid, the file read
again, of all outputs, and in parentheses those that were invalid as they were read. Yield: buildings with nothing
refused or set aside. Parts: of these the buildings in which something that was to go for its size turned out to be a part
of the building and stayed (G411, G412, G418). Short: edges under the target's least length of which the input has no such
edge, found here without oriel. Left: buildings in which oriel tells such edges (G415) that it could not clear; as they
were: those in which it tells only edges of parts that stay as they were; untold: those with short edges of which it tells nothing.
ORIEL_YIELD_V=1 names the buildings that fall short.
"""
import itertools
import json
import os
import subprocess
import sys
import tempfile
from collections import defaultdict

from city_lines import records

TARGETS = [("--scale", f"1:{n}") for n in (500, 1000, 2500, 5000, 10000)] + [("--to-lod", l) for l in ("2.0", "1.2", "1.0")]
NEAR_M = 0.01  # ends of an edge that stays: planes are drawn through noisy points, which moves them by up to 8 mm


def least_edge_m(target):
    """The profile's c: 0.125 mm on the map; 2 m at levels of detail (rules/profiles/lod.yaml)."""
    return 0.000125 * float(target[2:]) if ":" in target else 2.0


def buildings(paths, lod=None):
    """id -> facets (outer and inner rings of points) of the solid at the lod, else at the highest."""
    found = {}
    for path in paths:
        for record, points in records(path):
            for name, thing in record["CityObjects"].items():
                if not thing["type"].startswith("Building") or thing["type"] == "BuildingInstallation":
                    continue
                usable = [g for g in thing.get("geometry", []) if float(g["lod"]) > 0 and lod in (None, g["lod"])]
                if usable:
                    g = max(usable, key=lambda g: float(g["lod"]))
                    depth = {"MultiSurface": 0, "CompositeSurface": 0, "Solid": 1, "MultiSolid": 2, "CompositeSolid": 2}[g["type"]]
                    facets = g["boundaries"]
                    for _ in range(depth):
                        facets = [f for part in facets for f in part]
                    found[name] = [[[points[v] for v in ring] for ring in facet] for facet in facets]
    return found


def edges(facets):
    seen = set()
    for facet in facets:
        for ring in facet:
            for p, q in zip(ring, ring[1:] + ring[:1]):
                seen.add((min(tuple(p), tuple(q)), max(tuple(p), tuple(q))))
    return seen


def distance(p, q):
    return sum((a - b) ** 2 for a, b in zip(p, q)) ** 0.5


class Edges:
    """The edges of the input; `flat`: as seen from above."""

    def __init__(self, facets, flat):
        self.flat = flat
        seen = [(self.seen(p), self.seen(q)) for p, q in edges(facets)]
        self.ends = defaultdict(list)  # by boxes of NEAR_M
        for p in {p for edge in seen for p in edge}:
            self.ends[tuple(int(c // NEAR_M) for c in p)].append(p)
        self.same = {frozenset((self.mm(p), self.mm(q))) for p, q in seen}

    def seen(self, p):
        return tuple(p[:2]) if self.flat else tuple(p)

    def mm(self, p):
        return tuple(round(1000 * c) for c in p)

    def is_end(self, p):
        around = itertools.product(*[[int(c // NEAR_M) + d for d in (-1, 0, 1)] for c in p])
        return any(distance(p, end) <= NEAR_M for box in around for end in self.ends.get(box, ()))

    def has(self, p, q):
        """An edge from a corner of the input to another one: what was between them had shorter edges."""
        p, q = self.seen(p), self.seen(q)
        return frozenset((self.mm(p), self.mm(q))) in self.same or (self.is_end(p) and self.is_end(q))


def new_short_edges(before, after, least_m, flat):
    known = None
    short = 0
    for p, q in edges(after):
        if distance(p, q) >= least_m:
            continue
        known = known or Edges(before, flat)
        if flat and distance(known.seen(p), known.seen(q)) <= NEAR_M:
            short += 1
        elif not known.has(p, q):
            short += 1
    return short


def run(arguments):
    return subprocess.run(arguments, capture_output=True, text=True)


def validity(oriel, paths, lod):
    options = ["--lod", lod] if lod else []
    lines = run([oriel, "validate", "--json", *paths, *options]).stdout.splitlines()
    return {v["id"]: v["valid"] for v in map(json.loads, lines) if v.get("lod")}


def main():
    if sys.argv[1] == "--header":
        print("| data | target | solids | changed | valid in the file (invalid as read) | done | yield | parts | short edges | left | of parts as they were | untold |")
        print("|" + "---|" * 12)
        return
    oriel, name, files = sys.argv[1], sys.argv[2], sys.argv[3:]
    name, _, lod = name.partition(":")
    before, was_valid = buildings(files, lod or None), validity(oriel, files, lod)
    profile = os.environ.get("ORIEL_YIELD_PROFILE", "")
    pack = os.environ.get("ORIEL_YIELD_RULES", "")
    for option, level in TARGETS:
        if option == "--to-lod" and lod and float(level) > float(lod):
            continue
        with tempfile.TemporaryDirectory() as folder:
            why = folder + "/why.jsonl"
            os.mkdir(folder + "/out")
            out = folder + "/out/"
            made = run([oriel, "generalise", *files, option, level, "-v", "-j", "2", "-o", out, "--explain", why,
                        *(["--lod", lod] if lod else []), *(["--rules", pack] if pack else []),
                        *(["--profile", profile] if profile and option == "--scale" else [])])
            if made.returncode not in (0, 3):
                sys.exit(made.stderr)
            written = [os.path.join(folder, "out", f) for f in sorted(os.listdir(folder + "/out"))]
            report(oriel, name + (" " + lod if lod else ""), option, level, lod, made.stderr, why, written, before, was_valid)


def report(oriel, name, option, level, lod, told, why, written, before, was_valid):
    its_lod = level if option == "--to-lod" else lod
    after, is_valid = buildings(written, its_lod or None), validity(oriel, written, its_lod)
    refused, changed, parts, solids = defaultdict(set), set(), set(), set(before)
    for deed in map(json.loads, open(why)):
        if deed["outcome"] == "refused":
            refused[deed["building"]].add(deed["code"] + " " + deed["reason"])
        elif deed["outcome"] != "kept":
            changed.add(deed["building"])
        elif deed["code"]:
            parts.add(deed["building"])
    left, whole = set(), set()
    for line in told.splitlines():
        words = line.split()
        if len(words) > 3 and "G415" in words[2:4]:
            (whole if "stay as they were" in line else left).add(words[1].rstrip(":"))
        if len(words) < 3 or words[0] not in ("error:", "warning:"):
            continue
        building, code = words[1].rstrip(":"), words[2]
        if words[0] == "error:" and (code.startswith("E") or code == "G404"):
            solids.discard(building)  # not closed, or not read
        elif words[0] == "error:" or code == "G410":
            refused[building].add(code)
    outputs = solids & set(after)
    short = {b: new_short_edges(before[b], after[b], least_edge_m(level), option == "--to-lod" and level < "2")
             for b in outputs if option == "--to-lod" or b in changed}
    valid = sum(is_valid.get(b, False) for b in outputs)
    came_invalid = sum(not was_valid.get(b, False) for b in outputs if not is_valid.get(b, False))
    done = sum(b not in refused for b in solids)
    print(f"| {name} | {level} | {len(solids)} | {len(changed)} | {valid} of {len(outputs)} ({came_invalid}) | {done} | "
          f"{100 * done / max(1, len(solids)):.1f} % | {len((parts & solids) - set(refused))} | {sum(n > 0 for n in short.values())} ({sum(short.values())}) | {len(left)} | {len(whole - left)} | "
          f"{sum(n > 0 for b, n in short.items() if b not in left | whole)} |", flush=True)
    if os.environ.get("ORIEL_YIELD_V"):
        for b in sorted(solids):
            if b in refused or short.get(b) or not is_valid.get(b, False):
                print("   ", b, "" if is_valid.get(b) else "INVALID", sorted(refused[b]) if b in refused else "", short.get(b, ""))


main()

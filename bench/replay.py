#!/usr/bin/env python3
"""Series of all solids of some files, replayed both ways, as a line of a table; exit code 1 if anything is not as it has to be.

    replay.py ORIEL NAME[:LOD] FILE...
    replay.py --header

Down: levels of buildings that `--at` makes of the finest level and the log and that have the hash of what the series wrote (its
CityObjects with their attributes, and facets with points, semantics and installations), of all; up: of the coarsest and the log.
First: buildings that are the same at 1:1 from both ends, with the volume, area and features of what `--scale 1:1` draws.
Between: levels at BETWEEN that are the same from both ends. Valid: of all levels mentioned so many are, for `oriel validate`.
Prefixes: states after each operation, as series_levels.py reads the log: valid ones of all. The log has to lead to each level
and back to where it began. Set aside: buildings that have no series, by code.
ORIEL_REPLAY_V=1 names what falls short. ORIEL_REPLAY_PROFILE and ORIEL_REPLAY_RULES are a profile and a pack.
"""
import itertools
import json
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter

from series_levels import Level, apply, lumps_of

SCALES = [500, 1000, 2500, 5000, 10000]
BETWEEN = [700, 1700, 3500, 7000]
NEAR = 0.001  # of volumes and areas: what is drawn anew lies in fitted planes and on a grid
AT_ONCE = 2000  # prefixes in a file


def run(arguments):
    return subprocess.run(arguments, capture_output=True, text=True)


def findings(oriel, path, lod):
    """Codes by building, each once; none: it is valid."""
    lines = run([oriel, "validate", "--json", path, *(["--lod", lod] if lod else [])]).stdout.splitlines()
    return {v["id"]: [] if v["valid"] else sorted({f["code"] for f in v["findings"]}) or ["?"] for v in map(json.loads, lines) if v.get("lod")}


class Replay:
    def __init__(self, oriel, name, files, folder):
        self.oriel, self.folder = oriel, folder
        self.name, _, self.lod = name.partition(":")
        self.has_semantics = bool(self.lod)  # 3dbag: what is not drawn anew keeps its own names
        self.valid, self.judged, self.short = 0, 0, []
        self.options = [] if not self.lod else ["--lod", self.lod]
        for key in "profile", "rules":
            value = os.environ.get("ORIEL_REPLAY_" + key.upper())
            self.options += ["--" + key, value] if value else []
        self.make(files)

    def make(self, files):
        told = run([self.oriel, "generalise", *files, *self.options, "--series", ",".join(f"1:{s}" for s in SCALES), "-j", "2", "-o", self.folder + "/s"])
        if told.returncode not in (0, 3):
            sys.exit(told.stderr)
        self.ending = ".city.jsonl" if os.path.exists(self.folder + "/s.1-500.city.jsonl") else ".city.json"
        self.aside = dict(re.findall(r"^error: .*?(\S+): ([EG]\d+)", told.stderr, re.MULTILINE))
        for end in SCALES[0], SCALES[-1]:  # series of one level
            os.symlink(self.level_path("s", end), self.level_path(f"only{end}", end))
            os.symlink(self.folder + "/s.oplog.jsonl", f"{self.folder}/only{end}.oplog.jsonl")
        self.levels = {scale: Level(self.level_path("s", scale)) for scale in SCALES}
        self.buildings = [b for b in findings(self.oriel, self.level_path("s", SCALES[0]), self.lod) if b not in self.aside]

    def level_path(self, name, scale):
        return f"{self.folder}/{name}.1-{scale}{self.ending}"

    def judge(self, path, what):
        codes = findings(self.oriel, path, self.lod)
        for building in self.buildings:
            self.judged += 1
            self.valid += not codes[building]
            if codes[building]:
                self.short.append(f"{building} at {what}: {codes[building]}")

    def at(self, scale, end):
        path = f"{self.folder}/at{self.ending}"
        made = run([self.oriel, "generalise", "--at", f"1:{scale}", "--from", f"{self.folder}/only{end}", "-o", path])
        if made.returncode:
            self.short.append(f"1:{scale} from 1:{end}: {made.stderr.strip()}")
            return None
        return path

    def same(self, one, other, what):
        """How many buildings are the same, with what is theirs."""
        if one is None or other is None:
            return 0
        mine, its = one.hashes(), other.hashes()
        count = 0
        for building in self.buildings:
            names = {building, *one.objects[building].get("children", []), *other.objects[building].get("children", [])}
            is_same = all(mine.get(name) == its.get(name) for name in names)
            count += is_same
            if not is_same:
                self.short.append(f"{building} differs: {what}")
        if mine.keys() != its.keys():
            self.short.append(f"other CityObjects: {what}")
        return count

    def both_ways(self):
        counts = []
        for end in SCALES[0], SCALES[-1]:
            count = 0
            for scale in SCALES:
                path = self.at(scale, end)
                count += self.same(path and Level(path), self.levels[scale], f"1:{scale} from 1:{end}")
            counts.append(count)
        for scale in SCALES:
            self.judge(self.level_path("s", scale), f"1:{scale}")
        return counts

    def at_both(self, scale):
        """The level as made of the finest one, and in how many buildings the one made of the coarsest is the same."""
        paths = [self.at(scale, SCALES[0])]
        level = paths[0] and Level(paths[0])
        if level:
            self.judge(paths[0], f"1:{scale}")
        coarse = self.at(scale, SCALES[-1])
        return level, self.same(level, coarse and Level(coarse), f"1:{scale} from both ends")

    def first(self, files):
        level, same = self.at_both(1)
        drawn = self.drawn_at_once(files)
        count = 0
        for building in self.buildings if level else []:
            pairs = zip(level.figures(building, self.lod), drawn[building].figures(building, self.lod))
            is_near = all(abs(a - b) <= NEAR * b for a, b in pairs)
            other = set() if self.has_semantics else level.features(building, self.lod) ^ drawn[building].features(building, self.lod)
            count += is_near and not other
            if not is_near or other:
                self.short.append(f"{building} is not drawn as at 1:1: {level.figures(building, self.lod)} for "
                                  f"{drawn[building].figures(building, self.lod)}, {sorted(other)}")
        return min(count, same)

    def drawn_at_once(self, files):
        folder = self.folder + "/drawn/"
        os.mkdir(folder)
        run([self.oriel, "generalise", *files, *self.options, "--scale", "1:1", "-j", "2", "-o", folder])
        levels = [Level(folder + name) for name in sorted(os.listdir(folder))]
        return {name: level for level in levels for name in level.objects}

    def prefixes(self):
        self.prefix_count, self.invalid, pending = 0, 0, []
        with open(self.folder + "/s.oplog.jsonl") as log:
            operations = (line for line in map(json.loads, log) if "end" not in line)
            for building, lines in itertools.groupby(operations, lambda line: line["building"]):
                try:
                    for number, state in enumerate(self.walk(building, list(lines))):
                        pending.append(feature_line(f"{building}#{number}", state))
                        if len(pending) == AT_ONCE:
                            self.judge_prefixes(pending)
                except AssertionError as fault:
                    self.short.append(f"{building}: the log {fault}")
        self.judge_prefixes(pending)

    def walk(self, building, operations):
        """Each state of a building, from the finest to the coarsest; then all the way back."""
        state = self.levels[SCALES[0]].state(building, self.lod)
        for operation in reversed([o for o in operations if o["scale"] <= SCALES[0]]):
            apply(state, operation["inverse"])
        finest = comparable(state)
        yield state
        for before, scale in zip([0, *SCALES], [*SCALES, float("inf")]):
            for operation in operations:
                if before < operation["scale"] <= scale:
                    apply(state, operation["forward"])
                    yield state
            if scale in self.levels:
                assert comparable(state) == comparable(self.levels[scale].state(building, self.lod)), f"does not lead to 1:{scale}"
        for operation in reversed(operations):
            apply(state, operation["inverse"])
        assert comparable(state) == finest, "does not lead back"

    def judge_prefixes(self, pending):
        path = self.folder + "/prefixes.city.jsonl"
        with open(path, "w") as file:
            file.write(json.dumps({"type": "CityJSON", "version": "2.0", "CityObjects": {}, "vertices": [],
                                   "transform": {"scale": [1e-6] * 3, "translate": [0, 0, 0]}}) + "\n")
            file.writelines(pending)
        codes = findings(self.oriel, path, None)
        assert len(codes) == len(pending), "a prefix was not judged"
        self.prefix_count += len(codes)
        for name, its in codes.items():
            self.invalid += bool(its)
            if its:
                self.short.append(f"{name} is a prefix with {its}")
        pending.clear()


def comparable(state):
    facets, installations, counts = state
    return ({outer: (holes, surface, sorted(owners)) for outer, (holes, surface, owners) in facets.items()},
            {name: dict(members) for name, members in installations.items()}, dict(counts))


def feature_line(name, state):
    numbers = {}
    lumps = [[[[[numbers.setdefault(p, len(numbers)) for p in ring] for ring in rings] for rings in shell] for shell in lump]
             for lump in lumps_of([(outer, *holes) for outer, (holes, _, _) in state[0].items()])]
    kind = "Solid" if len(lumps) == 1 else "MultiSolid"
    geometry = {"type": kind, "lod": "2", "boundaries": lumps[0] if kind == "Solid" else lumps}
    return json.dumps({"type": "CityJSONFeature", "id": name, "vertices": list(numbers),
                       "CityObjects": {name: {"type": "Building", "geometry": [geometry]}}}) + "\n"


def main():
    if sys.argv[1] == "--header":
        print("| data | buildings | down | up | first | between | valid | prefixes | set aside |")
        print("|" + "---|" * 9)
        return 0
    oriel, name, files = sys.argv[1], sys.argv[2], sys.argv[3:]
    with tempfile.TemporaryDirectory() as folder:
        replay = Replay(oriel, name, files, folder)
        down, up = replay.both_ways()
        first = replay.first(files)
        between = sum(replay.at_both(scale)[1] for scale in BETWEEN)
        replay.prefixes()
    n = len(replay.buildings)
    aside = ", ".join(f"{count} {code}" for code, count in sorted(Counter(replay.aside.values()).items()))
    print(f"| {replay.name} {replay.lod} | {n} | {down} of {n * len(SCALES)} | {up} of {n * len(SCALES)} | {first} of {n} | "
          f"{between} of {n * len(BETWEEN)} | {replay.valid} of {replay.judged} | "
          f"{replay.prefix_count - replay.invalid} of {replay.prefix_count} | {aside or 'none'} |", flush=True)
    if os.environ.get("ORIEL_REPLAY_V"):
        print("\n".join("    " + fault for fault in replay.short), flush=True)
    return 1 if replay.short else 0


sys.exit(main())

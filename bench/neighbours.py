#!/usr/bin/env python3
"""Rows and blocks measured: python3 bench/neighbours.py ORIEL GENERATE [--houses N] [--tile FILE] [--scales 10000,25000]

Generalises a generated city, and a tile if there is one, with --neighbours and a profile that asks for groups, and judges the
output by a reader and measures of its own: valid solids (oriel validate), ground that two buildings cover, contacts that were
lost, ground covered before and after, and one hash over shards, threads and orders. One line of JSON for each.
"""
import argparse
import hashlib
import json
import math
import os
import subprocess
import sys
import tempfile
import time
from collections import defaultdict

PROFILE = """schema: oriel-profile/1
profile: {name: town, version: 1.0.0}
levels:
  map: {form: as-is, map-mm: 0.3, verdicts: {point: omit, line: omit, small: omit}, buildings: {aggregate: touching, gap-mm: 0.2}}
"""
TOUCH = 0.05  # metres, as kContact_m
LINE = 0.01  # metres: eaves and ridges that differ by no more are in line


def run(*call, ok=(0, 3)):
    done = subprocess.run(call, capture_output=True, text=True)
    if done.returncode not in ok:
        sys.exit(f"{' '.join(call)}: exit code {done.returncode}\n{done.stderr}")
    return done


def measured(*call):
    """Seconds by the clock and the peak of memory in MB of a call."""
    start = time.perf_counter()
    with subprocess.Popen(call, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 3):
        sys.exit(f"{' '.join(call)}: exit code {process.returncode}")
    return time.perf_counter() - start, usage.ru_maxrss / 1000


def features(path):
    """(id, attributes, polygons) of every building, each polygon a list of rings of points."""
    with open(path) as file:
        head = json.loads(file.readline())
        lines = file if head["type"] == "CityJSON" and path.endswith(".jsonl") else []
        if not path.endswith(".jsonl"):
            yield from buildings(head, head["transform"])
        for line in lines:
            yield from buildings(json.loads(line), head["transform"])


def buildings(record, transform):
    scale, move = transform["scale"], transform["translate"]
    points = [[v[k] * scale[k] + move[k] for k in range(3)] for v in record["vertices"]]
    for name, thing in record["CityObjects"].items():
        if thing["type"] not in ("Building", "BuildingPart") or not thing.get("geometry"):
            continue
        if "oriel_member_of" in thing.get("attributes", {}):
            continue
        best = max(thing["geometry"], key=lambda g: float(g["lod"]))
        if float(best["lod"]) < 1:
            continue
        shells = best["boundaries"]
        flat = {"Solid": lambda b: [p for s in b for p in s], "MultiSurface": lambda b: b, "CompositeSurface": lambda b: b,
                "MultiSolid": lambda b: [p for solid in b for s in solid for p in s]}[best["type"]](shells)
        yield name, thing.get("attributes", {}), [[[points[i] for i in ring] for ring in polygon] for polygon in flat]


def area(ring):
    return sum(ring[i - 1][0] * ring[i][1] - ring[i][0] * ring[i - 1][1] for i in range(len(ring))) / 2


def normal_z(ring):
    n = [0.0, 0.0, 0.0]
    for i in range(len(ring)):
        p, q = ring[i - 1], ring[i]
        n[0] += (p[1] - q[1]) * (p[2] + q[2])
        n[1] += (p[2] - q[2]) * (p[0] + q[0])
        n[2] += (p[0] - q[0]) * (p[1] + q[1])
    size = math.sqrt(sum(c * c for c in n))
    return n[2] / size if size > 0 else 0


def ground_of(polygons):
    """Rings of the faces that look down within half a metre of the lowest point, the outer ones counter-clockwise."""
    low = min(p[2] for polygon in polygons for p in polygon[0])
    rings = []
    for polygon in polygons:
        if normal_z(polygon[0]) < -0.25 and max(p[2] for p in polygon[0]) <= low + 0.5:
            rings += [[(p[0], p[1]) for p in reversed(ring)] for ring in polygon]
    return rings


def triangles(rings):
    out = []
    for ring in rings:
        for i in range(1, len(ring) - 1):
            t = (ring[0], ring[i], ring[i + 1])
            size = area(t)
            if size:
                out.append((t, 1) if size > 0 else (t[::-1], -1))
    return out


def common(t, u):
    piece = list(t)
    for i in range(3):
        a, b = u[i], u[(i + 1) % 3]
        side = lambda p: (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        cut = []
        for k in range(len(piece)):
            p, q = piece[k - 1], piece[k]
            sp, sq = side(p), side(q)
            if (sp > 0) != (sq > 0):
                s = sp / (sp - sq)
                cut.append((p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])))
            if sq > 0:
                cut.append(q)
        piece = cut
        if len(piece) < 3:
            return 0
    return area(piece)


def overlap(one, other):
    return sum(s * r * common(t, u) for t, s in triangles(one) for u, r in triangles(other)
               if max(p[0] for p in t) > min(p[0] for p in u) and max(p[0] for p in u) > min(p[0] for p in t)
               and max(p[1] for p in t) > min(p[1] for p in u) and max(p[1] for p in u) > min(p[1] for p in t))


def contact(one, other):
    """Length along which edges of two grounds run against each other within TOUCH, and how far they are apart at most."""
    total, widest = 0.0, 0.0
    for p in one:
        for i in range(len(p)):
            a, b = p[i - 1], p[i]
            size = math.dist(a, b)
            if not size:
                continue
            u = ((b[0] - a[0]) / size, (b[1] - a[1]) / size)
            for q in other:
                for k in range(len(q)):
                    c, d = q[k - 1], q[k]
                    along = [(x[0] - a[0]) * u[0] + (x[1] - a[1]) * u[1] for x in (c, d)]
                    across = [(x[1] - a[1]) * u[0] - (x[0] - a[0]) * u[1] for x in (c, d)]
                    if along[1] >= along[0] or max(map(abs, across)) > TOUCH:
                        continue
                    shared = min(size, along[0]) - max(0.0, along[1])
                    if shared > 0.1:
                        total += shared
                        widest = max(widest, *map(abs, across))
    return total, widest


def pairs_near(grounds, reach=TOUCH):
    boxes = {}
    for name, rings in grounds.items():
        xs, ys = [p[0] for r in rings for p in r], [p[1] for r in rings for p in r]
        if xs:
            boxes[name] = (min(xs) - reach, min(ys) - reach, max(xs) + reach, max(ys) + reach)
    cells = defaultdict(list)
    for name, (x0, y0, x1, y1) in boxes.items():
        for x in range(int(x0 // 50), int(x1 // 50) + 1):
            for y in range(int(y0 // 50), int(y1 // 50) + 1):
                cells[x, y].append(name)
    seen = set()
    for names in cells.values():
        for i, one in enumerate(names):
            for other in names[:i]:
                key = tuple(sorted((one, other)))
                p, q = boxes[one], boxes[other]
                if key not in seen and p[0] <= q[2] and q[0] <= p[2] and p[1] <= q[3] and q[1] <= p[3]:
                    seen.add(key)
    return sorted(seen)


def size_3d(ring):
    n = [0.0, 0.0, 0.0]
    for i in range(len(ring)):
        p, q = ring[i - 1], ring[i]
        for k in range(3):
            n[k] += p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3]
    return math.sqrt(sum(c * c for c in n)) / 2


def roof_of(polygons):
    """Heights of eaves and ridge: the lowest and the highest point of the largest face that is a roof and not level."""
    faces = [polygon[0] for polygon in polygons if 0.25 < normal_z(polygon[0]) < 0.985]
    if not faces:
        return None
    largest = max(faces, key=size_3d)
    return min(p[2] for p in largest), max(p[2] for p in largest)


def roof_lines(before, after, leader, pairs):
    """Of eaves and ridges that were in line between two that touch and stay apart: how many are out of line, and by how much."""
    were, out, widest = 0, 0, 0.0
    for p, q in pairs:
        if leader.get(p) != p or leader.get(q) != q or None in (before.get(p), before.get(q), after.get(p), after.get(q)):
            continue
        for k in range(2):
            if abs(before[p][k] - before[q][k]) <= LINE:
                were += 1
                apart = abs(after[p][k] - after[q][k])
                out += apart > LINE
                widest = max(widest, apart)
    return {"roof_lines": were, "out_of_line": out, "out_by_mm": round(1000 * widest, 1)}


def city(path):
    grounds, members = {}, {}
    for name, attributes, polygons in features(path):
        grounds[name] = ground_of(polygons)
        for member in str(attributes.get("oriel_members", name)).split(";"):
            members[member] = name
    return grounds, members


def covered(grounds):
    overlaps = {pair: overlap(grounds[pair[0]], grounds[pair[1]]) for pair in pairs_near(grounds)}
    return sum(area(r) for rings in grounds.values() for r in rings) - sum(overlaps.values()), overlaps


def judge(oriel, before_path, after_path, scale, name):
    before, _ = city(before_path)
    after, leader = city(after_path)
    covered_before, overlaps_before = covered(before)
    covered_after, overlaps_after = covered(after)
    known = {tuple(sorted((leader.get(p), leader.get(q)))) for (p, q), m2 in overlaps_before.items()
             if m2 > 0.01 and leader.get(p) and leader.get(q)}
    new = [pair for pair, m2 in overlaps_after.items() if m2 > 0.01 and pair not in known]
    lost, gap = 0.0, 0.0
    length = 0.0
    wanted = defaultdict(float)
    for p, q in pairs_near(before):
        metres, _ = contact(before[p], before[q])
        length += metres
        if metres > 0.1 and leader.get(p) and leader.get(q) and leader[p] != leader[q]:
            wanted[tuple(sorted((leader[p], leader[q])))] += metres
    for (p, q), metres in wanted.items():
        found, apart = contact(after[p], after[q])
        lost += max(0.0, metres - found)
        gap = max(gap, apart)
    valid = run(oriel, "validate", after_path).stderr.strip().splitlines()[-1]
    print(json.dumps({"input": name, "scale": scale, "buildings": len(before), "after": len(after), "groups": sum(
        1 for one in set(leader.values()) if list(leader.values()).count(one) > 1), "valid": valid,
        "overlaps": len(new), "contact_m": round(length, 1), "between_groups_m": round(sum(wanted.values()), 1),
        "contact_lost_m": round(lost, 2), "widest_gap_mm": round(1000 * gap, 2), "covered_m2": round(covered_before, 1),
        "covered_change_pct": round(100 * (covered_after / covered_before - 1), 2),
        **roof_lines(*({n: roof_of(p) for n, _, p in features(path)} for path in (before_path, after_path)), leader,
                     [pair for pair in pairs_near(before) if contact(before[pair[0]], before[pair[1]])[0] > 0.1])}), flush=True)


def lines_hash(paths):
    lines = sorted(line for path in paths for line in open(path) if '"CityJSONFeature"' in line[:60])
    return hashlib.sha256("".join(lines).encode()).hexdigest()


def one_hash(oriel, source, profile, scale, folder, name):
    """Whole, in threads, turned round, and in shards that look at the whole."""
    head, *lines = open(source).readlines()
    hashes, parts = set(), []
    backwards = os.path.join(folder, "backwards.city.jsonl")
    open(backwards, "w").write(head + "".join(reversed(lines)))
    for i in range(3):
        parts.append(os.path.join(folder, f"part{i}.city.jsonl"))
        open(parts[-1], "w").write(head + "".join(lines[i::3]))

    def made(path, *more):
        out = os.path.join(folder, "made." + os.path.basename(path))
        run(oriel, "generalise", path, "--scale", f"1:{scale}", "--profile", profile, "-o", out, *more)
        return out
    hashes.add(lines_hash([made(source, "--neighbours")]))
    hashes.add(lines_hash([made(source, "--neighbours", "-j", "3")]))
    hashes.add(lines_hash([made(backwards, "--neighbours", "-j", "2")]))
    hashes.add(lines_hash([made(part, f"--neighbours={source}", "-j", "2") for part in parts]))
    print(json.dumps({"input": name, "scale": scale, "hashes": len(hashes)}), flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("oriel")
    parser.add_argument("generate")
    parser.add_argument("--houses", type=int, default=320)
    parser.add_argument("--tile")
    parser.add_argument("--scales", default="10000,25000")
    parser.add_argument("--times", default="", help="numbers of houses for which the search is measured: time and memory")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        profile = os.path.join(folder, "town.yaml")
        open(profile, "w").write(PROFILE)
        source = os.path.join(folder, "city.city.jsonl")
        run(asked.generate, "--style", "city", "--count", str(asked.houses), "--seed", "5", "-o", source)
        inputs = [("generated city", source)] + ([("tile", asked.tile)] if asked.tile else [])
        for name, path in inputs:
            for scale in asked.scales.split(","):
                out = os.path.join(folder, "out" + (".city.jsonl" if path.endswith("jsonl") else ".city.json"))
                run(asked.oriel, "generalise", path, "--neighbours", "--scale", f"1:{scale}", "--profile", profile, "-o", out)
                judge(asked.oriel, path, out, int(scale), name)
            if path.endswith("jsonl"):
                one_hash(asked.oriel, path, profile, asked.scales.split(",")[0], folder, name)
        for count in filter(None, asked.times.split(",")):
            run(asked.generate, "--style", "city", "--count", count, "--seed", "5", "-o", source)
            call = (asked.oriel, "label", source, "--id", "house-000001", "-o", os.path.join(folder, "n.city.jsonl"))
            (alone_s, alone_mb), (search_s, search_mb) = measured(*call), measured(*call, "--neighbours")
            print(json.dumps({"houses": int(count), "search_s": round(search_s - alone_s, 2), "alone_mb": round(alone_mb),
                              "search_mb": round(search_mb)}), flush=True)


if __name__ == "__main__":
    main()

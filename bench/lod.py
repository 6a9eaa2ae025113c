#!/usr/bin/env python3
"""Compares levels of detail of the same buildings, building by building, and prints a table.

    lod.py OURS.city.jsonl LOD REFERENCE.city.jsonl LOD

Ground areas are those of facets that look down; their overlap is measured along 400 lines across each building.
"""
import statistics
import sys

from city_lines import records


def solids(path, lod):
    """id -> list of shells, each a list of polygons (rings of points), of all geometries at that lod."""
    found = {}
    for record, points in records(path):
        for name, thing in record["CityObjects"].items():
            for geometry in thing.get("geometry", []):
                if geometry["lod"] != lod or "Solid" not in geometry["type"]:
                    continue
                bodies = [geometry["boundaries"]] if geometry["type"] == "Solid" else geometry["boundaries"]
                found[name] = [[[[points[v] for v in ring] for ring in polygon] for polygon in shell]
                               for body in bodies for shell in body]
    return found


def newell(ring):
    n = [0.0, 0.0, 0.0]
    o = ring[0]
    for p, q in zip(ring[1:], ring[2:]):
        u, v = [p[i] - o[i] for i in range(3)], [q[i] - o[i] for i in range(3)]
        for i in range(3):
            n[i] += (u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]) / 2
    return n


def volume(shells):
    base = shells[0][0][0][0]
    total = 0.0
    for shell in shells:
        for polygon in shell:
            for ring in polygon:
                n, o = newell(ring), ring[0]
                total += sum(n[i] * (o[i] - base[i]) for i in range(3)) / 3
    return total


def is_closed(shells):
    edges = {}
    for shell in shells:
        for polygon in shell:
            for ring in polygon:
                for p, q in zip(ring, ring[1:] + ring[:1]):
                    edges[tuple(p), tuple(q)] = edges.get((tuple(p), tuple(q)), 0) + 1
    return all(n == edges.get((q, p), 0) for (p, q), n in edges.items())


def ground(shells):
    """The outlines of facets that look down, without walls that lean."""
    rings = []
    for shell in shells:
        for polygon in shell:
            normals = [newell(ring) for ring in polygon]
            n = [sum(m[i] for m in normals) for i in range(3)]
            if n[2] < -0.5 * sum(c * c for c in n) ** 0.5:
                rings += polygon
    return rings


def spans(rings, y):
    cuts = sorted(p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
                  for ring in rings for p, q in zip(ring, ring[1:] + ring[:1]) if (p[1] <= y) != (q[1] <= y))
    return list(zip(cuts[::2], cuts[1::2]))


def overlap(mine, other, lines=400):
    ys = [p[1] for ring in mine + other for p in ring]
    low, step = min(ys), (max(ys) - min(ys)) / lines
    both = either = 0.0
    for i in range(lines):
        y = low + (i + 0.5) * step
        a, b = spans(mine, y), spans(other, y)
        common = sum(max(0.0, min(q, s) - max(p, r)) for p, q in a for r, s in b)
        both += common
        either += sum(q - p for p, q in a) + sum(q - p for p, q in b) - common
    return both / either if either else 0.0


def height(shells):
    z = [p[2] for shell in shells for polygon in shell for ring in polygon for p in ring]
    return max(z) - min(z)


def main():
    ours, theirs = solids(sys.argv[1], sys.argv[2]), solids(sys.argv[3], sys.argv[4])
    names = sorted(set(ours) & set(theirs))
    iou = [overlap(ground(ours[n]), ground(theirs[n])) for n in names]
    by_volume = [volume(ours[n]) / volume(theirs[n]) - 1 for n in names]
    by_height = [height(ours[n]) - height(theirs[n]) for n in names]
    within = sum(abs(v) <= 0.05 for v in by_volume)
    print(f"{sys.argv[2]} against {sys.argv[4]}: {len(ours)} solids, closed {sum(map(is_closed, ours.values()))}; "
          f"of {len(names)}: footprint IoU median {statistics.median(iou):.4f}, least {min(iou):.4f}, "
          f">= 0.999 {sum(i >= 0.999 for i in iou)}; volume median {100 * statistics.median(by_volume):+.2f} %, "
          f"median |.| {100 * statistics.median(map(abs, by_volume)):.2f} %, within 5 % {within}; "
          f"height median {statistics.median(by_height):+.3f} m, median |.| {statistics.median(map(abs, by_height)):.3f} m")
    if "-v" in sys.argv:
        for n, i, v, h in sorted(zip(names, iou, by_volume, by_height), key=lambda row: row[1])[:15]:
            print(f"  {n} IoU {i:.4f} volume {100 * v:+.2f} % height {h:+.2f} m")
        for n, i, v, h in sorted(zip(names, iou, by_volume, by_height), key=lambda row: -abs(row[2]))[:10]:
            print(f"  {n} IoU {i:.4f} volume {100 * v:+.2f} % height {h:+.2f} m")


main()

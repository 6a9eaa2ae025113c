#!/usr/bin/env python3
"""Compares the volume of houses at LoD 2.0 with what their truth says: the input and the air of its openings.

    lod_truth.py FOLDER_WITH_TRUTH FOLDER_WITH_LOD_2.0

Houses with chimneys or dormers are left out: their truth does not say how much of them is inside the roof.
"""
import glob
import json
import os
import sys


def polygons(city, lod=None):
    scale = city["transform"]["scale"]
    points = [[v[i] * scale[i] for i in range(3)] for v in city["vertices"]]
    found = []
    for thing in city["CityObjects"].values():
        for geometry in thing.get("geometry", []):
            if lod is not None and geometry["lod"] != lod:
                continue
            nested = geometry["boundaries"]
            for _ in range({"MultiSurface": 0, "Solid": 1, "MultiSolid": 2}[geometry["type"]]):
                nested = [inner for outer in nested for inner in outer]
            found += [[[points[v] for v in ring] for ring in polygon] for polygon in nested]
    return found


def area_vector(polygon):
    total = [0.0, 0.0, 0.0]
    for ring in polygon:
        o = ring[0]
        for p, q in zip(ring[1:], ring[2:]):
            u, v = [p[i] - o[i] for i in range(3)], [q[i] - o[i] for i in range(3)]
            for i in range(3):
                total[i] += (u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]) / 2
    return total


def area(polygon):
    return sum(c * c for c in area_vector(polygon)) ** 0.5


def volume(solid):
    return sum(area_vector([ring])[i] * ring[0][i] for polygon in solid for ring in polygon for i in range(3)) / 3


errors = []
for path in sorted(glob.glob(sys.argv[1] + "/*.stripped.city.json")):
    truth = json.load(open(path.replace("stripped.city", "truth")))["objects"]
    if any(thing["class"] in ("chimney", "dormer") for thing in truth):
        continue
    before = polygons(json.load(open(path)))
    after = polygons(json.load(open(os.path.join(sys.argv[2], os.path.basename(path)))), "2.0")
    air = sum(thing["recess_m"] * max(area(before[face]) for face in thing["faces"])
              for thing in truth if thing.get("detectable") and thing.get("recess_m"))
    errors.append(abs(volume(after) / (volume(before) + air) - 1))
print(f"{len(errors)} houses: volume within {100 * max(errors):.5f} %")

#!/usr/bin/env python3
"""Draws what `oriel repair` did to a building:
python3 docs/repair_picture.py OUT.png PUBLISHED.city.json REPORT.jsonl REPAIRED.city.json [AZIMUTH_DEG]

Three views: the polygons as published (dark: seen from behind); what was left out (orange: outside on both sides; violet: inner
faces); the solid (green: closed by oriel). Standard library only.
"""
import json
import sys

import picture

KEPT, BEHIND, CLOSED = (222, 218, 208), (96, 92, 92), (96, 176, 104)
LEFT_OUT = {"dangling": (232, 140, 52), "inner": (150, 110, 190)}


def faces_of(path):
    """(rings in metres, semantic type) of the polygons in reading order."""
    with open(path) as file:
        model = json.load(file)
    scale, shift = model["transform"]["scale"], model["transform"]["translate"]
    points = [[c * s + t for c, s, t in zip(v, scale, shift)] for v in model["vertices"]]
    for body in model["CityObjects"].values():
        for geometry in body.get("geometry", []):
            shells = geometry["boundaries"] if geometry["type"] == "Solid" else [geometry["boundaries"]]
            semantics = geometry.get("semantics")
            values = semantics["values"] if semantics else [[None] * len(shell) for shell in shells]
            if semantics and geometry["type"] != "Solid":
                values = [values]
            for shell, numbers in zip(shells, values):
                for face, number in zip(shell, numbers):
                    kind = semantics["surfaces"][number]["type"] if number is not None else None
                    yield [[points[i] for i in ring] for ring in face], kind


def draw_both_sides(view, rings, front, back):
    view.draw(rings, front)
    view.draw([ring[::-1] for ring in rings], back)


def main(out, published, report, repaired, azimuth_deg="32"):
    picture.AZIMUTH_DEG = float(azimuth_deg)
    before, after = list(faces_of(published)), list(faces_of(repaired))
    with open(report) as file:
        said = json.loads(file.readline())
    role = {p: kind for kind in LEFT_OUT for p in said[kind]["polygons"]}
    frame = picture.frame_of([(rings, None) for rings, _ in before])
    views = [picture.View(frame) for _ in range(3)]
    for number, (rings, _) in enumerate(before):
        draw_both_sides(views[0], rings, KEPT, BEHIND)
        if number in role:
            draw_both_sides(views[1], rings, LEFT_OUT[role[number]], LEFT_OUT[role[number]])
    for rings, kind in after:
        views[2].draw(rings, CLOSED if kind == "ClosureSurface" else KEPT)
    picture.write(out, views)


if __name__ == "__main__":
    main(*sys.argv[1:])

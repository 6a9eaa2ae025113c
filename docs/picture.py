#!/usr/bin/env python3
"""Draws docs/picture.png from files that oriel wrote: python3 docs/picture.py OUT.png [--azimuth DEG] IN.city.json...

Every file is one view, side by side, parallel projection, hidden parts by a depth buffer, parts coloured by their label.
Standard library only.
"""
import json
import math
import struct
import sys
import zlib

PANEL_PX, HEIGHT_PX, FINER = 420, 400, 3
AZIMUTH_DEG, ELEVATION_DEG = 32, 24
COLOURS = {
    "WallSurface": (236, 226, 208), "RoofSurface": (176, 92, 76), "GroundSurface": (150, 150, 150),
    "OuterCeilingSurface": (205, 195, 180), "OuterFloorSurface": (205, 195, 180),
    "window": (84, 150, 206), "door": (122, 84, 52), "chimney": (96, 66, 62), "dormer": (226, 150, 70),
    "balcony": (110, 168, 108), "canopy": (170, 120, 178), "stairs": (140, 140, 148), None: (222, 222, 222),
}


def direction():
    a, e = math.radians(AZIMUTH_DEG), math.radians(ELEVATION_DEG)
    right = (math.cos(a), math.sin(a), 0)
    towards = (math.sin(a) * math.cos(e), -math.cos(a) * math.cos(e), math.sin(e))
    up = (-math.sin(a) * math.sin(e), math.cos(a) * math.sin(e), math.cos(e))
    return right, up, towards


def dot(p, q):
    return sum(a * b for a, b in zip(p, q))


def polygons_of(path):
    """(rings in metres, colour) of everything in the file."""
    with open(path) as file:
        model = json.load(file)
    scale, shift = model["transform"]["scale"], model["transform"]["translate"]
    points = [[c * s + t for c, s, t in zip(v, scale, shift)] for v in model["vertices"]]
    found = []
    for body in sorted(model["CityObjects"].values(), key=lambda o: o["type"] != "Building"):
        label = body.get("attributes", {}).get("oriel_label")
        for geometry in body.get("geometry", []):
            is_solid = geometry["type"] == "Solid"
            faces = geometry["boundaries"][0] if is_solid else geometry["boundaries"]
            semantics = geometry.get("semantics")
            values = semantics["values"] if semantics else [None] * len(faces)
            if semantics and is_solid:
                values = values[0]
            for face, value in zip(faces, values):
                surface = semantics["surfaces"][value] if value is not None else {}
                kind = surface.get("oriel_label", label or surface.get("type"))
                found.append(([[points[i] for i in ring] for ring in face], COLOURS.get(kind, COLOURS[None])))
    return found


def newell(ring):
    n = [0.0, 0.0, 0.0]
    for p, q in zip(ring, ring[1:] + ring[:1]):
        n[0] += (p[1] - q[1]) * (p[2] + q[2])
        n[1] += (p[2] - q[2]) * (p[0] + q[0])
        n[2] += (p[0] - q[0]) * (p[1] + q[1])
    size = math.sqrt(dot(n, n)) or 1
    return [c / size for c in n]


class View:
    def __init__(self, frame):
        self.width, self.height = PANEL_PX * FINER, HEIGHT_PX * FINER
        self.colour = [(255, 255, 255)] * (self.width * self.height)
        self.depth = [-1e9] * (self.width * self.height)
        self.plane = [None] * (self.width * self.height)
        self.frame = frame

    def to_pixels(self, p):
        right, up, towards = direction()
        x0, y0, scale = self.frame
        return ((dot(p, right) - x0) * scale + self.width / 2,
                self.height / 2 - (dot(p, up) - y0) * scale, dot(p, towards))

    def draw(self, rings, colour):
        normal = newell(rings[0])
        if dot(normal, direction()[2]) <= 1e-6:
            return
        light = 0.62 + 0.38 * max(0.0, dot(normal, (0.25, -0.75, 0.61)))
        shade = tuple(int(c * light) for c in colour)
        plane = (round(dot(normal, rings[0][0]), 2),) + tuple(round(c, 2) for c in normal)
        flat = [[self.to_pixels(p) for p in ring] for ring in rings]
        d = self.depth_of(flat[0])
        for y in range(max(0, int(min(p[1] for p in flat[0]))),
                       min(self.height, int(max(p[1] for p in flat[0])) + 1)):
            self.draw_row(y, flat, d, shade, plane)

    def depth_of(self, ring):
        """Depth as a + b x + c y."""
        n = newell(ring)
        p = ring[0]
        return (p[2] + (n[0] * p[0] + n[1] * p[1]) / n[2], -n[0] / n[2], -n[1] / n[2])

    def draw_row(self, y, flat, d, shade, plane):
        middle = y + 0.5
        crossings = sorted(
            p[0] + (middle - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
            for ring in flat for p, q in zip(ring, ring[1:] + ring[:1]) if (p[1] <= middle) != (q[1] <= middle))
        for start, end in zip(crossings[::2], crossings[1::2]):
            for x in range(max(0, math.ceil(start - 0.5)), min(self.width, math.ceil(end - 0.5))):
                depth = d[0] + d[1] * (x + 0.5) + d[2] * middle
                i = y * self.width + x
                if depth < self.depth[i] - 1e-4:
                    continue
                self.depth[i], self.colour[i], self.plane[i] = depth, shade, (plane, shade)

    def pixel(self, x, y):
        """The mean of the fine pixels; lines where the plane or the part changes."""
        total = [0, 0, 0]
        for fy in range(y * FINER, (y + 1) * FINER):
            for fx in range(x * FINER, (x + 1) * FINER):
                i = fy * self.width + fx
                here = self.plane[i]
                is_line = (fx + 1 < self.width and self.plane[i + 1] != here) or (
                    fy + 1 < self.height and self.plane[i + self.width] != here)
                for c in range(3):
                    total[c] += 60 if is_line else self.colour[i][c]
        return bytes(t // (FINER * FINER) for t in total)


def frame_of(polygons):
    right, up, _ = direction()
    xs = [dot(p, right) for rings, _ in polygons for p in rings[0]]
    ys = [dot(p, up) for rings, _ in polygons for p in rings[0]]
    scale = min(PANEL_PX * 0.92 / (max(xs) - min(xs)), HEIGHT_PX * 0.92 / (max(ys) - min(ys))) * FINER
    return ((min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2, scale)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write(out, views):
    rows = b"".join(b"\0" + b"".join(view.pixel(x, y) for view in views for x in range(PANEL_PX))
                    for y in range(HEIGHT_PX))
    header = struct.pack(">IIBBBBB", PANEL_PX * len(views), HEIGHT_PX, 8, 2, 0, 0, 0)
    with open(out, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def main(out, paths):
    views = []
    frame = frame_of(polygons_of(paths[0]))
    for path in paths:
        views.append(View(frame))
        for rings, colour in polygons_of(path):
            views[-1].draw(rings, colour)
    write(out, views)


if __name__ == "__main__":
    arguments = sys.argv[2:]
    if arguments[0] == "--azimuth":
        AZIMUTH_DEG = float(arguments[1])
        arguments = arguments[2:]
    main(sys.argv[1], arguments)

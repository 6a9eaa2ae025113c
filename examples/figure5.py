#!/usr/bin/env python3
"""Writes the building of the paper's figure 5, modelled again, as CityJSON to stdout.

Known from the paper: 34 split planes; 19 cells; 8 inner nodes; a chimney, which is found first, by one
plane, with a quality value of 0.003. Chosen here: all else, so that just this comes out."""

import json

LENGTH, DEPTH, EAVES, RIDGE = 12.0, 8.0, 6.0, 9.0
NICHE = 0.2
COLUMNS = [(1.0, 2.2), (5.4, 6.6), (9.8, 11.0)]  # along the front and the back
SIDE = (3.0, 4.2)  # along the sides
ROWS = [(1.0, 2.5), (4.0, 5.5)]
DOOR = (COLUMNS[1][0], COLUMNS[1][1], 2.2)  # from, to, height: it stands on the ground
CHIMNEY = (3.0, 3.4, 2.0, 2.36, 10.0)  # x, y, top
BALCONY = (4.0, 8.0, 9.5, 3.0, 3.2)  # x, y of its front, z

polygons = []


def add(*rings):
    """The outer ring counter-clockwise as seen from outside, then holes, clockwise."""
    polygons.append(rings)


def roof(y):
    """The height of the roof over y."""
    half = DEPTH / 2
    return EAVES + (RIDGE - EAVES) * (half - abs(half - y)) / half


def rectangle(place, u0, u1, v0, v1):
    """A ring in a plane: place(u, v) is a point of it; counter-clockwise where u × v looks outside."""
    return [place(u0, v0), place(u1, v0), place(u1, v1), place(u0, v1)]


def opening(place, u0, u1, v0, v1, on_ground=False):
    """Pane and reveals of a niche; place(u, v, depth). Returns the hole in the wall."""
    add(rectangle(lambda u, v: place(u, v, NICHE), u0, u1, v0, v1))
    corners = [(u0, v0), (u1, v0), (u1, v1), (u0, v1)]
    for (au, av), (bu, bv) in zip(corners, corners[1:] + corners[:1]):
        if on_ground and av == bv == v0:
            continue
        add([place(au, av, 0), place(bu, bv, 0), place(bu, bv, NICHE), place(au, av, NICHE)])
    return rectangle(lambda u, v: place(u, v, 0), u0, u1, v0, v1)[::-1]


def long_wall(place, ring, more_holes=()):
    """The front or the back: five windows and a door."""
    holes = list(more_holes)
    for u0, u1 in COLUMNS:
        for v0, v1 in ROWS:
            if (u0, v0) != (DOOR[0], ROWS[0][0]):
                holes.append(opening(place, u0, u1, v0, v1))
    opening(place, DOOR[0], DOOR[1], 0.0, DOOR[2], on_ground=True)
    add(ring, *holes)


def outline(place):
    """A long wall around its door."""
    u0, u1, height = DOOR
    return [place(u, v, 0) for u, v in [(0, 0), (u0, 0), (u0, height), (u1, height), (u1, 0), (LENGTH, 0),
                                        (LENGTH, EAVES), (0, EAVES)]]


def walls():
    def front(u, v, d):
        return (u, d, v)

    def back(u, v, d):
        return (LENGTH - u, DEPTH - d, v)

    x0, x1, _, z0, z1 = BALCONY
    long_wall(front, outline(front))
    long_wall(back, outline(back),
              [rectangle(lambda u, v: back(u, v, 0), LENGTH - x1, LENGTH - x0, z0, z1)[::-1]])
    for x, inwards in ((0.0, 1), (LENGTH, -1)):
        def side(u, v, d, x=x, inwards=inwards):
            return (x + inwards * d, DEPTH - u if inwards > 0 else u, v)
        u0, u1 = (DEPTH - SIDE[1], DEPTH - SIDE[0]) if inwards > 0 else SIDE
        holes = [opening(side, u0, u1, v0, v1) for v0, v1 in ROWS]
        add([side(u, v, 0) for u, v in [(0, 0), (DEPTH, 0), (DEPTH, EAVES), (DEPTH / 2, RIDGE), (0, EAVES)]],
            *holes)


def ground():
    u0, u1, _ = DOOR
    add([(0, 0, 0), (0, DEPTH, 0), (LENGTH - u1, DEPTH, 0), (LENGTH - u1, DEPTH - NICHE, 0),
         (LENGTH - u0, DEPTH - NICHE, 0), (LENGTH - u0, DEPTH, 0), (LENGTH, DEPTH, 0), (LENGTH, 0, 0),
         (u1, 0, 0), (u1, NICHE, 0), (u0, NICHE, 0), (u0, 0, 0)])


def roof_and_chimney():
    x0, x1, y0, y1, top = CHIMNEY
    foot = [(x0, y0, roof(y0)), (x1, y0, roof(y0)), (x1, y1, roof(y1)), (x0, y1, roof(y1))]
    head = [(x, y, top) for x, y, _ in foot]
    add([(0, 0, EAVES), (LENGTH, 0, EAVES), (LENGTH, DEPTH / 2, RIDGE), (0, DEPTH / 2, RIDGE)], foot[::-1])
    add([(LENGTH, DEPTH, EAVES), (0, DEPTH, EAVES), (0, DEPTH / 2, RIDGE), (LENGTH, DEPTH / 2, RIDGE)])
    add(head)
    for i in range(4):
        j = (i + 1) % 4
        add([foot[i], foot[j], head[j], head[i]])


def balcony():
    x0, x1, y1, z0, z1 = BALCONY
    y0 = DEPTH
    add([(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)])
    add([(x0, y0, z0), (x0, y1, z0), (x1, y1, z0), (x1, y0, z0)])
    add([(x1, y1, z0), (x0, y1, z0), (x0, y1, z1), (x1, y1, z1)])
    add([(x0, y1, z0), (x0, y0, z0), (x0, y0, z1), (x0, y1, z1)])
    add([(x1, y0, z0), (x1, y1, z0), (x1, y1, z1), (x1, y0, z1)])


def city_json():
    places = [[[tuple(round(c * 1000) for c in p) for p in ring] for ring in rings] for rings in polygons]
    vertices = sorted({p for rings in places for ring in rings for p in ring})
    number = {p: i for i, p in enumerate(vertices)}
    boundaries = [[[number[p] for p in ring] for ring in rings] for rings in places]
    return {"type": "CityJSON", "version": "2.0",
            "transform": {"scale": [0.001] * 3, "translate": [0, 0, 0]},
            "CityObjects": {"figure5": {"type": "Building", "geometry": [
                {"type": "Solid", "lod": "3", "boundaries": [boundaries]}]}},
            "vertices": vertices}


walls()
ground()
roof_and_chimney()
balcony()
print(json.dumps(city_json(), separators=(",", ":")))

"""CityJSON as sets of polygons with what they are, to be compared."""
import collections
import copy
import json

DEPTHS = {"MultiSolid": 2, "CompositeSolid": 2, "Solid": 1}
WRITTEN = ("Building", "BuildingPart", "BuildingInstallation")


def records(path):
    """The transform, vertices and objects of a file, or of each line of a stream."""
    with open(path, encoding="utf-8") as file:
        lines = [file.read()] if path.endswith(".json") else file.read().splitlines()
    header = json.loads(lines[0])
    for line in lines:
        one = json.loads(line)
        yield one.get("transform", header["transform"]), one["vertices"], one["CityObjects"]


def as_text(value):
    """Yes and no, which CityGML does not have, are texts."""
    return str(value).lower() if isinstance(value, bool) else value


def surface_of(surfaces, number):
    """What a polygon is, without numbers of other surfaces."""
    if number is None:
        return None
    surface = {key: as_text(value) for key, value in surfaces[number].items() if key != "children"}
    if "parent" in surface:
        surface["parent"] = surfaces[surface["parent"]]["type"]
    return json.dumps(surface, sort_keys=True)


def without_repeats(points):
    """A ring without points that stand twice in a row."""
    out = []
    for point in points:
        if not out or out[-1] != point:
            out.append(point)
    while len(out) > 1 and out[0] == out[-1]:
        out.pop()
    return tuple(out)


def rings_of(polygon, places):
    """Its rings by their points; those of fewer than three corners are left out, and the polygon if its outer ring is one."""
    rings = [without_repeats([places[v] for v in ring]) for ring in polygon]
    if len(set(rings[0])) < 3:
        return ()
    return tuple(ring for ring in rings if len(set(ring)) >= 3)


class Geometry:
    """One geometry: its level and its polygons in order, each with its surface."""

    def __init__(self, geometry, places):
        self.lod = str(geometry["lod"])
        self.surfaces = geometry.get("semantics", {}).get("surfaces", [])
        self.polygons = []
        values = geometry.get("semantics", {}).get("values")
        self._walk(geometry["boundaries"], values, DEPTHS.get(geometry["type"], 0), places)

    def _walk(self, boundaries, values, depth, places):
        for i, part in enumerate(boundaries):
            value = values[i] if isinstance(values, list) else None
            if depth > 0:
                self._walk(part, value, depth - 1, places)
                continue
            rings = rings_of(part, places)
            if rings:
                self.polygons.append((rings, value))

    @property
    def is_named(self):
        return any(key.startswith("oriel_") for surface in self.surfaces for key in surface)

    def named(self):
        """How often each polygon occurs with its surface."""
        return collections.Counter((rings, surface_of(self.surfaces, value)) for rings, value in self.polygons)

    def plain(self):
        return [rings for rings, _ in self.polygons]

    def without_surfaces(self):
        other = copy.copy(self)
        other.surfaces, other.polygons = [], [(rings, None) for rings in self.plain()]
        return other


def objects_of(path):
    """All objects that are written, by id, and whether they were read as one of these."""
    found = {}
    for transform, vertices, objects in records(path):
        places = [tuple(round(t + s * x, 6) for x, s, t in zip(v, transform["scale"], transform["translate"])) for v in vertices]
        for name, one in objects.items():
            if one["type"] not in WRITTEN:
                continue
            geometries = [g for g in one.get("geometry", []) if g["type"].endswith(("Solid", "Surface"))]
            found[name] = {"type": one["type"], "attributes": one.get("attributes", {}), "parents": one.get("parents", []),
                           "geometries": [Geometry(g, places) for g in geometries]}
    return found


def chosen(geometries):
    """The geometry that oriel has named surfaces of, else the highest."""
    own = [g for g in geometries if g.is_named]
    return max(own or geometries, key=lambda g: g.lod, default=None)

"""Levels of a series and lines of its log, for replay.py: read without oriel, points in whole micrometres."""
import hashlib
import json
from collections import defaultdict


def ring_of(points):
    first = points.index(min(points))
    return tuple(points[first:] + points[:first])


def plain(surfaces, number):
    """A semantic surface without references to others."""
    if number is None:
        return {}
    return {k: v for k, v in surfaces[number].items() if k not in ("parent", "children")}


class Level:
    """The CityObjects of a file."""

    def __init__(self, path):
        self.objects = {}  # id -> what stands in the file, without geometry
        self.facets = {}  # id -> lod -> [(shell, rings, surface, parent)]
        transform = None
        with open(path) as file:
            records = map(json.loads, file if path.endswith("l") else [file.read()])
            for record in records:
                transform = record.get("transform", transform)
                scale, shift = transform["scale"], transform["translate"]
                points = [tuple(round(1e6 * (s + f * n)) for n, f, s in zip(v, scale, shift)) for v in record["vertices"]]
                for name, thing in record["CityObjects"].items():
                    self.facets[name] = {g["lod"]: facets_of(g, points) for g in thing.pop("geometry", [])}
                    self.objects[name] = {k: sorted(v) if k in ("children", "parents") else v for k, v in thing.items()}

    def hashes(self):
        """Of each CityObject; facets, shells, children may stand in any order."""
        return {name: hashlib.sha256(json.dumps([thing, {lod: by_shell(f) for lod, f in self.facets[name].items()}],
                                                sort_keys=True).encode()).hexdigest() for name, thing in self.objects.items()}

    def lod(self, building, lod):
        return lod or max(self.facets[building])

    def state(self, building, lod):
        """The building as the log has it: facets by outer ring, [holes, surface, installations]; installations; counts."""
        facets = {rings[0]: [rings[1:], surface, set()] for _, rings, surface, _ in self.facets[building][self.lod(building, lod)]}
        installations = {}
        for child in self.objects[building].get("children", []):
            members = dict(self.objects.get(child, {}).get("attributes", {}))
            if members.pop("oriel_geometry", None) is None:
                continue
            installations[child] = members
            for _, rings, _, _ in next(iter(self.facets[child].values())):
                facets[rings[0]][2].add(child)
        counts = {k: v for k, v in self.objects[building].get("attributes", {}).items() if k.startswith("oriel_removed_")}
        return facets, installations, counts

    def figures(self, building, lod):
        """Volume and area."""
        facets = [rings for _, rings, _, _ in self.facets[building][self.lod(building, lod)]]
        return volume_m3(facets), sum(map(area_m2, facets))

    def features(self, building, lod):
        """Their ids and labels."""
        shown = [surface for _, _, surface, _ in self.facets[building][self.lod(building, lod)]]
        shown += [self.objects[child].get("attributes", {}) for child in self.objects[building].get("children", [])]
        return {(thing["oriel_id"], thing["oriel_label"]) for thing in shown if "oriel_id" in thing}


def facets_of(geometry, points):
    depth = {"MultiSurface": 0, "CompositeSurface": 0, "Solid": 1}.get(geometry["type"], 2)
    semantics = geometry.get("semantics", {})
    surfaces = semantics.get("surfaces", [])
    out = []

    def visit(boundaries, values, shell):
        for i, part in enumerate(boundaries):
            value = values[i] if values else None
            if len(shell) < depth:
                visit(part, value, shell + (i,))
                continue
            rings = [ring_of([points[v] for v in ring]) for ring in part]
            parent = None if value is None else surfaces[value].get("parent")
            out.append((shell, (rings[0], *sorted(rings[1:])), plain(surfaces, value), plain(surfaces, parent)))

    visit(geometry["boundaries"], semantics.get("values"), ())
    return out


def by_shell(facets):
    shells = defaultdict(list)
    for shell, *facet in facets:
        shells[shell].append(json.dumps(facet, sort_keys=True))
    return sorted(sorted(shell) for shell in shells.values())


def micrometres(ring):
    return ring_of([tuple(round(1e6 * c) for c in p) for p in ring])


def facet_of(facet):
    rings = [micrometres(ring) for ring in facet["rings"]]
    surface = {"type": facet["type"], **facet.get("members", {})} if facet.get("type") else {}
    return rings[0], [tuple(sorted(rings[1:])), surface, set(facet.get("installations", []))]


def apply(state, step):
    """`forward` or `inverse` of a line of the log; an AssertionError if it does not fit."""
    facets, installations, counts = state
    for outer, facet in map(facet_of, step.get("remove", [])):
        assert facets.pop(outer, None) == facet, "takes away what is not there"
    for outer, facet in map(facet_of, step.get("add", [])):
        assert outer not in facets, "adds what is there"
        facets[outer] = facet
    for holes in step.get("holes", []):
        outer = micrometres(holes["of"])
        gone, new = ({micrometres(ring) for ring in holes.get(key, [])} for key in ("remove", "add"))
        assert outer in facets and gone <= set(facets[outer][0]), "takes away a hole that is not there"
        facets[outer][0] = tuple(sorted(set(facets[outer][0]) - gone | new))
    for values, changed in (installations, step.get("installations", {})), (counts, step.get("attributes", {})):
        for key, value in changed.items():
            values.pop(key, None)
            if value is not None:
                values[key] = value


def edges(rings):
    return ((p, q) for ring in rings for p, q in zip(ring, ring[1:] + ring[:1]))


def newell(rings):
    """Twice the area vector, in m2."""
    o = rings[0][0]
    total = [0.0, 0.0, 0.0]
    for p, q in edges(rings):
        a, b = [(c - d) / 1e6 for c, d in zip(p, o)], [(c - d) / 1e6 for c, d in zip(q, o)]
        for i in range(3):
            total[i] += a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2]
    return total


def area_m2(rings):
    return sum(c * c for c in newell(rings)) ** 0.5 / 2


def volume_m3(facets):
    base = facets[0][0][0]
    return sum(sum((c - d) / 1e6 * n for c, d, n in zip(rings[0][0], base, newell(rings))) for rings in facets) / 6


def box(shell):
    points = [p for rings in shell for p in rings[0]]
    return [min(p[i] for p in points) for i in range(3)] + [-max(p[i] for p in points) for i in range(3)]


def lumps_of(facets):
    """What hangs together by edges is a shell; one that is turned inwards is a cavity of the smallest lump around it."""
    parent = list(range(len(facets)))

    def find(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    first = {}
    for i, rings in enumerate(facets):
        for p, q in edges(rings):
            parent[find(i)] = find(first.setdefault((min(p, q), max(p, q)), i))
    shells = defaultdict(list)
    for i, rings in enumerate(facets):
        shells[find(i)].append(rings)
    if len(shells) == 1:
        return [list(shells.values())]
    shells = sorted(shells.values(), key=volume_m3)
    lumps = [[shell] for shell in shells if volume_m3(shell) >= 0]
    for cavity in shells[:len(shells) - len(lumps)]:
        around = [lump for lump in lumps if all(a <= b for a, b in zip(box(lump[0]), box(cavity)))]
        (around or lumps)[0].append(cavity)
    return lumps

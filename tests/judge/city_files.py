"""CityJSON files and streams as the judge sees them: one geometry of each building, with its coordinates."""
import json

SURFACES = ("Solid", "MultiSolid", "CompositeSolid", "MultiSurface", "CompositeSurface")


def documents(path):
    """The transform, vertices and objects of a file, or of each line of a stream."""
    with open(path) as file:
        if not path.endswith(".jsonl"):
            one = json.load(file)
            yield one["transform"], one["vertices"], one["CityObjects"]
            return
        header = json.loads(file.readline())
        for line in file:
            one = json.loads(line)
            yield header["transform"], one["vertices"], one["CityObjects"]


def mapped(boundaries, value_of):
    """Nested lists of vertex numbers with what stands for each of them."""
    return [value_of[b] if isinstance(b, int) else mapped(b, value_of) for b in boundaries]


def vertices_in(boundaries, found):
    for b in boundaries:
        if isinstance(b, int):
            found.add(b)
        else:
            vertices_in(b, found)
    return found


def chosen_geometry(city_object, lod):
    """The geometry that oriel reads: that of a level of detail, or the highest."""
    if city_object["type"] not in ("Building", "BuildingPart"):
        return None
    fitting = [g for g in city_object.get("geometry", [])
               if g["type"] in SURFACES and (lod is None or str(g["lod"]) == lod)]
    return max(fitting, key=lambda g: str(g["lod"])) if fitting else None


class Geometry:
    """Of one building: what is compared is its type and every coordinate in metres, to the tenth of a micrometre."""

    def __init__(self, transform, vertices, city_object, geometry):
        self.transform, self.object, self.type = transform, city_object, geometry["type"]
        self.boundaries = geometry["boundaries"]
        self.semantics = geometry.get("semantics")
        self.vertices = {n: vertices[n] for n in sorted(vertices_in(self.boundaries, set()))}
        scale, translate = transform["scale"], transform["translate"]
        self.points = {n: tuple(round(v[i] * scale[i] + translate[i], 7) for i in range(3))
                       for n, v in self.vertices.items()}

    def numbers(self):
        return self.type, mapped(self.boundaries, self.points)


def geometries(path, lod):
    found = {}
    for transform, vertices, objects in documents(path):
        for name, city_object in objects.items():
            geometry = chosen_geometry(city_object, lod)
            if geometry and max(vertices_in(geometry["boundaries"], {-1})) < len(vertices):
                found[name] = Geometry(transform, vertices, city_object, geometry)
    return found


def city_json(buildings):
    """A file of these buildings (by id, of one transform), with this geometry only."""
    vertices, objects, transform = [], {}, None
    for name, one in buildings.items():
        transform = one.transform
        number_of = {}
        for n, vertex in one.vertices.items():
            number_of[n] = len(vertices)
            vertices.append(vertex)
        geometry = {"type": one.type, "lod": "2", "boundaries": mapped(one.boundaries, number_of)}
        if one.semantics:
            geometry["semantics"] = one.semantics
        objects[name] = {"type": "Building", "attributes": {}, "geometry": [geometry]}
    return {"type": "CityJSON", "version": "2.0", "transform": transform, "CityObjects": objects, "vertices": vertices}


def city_json_seq(buildings):
    """The lines of a stream of these buildings."""
    whole = city_json(buildings)
    yield {**whole, "CityObjects": {}, "vertices": []}
    for name, one in buildings.items():
        alone = city_json({name: one})
        yield {"type": "CityJSONFeature", "id": name, "CityObjects": alone["CityObjects"], "vertices": alone["vertices"]}


def by_transform(buildings):
    """A file has one transform."""
    groups = {}
    for name, one in buildings.items():
        groups.setdefault(json.dumps(one.transform), {})[name] = one
    return list(groups.values())
